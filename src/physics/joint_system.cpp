#include "physics/joint_system.hpp"

#include <algorithm>
#include <cmath>

namespace lantern::physics {
namespace {

double size_of_spin(double spin) { return std::abs(spin); }
double size_of_spin(const Vec<3>& spin) { return glm::length(spin); }

double inverse_inertia_at(const Body<2>& body, const Mat<2>&) { return body.inverse_inertia; }
Mat<3> inverse_inertia_at(const Body<3>& body, const Mat<3>& axes) {
  Mat<3> scaled = axes;
  for (int i = 0; i < 3; ++i) scaled[i] *= body.inverse_inertia[i];
  return scaled * glm::transpose(axes);
}

}  // namespace

template <int D>
JointSystem<D>::JointSystem(SmoothSystem<D>& system, std::span<const JointRows<D>> joints,
                            WorldWork& work)
    : system_(system), work_(work), frames_(system.bodies().size()) {
  const std::span<const Body<D>> bodies = system.bodies();
  const auto hold_off_centre = [&](std::uint32_t i) {
    frames_[i].off_centre = true;
    system.turn_also(i);
    frames_[i].turns = system.turns(i);
    if (system.moves(i) && !system.turns(i) && bodies[i].inverse_inertia != Spin<D>(0.0))
      can_be_solved_ = false;
    frames_[i].axes = matrix(bodies[i].orientation);
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

template <int D>
void JointSystem<D>::add(const JointRows<D>& joint) {
  const Body<D>& a = system_.bodies()[joint.a];
  const Body<D>& b = system_.bodies()[joint.b];
  Hold hold{.joint = &joint, .first = rows_.size()};
  hold.width = joint.joint.kind == JointKind::pin ? D : 1;
  const double lengths =
      joint.joint.length + glm::length(joint.joint.at_a) + glm::length(joint.joint.at_b);
  hold.size = std::max(lengths, std::min(thickness<D>(a.shape), thickness<D>(b.shape)));
  hold.tolerance =
      kJointSettings.rounding * (lengths + glm::length(a.position) + glm::length(b.position));
  holds_.push_back(hold);
  Row row{.a = joint.a, .b = joint.b};
  if (system_.moves(joint.a)) row.mass_a = a.inverse_mass;
  if (system_.moves(joint.b)) row.mass_b = b.inverse_mass;
  for (int k = 0; k < hold.width; ++k) {
    row.direction = Vec<D>(0.0);
    row.direction[k] = 1;
    rows_.push_back(row);
  }
}

template <int D>
void JointSystem<D>::place(const State& state) {
  for (std::size_t i = 0; i < frames_.size(); ++i)
    if (frames_[i].turns || (frames_[i].off_centre && system_.bodies()[i].moves()))
      frames_[i].axes = matrix(state.orientation[i]);
  const std::span<const Body<D>> bodies = system_.bodies();
  for (Hold& hold : holds_) {
    stop_if_asked();
    const std::uint32_t a = hold.joint->a, b = hold.joint->b;
    hold.arm_a = frames_[a].axes * hold.joint->joint.at_a;
    hold.arm_b = frames_[b].axes * hold.joint->joint.at_b;
    hold.gap = (bodies[b].position - bodies[a].position) + (state.shift[b] - state.shift[a]) +
               (hold.arm_b - hold.arm_a);
    if (hold.width == 1) hold.length = glm::length(hold.gap);
  }
}

template <int D>
void JointSystem<D>::look(const State& state) {
  place(state);
  for (std::size_t i = 0; i < frames_.size(); ++i)
    if (frames_[i].turns)
      frames_[i].inverse_inertia = inverse_inertia_at(system_.bodies()[i], frames_[i].axes);
  for (const Hold& hold : holds_) {
    const Frame& a = frames_[hold.joint->a];
    const Frame& b = frames_[hold.joint->b];
    for (std::size_t r = hold.first; r < hold.first + static_cast<std::size_t>(hold.width); ++r) {
      Row& row = rows_[r];
      const Vec<D> along =
          hold.width == 1 && hold.length > 0 ? hold.gap / hold.length : row.direction;
      row.set(along, hold.arm_a, a.inverse_inertia, hold.arm_b, b.inverse_inertia);
    }
  }
}

template <int D>
bool JointSystem<D>::factor() {
  compliant_ = false;
  if (factor_rows(rows_, kJointSettings.least_part, factor_)) return true;
  compliant_ = true;
  return factor_compliant(rows_, kJointSettings.compliance, factor_);
}

template <int D>
void JointSystem<D>::count_solve() const {
  ++work_.direct_solves;
  work_.direct_rows += rows_.size();
  work_.constraint_rows += rows_.size();
}

template <int D>
void JointSystem<D>::solve() {
  count_solve();
  factor_.solve(values_);
}

template <int D>
double JointSystem<D>::find_errors(const State& state) {
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

template <int D>
bool JointSystem<D>::wide_open(double h) const {
  for (const Hold& hold : holds_) {
    const double most =
        std::min(kJointSettings.wide_open * hold.size, kJointSettings.fastest_closing * h);
    for (std::size_t r = hold.first; r < hold.first + static_cast<std::size_t>(hold.width); ++r)
      if (!(std::abs(values_[r]) <= most)) return true;
  }
  return false;
}

template <int D>
void JointSystem<D>::find_velocities(const State& state) {
  for (const Hold& hold : holds_)
    for (const std::uint32_t i : {hold.joint->a, hold.joint->b}) {
      Frame& frame = frames_[i];
      const Body<D>& body = system_.bodies()[i];
      frame.velocity = system_.velocity(state, i);
      if (frame.turns)
        frame.spin = frame.inverse_inertia * (body.angular_momentum + state.twist[i]);
      else if (body.kind == BodyKind::kinematic_body)
        frame.spin = body.kinematic_spin;
    }
}

template <int D>
const std::vector<double>& JointSystem<D>::speeds(const State& state) {
  find_velocities(state);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Row& row = rows_[r];
    const Frame& a = frames_[row.a];
    const Frame& b = frames_[row.b];
    speeds_[r] = glm::dot(row.direction, b.velocity - a.velocity) +
                 (dot(row.turn_b, b.spin) - dot(row.turn_a, a.spin));
  }
  return speeds_;
}

// Against the fastest of all points that are held.
template <int D>
double JointSystem<D>::missing_speed(const State& state) {
  speeds(state);
  double fastest = 0, worst = 0;
  for (const Hold& hold : holds_) {
    const Frame& a = frames_[hold.joint->a];
    const Frame& b = frames_[hold.joint->b];
    fastest =
        std::max({fastest, glm::length(a.velocity) + size_of_spin(a.spin) * glm::length(hold.arm_a),
                  glm::length(b.velocity) + size_of_spin(b.spin) * glm::length(hold.arm_b)});
  }
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    values_[r] = -speeds_[r];
    worst = std::max(worst, std::abs(values_[r]));
  }
  return worst > 0 ? worst / (kJointSettings.rounding * fastest) : 0;
}

template <int D>
double JointSystem<D>::swing_squared(std::span<const double> impulses, double time) const {
  double most = 0;
  for (const Hold& hold : holds_) {
    double square = 0;
    for (int k = 0; k < hold.width; ++k) {
      const double impulse = impulses[hold.first + static_cast<std::size_t>(k)];
      square += impulse * impulse;
    }
    const JointRows<D>& joint = *hold.joint;
    most = std::max(most, joint.swing_squared(system_.bodies()[joint.a], system_.bodies()[joint.b],
                                              std::sqrt(square) / time));
  }
  return most;
}

template <int D>
Vec<D> JointSystem<D>::impulse(const Hold& hold) const {
  Vec<D> sum(0.0);
  for (std::size_t r = hold.first; r < hold.first + static_cast<std::size_t>(hold.width); ++r)
    sum += rows_[r].direction * impulses_[r];
  return sum;
}

template class JointSystem<2>;
template class JointSystem<3>;

}  // namespace lantern::physics
