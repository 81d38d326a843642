// A plot of points on two axes: a frame's chart, and what the reports are made of.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
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

struct PlotPoint {
  Vec<2> at{0.0};         // x, y in the axes' units
  bool beyond = false;    // diverged: drawn as an open mark at the upper edge, whatever its y
  std::string note = {};  // written beside it if there is room; mostly empty
  bool open = false;      // drawn as an open mark where it is
  // How far it may be off, along x and along y: a level and an upright whisker, where it has an
  // extent. The axes widen for it.
  std::optional<Box<2>> spread = std::nullopt;
};

// Points of one contestant, joined in their order; those beyond stand alone.
struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;
  int look = 0;          // colour and mark; the same contestant has the same in every plot
  bool is_peer = false;  // dashed
  bool joined = true;
  int color = 0;  // a body's, where it is not the look's
  PlotInk ink() const { return {look, is_peer, color}; }
};

// A line that is not measured: a rounding floor, a theoretical limit, a bar. It is cut to the plot
// and does not widen its axes.
struct PlotGuide {
  std::string name;
  std::vector<Vec<2>> points;
};

// An order: y goes as x^exponent. Shown as a fan of thin lines in an empty corner, on logarithmic
// axes only.
struct PlotSlope {
  std::string name;
  double exponent = 0;
};

// An outcome, of y from `least` to `most`: "exact" from 0 to 0.
struct PlotBand {
  std::string name;
  double least = 0, most = 0;
  bool holds(double y) const { return y >= least && y <= most; }
};

enum class PlotNames {
  ends,    // at the lines' ends where all have room, else in a legend below
  legend,  // in a legend below
  none,    // elsewhere: several plots share one legend
  column,  // beside the ends in a column at the right, each with its newest number
};

struct Plot {
  std::string title;
  std::string x_name, y_name;  // with their units: "seconds", "error (relative)"
  std::string x_note;          // behind the name of x, where it has room
  bool log_x = true,
       log_y = true;  // a logarithmic y has a place for 0 below its scale, x has none
  std::vector<PlotSeries> series;
  std::vector<PlotGuide> guides;
  std::vector<PlotSlope> slopes;
  std::vector<PlotBand> bands;  // the lowest first; if there are any, y is no
                                // scale
  std::vector<Vec<2>> front;    // the Pareto front's corners, ascending in x; drawn as stairs
  std::string front_name = "Pareto front";
  PlotNames names = PlotNames::ends;
  double size = kDeskLabel;         // of the names; all else follows it
  double mark = 0;                  // radius of the marks; 0 follows the size
  std::string beyond = "diverged";  // the name of the strip at the upper edge
  std::string empty = "no point";   // said when there is none
  // A panel of a frame, to be read from the last row: strong lines with marks apart from each
  // other, numbers written out, and the newest point of each line stressed.
  bool slide = false;
  // x is the seconds of a run, from 0 to `seconds` if that is known: the axes must not jump while
  // it goes on.
  bool over_time = false;
  std::optional<double> seconds;
  std::optional<double> least,
      most;  // ends of y; lines leave the picture beyond them
  // The least and the greatest y that there will ever be: the axis holds them from the beginning.
  std::optional<std::pair<double, double>> range;
  std::optional<std::pair<double, double>> x_range;

  // On the axis of x.
  bool has_place(const PlotPoint& p) const {
    return std::isfinite(p.at.x) && (!log_x || p.at.x > 0);
  }
};

// The key (DrawList::Scope) of what is drawn of a series: "series/3", "series/3/whiskers", or of
// the mark of one of its points, "series/3/7". A slide has none of them.
std::string plot_key(const Plot& plot, const PlotSeries& series);
std::string plot_key(const Plot& plot, const PlotSeries& series, const PlotPoint& point);

// Fills the panel. Names stand at the lines' ends or in a legend, none covers another. Points that
// are not finite are left out, and those in none of the bands; an empty plot says that there is
// nothing to see.
void draw_plot(const Plot& plot, const Box<2>& panel, DrawList& list, Labels& labels);

// The same of a plot that has bands: its values are no scale but a few outcomes: right, wrong by
// one, wrong by more.
//
//   off by 1    |  . . . . . . . . . . . .
//   Bullet      |            o---o             open: not in the lowest band
//   exact       |  . . . . . . . . . . . .
//   impulses    |     x---x---x                a lane for each series
//   Bullet      |       *-------------*
//               +-------------------------  seconds
//
// Every series has a lane of its own in each band that
// it has points in, so that none hides another; bands without points are left out, but never the
// lowest. The last corner of the plot's front, that of least error, is marked. Lanes are named at
// the left if there is room, unless the plot's names are elsewhere.
void draw_banded_plot(const Plot& plot, const Box<2>& panel, DrawList& list, Labels& labels);

// Whether each lane of such a plot has its name beside it.
bool names_its_lanes(const Plot& plot, const Box<2>& panel);

}  // namespace lantern::draw
