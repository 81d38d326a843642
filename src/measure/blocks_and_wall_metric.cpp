// A heavy block pushes a light one against a wall; all bounces are elastic. How often do they hit?
// Galperin, "Playing Pool with pi", 2003: with the places scaled by the roots of the masses the two
// blocks are one point in a wedge, and each hit is a reflection. Unfolded, its way is a straight
// line that crosses one ray for each hit.
//
//   y = sqrt(m) q       | . way            q: gap from the wall to the light block
//                    \  |.  /              Q: gap from the wall to the heavy one, less the light
//                     \ .| /                  one's width
//                      \|/__ theta         tan theta = sqrt(m / M)
//   x = sqrt(M) Q
//
// For M = 100^k m it crosses floor(pi 10^k) rays in all.
#include <numbers>

#include "measure/error_metrics.hpp"
#include "measure/problem_scene.hpp"

namespace lantern {
namespace {

using Real = long double;

struct Point {
  Real x = 0, y = 0;
};
Real turning(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
Real dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }

class BlocksAndWall : public ErrorMetric {
 public:
  explicit BlocksAndWall(const Scenario& scenario) : wall_(ground_of(scenario)) {
    require_links(scenario, 0);
    if (scenario.world.gravity != Vec<3>(0.0)) refuse_problem(scenario, "there is gravity");
    const auto moving = moving_bodies(scenario);
    if (moving.size() != 2) refuse_problem(scenario, "it needs two blocks");
    inner_ = moving[0];
    outer_ = moving[1];
    const auto height = [&](std::size_t i) {
      return glm::dot(scenario.bodies[i].position, wall_.normal) - wall_.height;
    };
    if (height(inner_) > height(outer_)) std::swap(inner_, outer_);
    const BodySpec& inner = scenario.bodies[inner_];
    const BodySpec& outer = scenario.bodies[outer_];
    if (!are_parallel(outer.position - inner.position, wall_.normal) ||
        !are_parallel(inner.velocity, wall_.normal) || !are_parallel(outer.velocity, wall_.normal))
      refuse_problem(scenario, "the blocks do not move on one line towards the wall");
    if (restitution_between(scenario, inner_, outer_) != 1 ||
        restitution_between(scenario, inner_, wall_.body) != 1)
      refuse_problem(scenario, "a bounce is not elastic (restitution = 1)");
    root_inner_ = std::sqrt(static_cast<Real>(mass_of_body(scenario, inner_)));
    root_outer_ = std::sqrt(static_cast<Real>(mass_of_body(scenario, outer_)));
    const Real half = reach_along(inner, wall_.normal);
    start_.y = root_inner_ * (height(inner_) - half);
    start_.x = root_outer_ * (height(outer_) - 2 * half - reach_along(outer, wall_.normal));
    speed_ = scaled(inner.velocity, outer.velocity);
    theta_ = std::atan2(root_inner_, root_outer_);
    if (start_.y < 0 || turning(start_, {root_outer_, root_inner_}) < 0)
      refuse_problem(scenario, "the blocks begin in each other");
    if (inner.velocity != Vec<3>(0.0) || !(speed_.x < 0))
      refuse_problem(scenario, "not the outer block alone moves, towards the wall");
  }

  void look(const Observation& now) override {
    const Real t = now.time;
    const Point place{start_.x + speed_.x * t, start_.y + speed_.y * t};
    const Real angle =
        std::atan2(start_.y, start_.x) + std::atan2(turning(start_, place), dot(start_, place));
    const Point found = scaled(now.states[inner_].velocity, now.states[outer_].velocity);
    measure_hits(angle / theta_, found, now.impacts);
    measure_speeds(std::floor(angle / theta_), found);
    const Real energy = dot(speed_, speed_);
    energy_.meet(static_cast<double>((dot(found, found) - energy) / energy));
  }

  std::vector<Norm> norms() const override {
    return {{"hits", hits_, "hits", "how many too many or too few there were by the end"},
            {"v", speed_error_, "1",
             "error of both velocities at the end, weighted by the roots of the masses, relative"},
            {"E", energy_.value(), "1", kEnergyMeaning}};
  }

 private:
  Point scaled(const Vec<3>& inner, const Vec<3>& outer) const {
    return {root_outer_ * static_cast<Real>(glm::dot(outer, wall_.normal)),
            root_inner_ * static_cast<Real>(glm::dot(inner, wall_.normal))};
  }

  // Who does not count its hits is asked how far they have turned the velocities. These begin at
  // the angle pi; after n hits they are at pi - n theta, or, while the light block goes towards the
  // wall, at -(pi - (n + 1) theta).
  Real hits_by(const Point& found) const {
    const Real angle = std::atan2(found.y, found.x);
    const Real left = std::abs(angle);
    return std::round((std::numbers::pi_v<Real> - left) / theta_) - (angle < 0 ? 1 : 0);
  }

  void measure_hits(Real rays, const Point& found, std::uint64_t told) {
    const Real hits = told > 0 ? static_cast<Real>(told) : hits_by(found);
    // A look at the very moment of a hit may see it or not.
    constexpr Real kNearHit = 0.02L;
    const Real some = std::abs(std::floor(rays - kNearHit));
    const Real more = std::abs(std::floor(rays + kNearHit));
    hits_ = static_cast<double>(std::min(std::abs(hits - some), std::abs(hits - more)));
    if (!std::isfinite(static_cast<double>(dot(found, found)))) hits_ = std::nan("");
  }

  void measure_speeds(Real cell, const Point& found) {
    const Real size = std::sqrt(dot(speed_, speed_));
    const Real from = std::numbers::pi_v<Real>;
    const bool mirrored = std::fmod(cell, 2.0L) != 0;
    const Real angle = mirrored ? (cell + 1) * theta_ - from : from - cell * theta_;
    const Point exact{size * std::cos(angle), size * std::sin(angle)};
    const Point off{found.x - exact.x, found.y - exact.y};
    speed_error_ = static_cast<double>(std::sqrt(dot(off, off)) / size);
  }

  Footing wall_;
  std::size_t inner_ = 0, outer_ = 0;
  Real root_inner_ = 0, root_outer_ = 0, theta_ = 0;
  Point start_, speed_;
  double hits_ = 0, speed_error_ = 0;
  Worst energy_;
};

}  // namespace

std::unique_ptr<ErrorMetric> blocks_and_wall_metric(const Scenario& scenario) {
  return std::make_unique<BlocksAndWall>(scenario);
}

}  // namespace lantern
