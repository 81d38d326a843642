#include "draw/plot_marks.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "draw/font.hpp"
#include "draw/pen.hpp"
#include "draw/plot_parts.hpp"
#include "geometry/elementary.hpp"

namespace lantern::draw {
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
    const auto [s, c] = geometry::sin_cos(turn + 2 * kQuarter * arm);
    for (const Vec<2>& p : {Vec<2>{half, -half}, Vec<2>{1, -half}, Vec<2>{1, half}})
      points.push_back(at + radius * Vec<2>{c * p.x - s * p.y, s * p.x + c * p.y});
  }
  return points;
}

std::vector<Vec<2>> bar(const Vec<2>& at, const Vec<2>& half) {
  return {at - half, at + Vec<2>{half.x, -half.y}, at + half, at + Vec<2>{-half.x, half.y}};
}

// Those that are regular polygons, by how far their corners lie from the middle.
struct Ring {
  int corners;
  double reach, turn;
};
constexpr Ring kRings[] = {{4, 1.22, kQuarter}, {3, 1.4, kUp}, {4, 1.35, 0},      {3, 1.4, -kUp},
                           {5, 1.2, kUp},       {3, 1.35, 0},  {3, 1.35, 2 * kUp}};

std::vector<Vec<2>> outline(int mark, const Vec<2>& at, double r) {
  if (mark == 6) return bar(at, {0.6 * r, 1.3 * r});
  if (mark == 7) return bar(at, {1.35 * r, 0.6 * r});
  if (mark == 8) return plus(at, 1.4 * r, 0.3, 0);
  if (mark == 9) return plus(at, 1.4 * r, 0.3, kQuarter);
  if (mark == 10) return star(at, 1.55 * r, 5, 0.42, kUp);
  if (mark == 11) return star(at, 1.6 * r, 4, 0.38, kUp);
  const Ring& ring = kRings[mark < 6 ? mark - 1 : mark - 7];
  return ring_of(at, ring.reach * r, ring.corners, ring.turn);
}

// Colours whose lines are lost on white, or as greys in print.
bool is_pale(Role role) {
  return role == body_role(2) || role == body_role(3) || role == body_role(6);
}

constexpr double kColumnGap = 26;

struct Columns {
  std::size_t count = 1, rows = 1;
  double width = 0, sample = 0, line = 0;
};

Columns columns_of(const std::vector<LegendEntry>& entries, double width, double size) {
  Columns c;
  c.sample = 2.1 * size;
  c.line = 1.42 * size;
  for (const LegendEntry& entry : entries)
    c.width = std::max(c.width, c.sample + 8 + text_width(entry.name, size, Weight::regular) + 1);
  c.width = std::min(c.width, width);
  const double fit = (width + kColumnGap) / (c.width + kColumnGap);
  const std::size_t most = std::max<std::size_t>(1, static_cast<std::size_t>(fit));
  c.rows = (entries.size() + most - 1) / most;
  c.count = c.rows == 0 ? 0 : (entries.size() + c.rows - 1) / c.rows;
  return c;
}

}  // namespace

Role plot_role(int look) {
  constexpr int kColors[] = {4, 1, 5, 8, 7, 2, 6, 3};
  return body_role(kColors[look % std::ssize(kColors)]);
}

void draw_plot_mark(const PlotInk& ink, const Vec<2>& at, double radius, bool open,
                    DrawList& list) {
  const int mark = ink.look % kPlotMarks;
  const Stroke rim{Role::body_line, 0.16 * radius + 0.4};
  const auto draw = [&](Role fill, const Stroke& stroke) {
    if (mark == 0)
      list.disc(at, radius, fill, stroke);
    else
      list.polygon(outline(mark, at, radius), fill, stroke);
  };
  if (!open) return draw(ink.role(), rim);
  draw(Role::panel, {rim.role, 0.66 * radius});  // a dark line under a colour that may be pale
  draw(Role::panel, {ink.role(), 0.4 * radius});
}

void draw_plot_whisker(const PlotInk& ink, const Vec<2>& from, const Vec<2>& to, double radius,
                       DrawList& list) {
  const double width = 0.3 * radius;
  const PlotInk unbroken{ink.look, false, ink.color};
  const Vec<2> across = from.y == to.y ? Vec<2>(0, 0.7 * radius) : Vec<2>(0.7 * radius, 0);
  draw_plot_line(unbroken, from, to, width, list);
  for (const Vec<2>& end : {from, to})
    draw_plot_line(unbroken, end - across, end + across, width, list);
}

void draw_plot_line(const PlotInk& ink, const Vec<2>& from, const Vec<2>& to, double width,
                    DrawList& list) {
  const double dash = ink.is_peer ? 3.2 * width : 0;
  if (is_pale(ink.role())) list.line(from, to, {Role::cell_line_2, width + 1.6, dash});
  list.line(from, to, {ink.role(), width, dash});
}

double plot_legend_height(const std::vector<LegendEntry>& entries, double width, double size) {
  if (entries.empty()) return 0;
  const Columns c = columns_of(entries, width, size);
  return static_cast<double>(c.rows) * c.line;
}

void draw_plot_legend(const std::vector<LegendEntry>& entries, const Box<2>& place, double size,
                      DrawList& list, Labels& labels) {
  if (entries.empty()) return;
  const Columns c = columns_of(entries, place.size().x, size);
  const TextStyle style = PlotType(size).name;
  const auto fitting = static_cast<std::size_t>(std::max(1.0, place.size().y / c.line + 1e-6));
  const std::size_t rows = std::min(c.rows, fitting);
  const std::size_t shown = rows < c.rows ? rows - 1 : rows;  // the last row tells of the others
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::size_t row = i % c.rows, column = i / c.rows;
    if (row >= shown) {
      ++left_out;
      continue;
    }
    const Vec<2> at{place.lo.x + static_cast<double>(column) * (c.width + kColumnGap),
                    place.lo.y + (static_cast<double>(row) + 0.5) * c.line};
    draw_plot_line(entries[i].ink(), at + Vec<2>{3, 0}, at + Vec<2>{c.sample - 3, 0}, 0.14 * size,
                   list);
    draw_plot_mark(entries[i].ink(), at + Vec<2>{c.sample / 2, 0}, 0.33 * size, false, list);
    labels.add(shortened(entries[i].name, c.width - c.sample - 8, style),
               {{at.x + c.sample + 8, at.y + 0.36 * size}, 0}, style, place);
  }
  if (left_out > 0)
    labels.try_add(fmt::format("and {} more", left_out),
                   {{{place.lo.x, place.lo.y + (static_cast<double>(rows) - 0.14) * c.line}, 0}},
                   style, place);
}

}  // namespace lantern::draw
