// Runge-Kutta on accelerations that satisfy the joints. An orientation is the start's, turned by a
// rotation vector u, whose rate follows from the angular velocity w (Munthe-Kaas):
//
//   du/dt = w - u x w / 2 + u x (u x w) / 12 + ...
//
// of which order 4 needs no more. What the method leaves undone of the joints, of its own order, is
// projected out along their impulses, of the places first and then of the velocities.
#include <array>
#include <vector>

#include "physics/constrained_motion.hpp"

namespace lantern::physics {
namespace {

// A method each of whose looks is from where the one before leads.
struct Tableau {
  int looks;
  std::array<double, 4> way;     // to the next look, of h
  std::array<double, 4> weight;  // in the sum
};
constexpr Tableau kEuler{1, {}, {1}};
constexpr Tableau kClassical{4, {0.5, 0.5, 1}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};

double rotation_rate(double, double spin) { return spin; }
Vec<3> rotation_rate(const Vec<3>& u, const Vec<3>& spin) {
  const Vec<3> once = glm::cross(u, spin);
  return spin - once * 0.5 + glm::cross(u, once) / 12.0;
}

template <int D>
class RungeKutta {
 public:
  RungeKutta(ConstrainedPart<D>& part, const Tableau& tableau)
      : part_(part),
        system_(part.system),
        joints_(part.joints),
        state_(part.state),
        h_(part.h),
        tableau_(tableau),
        slopes_(system_.movers().size()),
        sums_(system_.movers().size()) {}

  bool run() {
    for (int look = 0; look < tableau_.looks; ++look) {
      if (look > 0) {
        go(slopes_, tableau_.way[look - 1] * h_);
        joints_.look(state_);
        if (!joints_.factor()) return false;
      }
      find_slopes(tableau_.weight[look]);
      if (look == 0 &&
          !(h_ * h_ * joints_.swing_squared(joints_.last(), 1) <= kJointSettings.most_swing))
        return false;
    }
    go(sums_, h_);
    if (!joints_.close_gaps(state_)) return false;
    joints_.look(state_);
    return joints_.stop_parting(state_, true);
  }

 private:
  struct Slope {
    Vec<D> velocity{0.0}, acceleration{0.0};
    Spin<D> turning{0.0}, torque{0.0};
    Spin<D> turned{0.0};  // the rotation vector at which it was taken
  };

  void find_slopes(double weight) {
    system_.evaluate(state_, pull_);
    joints_.hold_accelerations(state_, pull_, weight * h_);
    for (std::size_t n = 0; n < slopes_.size(); ++n) {
      const std::size_t i = system_.movers()[n];
      Slope& slope = slopes_[n];
      slope.velocity = system_.velocity(state_, i);
      slope.acceleration = pull_.acceleration[i];
      Slope& sum = sums_[n];
      sum.velocity += slope.velocity * weight;
      sum.acceleration += slope.acceleration * weight;
      if (!system_.turns(i)) continue;
      slope.turning = rotation_rate(slope.turned, system_.angular_velocity(state_, i));
      slope.torque = pull_.torque[i];
      sum.turning += slope.turning * weight;
      sum.torque += slope.torque * weight;
    }
  }

  // To where the slopes lead from the start.
  void go(std::vector<Slope>& slopes, double time) {
    const std::span<const Body<D>> bodies = system_.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i].kind != BodyKind::kinematic_body) continue;
      state_.shift[i] = time * bodies[i].velocity;
      state_.orientation[i] =
          turned(bodies[i].orientation, Spin<D>(bodies[i].kinematic_spin * time));
    }
    for (std::size_t n = 0; n < slopes.size(); ++n) {
      const std::size_t i = system_.movers()[n];
      state_.shift[i] = time * slopes[n].velocity;
      state_.kick[i] = time * slopes[n].acceleration;
      if (!system_.turns(i)) continue;
      slopes[n].turned = time * slopes[n].turning;
      state_.twist[i] = time * slopes[n].torque;
      state_.orientation[i] = turned(bodies[i].orientation, slopes[n].turned);
    }
  }

  ConstrainedPart<D>& part_;
  SmoothSystem<D>& system_;
  JointSystem<D>& joints_;
  SmoothState<D>& state_;
  double h_;
  const Tableau& tableau_;
  Pull<D> pull_;
  std::vector<Slope> slopes_, sums_;  // one a mover
};

}  // namespace

template <int D>
bool constrained_runge_kutta(ConstrainedPart<D>& part, Integrator integrator) {
  const bool euler = integrator == Integrator::explicit_euler;
  return RungeKutta<D>(part, euler ? kEuler : kClassical).run();
}

template bool constrained_runge_kutta(ConstrainedPart<2>&, Integrator);
template bool constrained_runge_kutta(ConstrainedPart<3>&, Integrator);

}  // namespace lantern::physics
