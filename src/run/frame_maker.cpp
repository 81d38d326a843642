#include "run/frame_maker.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/error.hpp"
#include "base/stop.hpp"
#include "base/words.hpp"
#include "frame/frame.hpp"
#include "frame/panel.hpp"
#include "frame/parts/ground.hpp"
#include "geometry/flat.hpp"
#include "language/code_text.hpp"
#include "language/counts.hpp"
#include "run/counters.hpp"

namespace lantern::run {

// --- what is counted here ---

namespace {

constexpr CountDoc kAnswerCounts[] = {
    {"nodes_visited", when::query, "node visited/nodes visited",
     "Nodes that the last ray, cull or query went into."},
    {"nodes_skipped", when::query, "node left out/nodes left out",
     "Nodes that it left out, with all below them."},
    {"objects_tested", when::query, "body tested/bodies tested", "Bodies that it tested.",
     Most::bodies},
    {"hits", when::query, "", "Bodies that it found.", Most::bodies},
    {"compared_bodies", when::compared, "body compared/bodies compared",
     "Bodies of the last `compare`."},
    {"compared_pairs", when::compared, "by brute force",
     "Pairs of them that brute force would test."},
    {"compared_overlaps", when::compared, "overlap of boxes/overlaps of boxes",
     "Those whose boxes overlap after its step, by every kind."},
    {"least_work", when::compared, "comparison a step/comparisons a step",
     "Comparisons of the kind that needed fewest in its step, to make ready and to find pairs."},
    {"least_lecture_work", when::compared, "by the lecture's best",
     "The same of the quadtree, octree, BSP and kD-tree alone."}};

// Frames of one run, all paces together.
constexpr std::uint32_t kMostFrames = 100'000;

bool has_node(const Frame& frame, const std::string& label) {
  return std::ranges::find(frame.nodes, label, &FrameNode::label) != frame.nodes.end();
}

// Does the part of a flat world that is shown hold what the note is about?
bool in_view(const FrameNote& note, const Frame& frame) {
  if (!frame.view) return true;
  if (note.of == NoteOf::point) return contains(*frame.view, flat(note.point));
  for (const BodyId id : note.bodies) {
    const FrameBody* body = frame.body_of(id);
    if (!body || !overlap(flat(body->box), *frame.view)) return false;
  }
  return true;
}

// What the sparkline shows: the number that the scenario puts in front, if it is a count.
std::string trace_name(const Scenario& scenario) {
  const std::string front =
      scenario.headline.empty() ? "pairs" : fronted(scenario.headline[0]).name;
  return find_in(known_counts(), front) ? front : "pairs";
}

std::string why_not_noted(const NoteSpec& note, const Frame& frame) {
  if (!note.event.empty() && note.event != frame.event)
    return fmt::format("no event '{}' has it", note.event);
  if (note.of == NoteOf::node && !has_node(frame, note.name))
    return fmt::format("there is no node '{}'", note.name);
  if (frame.view) return "it lies outside the view";
  return "its body is not there";
}

}  // namespace

std::span<const CountDoc> answer_counts() { return kAnswerCounts; }

FrameMaker::FrameMaker(const Scenario& scenario, Pace pace, const Stage& stage,
                       const std::function<bool(const Frame&)>& sink, Wanted wants)
    : scenario_(scenario),
      pace_(pace),
      stage_(stage),
      sink_(sink),
      wants_(wants),
      headline_(scenario.headline),
      panels_(scenario.panels),
      looks_(scenario) {
  LANTERN_CHECK(counts_are_known(), ==, true);
  if (scenario.chart) plotter_.emplace(scenario);
  if (shows(scenario.panels, "sparkline"))
    trace_ = FrameTrace{trace_name(scenario), {}, script_seconds(scenario, &part_)};
  if (shows(scenario.panels, "code"))
    for (const Step& step : scenario.steps)
      if (step.code && !code_) code_ = code_of(step.code->function);
}

void FrameMaker::begin(const Step& step, std::uint32_t index) {
  step_ = &step;
  step_index_ = index;
  const bool new_part = !step.part.empty() && step.part != part_;
  if (!step.part.empty()) part_ = step.part;
  if (trace_ && new_part) {
    trace_->points.clear();
    trace_->seconds = script_seconds(scenario_, &part_);
    trace_begun_ = stage_.time;
  }
  if (plotter_) plotter_->begin_part(part_, stage_.time);
  if (index == 0 || new_part) {
    part_seconds_ = script_seconds(scenario_, &part_);
    steps_before_part_ = stage_.engine ? stage_.engine->world_work().steps : 0;
  }
  touched = {};
  focus.clear();
  texture.clear();
  finding_.reset();
  narrow.begin_step();
  noted_.clear();
  looks_.begin(step, stage_.time);
  begin_code();
  if (!step.headline.empty()) headline_ = step.headline;
  if (!step.panels.empty()) panels_ = step.panels;
  lengths_before_.clear();
  for (const RulerSpec& ruler : step.rulers) {
    const auto ends = ends_of(ruler, stage_.engine.get());
    lengths_before_.push_back(ends ? std::optional(glm::distance(ends->first, ends->second))
                                   : std::nullopt);
  }
}

bool FrameMaker::wanted(std::string_view event) const {
  const auto& events = step_->events;
  return events.empty() || std::ranges::find(events, event) != events.end();
}

bool FrameMaker::emits(std::string_view event) {
  if (stopped_ || !by_event() || !wanted(event)) return false;
  if (wants_ == Wanted::all || !step_->notes.empty()) return true;
  stop_if_asked();
  if (stage_.engine) tell_faults();
  next_index();
  return false;
}

void FrameMaker::note_refused(const std::string& name) {
  refused_names_ += (refused_names_.empty() ? "" : ", ") + word(name);
}

void FrameMaker::show_finding(Finding finding) {
  counted_ = QueryNumbers{finding.counts, finding.hits.size()};
  focus = {finding.hits.begin(), finding.hits.end()};
  finding_ = std::move(finding);
}

void FrameMaker::add_row(FrameComparison::Row row, const std::string& answer) {
  comparison_.rows.push_back(std::move(row));
  answer_ = answer;
}

Frame FrameMaker::picture(const Touched& now, std::string_view event, bool midst) {
  stop_if_asked();
  Frame frame;
  frame.scenario = scenario_.name;
  if (!scenario_.side.empty())
    frame.add<FrameSide>() = {scenario_.side, scenario_.side_title, false};
  frame.title = scenario_.title;
  frame.part = part_;
  frame.seed = scenario_.seed;
  frame.index = report_.frames;
  frame.step = step_index_;
  frame.steps = static_cast<std::uint32_t>(scenario_.steps.size());
  frame.event = event;
  frame.step_name = step_->name;
  frame.panels = panels_;
  frame.cast = static_cast<std::uint32_t>(scenario_.bodies.size());
  if (!scenario_.world.land.empty())
    frame.add<FrameLand>() = {scenario_.world.land, scenario_.world.sea};
  if (!scenario_.paints.empty()) frame.add<FramePaints>().paints = scenario_.paints;
  frame.time = stage_.time;
  frame.dimension = scenario_.world.dimension;
  frame.bounds = scenario_.world.bounds;
  looks_.show(frame);
  for (const std::string& written : headline_) {
    const auto& [name, words] = fronted(written);
    frame.headline.push_back(name);
    if (!words.empty()) frame.words[name] = words;
  }
  if (stage_.engine) stage_.engine->picture(now, swept ? &*swept : nullptr, frame);
  if (stage_.engine) tell_faults();
  if (stage_.engine) narrow.add_to(frame, *stage_.engine);
  // Speeds that numbers still hold may have squares that they do not.
  for (const auto& [name, number] : frame.measures)
    if (!std::isfinite(number)) throw Refused("the measure '{}' overflows", name);
  if (stage_.level)
    stage_.level->picture(stage_.engine && stage_.engine->structure().of_level, frame);
  if (stage_.atlas) stage_.atlas->picture(now, frame);
  if (stage_.screen) stage_.screen->picture(frame);
  frame.hash = swept ? swept->state : state_hash(frame);
  add_finding(frame);
  add_comparison(frame);
  add_rulers(frame);
  lighting_.light({traits_of(step_->verb), focus, midst}, frame);
  if (step_->lit && !midst) light_named(frame);
  light_room(frame);
  add_notes(frame);
  if (plotter_) frame.add<FrameChart>() = plotter_->chart();
  if (trace_) trace(frame);
  frame.put(code_);
  if (stage_.engine && shows(scenario_.panels, "collisions")) add_collisions(frame);
  if (stage_.level && shows(scenario_.panels, "matrix")) stage_.level->picture_matrix(frame);
  for (const Panel panel : frame.panels)
    if (const auto gather = run_of(panel).gather) gather(stage_, frame);
  return frame;
}

// The function of the step, or of the step before, and the lines that the step names.
void FrameMaker::begin_code() {
  if (!code_) return;
  if (step_->code && code_->function != step_->code->function)
    code_ = code_of(step_->code->function);
  light_line(*code_, step_->code ? step_->code->line : "");
}

// The line in which the lecture's code is, if the step runs that.
void FrameMaker::light_code(std::string_view event, std::string_view line) {
  const auto place = code_ ? code_place(event) : std::nullopt;
  if (!place) return;
  if (code_->function != place->function) code_ = code_of(place->function);
  light_line(*code_, line.empty() ? place->line : line);
}

void FrameMaker::show_phase(std::string_view phase, Frame& frame) {
  if (scenario_.world.contacts == ContactMethod::lecture) light_code(phase);
  frame.put(code_);
}

void FrameMaker::add_collisions(Frame& frame) const {
  FrameCollisions& told = frame.add<FrameCollisions>();
  stage_.engine->list_collisions(told);
  told.now = stage_.engine->world_work().steps;
  told.first = steps_before_part_;
  if (part_seconds_)
    told.steps =
        static_cast<std::uint64_t>(std::llround(*part_seconds_ / scenario_.world.time_step));
}

// A wrong tree is drawn as it is, and its run fails; each fault is told where it is first seen.
void FrameMaker::tell_faults() {
  constexpr std::size_t kMost = 8;
  for (const std::string& fault : stage_.engine->structure_faults())
    if (faults_.size() < kMost && faults_.insert(fault).second)
      fail(fmt::format("{} (frame {}, time {:.6g} s)", fault, report_.frames, stage_.time));
}

// One point a moment: the last that was so.
void FrameMaker::trace(Frame& frame) {
  if (const auto n = frame.count(trace_->name); n && !swept) {
    const Vec<2> now{frame.time - trace_begun_, static_cast<double>(*n)};
    std::vector<Vec<2>>& points = trace_->points;
    if (!points.empty() && points.back().x == now.x) points.pop_back();
    points.push_back(now);
  }
  frame.add<FrameTrace>() = *trace_;
}

void FrameMaker::settle(std::string_view verb, bool last, const std::string& caption) {
  begin_code();  // events have shown where they are
  Frame frame = picture(touched, step_->name.empty() ? verb : step_->name);
  if (plotter_ && (plotter_->over_time() || (last && step_->plot))) {
    if (plotter_->over_time())
      plotter_->add_moment(frame);
    else
      plotter_->add(*step_->plot, part_, frame);
    frame.add<FrameChart>() = plotter_->chart();
  }
  // Of a side's frames the caption is that of all sides together.
  if (!caption.empty() && !(last && !step_->after.empty()))
    frame.caption = caption;
  else if (scenario_.side.empty())
    tell(step_->words(last), frame);
  frame.ending = last && step_->ending;
  if (last && !step_->question.empty() && scenario_.side.empty())
    frame.add<FrameQuestion>() =
        FrameQuestion{step_->question, fill(step_->answer, frame), step_->predict};
  verify(step_->always, frame);
  if (last) verify(step_->expect, frame);
  if (last) require_notes(frame);
  give(std::move(frame));
}

void FrameMaker::emit(const Touched& now, std::string_view event, std::string caption,
                      std::optional<BodyId> about, std::string_view line) {
  if (stage_.engine && traits_of(stage_.engine->structure().kind).is_plain &&
      std::holds_alternative<Insert>(step_->verb))
    light_code(event, line);
  Frame frame = picture(now, event, true);
  frame.caption = std::move(caption);
  for (FrameBody& body : frame.bodies) body.lit = body.id == about;
  give(std::move(frame), true);
}

// That of a frame which is given, or counted.
std::uint32_t FrameMaker::next_index() {
  if (report_.frames == kMostFrames)
    throw ScenarioError(diagnose(scenario_, step_->where,
                                 fmt::format("more than {} frames", kMostFrames),
                                 "run for a shorter time, or choose fewer events"));
  return report_.frames++;
}

void FrameMaker::give(Frame frame, bool midst) {
  if (stopped_) return;
  frame.index = next_index();
  if (stage_.engine) {
    const WorldWork& now = stage_.engine->world_work();
    if (now.steps > last_work_.steps) frame.since_last_frame = work_between(last_work_, now);
    last_work_ = now;
  }
  if (frame.dimension == 3) tell_splits(frame);
  lighting_.remember(frame, midst);
  stopped_ = !sink_(frame);
}

// Which nodes are divided and were not; while time passes they come and go, and none is told.
void FrameMaker::tell_splits(Frame& frame) {
  const bool same = frame.structure == last_structure_;
  std::set<std::string> divided;
  for (FrameNode& node : frame.nodes) {
    if (node.leaf || node.of_static) continue;
    node.split = frame.time == last_time_ && !(same && divided_.contains(node.label));
    divided.insert(node.label);
  }
  divided_ = std::move(divided);
  last_structure_ = frame.structure;
  last_time_ = frame.time;
}

void FrameMaker::fail(std::string message) {
  report_.unmet.add([&] { return diagnose(scenario_, step_->where, message + on_side()); });
}

std::string FrameMaker::on_side() const {
  return scenario_.side.empty() ? "" : fmt::format(", side '{}'", scenario_.side);
}

void FrameMaker::add_finding(Frame& frame) const {
  if (counted_) {
    frame.add_count("nodes_visited", counted_->counts.nodes_visited);
    frame.add_count("nodes_skipped", counted_->counts.nodes_skipped);
    frame.add_count("objects_tested", counted_->counts.objects_tested);
    frame.add_count("hits", counted_->hits);
  }
  if (!finding_) return;
  FrameFinding& found = frame.add<FrameFinding>();
  found.hits = finding_->hits;
  if (finding_->ray) found.rays.push_back(*finding_->ray);
  if (finding_->view) found.views.push_back(*finding_->view);
  if (finding_->region) found.queries.push_back(*finding_->region);
  for (FrameBody& body : frame.bodies) body.refused = finding_->missed.contains(body.id);
  if (!finding_->ray) dim(frame);
}

// Of the world that was compared last.
void FrameMaker::add_comparison(Frame& frame) {
  if (comparison_.rows.empty()) return;
  FrameComparison::Row& last = comparison_.rows.back();
  frame.add_count("compared_bodies", last.bodies);
  frame.add_count("compared_pairs", last.testable);
  frame.add_count("compared_overlaps", last.cells.front().work.overlaps);
  frame.add_count("least_work", last.least());
  if (const std::uint64_t least = last.least(true); least != FrameComparison::kNoWork)
    frame.add_count("least_lecture_work", least);
  if (!answer_.empty()) last.answer = fill(std::exchange(answer_, {}), frame);
  frame.add<FrameComparison>() = comparison_;
}

// Who is ruled out: not found in the end; before it, tested in vain or only in nodes left out.
void FrameMaker::dim(Frame& frame) const {
  std::set<BodyId> within_reach;
  for (const FrameNode& node : frame.nodes)
    if (!node.skipped) within_reach.insert(node.bodies.begin(), node.bodies.end());
  for (FrameBody& body : frame.bodies) {
    if (std::ranges::binary_search(frame.get<FrameFinding>().hits, body.id)) continue;
    body.dimmed = finding_->done || body.refused || !within_reach.contains(body.id);
  }
}

void FrameMaker::add_rulers(Frame& frame) const {
  for (std::size_t i = 0; i < step_->rulers.size(); ++i) {
    const RulerSpec& spec = step_->rulers[i];
    const auto ends = ends_of(spec, stage_.engine.get());
    if (!ends) continue;
    FrameRuler ruler{
        ends->first, ends->second, glm::distance(ends->first, ends->second), {}, spec.text};
    if (spec.change) ruler.before = lengths_before_[i];
    frame.add<FrameRulers>().rulers.push_back(std::move(ruler));
  }
}

// The free leaves that were asked: lit where there is room, passed where there is none.
void FrameMaker::light_room(Frame& frame) const {
  if (asked.x > 0) frame.add<FrameTextures>().asked = asked;
  const auto* ask = std::get_if<AskRoom>(&step_->verb);
  if (!ask) return;
  frame.add<FrameTextures>().asked = {ask->width, ask->height};
  for (FrameNode& node : frame.nodes)
    if (node.leaf && node.bodies.empty())
      node.mark = node.box.size().x >= ask->width && node.box.size().y >= ask->height
                      ? Mark::lit
                      : Mark::passed;
}

std::optional<std::string> FrameMaker::text_of(std::string_view name, const Frame& frame) const {
  if (name == "texture") return word(texture);
  if (name == "refused_names") return refused_names_.empty() ? word("none") : refused_names_;
  if (name == "time") return say("{:.2f}", frame.time);
  if (const auto measured = frame.measure(name)) return say("{:.4g}", *measured);
  return std::nullopt;
}

void FrameMaker::light_named(Frame& frame) {
  const LitSpec* strange = light_only(*step_->lit, frame);
  if (strange && reported_.insert(strange).second)
    report_.unmet.add([&] {
      return diagnose(scenario_, strange->where,
                      fmt::format("'{}' is to be lit on frame {}, and is neither a body nor a node "
                                  "there{}",
                                  strange->name, report_.frames, on_side()));
    });
}

// Those whose bodies and nodes are there by now.
void FrameMaker::add_notes(Frame& frame) {
  for (const NoteSpec& spec : step_->notes) {
    if (!spec.event.empty() && spec.event != frame.event) continue;
    FrameNote note{fill(spec.text, frame), spec.of, {}, kNone, {}, spec.point};
    for (const std::size_t body : spec.bodies)
      if (const auto id = stage_.engine->id_of(body)) note.bodies.push_back(*id);
    if (spec.of == NoteOf::count) note.count = spec.name;
    for (std::uint32_t i = 0; spec.of == NoteOf::node && i < frame.nodes.size(); ++i)
      if (frame.nodes[i].label == spec.name && note.node == kNone) note.node = i;
    if (note.bodies.size() != spec.bodies.size()) continue;
    if (spec.of == NoteOf::node && note.node == kNone) continue;
    if (!in_view(note, frame)) continue;
    frame.notes.push_back(std::move(note));
    noted_.insert(&spec);
  }
}

// A note that stood on no frame of the step is a promise that was not kept.
void FrameMaker::require_notes(const Frame& frame) {
  for (const NoteSpec& note : step_->notes)
    if (!noted_.contains(&note) && (note.event.empty() || by_event()))
      report_.unmet.add([&] {
        return diagnose(
            scenario_, note.where,
            fmt::format("the note '{}' has nothing to point at on frame {}: {}{}", note.text,
                        report_.frames, why_not_noted(note, frame), on_side()));
      });
}

// The caption, and which numbers it tells.
void FrameMaker::tell(const std::string& text, Frame& frame) const {
  frame.caption = fill(text, frame);
  for (const std::string& name : placeholders_of(text))
    if (frame.number(name)) frame.told.push_back(name);
}

std::string FrameMaker::fill(const std::string& text, const Frame& frame) const {
  const Speaking speaking(scenario_.words_of(text));
  return fill_caption(
      text, [&](std::string_view name) { return text_of(name, frame); },
      [&](std::string_view name) { return frame.count(name); });
}

void FrameMaker::verify(const std::vector<Expectation>& expectations, const Frame& frame) {
  report_.expectations += expectations.size();
  const auto problems = unmet(expectations, frame);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    if (!problems[i] || !reported_.insert(&expectations[i]).second) continue;
    report_.unmet.add([&] {
      return diagnose(scenario_, expectations[i].where,
                      fmt::format("{} (frame {}, time {:.6g} s{})", *problems[i], frame.index,
                                  frame.time, on_side()));
    });
  }
}

}  // namespace lantern::run
