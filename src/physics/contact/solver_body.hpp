// A body while constraints are solved: just its velocities and what resists their change; and the
// rows of constraints that are solved all at once.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/scratch.hpp"
#include "base/stop.hpp"
#include "physics/body.hpp"
#include "physics/world_config.hpp"

namespace lantern::physics {

template <int D>
struct Motion {
  Vec<D> velocity{0.0};
  Spin<D> spin{0.0};
};

template <int D>
struct SolverBody : Motion<D> {
  double inverse_mass = 0;
  Inertia<D> inverse_inertia{0.0};
  Spin<D> twist{0.0};  // angular momentum gained from constraints
  // How the body really moves over the sub-step: its mean velocities. They differ from its own by
  // what pushes out penetration, which must not become motion (split impulses).
  Motion<D> mean;
  Spin<D> lag{0.0};           // of the angular momentum while the body turns, see Increment
  Spin<D> turning_spin{0.0};  // the mean spin that this gives

  void apply(const Vec<D>& impulse, const Vec<D>& arm) {
    const Spin<D> turn = cross(arm, impulse);
    this->velocity += impulse * inverse_mass;
    this->spin += inverse_inertia * turn;
    twist += turn;
  }
  void correct(const Vec<D>& impulse, const Vec<D>& arm) {
    mean.velocity += impulse * inverse_mass;
    mean.spin += inverse_inertia * cross(arm, impulse);
  }
};

template <int D>
inline Vec<D> relative_velocity(const Motion<D>& a, const Vec<D>& arm_a, const Motion<D>& b,
                                const Vec<D>& arm_b) {
  return (b.velocity + cross(b.spin, arm_b)) - (a.velocity + cross(a.spin, arm_a));
}

template <int D>
Vec<D> unit_vec(int axis) {
  Vec<D> unit(0.0);
  unit[axis] = 1;
  return unit;
}

// Unit vectors across a unit vector and each other.
inline std::array<Vec<2>, 1> tangents(const Vec<2>& n) { return {Vec<2>(-n.y, n.x)}; }
inline std::array<Vec<3>, 2> tangents(const Vec<3>& n) {
  const Vec<3> other = std::abs(n.x) < 0.6 ? Vec<3>(1, 0, 0) : Vec<3>(0, 1, 0);
  const Vec<3> s = glm::normalize(glm::cross(n, other));
  return {s, glm::cross(n, s)};
}

// How much relative velocity along `direction` an impulse of 1 along it gives: the inverse of the
// effective mass.
template <int D>
inline double inverse_effective_mass(const SolverBody<D>& a, const Vec<D>& arm_a,
                                     const SolverBody<D>& b, const Vec<D>& arm_b,
                                     const Vec<D>& direction) {
  const Spin<D> turn_a = cross(arm_a, direction), turn_b = cross(arm_b, direction);
  return a.inverse_mass + b.inverse_mass + dot(turn_a, a.inverse_inertia * turn_a) +
         dot(turn_b, b.inverse_inertia * turn_b);
}

// Symmetric positive definite linear equations, solved directly by Cholesky factors. Each line of
// the factor begins where the matrix's does (an envelope: Jennings, "A Compact Storage Scheme",
// 1966), so that a chain or a stack, numbered from end to end, costs time in proportion to its
// length.
class EnvelopeSystem {
 public:
  void clear() {
    first_.clear();
    start_.clear();
    entries_.clear();
    work_ = 0;
  }

  // Room for so many lines, if they are short.
  void reserve(std::size_t lines) {
    constexpr std::size_t kShort = 8;
    first_.reserve(lines);
    start_.reserve(lines);
    entries_.reserve(lines * kShort);
  }

  // The next line has nothing before the column `first`, which is no further than its diagonal.
  void add_line(std::size_t first) {
    const std::size_t length = first_.size() - first + 1;
    first_.push_back(first);
    start_.push_back(entries_.size());
    entries_.resize(entries_.size() + length);
    work_ += static_cast<double>(length) * static_cast<double>(length) / 2;
  }

  std::size_t lines() const { return first_.size(); }
  double work() const { return work_; }  // products that a factor takes, about

  // Finds the factor of the matrix whose entries are matrix(line, column), asked for once each, up
  // to the diagonal. False if it is not positive definite, or if of a line no more than the part
  // `least` is left by what those before it say.
  template <class Matrix>
  bool factor(Matrix&& matrix, double least = 0) {
    for (std::size_t i = 0; i < lines(); ++i) {
      stop_if_asked();
      double* line_i = &entries_[start_[i]];
      for (std::size_t j = first_[i]; j <= i; ++j) {
        const double* line_j = &entries_[start_[j]];
        double value = matrix(i, j);
        const double whole = value;
        for (std::size_t k = std::max(first_[i], first_[j]); k < j; ++k)
          value -= line_i[k - first_[i]] * line_j[k - first_[j]];
        if (i == j && !(value > least * whole)) return false;
        line_i[j - first_[i]] = i == j ? std::sqrt(value) : value / line_j[j - first_[j]];
      }
    }
    return true;
  }

  // Replaces the right-hand side by the solution. After `factor`.
  void solve(Scratch<double>& values) const {
    for (std::size_t i = 0; i < lines(); ++i) {
      stop_if_asked();
      const double* line = &entries_[start_[i]];
      double value = values[i];
      for (std::size_t j = first_[i]; j < i; ++j) value -= line[j - first_[i]] * values[j];
      values[i] = value / line[i - first_[i]];
    }
    for (std::size_t i = lines(); i-- > 0;) {
      const double* line = &entries_[start_[i]];
      values[i] /= line[i - first_[i]];
      for (std::size_t j = first_[i]; j < i; ++j) values[j] -= line[j - first_[i]] * values[i];
    }
  }

 private:
  Scratch<std::size_t> first_, start_;  // of each line: its first column, and where it is kept
  Scratch<double> entries_;             // of the factor
  double work_ = 0;
};

// One condition, as rows are solved all at once. An impulse of 1 pushes b along the direction and
// turns it by turn_b, and a the other way. Of bodies that cannot be moved (turned) masses (what is
// gained) are zero.
template <int D>
struct ConstraintRow {
  std::uint32_t a = 0, b = 0;     // bodies
  double mass_a = 0, mass_b = 0;  // inverse
  Vec<D> direction{0.0};
  Spin<D> turn_a{0.0}, turn_b{0.0};
  Spin<D> gained_a{0.0}, gained_b{0.0};

  void set(const Vec<D>& along, const Vec<D>& arm_a, const Inertia<D>& inverse_inertia_a,
           const Vec<D>& arm_b, const Inertia<D>& inverse_inertia_b) {
    direction = along;
    turn_a = cross(arm_a, along);
    turn_b = cross(arm_b, along);
    gained_a = inverse_inertia_a * turn_a;
    gained_b = inverse_inertia_b * turn_b;
  }
  // How much the velocity along this row changes by an impulse along another.
  double answer_to(const ConstraintRow& y) const {
    const double along = glm::dot(direction, y.direction);
    double sum = 0;
    if (a == y.a) sum += mass_a * along + dot(turn_a, y.gained_a);
    if (b == y.b) sum += mass_b * along + dot(turn_b, y.gained_b);
    if (a == y.b) sum -= mass_a * along + dot(turn_a, y.gained_b);
    if (b == y.a) sum -= mass_b * along + dot(turn_b, y.gained_a);
    return sum;
  }
};

// Gives the bodies the impulses of all rows: to their velocities, or to their mean velocities
// alone.
template <int D>
void apply_rows(const Scratch<ConstraintRow<D>>& rows, const Scratch<double>& impulses,
                Scratch<SolverBody<D>>& bodies, bool to_mean) {
  const auto apply = [&](SolverBody<D>& body, const Vec<D>& direction, const Spin<D>& turn,
                         const Spin<D>& gained, double size) {
    Motion<D>& motion = to_mean ? body.mean : body;
    motion.velocity += direction * (size * body.inverse_mass);
    motion.spin += gained * size;
    if (!to_mean) body.twist += turn * size;
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ConstraintRow<D>& row = rows[i];
    apply(bodies[row.a], row.direction, row.turn_a, row.gained_a, -impulses[i]);
    apply(bodies[row.b], row.direction, row.turn_b, row.gained_b, impulses[i]);
  }
}

// Lays out the factor of the matrix of all rows' answers to each other, of `bodies` bodies. False
// as soon as it would take more than `most_work` products.
template <int D>
bool plan(const Scratch<ConstraintRow<D>>& rows, std::size_t bodies, EnvelopeSystem& factor,
          double most_work = std::numeric_limits<double>::infinity()) {
  Scratch<std::size_t> first_of(bodies, rows.size());  // row of each body
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
    if (factor.work() > most_work) return false;
  }
  return true;
}

// False if a row says no more than those before it, but for the part `least`.
template <int D>
bool factor_rows(const Scratch<ConstraintRow<D>>& rows, double least, EnvelopeSystem& factor) {
  return factor.factor([&](std::size_t i, std::size_t j) { return rows[i].answer_to(rows[j]); },
                       least);
}

// Each row gives way by the part `compliance`. False if rows are no numbers.
template <int D>
bool factor_compliant(const Scratch<ConstraintRow<D>>& rows, double compliance,
                      EnvelopeSystem& factor) {
  return factor.factor([&](std::size_t i, std::size_t j) {
    return rows[i].answer_to(rows[j]) * (i == j ? 1 + compliance : 1);
  });
}

inline void count_direct_solve(std::size_t rows, WorldWork& work) {
  ++work.direct_solves;
  work.direct_rows += rows;
}

}  // namespace lantern::physics
