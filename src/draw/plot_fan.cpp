#include "draw/plot_fan.hpp"

#include <algorithm>
#include <cmath>

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
