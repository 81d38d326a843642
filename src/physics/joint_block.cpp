#include "physics/joint_block.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lantern::physics {
namespace {

double angle_between(const Rotation<2>& a, const Rotation<2>& b) {
  return std::abs(a.angle - b.angle);
}
double angle_between(const Rotation<3>& a, const Rotation<3>& b) {
  const glm::dquat q = a.q * glm::conjugate(b.q);
  return 2 * std::asin(std::min(1.0, std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z)));
}

}  // namespace

template <int D>
void JointBlock<D>::list(const std::vector<JointRows<D>>& joints,
                         const std::vector<SolverBody<D>>& bodies) {
  rows_.clear();
  joint_of_.clear();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const JointRows<D>& joint = joints[i];
    const SolverBody<D>&a = bodies[joint.a], &b = bodies[joint.b];
    if (a.inverse_mass == 0 && b.inverse_mass == 0) continue;
    const bool pin = joint.joint.kind == JointKind::pin;
    for (int k = 0; k < (pin ? D : 1); ++k) {
      JointRow<D> row{.a = joint.a, .b = joint.b, .mass_a = a.inverse_mass};
      row.mass_b = b.inverse_mass;
      Vec<D> along = joint.direction;
      if (pin) {
        along = Vec<D>(0.0);
        along[k] = 1;
      }
      row.set(along, joint.arm_a, a.inverse_inertia, joint.arm_b, b.inverse_inertia);
      rows_.push_back(row);
      joint_of_.push_back(static_cast<std::uint32_t>(i));
    }
  }
}

template <int D>
bool JointBlock<D>::refresh(const std::vector<JointRows<D>>& joints,
                            const std::vector<SolverBody<D>>& bodies) {
  list(joints, bodies);
  if (factor_.lines() != rows_.size()) plan(rows_, bodies.size(), factor_);
  solved_ = !rows_.empty() && factor_.work() <= kJointSettings.most_work &&
            (factor_rows(rows_, kJointSettings.least_part, factor_) ||
             factor_compliant(rows_, kJointSettings.swept_compliance, factor_));
  values_.resize(rows_.size());
  return solved_;
}

template <int D>
void JointBlock<D>::solve(const EnvelopeSystem& factor, WorldWork& work) {
  ++work.direct_solves;
  work.direct_rows += rows_.size();
  work.constraint_rows += rows_.size();
  factor.solve(values_);
}

template <int D>
void JointBlock<D>::solve_velocities(std::vector<JointRows<D>>& joints,
                                     std::vector<SolverBody<D>>& bodies, Sweep& sweep,
                                     WorldWork& work) {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const JointRow<D>& row = rows_[r];
    const JointRows<D>& joint = joints[joint_of_[r]];
    values_[r] = -glm::dot(
        row.direction, relative_velocity(bodies[row.a], joint.arm_a, bodies[row.b], joint.arm_b));
  }
  solve(factor_, work);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const JointRow<D>& row = rows_[r];
    bodies[row.a].apply_along(row.direction, row.turn_a, row.gained_a, -values_[r]);
    bodies[row.b].apply_along(row.direction, row.turn_b, row.gained_b, values_[r]);
    Vec<D>& impulse = joints[joint_of_[r]].impulse;
    impulse += row.direction * values_[r];
    sweep.change = std::max(sweep.change, std::abs(values_[r]));
    sweep.largest = std::max(sweep.largest, glm::length(impulse));
  }
}

template <int D>
void JointBlock<D>::correct_positions(const std::vector<JointRows<D>>& joints,
                                      std::vector<SolverBody<D>>& bodies, Sweep& sweep,
                                      WorldWork& work) {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const JointRow<D>& row = rows_[r];
    const JointRows<D>& joint = joints[joint_of_[r]];
    values_[r] = -glm::dot(row.direction, relative_mean_velocity(bodies[row.a], joint.arm_a,
                                                                 bodies[row.b], joint.arm_b));
  }
  solve(factor_, work);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const JointRow<D>& row = rows_[r];
    bodies[row.a].correct_along(row.direction, row.gained_a, -values_[r]);
    bodies[row.b].correct_along(row.direction, row.gained_b, values_[r]);
    sweep.change = std::max(sweep.change, std::abs(values_[r]));
  }
}

// The largest one.
template <int D>
double JointBlock<D>::find_errors(std::vector<JointRows<D>>& joints,
                                  const std::vector<Body<D>>& bodies) {
  for (JointRows<D>& joint : joints) joint.find_gap(bodies[joint.a], bodies[joint.b]);
  double worst = 0;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    values_[r] = -glm::dot(joints[joint_of_[r]].error(), rows_[r].direction);
    worst = std::max(worst, std::abs(values_[r]));
  }
  return worst;
}

template <int D>
void JointBlock<D>::move(std::vector<Body<D>>& bodies, double share) const {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const JointRow<D>& row = rows_[r];
    const double by = values_[r] * share;
    bodies[row.a].position -= row.direction * (row.mass_a * by);
    bodies[row.b].position += row.direction * (row.mass_b * by);
    if (row.gained_a != Spin<D>(0.0))
      turn_with_momentum(bodies[row.a], Spin<D>(row.gained_a * -by));
    if (row.gained_b != Spin<D>(0.0)) turn_with_momentum(bodies[row.b], Spin<D>(row.gained_b * by));
  }
}

template <int D>
void JointBlock<D>::keep(const std::vector<Body<D>>& bodies) {
  kept_.clear();
  for (const Body<D>& body : bodies)
    kept_.push_back({body.position, body.orientation, body.angular_momentum});
}

template <int D>
void JointBlock<D>::restore(std::vector<Body<D>>& bodies) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].position = kept_[i].position;
    bodies[i].orientation = kept_[i].orientation;
    bodies[i].angular_momentum = kept_[i].angular_momentum;
  }
}

// How far the bodies have come from where they were kept, at most: of their surfaces.
template <int D>
double JointBlock<D>::way_of(const std::vector<Body<D>>& bodies) const {
  double most = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].kind != BodyKind::dynamic_body) continue;
    const double turn = angle_between(bodies[i].orientation, kept_[i].orientation);
    most = std::max(most, glm::length(bodies[i].position - kept_[i].position) +
                              turning_reach<D>(bodies[i].shape) * turn);
  }
  return most;
}

template <int D>
bool JointBlock<D>::damp() {
  plan(rows_, kept_.size(), damped_);
  return factor_compliant(rows_, kJointSettings.damping, damped_);
}

template <int D>
void JointBlock<D>::close_gaps(std::vector<JointRows<D>>& joints, std::vector<Body<D>>& bodies,
                               double h, WorldWork& work) {
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

template class JointBlock<2>;
template class JointBlock<3>;

}  // namespace lantern::physics
