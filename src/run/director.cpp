#include "run/director.hpp"

#include <cmath>

#include "base/stop.hpp"
#include "run/event_text.hpp"
#include "run/script_run.hpp"

namespace lantern::run {

std::uint32_t ScriptRun::ticks_in(double seconds) const {
  return static_cast<std::uint32_t>(std::llround(seconds / scenario.world.time_step));
}

std::uint32_t ScriptRun::frame_every(int of_step) const {
  return static_cast<std::uint32_t>(of_step > 0 ? of_step : scenario.world.frame_every);
}

std::vector<FrameLook> ScriptRun::let_time_pass(bool with_looks) {
  std::vector<FrameLook> looks;
  if (stage.engine) {
    if (with_looks)
      looks = engine().step_and_tell_looks();
    else
      engine().step();
    if (watch) watch->passed(engine());
  }
  stage.time += scenario.world.time_step;
  return looks;
}

DirectorReport ScriptRun::report() {
  DirectorReport report = frames.take_report();
  if (stage.engine) report.world = engine().world_work();
  return report;
}

void ScriptRun::focus(std::size_t body) { frames.focus.insert(*engine().id_of(body)); }

void ScriptRun::watch_movers() {
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i)
    if (engine().is_moving(i)) focus(i);
}

// Once nobody looks any more, the rest of an insertion goes on without words and pictures.
void ScriptRun::witness(const Event& event) {
  if (frames.stopped()) return;
  using Kind = Event::Kind;
  if (event.kind == Kind::test) frames.touched.passed.insert(event.node);
  const StructureSpec& structure = engine().structure();
  if (event.kind == Kind::make_child && structure.eager_children) return;
  if (!frames.emits(event_name(event.kind))) return;
  Touched now = frames.touched;
  (event.kind == Kind::miss ? now.passed : now.lit).insert(event.node);
  const std::string node = engine().label_of(event.node);
  const std::string text = event_text(event, structure, node, name_of(event.body));
  const bool is_child = event.kind == Kind::make_child && !node.empty();
  frames.emit(now, event_name(event.kind), text, event.body,
              is_child ? fmt::format("children[{}] =", node.back() - '1') : "");
}

EventWatch ScriptRun::watch_of_insertion() {
  if (!frames.by_event()) return {};
  const StructureTraits& traits = traits_of(engine().structure().kind);
  for (int i = 0; i <= static_cast<int>(EventKind::leave); ++i)
    if (const auto kind = static_cast<EventKind>(i);
        traits.tells_of(kind) && frames.wanted(event_name(kind)))
      return [this](const Event& event) { witness(event); };
  return {};
}

std::string ScriptRun::name_of(BodyId id) const {
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i)
    if (stage.engine->id_of(i) == id) return scenario.bodies[i].called();
  return {};
}

namespace {

// A verb that has no frames of its own is one change, shown when it is done.
template <class V>
void carry(const V& verb, ScriptRun& run) {
  if constexpr (requires { act(verb, run); }) {
    act(verb, run);
  } else {
    if constexpr (V::kTraits.changes_bodies) run.engine().apply(verb);
    if constexpr (requires { verb.body; }) run.focus(verb.body);
    run.frames.settle(V::kTraits.name);
  }
}

}  // namespace

void ScriptRun::play(const Scenario& as, std::size_t index) {
  const Step& step = as.steps[index];
  stop_if_asked();
  frames.begin(step, static_cast<std::uint32_t>(index));
  if (watch) watch->begin(step);
  if (stage.engine) engine().forget_events();
  if (const VerbTraits& verb = traits_of(step.verb);
      stage.level && (verb.changes_bodies || verb.passes_time))
    stage.level->put_away_answers();
  try {
    std::visit([&](const auto& verb) { carry(verb, *this); }, step.verb);
  } catch (const Refused& refused) {
    throw ScenarioError(diagnose(scenario, step.where, refused.what()));
  } catch (const StructureFault& broken) {
    const auto name_of = [this](BodyId id) { return engine().name_of(id); };
    throw BrokenStructure(diagnose(scenario, step.where, text_of(broken.fault(), name_of)));
  }
}

std::unique_ptr<Performance> perform(const Scenario& scenario, Pace pace, Work& work,
                                     const std::function<bool(const Frame&)>& sink, RunWatch* watch,
                                     Wanted wants) {
  if (!scenario.sides.empty()) return perform_sides(scenario, pace, work, sink, watch);
  return std::make_unique<ScriptRun>(scenario, pace, work, sink, watch, wants);
}

DirectorReport direct(const Scenario& scenario, Pace pace, Work& work,
                      const std::function<bool(const Frame&)>& sink, RunWatch* watch,
                      Wanted wants) {
  const auto performance = perform(scenario, pace, work, sink, watch, wants);
  for (std::size_t i = 0; i < scenario.steps.size() && !performance->stopped(); ++i)
    performance->play(scenario, i);
  return performance->report();
}

}  // namespace lantern::run
