// The folder DIR/<scenario>: what an earlier run has left in it, and what of that still stands.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "frame/frame.hpp"
#include "language/scenario.hpp"
#include "render/png.hpp"

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
  explicit Manifest(ScenarioName of) : scenario(std::move(of)) {}

  ScenarioName scenario;
  std::string title;
  std::uint64_t seed = 1;
  Pace pace = Pace::step;
  std::string size, theme;  // "1600x900", "light"
  FileKind format = FileKind::png;
  PngEffort png = PngEffort::fast;
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

// How manifests, and the command line, call what a folder's files are.
inline constexpr std::pair<std::string_view, FileKind> kPictureKinds[] = {{"png", FileKind::png},
                                                                          {"svg", FileKind::svg}};
inline constexpr std::pair<std::string_view, PngEffort> kPngEfforts[] = {
    {"fast", PngEffort::fast}, {"small", PngEffort::small}};
inline constexpr std::pair<std::string_view, Pace> kPaces[] = {{"step", Pace::step},
                                                               {"event", Pace::event}};

// The word for a value, which must be there.
template <class Value, std::size_t n>
std::string_view word_for(Value value, const std::pair<std::string_view, Value> (&words)[n]) {
  return std::ranges::find(words, value, &std::pair<std::string_view, Value>::second)->first;
}

inline constexpr const char* kManifest = "manifest.json";

std::string to_json(const Manifest& manifest);
// What to_json wrote, but for the digits of in-betweens, which it does not tell. Throws RefusedFile
// (app/folders/kept_files.hpp) for a text that is anything else, or of another build.
Manifest read_manifest(std::string_view json);

// "ghost_quadtree_0007.png"
std::string frame_file(const ScenarioName& scenario, std::uint32_t index, FileKind kind);
// The index of the frame whose picture or facts have this name; nothing for any other file.
std::optional<std::uint32_t> frame_of(std::string_view file, std::string_view scenario);
// Would a run write a file of this name into a scenario's folder?
bool is_frame_file(std::string_view file, std::string_view scenario);
// Are these the bytes of such a file exactly as Lantern wrote it? By its ending: png, svg, json.
bool is_as_made(std::string_view file, std::string_view bytes);
// "ghost_quadtree_atlas.png"
std::string atlas_file(const ScenarioName& scenario, FileKind kind);
// "ghost_quadtree_0007_03.png", the third on the way from frame 7 to frame 8: by name in-betweens
// stand where they are seen.
std::string in_between_file(const Manifest& manifest, std::uint32_t index, std::uint64_t number);

// Words about files, the first few of them by name: "ghosts: removed: a.png, b.png and 17 more".
std::string about_files(const std::string& scenario, const char* what,
                        const std::vector<std::string>& names);

class FrameFolder {
 public:
  // Makes DIR/<scenario> in the folder DIR, keeps other processes out of it, and looks at what an
  // earlier run has left. Throws IoError, and UsageError for a folder that Lantern keeps for
  // something else.
  FrameFolder(const Folder& output, const Manifest& wanted, bool whole);

  const Folder& folder() const { return folder_; }

  // Is the picture, or are the facts (FileKind::json), of this frame there as they are wanted?
  bool stands(std::uint32_t index, FileKind kind) const;
  bool stands(const std::string& name) const { return standing_.contains(name); }
  // How many in-betweens stand from this frame on.
  std::uint64_t in_betweens_standing(std::uint32_t index) const;

  // Removes what an earlier run has left and what is not wanted now, if Lantern made it and nobody
  // has changed it since; `whole` runs, of all frames, leave nothing of another format, either.
  // Says so. To be called when all is there that the frames need.
  void remove_old() const;
  // Of the files that stood there under names of ours, but not as Lantern made them: warns which
  // are left, and which are replaced, since they are among the files written.
  void tell_of_strange(const std::set<std::string>& written) const;

 private:
  bool is_wanted(const std::string& name, FileKind kind, const MadeFrom& found, bool whole) const;
  void look_at(const std::string& name, bool same_build, bool whole);

  Folder folder_;
  const Manifest& wanted_;
  FolderLock lock_;
  std::set<std::string> standing_;  // names of files, as those below
  std::vector<std::string> old_, strange_;
};

}  // namespace lantern::app
