// Bodies that joints hold and nothing touches: the joints are part of the equations of motion,
// which each method of integration solves in its own way, so that it keeps its order.
//
//   velocity_verlet,        RATTLE (Andersen, J. Comput. Phys. 52, 1983): impulses along the joints
//   semi_implicit_euler     at the start, after which they hold at the end; and at the end, after
//                           which their velocities do. Bodies turn as they do freely in between.
//   explicit_euler,         Runge-Kutta on the accelerations that the joints leave, orientations by
//   runge_kutta_4           Munthe-Kaas (Appl. Numer. Math. 29, 1999); the end is projected
//   implicit_midpoint,      the stage is solved for velocities and joints' impulses together, by
//   implicit_euler          Newton's method; places hold at the end, velocities are projected
//
// Where something touches what joints hold, rows hold the joints as they hold contacts: these only
// take energy, of what turns by an angle in a part of the step half that angle's square.
//
// See Hairer, Lubich, Wanner, "Geometric Numerical Integration", VII.1 and IV.4.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "base/scratch.hpp"
#include "physics/contact/contact_solver.hpp"
#include "physics/integrate/smooth_system.hpp"
#include "physics/joint/joint_rows.hpp"

namespace lantern::physics {

// The joints of an island as equations between the places of its bodies, g(q) = 0, and what follows
// from them: the velocities J v = 0 and, of multipliers, the system
//
//   J M^-1 J^T
//
// which is solved at once, by Cholesky factors; rows lie in the order of the joints, so that a
// chain costs time in proportion to its length. Rows that say the same twice (a closed loop that is
// over-determined) have no factor: they are given a little compliance, and solved again until
// nothing is missing.
template <int D>
class JointSystem {
 public:
  // A joint at the state that was last looked at.
  struct Hold {
    const JointRows<D>* joint = nullptr;
    std::size_t first = 0;  // of its rows
    int width = 0;
    std::size_t end() const { return first + static_cast<std::size_t>(width); }
    double size = 0;       // against which a gap is wide
    double tolerance = 0;  // of its gap, by rounding
    Vec<D> arm_a{0.0}, arm_b{0.0};
    Vec<D> gap{0.0};  // from a's point to b's
    double length = 0;
  };

  // The system is told what the joints turn. Both inputs must outlive the object.
  JointSystem(SmoothSystem<D>& system, std::span<const JointRows<D>> joints, WorldWork& work)
      : system_(system), work_(work), held_(system.bodies().size()) {
    const std::span<const Body<D>> bodies = system.bodies();
    const auto hold_off_centre = [&](std::uint32_t i) {
      held_[i].off_centre = true;
      system.turn_also(i);
      held_[i].turns = system.turns(i);
      if (system.moves(i) && !system.turns(i) && bodies[i].inverse_inertia != Spin<D>(0.0))
        can_be_solved_ = false;
      held_[i].axes = matrix(bodies[i].orientation);
    };
    for (const JointRows<D>& joint : joints) {
      if (joint.joint.at_a != Vec<D>(0.0)) hold_off_centre(joint.a);
      if (joint.joint.at_b != Vec<D>(0.0)) hold_off_centre(joint.b);
    }
    holds_.reserve(joints.size());
    rows_.reserve(joints.size() * D);
    for (const JointRows<D>& joint : joints)
      if (system.moves(joint.a) || system.moves(joint.b)) add(joint);
    plan(rows_, bodies.size(), factor_);
    impulses_.assign(rows_.size(), 0.0);
    values_.resize(rows_.size());
    speeds_.resize(rows_.size());
  }

  // False if a joint turns a body that can turn about some axes only.
  bool can_be_solved() const { return can_be_solved_; }
  const Scratch<ConstraintRow<D>>& rows() const { return rows_; }
  const Scratch<Hold>& holds() const { return holds_; }
  // Impulses of all rows so far, and what was last added to them.
  Scratch<double>& impulses() { return impulses_; }
  const Scratch<double>& impulses() const { return impulses_; }

  // Upon b.
  Vec<D> impulse(const Hold& hold) const {
    Vec<D> sum(0.0);
    for (std::size_t r = hold.first; r < hold.end(); ++r) sum += rows_[r].direction * impulses_[r];
    return sum;
  }

  // The rows are those of this state from now on.
  void look(const SmoothState<D>& state) {
    place(state);
    for (std::size_t i = 0; i < held_.size(); ++i)
      if (held_[i].turns)
        held_[i].inverse_inertia = world_inverse_inertia(system_.bodies()[i], held_[i].axes);
    for (const Hold& hold : holds_) {
      const HeldBody& a = held_[hold.joint->a];
      const HeldBody& b = held_[hold.joint->b];
      for (std::size_t r = hold.first; r < hold.end(); ++r) {
        ConstraintRow<D>& row = rows_[r];
        const Vec<D> along =
            hold.width == 1 && hold.length > 0 ? hold.gap / hold.length : row.direction;
        row.set(along, hold.arm_a, a.inverse_inertia, hold.arm_b, b.inverse_inertia);
      }
    }
  }

  // Of the rows. False if there is none.
  bool factor() {
    compliant_ = false;
    if (factor_rows(rows_, kJointSettings.least_part, factor_)) return true;
    compliant_ = true;
    return factor_compliant(rows_, kJointSettings.compliance, factor_);
  }

  // J v of the rows' own state.
  const Scratch<double>& speeds(const SmoothState<D>& state) {
    find_velocities(state);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const ConstraintRow<D>& row = rows_[r];
      const HeldBody& a = held_[row.a];
      const HeldBody& b = held_[row.b];
      speeds_[r] = glm::dot(row.direction, b.velocity - a.velocity) +
                   (dot(row.turn_b, b.spin) - dot(row.turn_a, a.spin));
    }
    return speeds_;
  }

  // Errors of the joints' places; the largest, in units of its tolerance. The rows stay.
  double find_errors(const SmoothState<D>& state) {
    place(state);
    double worst = 0;
    for (const Hold& hold : holds_) {
      double size = 0;
      if (hold.width == 1) {
        values_[hold.first] = hold.joint->joint.length - hold.length;
        size = std::abs(values_[hold.first]);
      } else {
        for (int k = 0; k < D; ++k) {
          values_[hold.first + static_cast<std::size_t>(k)] = -hold.gap[k];
          size = std::max(size, std::abs(hold.gap[k]));
        }
      }
      if (!(size <= worst * hold.tolerance)) worst = size / hold.tolerance;
    }
    return worst;
  }

  const Scratch<double>& errors() const { return values_; }
  // Whether the errors last found are too large to be closed at once, in a step of `h` seconds.
  bool wide_open(double h) const {
    for (const Hold& hold : holds_) {
      const double most =
          std::min(kJointSettings.wide_open * hold.size, kJointSettings.fastest_closing * h);
      for (std::size_t r = hold.first; r < hold.end(); ++r)
        if (!(std::abs(values_[r]) <= most)) return true;
    }
    return false;
  }

  // The next three solve until nothing is missing but rounding, by the rows and the factor that
  // there are; the state may be near the one that they are from. False if that does not converge.
  //
  // Moves the places.
  bool close_gaps(SmoothState<D>& state) {
    return settle([&] { return find_errors(state); },
                  [&] {
                    for (std::size_t r = 0; r < rows_.size(); ++r) {
                      const ConstraintRow<D>& row = rows_[r];
                      const auto move = [&](std::uint32_t i, double mass, const Spin<D>& gained,
                                            double by) {
                        state.shift[i] += row.direction * (mass * by);
                        if (held_[i].turns)
                          state.orientation[i] = turned(state.orientation[i], gained * by);
                      };
                      move(row.a, row.mass_a, row.gained_a, -values_[r]);
                      move(row.b, row.mass_b, row.gained_b, values_[r]);
                    }
                  });
  }

  // Kicks; `counts` among the impulses.
  bool stop_parting(SmoothState<D>& state, bool counts) {
    return settle([&] { return missing_speed(state); },
                  [&] {
                    act(state.kick, state.twist);
                    for (std::size_t r = 0; counts && r < rows_.size(); ++r)
                      impulses_[r] += values_[r];
                  });
  }

  // Kicks so that places hold after h.
  bool hold_at_end(SmoothState<D>& state, double h) {
    system_.fly(state, state, h);
    return settle([&] { return find_errors(state); },
                  [&] {
                    for (double& value : values_) value /= h;
                    act(state.kick, state.twist);
                    for (std::size_t r = 0; r < rows_.size(); ++r) impulses_[r] += values_[r];
                    system_.fly(state, state, h);
                  });
  }

  // Adds what the joints do to the accelerations, over `time` seconds.
  void hold_accelerations(const SmoothState<D>& state, Pull<D>& pull, double time) {
    find_velocities(state);
    const int rounds = compliant_ ? kJointSettings.compliant_rounds : 1;
    for (int round = 0; round < rounds; ++round) {
      for (const Hold& hold : holds_)
        for (const std::uint32_t i : {hold.joint->a, hold.joint->b}) {
          HeldBody& held = held_[i];
          held.acceleration = pull.acceleration[i];
          if (!held.turns) continue;
          const Spin<D> momentum = system_.bodies()[i].angular_momentum + state.twist[i];
          held.turning = held.inverse_inertia * (pull.torque[i] + gyroscopic(held.spin, momentum));
        }
      for (const Hold& hold : holds_) {
        const HeldBody& a = held_[hold.joint->a];
        const HeldBody& b = held_[hold.joint->b];
        const Vec<D> way_a = cross(a.spin, hold.arm_a), way_b = cross(b.spin, hold.arm_b);
        Vec<D> parting = (b.acceleration - a.acceleration) +
                         (cross(b.turning, hold.arm_b) - cross(a.turning, hold.arm_a)) +
                         (cross(b.spin, way_b) - cross(a.spin, way_a));
        if (hold.width == 1) {
          const Vec<D>& direction = rows_[hold.first].direction;
          const Vec<D> speed = (b.velocity + way_b) - (a.velocity + way_a);
          const Vec<D> across = speed - direction * glm::dot(speed, direction);
          values_[hold.first] =
              -glm::dot(parting, direction) - glm::dot(across, across) / hold.length;
        } else {
          for (int k = 0; k < D; ++k)
            values_[hold.first + static_cast<std::size_t>(k)] = -parting[k];
        }
      }
      solve();
      act(pull.acceleration, pull.torque);
      for (std::size_t r = 0; r < rows_.size(); ++r) impulses_[r] += values_[r] * time;
    }
  }

  // That of all joints (see JointRows), if impulses were those of `time` seconds.
  double swing_squared(std::span<const double> impulses, double time) const {
    double most = 0;
    for (const Hold& hold : holds_) {
      double square = 0;
      for (int k = 0; k < hold.width; ++k) {
        const double impulse = impulses[hold.first + static_cast<std::size_t>(k)];
        square += impulse * impulse;
      }
      const JointRows<D>& joint = *hold.joint;
      most =
          std::max(most, joint.swing_squared(system_.bodies()[joint.a], system_.bodies()[joint.b],
                                             std::sqrt(square) / time));
    }
    return most;
  }

  std::span<const double> last() const { return values_; }

  void count_solve() const { count_direct_solve(rows_.size(), work_); }  // of all rows at once

 private:
  // A body as rows need it.
  struct HeldBody {
    bool off_centre = false;  // some joint holds it off its centre
    bool turns = false;
    Mat<D> axes{1.0};
    Inertia<D> inverse_inertia{0.0};
    Vec<D> velocity{0.0}, acceleration{0.0};
    Spin<D> spin{0.0}, turning{0.0};  // angular velocity and acceleration
  };

  void add(const JointRows<D>& joint) {
    const Body<D>& a = system_.bodies()[joint.a];
    const Body<D>& b = system_.bodies()[joint.b];
    Hold hold{.joint = &joint, .first = rows_.size(), .width = joint.width()};
    const double lengths =
        joint.joint.length + glm::length(joint.joint.at_a) + glm::length(joint.joint.at_b);
    hold.size = std::max(lengths, thinner(a, b));
    hold.tolerance =
        kJointSettings.rounding * (lengths + glm::length(a.position) + glm::length(b.position));
    holds_.push_back(hold);
    ConstraintRow<D> row{.a = joint.a, .b = joint.b};
    if (system_.moves(joint.a)) row.mass_a = a.inverse_mass;
    if (system_.moves(joint.b)) row.mass_b = b.inverse_mass;
    for (int k = 0; k < hold.width; ++k) {
      row.direction = unit_vec<D>(k);
      rows_.push_back(row);
    }
  }

  void place(const SmoothState<D>& state) {
    for (std::size_t i = 0; i < held_.size(); ++i)
      if (held_[i].turns || (held_[i].off_centre && system_.bodies()[i].moves()))
        held_[i].axes = matrix(state.orientation[i]);
    const std::span<const Body<D>> bodies = system_.bodies();
    for (Hold& hold : holds_) {
      stop_if_asked();
      const std::uint32_t a = hold.joint->a, b = hold.joint->b;
      hold.arm_a = held_[a].axes * hold.joint->joint.at_a;
      hold.arm_b = held_[b].axes * hold.joint->joint.at_b;
      hold.gap = (bodies[b].position - bodies[a].position) + (state.shift[b] - state.shift[a]) +
                 (hold.arm_b - hold.arm_a);
      if (hold.width == 1) hold.length = glm::length(hold.gap);
    }
  }

  void find_velocities(const SmoothState<D>& state) {
    for (const Hold& hold : holds_)
      for (const std::uint32_t i : {hold.joint->a, hold.joint->b}) {
        HeldBody& held = held_[i];
        const Body<D>& body = system_.bodies()[i];
        held.velocity = system_.velocity(state, i);
        if (held.turns)
          held.spin = held.inverse_inertia * (body.angular_momentum + state.twist[i]);
        else if (body.kind == BodyKind::kinematic_body)
          held.spin = body.kinematic_spin;
      }
  }

  void solve() {
    count_solve();
    factor_.solve(values_);
  }

  // What was solved for acts upon the bodies: impulses upon velocities, forces upon accelerations.
  void act(Scratch<Vec<D>>& linear, Scratch<Spin<D>>& angular) const {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const ConstraintRow<D>& row = rows_[r];
      linear[row.a] -= row.direction * (row.mass_a * values_[r]);
      linear[row.b] += row.direction * (row.mass_b * values_[r]);
      if (held_[row.a].turns) angular[row.a] -= row.turn_a * values_[r];
      if (held_[row.b].turns) angular[row.b] += row.turn_b * values_[r];
    }
  }

  // Against the fastest of all points that are held.
  double missing_speed(const SmoothState<D>& state) {
    speeds(state);
    double fastest = 0, worst = 0;
    for (const Hold& hold : holds_) {
      const HeldBody& a = held_[hold.joint->a];
      const HeldBody& b = held_[hold.joint->b];
      fastest =
          std::max({fastest, glm::length(a.velocity) + size_of(a.spin) * glm::length(hold.arm_a),
                    glm::length(b.velocity) + size_of(b.spin) * glm::length(hold.arm_b)});
    }
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      values_[r] = -speeds_[r];
      worst = std::max(worst, std::abs(values_[r]));
    }
    return worst > 0 ? worst / (kJointSettings.rounding * fastest) : 0;
  }

  // What turns the angular velocity of a body that nothing turns: in the plane nothing.
  static double gyroscopic(double, double) { return 0; }
  static Vec<3> gyroscopic(const Vec<3>& spin, const Vec<3>& momentum) {
    return glm::cross(momentum, spin);
  }

  // missing() fills in what is missing and gives the worst of it in units of rounding; mend() uses
  // the impulses that follow.
  template <class Missing, class Mend>
  bool settle(Missing&& missing, Mend&& mend) {
    double last = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kJointSettings.most_rounds; ++round) {
      const double worst = missing();
      if (worst <= 1) return true;
      if (!(worst <= last / 2)) return worst <= kJointSettings.near_rounding;
      last = worst;
      solve();
      mend();
    }
    return last <= kJointSettings.near_rounding;
  }

  SmoothSystem<D>& system_;
  WorldWork& work_;
  bool can_be_solved_ = true;
  bool compliant_ = false;
  Scratch<HeldBody> held_;  // one a body
  Scratch<Hold> holds_;
  Scratch<ConstraintRow<D>> rows_;
  EnvelopeSystem factor_;
  Scratch<double> values_;  // what is missing, then impulses
  Scratch<double> speeds_, impulses_;
};

// Moves the island, whole or, where that does not converge, in parts. Joints' impulses are noted in
// its rows. Velocities at the start that do not satisfy the joints are projected first, which only
// takes energy.
//
// The tension of joints may swing bodies faster than an explicit method can follow: light links
// that carry a heavy end. Then the implicit midpoint moves them; and what that does not solve,
// implicit Euler does.
//
// False if this is not for them: they are moved by different integrators, joints are wide open, or
// even small parts do not converge (see JointSettings). The bodies are then as they were, but may
// have been brought together where a joint was a little open, and their velocities projected.
template <int D>
bool move_constrained(const IslandMove<D>& move);

// One part while it is made: the rows and their factor are those of the start.
template <int D>
struct ConstrainedPart {
  SmoothSystem<D>& system;
  JointSystem<D>& joints;
  SmoothState<D>& state;  // that of the start, then that of the end
  double h;
  double swing = 0;  // how fast the joints' tension swings bodies, radians a second, if it matters

  // Whether an explicit method can follow it.
  bool follows(double swing_squared) {
    swing = std::sqrt(swing_squared);
    return h * swing <= kJointSettings.most_swing;
  }
};

// How each method moves a part; false if it does not converge.
template <int D>
bool constrained_explicit_euler(ConstrainedPart<D>& part);
template <int D>
bool constrained_verlet(ConstrainedPart<D>& part);
template <int D>
bool constrained_runge_kutta_4(ConstrainedPart<D>& part);
template <int D>
bool constrained_implicit_midpoint(ConstrainedPart<D>& part);
template <int D>
bool constrained_implicit_euler(ConstrainedPart<D>& part);

// v := v + time a(x, v_new) by forces and joints together, places as they are; rows of the state.
template <int D>
bool constrained_damped_kick(ConstrainedPart<D>& part, double time);

}  // namespace lantern::physics
