#include "fuzz/energy.hpp"

#include <algorithm>
#include <cmath>

namespace lantern::fuzz {
namespace {

bool moves_by_itself(const BodySpec& body) {
  return body.brain != Brain::none || (body.kind == BodyKind::kinematic_body &&
                                       (body.velocity != Vec<3>(0.0) || body.spin != 0));
}

bool passes_time(const Verb& verb) {
  return std::holds_alternative<Run>(verb) || std::holds_alternative<Wait>(verb) ||
         std::holds_alternative<Phases>(verb) || std::holds_alternative<Show>(verb);
}

}  // namespace

EnergyMeter::EnergyMeter(const Scenario& scenario) : scenario_(scenario) {
  const WorldSpec& world = scenario.world;
  const bool shown_failing = world.integrator == Integrator::explicit_euler ||
                             world.rotation == RotationMethod::explicit_gyroscopic;
  applies_ = !scenario.bodies.empty() && !shown_failing;
  for (const BodySpec& body : scenario.bodies)
    applies_ = applies_ && !moves_by_itself(body) &&
               body.integrator != std::optional(Integrator::explicit_euler) &&
               body.rotation != std::optional(RotationMethod::explicit_gyroscopic);
  for (const Step& step : scenario.steps)
    if (const auto* force = std::get_if<ApplyForce>(&step.verb))
      applies_ = applies_ && force->force == Vec<3>(0.0);
}

void EnergyMeter::look(const Frame& frame) {
  if (!applies_) return;
  const auto energy = frame.measure("energy"), kinetic = frame.measure("kinetic_energy"),
             potential = frame.measure("potential_energy");
  if (!energy || !kinetic || !potential) return;
  if (!running_ || !passes_time(scenario_.steps[frame.step].verb)) {
    running_ = true;
    lowest_ = *energy;
    kinetic_ = *kinetic;
    low_potential_ = high_potential_ = *potential;
    return;
  }
  low_potential_ = std::min(low_potential_, *potential);
  high_potential_ = std::max(high_potential_, *potential);
  lowest_ = std::min(lowest_, *energy);
  const double scale = kinetic_ + (high_potential_ - low_potential_) +
                       1e-9 * (std::abs(lowest_) + high_potential_ - low_potential_) + 1e-6;
  growth_ = std::max(growth_, (*energy - lowest_) / scale);
}

}  // namespace lantern::fuzz
