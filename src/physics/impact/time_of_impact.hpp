// When two bodies meet, and for how long they are sure not to.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/scratch.hpp"
#include "physics/contact/contact_solver.hpp"

namespace lantern::physics {

// The numbers of impacts: how their times are found, and how the blows are resolved.
struct ImpactSettings {
  int most_advances = 200;  // towards one impact
  double overshoot = 1.05;  // of the way to where they would meet at their speed
  int most_cuts = 60;       // of the time between apart and overlapping
  // Of the thinner one's thickness: points so near each other touch at a time; what gets no nearer
  // in half of all advances is there.
  double near = 1e-9;
  double touches = 1e-15;  // of the sizes: so near is at the moment of the impact
  // Of the thinner one's thickness: what turns may bend its way by so little before it is looked at
  // again, where it touches without approaching.
  double lift = 1e-3;
  double shortest_bounce = 1.0 / 32;  // of a step: one that would be shorter is none
  int most_rests = 3;                 // in a step: a pair that rests so often does not bounce again
  double speed_by_rounding = 1e-12;   // of both speeds: what approaches slower is at rest
  double speed_by_turning = 1e-7;     // of the speeds of what turns, the same
  int bouncing_rounds = 64;           // through all touching pairs, in one impact
  int most_rounds = 96;               // the last ones without restitution
  int most_point_sweeps = 200;        // over the points of one pair
  double change = 1e-15;              // of the largest impulse: so small a one ends these sweeps
  double touching = 4e-9;             // of the thinner one's: so near is struck, too
  double gain_by_rounding = 1e-12;    // of the blow's energy: so small a gain of it is none
  std::size_t most_together = 64;     // rows of what joints hold, or few more, struck at once
  int most_jointed_sweeps = 1000;     // over these
  int joint_rounds = 3;               // in which joints are solved
  double most_held_turn = 0.5;        // radians for which a contact holds what turns
  double same_way = 1e-12;            // relatively: what moves so nearly as foreseen, does so
  double deep = 0.25;                 // of the thinner one's thickness: deeper no contact may be,
  double same_side = 0.7;             // cosine between normals of a contact that is still the same
  double shortest_part = 1e-9;        // of a step, and
  int most_parts = 1024;              // of a step, into which it is cut to keep it so
};
inline constexpr ImpactSettings kImpactSettings;

// How a body flies for a while: x(t) = position + t velocity + t^2 bend.
template <int D>
struct Trajectory {
  const Body<D>* body = nullptr;
  Vec<D> velocity{0.0};
  Vec<D> bend{0.0};
  RotationMethod rotation = RotationMethod::exact;
  double held = 0;  // acceleration that forces would give it, if it did not rest on something
};

// Two bodies that may meet.
template <int D>
struct Encounter {
  const Trajectory<D>&a, &b;
  double within;                           // seconds
  double slow;                             // what approaches more slowly is said to rest
  double reach;                            // farther apart they are not looked at
  WorldWork& work;                         // counts each look at the two, by the narrow phase
  std::vector<ImpactLook<D>>* looks = {};  // is told each, if there is one,
  double begun = 0;                        // so many seconds after its step began
};

// A body after so many seconds of it.
template <int D>
Body<D> flown(const Trajectory<D>& path, double t) {
  Body<D> body = *path.body;
  body.position += t * (path.velocity + t * path.bend);
  body.velocity = path.velocity + 2 * t * path.bend;
  turn_freely(body, t, path.rotation);
  return body;
}

enum class Meeting {
  strikes,
  rests,  // too slow for an impact: from then on it is a contact
  apart,  // none yet: so far it was looked for
};

template <int D>
struct TimeOfImpact {
  double seconds = 0;
  Meeting meeting = Meeting::strikes;
  Vec<D> normal{0.0};
};

// A body at a moment of its free flight.
template <int D>
struct Flying {
  Shape<D> shape{};
  Vec<D> position{0.0};
  Mat<D> axes{1.0};  // of its core, as columns
  Vec<D> velocity{0.0};
  Spin<D> spin{0.0};         // radians a second
  double pull = 0;           // its centre is accelerated by so much, never more
  double fastest = 0;        // it never spins faster
  double swerve = 0;         // acceleration of a point that is 1 from the centre, by turning alone
  double corner_swerve = 0;  // the same of its own corners
};

// A plane that turns is followed for so many radians at most: what bounds it grows with time.
inline constexpr double kMostTurn = 0.5;
// A corner seen along the normal: s + rate t, wrong by no more than bend t^2 / 2.
struct Side {
  double at = 0, rate = 0, bend = 0;
};

template <int D>
struct Sides {
  std::array<Side, 1 << D> room;
  std::size_t count = 0;
  void add(const Side& side) { room[count++] = side; }
};

// Where corners are seen from: a frame that flies and turns with a body; or none, which stands.
template <int D>
struct SeenFrom {
  const Flying<D>* body = nullptr;
  double within = 0;
};

template <int D>
Side seen(const Flying<D>& body, const Vec<D>& arm, const Vec<D>& n, const SeenFrom<D>& frame) {
  const double reach = glm::length(arm);
  const Vec<D> point = body.position + arm, v = body.velocity + cross(body.spin, arm);
  const double bend = body.pull + body.corner_swerve;
  if (frame.body == nullptr) return {glm::dot(n, point), glm::dot(n, v), bend};
  const Flying<D>& own = *frame.body;
  const Vec<D> d = point - own.position;
  if (&own == &body) return {glm::dot(n, d), 0, 0};
  const double fast = glm::length(body.velocity - own.velocity) + body.fastest * reach +
                      (body.pull + own.pull) * frame.within;
  const double far = glm::length(d) + fast * frame.within;
  return {glm::dot(n, d), glm::dot(n, v - own.velocity - cross(own.spin, d)),
          bend + own.pull + 2 * own.fastest * fast + own.swerve * far};
}

// All corners, each moved out by the roundness; as a ball round the centre the body may turn as it
// likes. `out` is 1 for the body that lies behind the plane, -1 for the one before it.
template <int D>
Sides<D> sides_of(const Flying<D>& body, const Vec<D>& n, const SeenFrom<D>& frame, double out,
                  bool as_ball) {
  Sides<D> sides;
  visit_shape<D>(
      body.shape,
      [&](const Core<D>& core) {
        if (as_ball) {
          const double radius = glm::length(core.half) + core.radius;
          const double along = glm::dot(n, body.position) + out * radius;
          return sides.add({along, glm::dot(n, body.velocity), body.pull});
        }
        for (unsigned corner = 0; corner < 1U << D; ++corner) {
          Vec<D> arm(0.0);
          bool twin = false;
          for (int i = 0; i < D; ++i) {
            const bool high = (corner >> i & 1U) != 0;
            twin |= high && core.half[i] == 0;
            arm += body.axes[i] * (high ? core.half[i] : -core.half[i]);
          }
          if (twin) continue;
          Side side = seen(body, arm, n, frame);
          side.at += out * core.radius;
          sides.add(side);
        }
      },
      [&](const HalfSpace<D>&) { sides.add(seen(body, Vec<D>(0.0), n, frame)); });
  return sides;
}

// When a gap g with the rate v, which shrinks by no more than bend t^2 / 2 besides, may be closed.
inline double until_closed(double g, double v, double bend) {
  if (bend == 0) return v < 0 ? g / -v : HUGE_VAL;
  const double root = std::sqrt(v * v + 2 * bend * g);
  return v > 0 ? (v + root) / bend : root - v > 0 ? 2 * g / (root - v) : 0;
}

template <int D>
double until_met(const Sides<D>& behind, const Sides<D>& before, double depth, double within) {
  double sure = within;
  for (std::size_t i = 0; i < behind.count; ++i)
    for (std::size_t j = 0; j < before.count; ++j) {
      const Side &a = behind.room[i], &b = before.room[j];
      const double gap = b.at - a.at;
      if (gap < -depth) return 0;  // this plane is not between them
      sure = std::min(sure, until_closed(std::max(gap, 0.0), b.rate - a.rate, a.bend + b.bend));
    }
  return sure;
}

template <int D>
bool is_half_space(const Flying<D>& body) {
  return std::holds_alternative<HalfSpace<D>>(body.shape);
}

// The most that a free body's spin becomes as it wanders: exact, since the energy and |L| are kept.
template <int D>
double fastest_spin(const Body<D>& body) {
  const Spin<D> spin = angular_velocity(body);
  double square = dot(spin, spin);
  if constexpr (D == 3) {
    if (body.is_dynamic()) {
      // As L wanders, |w|^2 is a linear function of the square of L's middle component, and the
      // largest where that is 0.
      const Vec<3> l = glm::conjugate(body.orientation.q) * body.angular_momentum;
      std::array<int, 3> axis{0, 1, 2};
      const Vec<3>& m = body.inverse_inertia;
      std::ranges::sort(axis, {}, [&](int i) { return std::pair(m[i], i); });
      square += (m[axis[1]] - m[axis[0]]) * (m[axis[2]] - m[axis[1]]) * l[axis[1]] * l[axis[1]];
    }
  }
  return std::sqrt(square);
}

// Acceleration of what turns, against spin^2 radius: a spin that wanders has more. I w' = L x w,
// and no inertia is larger than the other two together, so |w'| <= w^2 / sqrt(3).
template <int D>
inline constexpr double kWandering = D == 2 ? 1 : 1.58;

// Of the corners of a free body, by turning alone: the most that they become as its spin wanders.
struct Whirl {
  double speed = 0;
  double swerve = 0;  // acceleration
};

// Of vectors whose components are at most so large.
inline Vec<3> largest_cross(const Vec<3>& a, const Vec<3>& b) {
  return {a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x};
}

// No component of the spin, about the body's own axes, is larger than all of |L| or all of the
// energy would make it. So a needle's spin about its length, which may be huge, is not taken for
// one that moves its ends.
template <int D>
Whirl whirl(const Body<D>& body) {
  const double reach = turning_reach<D>(body.shape);
  if (reach == 0 || !body.moves() || body.asleep) return {};
  if constexpr (D == 3)
    if (body.is_dynamic() && body.turns_about_every_axis()) {
      const Vec<3>& inverse = body.inverse_inertia;
      const Vec<3> l = glm::conjugate(body.orientation.q) * body.angular_momentum;
      const double length = glm::length(l), energy = glm::dot(l * inverse, l);
      const Vec<3> spin = glm::min(length * inverse, glm::sqrt(energy * inverse));
      const Vec<3> arm = visit_shape<3>(
          body.shape, [](const Core<3>& core) { return core.half; },
          [](const HalfSpace<3>&) { return Vec<3>(0.0); });
      const Vec<3> wanders =
          inverse *
          glm::abs(Vec<3>(1 / inverse.y - 1 / inverse.z, 1 / inverse.z - 1 / inverse.x,
                          1 / inverse.x - 1 / inverse.y)) *
          Vec<3>(spin.y * spin.z, spin.z * spin.x, spin.x * spin.y);
      const Vec<3> speed = largest_cross(spin, arm);
      return {glm::length(speed),
              glm::length(largest_cross(spin, speed) + largest_cross(wanders, arm))};
    }
  const double spin = fastest_spin(body);
  return {spin * reach, (body.is_dynamic() ? kWandering<D> : 1) * spin * spin * reach};
}

// Seconds, at most `within`, in which the two are sure not to touch. `normal` points from a to b
// and nearly parts them; the better it does, the longer. What is no deeper than `depth` along it
// counts as apart: touching bodies may part.
//
// They are apart as long as all corners are on their sides of a plane. Planes that stay as they
// are, and such as turn with a or with b, are tried: the last is best for a corner near a face.
// Along each corners fly on parabolas at worst.
template <int D>
double sure_advance(const Flying<D>& a, const Flying<D>& b, const Vec<D>& n, double depth,
                    double within) {
  double sure = 0;
  const auto with = [&](const SeenFrom<D>& frame, bool as_ball) {
    const double met = until_met(sides_of(a, n, frame, 1, as_ball),
                                 sides_of(b, n, frame, -1, as_ball), depth, frame.within);
    sure = std::max(sure, met);
  };
  with({nullptr, within}, false);
  with({nullptr, within}, true);
  if (is_half_space(a) || is_half_space(b)) return sure;  // their planes stand
  for (const Flying<D>* own : {&a, &b})
    if (own->fastest > 0) with({own, std::min(within, kMostTurn / own->fastest)}, false);
  return sure;
}

template <int D>
Flying<D> flying(const Trajectory<D>& path) {
  const Body<D>& now = *path.body;
  Flying<D> body{now.shape, now.position};
  if (turns<D>(now.shape)) body.axes = matrix(now.orientation);
  body.velocity = path.velocity;
  body.pull = 2 * glm::length(path.bend);
  const Whirl turning = whirl(now);
  if (turning.speed == 0) return body;
  body.spin = angular_velocity(now);
  body.fastest = fastest_spin(now);
  body.swerve = body.fastest * body.fastest * (now.is_dynamic() ? kWandering<D> : 1);
  body.corner_swerve = turning.swerve;
  return body;
}

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
  explicit Approach(const Encounter<D>& of) : of_(of) {
    const Trajectory<D>&a = of.a, &b = of.b;
    const Whirl turns_a = whirl(*a.body), turns_b = whirl(*b.body);
    turn_a_ = turns_a.speed;
    turn_b_ = turns_b.speed;
    bend_ = 2 * glm::length(b.bend - a.bend) + turns_a.swerve + turns_b.swerve;
    turns_ = turn_a_ + turn_b_ > 0;
    most_turn_ = kMostTurn / (fastest_spin(*a.body) + fastest_spin(*b.body));
    near_ = kImpactSettings.near * thinner(*a.body, *b.body);
    lift_ = std::sqrt(kImpactSettings.lift * thinner(*a.body, *b.body) / bend_);
    size_ = glm::length(a.body->position) + glm::length(b.body->position);
    for (const Trajectory<D>* path : {&a, &b})
      if (const double t = thickness<D>(path->body->shape); t < kEndless) size_ += t;
  }

  std::optional<TimeOfImpact<D>> find() const {
    double t = 0;
    Vec<D> normal(0.0);
    for (int i = 0; i < kImpactSettings.most_advances; ++i) {
      const auto seen = gap_at(t);
      if (!seen) return std::nullopt;
      normal = seen->normal;
      double next = t;
      if (seen->gap <= size_ * kImpactSettings.touches) {
        if (seen->closing > of_.slow) return TimeOfImpact<D>{t, Meeting::strikes, seen->normal};
        if (seen->closing > -of_.slow) {
          // They glide along each other, unless something presses them.
          if (bend_ == 0 && of_.a.held + of_.b.held == 0) return std::nullopt;
          if (!turns_ || !lifts_off(t)) return TimeOfImpact<D>{t, Meeting::rests, seen->normal};
          next = t + lift_;
        } else {
          // They part, and cannot be back before this.
          if (bend_ == 0) return std::nullopt;
          next = t + (turns_ ? sure(t, *seen) : 2 * -seen->closing / bend_);
        }
      } else {
        const double root = std::sqrt(seen->bound * seen->bound + 2 * bend_ * seen->gap);
        if (!(seen->bound + root > 0)) return std::nullopt;
        next = t + 2 * seen->gap / (seen->bound + root);
        if (turns_ && next < of_.within) next = std::max(next, t + sure(t, *seen));
        tell_free_until(next);
        if (const auto met = bracketed(t, *seen, next)) return met;
      }
      // No nearer in numbers, or so slowly that it is as good as there. What parts may come back.
      if (next == t || (i > kImpactSettings.most_advances / 2 && seen->gap < near_)) {
        if (const auto met = at(t, *seen)) return met;
        next = std::max(next, t + lift_);
      }
      if (!(next < of_.within)) return std::nullopt;
      t = next;
    }
    // They turn so fast that no sure advance comes to an end.
    return turns_
               ? std::optional(TimeOfImpact<D>{t, t > 0 ? Meeting::apart : Meeting::rests, normal})
               : std::nullopt;
  }

 private:
  double sure(double t, const Gap<D>& seen) const {
    const Body<D> a = flown(of_.a, t), b = flown(of_.b, t);
    return sure_advance(flying<D>({&a, a.velocity, of_.a.bend}),
                        flying<D>({&b, b.velocity, of_.b.bend}), seen.normal,
                        std::max(-seen.gap, 0.0) + near_, of_.within - t);
  }
  // The corner on which a body turns leaves what it touches, pulled towards the body's centre.
  bool lifts_off(double t) const {
    const auto later = gap_at(t + lift_);
    return !later || later->gap > size_ * kImpactSettings.touches;
  }

  std::optional<TimeOfImpact<D>> at(double t, const Gap<D>& seen) const {
    if (seen.closing <= -of_.slow) return std::nullopt;
    return TimeOfImpact<D>{t, seen.closing <= of_.slow ? Meeting::rests : Meeting::strikes,
                           seen.normal};
  }

  // What turns is sure not to touch for a short while only, and advances creep. But where the
  // nearest points would meet if they kept their speed, the shapes mostly overlap, so that the
  // moment lies in between (by false position, Illinois).
  std::optional<TimeOfImpact<D>> bracketed(double t, Gap<D> seen, double sure) const {
    if (!turns_ || !(seen.closing > of_.slow)) return std::nullopt;
    if (!(sure < of_.within)) return std::nullopt;
    double end = std::min(
        {t + seen.gap / seen.closing * kImpactSettings.overshoot, t + most_turn_, of_.within});
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
    const Body<D> a = flown(of_.a, t), b = flown(of_.b, t);
    ++of_.work.narrow_tests;
    ++of_.work.impact_looks;
    const auto manifold = collide(placed(a), placed(b), of_.reach);
    if (!manifold) return std::nullopt;
    Gap<D> seen;
    seen.gap = manifold->least_separation();
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
    if (of_.looks != nullptr) tell_look(t, a, b, *manifold, seen.gap);
    return seen;
  }

  void tell_look(double t, const Body<D>& a, const Body<D>& b, const Manifold<D>& manifold,
                 double gap) const {
    const auto points = manifold.points();
    const ManifoldPoint<D>& nearest =
        *std::ranges::min_element(points, {}, &ManifoldPoint<D>::separation);
    const Vec<D> half = manifold.normal * (gap / 2);
    of_.looks->push_back({of_.begun + t, pose(a), pose(b), nearest.position - half,
                          nearest.position + half, gap, of_.begun + t});
  }
  // Of the last look.
  void tell_free_until(double t) const {
    if (of_.looks != nullptr) of_.looks->back().free_until = of_.begun + std::min(t, of_.within);
  }

  const Encounter<D>& of_;
  double turn_a_ = 0, turn_b_ = 0;  // how fast surfaces can move by turning
  double bend_ = 0;                 // the gap's second derivative is at least minus this
  double size_ = 0;
  double near_ = 0;
  double most_turn_ = 0;  // seconds
  double lift_ = 0;       // seconds in which it bends a way by next to nothing
  bool turns_ = false;
};

// The first moment at which the two bodies touch and approach; nothing if there is none. By
// conservative advancement (Mirtich, "Impulse-based Dynamic Simulation", 1996): go on for as long
// as they surely cannot touch.
template <int D>
std::optional<TimeOfImpact<D>> time_of_impact(const Encounter<D>& of) {
  const std::size_t before = of.looks == nullptr ? 0 : of.looks->size();
  const auto met = Approach<D>(of).find();
  if (of.looks != nullptr && met && met->meeting == Meeting::strikes)
    for (std::size_t i = before; i < of.looks->size(); ++i)
      (*of.looks)[i].meets = (*of.looks)[i].time == of.begun + met->seconds;
  return met;
}

}  // namespace lantern::physics
