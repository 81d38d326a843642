// The folder DIR/<scenario>: what an earlier run has left in it, and what of that still stands.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/manifest.hpp"
#include "base/folder_lock.hpp"

namespace lantern {

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

}  // namespace lantern
