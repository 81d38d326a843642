// The folder DIR/<scenario>: what an earlier run has left in it, and what of that still stands.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
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
  std::uint64_t in_betweens = 0;  // from it to the next one
};

struct Manifest {
  std::string scenario;
  std::string title;
  std::uint64_t seed = 1;
  std::string pace, size, theme, format, png, facts;
  std::string in_betweens;    // how many are wanted, as InBetweens says it; empty for none
  int in_between_digits = 2;  // of their numbers, so that they stand in order by name
  bool transparent = false;
  std::vector<std::string> switches;  // of the command line, as "no-title", "dpi-300"
  std::uint64_t scenario_hash = 0;    // of the file's bytes
  bool finished = false;
  std::uint64_t expectations = 0;
  std::uint64_t unmet = 0;
  std::map<std::uint32_t, ListedFrame> frames;  // that stand in the folder, by index

  // What its frame `index` is made from. Neither the range nor the threads, backend or folder
  // belong to it: a frame is the same in any of them.
  MadeFrom frame_from(std::uint32_t index) const;
  // The same of its `number`-th in-between, from 1: of the way from frame `index` to the next.
  MadeFrom in_between_from(std::uint32_t index, std::uint64_t number) const;
  // The same of the finished atlas, which has a size of its own.
  MadeFrom atlas_from() const;
};

// Was the folder's last run made by this very build? Two builds of one version may draw
// differently. False if the file is missing or damaged.
bool is_of_this_build(const std::filesystem::path& manifest);

std::string to_json(const Manifest& manifest);
// What to_json wrote, but for the digits of in-betweens, which it does not tell. Nothing for a text
// that is damaged, of another format, or of another build.
std::optional<Manifest> read_manifest(std::string_view json);

// "ghost_quadtree_0007.png"
std::string frame_file(const std::string& scenario, std::uint32_t index, std::string_view ending);
// The index of the frame whose picture or facts have this name; nothing for any other file.
std::optional<std::uint32_t> frame_of(std::string_view file, const std::string& scenario);
// Are these the bytes of such a file exactly as Lantern wrote it? By its ending: png, svg, json.
bool is_as_made(std::string_view file, std::string_view bytes);
// "ghost_quadtree_atlas.png"
std::string atlas_file(const std::string& scenario, std::string_view ending);
// "ghost_quadtree_0007_03.png", the third on the way from frame 7 to frame 8: by name in-betweens
// stand where they are seen.
std::string in_between_file(const Manifest& manifest, std::uint32_t index, std::uint64_t number);

// Words about files, the first few of them by name: "ghosts: removed: a.png, b.png and 17 more".
std::string about_files(const std::string& scenario, const char* what,
                        const std::vector<std::string>& names);

class FrameFolder {
 public:
  // Makes the folder, and keeps other processes out of it. What an earlier run has left and what is
  // not wanted now is removed, if Lantern made it and nobody has changed it since; `whole` runs, of
  // all frames, leave nothing of another format, either. Throws IoError.
  FrameFolder(const std::filesystem::path& path, const Manifest& wanted, bool whole);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(std::uint32_t index, std::string_view ending) const;
  std::filesystem::path in_between(std::uint32_t index, std::uint64_t number) const;
  std::filesystem::path atlas(std::string_view ending) const;

  // Is the picture, or are the facts ("json"), of this frame there as they are wanted?
  bool stands(std::uint32_t index, std::string_view ending) const;
  bool in_between_stands(std::uint32_t index, std::uint64_t number) const;
  bool atlas_stands(std::string_view ending) const;
  bool stands(const std::string& name) const { return standing_.contains(name); }
  // How many in-betweens stand from this frame on.
  std::uint64_t in_betweens_standing(std::uint32_t index) const;

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
