// The methods' limits of stability from both sides, and their laws of energy, on a damped spring.
#include <complex>
#include <numbers>

#include "measure/stress_scene.hpp"

namespace lantern::measure {
namespace {

constexpr int kOmegaDecades = 4, kOmegaPerDecade = 12;
constexpr int kZetaDecades = 6, kZetaPerDecade = 6;

struct State {
  double x = 0, v = 0;
};

// One step of 1 s.
State stepped(Integrator method, double omega, double zeta, const State& start) {
  World<2> world = stress::oscillator_world(method, omega, zeta, start.x, start.v);
  world.step(1);
  const Body<2>& body = world.bodies()[1];
  return {body.position.x, body.velocity.x};
}

// Of the matrix (a b; c d): the larger absolute value of its eigenvalues. Written so that nothing
// cancels where both are nearly 1.
double spectral_radius(double a, double b, double c, double d) {
  const double mean = (a + d) / 2, half = (a - d) / 2;
  const double square = half * half + b * c;
  if (square >= 0) return std::abs(mean) + std::sqrt(square);
  return std::sqrt(mean * mean - square);  // a conjugate pair
}

// Where |R(z)| = |1 + z + z^2/2 + z^3/6 + z^4/24| passes 1 on the way that z = lambda h takes as h
// grows, lambda being the faster of the spring's two eigenvalues. The region of stability is
// star-shaped around 0 on the left side, so the way leaves it once.
double runge_kutta_limit(double zeta) {
  const std::complex<double> way =
      zeta <= 1 ? std::complex<double>(-zeta, std::sqrt(1 - zeta * zeta)) : -1.0;
  const auto is_outside = [&](double r) {
    const auto z = r * way;
    return std::abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)))) > 1;
  };
  double inside = 1, outside = 4;
  for (int i = 0; i < 60; ++i) {
    const double middle = (inside + outside) / 2;
    (is_outside(middle) ? outside : inside) = middle;
  }
  return zeta <= 1 ? inside : inside / (zeta + std::sqrt(zeta * zeta - 1));
}

// `count` middles of cells, each a 10^(1/per_decade) wide.
std::vector<double> middles(double low, int per_decade, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(low * std::pow(10.0, (i + 0.5) / per_decade));
  return values;
}

using namespace stress;

constexpr double kRatios[] = {0, 0.01, 0.1, 0.5, 1, 2, 10, 1e3};  // damping ratios
constexpr double kFar = 1e6;                                      // an excursion that says enough

// The farthest that the mass, which starts at rest at 1, comes within the steps of 1 s.
double farthest(Integrator method, double omega_h, double zeta, int steps) {
  World<2> world = oscillator_world(method, omega_h, zeta, 1, 0);
  double far = 0;
  for (int i = 0; i < steps && far < kFar; ++i) {
    world.step(1);
    far = largest(far, std::abs(world.bodies()[1].position.x));
  }
  return far;
}

// Long enough for what grows at 1.01 times the limit to pass kFar, whatever the damping.
int long_enough(Integrator method, double zeta) {
  if (method == Integrator::velocity_verlet && zeta > 10) return 800000;
  return method == Integrator::explicit_euler && zeta < 1 ? 80000 : 20000;
}

// Explicit Euler has no limit at zeta = 0, and at 0.01 one too slow to see in a short run.
bool has_limit(Integrator method, double zeta) {
  return method != Integrator::explicit_euler || zeta > 0.05;
}

template <Integrator Method>
StressResult below_limit() {
  double worst = 0, at = 0;
  for (const double zeta : kRatios) {
    if (!has_limit(Method, zeta)) continue;
    const double far = farthest(Method, 0.99 * stability_limit(Method, zeta), zeta, 10000);
    if (far > worst) at = zeta;
    worst = largest(worst, far);
  }
  // So near to the limit what is damped critically swells for a while, by theory 36 times.
  return at_most(100, worst, "x the start", fmt::format("worst at damping ratio {}", at));
}

template <Integrator Method>
StressResult beyond_limit() {
  double least = kFar, at = 0;
  for (const double zeta : kRatios) {
    if (!has_limit(Method, zeta)) continue;
    const double far =
        farthest(Method, 1.01 * stability_limit(Method, zeta), zeta, long_enough(Method, zeta));
    if (far < least) at = zeta;
    least = std::min(least, far);
  }
  return at_least(1e4, least, "x the start", fmt::format("least at damping ratio {}", at));
}

// omega h from 0.01 to 1e4, over 1000 steps each.
template <Integrator Method>
StressResult at_every_step() {
  double worst = 0;
  std::string where;
  for (const double zeta : kRatios)
    for (double omega_h = 0.01; omega_h < 2e4; omega_h *= 10) {
      const double far = farthest(Method, omega_h, zeta, 1000);
      if (far > worst)
        where = fmt::format("worst at damping ratio {}, omega h {:g}", zeta, omega_h);
      worst = largest(worst, far);
    }
  return at_most(1 + 1e-9, worst, "x the start", where);
}

// (v^2 + omega^2 x^2) / 2
double energy_of(const World<2>& world, double omega) {
  const double x = world.bodies()[1].position.x, v = world.bodies()[1].velocity.x;
  return (v * v + omega * omega * x * x) / 2;
}

// A run of a case: how far the energy of the undamped spring after `steps` steps is from
// `law(omega h)` to the power of `steps` times the first, worst over omega h; relative.
auto keeps_law(double bound, const char* detail, Integrator method, std::vector<double> omega_hs,
               int steps, auto law) {
  return none_above(bound, "relative", detail, [=] {
    double worst = 0;
    for (const double w : omega_hs) {
      World<2> world = oscillator_world(method, w, 0, 1, 0.3 * w);
      const double before = energy_of(world, w);
      double expected = before;
      for (int i = 0; i < steps; ++i) {
        world.step(1);
        expected *= law(w * w);
      }
      worst = largest(worst, std::abs(energy_of(world, w) / expected - 1));
    }
    return worst;
  });
}

// The largest change of the undamped spring's energy over the steps, relative.
double wavering(Integrator method, double omega_h, int steps) {
  World<2> world = oscillator_world(method, omega_h, 0, 1, 0);
  const double before = energy_of(world, omega_h);
  return worst_after_steps(world, steps, 1,
                           [&] { return std::abs(energy_of(world, omega_h) / before - 1); });
}

// Over 20000 steps of each omega h: of the method's bound, as a function of omega h.
auto keeps_bound(const char* unit, const char* detail, Integrator method, auto bound) {
  return none_above(1.01, unit, detail, [=] {
    return worst_over({0.01, 0.1, 0.5},
                      [=](double w) { return wavering(method, w, 20000) / bound(w); });
  });
}

// Without damping, a million periods: nothing that a symplectic method loses may add up.
StressResult many_periods() {
  const double w = 2 * std::numbers::pi / 20;  // 20 steps a period
  return at_most(w * w / 4 * 1.01, wavering(Integrator::velocity_verlet, w, 20'000'000), "relative",
                 "1e6 periods of 20 steps");
}

StressResult map_agrees() {
  int wrong = 0;
  const StabilityMap map = make_stability_map();
  for (const StabilityMap::Panel& panel : map.panels)
    for (std::size_t row = 0; row < map.zeta.size(); ++row)
      for (std::size_t column = 0; column < map.omega_h.size(); ++column)
        wrong += grows(map.growth_at(panel, column, row)) !=
                 (map.omega_h[column] > stability_limit(panel.method, map.zeta[row]));
  return at_most(0, wrong, "cells",
                 fmt::format("of {}", map.panels.size() * map.zeta.size() * map.omega_h.size()));
}

}  // namespace

// Neither start is, or comes to, x = 0, where the spring has no direction.
double measured_growth(Integrator method, double omega_h, double zeta) {
  const State s{1, 0.125}, t{1, -0.5};
  const State p = stepped(method, omega_h, zeta, s), q = stepped(method, omega_h, zeta, t);
  // The columns of the matrix, by Cramer's rule: M s = p and M t = q.
  const double det = s.x * t.v - t.x * s.v;
  const double a = (p.x * t.v - q.x * s.v) / det, b = (q.x * s.x - p.x * t.x) / det;
  const double c = (p.v * t.v - q.v * s.v) / det, d = (q.v * s.x - p.v * t.x) / det;
  return spectral_radius(a, b, c, d);
}

double stability_limit(Integrator method, double zeta) {
  if (method == Integrator::explicit_euler)
    return zeta <= 1 ? 2 * zeta : 2 / (zeta + std::sqrt(zeta * zeta - 1));
  if (method == Integrator::semi_implicit_euler)
    return 2 / (std::sqrt(1 + zeta * zeta) + zeta);  // = 2 (sqrt(1 + zeta^2) - zeta)
  if (method == Integrator::velocity_verlet) return 2;
  if (method == Integrator::runge_kutta_4) return runge_kutta_limit(zeta);
  return std::numeric_limits<double>::infinity();  // of the implicit ones; others are not tried
}

StabilityMap make_stability_map() {
  StabilityMap map;
  map.omega_h = middles(map.omega_low, kOmegaPerDecade, kOmegaDecades * kOmegaPerDecade);
  map.zeta = middles(map.zeta_low, kZetaPerDecade, kZetaDecades * kZetaPerDecade);
  map.zeta.insert(map.zeta.begin(), 0.0);
  for (const Integrator method : stress::kIntegrators) {
    StabilityMap::Panel panel{method, {}};
    for (const double zeta : map.zeta)
      for (const double omega_h : map.omega_h)
        panel.growth.push_back(measured_growth(method, omega_h, zeta));
    map.panels.push_back(std::move(panel));
  }
  return map;
}

std::vector<StressCase> stability_cases() {
  using enum Integrator;
  constexpr const char* kGroup = "stability";
  constexpr const char* kBelow =
      "At 0.99 times its limit the spring stays bounded, at any damping.";
  constexpr const char* kBeyond = "At 1.01 times its limit the spring grows, at any damping.";
  constexpr const char* kEvery = "The spring stays bounded at any step and damping.";
  return {
      {"explicit_euler_below_limit", kGroup, kBelow, below_limit<explicit_euler>},
      {"explicit_euler_beyond_limit", kGroup, kBeyond, beyond_limit<explicit_euler>},
      {"semi_implicit_euler_below_limit", kGroup, kBelow, below_limit<semi_implicit_euler>},
      {"semi_implicit_euler_beyond_limit", kGroup, kBeyond, beyond_limit<semi_implicit_euler>},
      {"velocity_verlet_below_limit", kGroup, kBelow, below_limit<velocity_verlet>},
      {"velocity_verlet_beyond_limit", kGroup, kBeyond, beyond_limit<velocity_verlet>},
      {"runge_kutta_4_below_limit", kGroup, kBelow, below_limit<runge_kutta_4>},
      {"runge_kutta_4_beyond_limit", kGroup, kBeyond, beyond_limit<runge_kutta_4>},
      {"implicit_midpoint_any_step", kGroup, kEvery, at_every_step<implicit_midpoint>},
      {"implicit_euler_any_step", kGroup, kEvery, at_every_step<implicit_euler>},
      {"stability_map_agrees", kGroup,
       "Every cell of every method's map is on the side of its limit that theory says.",
       map_agrees},
      {"explicit_euler_energy", kGroup,
       "Each step multiplies an undamped spring's energy by 1 + (omega h)^2.",
       keeps_law(2e-13, "500 steps, omega h from 0.01 to 1", explicit_euler, {0.01, 0.1, 1}, 500,
                 [](double w2) { return 1 + w2; })},
      // The modified energy v^2 + w^2 x^2 - h w^2 x v is kept.
      {"semi_implicit_euler_energy", kGroup, "The energy of an undamped spring stays bounded.",
       keeps_bound("x bound", "20000 steps; the bound is omega h/(2 - omega h)",
                   semi_implicit_euler, [](double w) { return w / (2 - w); })},
      {"velocity_verlet_energy", kGroup,
       "The energy of an undamped spring wavers by (omega h)^2/4 at most.",
       keeps_bound("x (omega h)^2/4", "20000 steps, omega h 0.01, 0.1, 0.5", velocity_verlet,
                   [](double w) { return w * w / 4; })},
      // |R(iw)|^2 = 1 - w^6/72 + w^8/576, exactly.
      {"runge_kutta_4_energy", kGroup,
       "Each step loses (omega h)^6/72 of an undamped spring's energy.",
       keeps_law(5e-13, "200 steps, omega h from 0.01 to 2", runge_kutta_4, {0.01, 0.1, 1, 2}, 200,
                 [](double w2) { return 1 - w2 * w2 * w2 / 72 + w2 * w2 * w2 * w2 / 576; })},
      {"implicit_midpoint_energy", kGroup,
       "The energy of an undamped spring is kept to rounding, at any step.",
       keeps_law(1e-12, "1000 steps, omega h from 0.01 to 100", implicit_midpoint,
                 {0.01, 0.1, 1, 10, 100}, 1000, [](double) { return 1.0; })},
      {"implicit_euler_energy", kGroup,
       "Each step divides an undamped spring's energy by 1 + (omega h)^2.",
       keeps_law(2e-13, "500 steps, omega h from 0.01 to 1", implicit_euler, {0.01, 0.1, 1}, 500,
                 [](double w2) { return 1 / (1 + w2); })},
      {"million_periods", kGroup,
       "Over a million periods Verlet's energy wavers, but does not drift.", many_periods, true}};
}

}  // namespace lantern::measure
