// What charts of lines and of bars share.
#pragma once

#include "draw/axis.hpp"
#include "draw/labels.hpp"
#include "scenario/frame.hpp"

namespace lantern {

inline constexpr int kChartLooks = 8;  // colours, marks and dashes that series take in turn

// The body colour of the i-th series: dark and unlike ones first.
int chart_color(std::size_t i);

// The type of a chart: larger on a panel that has the page for itself.
struct ChartType {
  explicit ChartType(const Box<2>& panel) {
    const double k = panel.size().x > 1000 && panel.size().y > 380 ? 1.22 : 1;
    tick = {k * (kLeastLabel + 0.4), Weight::regular, Role::quiet_ink, Role::none};
    name = {k * kLabel, Weight::regular, Role::ink, Role::none};
    number = {k * kLabel, Weight::semibold, Role::ink, Role::none};
  }
  TextStyle tick, name, number;
};

// The mark of the i-th series in a body's colour, `radius` large, with the panel's tone around it.
void draw_chart_mark(std::size_t i, int color, const Vec<2>& at, double radius, DrawList& list);

// A count's or measure's name as words: "pair tests" of "pair_tests", "energy: bob" of
// "energy.bob".
std::string chart_words(std::string name);

// A heading at the panel's upper left; gives the height it takes, 0 for an empty text.
double draw_chart_heading(const std::string& text, const Box<2>& panel, Labels& labels);

void draw_lines_chart(const FrameChart& chart, const Box<2>& panel, DrawList& list, Labels& labels);
void draw_bars_chart(const FrameChart& chart, const Box<2>& panel, DrawList& list, Labels& labels);

}  // namespace lantern
