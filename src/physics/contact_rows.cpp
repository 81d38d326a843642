#include "physics/contact_rows.hpp"

#include <algorithm>
#include <cmath>

namespace lantern {
namespace {

// The part of penetration that one sub-step pushes out, and at most how fast. So stiffness grows
// with the rate of sub-steps (Catto, "Soft Constraints", 2011; Macklin et al., "Small Steps in
// Physics Simulation", 2019).
constexpr double kPushedOut = 0.25;
constexpr double kFastestPush = 4;  // units a second
// Of full friction: what stops a body within so little of it does not slip in the end.
constexpr double kSlipByRounding = 1e-6;

template <int D>
Mat<D> axes_of(const Body<D>& body) {
  const bool turns = !std::holds_alternative<AxisBox<D>>(body.shape) &&
                     !std::holds_alternative<HalfSpace<D>>(body.shape);
  return turns ? matrix(body.orientation) : Mat<D>(1.0);
}

// How far the surface is from the part of the body that turns.
template <int D>
double roundness(const Shape<D>& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
  if (const auto* capsule = std::get_if<Capsule>(&shape)) return capsule->radius;
  return 0;
}

template <int D>
Vec<D> across(const Vec<D>& v, const Vec<D>& normal) {
  return v - normal * glm::dot(v, normal);
}

// The largest compliance across the normal. With it a sweep never overshoots, and where it stops,
// friction points exactly against the slip.
double softest(const Mover<2>& a, const Mover<2>& b, const ContactPoint<2>& p, const Vec<2>& n) {
  return compliance<2>(a, p.arm_a, b, p.arm_b, {-n.y, n.x});
}
double softest(const Mover<3>& a, const Mover<3>& b, const ContactPoint<3>& p, const Vec<3>& n) {
  const Vec<3> other = std::abs(n.x) < 0.6 ? Vec<3>(1, 0, 0) : Vec<3>(0, 1, 0);
  const Vec<3> s = glm::normalize(glm::cross(n, other)), t = glm::cross(n, s);
  const auto turned_by = [&](const Mover<3>& m, const Vec<3>& arm, const Vec<3>& direction) {
    return cross(m.inverse_inertia * cross(arm, direction), arm);
  };
  const Vec<3> by_s = turned_by(a, p.arm_a, s) + turned_by(b, p.arm_b, s);
  const Vec<3> by_t = turned_by(a, p.arm_a, t) + turned_by(b, p.arm_b, t);
  const double ss = glm::dot(by_s, s), tt = glm::dot(by_t, t), st = glm::dot(by_s, t);
  const double mean = (ss + tt) / 2, half = (ss - tt) / 2;
  return a.inverse_mass + b.inverse_mass + mean + std::sqrt(half * half + st * st);
}

}  // namespace

template <int D>
void set_points(ContactRows<D>& rows, const Manifold<D>& manifold, const Body<D>& a,
                const Body<D>& b, const Contact<D>* remembered, double scale) {
  rows.normal = manifold.normal;
  rows.count = manifold.count;
  rows.share = a.inverse_mass == 0 ? 1 : b.inverse_mass == 0 ? 0 : 0.5;
  const Mat<D> axes_a = axes_of(a), axes_b = axes_of(b);
  for (int i = 0; i < manifold.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const ManifoldPoint<D>& from = manifold.room[at];
    ContactPoint<D> p;
    p.feature = from.feature;
    p.round_a = rows.normal * roundness<D>(a.shape);
    p.round_b = rows.normal * -roundness<D>(b.shape);
    const Vec<D> half_gap = rows.normal * (from.separation / 2);
    const Vec<D> to_a = from.position - half_gap - a.position;
    const Vec<D> to_b = from.position + half_gap - b.position;
    p.core_a = (to_a - p.round_a) * axes_a;  // a vector times a matrix: by its inverse
    p.core_b = (to_b - p.round_b) * axes_b;
    p.offset = from.separation - glm::dot(rows.normal, (b.position - a.position) + to_b - to_a);
    if (remembered != nullptr)
      for (int j = 0; j < remembered->manifold.count; ++j) {
        const auto old = static_cast<std::size_t>(j);
        if (remembered->manifold.room[old].feature != p.feature) continue;
        p.pn = remembered->normal_impulses[old] * scale;
        p.pt = across(remembered->friction_impulses[old] * scale, rows.normal);
      }
    rows.room[at] = p;
  }
}

template <int D>
void refresh(ContactRows<D>& rows, const Body<D>& a, const Body<D>& b, const Mover<D>& mover_a,
             const Mover<D>& mover_b, double threshold, double touching) {
  const Mat<D> axes_a = axes_of(a), axes_b = axes_of(b);
  for (ContactPoint<D>& p : rows.points()) {
    const Vec<D> to_a = axes_a * p.core_a + p.round_a, to_b = axes_b * p.core_b + p.round_b;
    const Vec<D> gap = (b.position - a.position) + to_b - to_a;
    p.separation = glm::dot(rows.normal, gap) + p.offset;
    p.gap = p.separation > touching ? p.separation : 0;
    p.arm_a = to_a + gap * rows.share;
    p.arm_b = to_b - gap * (1 - rows.share);
    p.normal_compliance = compliance(mover_a, p.arm_a, mover_b, p.arm_b, rows.normal);
    if (rows.friction > 0) p.tangent_compliance = softest(mover_a, mover_b, p, rows.normal);
    const Vec<D> velocity = relative_velocity(mover_a, p.arm_a, mover_b, p.arm_b);
    const double parting = glm::dot(velocity, rows.normal);
    p.bounce = p.gap == 0 && parting < -threshold ? -rows.restitution * parting : 0;
    p.slip = across(velocity, rows.normal);
  }
}

template <int D>
void warm_start(ContactRows<D>& rows, Mover<D>& a, Mover<D>& b) {
  for (ContactPoint<D>& p : rows.points())
    p.kicked_slip = across(relative_velocity(a, p.arm_a, b, p.arm_b), rows.normal);
  for (ContactPoint<D>& p : rows.points()) {
    const Vec<D> impulse = rows.normal * p.pn + p.pt;
    a.apply(-impulse, p.arm_a);
    b.apply(impulse, p.arm_b);
  }
}

template <int D>
void sweep_velocities(ContactRows<D>& rows, Mover<D>& a, Mover<D>& b, double h, Sweep& sweep) {
  for (ContactPoint<D>& p : rows.points()) {
    if (p.normal_compliance == 0) continue;
    const double parting =
        glm::dot(relative_velocity(a, p.arm_a, b, p.arm_b), rows.normal) - p.bounce;
    // Bodies that are still apart may come as close as to touch.
    const double before = p.pn;
    p.pn = std::max(before - (parting + p.gap / h) / p.normal_compliance, 0.0);
    const Vec<D> impulse = rows.normal * (p.pn - before);
    a.apply(-impulse, p.arm_a);
    b.apply(impulse, p.arm_b);
    sweep.change = std::max(sweep.change, std::abs(p.pn - before));
    sweep.largest = std::max(sweep.largest, p.pn);
    ++sweep.rows;
  }
  if (rows.friction == 0) return;
  for (ContactPoint<D>& p : rows.points()) {
    if (p.tangent_compliance == 0 || (p.pn == 0 && p.pt == Vec<D>(0.0))) continue;
    const Vec<D> slip = across(relative_velocity(a, p.arm_a, b, p.arm_b), rows.normal);
    const Vec<D> before = p.pt;
    p.pt -= slip / p.tangent_compliance;
    const double most = rows.friction * p.pn, length = glm::length(p.pt);
    p.sticks = length <= most * (1 + kSlipByRounding);
    if (length > most) p.pt *= most / length;
    const Vec<D> impulse = p.pt - before;
    a.apply(-impulse, p.arm_a);
    b.apply(impulse, p.arm_b);
    sweep.change = std::max(sweep.change, glm::length(impulse));
    sweep.rows += D - 1;
    sweep.friction_rows += D - 1;
  }
}

namespace {

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
void begin_carrying(ContactRows<D>& rows, Mover<D>& a, Mover<D>& b, double lag_a, double lag_b) {
  const ContactPoint<D>* firmest = nullptr;
  for (const ContactPoint<D>& p : rows.points())
    if (firmest == nullptr || p.pn > firmest->pn) firmest = &p;
  for (ContactPoint<D>& p : rows.points()) {
    p.carried = 0;
    if (rows.friction == 0 || p.pn == 0) continue;
    if (!p.sticks) {
      // Slips through the whole sub-step, slowed evenly: the mean is half way.
      a.carry(p.pt * (0.5 - lag_a), p.arm_a);
      b.carry(p.pt * (lag_b - 0.5), p.arm_b);
      continue;
    }
    // A point that presses by rounding only stops when the firmest does.
    const bool hardly = p.pn <= 1e-9 * firmest->pn && firmest->sticks;
    const double time = sliding_share(hardly ? *firmest : p, rows.friction);
    p.wanted_slip =
        p.slip * (time / 2) + across(relative_velocity(a, p.arm_a, b, p.arm_b), rows.normal);
  }
}

template <int D>
double wanted_carriage(const ContactPoint<D>& point, double h) {
  if (point.gap > 0) return -point.gap / h;
  return std::min(-point.separation * kPushedOut / h, kFastestPush);
}

template <int D>
void sweep_carriage(ContactRows<D>& rows, Mover<D>& a, Mover<D>& b, double h, Sweep& sweep) {
  for (ContactPoint<D>& p : rows.points()) {
    if (p.normal_compliance == 0) continue;
    const double parting = glm::dot(relative_carriage(a, p.arm_a, b, p.arm_b), rows.normal);
    const double wanted = wanted_carriage(p, h);
    const double before = p.carried;
    // Together with the impulse that is there already, it may push but not pull.
    const double least = p.bounce > 0 ? 0 : -p.pn;
    p.carried = std::max(before + (wanted - parting) / p.normal_compliance, least);
    const Vec<D> impulse = rows.normal * (p.carried - before);
    a.carry(-impulse, p.arm_a);
    b.carry(impulse, p.arm_b);
    sweep.change = std::max(sweep.change, std::abs(p.carried - before));
    ++sweep.rows;
  }
  for (ContactPoint<D>& p : rows.points()) {
    if (!p.sticks || p.pn == 0 || p.tangent_compliance == 0) continue;
    const Vec<D> slip = across(relative_carriage(a, p.arm_a, b, p.arm_b), rows.normal);
    const Vec<D> impulse = (p.wanted_slip - slip) / p.tangent_compliance;
    a.carry(-impulse, p.arm_a);
    b.carry(impulse, p.arm_b);
    sweep.change = std::max(sweep.change, glm::length(impulse));
    sweep.rows += D - 1;
    sweep.friction_rows += D - 1;
  }
}

#define LANTERN_INSTANTIATE(D)                                                                  \
  template void set_points(ContactRows<D>&, const Manifold<D>&, const Body<D>&, const Body<D>&, \
                           const Contact<D>*, double);                                          \
  template void refresh(ContactRows<D>&, const Body<D>&, const Body<D>&, const Mover<D>&,       \
                        const Mover<D>&, double, double);                                       \
  template void warm_start(ContactRows<D>&, Mover<D>&, Mover<D>&);                              \
  template void sweep_velocities(ContactRows<D>&, Mover<D>&, Mover<D>&, double, Sweep&);        \
  template void begin_carrying(ContactRows<D>&, Mover<D>&, Mover<D>&, double, double);          \
  template double wanted_carriage(const ContactPoint<D>&, double);                              \
  template void sweep_carriage(ContactRows<D>&, Mover<D>&, Mover<D>&, double, Sweep&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern
