// Steps of every length, and numbers that overflow.
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "geometry/not_finite.hpp"
#include "measure/stress_scene.hpp"

namespace lantern::measure {
namespace {

using namespace stress;

// Two boxes at rest on the floor.
template <int D>
World<D> resting(Integrator method = Integrator::semi_implicit_euler) {
  World<D> world =
      world_of<D>({.gravity = at<D>(0, -kGravity), .integrator = method},
                  {make_floor<D>(), make_box<D>(at<D>(0, 0.5)), make_box<D>(at<D>(0, 1.5))});
  run(world, 0.1);
  return world;
}

template <int D>
int changed_by_no_time() {
  int changed = 0;
  for (const Integrator method : kIntegrators) {
    World<D> world = resting<D>(method);
    const std::uint64_t before = world.hash();
    world.step(0);
    changed += world.hash() != before;
  }
  return changed;
}

StressResult step_zero() {
  return at_most(0, changed_by_no_time<2>() + changed_by_no_time<3>(), "worlds",
                 "changed, of 12: every method, 2D and 3D");
}

template <int D>
int bad_steps_taken(int& tried) {
  int taken = 0;
  World<D> world = resting<D>();
  const std::uint64_t before = world.hash();
  for (const double h : {-1e-300, -1e-12, -1.0 / 60, -1e3, kNan, kInfinity, -kInfinity}) {
    const auto why = refusal([&] { world.step(h); });
    ++tried;
    taken += !why || why->find("time step") == std::string::npos || world.hash() != before;
  }
  return taken;
}

StressResult step_negative() {
  int tried = 0;
  const int taken = bad_steps_taken<2>(tried) + bad_steps_taken<3>(tried);
  return at_most(0, taken, "steps",
                 fmt::format("taken, of {} that are negative or no number", tried));
}

// How far what rests is from its place after steps of `h`; endless if anything is not finite. A
// step that is refused must name body and step.
template <int D>
double rest_error(Integrator method, double h, int steps) {
  World<D> world = resting<D>(method);
  const auto why = refusal([&] {
    for (int i = 0; i < steps; ++i) world.step(h);
  });
  const bool told =
      !why || (why->find("'") != std::string::npos && why->find("step") != std::string::npos);
  if (!told || !is_finite(world)) return kInfinity;
  return largest(glm::length(world.bodies()[1].position - at<D>(0, 0.5)),
                 glm::length(world.bodies()[2].position - at<D>(0, 1.5)));
}

double worst_rest_error(double h, int steps) {
  double worst = 0;
  for (const Integrator method : kIntegrators)
    worst = largest({worst, rest_error<2>(method, h, steps), rest_error<3>(method, h, steps)});
  return worst;
}

double step_tiny() { return largest(worst_rest_error(1e-12, 100), worst_rest_error(1e-9, 100)); }

// Against the way that a free fall would go in one such step.
double step_huge() {
  return worst_over({1.0, 1e3},
                    [](double h) { return worst_rest_error(h, 10) / (kGravity * h * h / 2); });
}

// The world must say who overflows and in which step, and stay as it was.
template <int D>
bool tells(World<D>& world, const char* who, double h) {
  const std::uint64_t before = world.hash();
  const std::string step = fmt::format("in step {}", world.work().steps + 1);
  const auto why = refusal([&] { world.step(h); });
  return why && why->find(who) != std::string::npos && why->find(step) != std::string::npos &&
         world.hash() == before && is_finite(world);
}

constexpr Integrator kExplicit[] = {Integrator::explicit_euler, Integrator::semi_implicit_euler,
                                    Integrator::velocity_verlet, Integrator::runge_kutta_4};
constexpr Integrator kImplicit[] = {Integrator::implicit_midpoint, Integrator::implicit_euler};

// By speed, and by force.
template <int D>
int silent_overflows(std::span<const Integrator> methods) {
  int silent = 0;
  for (const Integrator method : methods) {
    World<D> by_speed = resting<D>(method);
    Body<D> fast = make_body<D>(Sphere{0.5}, at<D>(9, 9), "fast");
    fast.velocity = at<D>(1e300);
    by_speed.add(fast);
    silent += !tells(by_speed, "'fast'", 1e10);

    World<D> by_force = resting<D>(method);
    Body<D> light = make_body<D>(Sphere{0.5}, at<D>(9, 9), "light");
    light.mass = 1e-300;
    by_force.push(by_force.add(light), at<D>(1e9), at<D>(9, 9));
    silent += !tells(by_force, "'light'", kStep);
  }
  return silent;
}

StressResult overflow_of(std::span<const Integrator> methods) {
  const int silent = silent_overflows<2>(methods) + silent_overflows<3>(methods);
  return at_most(
      0, silent, "runs",
      fmt::format("of {} that do not name body and step, or change the world", 4 * methods.size()));
}

// An explicit method far beyond its limit blows up: it ends with a refusal, never with a NaN.
double blow_up() {
  int silent = 0;
  for (const Integrator method : kExplicit) {
    World<2> world = world_of<2>(
        {.integrator = method, .contacts = ContactMethod::none},  // or it may rest on its anchor
        {make_anchor<2>(), make_body<2>(Sphere{0.5}, {2, 0}, "bob")});
    world.add_spring({.b = 1, .stiffness = 1e8});
    const auto why = refusal([&] {
      for (int i = 0; i < 2000; ++i) world.step(kStep);
    });
    silent += !why || why->find("'bob'") == std::string::npos ||
              why->find("in step") == std::string::npos || !is_finite(world);
  }
  return silent;
}

}  // namespace

std::vector<StressCase> step_cases() {
  constexpr const char* kGroup = "extreme input";
  return {
      {"step_zero", kGroup, "A step of no time changes not a bit of the world.", step_zero},
      {"step_negative", kGroup, "A negative step is refused, and the world stays as it was.",
       step_negative},
      {"step_tiny", kGroup, "What rests does so at steps of 1e-12 s.",
       none_above(1e-3, "m", "what rests has moved; h = 1e-12 and 1e-9, every method, 2D and 3D",
                  step_tiny)},
      {"step_huge", kGroup,
       "What rests does so at steps of 1000 s, or the world says who does not.",
       none_above(1e-5, "of a fall",
                  "that what rests has moved; h = 1 and 1e3, every method, 2D and 3D", step_huge)},
      {"overflow", kGroup, "A number that overflows ends the run, naming body and step.",
       [] { return overflow_of(kExplicit); }},
      {"overflow_implicit", kGroup,
       "An implicit method ends a run that overflows, naming body and step.",
       [] { return overflow_of(kImplicit); }},
      {"blow_up", kGroup, "A spring beyond its method's limit ends the run, naming body and step.",
       none_above(0, "runs", "of 4 explicit methods that do not end naming body and step",
                  blow_up)}};
}

}  // namespace lantern::measure
