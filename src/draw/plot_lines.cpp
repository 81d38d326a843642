#include "draw/plot_lines.hpp"

#include <algorithm>
#include <cmath>

#include "draw/font.hpp"
#include "draw/pen.hpp"
#include "geometry/not_finite.hpp"

namespace lantern::draw {
namespace {

// The ends of lines `reach` long from the origin.
std::vector<Vec<2>> fan(const std::vector<PlotSlope>& slopes, const Vec<2>& decade, double reach) {
  std::vector<Vec<2>> ends;
  for (const PlotSlope& slope : slopes) {
    const Vec<2> direction{decade.x, -slope.exponent * decade.y};
    ends.push_back(direction * (reach / std::hypot(direction.x, direction.y)));
  }
  return ends;
}

double least_height_between(const std::vector<Vec<2>>& ends) {
  double least = 1e9;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) least = std::min(least, std::abs(ends[i].y - ends[k].y));
  return least;
}

}  // namespace

std::vector<Vec<2>> thinned(const std::vector<Vec<2>>& points, std::size_t most) {
  if (points.size() <= most) return points;
  std::vector<Vec<2>> kept;
  const std::size_t parts = most / 4;
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t from = points.size() * part / parts;
    const std::size_t to = points.size() * (part + 1) / parts - 1;
    std::size_t low = from, high = from;
    for (std::size_t i = from; i <= to; ++i) {
      if (points[i].y < points[low].y) low = i;
      if (points[i].y > points[high].y) high = i;
    }
    for (const std::size_t i : {from, std::min(low, high), std::max(low, high), to})
      if (kept.empty() || kept.back() != points[i]) kept.push_back(points[i]);
  }
  return kept;
}

std::vector<Vec<2>> draw_front(const std::vector<Vec<2>>& corners, const Box<2>& area, double width,
                               double rim, DrawList& list) {
  std::vector<Vec<2>> steps;
  for (const Vec<2>& p : corners) {
    if (!is_finite(p)) continue;
    if (!steps.empty()) steps.push_back({p.x, steps.back().y});
    steps.push_back(p);
  }
  if (steps.empty()) return steps;
  steps.insert(steps.begin(), {steps.front().x, area.lo.y});
  steps.push_back({area.hi.x, steps.back().y});
  Pen pen(list, shrunk(area, width / 2 + 1));
  pen.path(steps, false, {Role::lit, width});
  pen.path(steps, false, {Role::lit_fill, width - rim});
  return steps;
}

void name_front(const std::string& text, const std::vector<Vec<2>>& steps, double width,
                TextStyle style, PlotNamer& namer) {
  std::vector<Anchor> anchors;
  const double lift = width / 2 + 0.35 * style.size;
  for (std::size_t i = steps.size(); i-- > 1;) {
    if (steps[i].y != steps[i - 1].y) continue;
    const double right = std::min(steps[i].x - width / 2, steps.back().x) - 4;
    anchors.push_back({{right, steps[i].y - lift}, 1});
    anchors.push_back({{right, steps[i].y + lift + 0.7 * style.size}, 1});
  }
  style.role = Role::lit_ink;
  namer.name(text, anchors, style, 0);
}

Pieces draw_guide(const std::vector<Vec<2>>& points, const Box<2>& area, PlotNamer& namer,
                  DrawList& list) {
  Pieces pieces;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (const auto part = cut_line(points[i - 1], points[i], area)) {
      pieces.push_back(*part);
      namer.cross(part->first, part->second);
      list.line(part->first, part->second, {Role::quiet_ink, 1.5, 7});
    }
  return pieces;
}

void name_guide(const std::string& text, const Pieces& pieces, const TextStyle& style,
                PlotNamer& namer) {
  if (pieces.empty()) return;
  std::vector<Anchor> anchors;
  for (const double t : {0.98, 0.02, 0.75, 0.25, 0.5})
    for (const double lift : {-0.45, 1.05}) {
      const auto& [from, to] = t > 0.5 ? pieces.back() : pieces.front();
      anchors.push_back({from + t * (to - from) + Vec<2>{0, lift * style.size}, t});
    }
  namer.name(text, anchors, style, 3);
}

void draw_slope_fan(const std::vector<PlotSlope>& slopes, const Vec<2>& decade, const Box<2>& area,
                    const PlotType& type, const PlotNamer& namer, DrawList& list, Labels& labels) {
  const double size = type.tick.size;
  std::vector<Vec<2>> ends;
  for (const double reach : {3.8, 4.9, 6.5, 8.7}) {
    ends = fan(slopes, decade, reach * size);
    if (least_height_between(ends) >= 1.1 * size + 2) break;
    ends.clear();  // two names would touch
  }
  if (ends.empty()) return;
  double text = 0;
  for (const PlotSlope& slope : slopes)
    text = std::max(text, text_width(slope.name, size, type.tick.weight));
  Box<2> reach{{0, 0}, {0, 0}};
  for (const Vec<2>& end : ends) reach = united(reach, Box<2>{end, end});
  reach.lo.y -= 0.6 * size;
  reach.hi += Vec<2>{text + 8, 0.6 * size};
  const Vec<2> lo = area.lo + Vec<2>{8, 6}, hi = area.hi - reach.size() - Vec<2>{8, 6};
  for (const Vec<2>& corner : {Vec<2>{lo.x, hi.y}, Vec<2>{hi.x, lo.y}, lo, hi}) {
    const Box<2> place{corner, corner + reach.size()};
    if (namer.crowd(place) > 0 || !labels.is_free(place, area)) continue;
    const Vec<2> from = corner - reach.lo;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const Vec<2> end = from + ends[i];
      list.line(from, end, {Role::cell_line_2, 1.4});
      labels.try_add(slopes[i].name, {{end + Vec<2>{5, 0.36 * size}, 0}}, type.tick, area);
    }
    return;
  }
}

}  // namespace lantern::draw
