// An integrator of one's own, in one file: half a flight, a kick by the forces there, half a
// flight. Scenarios of a program that adds it may say integrator = "position_verlet".
#include <cmath>
#include <cstdio>
#include <span>

#include <lantern/physics/integrate/smooth_system.hpp>
#include <lantern/physics/world.hpp>

using namespace lantern::physics;

namespace {

//! [integrator]
template <int D>
void position_verlet(SmoothSystem<D>& system, double h, std::span<Increment<D>> out) {
  SmoothState<D> middle = system.start();
  system.fly(middle, middle, h / 2);
  const Pull<D> pull = system.evaluate(middle);
  for (const std::size_t i : system.movers()) {
    out[i].kick = h * pull.acceleration[i];
    out[i].drift = -h / 2 * out[i].kick;  // half of the way is flown before the kick
    out[i].twist = h * pull.torque[i];
    out[i].lag = -out[i].twist / 2.0;
  }
}

const Integration kPositionVerlet = {.name = "position_verlet",
                                     .order = 2,
                                     .lag = 0.5,
                                     .increments = {position_verlet<2>, position_verlet<3>}};
//! [integrator]

// Where a weight on a spring, let go at 1, is after one second, against cos(omega t).
double error_of(Integrator method, int steps) {
  constexpr double kOmega = 3;
  World<2> world({.integrator = method, .contacts = ContactMethod::none, .may_sleep = false});
  Body<2> anchor{.shape = Sphere{0.1}, .kind = BodyKind::static_body};
  Body<2> weight{.shape = Sphere{0.1}, .position = {1, 0}, .mass = 1};
  const BodyId ends[] = {world.add(anchor), world.add(weight)};
  world.add_spring({.a = ends[0], .b = ends[1], .stiffness = kOmega * kOmega});
  for (int i = 0; i < steps; ++i) world.step(1.0 / steps);
  return std::abs(world.find(ends[1])->position.x - std::cos(kOmega));
}

}  // namespace

int main() {
  const Integrator mine = add_integrator(kPositionVerlet);
  if (integrator_named("position_verlet") != mine) return 1;
  const double order = std::log2(error_of(mine, 100) / error_of(mine, 200));
  std::printf("half the step: the error falls by 2 to the power of %.3f\n", order);
  return std::abs(order - integration(mine).order) < 0.1 ? 0 : 1;
}
