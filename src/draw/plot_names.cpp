#include "draw/plot_names.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "draw/clip.hpp"

namespace lantern {
namespace {

constexpr double kNameBeside = 16;  // between the area and a name in the column
constexpr double kAfterNumber = 8;

void draw_name(const ColumnName& line, const PlotPaper& paper, DrawList& list, Labels& labels) {
  const Box<2>&area = paper.place.area, panel = paper.place.panel;
  const Vec<2> end{line.end.x, std::clamp(line.end.y, area.lo.y, area.hi.y)};
  const bool newest_at_edge = end.x > area.hi.x - 40;
  double x = area.hi.x + kNameBeside;
  if (std::abs(line.label - end.y) > 4 || !newest_at_edge)
    list.line({std::min(end.x + 12, x - 5), end.y}, {x - 5, line.label},
              {Role::cell_line_3, 1.4, newest_at_edge ? 0.0 : 4.0});
  const double y = line.label + 0.36 * paper.type.name.size;
  for (const auto& [words, style] :
       {std::pair{line.number, paper.type.title}, std::pair{line.name, paper.type.name}}) {
    const std::string text = shortened(words, panel.hi.x - x, style);
    labels.try_add(text, {{{x, y}, 0}}, style, panel);
    x += text_width(text, style) + kAfterNumber;
  }
}

}  // namespace

bool PlotNamer::name(const std::string& text, const std::vector<Anchor>& anchors,
                     const TextStyle& style, std::size_t most_crossed) {
  for (std::size_t crossed = 0; crossed <= most_crossed; ++crossed) {
    const Anchor* free = labels_.free_anchor(text, anchors, style, area_, [&](const Box<2>& box) {
      return marks_on(box) == 0 && lines_through(box) <= crossed;
    });
    if (!free) continue;
    labels_.add(text, *free, style, area_);
    return true;
  }
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
  return std::min(widest + 1, 0.42 * paper.place.panel.size().x) + kNameBeside + 4;
}

void draw_column(std::vector<ColumnName> names, std::size_t all, const PlotPaper& paper,
                 DrawList& list, Labels& labels) {
  const Box<2>&area = paper.place.area, panel = paper.place.panel;
  const double pitch = 1.35 * paper.type.name.size;
  const double top = panel.lo.y + 14, bottom = area.hi.y - 8;
  std::stable_sort(names.begin(), names.end(),
                   [](const ColumnName& a, const ColumnName& b) { return a.end.y < b.end.y; });
  const auto most = static_cast<std::size_t>(std::max(1.0, (bottom - top) / pitch));
  if (names.size() > most) names.resize(most);
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
  if (names.size() == most && all > most)
    labels.try_add(fmt::format("and {} more", all - most),
                   {{{panel.hi.x, area.hi.y + paper.type.under_ticks()}, 1}}, paper.type.tick,
                   panel);
}

}  // namespace lantern
