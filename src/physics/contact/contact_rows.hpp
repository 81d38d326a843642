// Contact constraints: bodies do not move into each other, and friction holds them back.
//
// Each point has one row along the normal and, with friction, one block across it. Rows are solved
// one after another, again and again (projected Gauss-Seidel; Catto, "Iterative Dynamics with
// Temporal Coherence", 2005): each finds the impulse after which its own condition holds, and the
// sum of impulses is clamped, not each single one.
//
//   normal     pn >= 0, and the bodies do not approach
//   friction   |pt| <= mu pn: a cone, so all directions are alike
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "physics/contact/contact_point.hpp"
#include "physics/contacts.hpp"

namespace lantern::physics {

// The contact of two bodies of an island.
template <int D>
struct ContactRows {
  std::uint32_t a = 0, b = 0;  // places among the island's bodies
  double friction = 0;
  double restitution = 0;
  double shallow = 0;  // so little penetration is eased out, where sweeps alone push
  Vec<D> normal{0.0};
  // Where something round lies on a flat face that may turn: its normal in the axes of the body
  // whose face it is, and in the world as it was last; else zero.
  Vec<D> flat{0.0}, faced{0.0};
  bool faces_a = false;  // the face is that of b, towards a
  bool carries = false;  // one of them is a kinematic body that turns, see carry
  std::array<ContactPoint<D>, Manifold<D>::kMostPoints> room;
  int count = 0;

  ContactRows() {}  // NOLINT: room that nobody reads is not cleared

  std::span<ContactPoint<D>> points() { return {room.data(), static_cast<std::size_t>(count)}; }
  std::span<const ContactPoint<D>> points() const {
    return {room.data(), static_cast<std::size_t>(count)};
  }

  // Points from the narrow phase, with the impulses per second that were remembered.
  void set_points(const Manifold<D>& manifold, const Body<D>& body_a, const Body<D>& body_b,
                  const Mat<D>& axes_a, const Mat<D>& axes_b, const Contact<D>* remembered,
                  double scale) {
    const Solid solid_a = solid_of(body_a.shape), solid_b = solid_of(body_b.shape);
    const Vec<D> at_a = body_a.position, at_b = body_b.position;
    normal = manifold.normal;
    count = manifold.count;
    shallow = kRowSettings.shallow * std::min(solid_a.thickness, solid_b.thickness);
    find_face(body_a, body_b, axes_a, axes_b, solid_a.radius > 0, solid_b.radius > 0);
    for (int i = 0; i < manifold.count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const ManifoldPoint<D>& from = manifold.room[at];
      ContactPoint<D>& p = room[at];
      p.feature = from.feature;
      p.inverse_tangent_mass = p.pn = p.correction = 0;
      p.pt = p.kicked_slip = p.wanted_slip = p.coupling = p.carried = Vec<D>(0.0);
      p.sticks = false;
      p.round_a = manifold.normal * solid_a.radius;
      p.round_b = manifold.normal * -solid_b.radius;
      const Vec<D> half_gap = manifold.normal * (from.separation / 2);
      const Vec<D> to_a = from.position - half_gap - at_a;
      const Vec<D> to_b = from.position + half_gap - at_b;
      p.core_a = (to_a - p.round_a) * axes_a;  // a vector times a matrix: by its inverse
      p.core_b = (to_b - p.round_b) * axes_b;
      // While bodies slide or roll on each other, the corner (or the round side) of one of them
      // moves over the face of the other: where it is now, they touch. Where edges cross it is half
      // way.
      const bool corner_a = solid_a.is_corner(p.core_a), corner_b = solid_b.is_corner(p.core_b);
      p.share = flat != Vec<D>(0.0)        ? (faces_a ? 0 : 1)
                : corner_a != corner_b     ? (corner_b ? 1 : 0)
                : body_a.inverse_mass == 0 ? 1
                : body_b.inverse_mass == 0 ? 0
                                           : 0.5;
      p.offset = from.separation - glm::dot(manifold.normal, (at_b - at_a) + to_b - to_a);
    }
    if (remembered != nullptr) take_over(manifold, *remembered, scale);
  }

  // Arms, separations and effective masses where the bodies are now; velocities are those before
  // the sub-step's forces. Points that approach faster than `threshold` bounce; those no farther
  // apart than `touching` have no gap. Of a sub-step of `h` seconds, in which the mean velocities
  // of bodies lag behind by `lag_a` and `lag_b` (see begin_correction).
  void refresh(const Body<D>& body_a, const Body<D>& body_b, const Mat<D>& axes_a,
               const Mat<D>& axes_b, const SolverBody<D>& solver_a, const SolverBody<D>& solver_b,
               double threshold, double touching, double h = 0, double lag_a = 0,
               double lag_b = 0) {
    const double lag = std::max(body_a.is_dynamic() ? lag_a : 0, body_b.is_dynamic() ? lag_b : 0);
    carries = carries_round(body_a) || carries_round(body_b);
    const bool rolls = flat != Vec<D>(0.0);
    const double ahead = rolls && turns_alike(faces_a ? body_b : body_a) ? std::min(lag, 0.5) : 0;
    const double turning = carries ? 0 : ahead * h;
    const Vec<D> lies = !rolls    ? normal
                        : faces_a ? turn_face(axes_b, solver_b.spin * turning)
                                  : turn_face(axes_a, solver_a.spin * turning);
    const Vec<D> apart = body_b.position - body_a.position;
    const auto along = tangents(normal);
    for (ContactPoint<D>& p : points()) {
      const Vec<D> to_a = axes_a * p.core_a + p.round_a, to_b = axes_b * p.core_b + p.round_b;
      const Vec<D> gap = apart + to_b - to_a;
      p.separation = glm::dot(lies, gap) + p.offset;
      p.gap = p.separation > touching ? p.separation : 0;
      p.arm_a = to_a + gap * p.share;
      p.arm_b = to_b - gap * (1 - p.share);
      const Vec<D> velocity = relative_velocity(solver_a, p.arm_a, solver_b, p.arm_b);
      p.slip = across(velocity);
      if (carries || ahead > 0) {
        const bool leads = carries_round(p.share > 0.5 ? body_b : body_a);
        carry(p, solver_a, axes_a * p.core_a, solver_b, axes_b * p.core_b, h,
              !carries ? ahead
              : leads  ? 0.5
                       : 0.5 + lag);
      }
      p.inverse_normal_mass = inverse_effective_mass(solver_a, p.arm_a, solver_b, p.arm_b, normal);
      if (friction > 0) {
        p.inverse_tangent_mass = softest(solver_a, solver_b, p, along);
        p.coupling = coupling(solver_a, solver_b, p);
      }
      const double parting = glm::dot(velocity, normal);
      p.bounce = p.gap == 0 && parting < -threshold ? -restitution * parting : 0;
    }
  }

  void warm_start(SolverBody<D>& body_a, SolverBody<D>& body_b) {
    for (ContactPoint<D>& p : points())
      p.kicked_slip = across(relative_velocity(body_a, p.arm_a, body_b, p.arm_b));
    for (ContactPoint<D>& p : points()) apply(p, normal * p.pn + p.pt, body_a, body_b);
  }

  // One sweep over velocities, for a sub-step of `h` seconds; over normals from the last point to
  // the first if `backwards`. If it always began at the same one, that side of a face would always
  // be pressed first, and a stack would lean.
  void solve_velocities(SolverBody<D>& body_a, SolverBody<D>& body_b, double h, Sweep& sweep,
                        bool backwards = false) {
    for (int i = 0; i < count; ++i) {
      ContactPoint<D>& p = room[static_cast<std::size_t>(backwards ? count - 1 - i : i)];
      if (p.inverse_normal_mass == 0) continue;
      const Vec<D> velocity = relative_velocity(body_a, p.arm_a, body_b, p.arm_b);
      const double parting = glm::dot(velocity, normal) - p.bounce;
      // Bodies that are still apart may come as close as to touch.
      const double before = p.pn;
      p.pn = std::max(before - (parting + p.gap / h) / answer_to_normal(p, velocity), 0.0);
      apply(p, normal * (p.pn - before), body_a, body_b);
      sweep.change = std::max(sweep.change, std::abs(p.pn - before));
      sweep.largest = std::max(sweep.largest, p.pn);
      ++sweep.work->normal_rows;
    }
    if (friction == 0) return;
    for (ContactPoint<D>& p : points()) {
      if (p.inverse_tangent_mass == 0 || (p.pn == 0 && p.pt == Vec<D>(0.0))) continue;
      const Vec<D> slip = across(relative_velocity(body_a, p.arm_a, body_b, p.arm_b));
      const Vec<D> before = p.pt;
      p.pt -= slip / p.inverse_tangent_mass;
      const double most = friction * p.pn, length = glm::length(p.pt);
      p.sticks = length <= most * (1 + kRowSettings.slip_by_rounding);
      if (length > most) p.pt *= most / length;
      const Vec<D> impulse = p.pt - before;
      apply(p, impulse, body_a, body_b);
      sweep.change = std::max(sweep.change, glm::length(impulse));
      sweep.work->friction_rows += D - 1;
    }
  }

  // What follows from the velocities found: the way that slipping points lag behind (see
  // sub_step.hpp), and how far sticking ones may still slide. `lag_a` and `lag_b` are the lags that
  // the integrator has already, `kicked_a` and `kicked_b` the motions after forces alone.
  void begin_correction(SolverBody<D>& body_a, SolverBody<D>& body_b, double lag_a, double lag_b,
                        const Motion<D>& kicked_a, const Motion<D>& kicked_b) {
    const ContactPoint<D>* firmest = nullptr;
    for (const ContactPoint<D>& p : points())
      if (firmest == nullptr || p.pn > firmest->pn) firmest = &p;
    for (ContactPoint<D>& p : points()) {
      p.correction = 0;
      if (friction == 0 || p.pn == 0) continue;
      if (!p.sticks) {
        const Vec<D> now = across(relative_velocity(body_a, p.arm_a, body_b, p.arm_b));
        const Vec<D> kicked = across(relative_velocity(kicked_a, p.arm_a, kicked_b, p.arm_b));
        const Vec<D> slowed = p.pt * slowing_share(p, now - p.slip, now - kicked);
        body_a.correct(slowed * (0.5 - lag_a), p.arm_a);
        body_b.correct(slowed * (lag_b - 0.5), p.arm_b);
        continue;
      }
      // A point that presses by rounding only stops when the firmest does.
      const bool hardly = p.pn <= kRowSettings.presses_by_rounding * firmest->pn && firmest->sticks;
      const double time = sliding_share(hardly ? *firmest : p);
      p.wanted_slip =
          p.slip * (time / 2) + across(relative_velocity(body_a, p.arm_a, body_b, p.arm_b));
      if (p.carried != Vec<D>(0.0)) p.wanted_slip += p.carried;
    }
  }

  // One sweep over mean velocities: after `h` seconds, points that press touch without penetration,
  // or with a part of it.
  void correct_positions(SolverBody<D>& body_a, SolverBody<D>& body_b, double h, bool alone,
                         Sweep& sweep) {
    for (ContactPoint<D>& p : points()) {
      if (p.inverse_normal_mass == 0) continue;
      const double parting =
          glm::dot(relative_velocity(body_a.mean, p.arm_a, body_b.mean, p.arm_b), normal);
      const double wanted = alone ? swept_push(p, h) : p.wanted_mean_speed(h);
      const double before = p.correction;
      // Together with the impulse that is there already, it may push but not pull.
      const double least = p.bounce > 0 ? 0 : -p.pn;
      p.correction = std::max(before + (wanted - parting) / p.inverse_normal_mass, least);
      correct(p, normal * (p.correction - before), body_a, body_b);
      sweep.change = std::max(sweep.change, std::abs(p.correction - before));
      ++sweep.work->normal_rows;
    }
    if (alone) return;
    for (ContactPoint<D>& p : points()) {
      if (!p.sticks || p.pn == 0 || p.inverse_tangent_mass == 0) continue;
      const Vec<D> slip = across(relative_velocity(body_a.mean, p.arm_a, body_b.mean, p.arm_b));
      const Vec<D> impulse = (p.wanted_slip - slip) / p.inverse_tangent_mass;
      correct(p, impulse, body_a, body_b);
      sweep.change = std::max(sweep.change, glm::length(impulse));
      sweep.work->friction_rows += D - 1;
    }
  }

 private:
  static bool carries_round(const Body<D>& body) {
    return body.kind == BodyKind::kinematic_body && body.kinematic_spin != Spin<D>(0.0) &&
           turns<D>(body.shape);
  }

  // What sticks to a kinematic body that turns goes round with it, and what rolls on it is taken
  // along. With the velocity that the surface has where they touched at the beginning, both would
  // go off along the tangent: by a part of order h farther out in each second. How that body moves
  // is known, so the rows are those of the moment for which the new velocity stands: half way, if
  // that is the mean one, and later by as much as the mean velocity lags behind. What is round on a
  // face that turns is met half way, too, if the mean velocity and spin lag; else a plank that
  // rocks would gain energy. The place of contact is by then, `ahead` sub-steps on, where its
  // corner takes it, or the middle of the round side. Such an Adams-Bashforth step is of second
  // order, and lets what goes round by x in it go outward by x^4 / 4.
  void carry(ContactPoint<D>& p, const SolverBody<D>& body_a, const Vec<D>& core_a,
             const SolverBody<D>& body_b, const Vec<D>& core_b, double h, double ahead) {
    const bool is_b = p.share > 0.5;
    const SolverBody<D>&leader = is_b ? body_b : body_a, &other = is_b ? body_a : body_b;
    Vec<D> way = leader.velocity + cross(leader.spin, is_b ? core_b : core_a);
    if (flat != Vec<D>(0.0)) way += cross(other.spin, is_b ? p.round_b : p.round_a);
    // Along the surface of the other: it does not go into it.
    way -= normal *
           glm::dot(way - other.velocity - cross(other.spin, is_b ? p.arm_a : p.arm_b), normal);
    const Vec<D> along_a = (way - body_a.velocity) * h, along_b = (way - body_b.velocity) * h;
    const Vec<D> turned = across(cross(body_b.spin, along_b) - cross(body_a.spin, along_a));
    p.slip += turned * (carries ? ahead - 1 : -ahead);
    p.carried = turned * std::max(ahead - 0.5, 0.0);
    p.arm_a += along_a * ahead;
    p.arm_b += along_b * ahead;
  }

  // Whether what touches is a flat face of one body, which may turn, and a round side of the other.
  void find_face(const Body<D>& body_a, const Body<D>& body_b, const Mat<D>& axes_a,
                 const Mat<D>& axes_b, bool round_a, bool round_b) {
    flat = faced = Vec<D>(0.0);
    if (round_a == round_b) return;
    faces_a = round_a;
    const Body<D>& body = faces_a ? body_b : body_a;
    const Mat<D>& axes = faces_a ? axes_b : axes_a;
    if (!carries_round(body) && body.inverse_inertia == Spin<D>(0.0)) return;
    const Vec<D> along = normal * axes;
    for (int i = 0; i < D; ++i)
      if (std::abs(along[i]) > 1 - kRowSettings.flat) flat[i] = along[i] < 0 ? -1 : 1;
    faced = axes * flat;
  }

  // The normal of a face turns with its body, in a step's sub-steps too: what is round rolls on it,
  // and touches it elsewhere. (On a normal that stays, a rocking plank would be lifted.) Returns
  // the normal as it is now; rows have it turned on by `turn`.
  Vec<D> turn_face(const Mat<D>& axes, const Spin<D>& turn) {
    const Vec<D> now = axes * flat;
    if (now == faced && turn == Spin<D>(0.0)) return normal;
    for (ContactPoint<D>& p : points()) {
      p.round_a = now * glm::dot(p.round_a, faced);
      p.round_b = now * glm::dot(p.round_b, faced);
    }
    faced = now;
    normal = turn == Spin<D>(0.0) ? now : matrix(turned(Rotation<D>{}, turn)) * now;
    for (ContactPoint<D>& p : points()) p.pt = across(p.pt);
    return now;
  }

  // Impulses stay with their features. A feature has another name as soon as another corner ends
  // the face, which in a stack of equal boxes the slightest shift does; what is left without a
  // point then goes to the nearest new one, if that is as near as `shallow`, lest half of what
  // carries the stack is forgotten.
  void take_over(const Manifold<D>& manifold, const Contact<D>& old, double scale) {
    constexpr auto kMost = static_cast<std::size_t>(Manifold<D>::kMostPoints);
    std::array<bool, kMost> has{}, given{};
    const std::size_t now = points().size(), before = old.manifold.points().size();
    std::size_t left = std::min(now, before);
    const auto pass_on = [&](std::size_t from, std::size_t to) {
      room[to].pn = old.normal_impulses[from] * scale;
      room[to].pt = across(old.friction_impulses[from] * scale);
      has[to] = given[from] = true;
      --left;
    };
    for (std::size_t i = 0; i < now; ++i)
      for (std::size_t j = 0; j < before; ++j)
        if (old.manifold.room[j].feature == room[i].feature) pass_on(j, i);
    while (left > 0) {
      double nearest = shallow * shallow;
      std::size_t from = kMost, to = kMost;
      for (std::size_t i = 0; i < now; ++i)
        for (std::size_t j = 0; j < before; ++j) {
          if (has[i] || given[j]) continue;
          const Vec<D> way = manifold.room[i].position - old.manifold.room[j].position;
          if (!(glm::dot(way, way) < nearest)) continue;
          nearest = glm::dot(way, way);
          from = j;
          to = i;
        }
      if (from == kMost) return;
      pass_on(from, to);
    }
  }

  // The mean speed of parting for a point that sweeps alone push, see RowSettings.
  double swept_push(const ContactPoint<D>& p, double h) const {
    if (p.gap > 0) return -p.gap / h;
    const double eased = p.pn > 0 ? std::min(-p.separation, shallow) : 0,
                 pushed = -p.separation - eased;
    return std::min((eased * kRowSettings.eased_out + pushed * kRowSettings.pushed_out) / h,
                    kRowSettings.fastest_push);
  }

  // An impulse upon b at a point, and the opposite one upon a.
  static void apply(const ContactPoint<D>& p, const Vec<D>& impulse, SolverBody<D>& a,
                    SolverBody<D>& b) {
    a.apply(-impulse, p.arm_a);
    b.apply(impulse, p.arm_b);
  }
  static void correct(const ContactPoint<D>& p, const Vec<D>& impulse, SolverBody<D>& a,
                      SolverBody<D>& b) {
    a.correct(-impulse, p.arm_a);
    b.correct(impulse, p.arm_b);
  }

  Vec<D> across(const Vec<D>& v) const { return v - normal * glm::dot(v, normal); }

  // A body's core.
  struct Solid {
    Vec<D> half{0.0};
    double radius = 0;  // how far the surface is from the part of the body that turns
    double near = -1;   // so near to a corner of the core is at it; a half-space has none
    double thickness = geometry::kEndless;

    // Of a point in the body's own axes. A sphere's centre is one, an end of a capsule's segment.
    bool is_corner(const Vec<D>& point) const {
      for (int i = 0; i < D; ++i)
        if (std::abs(std::abs(point[i]) - half[i]) > near) return false;
      return true;
    }
  };
  static Solid solid_of(const Shape<D>& shape) {
    return visit_shape<D>(
        shape,
        [](const Core<D>& core) {
          double size = core.radius;
          for (int i = 0; i < D; ++i) size = std::max(size, core.half[i]);
          return Solid{core.half, core.radius, kRowSettings.corner * size, core.thickness()};
        },
        [](const HalfSpace<D>&) { return Solid{}; });
  }

  // The inverse of the least effective mass across the normal. With it a sweep never overshoots,
  // and where it stops, friction points exactly against the slip.
  double softest(const SolverBody<D>& body_a, const SolverBody<D>& body_b, const ContactPoint<D>& p,
                 const std::array<Vec<D>, D - 1>& along) const {
    if constexpr (D == 2) {
      return inverse_effective_mass(body_a, p.arm_a, body_b, p.arm_b, along[0]);
    } else {
      const auto& [s, t] = along;
      const auto turned_by = [&](const Vec<3>& direction) {
        return cross(body_a.inverse_inertia * cross(p.arm_a, direction), p.arm_a) +
               cross(body_b.inverse_inertia * cross(p.arm_b, direction), p.arm_b);
      };
      const Vec<3> by_s = turned_by(s), by_t = turned_by(t);
      const double ss = glm::dot(by_s, s), tt = glm::dot(by_t, t), st = glm::dot(by_s, t);
      const double mean = (ss + tt) / 2, half = (ss - tt) / 2;
      return body_a.inverse_mass + body_b.inverse_mass + mean + std::sqrt(half * half + st * st);
    }
  }

  // Velocity across by an impulse of 1 along the normal, if full friction could make of it as much
  // as `coupled` says; c^2 <= (K_nn - 1/m) (K_tt - 1/m) rules out nearly all points.
  Vec<D> coupling(const SolverBody<D>& body_a, const SolverBody<D>& body_b,
                  const ContactPoint<D>& p) const {
    const double mass = body_a.inverse_mass + body_b.inverse_mass,
                 least = kRowSettings.coupled * p.inverse_normal_mass / friction;
    if ((p.inverse_normal_mass - mass) * (p.inverse_tangent_mass - mass) < least * least)
      return Vec<D>(0.0);
    const Vec<D> c = across(cross(body_a.inverse_inertia * cross(p.arm_a, normal), p.arm_a) +
                            cross(body_b.inverse_inertia * cross(p.arm_b, normal), p.arm_b));
    return glm::dot(c, c) < least * least ? Vec<D>(0.0) : c;
  }

  // Velocity along the normal by an impulse of 1 along it; with what friction adds to it, which
  // follows in the same sweep, where the point slips and both would else overshoot in turns.
  double answer_to_normal(const ContactPoint<D>& p, const Vec<D>& velocity) const {
    if (p.coupling == Vec<D>(0.0) || p.sticks) return p.inverse_normal_mass;
    const Vec<D> way = p.pt != Vec<D>(0.0) ? p.pt : -across(velocity);
    const double length = glm::length(way);
    if (!(length > 0)) return p.inverse_normal_mass;
    return p.inverse_normal_mass + std::max(friction * glm::dot(way, p.coupling) / length, 0.0);
  }

  // Slips through the whole sub-step. The part of friction that slows it does so evenly: the mean
  // is half way. The part that holds against forces lags as these do: else a body that they move by
  // little would move by half of the friction more. `change` is that of the slip, of which contacts
  // made `made`. On rollers that turn against each other each friction counts, not just the larger.
  double slowing_share(const ContactPoint<D>& p, const Vec<D>& change, const Vec<D>& made) const {
    const double slowed = glm::dot(change, made), most = glm::dot(made, made);
    if (!(slowed > 0) || (!carries && !(glm::dot(change, p.pt) > 0))) return 0;
    return std::min(slowed / most, 1.0);
  }

  // Part of the sub-step for which a point that sticks in the end slides on: until full friction
  // would have stopped it, t / h = |slip_0| / |change of slip under full friction|.
  double sliding_share(const ContactPoint<D>& p) const {
    const double used = glm::length(p.pt) / (friction * p.pn);
    const double slip = glm::length(p.slip);
    const double change = glm::length((p.kicked_slip - p.slip) * used - p.kicked_slip);
    return change > 0 ? std::min(slip * used / change, 1.0) : 0;
  }
};

}  // namespace lantern::physics
