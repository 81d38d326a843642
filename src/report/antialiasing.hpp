// What antialiasing costs and what it is worth: each choice's error against a picture of 16 x 16
// sub-pixels a pixel, and the time to draw a frame.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/plot.hpp"
#include "draw/theme.hpp"
#include "measure/timed.hpp"
#include "render/context.hpp"
#include "report/reference_picture.hpp"

namespace lantern::report {

struct PictureScene {
  std::string name;
  DrawList list;
};

// One choice on one scene.
struct PictureRow {
  std::string scene;
  std::string family;   // "coverage", "samples", "cairo": a line of the plot
  std::string choice;   // "2 x 2", "none"
  std::string version;  // of a peer; empty for Lantern
  PictureError error;
  Timing timing;     // seconds a frame, from draw list to pixels in memory; of samples no repeats
  std::string part;  // "texts": nothing else was drawn, and not timed; empty for all of the picture
  int width = 0, height = 0;  // of the picture, pixels
};

struct PictureConfig {
  int width = 1280, height = 720;
  Theme theme;
  Backend backend = Backend::automatic;
  TimingRule timing{5, 0.05};
};

struct PictureReport {
  int width = 0, height = 0;
  std::string backend;  // that drew
  std::string cairo;    // its version, or why there is none
  std::vector<std::string> scenes;
  std::vector<PictureRow> rows;  // by scenes, then families in order
};

// Of each scene, in this order:
//   coverage 1 x 1  what Lantern does: the share of a pixel that a shape covers, computed
//   coverage 2 x 2, 4 x 4   the same at a larger size, averaged down in stored levels
//   cairo none, fast, default, best   its own choices; left out without cairo
//   samples 1, 4, 8   no coverage: what the middle of the pixel shows, or the mean of
//   multisampling's
//                     standard places. Not timed: Lantern has no such path, since its shapes are
//                     not triangles and an edge is inside a fragment, where hardware takes one
//                     sample.
// Then, to tell where the error comes from, coverage 1 x 1 and cairo's default again with only the
// rects, lines, polygons and texts of the scene, each against a reference of its own.
//
// Timed frames have every polygon moved by a little, as in a film, so that none of its masks is
// found again; texts stand still. `told` is called after each row. Throws BackendError; Refused for
// a size that cannot be supersampled.
PictureReport measure_pictures(std::span<const PictureScene> scenes, const PictureConfig& config,
                               const std::function<void()>& told);
inline constexpr std::size_t kPictureRows = 18;  // of a scene, at most

// Error (root mean square, levels) against milliseconds: a line for each family that is timed, a
// guide for each number of samples.
Plot picture_plot(const PictureReport& report, const std::string& scene);

// "ghost_quadtree: coverage is off by 1.1 levels in 2.1 ms; ..."
std::string picture_sentence(const PictureReport& report, const std::string& scene);

// "The cheapest way under 10 levels RMS is coverage 1 × 1: 2.1 ms a frame, off by 7.3 levels; cairo
// none is farther off." Of the scene's timed rows; ways that cost the same within the spread of
// their times (costs_the_same) are told as equals. Where none is under 10, the least of 20, 50, 100
// and 255 that one is under. Without a timed row it says so.
std::string cheapest_picture(const PictureReport& report, const std::string& scene);

// A page of 1600 x 900: the plot, that sentence, and in small what drew it and where.
DrawList draw_picture_page(const PictureReport& report, const std::string& scene,
                           const std::string& circumstances);

std::string to_table(const PictureReport& report);
std::string to_csv(const PictureReport& report);
std::string to_json(const PictureReport& report);  // lantern.measure.pictures/1

}  // namespace lantern::report
