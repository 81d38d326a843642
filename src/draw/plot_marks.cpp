#include "draw/plot_marks.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "draw/chart_parts.hpp"
#include "draw/metrics.hpp"
#include "draw/pen.hpp"

namespace lantern {
namespace {

constexpr double kQuarter = 0.785398163397448, kUp = -1.570796326794897;

// A star of `tips` with its valleys at `inner` of the radius.
std::vector<Vec<2>> star(const Vec<2>& at, double radius, int tips, double inner, double turn) {
  const std::vector<Vec<2>> ring = ring_of({0, 0}, 1, 2 * tips, turn);
  std::vector<Vec<2>> points;
  for (std::size_t i = 0; i < ring.size(); ++i)
    points.push_back(at + ring[i] * (i % 2 == 0 ? radius : inner * radius));
  return points;
}

// A plus sign, its arms `half` of the radius to each side of the middle.
std::vector<Vec<2>> plus(const Vec<2>& at, double radius, double half, double turn) {
  std::vector<Vec<2>> points;
  for (int arm = 0; arm < 4; ++arm) {
    const double a = turn + 2 * kQuarter * arm, c = std::cos(a), s = std::sin(a);
    for (const Vec<2>& p : {Vec<2>{half, -half}, Vec<2>{1, -half}, Vec<2>{1, half}})
      points.push_back(at + radius * Vec<2>{c * p.x - s * p.y, s * p.x + c * p.y});
  }
  return points;
}

std::vector<Vec<2>> bar(const Vec<2>& at, const Vec<2>& half) {
  return {at - half, at + Vec<2>{half.x, -half.y}, at + half, at + Vec<2>{-half.x, half.y}};
}

std::vector<Vec<2>> outline(int mark, const Vec<2>& at, double r) {
  switch (mark) {
    case 1:
      return ring_of(at, 1.25 * r, 4, kQuarter);
    case 2:
      return ring_of(at, 1.35 * r, 3, kUp);
    case 3:
      return ring_of(at, 1.35 * r, 4, 0);
    case 4:
      return ring_of(at, 1.35 * r, 3, -kUp);
    case 5:
      return ring_of(at, 1.2 * r, 5, kUp);
    case 6:
      return bar(at, {0.6 * r, 1.3 * r});
    case 7:
      return bar(at, {1.35 * r, 0.6 * r});
    case 8:
      return plus(at, 1.4 * r, 0.3, 0);
    case 9:
      return plus(at, 1.4 * r, 0.3, kQuarter);
    case 10:
      return star(at, 1.55 * r, 5, 0.42, kUp);
    case 11:
      return star(at, 1.6 * r, 4, 0.38, kUp);
    case 12:
      return ring_of(at, 1.35 * r, 3, 0);
    default:
      return ring_of(at, 1.35 * r, 3, 2 * kUp);
  }
}

// Colours whose lines are lost on white, or as greys in print.
bool is_pale(int look) {
  const int color = chart_color(static_cast<std::size_t>(look));
  return color == 2 || color == 3 || color == 6;
}

}  // namespace

Role plot_role(int look) { return body_role(chart_color(static_cast<std::size_t>(look))); }

void draw_plot_mark(int look, const Vec<2>& at, double radius, bool open, DrawList& list) {
  const Role role = plot_role(look);
  const int mark = look % kPlotMarks;
  const Stroke rim{Role::body_line, 0.14 * radius + 0.35, 0};
  const Stroke line{role, 0.4 * radius, 0};
  if (mark == 0) {
    if (open) list.shapes.emplace_back(disc(at, radius, Role::panel, {rim.role, 0.66 * radius, 0}));
    list.shapes.emplace_back(disc(at, radius, open ? Role::panel : role, open ? line : rim));
    return;
  }
  const std::vector<Vec<2>> points = outline(mark, at, radius);
  if (open)  // a dark line under the coloured one, which may be pale
    list.shapes.emplace_back(PolygonShape{points, Role::panel, {rim.role, 0.66 * radius, 0}});
  list.shapes.emplace_back(PolygonShape{points, open ? Role::panel : role, open ? line : rim});
}

void draw_plot_whisker(int look, const Vec<2>& from, const Vec<2>& to, double radius,
                       DrawList& list) {
  const double width = 0.3 * radius;
  const Vec<2> across = from.y == to.y ? Vec<2>(0, 0.7 * radius) : Vec<2>(0.7 * radius, 0);
  draw_plot_line(look, false, from, to, width, list);
  for (const Vec<2>& end : {from, to})
    draw_plot_line(look, false, end - across, end + across, width, list);
}

void draw_plot_line(int look, bool is_peer, const Vec<2>& from, const Vec<2>& to, double width,
                    DrawList& list) {
  const double dash = is_peer ? 3.2 * width : 0;
  if (is_pale(look))
    list.shapes.emplace_back(LineShape{from, to, {Role::cell_line_2, width + 1.6, dash}, false});
  list.shapes.emplace_back(LineShape{from, to, {plot_role(look), width, dash}, false});
}

}  // namespace lantern
