// The matrix of an implicit step: how the momentum that is still missing changes with the velocity,
//
//     A = M + time^2 K + time C
//
// with masses and inertias M, the stiffness K of springs and of bodies that attract each other, and
// the damping C of springs and drag.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "physics/block_system.hpp"
#include "physics/smooth_system.hpp"

namespace lantern {

// Unknowns are changes of velocity, one group a mover; if B > D, also of angular velocity.
template <int D, int B>
class MotionMatrix {
 public:
  using Row = std::array<double, B>;

  explicit MotionMatrix(const SmoothSystem<D>& system)
      : system_(system), number_(numbers(system)), blocks_(system.movers().size(), links()) {}

  // Of a state that is `time` after the start; `time_squared` may be 0, which leaves K out. False
  // if the matrix is not positive definite: springs that are compressed want to buckle. Without
  // `buckling` K leaves that out (Teran and others, "Robust quasistatic finite elements and flesh
  // simulation", 2005); what fails then is rounding, and bodies taken as `heavier` mend it.
  bool factor(const SmoothState<D>& state, double time_squared, double time, bool buckling,
              double heavier) {
    buckling_ = buckling;
    blocks_.clear();
    for (std::size_t n = 0; n < system_.movers().size(); ++n) add_body(state, time, n, heavier);
    for (std::size_t k = 0; k < system_.ends().size(); ++k)
      add_spring(state, time_squared, time, k);
    return blocks_.factor();
  }

  // Momenta to velocities. After `factor`.
  void solve(std::vector<Row>& rows) const { blocks_.solve(rows); }

  // rows -= time^2 K v: the momenta that springs give for the way that v leads in the time. K is
  // that of the last `factor`.
  void subtract_stretching(const SmoothState<D>& state, double time, std::vector<Row>& rows) const {
    for (std::size_t k = 0; k < system_.ends().size(); ++k) {
      const auto [a, b] = system_.ends()[k];
      const Stretch<D> s = system_.stretch(state, k);
      const Sides sides = sides_of(s, time * time, 0);
      const Vec<D> motion = (system_.velocity(state, b) - system_.velocity(state, a)) +
                            cross(system_.angular_velocity(state, b), s.arm_b) -
                            cross(system_.angular_velocity(state, a), s.arm_a);
      const Vec<D> momentum = sides.across * motion + (sides.along - sides.across) *
                                                          glm::dot(motion, s.direction) *
                                                          s.direction;
      const auto columns_a = columns(a, s.arm_a), columns_b = columns(b, s.arm_b);
      for (int c = 0; c < B; ++c) {
        if (system_.moves(a)) rows[number_[a]][c] += glm::dot(columns_a[c], momentum);
        if (system_.moves(b)) rows[number_[b]][c] -= glm::dot(columns_b[c], momentum);
      }
    }
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  static std::vector<std::size_t> numbers(const SmoothSystem<D>& system) {
    std::vector<std::size_t> number(system.bodies().size(), kNone);
    for (std::size_t n = 0; n < system.movers().size(); ++n) number[system.movers()[n]] = n;
    return number;
  }

  std::vector<std::pair<std::size_t, std::size_t>> links() const {
    std::vector<std::pair<std::size_t, std::size_t>> all;
    for (const auto& [a, b] : system_.ends())
      if (a != b && system_.moves(a) && system_.moves(b)) all.emplace_back(number_[a], number_[b]);
    return all;
  }

  void add_body(const SmoothState<D>& state, double time, std::size_t n, double heavier) {
    const std::size_t i = system_.movers()[n];
    const Body<D>& body = system_.bodies()[i];
    const double mass = 1 / body.inverse_mass;
    for (int r = 0; r < D; ++r) blocks_.add(n, r, r, heavier * mass + time * body.linear_drag);
    if constexpr (B > D) {
      if (!system_.turns(i)) {
        for (int r = D; r < B; ++r) blocks_.add(n, r, r, mass);  // unknowns that will be zero
      } else {
        for (int c = D; c < B; ++c) {
          const Spin<D> column = system_.inertia_times(state, i, unit_spin(c));
          for (int r = D; r < B; ++r) blocks_.add(n, r, c, heavier * component(column, r));
          blocks_.add(n, c, c, time * body.angular_drag);
        }
      }
    }
  }

  // What a spring gives for a motion of its ends along its line and across it. Along it pushes back
  // by k and c; across, a tense spring pulls straight, by tension / length, which is negative when
  // it is compressed. Of bodies that attract each other, k is negative.
  struct Sides {
    double along;
    double across;
  };
  Sides sides_of(const Stretch<D>& s, double time_squared, double time) const {
    const double stiff = time_squared * s.stiffness;
    const double along = buckling_ ? stiff : std::max(stiff, 0.0);
    if (!(s.length > 0)) return {along, along};  // no direction: alike in all
    const double across = time_squared * s.tension / s.length;
    return {along + time * s.damping, buckling_ ? across : std::max(across, 0.0)};
  }

  void add_spring(const SmoothState<D>& state, double time_squared, double time, std::size_t k) {
    const auto [a, b] = system_.ends()[k];
    if (a == b) return;
    const Stretch<D> s = system_.stretch(state, k);
    const Sides sides = sides_of(s, time_squared, time);
    const auto columns_a = columns(a, s.arm_a), columns_b = columns(b, s.arm_b);
    const auto product = [&](const Vec<D>& u, const Vec<D>& v) {
      const double un = glm::dot(u, s.direction), vn = glm::dot(v, s.direction);
      return sides.across * glm::dot(u, v) + (sides.along - sides.across) * un * vn;
    };
    const bool linked = system_.moves(a) && system_.moves(b);
    for (int r = 0; r < B; ++r) {
      for (int c = 0; c < B; ++c) {
        if (system_.moves(a)) blocks_.add(number_[a], r, c, product(columns_a[r], columns_a[c]));
        if (system_.moves(b)) blocks_.add(number_[b], r, c, product(columns_b[r], columns_b[c]));
        if (linked) blocks_.add(number_[b], number_[a], r, c, -product(columns_b[r], columns_a[c]));
      }
    }
    const Vec<D> force = time_squared * s.tension * s.direction;
    add_lever(a, s.arm_a, force);
    add_lever(b, s.arm_b, -force);
  }

  // How the end of an arm moves with each unknown.
  std::array<Vec<D>, B> columns(std::size_t i, const Vec<D>& arm) const {
    std::array<Vec<D>, B> all;
    all.fill(Vec<D>(0.0));
    for (int c = 0; c < D; ++c) all[c][c] = 1;
    if constexpr (B > D)
      if (system_.turns(i))
        for (int c = D; c < B; ++c) all[c] = cross(unit_spin(c), arm);
    return all;
  }

  // A force turns a body back that its arm has turned away from: the symmetric part of
  // (arm . force) I - arm force^T, which in 2D is all of it.
  void add_lever(std::size_t i, const Vec<D>& arm, const Vec<D>& force) {
    if constexpr (B > D) {
      if (!system_.turns(i)) return;
      const double back = glm::dot(arm, force);
      if constexpr (D == 2) {
        blocks_.add(number_[i], D, D, buckling_ ? back : std::max(back, 0.0));
      } else if (buckling_) {
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c)
            blocks_.add(number_[i], D + r, D + c,
                        (r == c ? back : 0) - (arm[r] * force[c] + arm[c] * force[r]) / 2);
      }
    }
  }

  static Spin<D> unit_spin(int c) {
    if constexpr (D == 2) {
      return 1.0;
    } else {
      Spin<D> spin(0.0);
      spin[c - D] = 1;
      return spin;
    }
  }
  static double component(const Spin<D>& spin, int r) {
    if constexpr (D == 2) {
      return spin;
    } else {
      return spin[r - D];
    }
  }

  const SmoothSystem<D>& system_;
  std::vector<std::size_t> number_;  // of a body among the movers
  BlockSystem<B> blocks_;
  bool buckling_ = true;
};

}  // namespace lantern
