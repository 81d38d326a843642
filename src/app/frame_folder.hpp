// The folder DIR/<scenario>: what an earlier run has left in it, and what of that still stands.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/folder_lock.hpp"
#include "render/seal.hpp"
#include "scenario/scenario.hpp"

namespace lantern::app {

// manifest.json: what a folder of frames holds, and how it came to be. It is written before the
// first frame and after the last one.
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
  std::vector<std::string> switches;  // of the command line, as "no-title"
  std::uint64_t scenario_hash = 0;    // of the file's bytes
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

class FrameFolder {
 public:
  // Makes the folder, and keeps other processes out of it. What an earlier run has left and what is
  // not wanted now is removed, if Lantern made it and nobody has changed it since; `whole` runs, of
  // all frames, leave nothing of another format, either. Throws IoError.
  FrameFolder(const std::filesystem::path& path, const Manifest& wanted, bool whole);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(std::uint32_t index, std::string_view ending) const;
  std::filesystem::path atlas(std::string_view ending) const;

  // Is the picture, or are the facts ("json"), of this frame there as they are wanted?
  bool stands(std::uint32_t index, std::string_view ending) const;
  bool atlas_stands(std::string_view ending) const;

  // Names of files, in order: removed; named as a frame, but not of Lantern's making, and left.
  const std::vector<std::string>& removed() const { return removed_; }
  const std::vector<std::string>& strange() const { return strange_; }

 private:
  bool is_wanted(const std::string& name, std::string_view ending, const MadeFrom& found,
                 bool whole) const;
  void look_at(const std::string& name, bool same_build, bool whole);

  std::filesystem::path path_;
  const Manifest& wanted_;
  FolderLock lock_;
  std::map<std::string, MadeFrom> standing_;  // by file name
  std::vector<std::string> removed_, strange_;
};

}  // namespace lantern::app
