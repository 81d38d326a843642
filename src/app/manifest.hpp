// manifest.json: what a folder of frames holds, and how it came to be. It is written before the
// first frame and after the last one.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "render/seal.hpp"
#include "scenario/scenario.hpp"

namespace lantern {

// One frame as the manifest lists it.
struct ListedFrame {
  std::uint32_t step = 0;
  std::string event;
  double time = 0;
  std::string caption;
  std::uint64_t hash = 0;
};

struct Manifest {
  std::string scenario;
  std::string title;
  std::uint64_t seed = 1;
  std::string pace, size, theme, format, png, facts;
  bool transparent = false;
  std::uint64_t scenario_hash = 0;  // of the file's bytes
  bool finished = false;
  std::uint64_t expectations = 0;
  std::uint64_t unmet = 0;
  std::map<std::uint32_t, ListedFrame> frames;  // that stand in the folder, by index

  // What its frame `index` is made from. Neither the range nor the threads, backend or folder
  // belong to it: a frame is the same in any of them.
  MadeFrom frame_from(std::uint32_t index) const;
  // The same of the finished atlas, which has a size of its own.
  MadeFrom atlas_from() const;
};

// Was the folder's last run made by this very build? Two builds of one version may draw
// differently. False if the file is missing or damaged.
bool is_of_this_build(const std::filesystem::path& manifest);

std::string to_json(const Manifest& manifest);

// "ghost_quadtree_0007.png"
std::string frame_file(const std::string& scenario, std::uint32_t index, std::string_view ending);

}  // namespace lantern
