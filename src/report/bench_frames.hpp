// How fast draw lists become files, beside cairo with its own PNG writer in the same run.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "render/context.hpp"

namespace lantern::report {

struct FrameBenchConfig {
  int width = 1920, height = 1080;
  int frames = 60;  // files a writer makes in a round; the lists are taken in turn
  int rounds = 5;   // writers take turns; the median counts
  int threads = 2;  // that encode, beside the one that draws
  Backend backend = Backend::automatic;
  Theme theme;
};

struct FrameWriter {
  std::string name;
  double frames_per_second = 0;  // from draw list to file, median of the rounds
  double against_cairo = 0;      // its rate over that of cairo on one thread; 0 without cairo
  double bytes_per_file = 0;
  double pictures_encoded = 1;  // share of the frames that were not equal to the one before
};

// From the start of a new process: medians, in seconds.
struct StartTimes {
  bool shaders_known = false;  // whether Mesa kept compiled shaders from an earlier process
  double bare_context = 0;
  double first_file = 0;  // a finished frame of 1280 x 720 on disk
};

struct FrameBenchResult {
  FrameBenchConfig config;
  std::string cairo;  // version, or why there is none
  std::vector<FrameWriter> writers;
  std::vector<StartTimes> starts;
};

// Writes into `folder`, which must be there, and removes its files again. At least two lists, each
// different from the next, or equal pictures will be encoded but once. Forks to measure starts: to
// be called before other threads or a graphics library are there. Without cairo its rows are
// missing. Throws Refused (no lists, no rounds), BackendError, IoError.
FrameBenchResult bench_frames(std::span<const DrawList> lists, const std::filesystem::path& folder,
                              const FrameBenchConfig& config);

std::string to_table(const FrameBenchResult& result);
std::string to_json(const FrameBenchResult& result);  // lantern.bench.frames/1

}  // namespace lantern::report
