// Where the parts of a plot lie: its axes, and its points on the page.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "draw/plot.hpp"
#include "draw/plot_axes.hpp"
#include "draw/plot_legend.hpp"
#include "draw/plot_names.hpp"

namespace lantern {

// What differs between a page that is read closely and a slide.
struct PlotStyle {
  explicit PlotStyle(const Plot& plot);
  double mark = 5;  // radius
  double line = 3;
  double apart = 24;  // between two marks of a line, at least
  Vec<2> ticks_apart{0.0};
};

struct PlotRange {
  double least = 1e300, most = -1e300;
  void add(double value, bool logarithmic);
  bool empty() const { return least > most; }
};

// A series on the page.
struct PlacedSeries {
  const PlotSeries* series = nullptr;
  std::vector<Vec<2>> points;  // that are joined
  std::vector<Vec<2>> beyond;  // at the upper edge
  std::vector<bool> open;      // of the joined ones
  std::vector<std::pair<Vec<2>, std::string>> notes;
  std::vector<std::pair<Vec<2>, Vec<2>>> whiskers;
};

class PlotLayout {
 public:
  // Draws headings and the legend, and places the rest. The plot must outlive this.
  PlotLayout(const Plot& plot, const Box<2>& panel, bool with_legend, DrawList& list,
             Labels& labels);

  bool empty() const { return xs_.empty(); }
  const Box<2>& area() const { return paper_.place.area; }
  Box<2> scaled() const { return paper_.place.scaled(); }
  std::vector<Vec<2>> on_page(const std::vector<Vec<2>>& values) const;
  // Of each series, not farther out than a few panels: beyond, only the direction matters.
  std::vector<PlacedSeries> place_series() const;
  // Of each series, without a number if it has no points; the only one needs no name.
  std::vector<ColumnName> column() const;
  void draw_axes(DrawList& list);

 protected:
  const Plot& plot_;
  PlotStyle style_;
  PlotPaper paper_;
  Axis x_, y_;

 private:
  bool is_drawn(const PlotPoint& p) const;
  bool is_ground(double y) const;
  bool is_on_ground(const PlotPoint& p) const { return !p.beyond && is_ground(p.at.y); }
  bool has_points(const PlotSeries& series) const;
  void find_ranges();
  void add_legend(DrawList& list, Labels& labels);
  int ticks_in(int axis) const;
  Axis axis_of(const PlotRange& range, bool logarithmic, int ticks) const;
  Axis y_axis(int ticks) const;
  // Marks that would cover each other at an edge stand in rows, one a series.
  double row_height() const { return 2.7 * style_.mark; }
  int most_rows() const;
  template <class Is>
  double edge_height(const Is& is, double air) const;
  Vec<2> at(const Vec<2>& value) const;
  void place_whiskers(const Vec<2>& place, const Box<2>& spread, PlacedSeries& placed) const;

  Box<2>& area_ = paper_.place.area;
  PlotRange xs_, ys_;
};

}  // namespace lantern
