// What `lantern render` is asked for, read once, and a picture made so.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/frame_folder.hpp"
#include "app/in_betweens.hpp"
#include "base/work.hpp"
#include "draw/draw_list.hpp"
#include "draw/staging.hpp"
#include "render/pipeline.hpp"
#include "scenario/frame.hpp"

namespace lantern::app {

struct RenderOptions {
  std::vector<std::string> files;
  std::string output = "output";  // folder or file, see Destination; "-" is standard output
  std::string sheet;              // "3x2": frames across and down a page; empty for none
  std::string frames;             // "7", "3-9", "3-", "-9"; empty for all
  std::string at;                 // an event or a time in seconds; empty for all
  std::string size;               // pixels; empty for 1600x900, and for a sheet A4 across
  int dpi = 160;                  // pixels to the inch, where a picture meets paper
  std::string format = "png";     // png, svg
  std::string text = "outlines";  // of SVG: outlines, text
  std::string theme = "light";
  std::string pace;              // step, event; empty for the scenario's own
  std::string png = "fast";      // fast, small
  std::string backend = "auto";  // auto, osmesa, egl
  bool transparent = false;
  bool no_title = false, no_caption = false, no_counters = false;  // not drawn
  bool legend = false;                                             // drawn in any case
  bool strict = false;                                             // warnings are errors
  std::optional<int> threads;                         // that encode; none for one a core
  std::optional<std::uint64_t> tween = std::nullopt;  // in-betweens before each frame but the first
  std::optional<double> fps = std::nullopt;           // or as many as a change of half a second has
  bool reloading = false;  // a page loads itself again when it was made again (app/reload.hpp)
  std::string shard = "";  // "2/4": the second of four parts; empty for all
  std::optional<double> hold = std::nullopt;     // seconds of each still of a film
  bool format_given = false, png_given = false;  // on the command line
  bool json = false;
};

// Draws what is asked for; gives the exit code.
int draw_scenarios(const RenderOptions& options);
// Draws, and again what was saved since, until Ctrl-C: exit code 130.
int watch_scenarios(const RenderOptions& options);

struct RenderJob {
  // Throws UsageError for a size that cannot be. The options must outlive this.
  explicit RenderJob(const RenderOptions& options);

  const RenderOptions& options;
  Pipeline::Config picture;  // how the picture of a frame is made
  Backend backend = Backend::automatic;
  FileKind format = FileKind::png;  // of a frame's picture, where it is a file
  InBetweens in_betweens;

  // What of the frame is shown: as the scenario has it, and the command line.
  Display display_of(const Frame& frame) const;

  // The picture on paper, in points of 1/72 inch.
  Vec<2> points() const;

  // The frame as a page, with what the command line switches on and off.
  DrawList page_of(const Frame& frame, const Staging& staging, Work& work) const;

  // Of a folder that holds no frame yet.
  Manifest manifest(const Scenario& scenario, Pace pace) const;
};

// What a PNG says of its frame.
std::vector<PngText> texts_of(const Frame& frame);

// A whole file, sealed, in the job's format; `as` tells size and style, which the job's own
// pictures take from job.picture. For PNG it starts graphics and ends them.
std::string picture_of(const RenderJob& job, const Pipeline::Config& as, const Frame& frame,
                       const DrawList& list, const MadeFrom& from, Work& work);

}  // namespace lantern::app
