// How colours look to people, for tests: contrast, colour-vision deficiencies, colour distance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "draw/theme.hpp"

namespace lantern::draw::vision {

using Linear = std::array<double, 3>;
enum class Eye { normal, protan, deutan, tritan };

inline double linear(std::uint8_t byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// WCAG 2.1, relative luminance and contrast ratio.
inline double luminance(const Color& c) {
  return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
}
inline double contrast(const Color& a, const Color& b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

// Machado, Oliveira and Fernandes, "A Physiologically-based Model for Simulation of Color Vision
// Deficiency" (2009), severity 1.0, applied to linear light.
inline Linear seen_by(Eye eye, const Color& c) {
  constexpr double kMatrix[4][3][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                       {{0.152286, 1.052583, -0.204868},
                                        {0.114503, 0.786281, 0.099216},
                                        {-0.003882, -0.048116, 1.051998}},
                                       {{0.367322, 0.860646, -0.227968},
                                        {0.280085, 0.672501, 0.047413},
                                        {-0.011820, 0.042940, 0.968881}},
                                       {{1.255528, -0.076749, -0.178779},
                                        {-0.078411, 0.930809, 0.147602},
                                        {0.004733, 0.691367, 0.303900}}};
  const Linear in{linear(c.r), linear(c.g), linear(c.b)};
  Linear out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      out[i] += kMatrix[static_cast<std::size_t>(eye)][i][j] * in[j];
    out[i] = std::clamp(out[i], 0.0, 1.0);
  }
  return out;
}

// CIE 1976 L*a*b* of linear sRGB, white point D65.
inline std::array<double, 3> lab(const Linear& c) {
  const auto f = [](double t) {
    return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  };
  const double x = f((0.4124564 * c[0] + 0.3575761 * c[1] + 0.1804375 * c[2]) / 0.95047);
  const double y = f(0.2126729 * c[0] + 0.7151522 * c[1] + 0.0721750 * c[2]);
  const double z = f((0.0193339 * c[0] + 0.1191920 * c[1] + 0.9503041 * c[2]) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

inline double distance(Eye eye, const Color& a, const Color& b) {
  const auto p = lab(seen_by(eye, a)), q = lab(seen_by(eye, b));
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

}  // namespace lantern::draw::vision
