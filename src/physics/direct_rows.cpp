// Which rows a direct solve has: those of joints, of contacts that press, and of welds.
#include <algorithm>
#include <cmath>
#include <span>

#include "physics/direct_solve.hpp"
#include "physics/small_cholesky.hpp"

namespace lantern::physics {
namespace {

template <int D>
Vec<D> axis_of(int axis) {
  Vec<D> unit(0.0);
  unit[axis] = 1;
  return unit;
}

}  // namespace

template <int D>
void DirectSolve<D>::add_row(const Island<D>& island, Row row) {
  row.gained_a = island.solver_bodies[row.a].inverse_inertia * row.turn_a;
  row.gained_b = island.solver_bodies[row.b].inverse_inertia * row.turn_b;
  rows_.push_back(row);
}

template <int D>
void DirectSolve<D>::add_rows_of_their_own(const Island<D>& island, std::size_t first_part) {
  for (std::size_t i = first_part; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    part.row = rows_.size();
    add_row(island, {part.a, part.b, part.direction, cross(part.arm_a, part.direction),
                     cross(part.arm_b, part.direction)});
  }
}

// The wrench w of a part about the middle is its impulse times the column g. Of all gains that give
// the weld's wrench W, those with the least squares are gains = G^T (G G^T)^-1 W; and where the
// parts want different things of the weld, (G G^T)^-1 G is the least squares' way between them. So
// the shares (G G^T)^-1 g serve both ways.
template <int D>
bool DirectSolve<D>::add_weld(const Island<D>& island, std::size_t first_part) {
  const std::span<Part> parts{parts_.data() + first_part, parts_.size() - first_part};
  const std::uint32_t a = parts[0].a, b = parts[0].b;
  const auto turns = [&](std::uint32_t body) {
    return island.solver_bodies[body].inverse_mass != 0 &&
           island.bodies[body].turns_about_every_axis();
  };
  if (parts.size() <= kFreedoms || (!turns(a) && !turns(b))) return false;
  Vec<D> middle_a(0.0), middle_b(0.0);
  for (const Part& part : parts) {
    middle_a += part.arm_a / static_cast<double>(parts.size());
    middle_b += part.arm_b / static_cast<double>(parts.size());
  }
  double size = 0;
  for (const Part& part : parts) size = std::max(size, glm::length(part.arm_a - middle_a));
  if (!(size > 0)) return false;

  SmallMatrix<kFreedoms> square{};
  for (Part& part : parts) {
    const Spin<D> torque = cross(part.arm_a - middle_a, part.direction);
    for (int k = 0; k < kFreedoms; ++k)
      part.share[k] = k < D ? part.direction[k] : spin_component(torque, k - D) / size;
    for (int r = 0; r < kFreedoms; ++r)
      for (int c = 0; c <= r; ++c) square[r * kFreedoms + c] += part.share[r] * part.share[c];
  }
  if (!factor_small<kFreedoms>(square, kDirectSettings.least_spread)) {
    for (Part& part : parts) part.share = {1};
    return false;
  }
  for (Part& part : parts) {
    solve_lower<kFreedoms>(square, part.share);
    solve_upper<kFreedoms>(square, part.share);
    part.width = kFreedoms;
    part.row = rows_.size();
  }
  for (int k = 0; k < D; ++k) {
    const Vec<D> axis = axis_of<D>(k);
    add_row(island, {a, b, axis, cross(middle_a, axis), cross(middle_b, axis)});
  }
  for (int k = D; k < kFreedoms; ++k) {
    const Spin<D> turn = size * unit_spin<D>(k - D);
    add_row(island, {a, b, Vec<D>(0.0), turn, turn});
  }
  return true;
}

template <int D>
void DirectSolve<D>::list_joint(const Island<D>& island, JointRows<D>& joint) {
  Part part{
      .a = joint.a, .b = joint.b, .joint = &joint, .arm_a = joint.arm_a, .arm_b = joint.arm_b};
  const std::size_t first = parts_.size();
  if (joint.joint.kind == JointKind::pin) {
    for (int axis = 0; axis < D; ++axis) {
      part.direction = axis_of<D>(axis);
      parts_.push_back(part);
    }
  } else if (joint.inverse_mass > 0) {
    part.direction = joint.direction;
    parts_.push_back(part);
  }
  add_rows_of_their_own(island, first);
}

template <int D>
void DirectSolve<D>::list_contact(const Island<D>& island, ContactRows<D>& contact) {
  const auto across = tangents(contact.normal);
  const std::size_t first = parts_.size();
  for (ContactPoint<D>& point : contact.points()) {
    if (!(point.pn > 0) || !(point.inverse_normal_mass > 0)) continue;
    Part part{.a = contact.a,
              .b = contact.b,
              .point = &point,
              .arm_a = point.arm_a,
              .arm_b = point.arm_b,
              .direction = contact.normal};
    parts_.push_back(part);
    if (contact.friction == 0 || !point.sticks) continue;
    part.most = contact.friction;
    for (const Vec<D>& tangent : across) {
      ++part.tangent;
      part.direction = tangent;
      parts_.push_back(part);
    }
  }
  if (first < parts_.size() && !add_weld(island, first)) add_rows_of_their_own(island, first);
}

template <int D>
void DirectSolve<D>::list_rows(Island<D>& island) {
  rows_.clear();
  parts_.clear();
  for (JointRows<D>& joint : island.joints) list_joint(island, joint);
  for (IslandPair<D>& pair : island.pairs) list_contact(island, pair.rows);
}

template void DirectSolve<2>::list_rows(Island<2>&);
template void DirectSolve<3>::list_rows(Island<3>&);

}  // namespace lantern::physics
