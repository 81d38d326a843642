// What the verbs of bodies do: `insert`, `emit`, `remove`, `move`, `sleep`, `wake`, `force`,
// `impulse`, and `solve_by`.
#include <cmath>
#include <span>

#include "base/stop.hpp"
#include "run/script_run.hpp"

namespace lantern::run {

void carry_out(const Verb& any, Engine& engine, double time_step) {
  const auto carry = [&]<class V>(const V& verb) {
    if constexpr (V::kTraits.changes_bodies) change(verb, engine);
    if constexpr (V::kTraits.passes_time)
      for (auto n = std::llround(verb.seconds_of(time_step) / time_step); n > 0; --n) engine.step();
  };
  std::visit(carry, any);
}

void change(const Insert& insert, Engine& engine) {
  for (const std::size_t body : insert.bodies) engine.enter(body);
}
void change(const Emit& emit, Engine& engine) { engine.emit(emit.bodies, emit.every); }
void change(const Remove& remove, Engine& engine) {
  stop_if_asked();
  engine.leave(remove.bodies);
}
void change(const Move& move, Engine& engine) { engine.move(move); }
void change(const Sleep& sleep, Engine& engine) {
  for (const std::size_t body : sleep.bodies) engine.sleep(body);
}
void change(const Wake& wake, Engine& engine) { engine.wake(wake.bodies); }
void change(const ApplyForce& force, Engine& engine) { engine.apply(force); }
void change(const ApplyImpulse& impulse, Engine& engine) { engine.apply(impulse); }
void change(const SolveBy& method, Engine& engine) { engine.solve_by(method); }

// Where somebody looks on, each enters the world when the one before it is stored.
void act(const Insert& insert, ScriptRun& run) {
  const EventWatch watch = run.watch_of_insertion();
  for (const std::size_t& body : insert.bodies) {
    if (run.frames.stopped()) return;
    run.engine().enter(body);
    run.focus(body);
    run.frames.touched = {};  // the way down is each body's own
    if (watch) run.engine().store(std::span(&body, 1), watch);
  }
  if (!watch) run.engine().store(insert.bodies, {});
  run.frames.touched = {};
  run.frames.settle("insert");
}

void act(const Emit& emit, ScriptRun& run) {
  change(emit, run.engine());
  run.engine().rebuild();
  run.focus(emit.bodies.front());
  run.frames.settle("emit");
}

void act(const Remove& remove, ScriptRun& run) {
  change(remove, run.engine());
  run.engine().rebuild();
  run.frames.settle("remove");
}

void act(const Move& move, ScriptRun& run) {
  change(move, run.engine());
  run.focus(move.body);
  if (move.rebuild && run.frames.by_event())
    run.engine().follow([&](const Event& event) { run.witness(event); });
  else if (move.rebuild)
    run.engine().rebuild();
  run.frames.touched = {};
  run.frames.settle("move");
}

}  // namespace lantern::run
