// The marks and colours of a plot's series, and their legend: names beside a piece of the line, in
// columns.
#pragma once

#include <string>
#include <vector>

#include "draw/labels.hpp"

namespace lantern::draw {

inline constexpr int kPlotMarks = 14;     // shapes; with 8 colours, 56 looks are unlike
inline constexpr int kFirstPeerLook = 8;  // from here on crosses and stars: what peers take

// The colour of a look, 0 or more: dark and unlike ones first.
Role plot_role(int look);

// What tells one series from another: a mark, a colour and a dash.
struct PlotInk {
  int look = 0;          // mark and colour; the same series has the same in every plot
  bool is_peer = false;  // dashed
  int color = 0;         // a body's, where it is not the look's
  Role role() const { return color > 0 ? body_role(color) : plot_role(look); }
};

// A mark, `radius` large; open: of something that is not there, such as a diverged run.
void draw_plot_mark(const PlotInk& ink, const Vec<2>& at, double radius, bool open, DrawList& list);

// A whisker through a mark of that radius, level or upright, with a short bar across either end.
void draw_plot_whisker(const PlotInk& ink, const Vec<2>& from, const Vec<2>& to, double radius,
                       DrawList& list);

// A line, so that pale colours stay visible on pale ground.
void draw_plot_line(const PlotInk& ink, const Vec<2>& from, const Vec<2>& to, double width,
                    DrawList& list);

struct LegendEntry {
  std::string name;
  int look = 0;
  bool is_peer = false;
  PlotInk ink() const { return {look, is_peer}; }
};

// The height that they take in a legend so wide, page units.
double plot_legend_height(const std::vector<LegendEntry>& entries, double width, double size);

// At the top of `place`, in columns as wide as the longest name, read downwards. Names that are
// wider than the place are shortened; what has no room below is left out, and that is said.
void draw_plot_legend(const std::vector<LegendEntry>& entries, const Box<2>& place, double size,
                      DrawList& list, Labels& labels);

}  // namespace lantern::draw
