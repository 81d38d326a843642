// What `lantern render` is asked for, read once, and a picture made so.
#pragma once

#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/frame_folder.hpp"
#include "app/in_betweens.hpp"
#include "base/work.hpp"
#include "draw/draw_list.hpp"
#include "draw/staging.hpp"
#include "render/pipeline.hpp"
#include "scenario/frame.hpp"

namespace lantern::app {

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
