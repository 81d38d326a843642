// The metrics of problems whose bodies never touch. Each reads masses, springs, drag, gravity,
// places and speeds from the scenario, and throws Refused, naming what is wrong, if the scenario is
// not that problem.
#pragma once

#include <memory>

#include "measure/error_metric.hpp"

namespace lantern {

// Any number of bodies that are thrown, with or without drag. "traj" is relative to the longest way
// from the start and the greatest speed.
std::unique_ptr<ErrorMetric> projectile_metric(const Scenario& scenario);

// One body on one spring to a fixed point, under any damping: along a line, or, if the spring has
// no rest length and no damping, in any direction. "traj" is relative to the amplitude that it
// would have undamped, and to that times the frequency.
std::unique_ptr<ErrorMetric> oscillator_metric(const Scenario& scenario);

// Bodies in a row between one or two fixed points, tied each to the next by springs without
// damping, moving along the row. "traj" is relative to the greatest way from rest and the greatest
// speed of any of them, at about 20 moments.
std::unique_ptr<ErrorMetric> chain_metric(const Scenario& scenario);

// Two bodies that attract each other, one of which may be static. "traj" is relative to half the
// greater axis and the speed on a circle of that radius.
std::unique_ptr<ErrorMetric> kepler_metric(const Scenario& scenario);

// One body on a rod, or a stiff spring as long as it is at rest. "traj" is relative to the rod's
// length, and to that times sqrt(g / length); "joint" is how much longer or shorter the rod has
// become, relative to its length.
std::unique_ptr<ErrorMetric> pendulum_metric(const Scenario& scenario);

// One body that turns freely in a solid world. "att" is the angle, in radians, by which its
// orientation is off.
std::unique_ptr<ErrorMetric> free_top_metric(const Scenario& scenario);

}  // namespace lantern
