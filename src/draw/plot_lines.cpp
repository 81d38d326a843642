#include "draw/plot_lines.hpp"

#include <algorithm>
#include <cmath>

#include "draw/clip.hpp"
#include "draw/font.hpp"

namespace lantern {
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

void PlotFront::draw(const std::vector<Vec<2>>& corners, const Box<2>& area, double width,
                     double rim, DrawList& list) {
  width_ = width;
  right_ = area.hi.x;
  for (const Vec<2>& p : corners) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    if (!steps_.empty()) steps_.push_back({p.x, steps_.back().y});
    steps_.push_back(p);
  }
  if (steps_.empty()) return;
  steps_.insert(steps_.begin(), {steps_.front().x, area.lo.y});
  steps_.push_back({area.hi.x, steps_.back().y});
  const Box<2> inside = shrunk(area, width / 2 + 1);
  for (const auto& [role, w] :
       {std::pair(Role::lit, width), std::pair(Role::lit_fill, width - rim)})
    for (std::size_t i = 1; i < steps_.size(); ++i)
      if (const auto part = cut_line(steps_[i - 1], steps_[i], inside))
        list.line(part->first, part->second, {role, w});
}

void PlotFront::name(const std::string& text, TextStyle style, PlotNamer& namer) const {
  std::vector<Anchor> anchors;
  const double lift = width_ / 2 + 0.35 * style.size;
  for (std::size_t i = steps_.size(); i-- > 1;) {
    if (steps_[i].y != steps_[i - 1].y) continue;
    const double right = std::min(steps_[i].x - width_ / 2, right_) - 4;
    anchors.push_back({{right, steps_[i].y - lift}, 1});
    anchors.push_back({{right, steps_[i].y + lift + 0.7 * style.size}, 1});
  }
  style.role = Role::lit_ink;
  namer.name(text, anchors, style, 0);
}

void PlotGuideLine::draw(const std::vector<Vec<2>>& points, const Box<2>& area, PlotNamer& namer,
                         DrawList& list) {
  for (std::size_t i = 1; i < points.size(); ++i)
    if (const auto part = cut_line(points[i - 1], points[i], area)) {
      parts_.push_back(*part);
      namer.cross(part->first, part->second);
      list.line(part->first, part->second, {Role::quiet_ink, 1.5, 7});
    }
}

void PlotGuideLine::name(const std::string& text, const TextStyle& style, PlotNamer& namer) const {
  if (parts_.empty()) return;
  std::vector<Anchor> anchors;
  for (const double t : {0.98, 0.02, 0.75, 0.25, 0.5})
    for (const double lift : {-0.45, 1.05}) {
      const auto& part = t > 0.5 ? parts_.back() : parts_.front();
      const Vec<2> p = part.first + t * (part.second - part.first);
      anchors.push_back({p + Vec<2>{0, lift * style.size}, t});
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

}  // namespace lantern
