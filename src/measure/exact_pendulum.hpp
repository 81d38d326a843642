// A point mass on a rod, under gravity: angle'' = -(g / length) sin(angle).
#pragma once

namespace lantern {

struct PendulumState {
  long double angle = 0;  // radians from straight down, within half a turn
  long double speed = 0;  // radians a second
};

// `time` seconds after `start`; `omega` > 0 is sqrt(g / length). Throws Refused if it goes over the
// top, or stands there.
PendulumState exact_pendulum(long double omega, PendulumState start, long double time);

// Seconds of a whole swing from rest at `angle`, above 0 and below half a turn.
long double pendulum_period(long double omega, long double angle);

}  // namespace lantern
