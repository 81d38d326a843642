// Files that the user names, as their sinks write them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "app/file_sink.hpp"
#include "base/file.hpp"
#include "base/work.hpp"

namespace lantern::app {

// Throws UsageError if in-betweens are asked for: what is printed does not move.
void refuse_in_betweens(const Sequence& sequence);

// Where a file goes that an option names, if it may be written: see require_free(). Its folder is
// made: `users`, which the user has named, links and all; and what is below, through no link.
FilePlace make_place(const std::filesystem::path& file, const std::filesystem::path& users);

class NamedFiles {
 public:
  explicit NamedFiles(const Sequence& sequence) : to_(sequence.to), work_(sequence.work) {}

  // Makes the folder and writes the whole file, in which so many frames are. Throws IoError; what
  // stood there before then still does.
  void write(const std::filesystem::path& file, std::string_view bytes, std::uint64_t frames);

  // Before anybody is told that all is finished. Throws IoError.
  void settle() const;

  const FileSink::Made& made() const { return made_; }

 private:
  const Destination& to_;
  Work& work_;
  FileSink::Made made_;
};

}  // namespace lantern::app
