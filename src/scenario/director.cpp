#include "scenario/director.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/stop.hpp"
#include "scenario/event_text.hpp"
#include "scenario/frame_maker.hpp"
#include "scenario/stage.hpp"
#include "scenario/warnings.hpp"

namespace lantern {
namespace {

class Director {
 public:
  Director(const Scenario& scenario, Pace pace, Work& work,
           const std::function<bool(const Frame&)>& sink, RunWatch* watch)
      : scenario_(scenario),
        stage_(scenario, work),
        frames_(scenario, pace, stage_, sink),
        watch_(watch) {}

  DirectorReport run() {
    std::uint32_t index = 0;
    for (const Step& step : scenario_.steps) {
      stop_if_asked();
      frames_.begin(step, index++);
      if (watch_) watch_->begin(step);
      if (stage_.engine) stage_.engine->forget_events();
      try {
        std::visit([&](const auto& verb) { act(verb); }, step.verb);
      } catch (const Refused& refused) {
        throw ScenarioError(diagnose(scenario_, step.where, refused.what()));
      }
      if (frames_.stopped()) break;
    }
    DirectorReport report = frames_.take_report();
    if (stage_.engine) report.world = stage_.engine->world_work();
    return report;
  }

 private:
  // --- the verbs ---

  void act(const Show&) { frames_.settle("show"); }

  void act(const Insert& insert) {
    for (const std::size_t body : insert.bodies) {
      if (frames_.stopped()) return;
      stage_.engine->enter(body);
      frames_.focus.insert(*stage_.engine->id_of(body));
      stage_.engine->store(body, [&](const Event& event) { witness(event); });
    }
    frames_.settle("insert");
  }

  void act(const Remove& remove) {
    for (const std::size_t body : remove.bodies) {
      stop_if_asked();
      stage_.engine->leave(body);
    }
    stage_.engine->rebuild();
    frames_.settle("remove");
  }

  void act(const Move& move) {
    stage_.engine->move(move);
    if (move.rebuild) stage_.engine->rebuild();
    frames_.focus.insert(*stage_.engine->id_of(move.body));
    frames_.settle("move");
  }

  void act(const ApplyForce& force) {
    stage_.engine->apply(force);
    frames_.focus.insert(*stage_.engine->id_of(force.body));
    frames_.settle("force");
  }

  void act(const ApplyImpulse& impulse) {
    stage_.engine->apply(impulse);
    frames_.focus.insert(*stage_.engine->id_of(impulse.body));
    frames_.settle("impulse");
  }

  void act(const Sleep& sleep) {
    for (const std::size_t body : sleep.bodies) stage_.engine->sleep(body);
    frames_.settle("sleep");
  }

  void act(const Wake& wake) {
    for (const std::size_t body : wake.bodies) stage_.engine->wake(body);
    frames_.settle("wake");
  }

  void act(const SolveBy& method) {
    stage_.engine->solve_by(method);
    frames_.settle("solve_by");
  }

  void act(const Run& run) {
    if (stage_.engine) watch_movers();
    const std::uint32_t ticks = ticks_in(run.seconds);
    for (std::uint32_t tick = 1; tick <= ticks && !frames_.stopped(); ++tick) {
      let_time_pass();
      if (tick % frame_every(run.every) == 0 || tick == ticks) frames_.settle("run", tick == ticks);
    }
  }

  // Runs until the event, which must happen in time.
  void act(const Wait& wait) {
    watch_movers();
    const std::uint32_t ticks = ticks_in(wait.at_most);
    for (std::uint32_t tick = 1; tick <= ticks && !frames_.stopped(); ++tick) {
      let_time_pass();
      if (stage_.engine->has_happened(wait.event, wait.bodies)) return frames_.settle("wait");
      if (tick == ticks)
        frames_.fail(
            fmt::format("what this step waits for has not happened within {} s", wait.at_most));
      if (tick % frame_every(wait.every) == 0 || tick == ticks)
        frames_.settle("wait", tick == ticks);
    }
  }

  // The state before the step, with what each phase of it finds, then the state after it.
  void act(const Phases&) {
    const Frame before = frames_.picture(frames_.touched, "broad_phase");
    const auto show = [&](std::string_view event, const Frame& frame) {
      if (!frames_.wanted(event)) return;
      Frame shown = frame;
      shown.event = event;
      shown.caption = phase_text(event, shown);
      frames_.give(shown);
    };
    show("broad_phase", before);
    let_time_pass();
    const Frame after = frames_.picture(frames_.touched, "integrate");
    const Frame meeting = met(before, after);
    Frame narrow = meeting;
    for (FrameContact& contact : narrow.contacts)
      for (FrameContact::Point& point : contact.points) point.impulse = 0;
    for (auto& [name, number] : narrow.counts)
      if (name == "impulses") number = 0;
    show("narrow_phase", narrow);
    show("solve", meeting);
    frames_.settle("integrate");
  }

  void act(const Rebuild& rebuild) {
    stage_.engine->rebuild_as(rebuild.structure);
    frames_.settle("rebuild");
  }

  // Bodies and structure as they were before the step, contacts as it found them.
  static Frame met(const Frame& before, const Frame& after) {
    static constexpr std::string_view kOfTheStep[] = {
        "contacts",      "contact_points",    "impulses",     "begins",
        "ends",          "pairs_tested",      "narrow_tests", "constraint_rows",
        "friction_rows", "force_evaluations", "rotations"};
    Frame frame = before;
    frame.contacts = after.contacts;
    for (auto& [name, number] : frame.counts)
      if (std::ranges::find(kOfTheStep, name) != std::end(kOfTheStep))
        number = after.count(name).value_or(number);
    for (auto& [name, number] : frame.measures)
      if (name == "penetration") number = after.measure(name).value_or(number);
    return frame;
  }

  // --- questions that the structure answers ---

  void act(const CastRay& ray) { answer(stage_.engine->ask(ray), "ray"); }
  void act(const Cull& view) { answer(stage_.engine->ask(view), "cull"); }
  void act(const Query& region) { answer(stage_.engine->ask(region), "query"); }

  void answer(Finding finding, std::string_view verb) {
    const std::vector<QueryEvent> walk = finding.walk;
    frames_.show_finding(std::move(finding));
    if (frames_.by_event()) replay(walk);
    for (const QueryEvent& event : walk)
      if (event.kind == QueryEvent::Kind::visit) frames_.touched.lit.insert(event.node);
    frames_.settle(verb);
  }

  // One frame for each thing that the walk did.
  void replay(const std::vector<QueryEvent>& walk) {
    using Kind = QueryEvent::Kind;
    for (std::size_t i = 0; i < walk.size() && !frames_.stopped(); ++i) {
      const QueryEvent& event = walk[i];
      if (event.kind == Kind::hit) continue;  // told with its test
      const bool hit = i + 1 < walk.size() && walk[i + 1].kind == Kind::hit;
      const bool is_test = event.kind == Kind::test;
      const std::string_view name =
          is_test ? (hit ? "hit" : "miss") : (event.kind == Kind::visit ? "visit" : "skip");
      if (event.kind == Kind::visit) frames_.touched.passed.insert(event.node);
      if (!frames_.wanted(name)) continue;
      Touched now{{}, frames_.touched.passed};
      if (event.kind != Kind::skip) now.lit.insert(event.node);
      frames_.emit(now, name,
                   query_text(name, stage_.engine->label_of(event.node), name_of(event.body)),
                   is_test ? std::optional(event.body) : std::nullopt);
    }
  }

  // --- levels ---

  void act(const CompileLevel&) {
    stage_.level->compile([&](const LevelMoment& moment) {
      if (!frames_.stopped() && frames_.by_event() && frames_.wanted(moment.event))
        frames_.emit({}, moment.event, moment.text);
    });
    frames_.settle("compile");
  }

  void act(const Locate& locate) {
    stage_.level->locate(locate.point);
    frames_.settle("locate");
  }

  void act(const OrderFrom& order) {
    stage_.level->order_from(order.eye);
    frames_.settle("order");
  }

  // --- the atlas ---

  void act(const Pack& pack) {
    for (std::size_t i = 0; i < pack.textures.size() && !frames_.stopped(); ++i) {
      const TextureSpec& texture = scenario_.textures[pack.textures[i]];
      if (pack.each) frames_.touched = {};
      frames_.texture = texture.name;
      const bool last = i + 1 == pack.textures.size();
      const bool names = last && !pack.free_name.empty();
      const std::vector<std::uint32_t> before =
          names ? stage_.atlas->free_leaves() : std::vector<std::uint32_t>();
      // Who packs many for one frame looks at none of them.
      AtlasStage::Watch watch;
      if (pack.each || frames_.by_event())
        watch = [&](const AtlasEvent& e) { witness(e, texture); };
      const bool packed = stage_.atlas->pack(pack.textures[i], watch).has_value();
      if (!packed) frames_.note_refused(texture.name);
      if (names) stage_.atlas->name_free_leaf(pack.free_name, before);
      if (!last && !pack.each) continue;
      frames_.settle("pack", last, packed ? "" : refusal(texture));
    }
  }

  void act(const AskRoom& ask) {
    stage_.atlas->ask_room(ask.width, ask.height);
    frames_.settle("ask_room");
  }

  // --- time ---

  std::uint32_t ticks_in(double seconds) const {
    return static_cast<std::uint32_t>(std::llround(seconds / scenario_.world.time_step));
  }

  std::uint32_t frame_every(int of_step) const {
    return static_cast<std::uint32_t>(of_step > 0 ? of_step : scenario_.world.frame_every);
  }

  void let_time_pass() {
    if (stage_.engine) {
      stage_.engine->step();
      if (watch_) watch_->passed(*stage_.engine);
      stage_.engine->rebuild();
    }
    stage_.time += scenario_.world.time_step;
  }

  void watch_movers() {
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i)
      if (stage_.engine->is_moving(i)) frames_.focus.insert(*stage_.engine->id_of(i));
  }

  // --- watching the algorithms ---

  // Once nobody looks any more, the rest of an insertion goes on without words and pictures.
  void witness(const Event& event) {
    if (frames_.stopped()) return;
    using Kind = Event::Kind;
    if (event.kind == Kind::test) frames_.touched.passed.insert(event.node);
    if (event.kind == Kind::store || event.kind == Kind::split || event.kind == Kind::depth_limit ||
        event.kind == Kind::no_progress)
      frames_.touched.lit.insert(event.node);
    if (!frames_.by_event() || !frames_.wanted(event_name(event.kind))) return;
    if (event.kind == Kind::make_child && stage_.engine->structure().children == Children::eager)
      return;
    Touched now = frames_.touched;
    now.lit.clear();
    (event.kind == Kind::miss ? now.passed : now.lit).insert(event.node);
    frames_.emit(now, event_name(event.kind),
                 event_text(event, stage_.engine->label_of(event.node), name_of(event.body),
                            stage_.engine->structure().max_depth),
                 event.body);
  }

  void witness(const AtlasEvent& event, const TextureSpec& texture) {
    if (frames_.stopped()) return;
    using Kind = AtlasEvent::Kind;
    (event.kind == Kind::cut || event.kind == Kind::store ? frames_.touched.lit
                                                          : frames_.touched.passed)
        .insert(event.node);
    if (!frames_.by_event() || !frames_.wanted(event_name(event.kind))) return;
    Touched now{{event.node}, frames_.touched.passed};
    frames_.emit(now, event_name(event.kind),
                 event_text(event, stage_.atlas->label_of(event.node), texture.name, texture.width,
                            texture.height));
  }

  std::string name_of(BodyId id) const {
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i)
      if (stage_.engine->id_of(i) == id) return scenario_.bodies[i].name;
    return {};
  }

  static std::string refusal(const TextureSpec& t) {
    return fmt::format("No leaf has room for {} ({} × {}): it is refused, the rest is kept.",
                       t.name, t.width, t.height);
  }

  const Scenario& scenario_;
  Stage stage_;
  FrameMaker frames_;
  RunWatch* watch_;
};

}  // namespace

DirectorReport direct(const Scenario& scenario, Pace pace, Work& work,
                      const std::function<bool(const Frame&)>& sink, RunWatch* watch) {
  if (!watch) return Director(scenario, pace, work, sink, nullptr).run();
  const std::function<bool(const Frame&)> both = [&](const Frame& frame) {
    watch->see(frame);
    return sink(frame);
  };
  return Director(scenario, pace, work, both, watch).run();
}

}  // namespace lantern
