#include "geometry/polygon.hpp"

namespace lantern::geometry {

Polygon polygon_of(const Box<2>& box) {
  return {box.lo, {box.hi.x, box.lo.y}, box.hi, {box.lo.x, box.hi.y}};
}

Polygon clipped(const Polygon& polygon, const Plane<2>& line, bool keep_front) {
  const auto height_within = [&](const Vec<2>& p) {
    return keep_front ? height(p, line) : -height(p, line);
  };
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>& from = polygon[i];
    const Vec<2>& to = polygon[(i + 1) % polygon.size()];
    const double a = height_within(from);
    const double b = height_within(to);
    if (a >= 0) kept.push_back(from);
    if ((a > 0 && b < 0) || (a < 0 && b > 0)) kept.push_back(from + (to - from) * (a / (a - b)));
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

}  // namespace lantern::geometry
