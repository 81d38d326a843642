#include "draw/plot_parts.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "draw/pen.hpp"

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
    labels.try_add(fmt::format("and {} more", all - most),
                   {{{panel.hi.x, area.hi.y + paper.type.under_ticks()}, 1}}, paper.type.tick,
                   panel);
}

}  // namespace lantern::draw
