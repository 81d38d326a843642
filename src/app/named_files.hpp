// Files that the user names, as their sinks write them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "app/file_sink.hpp"
#include "base/work.hpp"

namespace lantern::app {

// Throws UsageError if in-betweens are asked for: what is printed does not move.
void refuse_in_betweens(const Sequence& sequence);

// Makes the folder of a file that an option names, if the file may be written: see require_free().
void make_place(const std::filesystem::path& file);

class NamedFiles {
 public:
  explicit NamedFiles(Work& work) : work_(work) {}

  // Makes the folder and writes the whole file, in which so many frames are. Throws IoError; what
  // stood there before then still does.
  void write(const std::filesystem::path& file, std::string_view bytes, std::uint64_t frames);

  // Before anybody is told that all is finished. Throws IoError.
  void settle() const;

  const FileSink::Made& made() const { return made_; }

 private:
  Work& work_;
  FileSink::Made made_;
};

}  // namespace lantern::app
