// What the implicit methods share: velocities that must agree with the forces they lead to.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "base/scratch.hpp"
#include "physics/integrate/block_system.hpp"
#include "physics/integrate/smooth_system.hpp"

namespace lantern::physics {

enum class LinearSolver {
  by_size,    // direct up to kMostFactorBytes, and up to kMostAttracting bodies
  direct,     // BlockSystem
  iterative,  // BlockIteration
};

inline constexpr std::size_t kMostFactorBytes = std::size_t{64} << 20;
// A factor for n bodies that all attract each other takes n^3 / 6 products of blocks, a step of an
// iteration n^2 / 2 products of a block with a vector.
inline constexpr std::size_t kMostAttracting = 512;

template <int D>
constexpr int kTurning = D == 2 ? 3 : 6;  // unknowns of a body that turns

// What ties two bodies besides the springs: a joint, whose tension turns as its bodies do. Of a pin
// the length is 0, and only its levers count.
template <int D>
struct Tie {
  Ends ends;
  Stretch<D> stretch;
};

// The matrix of an implicit step: how the momentum that is still missing changes with the velocity,
//
//     A = M + time^2 K + time C
//
// with masses and inertias M, the stiffness K of springs and of bodies that attract each other, and
// the damping C of springs and drag.
//
// It is factored where its factor is small, and never kept where very many attract each other or
// are tied together: there the equations are solved step by step.
//
// Unknowns are changes of velocity, one group a mover; if B > D, also of angular velocity.
template <int D, int B>
class MotionMatrix {
 public:
  using Row = std::array<double, B>;

  // The ties may change between two factors, but not their ends; they must outlive the matrix.
  MotionMatrix(const SmoothSystem<D>& system, LinearSolver solver,
               std::span<const Tie<D>> ties = {})
      : system_(system), ties_(ties) {
    const std::size_t count = system.movers().size();
    const bool all_linked = system.any_attraction() && count > kMostAttracting;
    if (solver == LinearSolver::direct || (solver == LinearSolver::by_size && !all_linked))
      blocks_ = BlockSystem<B>::planned(
          count, links(), solver == LinearSolver::direct ? std::size_t(-1) : kMostFactorBytes);
    if (!blocks_) iteration_.emplace(count);
  }

  // Of a state that is `time` after the start, and that must stay as it is until the equations are
  // solved; `time_squared` may be 0, which leaves K out. False if the matrix is not positive
  // definite: springs that are compressed want to buckle. Without `buckling` K leaves that out
  // (Teran and others, "Robust quasistatic finite elements and flesh simulation", 2005); what fails
  // then is rounding, and bodies taken as `heavier` mend it.
  bool factor(const SmoothState<D>& state, double time_squared, double time, bool buckling,
              double heavier) {
    buckling_ = buckling;
    state_ = &state;
    time_squared_ = time_squared;
    time_ = time;
    return blocks_ ? fill(*blocks_, heavier) : fill(*iteration_, heavier);
  }

  // Momenta to velocities: to rounding if the solution is direct, else up to about `tolerance` of
  // the momenta. After `factor`. False if only now the matrix is found not to be positive definite.
  bool solve(Scratch<Row>& rows, double tolerance) const {
    if (!blocks_)
      return iteration_->solve(rows, tolerance, [&](const auto& x, auto& y) { add_links(x, y); });
    blocks_->solve(rows);
    return true;
  }

  // rows -= time^2 K v: the momenta that springs give for the way that v leads in the time. K is
  // that of the last `factor`.
  void subtract_stretching(const SmoothState<D>& state, double time, Scratch<Row>& rows) const {
    system_.each_stretch(state, [&](const Ends& ends, const Stretch<D>& s, double) {
      const auto [a, b] = ends;
      const Sides sides = sides_of(s, time * time, 0);
      const Vec<D> motion = (system_.velocity(state, b) - system_.velocity(state, a)) +
                            cross(system_.angular_velocity(state, b), s.arm_b) -
                            cross(system_.angular_velocity(state, a), s.arm_a);
      const Vec<D> momentum = sides.momentum(motion, s.direction);
      const auto columns_a = columns(a, s.arm_a), columns_b = columns(b, s.arm_b);
      for (int c = 0; c < B; ++c) {
        if (system_.moves(a)) rows[system_.number(a)][c] += glm::dot(columns_a[c], momentum);
        if (system_.moves(b)) rows[system_.number(b)][c] -= glm::dot(columns_b[c], momentum);
      }
    });
  }

 private:
  Scratch<std::pair<std::size_t, std::size_t>> links() const {
    Scratch<std::pair<std::size_t, std::size_t>> all;
    const auto add = [&](const Ends& ends) {
      const auto [a, b] = ends;
      if (a != b && system_.moves(a) && system_.moves(b))
        all.emplace_back(system_.number(a), system_.number(b));
    };
    system_.each_two(add);
    for (const Tie<D>& tie : ties_) add(tie.ends);
    return all;
  }

  // f(ends, stretch) of springs, of what attracts each other, of ties.
  template <class F>
  void each_stretch(F&& f) const {
    system_.each_stretch(*state_,
                         [&](const Ends& ends, const Stretch<D>& s, double) { f(ends, s); });
    for (const Tie<D>& tie : ties_) f(tie.ends, tie.stretch);
  }

  template <class Blocks>
  bool fill(Blocks& blocks, double heavier) {
    blocks.clear();
    for (std::size_t n = 0; n < system_.movers().size(); ++n) add_body(blocks, n, heavier);
    each_stretch([&](const Ends& ends, const Stretch<D>& s) { add_spring(blocks, ends, s); });
    return blocks.factor();
  }

  template <class Blocks>
  void add_body(Blocks& blocks, std::size_t n, double heavier) {
    const std::size_t i = system_.movers()[n];
    const Body<D>& body = system_.bodies()[i];
    const double mass = 1 / (body.inverse_mass * system_.gained(i));
    for (int r = 0; r < D; ++r)
      blocks.add(n, r, r, heavier * mass + time_ * system_.linear_drag(i));
    if constexpr (B > D) {
      if (!system_.turns(i)) {
        for (int r = D; r < B; ++r) blocks.add(n, r, r, mass);  // unknowns that will be zero
      } else {
        for (int c = D; c < B; ++c) {
          const Spin<D> column = system_.inertia_times(*state_, i, unit_spin<D>(c - D));
          for (int r = D; r < B; ++r) blocks.add(n, r, c, heavier * spin_component(column, r - D));
          blocks.add(n, c, c, time_ * system_.angular_drag(i));
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
    Vec<D> momentum(const Vec<D>& motion, const Vec<D>& line) const {
      return across * motion + (along - across) * glm::dot(motion, line) * line;
    }
  };
  Sides sides_of(const Stretch<D>& s, double time_squared, double time) const {
    const double stiff = time_squared * s.stiffness;
    const double along = buckling_ ? stiff : std::max(stiff, 0.0);
    if (!(s.length > 0)) return {along, along};  // no direction: alike in all
    const double across = time_squared * s.tension / s.length;
    return {along + time * s.damping, buckling_ ? across : std::max(across, 0.0)};
  }

  template <class Blocks>
  void add_spring(Blocks& blocks, const Ends& ends, const Stretch<D>& s) {
    const auto [a, b] = ends;
    if (a == b) return;
    const Sides sides = sides_of(s, time_squared_, time_);
    const auto columns_a = columns(a, s.arm_a), columns_b = columns(b, s.arm_b);
    const auto product = [&](const Vec<D>& u, const Vec<D>& v) {
      const double un = glm::dot(u, s.direction), vn = glm::dot(v, s.direction);
      return sides.across * glm::dot(u, v) + (sides.along - sides.across) * un * vn;
    };
    const bool linked = system_.moves(a) && system_.moves(b);
    for (int r = 0; r < B; ++r) {
      for (int c = 0; c < B; ++c) {
        if (system_.moves(a))
          blocks.add(system_.number(a), r, c, product(columns_a[r], columns_a[c]));
        if (system_.moves(b))
          blocks.add(system_.number(b), r, c, product(columns_b[r], columns_b[c]));
        if (linked)
          blocks.add(system_.number(b), system_.number(a), r, c,
                     -product(columns_b[r], columns_a[c]));
      }
    }
    const Vec<D> force = time_squared_ * s.tension * s.direction;
    add_lever(blocks, a, s.arm_a, force);
    add_lever(blocks, b, s.arm_b, -force);
  }

  // y += (A without its diagonal blocks) x: what a motion of one end gives to the other.
  void add_links(const Scratch<Row>& x, Scratch<Row>& y) const {
    each_stretch([&](const Ends& ends, const Stretch<D>& s) {
      const auto [a, b] = ends;
      if (a == b || !system_.moves(a) || !system_.moves(b)) return;
      const Sides sides = sides_of(s, time_squared_, time_);
      const auto columns_a = columns(a, s.arm_a), columns_b = columns(b, s.arm_b);
      const auto momentum = [&](const Row& unknowns, const std::array<Vec<D>, B>& of_end) {
        Vec<D> motion(0.0);
        for (int c = 0; c < B; ++c) motion += unknowns[c] * of_end[c];
        return sides.momentum(motion, s.direction);
      };
      const Vec<D> of_a = momentum(x[system_.number(a)], columns_a);
      const Vec<D> of_b = momentum(x[system_.number(b)], columns_b);
      for (int c = 0; c < B; ++c) {
        y[system_.number(a)][c] -= glm::dot(columns_a[c], of_b);
        y[system_.number(b)][c] -= glm::dot(columns_b[c], of_a);
      }
    });
  }

  // How the end of an arm moves with each unknown.
  std::array<Vec<D>, B> columns(std::size_t i, const Vec<D>& arm) const {
    std::array<Vec<D>, B> all;
    all.fill(Vec<D>(0.0));
    for (int c = 0; c < D; ++c) all[c][c] = 1;
    if constexpr (B > D)
      if (system_.turns(i))
        for (int c = D; c < B; ++c) all[c] = cross(unit_spin<D>(c - D), arm);
    return all;
  }

  // A force turns a body back that its arm has turned away from: the symmetric part of (arm .
  // force) I - arm force^T, which in 2D is all of it.
  template <class Blocks>
  void add_lever(Blocks& blocks, std::size_t i, const Vec<D>& arm, const Vec<D>& force) {
    if constexpr (B > D) {
      if (!system_.turns(i)) return;
      const double back = glm::dot(arm, force);
      if constexpr (D == 2) {
        blocks.add(system_.number(i), D, D, buckling_ ? back : std::max(back, 0.0));
      } else if (buckling_) {
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c)
            blocks.add(system_.number(i), D + r, D + c,
                       (r == c ? back : 0) - (arm[r] * force[c] + arm[c] * force[r]) / 2);
      }
    }
  }

  const SmoothSystem<D>& system_;
  std::span<const Tie<D>> ties_;
  std::optional<BlockSystem<B>> blocks_;  // one of the two
  std::optional<BlockIteration<B>> iteration_;
  // Of the last `factor`.
  const SmoothState<D>* state_ = nullptr;
  double time_squared_ = 0;
  double time_ = 0;
  bool buckling_ = true;
};

// The state `time` after the start whose own forces lead to it: v = v0 + time a(x0 + time v, v), an
// implicit Euler step, solved to rounding. Throws Refused, naming the method and the step `h`, if
// that does not converge. The solver is chosen by the size; tests hold them against each other.
template <int D>
SmoothState<D> implicit_stage(SmoothSystem<D>& system, double time, std::string_view method,
                              double h, LinearSolver solver = LinearSolver::by_size);

// Kicks `state`, whose places stay, for `time` by forces that use the velocities after the kick:
// v := v + time a(x, v_new). One evaluation and one linear solution. Throws Refused if numbers fail
// (damping beyond 1e16 times mass / time).
template <int D>
void damped_kick(SmoothSystem<D>& system, SmoothState<D>& state, double time,
                 LinearSolver solver = LinearSolver::by_size);

}  // namespace lantern::physics
