#include "draw/plot_parts.hpp"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/font.hpp"
#include "draw/pen.hpp"
#include "geometry/elementary.hpp"
#include "geometry/not_finite.hpp"

namespace lantern::draw {
namespace {

constexpr double kNameBeside = 16;  // between the area and a name in the column
constexpr double kAfterNumber = 8;
constexpr double kLeader = 12;  // length, where a name had to make way

// At its line's end, which a short leader finds where the name had to make way.
void draw_name(const ColumnName& line, const PlotPaper& paper, DrawList& list, Labels& labels) {
  const Box<2>&area = paper.place.area, panel = paper.place.panel;
  const Vec<2> end{line.end.x, std::clamp(line.end.y, area.lo.y, area.hi.y)};
  double x = std::min(end.x, area.hi.x) + kNameBeside;
  if (std::abs(line.label - end.y) > 4) {
    list.line({end.x + 10, end.y}, {x + 8, line.label}, {Role::cell_line_3, 1.4});
    x += kLeader;
  }
  const double y = line.label + 0.36 * paper.type.name.size;
  for (auto [words, style] :
       {std::pair{line.number, paper.type.title}, std::pair{line.name, paper.type.name}}) {
    style.halo = Role::panel;
    const std::string text = shortened(words, panel.hi.x - x, style);
    labels.try_add(text, {{{x, y}, 0}}, style, panel);
    x += text_width(text, style) + kAfterNumber;
  }
}

// The ends of lines `reach` long from the origin.
std::vector<Vec<2>> fan(const std::vector<PlotSlope>& slopes, const Vec<2>& decade, double reach) {
  std::vector<Vec<2>> ends;
  for (const PlotSlope& slope : slopes) {
    const Vec<2> direction{decade.x, -slope.exponent * decade.y};
    ends.push_back(direction * (reach / geometry::hypot(direction.x, direction.y)));
  }
  return ends;
}

double least_height_between(const std::vector<Vec<2>>& ends) {
  double least = 1e9;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) least = std::min(least, std::abs(ends[i].y - ends[k].y));
  return least;
}

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
  Columns c{.sample = 2.1 * size, .line = 1.42 * size};
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

void PlotPaper::heading(const std::string& text, const TextStyle& style) {
  const std::string words = shortened(text, place.panel.size().x, style);
  if (words.empty() || place.panel.size().y < 60) return;
  labels_.add(words, {{place.panel.lo.x, place.area.lo.y + 0.78 * style.size}, 0}, style,
              place.panel);
  place.area.lo.y += 1.42 * style.size;
}

void PlotPaper::reserve_x(bool named) {
  place.area.hi.y -= type.under_ticks() + 8 * type.unit + (named ? 1.5 * type.name.size : 0);
}

void PlotPaper::reserve_y(const Axis& y) {
  double widest = 0;
  for (const Axis::Tick& tick : y.ticks())
    widest = std::max(widest, text_width(tick.text, type.tick));
  place.area.lo.x +=
      std::min(widest + 1, 0.3 * place.panel.size().x) + type.tick_length() + 8 * type.unit;
}

void PlotPaper::level_ticks(const Axis& x, double top, double bottom, const Stroke& stroke,
                            double below, double apart) {
  const Box<2>& area = place.area;
  double last = -1e9;
  for (const Axis::Tick& tick : x.ticks()) {
    const double at = area.lo.x + x.share(tick.value) * area.size().x;
    list_.crisp_line({at, top}, {at, bottom}, stroke);
    const double half = text_width(tick.text, type.tick) / 2;
    if (at - half < last + apart) continue;
    const Anchor anchor{{at, bottom + below + 0.78 * type.tick.size}, 0.5};
    if (labels_.try_add(tick.text, {anchor}, type.tick, place.panel)) last = at + half;
  }
}

void PlotPaper::upright_ticks(const Axis& y) {
  const Box<2> scaled = place.scaled();
  const double end = scaled.lo.x - type.tick_length(), room = end - 6 * type.unit;
  const auto write = [&](const std::string& text, double at) {
    labels_.try_add(shortened(text, room - place.panel.lo.x, type.tick),
                    {{{room, at + 0.36 * type.tick.size}, 1}}, type.tick, place.panel);
  };
  if (place.ground > 0) write("0", place.area.hi.y - place.ground / 2);
  double last = 1e9;
  for (const Axis::Tick& tick : y.ticks()) {
    const double at = scaled.hi.y - y.share(tick.value) * scaled.size().y;
    list_.crisp_line({end, at}, {scaled.hi.x, at}, {Role::rule, 1.5 * type.unit});
    if (at > last - std::max(22 * type.unit, 1.1 * type.tick.size)) continue;
    write(tick.text, at);
    last = at;
  }
}

void PlotPaper::axis_lines() {
  const Box<2>&area = place.area, scaled = place.scaled();
  for (const Vec<2>& end : {area.lo, area.hi})
    list_.crisp_line({area.lo.x, area.hi.y}, end, {Role::ink, 2.2 * type.unit});
  for (const double at : {scaled.lo.y, scaled.hi.y})
    if (at != area.lo.y && at != area.hi.y)
      list_.crisp_line({area.lo.x, at}, {area.hi.x, at}, {Role::cell_line_3, 1.2, 4});
}

void PlotPaper::name_x(const std::string& name, const std::string& note, const TextStyle& style) {
  const double left = place.area.lo.x, right = place.panel.hi.x;
  std::string text = name + note;
  if (text_width(text, style) > right - left) text = shortened(name, right - left, style);
  const double half = text_width(text, style) / 2;
  const double x =
      std::clamp(place.area.center().x, left + half, std::max(left + half, right - half));
  labels_.try_add(text, {{{x, place.panel.hi.y - 7 * type.unit}, 0.5}}, style, place.panel);
}

void PlotPaper::say_nothing(const std::string& why) {
  list_.crisp_rect(place.area, Role::panel, {Role::rule, 1.2});
  const double room = place.area.size().x - 2 * type.name.size;
  labels_.try_add(shortened(why, room, type.tick), {{place.area.center(), 0.5}}, type.tick,
                  place.panel);
}

bool PlotNamer::name(const std::string& text, const std::vector<Anchor>& anchors,
                     const TextStyle& style, std::size_t most_crossed) {
  for (std::size_t crossed = 0; crossed <= most_crossed; ++crossed)
    if (labels_.try_add(text, anchors, style, area_, area_, [&](const Box<2>& box) {
          return marks_on(box) == 0 && lines_through(box) <= crossed;
        }))
      return true;
  return false;
}

std::size_t PlotNamer::marks_on(const Box<2>& place) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(marks_, [&](const Box<2>& mark) { return overlap(place, mark); }));
}

std::size_t PlotNamer::lines_through(const Box<2>& place) const {
  return static_cast<std::size_t>(std::ranges::count_if(lines_, [&](const auto& line) {
    return cut_line(line.first, line.second, place).has_value();
  }));
}

double column_width(const std::vector<ColumnName>& names, const PlotPaper& paper, bool steady) {
  constexpr double kEvery = 80;  // the room grows by so much
  const auto& [tick, name, title, _] = paper.type;
  double widest = 0;
  for (const ColumnName& line : names)
    widest = std::max(widest, text_width(line.number, title) +
                                  (line.name.empty() ? 0 : text_width(line.name, name) + 10));
  if (steady) widest = std::ceil((widest + text_width("0.000", title)) / kEvery) * kEvery;
  return std::min(widest + 1, 0.42 * paper.place.panel.size().x) + kNameBeside + kLeader + 4;
}

void draw_column(std::vector<ColumnName> names, std::size_t all, const PlotPaper& paper,
                 DrawList& list, Labels& labels) {
  const Box<2>&area = paper.place.area, panel = paper.place.panel;
  const double size = paper.type.name.size, least_pitch = 1.1 * size;
  const double top = panel.lo.y + 0.6 * size;
  std::ranges::stable_sort(names, {}, [](const ColumnName& name) { return name.end.y; });
  // Above the axis if all have room there.
  double bottom = area.hi.y - 0.6 * size;
  const auto gaps = static_cast<double>(names.empty() ? 0 : names.size() - 1);
  if (top + gaps * least_pitch > bottom) bottom = std::min(top + gaps * least_pitch, area.hi.y);
  const auto most =
      static_cast<std::size_t>(std::max(0.0, (bottom - top) / least_pitch + 1e-9)) + 1;
  const bool crowded = names.size() > most;
  if (crowded) names.resize(most);
  const double room = names.size() < 2 ? 0 : (bottom - top) / double(names.size() - 1);
  const double pitch = std::clamp(room, least_pitch, 1.35 * size);
  double least = top;
  for (ColumnName& line : names) {
    line.label = std::max(least, std::clamp(line.end.y, area.lo.y, area.hi.y));
    least = line.label + pitch;
  }
  double limit = bottom;
  for (auto line = names.rbegin(); line != names.rend(); ++line) {
    line->label = std::min(line->label, limit);
    limit = line->label - pitch;
  }
  for (const ColumnName& line : names) draw_name(line, paper, list, labels);
  if (crowded)
    labels.try_add(say("and {} more", all - most),
                   {{{panel.hi.x, area.hi.y + paper.type.under_ticks()}, 1}}, paper.type.tick,
                   panel);
}

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
  for (const PlotSlope& slope : slopes) text = std::max(text, text_width(slope.name, type.tick));
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
    labels.try_add(say("and {} more", left_out),
                   {{{place.lo.x, place.lo.y + (static_cast<double>(rows) - 0.14) * c.line}, 0}},
                   style, place);
}

}  // namespace lantern::draw
