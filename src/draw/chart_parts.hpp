// What charts of lines and of bars share.
#pragma once

#include "draw/axis.hpp"
#include "draw/labels.hpp"
#include "scenario/frame.hpp"

namespace lantern {

inline constexpr int kChartLooks = 8;  // colours, marks and dashes that series take in turn

// The body colour of the i-th series: dark and unlike ones first.
int chart_color(std::size_t i);

// The mark of the i-th series, `radius` large, with the panel's tone around it.
void draw_chart_mark(std::size_t i, const Vec<2>& at, double radius, DrawList& list);

// A heading at the panel's upper left; gives the height it takes, 0 for an empty text.
double draw_chart_heading(const std::string& text, const Box<2>& panel, Labels& labels);

void draw_lines_chart(const FrameChart& chart, const Box<2>& panel, DrawList& list, Labels& labels);
void draw_bars_chart(const FrameChart& chart, const Box<2>& panel, DrawList& list, Labels& labels);

}  // namespace lantern
