#include "physics/contact_rows.hpp"

#include <algorithm>
#include <cmath>

namespace lantern::physics {
namespace {

// How far the surface is from the part of the body that turns.
template <int D>
double roundness(const Shape<D>& shape) {
  return visit_shape<D>(
      shape, [](const Core<D>& core) { return core.radius; },
      [](const HalfSpace<D>&) { return 0.0; });
}

// Whether a point of a body's core, in its own axes, is one of its corners: a sphere's centre, an
// end of a capsule's segment.
template <int D>
bool is_corner(const Shape<D>& shape, const Vec<D>& point) {
  return visit_shape<D>(
      shape,
      [&](const Core<D>& core) {
        double size = core.radius;
        for (int i = 0; i < D; ++i) size = std::max(size, core.half[i]);
        for (int i = 0; i < D; ++i)
          if (std::abs(std::abs(point[i]) - core.half[i]) > kRowSettings.corner * size)
            return false;
        return true;
      },
      [](const HalfSpace<D>&) { return false; });
}

// While bodies slide or roll on each other, the corner (or the round side) of one of them moves
// over the face of the other: where it is now, they touch. Where edges cross it is half way.
template <int D>
double where_impulses_act(const Body<D>& a, const Vec<D>& core_a, const Body<D>& b,
                          const Vec<D>& core_b) {
  const bool corner_a = is_corner<D>(a.shape, core_a), corner_b = is_corner<D>(b.shape, core_b);
  if (corner_a != corner_b) return corner_b ? 1 : 0;
  return a.inverse_mass == 0 ? 1 : b.inverse_mass == 0 ? 0 : 0.5;
}

// An impulse upon b at a point, and the opposite one upon a.
template <int D>
void apply(const ContactPoint<D>& p, const Vec<D>& impulse, SolverBody<D>& a, SolverBody<D>& b) {
  a.apply(-impulse, p.arm_a);
  b.apply(impulse, p.arm_b);
}
template <int D>
void correct(const ContactPoint<D>& p, const Vec<D>& impulse, SolverBody<D>& a, SolverBody<D>& b) {
  a.correct(-impulse, p.arm_a);
  b.correct(impulse, p.arm_b);
}

template <int D>
Vec<D> across(const Vec<D>& v, const Vec<D>& normal) {
  return v - normal * glm::dot(v, normal);
}

// The inverse of the least effective mass across the normal. With it a sweep never overshoots, and
// where it stops, friction points exactly against the slip.
double softest(const SolverBody<2>& a, const SolverBody<2>& b, const ContactPoint<2>& p,
               const Vec<2>& n) {
  return inverse_effective_mass<2>(a, p.arm_a, b, p.arm_b, {-n.y, n.x});
}
double softest(const SolverBody<3>& a, const SolverBody<3>& b, const ContactPoint<3>& p,
               const Vec<3>& n) {
  const Vec<3> other = std::abs(n.x) < 0.6 ? Vec<3>(1, 0, 0) : Vec<3>(0, 1, 0);
  const Vec<3> s = glm::normalize(glm::cross(n, other)), t = glm::cross(n, s);
  const auto turned_by = [&](const SolverBody<3>& m, const Vec<3>& arm, const Vec<3>& direction) {
    return cross(m.inverse_inertia * cross(arm, direction), arm);
  };
  const Vec<3> by_s = turned_by(a, p.arm_a, s) + turned_by(b, p.arm_b, s);
  const Vec<3> by_t = turned_by(a, p.arm_a, t) + turned_by(b, p.arm_b, t);
  const double ss = glm::dot(by_s, s), tt = glm::dot(by_t, t), st = glm::dot(by_s, t);
  const double mean = (ss + tt) / 2, half = (ss - tt) / 2;
  return a.inverse_mass + b.inverse_mass + mean + std::sqrt(half * half + st * st);
}

// Part of the sub-step for which a point that sticks in the end slides on: until full friction
// would have stopped it, t / h = |slip_0| / |change of slip under full friction|.
template <int D>
double sliding_share(const ContactPoint<D>& p, double friction) {
  const double used = glm::length(p.pt) / (friction * p.pn);
  const double slip = glm::length(p.slip);
  const double change = glm::length((p.kicked_slip - p.slip) * used - p.kicked_slip);
  return change > 0 ? std::min(slip * used / change, 1.0) : 0;
}

}  // namespace

template <int D>
void ContactRows<D>::set_points(const Manifold<D>& manifold, const Body<D>& body_a,
                                const Body<D>& body_b, const Mat<D>& axes_a, const Mat<D>& axes_b,
                                const Contact<D>* remembered, double scale) {
  normal = manifold.normal;
  count = manifold.count;
  for (int i = 0; i < manifold.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const ManifoldPoint<D>& from = manifold.room[at];
    ContactPoint<D> p;
    p.feature = from.feature;
    p.round_a = normal * roundness<D>(body_a.shape);
    p.round_b = normal * -roundness<D>(body_b.shape);
    const Vec<D> half_gap = normal * (from.separation / 2);
    const Vec<D> to_a = from.position - half_gap - body_a.position;
    const Vec<D> to_b = from.position + half_gap - body_b.position;
    p.core_a = (to_a - p.round_a) * axes_a;  // a vector times a matrix: by its inverse
    p.core_b = (to_b - p.round_b) * axes_b;
    p.share = where_impulses_act(body_a, p.core_a, body_b, p.core_b);
    p.offset =
        from.separation - glm::dot(normal, (body_b.position - body_a.position) + to_b - to_a);
    if (remembered != nullptr)
      for (int j = 0; j < remembered->manifold.count; ++j) {
        const auto old = static_cast<std::size_t>(j);
        if (remembered->manifold.room[old].feature != p.feature) continue;
        p.pn = remembered->normal_impulses[old] * scale;
        p.pt = across(remembered->friction_impulses[old] * scale, normal);
      }
    room[at] = p;
  }
}

template <int D>
void ContactRows<D>::refresh(const Body<D>& body_a, const Body<D>& body_b, const Mat<D>& axes_a,
                             const Mat<D>& axes_b, const SolverBody<D>& solver_a,
                             const SolverBody<D>& solver_b, double threshold, double touching) {
  for (ContactPoint<D>& p : points()) {
    const Vec<D> to_a = axes_a * p.core_a + p.round_a, to_b = axes_b * p.core_b + p.round_b;
    const Vec<D> gap = (body_b.position - body_a.position) + to_b - to_a;
    p.separation = glm::dot(normal, gap) + p.offset;
    p.gap = p.separation > touching ? p.separation : 0;
    p.arm_a = to_a + gap * p.share;
    p.arm_b = to_b - gap * (1 - p.share);
    p.inverse_normal_mass = inverse_effective_mass(solver_a, p.arm_a, solver_b, p.arm_b, normal);
    if (friction > 0) p.inverse_tangent_mass = softest(solver_a, solver_b, p, normal);
    const Vec<D> velocity = relative_velocity(solver_a, p.arm_a, solver_b, p.arm_b);
    const double parting = glm::dot(velocity, normal);
    p.bounce = p.gap == 0 && parting < -threshold ? -restitution * parting : 0;
    p.slip = across(velocity, normal);
  }
}

template <int D>
void ContactRows<D>::warm_start(SolverBody<D>& body_a, SolverBody<D>& body_b) {
  for (ContactPoint<D>& p : points())
    p.kicked_slip = across(relative_velocity(body_a, p.arm_a, body_b, p.arm_b), normal);
  for (ContactPoint<D>& p : points()) {
    apply<D>(p, normal * p.pn + p.pt, body_a, body_b);
  }
}

template <int D>
void ContactRows<D>::solve_velocities(SolverBody<D>& body_a, SolverBody<D>& body_b, double h,
                                      Sweep& sweep) {
  for (ContactPoint<D>& p : points()) {
    if (p.inverse_normal_mass == 0) continue;
    const double parting =
        glm::dot(relative_velocity(body_a, p.arm_a, body_b, p.arm_b), normal) - p.bounce;
    // Bodies that are still apart may come as close as to touch.
    const double before = p.pn;
    p.pn = std::max(before - (parting + p.gap / h) / p.inverse_normal_mass, 0.0);
    apply<D>(p, normal * (p.pn - before), body_a, body_b);
    sweep.change = std::max(sweep.change, std::abs(p.pn - before));
    sweep.largest = std::max(sweep.largest, p.pn);
    ++sweep.normal_rows;
  }
  if (friction == 0) return;
  for (ContactPoint<D>& p : points()) {
    if (p.inverse_tangent_mass == 0 || (p.pn == 0 && p.pt == Vec<D>(0.0))) continue;
    const Vec<D> slip = across(relative_velocity(body_a, p.arm_a, body_b, p.arm_b), normal);
    const Vec<D> before = p.pt;
    p.pt -= slip / p.inverse_tangent_mass;
    const double most = friction * p.pn, length = glm::length(p.pt);
    p.sticks = length <= most * (1 + kRowSettings.slip_by_rounding);
    if (length > most) p.pt *= most / length;
    const Vec<D> impulse = p.pt - before;
    apply(p, impulse, body_a, body_b);
    sweep.change = std::max(sweep.change, glm::length(impulse));
    sweep.friction_rows += D - 1;
  }
}

template <int D>
void ContactRows<D>::begin_correction(SolverBody<D>& body_a, SolverBody<D>& body_b, double lag_a,
                                      double lag_b) {
  const ContactPoint<D>* firmest = nullptr;
  for (const ContactPoint<D>& p : points())
    if (firmest == nullptr || p.pn > firmest->pn) firmest = &p;
  for (ContactPoint<D>& p : points()) {
    p.correction = 0;
    if (friction == 0 || p.pn == 0) continue;
    if (!p.sticks) {
      // Slips through the whole sub-step, slowed evenly: the mean is half way. Where friction only
      // balances forces, nothing is slowed.
      const Vec<D> now = across(relative_velocity(body_a, p.arm_a, body_b, p.arm_b), normal);
      if (glm::length(now - p.slip) <=
          kRowSettings.hardly_slowed * glm::length(p.pt) * p.inverse_tangent_mass)
        continue;
      body_a.correct(p.pt * (0.5 - lag_a), p.arm_a);
      body_b.correct(p.pt * (lag_b - 0.5), p.arm_b);
      continue;
    }
    // A point that presses by rounding only stops when the firmest does.
    const bool hardly = p.pn <= kRowSettings.presses_by_rounding * firmest->pn && firmest->sticks;
    const double time = sliding_share(hardly ? *firmest : p, friction);
    p.wanted_slip =
        p.slip * (time / 2) + across(relative_velocity(body_a, p.arm_a, body_b, p.arm_b), normal);
  }
}

template <int D>
void ContactRows<D>::correct_positions(SolverBody<D>& body_a, SolverBody<D>& body_b, double h,
                                       Sweep& sweep) {
  for (ContactPoint<D>& p : points()) {
    if (p.inverse_normal_mass == 0) continue;
    const double parting =
        glm::dot(relative_mean_velocity(body_a, p.arm_a, body_b, p.arm_b), normal);
    const double wanted = p.wanted_mean_speed(h);
    const double before = p.correction;
    // Together with the impulse that is there already, it may push but not pull.
    const double least = p.bounce > 0 ? 0 : -p.pn;
    p.correction = std::max(before + (wanted - parting) / p.inverse_normal_mass, least);
    correct<D>(p, normal * (p.correction - before), body_a, body_b);
    sweep.change = std::max(sweep.change, std::abs(p.correction - before));
    ++sweep.normal_rows;
  }
  for (ContactPoint<D>& p : points()) {
    if (!p.sticks || p.pn == 0 || p.inverse_tangent_mass == 0) continue;
    const Vec<D> slip = across(relative_mean_velocity(body_a, p.arm_a, body_b, p.arm_b), normal);
    const Vec<D> impulse = (p.wanted_slip - slip) / p.inverse_tangent_mass;
    correct(p, impulse, body_a, body_b);
    sweep.change = std::max(sweep.change, glm::length(impulse));
    sweep.friction_rows += D - 1;
  }
}

template struct ContactRows<2>;
template struct ContactRows<3>;

}  // namespace lantern::physics
