#include "measure/stability_map.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <limits>

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
  switch (method) {
    case Integrator::explicit_euler:
      return zeta <= 1 ? 2 * zeta : 2 / (zeta + std::sqrt(zeta * zeta - 1));
    case Integrator::semi_implicit_euler:
      return 2 / (std::sqrt(1 + zeta * zeta) + zeta);  // = 2 (sqrt(1 + zeta^2) - zeta)
    case Integrator::velocity_verlet:
      return 2;
    case Integrator::runge_kutta_4:
      return runge_kutta_limit(zeta);
    case Integrator::implicit_midpoint:
    case Integrator::implicit_euler:
      break;
  }
  return std::numeric_limits<double>::infinity();
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

}  // namespace lantern::measure
