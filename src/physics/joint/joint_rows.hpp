// Joint constraints, solved by the same sweeps as contacts; their impulses may push and pull.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/matrix.hpp>

#include "base/scratch.hpp"
#include "geometry/elementary.hpp"
#include "physics/contact/contact_rows.hpp"
#include "physics/joint.hpp"

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
  // Of h times the frequency that the joints' tension makes: explicit methods are stable below 2.
  double most_swing = 1;
  // Radians in a part, of bodies whose inertia is not alike about all axes: farther on, a joint's
  // impulses would find other energies.
  double most_turn = 0.25;
  double most_gain = 1e-2;  // of kinetic energy, in a part: more is no solution of these equations
  int most_parts = 16;      // into which a step is cut if it does not converge whole
  // Of joints beside contacts: rounds in which gaps are closed, to so small a part of the way that
  // may be moved; and products for one factor.
  int closing_rounds = 8;
  double straight = 1.0 / 16;           // of a gap: no more is left by a way that is straight
  double damping = 0.1;                 // of rows, where gaps close by no straight way, at most,
  double sag = 3e-7;                    // and this over the gap as a part of the joints' size
  double swept_compliance = 1e-6;       // of rows that say the same twice
  double shortest_sub_step = 1.0 / 64;  // of a step; joints that swing fast cut it so far
  double closed = 1e-9;
  double most_work = 4e6;
  std::size_t most_dense = 512;  // rows of implicit methods, whose matrix is full
};
inline constexpr JointSettings kJointSettings;

template <int D>
struct JointRows {
  Joint<D> joint = {};
  std::uint32_t place = 0;     // among the world's joints
  std::uint32_t a = 0, b = 0;  // places among the island's bodies
  Vec<D> arm_a{0.0}, arm_b{0.0};
  Vec<D> gap{0.0};          // from a's point to b's
  Vec<D> direction{0.0};    // of a rod, from a's point to b's
  Mat<D> solve{0.0};        // from an error of velocity to the impulse that mends it
  double inverse_mass = 0;  // effective, of a rod
  Vec<D> impulse{0.0};      // upon b, of this sub-step, N s
  Backoff backoff = {};
  double seconds = 0;  // of the sub-step of the last step that it is from; 0: there was none

  int width() const { return joint.kind == JointKind::pin ? D : 1; }  // in rows

  // Arms, gap and direction where the bodies are; the rest is left as it was.
  void find_gap(const Body<D>& body_a, const Body<D>& body_b) {
    arm_a = matrix(body_a.orientation) * joint.at_a;
    arm_b = matrix(body_b.orientation) * joint.at_b;
    gap = (body_b.position - body_a.position) + arm_b - arm_a;
    if (joint.kind == JointKind::pin) return;
    const double length = glm::length(gap);
    direction = length > 0 ? gap / length : Vec<D>(0.0);
  }

  // What is to be taken from the gap.
  Vec<D> error() const {
    return joint.kind == JointKind::pin ? gap : gap - direction * joint.length;
  }

  void refresh(const Body<D>& body_a, const Body<D>& body_b, const SolverBody<D>& solver_a,
               const SolverBody<D>& solver_b) {
    find_gap(body_a, body_b);
    if (joint.kind == JointKind::pin) {
      solve = glm::inverse(response(solver_a, solver_b));
      return;
    }
    inverse_mass = inverse_effective_mass(solver_a, arm_a, solver_b, arm_b, direction);
    impulse = direction * glm::dot(direction, impulse);
  }

  void warm_start(SolverBody<D>& body_a, SolverBody<D>& body_b) {
    body_a.apply(-impulse, arm_a);
    body_b.apply(impulse, arm_b);
  }

  void solve_velocities(SolverBody<D>& body_a, SolverBody<D>& body_b, Sweep& sweep) {
    const Vec<D> gained = impulse_for(-relative_velocity(body_a, arm_a, body_b, arm_b));
    impulse += gained;
    body_a.apply(-gained, arm_a);
    body_b.apply(gained, arm_b);
    sweep.change = std::max(sweep.change, glm::length(gained));
    sweep.largest = std::max(sweep.largest, glm::length(impulse));
    sweep.work->joint_rows += width();
  }

  // Mean velocities, too, keep the points together. (Gaps are closed by JointBlock, after the
  // bodies have moved.)
  void correct_positions(SolverBody<D>& body_a, SolverBody<D>& body_b, Sweep& sweep) {
    const Vec<D> gained = impulse_for(-relative_velocity(body_a.mean, arm_a, body_b.mean, arm_b));
    body_a.correct(-gained, arm_a);
    body_b.correct(gained, arm_b);
    sweep.change = std::max(sweep.change, glm::length(gained));
    sweep.work->joint_rows += width();
  }

  // The square of the frequency at which the bodies swing by a tension, an upper bound: an end at
  // distance l about the other by tension / l, and a body by the tension times its arm.
  double swing_squared(const Body<D>& body_a, const Body<D>& body_b, double tension) const {
    const auto swing = [&](const Body<D>& body, const Vec<D>& at) {
      if (!body.is_dynamic() || body.asleep) return 0.0;
      double most = 0;
      for (int i = 0; i < (D == 2 ? 1 : 3); ++i)
        most = std::max(most, spin_component(body.inverse_inertia, i));
      return glm::length(at) * most +
             (joint.kind == JointKind::distance ? body.inverse_mass / joint.length : 0);
    };
    return tension * (swing(body_a, joint.at_a) + swing(body_b, joint.at_b));
  }

 private:
  // Column j is the relative velocity that an impulse of 1 along axis j gives.
  Mat<D> response(const SolverBody<D>& body_a, const SolverBody<D>& body_b) const {
    Mat<D> k(body_a.inverse_mass + body_b.inverse_mass);
    for (int j = 0; j < D; ++j) {
      const Spin<D> spin_a = body_a.inverse_inertia * cross(arm_a, unit_vec<D>(j));
      const Spin<D> spin_b = body_b.inverse_inertia * cross(arm_b, unit_vec<D>(j));
      k[j] += cross(spin_a, arm_a) + cross(spin_b, arm_b);
    }
    return k;
  }

  // The impulse that adds `wanted` to the relative velocity.
  Vec<D> impulse_for(const Vec<D>& wanted) const {
    if (joint.kind == JointKind::pin) return solve * wanted;
    if (inverse_mass == 0) return Vec<D>(0.0);
    return direction * (glm::dot(direction, wanted) / inverse_mass);
  }
};

// The joints of an island solved all at once, between sweeps over its contacts: what light links
// carry need not wait until single impulses have run from end to end. And how gaps are closed.
template <int D>
class JointBlock {
 public:
  // Of joints that were refreshed, for bodies as they are. False if that is too much work: then
  // they are swept over one by one, and nothing closes their gaps.
  bool refresh(const Scratch<JointRows<D>>& joints, const Scratch<SolverBody<D>>& bodies) {
    list(joints, bodies);
    if (factor_.lines() != rows_.size()) plan(rows_, bodies.size(), factor_);
    solved_ = !rows_.empty() && factor_.work() <= kJointSettings.most_work &&
              (factor_rows(rows_, kJointSettings.least_part, factor_) ||
               factor_compliant(rows_, kJointSettings.swept_compliance, factor_));
    values_.resize(rows_.size());
    return solved_;
  }

  // By their velocities, or by their mean velocities.
  void stop_parting(const Scratch<JointRows<D>>& joints, Scratch<SolverBody<D>>& bodies,
                    bool of_mean, WorldWork& work) {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const ConstraintRow<D>& row = rows_[r];
      const JointRows<D>& joint = joints[joint_of_[r]];
      const SolverBody<D>&a = bodies[row.a], &b = bodies[row.b];
      const Motion<D>&of_a = of_mean ? a.mean : a, &of_b = of_mean ? b.mean : b;
      values_[r] =
          -glm::dot(row.direction, relative_velocity(of_a, joint.arm_a, of_b, joint.arm_b));
    }
    solve(work);
    apply_rows(rows_, values_, bodies, of_mean);
  }

  // Impulses after which no joint parts.
  void solve_velocities(Scratch<JointRows<D>>& joints, Scratch<SolverBody<D>>& bodies, Sweep& sweep,
                        WorldWork& work) {
    stop_parting(joints, bodies, false, work);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      Vec<D>& impulse = joints[joint_of_[r]].impulse;
      impulse += rows_[r].direction * values_[r];
      sweep.change = std::max(sweep.change, std::abs(values_[r]));
      sweep.largest = std::max(sweep.largest, glm::length(impulse));
    }
  }

  // The same of mean velocities.
  void correct_positions(const Scratch<JointRows<D>>& joints, Scratch<SolverBody<D>>& bodies,
                         Sweep& sweep, WorldWork& work) {
    stop_parting(joints, bodies, true, work);
    for (const double value : values_) sweep.change = std::max(sweep.change, std::abs(value));
  }

  // Moves bodies, after `h` seconds, so that gaps are closed: so often anew, until nothing is
  // missing, no faster than penetration is pushed out, and never so that they grow. Links in a line
  // give way across it only: what would close their gaps at once would throw them about. So where
  // that goes wrong it is damped (Levenberg, Quart. Appl. Math. 2, 1944), by rows of where the
  // bodies have come to; a gap that is small against their sag is left.
  void close_gaps(Scratch<JointRows<D>>& joints, Scratch<Body<D>>& bodies, double h,
                  WorldWork& work) {
    if (!solved_) return;
    double left = kRowSettings.fastest_push * h;
    const double enough = kJointSettings.closed * left;
    double worst = find_errors(joints, bodies), sum = sum_of_squares();
    double size = 0;
    for (const JointRows<D>& joint : joints)
      size =
          std::max(size, glm::length(joint.arm_a) + glm::length(joint.arm_b) + joint.joint.length);
    bool damped = false;
    for (int round = 0; round < kJointSettings.closing_rounds && worst > enough && left > 0;
         ++round) {
      solve(work);
      kept_ = bodies;
      move(bodies, 1);
      double way = way_of(bodies);
      if (way > left) {
        bodies = kept_;
        move(bodies, left / way);
        way = left;
      }
      const double now = find_errors(joints, bodies), sum_now = sum_of_squares();
      if (damped ? sum_now < sum : now < kJointSettings.straight * worst) {
        worst = now;
        sum = sum_now;
        left -= way;
        if (!damped) continue;
      } else {
        bodies = kept_;
        find_errors(joints, bodies);
        if (damped) return;
        damped = true;
      }
      look(joints, bodies);
      if (!factor_compliant(
              rows_, std::min(kJointSettings.damping, kJointSettings.sag * size / worst), factor_))
        return;
    }
  }

 private:
  void list(const Scratch<JointRows<D>>& joints, const Scratch<SolverBody<D>>& bodies) {
    rows_.clear();
    joint_of_.clear();
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const JointRows<D>& joint = joints[i];
      const SolverBody<D>&a = bodies[joint.a], &b = bodies[joint.b];
      if (a.inverse_mass == 0 && b.inverse_mass == 0) continue;
      for (int k = 0; k < joint.width(); ++k) {
        ConstraintRow<D> row{joint.a, joint.b, a.inverse_mass, b.inverse_mass};
        const bool pin = joint.joint.kind == JointKind::pin;
        row.set(pin ? unit_vec<D>(k) : joint.direction, joint.arm_a, a.inverse_inertia, joint.arm_b,
                b.inverse_inertia);
        rows_.push_back(row);
        joint_of_.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }

  // The rows of joints whose gaps were found where the bodies are.
  void look(const Scratch<JointRows<D>>& joints, const Scratch<Body<D>>& bodies) {
    const auto inertia = [&](std::uint32_t i) {
      const Body<D>& body = bodies[i];
      const bool turns = body.is_pushed() && body.inverse_inertia != Spin<D>(0.0);
      return turns ? world_inverse_inertia(body) : Inertia<D>(0.0);
    };
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const JointRows<D>& joint = joints[joint_of_[r]];
      const bool pin = joint.joint.kind == JointKind::pin;
      rows_[r].set(pin ? rows_[r].direction : joint.direction, joint.arm_a, inertia(joint.a),
                   joint.arm_b, inertia(joint.b));
    }
  }

  void solve(WorldWork& work) {
    count_direct_solve(rows_.size(), work);
    factor_.solve(values_);
  }

  static double angle_between(const Rotation<D>& a, const Rotation<D>& b) {
    if constexpr (D == 2) {
      return std::abs(a.angle - b.angle);
    } else {
      const glm::dquat q = a.q * glm::conjugate(b.q);
      return 2 * geometry::asin(std::min(1.0, std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z)));
    }
  }

  // How far the bodies have come from where they were kept, at most: of their surfaces.
  double way_of(const Scratch<Body<D>>& bodies) const {
    double most = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (!bodies[i].is_dynamic()) continue;
      const double turn = angle_between(bodies[i].orientation, kept_[i].orientation);
      most = std::max(most, glm::length(bodies[i].position - kept_[i].position) +
                                turning_reach<D>(bodies[i].shape) * turn);
    }
    return most;
  }

  double sum_of_squares() const {
    double sum = 0;
    for (const double value : values_) sum += value * value;
    return sum;
  }

  // The largest one.
  double find_errors(Scratch<JointRows<D>>& joints, const Scratch<Body<D>>& bodies) {
    for (JointRows<D>& joint : joints) joint.find_gap(bodies[joint.a], bodies[joint.b]);
    double worst = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      values_[r] = -glm::dot(joints[joint_of_[r]].error(), rows_[r].direction);
      worst = std::max(worst, std::abs(values_[r]));
    }
    return worst;
  }

  void move(Scratch<Body<D>>& bodies, double share) const {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const ConstraintRow<D>& row = rows_[r];
      const double by = values_[r] * share;
      bodies[row.a].position -= row.direction * (row.mass_a * by);
      bodies[row.b].position += row.direction * (row.mass_b * by);
      if (row.gained_a != Spin<D>(0.0))
        turn_with_momentum(bodies[row.a], Spin<D>(row.gained_a * -by));
      if (row.gained_b != Spin<D>(0.0))
        turn_with_momentum(bodies[row.b], Spin<D>(row.gained_b * by));
    }
  }

  Scratch<ConstraintRow<D>> rows_;
  Scratch<std::uint32_t> joint_of_;  // of each row
  EnvelopeSystem factor_;
  bool solved_ = false;
  Scratch<Body<D>> kept_;
  Scratch<double> values_;  // what is missing, then impulses
};

}  // namespace lantern::physics
