// Worlds that the stress cases share, and their figures.
#pragma once

#include "geometry/not_finite.hpp"
#include "measure/stress.hpp"
#include "physics/forces.hpp"
#include "physics/world.hpp"

namespace lantern::measure::stress {

inline constexpr double kStep = 1.0 / 60;  // s
inline constexpr double kGravity = 10;     // units / s^2

inline constexpr Integrator kIntegrators[] = {
    Integrator::explicit_euler, Integrator::semi_implicit_euler, Integrator::velocity_verlet,
    Integrator::runge_kutta_4,  Integrator::implicit_midpoint,   Integrator::implicit_euler};

// The larger one; what is no number wins, and is never lost.
inline double largest(double a, double b) { return std::isnan(a) || a >= b ? a : b; }
inline double largest(std::initializer_list<double> values) {
  double most = -kInfinity;
  for (const double value : values) most = largest(most, value);
  return most;
}

// The largest that `figure` gives for any of the values, or 0.
template <class T, class Figure>
double worst_over(std::initializer_list<T> values, Figure&& figure) {
  double worst = 0;
  for (const T& value : values) worst = largest(worst, figure(value));
  return worst;
}

// A run of a case: none of the figures may be larger than the bound.
template <class... Figures>
auto none_above(double bound, const char* unit, const char* detail, Figures... figures) {
  return [=] { return at_most(bound, largest({figures()...}), unit, detail); };
}

// A run of a case: none of what each `count(tried)` looks at may be wrong; `detail` has a place for
// how many these are.
template <class... Counts>
auto none_wrong(const char* unit, const char* detail, Counts... count) {
  return [=] {
    int tried = 0;
    const int wrong = (count(tried) + ...);
    return at_most(0, wrong, unit, fmt::format(fmt::runtime(detail), tried));
  };
}

// (x, y) in either dimension.
template <int D>
Vec<D> at(double x, double y = 0) {
  Vec<D> v{0.0};
  v.x = x;
  v.y = y;
  return v;
}

template <int D>
WorldConfig<D> with_gravity() {
  return {.gravity = at<D>(0, -kGravity)};
}

// Those that there are in so many dimensions.
template <int D>
std::vector<StructureKind> broad_phases_of() {
  std::vector<StructureKind> kinds(kStructureKinds.begin(), kStructureKinds.end());
  std::erase_if(kinds, [](StructureKind kind) { return !is_possible(kind, D); });
  return kinds;
}

template <int D>
Body<D> make_body(const Shape<D>& shape, const Vec<D>& position, const char* name = "body") {
  return {.name = name, .shape = shape, .position = position};
}

template <int D>
Body<D> make_ball(const Vec<D>& position, double radius = 0.5) {
  return make_body<D>(Sphere{radius}, position, "ball");
}

template <int D>
Body<D> make_box(const Vec<D>& position) {
  return make_body<D>(OrientedBox<D>{Vec<D>(0.5)}, position, "box");  // 1 m wide
}

// A half-space below `height`.
template <int D>
Body<D> make_floor(double height = 0, double friction = 0.5) {
  Body<D> body = make_body<D>(HalfSpace<D>{at<D>(0, 1)}, at<D>(0, height), "floor");
  body.kind = BodyKind::static_body;
  body.material.friction = friction;
  return body;
}

// A point that holds springs and joints.
template <int D>
Body<D> make_anchor() {
  Body<D> body = make_ball<D>(Vec<D>(0.0), 0.1);
  body.name = "anchor";
  body.kind = BodyKind::static_body;
  return body;
}

// One body on a damped spring: x'' + 2 zeta omega x' + omega^2 x = 0. Mass 1, body 1 of the world,
// on the x axis. The spring has no rest length, so the force is linear however far the body swings;
// but it pulls nothing while x is exactly 0.
inline World<2> oscillator_world(Integrator integrator, double omega, double zeta, double x,
                                 double v) {
  World<2> world({.integrator = integrator, .contacts = ContactMethod::none, .may_sleep = false});
  const Shape<2> ball = Sphere{0.5};
  world.add({.name = "anchor", .shape = ball, .kind = BodyKind::static_body});
  world.add({.name = "mass", .shape = ball, .position = {x, 0}, .velocity = {v, 0}, .mass = 1});
  world.add_spring({.b = 1, .stiffness = omega * omega, .damping = 2 * zeta * omega});
  return world;
}

template <int D>
void run(World<D>& world, double seconds, double h = kStep) {
  for (long i = 0, n = std::lround(seconds / h); i < n; ++i) world.step(h);
}

// The largest that `figure()` is after any of the steps.
template <int D, class Figure>
double worst_after_steps(World<D>& world, int steps, double h, Figure&& figure) {
  double worst = 0;
  for (int i = 0; i < steps; ++i) {
    world.step(h);
    worst = largest(worst, figure());
  }
  return worst;
}

template <int D>
World<D> world_of(const WorldConfig<D>& config, std::initializer_list<Body<D>> bodies) {
  World<D> world(config);
  for (const Body<D>& body : bodies) world.add(body);
  return world;
}

template <int D>
double total_energy(const World<D>& world) {
  return energy<D>(world.bodies(), world.forces()).total();
}

// The largest change of the energy over the steps, relative; or only the largest gain.
template <int D>
double energy_change(World<D>& world, int steps, double h) {
  const double before = total_energy(world);
  return worst_after_steps(world, steps, h,
                           [&] { return std::abs(total_energy(world) / before - 1); });
}
template <int D>
double energy_gain(World<D>& world, int steps, double h = kStep) {
  const double before = total_energy(world);
  return worst_after_steps(world, steps, h, [&] { return total_energy(world) / before - 1; });
}

// Of the last step, units.
template <int D>
double deepest(const World<D>& world) {
  double depth = 0;
  for (const Contact<D>& contact : world.contacts())
    depth = largest(depth, contact.manifold.depth());
  return depth;
}

template <int D>
bool is_finite(const World<D>& world) {
  return std::ranges::all_of(world.bodies(), [](const Body<D>& body) {
    return geometry::is_finite<D>(body.position) && geometry::is_finite<D>(body.velocity);
  });
}

// Why the action was refused; nothing if it was not.
std::optional<std::string> refusal(auto&& action) {
  try {
    action();
  } catch (const Refused& refused) {
    return refused.what();
  }
  return std::nullopt;
}

}  // namespace lantern::measure::stress
