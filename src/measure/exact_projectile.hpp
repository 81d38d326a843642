// A body that is thrown, with or without drag: x'' = g - rate x'.
#pragma once

namespace lantern {

struct FlightState {
  long double position = 0;
  long double velocity = 0;
};

// On one axis, `time` >= 0 seconds after the start. `acceleration` is that of gravity, `rate` >= 0
// is drag over mass, in 1/s. Without cancellation for any of them: with rate * time near 0 it is
// the parabola, with a large one the fall at its last speed, acceleration / rate.
FlightState exact_flight(FlightState start, long double acceleration, long double rate,
                         long double time);

}  // namespace lantern
