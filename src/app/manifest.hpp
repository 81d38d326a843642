// manifest.json: what a folder of frames holds, and how it came to be. It is written before the
// first frame and after the last one, so that a run that was cut off can go on where it stopped.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "app/selection.hpp"

namespace lantern {

struct Manifest {
  std::string scenario;
  std::string title;
  std::uint64_t seed = 1;
  std::string pace, size, theme, format, png;
  bool transparent = false;
  std::string scenario_hash;  // of the file's bytes
  bool finished = false;
  std::uint64_t expectations = 0;
  std::uint64_t unmet = 0;
  std::map<std::uint32_t, PlannedFrame> frames;  // that stand in the folder, by index

  // Two manifests with the same key describe the same pictures.
  std::string key() const;
  // Two with the same facts describe the same frames, drawn alike or not.
  std::string facts_key() const;
};

struct OldManifest {
  std::string key;
  std::string facts_key;
  bool finished = false;
  std::vector<std::uint32_t> frames;
};

// Nothing if there is none, or if it is damaged: then there is nothing to go on from.
std::optional<OldManifest> read_manifest(const std::filesystem::path& file);

std::string to_json(const Manifest& manifest);

// "ghost_quadtree_0007.png"
std::string frame_file(const std::string& scenario, std::uint32_t index, const std::string& ending);

}  // namespace lantern
