#include "render/dashes.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/ray.hpp"

namespace lantern::render {
namespace {

// How far square ends must reach beyond a corner to close its notch: tan of half the turn times
// half the width, for right turns and sharper ones half the width.
double reach_at_corner(const Vec<2>& in, const Vec<2>& out, double width) {
  const double cosine = glm::dot(in, out);
  if (cosine <= 0) return 0.5 * width;
  const double sine = std::abs(in.x * out.y - in.y * out.x);
  return 0.5 * width * sine / (1 + cosine);
}

}  // namespace

std::vector<DashPiece> cut_dashes(const std::vector<Vec<2>>& points, bool closed, double dash,
                                  double width, const Box<2>& visible) {
  std::vector<DashPiece> pieces;
  std::vector<Vec<2>> corners;  // without repeated points
  for (const Vec<2>& p : points)
    if (corners.empty() || corners.back() != p) corners.push_back(p);
  if (closed && corners.size() > 1 && corners.front() != corners.back())
    corners.push_back(corners.front());
  const std::size_t segments = corners.empty() ? 0 : corners.size() - 1;
  const auto direction = [&](std::size_t i) { return glm::normalize(corners[i + 1] - corners[i]); };
  const Box<2> near{visible.lo - Vec<2>(width), visible.hi + Vec<2>(width)};
  const double period = 2 * dash;
  double start = 0;  // way along the outline to the segment's first point
  for (std::size_t i = 0; i < segments; ++i) {
    const Vec<2> from = corners[i], to = corners[i + 1], along = direction(i);
    const double length = glm::length(to - from);
    const RaySpan seen = span_in(Ray<2>{from, to - from, 1}, near).value_or(RaySpan{1, 0});
    const double before = i > 0 ? reach_at_corner(direction(i - 1), along, width) : 0;
    const double after = i + 1 < segments ? reach_at_corner(along, direction(i + 1), width) : 0;
    double number = std::floor((start + seen.from * length) / period);
    for (; seen.from <= seen.to && number * period < start + seen.to * length; ++number) {
      const double a = number * period - start, b = a + dash;  // from the segment's first point
      if (b <= 0 || a >= length) continue;
      const double first = a < 0 ? -before : a;
      const double last = b > length ? length + after : b;
      pieces.push_back({from + along * first, from + along * last});
    }
    start += length;
  }
  return pieces;
}

std::vector<Vec<2>> outline_of(const Box<2>& box, double radius) {
  std::vector<Vec<2>> points;
  // A chord over an angle t leaves the arc by r t^2 / 8.
  const int steps = radius <= 0 ? 0 : 1 + static_cast<int>(std::sqrt(3.1 * std::min(radius, 1e4)));
  const Vec<2> lo = box.lo + Vec<2>(radius), hi = box.hi - Vec<2>(radius);
  const Vec<2> centers[] = {{hi.x, lo.y}, {hi.x, hi.y}, {lo.x, hi.y}, {lo.x, lo.y}};
  Vec<2> from{0, -1}, to{1, 0};
  for (const Vec<2>& center : centers) {
    for (int i = 0; i <= steps; ++i) {
      // The quarter circle by its rational parameter: sines differ from one C library to the next.
      const double t = steps == 0 ? 0 : static_cast<double>(i) / steps;
      const double c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
      points.push_back(center + radius * (c * from + s * to));
    }
    from = to;
    to = {-to.y, to.x};
  }
  return points;
}

}  // namespace lantern::render
