#include <cmath>

#include "measure/closed_forms.hpp"

namespace lantern {
namespace {

// (1 - e^-z) / z, which is 1 at 0.
long double mean_decay(long double z) { return z == 0 ? 1 : -std::expm1(-z) / z; }

// (z - 1 + e^-z) / z^2, which is 1/2 at 0. Below 1 its series, where the formula cancels.
long double mean_lag(long double z) {
  if (z >= 1) return (z + std::expm1(-z)) / (z * z);
  long double sum = 0, term = 0.5L;
  for (int n = 3; n < 40; ++n) {
    sum += term;
    term *= -z / n;
  }
  return sum;
}

}  // namespace

// With z = rate t:  v = v0 e^-z + g t (1 - e^-z)/z,  x = x0 + v0 t (1 - e^-z)/z
//                                                        + g t^2 (z - 1 + e^-z)/z^2.
FlightState exact_flight(FlightState start, long double acceleration, long double rate,
                         long double time) {
  const long double z = rate * time, decay = mean_decay(z);
  return {start.position + time * (start.velocity * decay + acceleration * time * mean_lag(z)),
          start.velocity * std::exp(-z) + acceleration * time * decay};
}

}  // namespace lantern
