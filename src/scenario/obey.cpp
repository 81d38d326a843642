#include "scenario/obey.hpp"

#include <cmath>

namespace lantern {
namespace {

struct Obey {
  Engine& engine;
  double time_step;

  void pass(double seconds) const {
    for (std::int64_t n = std::llround(seconds / time_step); n > 0; --n) engine.step();
  }
  void operator()(const auto&) const {}
  void operator()(const Insert& insert) const {
    for (const std::size_t i : insert.bodies) engine.enter(i);
  }
  void operator()(const Remove& remove) const {
    for (const std::size_t i : remove.bodies) engine.leave(i);
  }
  void operator()(const Move& move) const { engine.move(move); }
  void operator()(const Run& run) const { pass(run.seconds); }
  void operator()(const Phases&) const { pass(time_step); }
  void operator()(const ApplyForce& force) const { engine.apply(force); }
  void operator()(const ApplyImpulse& impulse) const { engine.apply(impulse); }
  void operator()(const SolveBy& method) const { engine.solve_by(method); }
  void operator()(const Sleep& sleep) const {
    for (const std::size_t i : sleep.bodies) engine.sleep(i);
  }
  void operator()(const Wake& wake) const {
    for (const std::size_t i : wake.bodies) engine.wake(i);
  }
};

}  // namespace

void obey(Engine& engine, const Verb& verb, double time_step) {
  std::visit(Obey{engine, time_step}, verb);
}

}  // namespace lantern
