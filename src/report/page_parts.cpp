#include "report/page_parts.hpp"

#include <algorithm>

#include "draw/draw_list.hpp"
#include "draw/font.hpp"

namespace lantern::report {

namespace {

constexpr std::size_t kMostFootLines = 3;

// What has no room ends in dots.
std::vector<std::string> lines_of(const std::string& text, double width, const TextStyle& style) {
  std::vector<std::string> lines = wrapped(text, width, style);
  if (lines.size() <= kMostFootLines) return lines;
  lines.resize(kMostFootLines);
  lines.back() = shortened(lines.back() + " …", width, style);
  return lines;
}

std::vector<LegendEntry> legend_of(const Plot& plot) {
  std::vector<LegendEntry> entries;
  for (const PlotSeries& s : plot.series) entries.push_back({s.name, s.look, s.is_peer});
  return entries;
}

}  // namespace

void draw_page_title(const std::string& title, const std::string& rest, double margin,
                     DrawList& list, Labels& labels) {
  constexpr double kBaseline = 58, kRule = 78;
  const Box<2> band{{margin, 20}, {list.page.x - margin, kRule - 2}};
  const TextStyle bold{26, Weight::semibold, Role::ink, Role::none};
  const TextStyle quiet{22, Weight::regular, Role::quiet_ink, Role::none};
  const std::string name = shortened(title, 0.6 * band.size().x, bold);
  labels.add(name, {{margin, kBaseline}, 0}, bold, band);
  const double x = margin + text_width(name, bold) + 11;
  labels.add(shortened("·  " + rest, band.hi.x - x, quiet), {{x, kBaseline}, 0}, quiet, band);
  list.crisp_line({margin, kRule}, {list.page.x - margin, kRule}, {Role::rule, 1.6});
}

double draw_page_foot(const std::vector<std::string>& notes, const std::string& small,
                      double margin, DrawList& list, Labels& labels) {
  constexpr double kNoteHeight = 26;
  const TextStyle quiet{kLeastDeskLabel + 0.1, Weight::regular, Role::quiet_ink, Role::none};
  const double width = list.page.x - 2 * margin;
  std::string joined;
  for (const std::string& note : notes) joined += (joined.empty() ? "" : " ") + note;
  std::vector<std::string> lines;
  if (!joined.empty()) lines = lines_of(joined, width, quiet);
  lines.push_back(shortened(small, width, quiet));
  const double top = list.page.y - 36 - kNoteHeight * static_cast<double>(lines.size());
  const Box<2> band{{margin, top}, {list.page.x - margin, list.page.y - 14}};
  double y = list.page.y - 26 - kNoteHeight * static_cast<double>(lines.size() - 1);
  for (const std::string& line : lines) {
    labels.add(line, {{margin, y}, 0}, quiet, band);
    y += kNoteHeight;
  }
  list.crisp_line({margin, top}, {list.page.x - margin, top}, {Role::rule, 1.6});
  return top;
}

void draw_plot_pair(Plot left, Plot right, double bottom, double margin, DrawList& list,
                    Labels& labels) {
  constexpr double kTop = 96, kGap = 48;
  const double width = list.page.x - 2 * margin, middle = margin + width / 2;
  Box<2> left_panel{{margin, kTop}, {middle - kGap / 2, bottom - 12}};
  if (!names_its_lanes(left, left_panel)) {
    const std::vector<LegendEntry> legend = legend_of(left);
    const double height =
        std::min(plot_legend_height(legend, width, kDeskLabel), 0.3 * (bottom - kTop));
    draw_plot_legend(legend, {{margin, bottom - height}, {margin + width, bottom}}, kDeskLabel,
                     list, labels);
    left_panel.hi.y -= height;
    left.names = PlotNames::none;
  }
  right.names = PlotNames::none;
  draw_plot(left, left_panel, list, labels);
  draw_plot(right, {{middle + kGap / 2, kTop}, {margin + width, left_panel.hi.y}}, list, labels);
}

}  // namespace lantern::report
