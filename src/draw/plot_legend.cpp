#include "draw/plot_legend.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "draw/font.hpp"
#include "draw/plot_axes.hpp"

namespace lantern {
namespace {

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

}  // namespace lantern
