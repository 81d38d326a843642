#include "draw/pen.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <tuple>

#include "geometry/elementary.hpp"
#include "geometry/not_finite.hpp"
#include "geometry/ray.hpp"

namespace lantern::draw {
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
      points.push_back(center + unit_at(angle) * radius);
    }
  }
  return points;
}

void keep_part(DrawShape shape, const Box<2>& rect, Pen& pen, DrawList& kept) {
  if (auto* line = std::get_if<LineShape>(&shape)) {
    const auto part = cut_line(line->from, line->to, rect);
    if (!part) return;
    std::tie(line->from, line->to) = *part;
  } else if (const auto* box = std::get_if<RectShape>(&shape); box && !holds(rect, box->box)) {
    shape = PolygonShape{outline_of(*box), box->fill, box->stroke};
  }
  auto* polygon = std::get_if<PolygonShape>(&shape);
  if (!polygon ||
      std::ranges::all_of(polygon->points, [&](const Vec<2>& p) { return contains(rect, p); })) {
    kept.shapes.push_back(std::move(shape));
    return;
  }
  const Stroke stroke = polygon->stroke;
  const std::vector<Vec<2>> inside = cut_to(polygon->points, rect);
  if (inside.size() >= 3 && polygon->fill != Role::none) kept.polygon(inside, polygon->fill);
  if (stroke.role != Role::none) pen.path(polygon->points, true, stroke);
}

}  // namespace

std::vector<Vec<2>> cut_to(std::vector<Vec<2>> polygon, const Box<2>& rect) {
  polygon = clipped(polygon, Plane<2>{{1, 0}, rect.lo.x}, true);
  polygon = clipped(polygon, Plane<2>{{1, 0}, rect.hi.x}, false);
  polygon = clipped(polygon, Plane<2>{{0, 1}, rect.lo.y}, true);
  return clipped(polygon, Plane<2>{{0, 1}, rect.hi.y}, false);
}

void cut_shapes(DrawList& list, std::size_t first, const Box<2>& rect) {
  const auto begin = list.shapes.begin() + static_cast<std::ptrdiff_t>(first);
  std::vector<DrawShape> whole(std::make_move_iterator(begin),
                               std::make_move_iterator(list.shapes.end()));
  list.shapes.resize(first);
  for (DrawShape& shape : whole) {
    if (const auto* line = std::get_if<LineShape>(&shape))
      if (contains(rect, line->from) && contains(rect, line->to)) list.shapes.push_back(shape);
    if (const auto* s = std::get_if<RectShape>(&shape))
      shape = PolygonShape{outline_of(*s), s->fill, s->stroke};
    auto* polygon = std::get_if<PolygonShape>(&shape);
    if (!polygon) continue;
    polygon->points = cut_to(std::move(polygon->points), rect);
    if (!polygon->points.empty()) list.shapes.push_back(std::move(shape));
  }
}

void keep_within(DrawList& list, std::size_t first, const Box<2>& rect) {
  DrawList kept;
  Pen pen(kept, rect);
  std::vector<std::size_t> place_of;  // of each shape from `first` on
  for (std::size_t i = first; i < list.shapes.size(); ++i) {
    place_of.push_back(first + kept.shapes.size());
    keep_part(std::move(list.shapes[i]), rect, pen, kept);
  }
  place_of.push_back(first + kept.shapes.size());
  list.shapes.resize(first);
  std::ranges::move(kept.shapes, std::back_inserter(list.shapes));
  for (KeyedRun& run : list.runs)
    if (run.first > first) run.first = place_of[run.first - first];
}

std::optional<std::pair<Vec<2>, Vec<2>>> cut_line(const Vec<2>& from, const Vec<2>& to,
                                                  const Box<2>& rect) {
  if (!is_finite(from) || !is_finite(to - from)) return std::nullopt;
  const auto seen = span_in(Ray<2>{from, to - from, 1}, rect);
  if (!seen) return std::nullopt;
  // Rounding may lead an end beside the rectangle by a hair.
  const auto at = [&](double share) {
    return glm::clamp(from + (to - from) * share, rect.lo, rect.hi);
  };
  return std::pair{contains(rect, from) ? from : at(seen->from),
                   contains(rect, to) ? to : at(seen->to)};
}

void Pen::line(const Vec<2>& from, const Vec<2>& to, const Stroke& stroke, double casing) {
  const auto part = cut_line(from, to, place_);
  if (!part) return;
  if (casing > 0) list_.line(part->first, part->second, {Role::panel, stroke.width + 2 * casing});
  list_.line(part->first, part->second, stroke);
}

void Pen::path(const std::vector<Vec<2>>& points, bool closed, const Stroke& stroke) {
  for (std::size_t i = 1; i < points.size(); ++i) line(points[i - 1], points[i], stroke);
  if (closed && points.size() > 2) line(points.back(), points.front(), stroke);
}

void Pen::arrow(const Vec<2>& from, const Vec<2>& to, const Stroke& stroke, double head,
                double casing) {
  const Vec<2> way = to - from;
  const double length = geometry::hypot(way.x, way.y);
  if (!std::isfinite(length) || !(length > 1e-6)) return;
  head = std::min(head, 0.8 * length);
  line(from, to - way * (0.7 * head / length), stroke, casing);
  polygon(arrow_head(from, to, head), stroke.role,
          casing > 0 ? Stroke{Role::panel, 1.2} : Stroke{});
}

void Pen::dot(const Vec<2>& center, double radius, Role fill, const Stroke& stroke) {
  if (is_finite(center) && holds(place_, Box<2>::around(center, Vec<2>(radius))))
    list_.disc(center, radius, fill, stroke);
}

void Pen::polygon(std::vector<Vec<2>> points, Role fill, const Stroke& stroke) {
  if (!std::ranges::all_of(points, is_finite<2>)) return;
  const bool whole =
      std::ranges::all_of(points, [&](const Vec<2>& p) { return contains(place_, p); });
  if (!whole) points = cut_to(std::move(points), place_);
  if (points.size() >= 3) list_.polygon(std::move(points), fill, stroke);
}

void Pen::hatch(const std::vector<Vec<2>>& polygon, double space, int lean, const Stroke& stroke,
                int most) {
  const std::vector<Vec<2>> part = cut_to(polygon, place_);
  if (part.size() < 3) return;
  // On a diagonal x + lean * y is constant.
  const auto place = [&](const Vec<2>& p) { return p.x + lean * p.y; };
  double least = place(part[0]), last = least;
  for (const Vec<2>& p : part) {
    least = std::min(least, place(p));
    last = std::max(last, place(p));
  }
  if (!std::isfinite(least) || !std::isfinite(last) || most < 1) return;
  while ((last - least) / space > most) space *= 2;
  for (double at = std::ceil(least / space) * space; at < last; at += space) {
    Vec<2> ends[2];
    int found = 0;
    for (std::size_t i = 0; i < part.size() && found < 2; ++i) {
      const Vec<2>&a = part[i], &b = part[(i + 1) % part.size()];
      const double da = place(a) - at, db = place(b) - at;
      if ((da < 0) == (db < 0)) continue;
      ends[found++] = a + (b - a) * (da / (da - db));
    }
    if (found == 2) line(ends[0], ends[1], stroke);
  }
}

std::vector<Vec<2>> arrow_head(const Vec<2>& from, const Vec<2>& to, double head) {
  const Vec<2> along = glm::normalize(to - from);
  const Vec<2> neck = to - along * head, side = Vec<2>(-along.y, along.x) * (0.48 * head);
  return {to, neck + side, neck + along * (0.22 * head), neck - side};
}

std::vector<Vec<2>> ring_of(const Vec<2>& center, double radius, int corners, double turn) {
  std::vector<Vec<2>> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 2 * std::numbers::pi * i / corners;
    points.push_back(center + unit_at(angle) * radius);
  }
  return points;
}

Vec<2> middle_of(const std::vector<Vec<2>>& points) {
  Vec<2> sum{0.0};
  for (const Vec<2>& p : points) sum += p;
  return sum / static_cast<double>(std::max<std::size_t>(1, points.size()));
}

}  // namespace lantern::draw
