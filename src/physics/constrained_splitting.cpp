// Kick along the joints, fly, kick: SHAKE with semi-implicit Euler, RATTLE with velocity Verlet.
// The second is symplectic and the same backwards in time, with free rotation as with free flight.
#include "physics/constrained_motion.hpp"

namespace lantern::physics {

template <int D>
bool constrained_splitting(ConstrainedPart<D>& part, Integrator integrator) {
  SmoothSystem<D>& system = part.system;
  JointSystem<D>& joints = part.joints;
  SmoothState<D>& state = part.state;
  const double h = part.h;
  const bool whole = integrator == Integrator::semi_implicit_euler;
  const double first = whole ? h : h / 2;
  system.kick(state, system.evaluate(state), first);
  // If it fails, an estimate of the tension is there all the same.
  const bool held = joints.hold_at_end(state, h);
  if (!part.follows(joints.swing_squared(joints.impulses(), first)) || !held) return false;
  joints.look(state);
  if (!joints.factor()) return false;
  if (whole) return joints.stop_parting(state, true);
  if (system.any_damping()) return constrained_damped_kick(part, h / 2);
  const Pull<D> pull = system.evaluate(state);
  for (const std::size_t i : system.movers()) {
    state.kick[i] += h / 2 * pull.acceleration[i];
    state.twist[i] += h / 2 * pull.torque[i];
  }
  return joints.stop_parting(state, true);
}

template bool constrained_splitting(ConstrainedPart<2>&, Integrator);
template bool constrained_splitting(ConstrainedPart<3>&, Integrator);

}  // namespace lantern::physics
