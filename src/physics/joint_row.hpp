// One condition of a joint, as joints are solved all at once: how bodies answer to its impulse.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "physics/envelope_system.hpp"
#include "physics/solver_body.hpp"

namespace lantern::physics {

// The numbers of joints that are solved as equations.
struct JointSettings {
  double rounding = 0x1p-49;   // of the lengths and speeds that cancel: so small an error is none
  double near_rounding = 1e6;  // times that, where solving once more makes it no smaller
  int most_rounds = 40;        // of Newton's method
  double least_part = 1e-11;   // of a row, that those before it do not say
  double compliance = 1e-10;   // of rows that say the same twice
  int compliant_rounds = 4;    // in which accelerations are mended
  double wide_open = 1e-3;     // of a joint's size: a wider gap at the start is eased out by rows
  double fastest_closing = 4;  // units a second, the same
  double most_swing = 1;       // h times the frequency that the joints' tension makes, of methods
                               // that are stable only below 2
  double most_turn = 0.25;     // radians in a part, of bodies whose inertia is not alike about all
                               // axes: farther on, a joint's impulses would find other energies
  double most_gain = 1e-2;  // of kinetic energy, in a part: more is no solution of these equations
  int most_parts = 16;      // into which a step is cut if it does not converge whole
  // Of joints beside contacts: rounds in which gaps are closed, to so small a part of the way that
  // may be moved; and products for one factor.
  int closing_rounds = 8;
  double damping = 1e-2;                // of rows, where gaps close by no straight way
  double swept_compliance = 1e-6;       // of rows that say the same twice
  double shortest_sub_step = 1.0 / 64;  // of a step; joints that swing fast cut it so far
  double closed = 1e-9;
  double most_work = 4e6;
  std::size_t most_dense = 512;  // rows of implicit methods, whose matrix is full
};
inline constexpr JointSettings kJointSettings;

// An impulse of 1 pushes b along the direction and turns it by turn_b, and a the other way. Of
// bodies that cannot be moved (turned) masses (what is gained) are zero.
template <int D>
struct JointRow {
  std::uint32_t a = 0, b = 0;  // bodies
  Vec<D> direction{0.0};
  Spin<D> turn_a{0.0}, turn_b{0.0};
  Spin<D> gained_a{0.0}, gained_b{0.0};
  double mass_a = 0, mass_b = 0;  // inverse

  void set(const Vec<D>& along, const Vec<D>& arm_a, const Inertia<D>& inverse_inertia_a,
           const Vec<D>& arm_b, const Inertia<D>& inverse_inertia_b) {
    direction = along;
    turn_a = cross(arm_a, along);
    turn_b = cross(arm_b, along);
    gained_a = inverse_inertia_a * turn_a;
    gained_b = inverse_inertia_b * turn_b;
  }
};

// How much the velocity along one row changes by an impulse along another.
template <int D>
double link(const JointRow<D>& x, const JointRow<D>& y) {
  const double along = glm::dot(x.direction, y.direction);
  double sum = 0;
  if (x.a == y.a) sum += x.mass_a * along + dot(x.turn_a, y.gained_a);
  if (x.b == y.b) sum += x.mass_b * along + dot(x.turn_b, y.gained_b);
  if (x.a == y.b) sum -= x.mass_a * along + dot(x.turn_a, y.gained_b);
  if (x.b == y.a) sum -= x.mass_b * along + dot(x.turn_b, y.gained_a);
  return sum;
}

// Lays out the factor of the matrix of links, of `bodies` bodies.
template <int D>
void plan(const std::vector<JointRow<D>>& rows, std::size_t bodies, EnvelopeSystem& factor) {
  std::vector<std::size_t> first_of(bodies, rows.size());  // row of each body
  factor.clear();
  factor.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::size_t first = i;
    const auto look_at = [&](std::uint32_t body, double mass) {
      if (mass == 0) return;
      first_of[body] = std::min(first_of[body], i);
      first = std::min(first, first_of[body]);
    };
    look_at(rows[i].a, rows[i].mass_a);
    look_at(rows[i].b, rows[i].mass_b);
    factor.add_line(first);
  }
}

// False if a row says no more than those before it, but for the part `least`.
template <int D>
bool factor_rows(const std::vector<JointRow<D>>& rows, double least, EnvelopeSystem& factor) {
  return factor.factor([&](std::size_t i, std::size_t j) { return link(rows[i], rows[j]); }, least);
}

// Each row gives way by the part `compliance`. False if rows are no numbers.
template <int D>
bool factor_compliant(const std::vector<JointRow<D>>& rows, double compliance,
                      EnvelopeSystem& factor) {
  return factor.factor([&](std::size_t i, std::size_t j) {
    return link(rows[i], rows[j]) * (i == j ? 1 + compliance : 1);
  });
}

}  // namespace lantern::physics
