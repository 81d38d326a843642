// Names inside a plot and beside it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "draw/labels.hpp"
#include "draw/plot_axes.hpp"

namespace lantern {

// Puts names where they cover no mark and few lines.
class PlotNamer {
 public:
  // Names stay in `area`.
  PlotNamer(const Box<2>& area, Labels& labels) : area_(area), labels_(labels) {}

  void cross(const Vec<2>& from, const Vec<2>& to) { lines_.push_back({from, to}); }
  void mark(const Vec<2>& at, double radius) {
    marks_.push_back(Box<2>::around(at, Vec<2>(radius)));
  }

  // The text at the anchor where it crosses the fewest lines, the first of equal ones; never on a
  // mark or another label. False, and nothing is drawn, if there is none, or if more than
  // `most_crossed` lines run through it.
  bool name(const std::string& text, const std::vector<Anchor>& anchors, const TextStyle& style,
            std::size_t most_crossed);

  // How many marks and lines touch the place.
  std::size_t crowd(const Box<2>& place) const { return marks_on(place) + lines_through(place); }

 private:
  std::size_t marks_on(const Box<2>& place) const;
  std::size_t lines_through(const Box<2>& place) const;

  Box<2> area_;
  Labels& labels_;
  std::vector<std::pair<Vec<2>, Vec<2>>> lines_;
  std::vector<Box<2>> marks_;
};

// A line's newest number and its name, at the right of the area beside the line's end.
struct ColumnName {
  std::string number, name;
  Vec<2> end{0.0};   // of the line, on the page
  double label = 0;  // y of the name's middle, once it is laid out
};

// The room that they take at the right of the area. Numbers over time change from frame to frame:
// `steady`, the room does not.
double column_width(const std::vector<ColumnName>& names, const PlotPaper& paper, bool steady);

// Moved apart where they would cover each other, the highest end first. Says how many of `all` are
// left out where not all have room.
void draw_column(std::vector<ColumnName> names, std::size_t all, const PlotPaper& paper,
                 DrawList& list, Labels& labels);

}  // namespace lantern
