// Half a kick along the joints, fly, half a kick: RATTLE, velocity Verlet with joints. Symplectic
// and the same backwards in time, with free rotation as with free flight.
#include "physics/constrained_motion.hpp"

namespace lantern::physics {

template <int D>
bool constrained_verlet(ConstrainedPart<D>& part) {
  SmoothSystem<D>& system = part.system;
  JointSystem<D>& joints = part.joints;
  SmoothState<D>& state = part.state;
  const double h = part.h;
  Pull<D> pull = system.evaluate(state);
  system.kick(state, pull, h / 2);
  // If it fails, an estimate of the tension is there all the same.
  const bool held = joints.hold_at_end(state, h);
  if (!part.follows(joints.swing_squared(joints.impulses(), h / 2)) || !held) return false;
  joints.look(state);
  if (!joints.factor()) return false;
  if (system.any_damping()) return constrained_damped_kick(part, h / 2);
  system.evaluate(state, pull);
  for (const std::size_t i : system.movers()) {
    state.kick[i] += h / 2 * pull.acceleration[i];
    state.twist[i] += h / 2 * pull.torque[i];
  }
  return joints.stop_parting(state, true);
}

template bool constrained_verlet(ConstrainedPart<2>&);
template bool constrained_verlet(ConstrainedPart<3>&);

}  // namespace lantern::physics
