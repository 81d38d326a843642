// What the verbs of bodies do: `insert`, `emit`, `remove`, `move`, `sleep`, `wake`, `force`,
// `impulse`, and `solve_by`.
#include <cmath>
#include <span>

#include "run/script_run.hpp"

namespace lantern::run {

void carry_out(const Verb& any, Engine& engine, double time_step) {
  const auto carry = [&]<class V>(const V& verb) {
    if constexpr (V::kTraits.changes_bodies) engine.apply(verb);
    if constexpr (V::kTraits.passes_time)
      for (auto n = std::llround(verb.seconds_of(time_step) / time_step); n > 0; --n) engine.step();
  };
  std::visit(carry, any);
}

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
  run.engine().apply(emit);
  run.engine().rebuild();
  run.focus(emit.bodies.front());
  run.frames.settle("emit");
}

void act(const Remove& remove, ScriptRun& run) {
  run.engine().apply(remove);
  run.engine().rebuild();
  run.frames.settle("remove");
}

void act(const Move& move, ScriptRun& run) {
  run.engine().apply(move);
  run.focus(move.body);
  if (move.rebuild && run.frames.by_event())
    run.engine().follow([&](const Event& event) { run.witness(event); });
  else if (move.rebuild)
    run.engine().rebuild();
  run.frames.touched = {};
  run.frames.settle("move");
}

}  // namespace lantern::run
