// The joints of an island solved all at once, between sweeps over its contacts: what light links
// carry need not wait until single impulses have run from end to end. And how gaps are closed.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/joint/joint_rows.hpp"

namespace lantern::physics {

template <int D>
class JointBlock {
 public:
  // Of joints that were refreshed, for bodies as they are. False if that is too much work: then
  // they are swept over one by one, and nothing closes their gaps.
  bool refresh(const std::vector<JointRows<D>>& joints, const std::vector<SolverBody<D>>& bodies) {
    list(joints, bodies);
    if (factor_.lines() != rows_.size()) plan(rows_, bodies.size(), factor_);
    solved_ = !rows_.empty() && factor_.work() <= kJointSettings.most_work &&
              (factor_rows(rows_, kJointSettings.least_part, factor_) ||
               factor_compliant(rows_, kJointSettings.swept_compliance, factor_));
    values_.resize(rows_.size());
    return solved_;
  }

  // Impulses after which no joint parts.
  void solve_velocities(std::vector<JointRows<D>>& joints, std::vector<SolverBody<D>>& bodies,
                        Sweep& sweep, WorldWork& work) {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const ConstraintRow<D>& row = rows_[r];
      const JointRows<D>& joint = joints[joint_of_[r]];
      values_[r] = -glm::dot(
          row.direction, relative_velocity(bodies[row.a], joint.arm_a, bodies[row.b], joint.arm_b));
    }
    solve(factor_, work);
    apply_rows(rows_, values_, bodies);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      Vec<D>& impulse = joints[joint_of_[r]].impulse;
      impulse += rows_[r].direction * values_[r];
      sweep.change = std::max(sweep.change, std::abs(values_[r]));
      sweep.largest = std::max(sweep.largest, glm::length(impulse));
    }
  }

  // The same of mean velocities.
  void correct_positions(const std::vector<JointRows<D>>& joints,
                         std::vector<SolverBody<D>>& bodies, Sweep& sweep, WorldWork& work) {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const ConstraintRow<D>& row = rows_[r];
      const JointRows<D>& joint = joints[joint_of_[r]];
      values_[r] = -glm::dot(row.direction, relative_mean_velocity(bodies[row.a], joint.arm_a,
                                                                   bodies[row.b], joint.arm_b));
    }
    solve(factor_, work);
    correct_rows(rows_, values_, bodies);
    for (const double value : values_) sweep.change = std::max(sweep.change, std::abs(value));
  }

  // Moves bodies, after `h` seconds, so that gaps are closed: so often anew, until nothing is
  // missing, no faster than penetration is pushed out, and never so that the widest gap grows.
  // Where a straight way overshoots (links in a line that are pulled across it), it is damped
  // (Levenberg, Quart. Appl. Math. 2, 1944).
  void close_gaps(std::vector<JointRows<D>>& joints, std::vector<Body<D>>& bodies, double h,
                  WorldWork& work) {
    if (!solved_) return;
    double left = kRowSettings.fastest_push * h;
    const double enough = kJointSettings.closed * left;
    double worst = find_errors(joints, bodies);
    bool damped = false;
    for (int round = 0; round < kJointSettings.closing_rounds && worst > enough && left > 0;
         ++round) {
      solve(damped ? damped_ : factor_, work);
      keep(bodies);
      move(bodies, 1);
      double way = way_of(bodies);
      if (way > left) {
        restore(bodies);
        move(bodies, left / way);
        way = left;
      }
      const double now = find_errors(joints, bodies);
      const bool better = now < worst;
      if (better) {
        left -= way;
      } else {
        restore(bodies);
        find_errors(joints, bodies);
        if (damped) return;
      }
      if (!damped && !(now < worst / 2) && !(damped = damp())) return;
      if (better) worst = now;
    }
  }

 private:
  struct KeptPlace {
    Vec<D> position;
    Rotation<D> orientation;
    Spin<D> angular_momentum;
  };

  void list(const std::vector<JointRows<D>>& joints, const std::vector<SolverBody<D>>& bodies) {
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

  void solve(const EnvelopeSystem& factor, WorldWork& work) {
    count_direct_solve(rows_.size(), work);
    factor.solve(values_);
  }

  bool damp() {
    plan(rows_, kept_.size(), damped_);
    return factor_compliant(rows_, kJointSettings.damping, damped_);
  }

  void keep(const std::vector<Body<D>>& bodies) {
    kept_.clear();
    for (const Body<D>& body : bodies)
      kept_.push_back({body.position, body.orientation, body.angular_momentum});
  }

  void restore(std::vector<Body<D>>& bodies) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies[i].position = kept_[i].position;
      bodies[i].orientation = kept_[i].orientation;
      bodies[i].angular_momentum = kept_[i].angular_momentum;
    }
  }

  static double angle_between(const Rotation<D>& a, const Rotation<D>& b) {
    if constexpr (D == 2) {
      return std::abs(a.angle - b.angle);
    } else {
      const glm::dquat q = a.q * glm::conjugate(b.q);
      return 2 * std::asin(std::min(1.0, std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z)));
    }
  }

  // How far the bodies have come from where they were kept, at most: of their surfaces.
  double way_of(const std::vector<Body<D>>& bodies) const {
    double most = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i].kind != BodyKind::dynamic_body) continue;
      const double turn = angle_between(bodies[i].orientation, kept_[i].orientation);
      most = std::max(most, glm::length(bodies[i].position - kept_[i].position) +
                                turning_reach<D>(bodies[i].shape) * turn);
    }
    return most;
  }

  // The largest one.
  double find_errors(std::vector<JointRows<D>>& joints, const std::vector<Body<D>>& bodies) {
    for (JointRows<D>& joint : joints) joint.find_gap(bodies[joint.a], bodies[joint.b]);
    double worst = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      values_[r] = -glm::dot(joints[joint_of_[r]].error(), rows_[r].direction);
      worst = std::max(worst, std::abs(values_[r]));
    }
    return worst;
  }

  void move(std::vector<Body<D>>& bodies, double share) const {
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

  std::vector<ConstraintRow<D>> rows_;
  std::vector<std::uint32_t> joint_of_;  // of each row
  EnvelopeSystem factor_, damped_;
  bool solved_ = false;
  std::vector<KeptPlace> kept_;
  std::vector<double> values_;  // what is missing, then impulses
};

extern template class JointBlock<2>;
extern template class JointBlock<3>;

}  // namespace lantern::physics
