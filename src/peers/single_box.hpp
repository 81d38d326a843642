// Boxes in single precision, rounded outward: what overlaps in double precision does so here.
#pragma once

#include <cmath>
#include <limits>

namespace lantern::peers {

inline float float_below(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity())
                                    : f;
}
inline float float_above(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

}  // namespace lantern::peers
