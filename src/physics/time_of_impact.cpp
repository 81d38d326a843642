// When two bodies meet.

#include <algorithm>
#include <cmath>

#include "physics/free_rotation.hpp"
#include "physics/impacts.hpp"
#include "physics/sure_advance.hpp"

namespace lantern::physics {
namespace {

// Acceleration of what turns, against spin^2 radius: a spin that wanders has more. I w' = L x w,
// and no inertia is larger than the other two together, so |w'| <= w^2 / sqrt(3).
template <int D>
constexpr double kWandering = D == 2 ? 1 : 1.58;

template <int D>
struct Gap {
  double gap = 0;
  double closing = 0;  // the fastest of the points that touch, by the points' own velocities
  double bound = 0;    // the surfaces cannot close faster, whatever turns
  Vec<D> normal{0.0};
};

template <int D>
class Approach {
 public:
  Approach(const Trajectory<D>& a, const Trajectory<D>& b, double within, double slow, double reach,
           WorldWork& work, std::vector<ImpactLook<D>>* looks, double begun)
      : a_(a), b_(b), within_(within), reach_(reach), work_(work), looks_(looks), begun_(begun) {
    fastest_a_ = spin_of(a);
    fastest_b_ = spin_of(b);
    turn_a_ = fastest_a_ * turning_reach<D>(a.body->shape);
    turn_b_ = fastest_b_ * turning_reach<D>(b.body->shape);
    bend_ = 2 * glm::length(b.bend - a.bend) + (fastest_a_ + fastest_b_) * (turn_a_ + turn_b_);
    slow_ = slow;
    turns_ = turn_a_ + turn_b_ > 0;
    near_ = kImpactSettings.near * thinner(*a.body, *b.body);
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
        next = t + (turns_ ? sure(t, *seen) : 2 * -seen->closing / bend_);
      } else {
        const double root = std::sqrt(seen->bound * seen->bound + 2 * bend_ * seen->gap);
        if (!(seen->bound + root > 0)) return std::nullopt;
        next = t + 2 * seen->gap / (seen->bound + root);
        if (turns_ && next < within_) next = std::max(next, t + sure(t, *seen));
        tell_free_until(next);
        if (const auto met = bracketed(t, *seen, next)) return met;
      }
      if (!(next < within_)) return std::nullopt;
      // No nearer in numbers, or so slowly that it is as good as there.
      if (next == t || (i > kImpactSettings.most_advances / 2 && seen->gap < near_))
        return at(t, *seen);
      t = next;
    }
    // They turn so fast that no sure advance comes to an end: a contact, from here on.
    return turns_ ? std::optional(TimeOfImpact{t, true}) : std::nullopt;
  }

 private:
  double spin_of(const Trajectory<D>& path) const {
    if (turning_reach<D>(path.body->shape) == 0 || !path.body->moves()) return 0;
    return fastest_spin(*path.body);
  }
  double sure(double t, const Gap<D>& seen) const {
    return sure_advance(flying(a_, t, fastest_a_), flying(b_, t, fastest_b_), seen.normal,
                        std::max(-seen.gap, 0.0) + near_, within_ - t);
  }
  Flying<D> flying(const Trajectory<D>& path, double t, double fastest) const {
    const Body<D> now = placed_at(path, t);
    Flying<D> body{now.shape, now.position};
    if (turns<D>(now.shape)) body.axes = matrix(now.orientation);
    body.velocity = now.velocity;
    body.pull = 2 * glm::length(path.bend);
    if (fastest == 0) return body;
    body.spin = angular_velocity(now);
    body.fastest = fastest;
    body.swerve = fastest * fastest * (now.kind == BodyKind::dynamic_body ? kWandering<D> : 1);
    return body;
  }
  Body<D> placed_at(const Trajectory<D>& path, double t) const {
    Body<D> body = *path.body;
    body.position += t * (path.velocity + t * path.bend);
    body.velocity = path.velocity + 2 * t * path.bend;
    turn_freely(body, t, path.rotation);
    return body;
  }

  std::optional<TimeOfImpact> at(double t, const Gap<D>& seen) const {
    if (seen.closing <= -slow_) return std::nullopt;
    return TimeOfImpact{t, seen.closing <= slow_};
  }

  // What turns is sure not to touch for a short while only, and advances creep. But where the
  // nearest points would meet if they kept their speed, the shapes mostly overlap, so that the
  // moment lies in between (by false position, Illinois).
  std::optional<TimeOfImpact> bracketed(double t, Gap<D> seen, double sure) const {
    if (!turns_ || !(seen.closing > slow_)) return std::nullopt;
    if (!(sure < within_)) return std::nullopt;
    double end = std::min(t + seen.gap / seen.closing * kImpactSettings.overshoot, within_);
    if (!(end > sure)) return std::nullopt;
    auto later = gap_at(end);
    if (!later || later->gap > 0) return std::nullopt;
    double low = seen.gap, high = later->gap;
    for (int i = 0; i < kImpactSettings.most_cuts && seen.gap > near_; ++i) {
      const double cut = t + (end - t) * (low / (low - high));
      if (!(cut > t && cut < end)) break;
      const auto met = gap_at(cut);
      if (!met) return std::nullopt;
      if (met->gap >= 0) {
        t = cut;
        seen = *met;
        low = met->gap;
        high /= 2;
      } else {
        end = cut;
        high = met->gap;
        low /= 2;
      }
    }
    return at(t, seen);
  }

  std::optional<Gap<D>> gap_at(double t) const {
    const Body<D> a = placed_at(a_, t), b = placed_at(b_, t);
    ++work_.narrow_tests;
    ++work_.impact_looks;
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
    seen.normal = manifold->normal;
    if (looks_ != nullptr) tell_look(t, a, b, *manifold, seen.gap);
    return seen;
  }

  void tell_look(double t, const Body<D>& a, const Body<D>& b, const Manifold<D>& manifold,
                 double gap) const {
    const auto points = manifold.points();
    const ManifoldPoint<D>& nearest =
        *std::min_element(points.begin(), points.end(),
                          [](const auto& p, const auto& q) { return p.separation < q.separation; });
    const Vec<D> half = manifold.normal * (gap / 2);
    looks_->push_back({begun_ + t, pose_of(a), pose_of(b), nearest.position - half,
                       nearest.position + half, gap, begun_ + t});
  }
  static Pose<D> pose_of(const Body<D>& body) { return {body.id, body.position, body.orientation}; }
  // Of the last look.
  void tell_free_until(double t) const {
    if (looks_ != nullptr) looks_->back().free_until = begun_ + std::min(t, within_);
  }

  const Trajectory<D>& a_;
  const Trajectory<D>& b_;
  double within_, reach_;
  WorldWork& work_;
  std::vector<ImpactLook<D>>* looks_;  // null if nobody watches
  double begun_;
  double fastest_a_ = 0, fastest_b_ = 0;  // spins
  double turn_a_ = 0, turn_b_ = 0;        // how fast surfaces can move by turning
  double bend_ = 0;                       // the gap's second derivative is at least minus this
  double slow_ = 0;
  double size_ = 0;
  double near_ = 0;
  bool turns_ = false;
};

}  // namespace

template <int D>
std::optional<TimeOfImpact> time_of_impact(const Trajectory<D>& a, const Trajectory<D>& b,
                                           double within, double slow, double reach,
                                           WorldWork& work, std::vector<ImpactLook<D>>* looks,
                                           double begun) {
  const std::size_t before = looks == nullptr ? 0 : looks->size();
  const auto met = Approach<D>(a, b, within, slow, reach, work, looks, begun).find();
  if (looks != nullptr && met && !met->rests)
    for (std::size_t i = before; i < looks->size(); ++i)
      (*looks)[i].meets = (*looks)[i].time == begun + met->seconds;
  return met;
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
                                                      double, double, double, WorldWork&,         \
                                                      std::vector<ImpactLook<D>>*, double);       \
  template double slowest_impact(const Trajectory<D>&, const Trajectory<D>&, double);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
