// A damped oscillator: m x'' + c x' + k x = 0.
#pragma once

namespace lantern {

struct Swing {
  long double x = 0;
  long double v = 0;
};

// `time` >= 0 seconds after `start`, for any stiffness > 0, damping >= 0 and mass > 0: below, at
// and above critical damping, and without cancellation near it. The phase is kept to twice the
// length of a long double, so that a million periods lose nothing.
Swing exact_swing(long double stiffness, long double damping, long double mass, Swing start,
                  long double time);

}  // namespace lantern
