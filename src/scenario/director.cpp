#include "scenario/director.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "scenario/atlas_stage.hpp"
#include "scenario/caption.hpp"
#include "scenario/engine.hpp"
#include "scenario/event_text.hpp"
#include "scenario/expectations.hpp"
#include "scenario/level_stage.hpp"
#include "scenario/plotter.hpp"

namespace lantern {
namespace {

// Frames of one run, all paces together.
constexpr std::uint32_t kMostFrames = 100'000;

class Director {
 public:
  Director(const Scenario& scenario, Pace pace, Work& work,
           const std::function<bool(const Frame&)>& sink)
      : scenario_(scenario), pace_(pace), sink_(sink) {
    if (!scenario.bodies.empty()) engine_ = make_engine(scenario, work);
    if (scenario.atlas) atlas_.emplace(scenario, work);
    if (scenario.level) level_.emplace(scenario);
    if (scenario.chart) plotter_.emplace(*scenario.chart);
  }

  DirectorReport run() {
    for (const Step& step : scenario_.steps) {
      begin(step);
      try {
        std::visit([&](const auto& verb) { act(verb); }, step.verb);
      } catch (const Refused& refused) {
        throw ScenarioError(diagnose(scenario_, step.where, refused.what()));
      }
      if (stopped_) break;
      ++step_index_;
    }
    return std::move(report_);
  }

 private:
  void begin(const Step& step) {
    step_ = &step;
    if (!step.part.empty()) part_ = step.part;
    touched_ = {};
    focus_.clear();
    texture_.clear();
    finding_.reset();
    if (engine_) engine_->forget_events();
  }

  bool by_event() const { return step_->pace.value_or(pace_) == Pace::event; }

  // --- the verbs ---

  void act(const Show&) { settle("show"); }

  void act(const Insert& insert) {
    for (const std::size_t body : insert.bodies) {
      if (stopped_) return;
      engine_->enter(body);
      focus_.insert(*engine_->id_of(body));
      engine_->store(body, [&](const Event& event) { witness(event); });
    }
    settle("insert");
  }

  void act(const Remove& remove) {
    for (const std::size_t body : remove.bodies) engine_->leave(body);
    engine_->rebuild();
    settle("remove");
  }

  void act(const Move& move) {
    engine_->move(move);
    if (move.rebuild) engine_->rebuild();
    focus_.insert(*engine_->id_of(move.body));
    settle("move");
  }

  void act(const ApplyForce& force) {
    engine_->apply(force);
    focus_.insert(*engine_->id_of(force.body));
    settle("force");
  }

  void act(const ApplyImpulse& impulse) {
    engine_->apply(impulse);
    focus_.insert(*engine_->id_of(impulse.body));
    settle("impulse");
  }

  void act(const Sleep& sleep) {
    for (const std::size_t body : sleep.bodies) engine_->sleep(body);
    settle("sleep");
  }

  void act(const Wake& wake) {
    for (const std::size_t body : wake.bodies) engine_->wake(body);
    settle("wake");
  }

  void act(const Run& run) {
    if (engine_) watch_movers();
    const std::uint32_t ticks = ticks_in(run.seconds);
    for (std::uint32_t tick = 1; tick <= ticks && !stopped_; ++tick) {
      let_time_pass();
      if (tick % frame_every(run.every) == 0 || tick == ticks) settle("run", tick == ticks);
    }
  }

  // Runs until the event, which must happen in time.
  void act(const Wait& wait) {
    watch_movers();
    const std::uint32_t ticks = ticks_in(wait.at_most);
    for (std::uint32_t tick = 1; tick <= ticks && !stopped_; ++tick) {
      let_time_pass();
      if (engine_->has_happened(wait.event, wait.bodies)) return settle("wait");
      if (tick == ticks)
        report_.unmet.push_back(diagnose(scenario_, step_->where,
                                         fmt::format("what this step waits for has not happened "
                                                     "within {} s",
                                                     wait.at_most)));
      if (tick % frame_every(wait.every) == 0 || tick == ticks) settle("wait", tick == ticks);
    }
  }

  // The state before the step, with what each phase of it finds, then the state after it.
  void act(const Phases&) {
    const Frame before = picture(touched_, "broad_phase");
    const auto show = [&](std::string_view event, const Frame& frame) {
      if (!wanted(event)) return;
      Frame shown = frame;
      shown.index = report_.frames;
      shown.event = event;
      shown.caption = phase_text(event, shown);
      give(shown);
    };
    show("broad_phase", before);
    let_time_pass();
    Frame after = picture(touched_, "integrate");
    Frame meeting = before;
    meeting.contacts = after.contacts;
    meeting.counts = after.counts;
    Frame narrow = meeting;
    for (FrameContact& contact : narrow.contacts)
      for (FrameContact::Point& point : contact.points) point.impulse = 0;
    show("narrow_phase", narrow);
    show("solve", meeting);
    settle("integrate");
  }

  void act(const Rebuild& rebuild) {
    engine_->rebuild_as(rebuild.structure);
    settle("rebuild");
  }

  // --- questions that the structure answers ---

  void act(const CastRay& ray) { answer(engine_->ask(ray), "ray"); }
  void act(const Cull& view) { answer(engine_->ask(view), "cull"); }
  void act(const Query& region) { answer(engine_->ask(region), "query"); }

  void answer(Finding finding, std::string_view verb) {
    finding_ = std::move(finding);
    const Finding& found = *finding_;
    if (by_event()) replay(found);
    for (const QueryEvent& event : found.walk)
      if (event.kind == QueryEvent::Kind::visit) touched_.lit.insert(event.node);
    counted_ = QueryNumbers{found.counts, found.hits.size()};
    focus_.insert(found.hits.begin(), found.hits.end());
    settle(verb);
  }

  // One frame for each thing that the walk did.
  void replay(const Finding& found) {
    using Kind = QueryEvent::Kind;
    for (std::size_t i = 0; i < found.walk.size() && !stopped_; ++i) {
      const QueryEvent& event = found.walk[i];
      if (event.kind == Kind::hit) continue;  // told with its test
      const bool hit = i + 1 < found.walk.size() && found.walk[i + 1].kind == Kind::hit;
      const bool is_test = event.kind == Kind::test;
      const std::string_view name =
          is_test ? (hit ? "hit" : "miss") : (event.kind == Kind::visit ? "visit" : "skip");
      if (event.kind == Kind::visit) touched_.passed.insert(event.node);
      if (!wanted(name)) continue;
      Touched now{{}, touched_.passed};
      if (event.kind != Kind::skip) now.lit.insert(event.node);
      emit(now, name, query_text(name, engine_->label_of(event.node), name_of(event.body)),
           is_test ? std::optional(event.body) : std::nullopt);
    }
  }

  // --- levels ---

  void act(const CompileLevel&) {
    level_->compile([&](const LevelMoment& moment) {
      if (by_event() && wanted(moment.event)) emit({}, moment.event, moment.text);
    });
    settle("compile");
  }

  void act(const Locate& locate) {
    level_->locate(locate.point);
    settle("locate");
  }

  void act(const OrderFrom& order) {
    level_->order_from(order.eye);
    settle("order");
  }

  // --- the atlas ---

  void act(const Pack& pack) {
    for (std::size_t i = 0; i < pack.textures.size() && !stopped_; ++i) {
      const TextureSpec& texture = scenario_.textures[pack.textures[i]];
      if (pack.each) touched_ = {};
      texture_ = texture.name;
      const bool last = i + 1 == pack.textures.size();
      const bool names = last && !pack.free_name.empty();
      const std::vector<std::uint32_t> before =
          names ? atlas_->free_leaves() : std::vector<std::uint32_t>();
      // Who packs many for one frame looks at none of them.
      AtlasStage::Watch watch;
      if (pack.each || by_event()) watch = [&](const AtlasEvent& e) { witness(e, texture); };
      const bool packed = atlas_->pack(pack.textures[i], watch).has_value();
      if (!packed) refused_names_ += (refused_names_.empty() ? "" : ", ") + texture.name;
      if (names) atlas_->name_free_leaf(pack.free_name, before);
      if (!last && !pack.each) continue;
      settle("pack", last, packed ? "" : refusal(texture));
    }
  }

  void act(const AskRoom& ask) {
    atlas_->ask_room(ask.width, ask.height);
    settle("ask_room");
  }

  // --- time ---

  std::uint32_t ticks_in(double seconds) const {
    return static_cast<std::uint32_t>(std::llround(seconds / scenario_.world.time_step));
  }

  std::uint32_t frame_every(int of_step) const {
    return static_cast<std::uint32_t>(of_step > 0 ? of_step : scenario_.world.frame_every);
  }

  void let_time_pass() {
    if (engine_) {
      engine_->step();
      engine_->rebuild();
    }
    time_ += scenario_.world.time_step;
  }

  void watch_movers() {
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i)
      if (engine_->is_moving(i)) focus_.insert(*engine_->id_of(i));
  }

  // --- watching the algorithms ---

  void witness(const Event& event) {
    using Kind = Event::Kind;
    if (event.kind == Kind::test) touched_.passed.insert(event.node);
    if (event.kind == Kind::store || event.kind == Kind::split || event.kind == Kind::depth_limit ||
        event.kind == Kind::no_progress)
      touched_.lit.insert(event.node);
    if (!by_event() || !wanted(event_name(event.kind))) return;
    if (event.kind == Kind::make_child && engine_->structure().children == Children::eager) return;
    Touched now = touched_;
    now.lit.clear();
    (event.kind == Kind::miss ? now.passed : now.lit).insert(event.node);
    emit(now, event_name(event.kind),
         event_text(event, engine_->label_of(event.node), name_of(event.body),
                    engine_->structure().max_depth),
         event.body);
  }

  void witness(const AtlasEvent& event, const TextureSpec& texture) {
    using Kind = AtlasEvent::Kind;
    (event.kind == Kind::cut || event.kind == Kind::store ? touched_.lit : touched_.passed)
        .insert(event.node);
    if (!by_event() || !wanted(event_name(event.kind))) return;
    Touched now{{event.node}, touched_.passed};
    emit(now, event_name(event.kind),
         event_text(event, atlas_->label_of(event.node), texture.name, texture.width,
                    texture.height));
  }

  bool wanted(std::string_view event) const {
    const auto& events = step_->events;
    return events.empty() || std::find(events.begin(), events.end(), event) != events.end();
  }

  std::string name_of(BodyId id) const {
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i)
      if (engine_->id_of(i) == id) return scenario_.bodies[i].name;
    return {};
  }

  static std::string refusal(const TextureSpec& t) {
    return fmt::format("No leaf has room for {} ({} × {}): it is refused, the rest is kept.",
                       t.name, t.width, t.height);
  }

  // --- frames ---

  // A frame of a finished state, on which the step's promises are verified.
  void settle(std::string_view verb, bool last = true, const std::string& caption = {}) {
    Frame frame = picture(touched_, step_->name.empty() ? verb : step_->name);
    if (plotter_) {
      if (last && step_->plot) plotter_->add(*step_->plot, step_->part, frame);
      frame.chart = plotter_->chart();
    }
    frame.caption = caption.empty() ? fill(step_->caption, frame) : caption;
    verify(step_->always, frame);
    if (last) verify(step_->expect, frame);
    give(frame);
  }

  // A frame in the midst of the algorithm, about one body if there is one.
  void emit(const Touched& touched, std::string_view event, std::string caption,
            std::optional<BodyId> about = {}) {
    Frame frame = picture(touched, event);
    frame.caption = std::move(caption);
    if (plotter_) frame.chart = plotter_->chart();
    for (FrameBody& body : frame.bodies) body.lit = body.id == about;
    give(frame);
  }

  Frame picture(const Touched& touched, std::string_view event) {
    Frame frame;
    frame.scenario = scenario_.name;
    frame.title = scenario_.title;
    frame.part = part_;
    frame.seed = scenario_.seed;
    frame.index = report_.frames;
    frame.step = step_index_;
    frame.steps = static_cast<std::uint32_t>(scenario_.steps.size());
    frame.event = event;
    frame.panels = scenario_.panels;
    frame.time = time_;
    frame.dimension = scenario_.world.dimension;
    frame.bounds = scenario_.world.bounds;
    frame.show_boxes = scenario_.world.show_boxes;
    frame.show_velocities = scenario_.world.show_velocities;
    if (scenario_.world.has_camera)
      frame.camera = Camera{scenario_.world.camera_eye, scenario_.world.camera_target};
    if (engine_) engine_->picture(touched, frame);
    if (level_) level_->picture(frame);
    if (atlas_) atlas_->picture(touched, frame);
    frame.hash = state_hash(frame);
    add_finding(frame);
    light(frame);
    return frame;
  }

  void add_finding(Frame& frame) const {
    if (counted_) {
      frame.counts.emplace_back("nodes_visited", counted_->counts.nodes_visited);
      frame.counts.emplace_back("nodes_skipped", counted_->counts.nodes_skipped);
      frame.counts.emplace_back("objects_tested", counted_->counts.objects_tested);
      frame.counts.emplace_back("hits", counted_->hits);
    }
    if (!finding_) return;
    frame.hits = finding_->hits;
    if (finding_->ray) frame.rays.push_back(*finding_->ray);
    if (finding_->view) frame.views.push_back(*finding_->view);
    if (finding_->region) frame.queries.push_back(*finding_->region);
    if (finding_->ray) return;
    for (FrameBody& body : frame.bodies)
      body.dimmed = !std::binary_search(frame.hits.begin(), frame.hits.end(), body.id);
  }

  // Bodies that the step is about, the leaves that hold them, and pairs that are new.
  void light(Frame& frame) {
    for (FrameBody& body : frame.bodies) body.lit = focus_.contains(body.id);
    if (touched_.lit.empty() && touched_.passed.empty()) light_leaves_of_focus(frame);
    if (const auto* ask = std::get_if<AskRoom>(&step_->verb))
      for (FrameNode& node : frame.nodes)
        if (node.leaf && node.bodies.empty() && node.box.size().x >= ask->width &&
            node.box.size().y >= ask->height)
          node.mark = Mark::lit;
    for (FramePair& p : frame.pairs)
      p.lit = !std::binary_search(last_pairs_.begin(), last_pairs_.end(), p.pair);
    last_pairs_.clear();
    for (const FramePair& p : frame.pairs) last_pairs_.push_back(p.pair);
  }

  // Parents stand before children, so one pass from the back hands the light up.
  void light_leaves_of_focus(Frame& frame) const {
    constexpr std::size_t kMostInFocus = 3;  // when all move, nothing stands out
    if (focus_.empty() || focus_.size() > kMostInFocus) return;
    for (std::size_t i = frame.nodes.size(); i-- > 0;) {
      FrameNode& node = frame.nodes[i];
      if (node.leaf && std::any_of(node.bodies.begin(), node.bodies.end(),
                                   [&](BodyId id) { return focus_.contains(id); }))
        node.mark = Mark::lit;
      if (node.mark != Mark::quiet && node.parent != kNone)
        frame.nodes[node.parent].mark = Mark::passed;
    }
  }

  std::string fill(const std::string& caption, const Frame& frame) const {
    const auto text = [&](std::string_view name) -> std::optional<std::string> {
      if (name == "texture") return texture_;
      if (name == "refused_names") return refused_names_.empty() ? "none" : refused_names_;
      if (name == "time") return fmt::format("{:.2f}", frame.time);
      if (const auto measured = frame.measure(name)) return fmt::format("{:.4g}", *measured);
      return std::nullopt;
    };
    return fill_caption(caption, text, [&](std::string_view name) { return frame.count(name); });
  }

  void verify(const std::vector<Expectation>& expectations, const Frame& frame) {
    for (const Expectation& expectation : expectations) {
      ++report_.expectations;
      const auto problem = unmet(expectation, frame);
      if (!problem || !reported_.insert(&expectation).second) continue;
      report_.unmet.push_back(
          diagnose(scenario_, expectation.where,
                   fmt::format("{} (frame {}, time {:.6g} s)", *problem, frame.index, frame.time)));
    }
  }

  void give(const Frame& frame) {
    if (stopped_) return;
    if (report_.frames == kMostFrames)
      throw ScenarioError(diagnose(scenario_, step_->where,
                                   fmt::format("more than {} frames", kMostFrames),
                                   "run for a shorter time, or choose fewer events"));
    ++report_.frames;
    stopped_ = !sink_(frame);
  }

  const Scenario& scenario_;
  Pace pace_;
  const std::function<bool(const Frame&)>& sink_;
  std::unique_ptr<Engine> engine_;  // if there are bodies
  std::optional<AtlasStage> atlas_;
  std::optional<LevelStage> level_;
  std::optional<Plotter> plotter_;
  DirectorReport report_;
  double time_ = 0;
  const Step* step_ = nullptr;
  std::uint32_t step_index_ = 0;
  std::string part_;
  Touched touched_;
  std::set<BodyId> focus_;  // the bodies that the step is about
  std::string texture_;     // that the frame is about
  std::string refused_names_;
  std::vector<Pair> last_pairs_;
  std::optional<Finding> finding_;  // of this step
  struct QueryNumbers {
    QueryCounts counts;
    std::size_t hits = 0;
  };
  std::optional<QueryNumbers> counted_;    // of the last ray, view or region
  std::set<const Expectation*> reported_;  // an unmet one is reported once
  bool stopped_ = false;
};

}  // namespace

DirectorReport direct(const Scenario& scenario, Pace pace, Work& work,
                      const std::function<bool(const Frame&)>& sink) {
  return Director(scenario, pace, work, sink).run();
}

}  // namespace lantern
