// The matrix of an implicit step: how the momentum that is still missing changes with the velocity,
//
//     A = M + time^2 K + time C
//
// with masses and inertias M, the stiffness K of the springs, and the damping C of springs and
// drag.
#pragma once

#include <algorithm>
#include <vector>

#include "physics/block_system.hpp"
#include "physics/smooth_system.hpp"

namespace lantern {

enum class Stiffness {
  none,       // K = 0: only velocities are unknown, places are known
  exact,      // K is the true derivative, perhaps not positive: a compressed spring wants to buckle
  projected,  // what is negative is left out (Teran and others, "Robust quasistatic finite elements
              // and flesh simulation", 2005), so that A is positive definite
};

// Unknowns are changes of velocity, one group a mover; if B > D, also of angular velocity.
template <int D, int B>
class MotionMatrix {
 public:
  using Row = std::array<double, B>;

  explicit MotionMatrix(const SmoothSystem<D>& system)
      : system_(system), number_(numbers(system)), blocks_(system.movers().size(), links()) {}

  // At a state that is `time` after the start. False if not positive definite, which can only be
  // with exact stiffness.
  bool factor(const SmoothState<D>& state, double time, Stiffness stiffness) {
    blocks_.clear();
    for (std::size_t n = 0; n < system_.movers().size(); ++n) add_body(state, time, n);
    for (std::size_t k = 0; k < system_.ends().size(); ++k) add_spring(state, time, stiffness, k);
    return blocks_.factor(stiffness != Stiffness::exact);
  }

  // Momenta to velocities. After `factor`.
  void solve(std::vector<Row>& rows) const { blocks_.solve(rows); }

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

  void add_body(const SmoothState<D>& state, double time, std::size_t n) {
    const std::size_t i = system_.movers()[n];
    const Body<D>& body = system_.bodies()[i];
    const double mass = 1 / body.inverse_mass;
    for (int r = 0; r < D; ++r) blocks_.add(n, r, r, mass + time * body.linear_drag);
    double least = mass;
    if constexpr (B > D) {
      if (!system_.turns(i)) {
        for (int r = D; r < B; ++r) blocks_.add(n, r, r, mass);  // unknowns that will be zero
      } else {
        for (int c = D; c < B; ++c) {
          const Spin<D> column = system_.inertia_times(state, i, unit_spin(c));
          for (int r = D; r < B; ++r) blocks_.add(n, r, c, component(column, r));
          blocks_.add(n, c, c, time * body.angular_drag);
        }
        if constexpr (D == 2) {
          least = std::min(least, 1 / body.inverse_inertia);
        } else {
          for (int k = 0; k < 3; ++k) least = std::min(least, 1 / body.inverse_inertia[k]);
        }
      }
    }
    blocks_.set_least(n, least);
  }

  // A spring pushes back along its line by k and c. Sideways a tense spring pulls straight: by
  // tension / length, which is negative when compressed.
  void add_spring(const SmoothState<D>& state, double time, Stiffness stiffness, std::size_t k) {
    const auto [a, b] = system_.ends()[k];
    if (a == b) return;
    const Spring<D>& spring = system_.forces().springs[k];
    const Stretch<D> s = system_.stretch(state, k);
    const double squared = stiffness == Stiffness::none ? 0 : time * time;
    double along = squared * spring.stiffness + time * spring.damping;
    double sideways = s.length > 0 ? squared * s.tension / s.length : 0;
    if (!(s.length > 0)) along = sideways = spring.rest_length > 0 ? 0 : squared * spring.stiffness;
    if (stiffness != Stiffness::exact) sideways = std::max(sideways, 0.0);

    const auto columns_a = columns(a, s.arm_a), columns_b = columns(b, s.arm_b);
    const auto product = [&](const Vec<D>& u, const Vec<D>& v) {
      const double un = glm::dot(u, s.direction), vn = glm::dot(v, s.direction);
      return sideways * glm::dot(u, v) + (along - sideways) * un * vn;
    };
    const bool linked = system_.moves(a) && system_.moves(b);
    for (int r = 0; r < B; ++r) {
      for (int c = 0; c < B; ++c) {
        if (system_.moves(a)) blocks_.add(number_[a], r, c, product(columns_a[r], columns_a[c]));
        if (system_.moves(b)) blocks_.add(number_[b], r, c, product(columns_b[r], columns_b[c]));
        if (linked) blocks_.add(number_[b], number_[a], r, c, -product(columns_b[r], columns_a[c]));
      }
    }
    const Vec<D> force = squared * s.tension * s.direction;
    add_lever(a, s.arm_a, force, stiffness);
    add_lever(b, s.arm_b, -force, stiffness);
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
  void add_lever(std::size_t i, const Vec<D>& arm, const Vec<D>& force, Stiffness stiffness) {
    if constexpr (B > D) {
      if (!system_.turns(i)) return;
      const double back = glm::dot(arm, force);
      if constexpr (D == 2) {
        blocks_.add(number_[i], D, D, stiffness == Stiffness::exact ? back : std::max(back, 0.0));
      } else if (stiffness == Stiffness::exact) {
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
};

}  // namespace lantern
