// What every plot has: headings, a ground, axes with their ticks, and names inside it and beside
// it.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "draw/axis.hpp"
#include "draw/plot.hpp"

namespace lantern::draw {

// The type of a plot: `size` is that of its names, all else follows it.
struct PlotType {
  explicit PlotType(double size)
      : tick{size < kLeastLabel ? 0.92 * size : std::max(kLeastLabel, 0.92 * size), Weight::regular,
             Role::quiet_ink},
        name{size, Weight::regular, Role::ink},
        title{size, Weight::semibold, Role::ink},
        unit(std::min(1.0, size / kDeskLabel)) {}
  TextStyle tick, name, title;
  double unit;  // of lines and gaps, which do not grow with large type

  double tick_length() const { return 7 * unit; }
  double under_ticks() const { return tick_length() + 8 * unit + 0.78 * tick.size; }  // baseline
};

// The parts of a plot's panel. `strip` is the height of the part at the area's upper edge that has
// no scale, `ground` that of the part at its lower edge where 0 is, on a logarithmic axis.
struct PlotArea {
  Box<2> panel, area;
  double strip = 0, ground = 0;

  Box<2> scaled() const {
    return {{area.lo.x, area.lo.y + strip}, {area.hi.x, area.hi.y - ground}};
  }
};

class PlotPaper {
 public:
  PlotPaper(const Box<2>& panel, double size, DrawList& list, Labels& labels)
      : place{panel, panel}, type(size), list_(list), labels_(labels) {}

  PlotArea place;
  PlotType type;

  // One below the other at the panel's upper left; they take their height from the area. Nothing
  // for an empty text, or on a panel too low for one.
  void heading(const std::string& text, const TextStyle& style);

  // Takes from the area's lower edge what the ticks of x and its name need.
  void reserve_x(bool named);
  // Takes from the area's left what the ticks' texts need, or as much of it as the panel can spare.
  void reserve_y(const Axis& y);

  // A line at each tick of a level axis from `top` to `bottom`, and its text `below` that, where it
  // has room: no nearer to the one before than `apart`.
  void level_ticks(const Axis& x, double top, double bottom, const Stroke& stroke, double below,
                   double apart);
  // A level line and a text for each tick of an upright one, and "0" on the ground.
  void upright_ticks(const Axis& y);
  // Along the left edge and the lower one, and dashed where the scale of y ends.
  void axis_lines();
  // The name of x below its ticks, with `note` behind it if both have room.
  void name_x(const std::string& name, const std::string& note, const TextStyle& style);
  // In place of all that is in the area.
  void say_nothing(const std::string& why);

 private:
  DrawList& list_;
  Labels& labels_;
};

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

// A line's newest number and its name, at the right of the line's end.
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

// Lines of a plot: what is left of a long series, and those that are no series: the front's stairs,
// guides and slopes. These are drawn first, and named when all marks are in place.

// Many points become about as many as `most`, so that the page can tell them apart: of each part of
// the line its first, lowest, highest and last one.
std::vector<Vec<2>> thinned(const std::vector<Vec<2>>& points, std::size_t most);

// The Pareto front: from the upper edge down to the first corner, then in steps from corner to
// corner to the right edge, under the marks. Corners are on the page, ascending in x; those that
// are not finite are left out. `area` is the part of the plot that has a scale, `rim` the width of
// the stairs' outline. Gives the steps.
std::vector<Vec<2>> draw_front(const std::vector<Vec<2>>& corners, const Box<2>& area, double width,
                               double rim, DrawList& list);
// Along the last step where it is free, else along the others.
void name_front(const std::string& text, const std::vector<Vec<2>>& steps, double width,
                TextStyle style, PlotNamer& namer);

// A guide, dashed and cut to the area. Gives the pieces.
using Pieces = std::vector<std::pair<Vec<2>, Vec<2>>>;
Pieces draw_guide(const std::vector<Vec<2>>& points, const Box<2>& area, PlotNamer& namer,
                  DrawList& list);
void name_guide(const std::string& text, const Pieces& pieces, const TextStyle& style,
                PlotNamer& namer);

// A key to slopes on logarithmic axes: lines that begin at one point and fall (or rise) as orders
// would.
//
//     +---___
//      `.    ---  h
//        `.
//          `  h²
//
// The least fan whose names can be told apart, in a corner of `area` where nothing else is; none if
// there is no such corner. `decade` is the size of a decade along x and y, page units.
void draw_slope_fan(const std::vector<PlotSlope>& slopes, const Vec<2>& decade, const Box<2>& area,
                    const PlotType& type, const PlotNamer& namer, DrawList& list, Labels& labels);

}  // namespace lantern::draw
