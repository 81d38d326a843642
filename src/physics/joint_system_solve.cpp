// What is solved of a system of joints: places, velocities, accelerations.
#include <cmath>
#include <limits>

#include "physics/joint_system.hpp"

namespace lantern::physics {
namespace {

// What turns the angular velocity of a body that nothing turns: in the plane nothing.
double gyroscopic(double, double) { return 0; }
Vec<3> gyroscopic(const Vec<3>& spin, const Vec<3>& momentum) { return glm::cross(momentum, spin); }

}  // namespace

template <int D>
void JointSystem<D>::kick(State& state, std::span<const double> impulses) const {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Row& row = rows_[r];
    state.kick[row.a] -= row.direction * (row.mass_a * impulses[r]);
    state.kick[row.b] += row.direction * (row.mass_b * impulses[r]);
    if (frames_[row.a].turns) state.twist[row.a] -= row.turn_a * impulses[r];
    if (frames_[row.b].turns) state.twist[row.b] += row.turn_b * impulses[r];
  }
}

// missing() fills in what is missing and gives the worst of it in units of rounding; mend() uses
// the impulses that follow.
template <int D>
template <class Missing, class Mend>
bool JointSystem<D>::settle(Missing&& missing, Mend&& mend) {
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

template <int D>
bool JointSystem<D>::close_gaps(State& state) {
  return settle([&] { return find_errors(state); },
                [&] {
                  for (std::size_t r = 0; r < rows_.size(); ++r) {
                    const Row& row = rows_[r];
                    const auto move = [&](std::uint32_t i, double mass, const Spin<D>& gained,
                                          double by) {
                      state.shift[i] += row.direction * (mass * by);
                      if (frames_[i].turns)
                        state.orientation[i] = turned(state.orientation[i], gained * by);
                    };
                    move(row.a, row.mass_a, row.gained_a, -values_[r]);
                    move(row.b, row.mass_b, row.gained_b, values_[r]);
                  }
                });
}

template <int D>
bool JointSystem<D>::stop_parting(State& state, bool counts) {
  return settle([&] { return missing_speed(state); },
                [&] {
                  kick(state, values_);
                  for (std::size_t r = 0; counts && r < rows_.size(); ++r)
                    impulses_[r] += values_[r];
                });
}

template <int D>
bool JointSystem<D>::hold_at_end(State& state, double h) {
  system_.fly(state, state, h);
  return settle([&] { return find_errors(state); },
                [&] {
                  for (double& value : values_) value /= h;
                  kick(state, values_);
                  for (std::size_t r = 0; r < rows_.size(); ++r) impulses_[r] += values_[r];
                  system_.fly(state, state, h);
                });
}

template <int D>
void JointSystem<D>::hold_accelerations(const State& state, Pull<D>& pull, double time) {
  find_velocities(state);
  const int rounds = compliant_ ? kJointSettings.compliant_rounds : 1;
  for (int round = 0; round < rounds; ++round) {
    for (const Hold& hold : holds_)
      for (const std::uint32_t i : {hold.joint->a, hold.joint->b}) {
        Frame& frame = frames_[i];
        frame.acceleration = pull.acceleration[i];
        if (!frame.turns) continue;
        const Spin<D> momentum = system_.bodies()[i].angular_momentum + state.twist[i];
        frame.turning = frame.inverse_inertia * (pull.torque[i] + gyroscopic(frame.spin, momentum));
      }
    for (const Hold& hold : holds_) {
      const Frame& a = frames_[hold.joint->a];
      const Frame& b = frames_[hold.joint->b];
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
        for (int k = 0; k < D; ++k) values_[hold.first + static_cast<std::size_t>(k)] = -parting[k];
      }
    }
    solve();
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const Row& row = rows_[r];
      pull.acceleration[row.a] -= row.direction * (row.mass_a * values_[r]);
      pull.acceleration[row.b] += row.direction * (row.mass_b * values_[r]);
      if (frames_[row.a].turns) pull.torque[row.a] -= row.turn_a * values_[r];
      if (frames_[row.b].turns) pull.torque[row.b] += row.turn_b * values_[r];
      impulses_[r] += values_[r] * time;
    }
  }
}

#define LANTERN_INSTANTIATE(D)                               \
  template bool JointSystem<D>::close_gaps(State&);          \
  template bool JointSystem<D>::stop_parting(State&, bool);  \
  template bool JointSystem<D>::hold_at_end(State&, double); \
  template void JointSystem<D>::hold_accelerations(const State&, Pull<D>&, double);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
