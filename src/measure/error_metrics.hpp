// The error metrics of all problems. Each reads masses, links, materials, places and speeds from
// the scenario, and throws Refused, naming what is wrong, if the scenario is not that problem.
#pragma once

#include "measure/error_metric.hpp"

namespace lantern {

using MakeErrorMetric = std::unique_ptr<ErrorMetric>(const Scenario&);

// Bodies that never touch.
MakeErrorMetric projectile_metric;  // any number of bodies that are thrown, with or without drag
// One body on one spring to a fixed point, under any damping: along a line, or, if the spring has
// no rest length and no damping, in any direction.
MakeErrorMetric oscillator_metric;
// Bodies in a row between one or two fixed points, tied each to the next by springs without
// damping, moving along the row.
MakeErrorMetric chain_metric;
MakeErrorMetric kepler_metric;  // two bodies that attract each other, one of which may be static
MakeErrorMetric
    pendulum_metric;  // one body on a rod, or on a stiff spring as long as it is at rest
MakeErrorMetric free_top_metric;  // one body that turns freely in 3D

// Bodies in contact.
MakeErrorMetric bouncing_ball_metric;
MakeErrorMetric blocks_and_wall_metric;
MakeErrorMetric collisions_metric;
MakeErrorMetric billiards_metric;
MakeErrorMetric slide_metric;
MakeErrorMetric slip_then_roll_metric;
MakeErrorMetric incline_metric;
MakeErrorMetric topple_metric;
MakeErrorMetric stack_metric;
MakeErrorMetric hanging_chain_metric;

}  // namespace lantern
