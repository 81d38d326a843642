// When two bodies meet.

#include <algorithm>
#include <cmath>

#include "physics/free_rotation.hpp"
#include "physics/impacts.hpp"

namespace lantern::physics {
namespace {

template <int D>
struct Gap {
  double gap = 0;
  double closing = 0;  // the fastest of the points that touch, by the points' own velocities
  double bound = 0;    // the surfaces cannot close faster, whatever turns
};

template <int D>
class Approach {
 public:
  Approach(const Trajectory<D>& a, const Trajectory<D>& b, double within, double slow, double reach,
           std::uint64_t& narrow_tests)
      : a_(a), b_(b), within_(within), reach_(reach), narrow_tests_(narrow_tests) {
    turn_a_ = turning(a);
    turn_b_ = turning(b);
    const double spin = spin_of(a) + spin_of(b);
    bend_ = 2 * glm::length(b.bend - a.bend) + spin * (turn_a_ + turn_b_);
    slow_ = slow;
    size_ = glm::length(a.body->position) + glm::length(b.body->position);
    for (const Trajectory<D>* path : {&a, &b})
      if (const double t = thickness<D>(path->body->shape); t < kEndless) size_ += t;
  }

  std::optional<TimeOfImpact> find() const {
    double t = 0;
    for (int i = 0; i < kImpactSettings.most_advances; ++i) {
      const auto seen = gap_at(t);
      if (!seen) return std::nullopt;
      double next = t;
      if (seen->gap <= size_ * kImpactSettings.touches) {
        if (seen->closing > slow_) return TimeOfImpact{t, false};
        if (seen->closing > -slow_) {
          // They glide along each other, unless something presses them.
          if (bend_ == 0 && a_.held + b_.held == 0) return std::nullopt;
          return TimeOfImpact{t, true};
        }
        // They part, and cannot be back before this.
        if (bend_ == 0) return std::nullopt;
        next = t + (turn_a_ + turn_b_ > 0 ? 1 : 2) * -seen->closing / bend_;
      } else {
        const double root = std::sqrt(seen->bound * seen->bound + 2 * bend_ * seen->gap);
        if (!(seen->bound + root > 0)) return std::nullopt;
        next = t + 2 * seen->gap / (seen->bound + root);
      }
      if (!(next < within_)) return std::nullopt;
      // No nearer in numbers, or so slowly that it is as good as there.
      if (next == t ||
          (i > kImpactSettings.most_advances / 2 && seen->gap < size_ * kImpactSettings.near))
        return seen->closing > slow_    ? std::optional(TimeOfImpact{t, false})
               : seen->closing > -slow_ ? std::optional(TimeOfImpact{t, true})
                                        : std::nullopt;
      t = next;
    }
    return std::nullopt;
  }

 private:
  double turning(const Trajectory<D>& path) const {
    return spin_of(path) * turning_reach<D>(path.body->shape);
  }
  double spin_of(const Trajectory<D>& path) const {
    if (turning_reach<D>(path.body->shape) == 0 || !path.body->moves()) return 0;
    const Spin<D> spin = angular_velocity(*path.body);
    return std::sqrt(dot(spin, spin));
  }
  Body<D> placed_at(const Trajectory<D>& path, double t) const {
    Body<D> body = *path.body;
    body.position += t * (path.velocity + t * path.bend);
    body.velocity = path.velocity + 2 * t * path.bend;
    turn_freely(body, t, path.rotation);
    return body;
  }

  std::optional<Gap<D>> gap_at(double t) const {
    const Body<D> a = placed_at(a_, t), b = placed_at(b_, t);
    ++narrow_tests_;
    const auto manifold = collide(placed(a), placed(b), reach_);
    if (!manifold) return std::nullopt;
    Gap<D> seen;
    seen.gap = manifold->room[0].separation;
    for (const ManifoldPoint<D>& p : manifold->points())
      seen.gap = std::min(seen.gap, p.separation);
    seen.bound = -glm::dot(b.velocity - a.velocity, manifold->normal) + turn_a_ + turn_b_;
    seen.closing = -seen.bound - 1;
    bool first = true;
    for (const ManifoldPoint<D>& p : manifold->points()) {
      if (p.separation > seen.gap + size_ * kImpactSettings.near) continue;
      const Vec<D> va = turn_a_ > 0 ? velocity_at(a, p.position - a.position) : a.velocity;
      const Vec<D> vb = turn_b_ > 0 ? velocity_at(b, p.position - b.position) : b.velocity;
      const double closing = -glm::dot(vb - va, manifold->normal);
      if (first || closing > seen.closing) seen.closing = closing;
      first = false;
    }
    return seen;
  }

  const Trajectory<D>& a_;
  const Trajectory<D>& b_;
  double within_, reach_;
  std::uint64_t& narrow_tests_;
  double turn_a_ = 0, turn_b_ = 0;  // how fast surfaces can move by turning
  double bend_ = 0;                 // the gap's second derivative is at least minus this
  double slow_ = 0;
  double size_ = 0;
};

}  // namespace

template <int D>
std::optional<TimeOfImpact> time_of_impact(const Trajectory<D>& a, const Trajectory<D>& b,
                                           double within, double slow, double reach,
                                           std::uint64_t& narrow_tests) {
  return Approach<D>(a, b, within, slow, reach, narrow_tests).find();
}

template <int D>
double slowest_impact(const Trajectory<D>& a, const Trajectory<D>& b, double step) {
  const double pull = 2 * glm::length(b.bend - a.bend) + a.held + b.held;
  return std::max(
      pull * step * kImpactSettings.shortest_bounce,
      kImpactSettings.speed_by_rounding * (glm::length(a.velocity) + glm::length(b.velocity)));
}

#define LANTERN_INSTANTIATE(D)                                                                    \
  template std::optional<TimeOfImpact> time_of_impact(const Trajectory<D>&, const Trajectory<D>&, \
                                                      double, double, double, std::uint64_t&);    \
  template double slowest_impact(const Trajectory<D>&, const Trajectory<D>&, double);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
