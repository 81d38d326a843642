#include "draw/clip.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "draw/metrics.hpp"
#include "geometry/polygon.hpp"

namespace lantern {
namespace {

// A rectangle with round corners as a polygon; a circle gets 32 corners.
std::vector<Vec<2>> outline_of(const RectShape& shape) {
  const Vec<2> size = shape.box.size();
  const double radius = std::min(shape.radius, std::min(size.x, size.y) / 2);
  if (!(radius > 0)) return polygon_of(shape.box);
  constexpr int kPerCorner = 8;
  const Box<2> centers = shrunk(shape.box, radius);
  std::vector<Vec<2>> points;
  for (int corner = 0; corner < 4; ++corner) {
    const Vec<2> center{corner == 0 || corner == 3 ? centers.hi.x : centers.lo.x,
                        corner < 2 ? centers.hi.y : centers.lo.y};
    for (int i = 0; i <= kPerCorner; ++i) {
      const double angle = (corner + i / double(kPerCorner)) * std::numbers::pi / 2;
      points.push_back(center + Vec<2>(std::cos(angle), std::sin(angle)) * radius);
    }
  }
  return points;
}

}  // namespace

std::vector<Vec<2>> cut_to(std::vector<Vec<2>> polygon, const Box<2>& rect) {
  polygon = clipped(polygon, Plane<2>{{1, 0}, rect.lo.x}, true);
  polygon = clipped(polygon, Plane<2>{{1, 0}, rect.hi.x}, false);
  polygon = clipped(polygon, Plane<2>{{0, 1}, rect.lo.y}, true);
  return clipped(polygon, Plane<2>{{0, 1}, rect.hi.y}, false);
}

void cut_shapes(DrawList& list, std::size_t first, const Box<2>& rect) {
  struct Cut {
    DrawList& list;
    const Box<2>& rect;
    void operator()(const RectShape& s) const { polygon(outline_of(s), s.fill, s.stroke); }
    void operator()(const PolygonShape& s) const { polygon(s.points, s.fill, s.stroke); }
    void operator()(const LineShape& s) const {
      if (contains(rect, s.from) && contains(rect, s.to)) list.shapes.emplace_back(s);
    }
    void operator()(const TextShape&) const {}
    void polygon(std::vector<Vec<2>> points, Role fill, const Stroke& stroke) const {
      points = cut_to(std::move(points), rect);
      if (!points.empty()) list.polygon(std::move(points), fill, stroke);
    }
  };
  const auto begin = list.shapes.begin() + static_cast<std::ptrdiff_t>(first);
  const std::vector<DrawShape> whole(std::make_move_iterator(begin),
                                     std::make_move_iterator(list.shapes.end()));
  list.shapes.resize(first);
  for (const DrawShape& shape : whole) std::visit(Cut{list, rect}, shape);
}

// Liang and Barsky, "A New Concept and Method for Line Clipping" (1984).
std::optional<std::pair<Vec<2>, Vec<2>>> cut_line(const Vec<2>& from, const Vec<2>& to,
                                                  const Box<2>& rect) {
  double first = 0, last = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double way = to[axis] - from[axis];
    if (!std::isfinite(from[axis]) || !std::isfinite(way)) return std::nullopt;
    if (way == 0) {
      if (from[axis] < rect.lo[axis] || from[axis] > rect.hi[axis]) return std::nullopt;
      continue;
    }
    const double a = (rect.lo[axis] - from[axis]) / way, b = (rect.hi[axis] - from[axis]) / way;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  if (first > last) return std::nullopt;
  // Rounding may lead an end beside the rectangle by a hair.
  const auto at = [&](double share) {
    Vec<2> p = from + (to - from) * share;
    for (int axis = 0; axis < 2; ++axis)
      p[axis] = std::clamp(p[axis], rect.lo[axis], rect.hi[axis]);
    return p;
  };
  return std::pair{contains(rect, from) ? from : at(first), contains(rect, to) ? to : at(last)};
}

}  // namespace lantern
