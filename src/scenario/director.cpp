#include "scenario/director.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "scenario/caption.hpp"
#include "scenario/event_text.hpp"
#include "scenario/expectations.hpp"
#include "scenario/stage.hpp"

namespace lantern {
namespace {

// Frames of one run, all paces together.
constexpr std::uint32_t kMostFrames = 100'000;

class Director {
 public:
  Director(const Scenario& scenario, Pace pace, Work& work,
           const std::function<bool(const Frame&)>& sink)
      : scenario_(scenario), pace_(pace), sink_(sink), stage_(scenario, work) {}

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
  }

  bool by_event() const { return step_->pace.value_or(pace_) == Pace::event; }

  // --- the verbs ---

  void act(const Show&) { settle("show"); }

  void act(const Insert& insert) {
    for (const std::size_t body : insert.bodies) {
      if (stopped_) return;
      stage_.enter(body);
      focus_.insert(*stage_.id_of(body));
      stage_.store(body, [&](const Event& event) { witness(event); });
    }
    settle("insert");
  }

  void act(const Remove& remove) {
    for (const std::size_t body : remove.bodies) stage_.leave(body);
    stage_.rebuild();
    settle("remove");
  }

  void act(const Move& move) {
    const Body<2> body = *stage_.body(move.body);
    stage_.place(move.body, move.to.value_or(body.position), move.velocity.value_or(body.velocity));
    stage_.rebuild();
    focus_.insert(body.id);
    settle("move");
  }

  void act(const Run& run) {
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i)
      if (const Body<2>* body = stage_.body(i))
        if (body->moves() && body->velocity != Vec<2>(0.0)) focus_.insert(body->id);
    const auto ticks = static_cast<std::uint32_t>(std::llround(run.seconds / scenario_.time_step));
    for (std::uint32_t tick = 1; tick <= ticks && !stopped_; ++tick) {
      stage_.let_time_pass();
      stage_.rebuild();
      settle("run", tick == ticks);
    }
  }

  void act(const Rebuild& rebuild) {
    stage_.rebuild_as(rebuild.structure);
    settle("rebuild");
  }

  void act(const Pack& pack) {
    for (std::size_t i = 0; i < pack.textures.size() && !stopped_; ++i) {
      const TextureSpec& texture = scenario_.textures[pack.textures[i]];
      if (pack.each) touched_ = {};
      texture_ = texture.name;
      const bool last = i + 1 == pack.textures.size();
      const bool names = last && !pack.free_name.empty();
      const std::vector<std::uint32_t> before =
          names ? stage_.free_leaves() : std::vector<std::uint32_t>();
      // Who packs many for one frame looks at none of them.
      Stage::AtlasWatch watch;
      if (pack.each || by_event()) watch = [&](const AtlasEvent& e) { witness(e, texture); };
      const bool packed = stage_.pack(pack.textures[i], watch).has_value();
      if (!packed) refused_names_ += (refused_names_.empty() ? "" : ", ") + texture.name;
      if (names) stage_.name_free_leaf(pack.free_name, before);
      if (!last && !pack.each) continue;
      settle("pack", last, packed ? "" : refusal(texture));
    }
  }

  void act(const AskRoom& ask) {
    stage_.ask_room(ask.width, ask.height);
    settle("ask_room");
  }

  // --- watching the algorithms ---

  void witness(const Event& event) {
    using Kind = Event::Kind;
    if (event.kind == Kind::test) touched_.passed.insert(event.node);
    if (event.kind == Kind::store || event.kind == Kind::split || event.kind == Kind::depth_limit ||
        event.kind == Kind::no_progress)
      touched_.lit.insert(event.node);
    if (!by_event() || !wanted(event_name(event.kind))) return;
    if (event.kind == Kind::make_child && stage_.structure().children == Children::eager) return;
    Touched now = touched_;
    now.lit.clear();
    (event.kind == Kind::miss ? now.passed : now.lit).insert(event.node);
    emit(now, event_name(event.kind),
         event_text(event, stage_.label_of(event.node), name_of(event.body),
                    stage_.structure().max_depth),
         event.body);
  }

  void witness(const AtlasEvent& event, const TextureSpec& texture) {
    using Kind = AtlasEvent::Kind;
    (event.kind == Kind::cut || event.kind == Kind::store ? touched_.lit : touched_.passed)
        .insert(event.node);
    if (!by_event() || !wanted(event_name(event.kind))) return;
    Touched now{{event.node}, touched_.passed};
    emit(now, event_name(event.kind),
         event_text(event, stage_.atlas_label_of(event.node), texture.name, texture.width,
                    texture.height));
  }

  bool wanted(std::string_view event) const {
    const auto& events = step_->events;
    return events.empty() || std::find(events.begin(), events.end(), event) != events.end();
  }

  std::string name_of(BodyId id) const {
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i)
      if (stage_.id_of(i) == id) return scenario_.bodies[i].name;
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
    stage_.picture(touched, frame);
    light(frame);
    return frame;
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
  Stage stage_;
  DirectorReport report_;
  const Step* step_ = nullptr;
  std::uint32_t step_index_ = 0;
  std::string part_;
  Touched touched_;
  std::set<BodyId> focus_;  // the bodies that the step is about
  std::string texture_;     // that the frame is about
  std::string refused_names_;
  std::vector<Pair> last_pairs_;
  std::set<const Expectation*> reported_;  // an unmet one is reported once
  bool stopped_ = false;
};

}  // namespace

DirectorReport direct(const Scenario& scenario, Pace pace, Work& work,
                      const std::function<bool(const Frame&)>& sink) {
  return Director(scenario, pace, work, sink).run();
}

}  // namespace lantern
