#include "draw/chart_view.hpp"

#include <algorithm>

#include "draw/chart_parts.hpp"
#include "draw/pen.hpp"

namespace lantern {

int chart_color(std::size_t i) {
  constexpr int kColors[kChartLooks] = {4, 1, 5, 8, 7, 2, 6, 3};
  return kColors[i % kChartLooks];
}

std::string chart_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  if (const std::size_t dot = name.find('.'); dot != std::string::npos) name.replace(dot, 1, ": ");
  return name;
}

void draw_chart_mark(std::size_t i, int color, const Vec<2>& at, double radius, DrawList& list) {
  const Role role = body_role(color);
  const Stroke rim{Role::body_line, 0.16 * radius + 0.4, 0};
  const auto shape = [&](int corners, double size, double turn) {
    list.shapes.emplace_back(PolygonShape{ring_of(at, size * radius, corners, turn), role, rim});
  };
  constexpr double kQuarter = 0.785398163397448, kUp = -1.570796326794897;
  switch (i % kChartLooks) {
    case 0:
      list.shapes.emplace_back(disc(at, radius, role, rim));
      break;
    case 1:
      shape(4, 1.22, kQuarter);
      break;
    case 2:
      shape(3, 1.4, kUp);
      break;
    case 3:
      shape(4, 1.35, 0);
      break;
    case 4:
      shape(3, 1.4, -kUp);
      break;
    case 5:
      list.shapes.emplace_back(
          disc(at, 0.85 * radius, Role::panel, {role, std::max(1.6, 0.5 * radius), 0}));
      break;
    case 6:
      shape(6, 1.2, 0);
      break;
    default:
      shape(5, 1.3, kUp);
      break;
  }
}

double draw_chart_heading(const std::string& text, const Box<2>& panel, Labels& labels) {
  const TextStyle style = ChartType(panel).number;
  const std::string words = shortened(text, panel.size().x, style);
  if (words.empty() || panel.size().y < 60) return 0;
  labels.add(words, {{panel.lo.x, panel.lo.y + 0.78 * style.size}, 0}, style, panel);
  return 1.7 * style.size;
}

void draw_chart(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels) {
  const FrameChart& chart = frame.chart;
  const Box<2> place = shrunk(panel, 4);
  if (place.size().x < 40 || place.size().y < 40) return;
  if (!chart.bars.empty()) return draw_bars_chart(chart, place, list, labels);
  draw_lines_chart(chart, place, list, labels);
}

}  // namespace lantern
