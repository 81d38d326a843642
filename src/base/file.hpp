// Whole files in, whole files out. A reader never sees half a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace lantern {

// The bytes of a regular file. Throws IoError if it cannot be read, is a folder or a device, or is
// larger than `most_bytes` (found from its size, before it is read).
std::string read_file(const std::filesystem::path& path, std::size_t most_bytes);

// The bytes of standard input, to its end. Throws IoError if it cannot be read or has more than
// `most_bytes`, and Stopped if that is wished while it waits.
std::string read_stdin(std::size_t most_bytes);
// A file that gets its name when it is whole: until then what stood at `path` stands, and when this
// goes, nothing is left. A symbolic link at `path` is replaced, not followed.
class PartFile {
 public:
  // Throws IoError naming path and reason, as the calls below do.
  explicit PartFile(std::filesystem::path path);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  void write(std::string_view bytes);
  void give_name();

  // For another process that is to write it: the open file, and the temporary name that it may have
  // beside; empty if it has none and vanishes with this process.
  int descriptor() const { return descriptor_; }
  const std::filesystem::path& temporary() const { return temporary_; }
  std::uint64_t bytes() const;  // in it by now

 private:
  void open_spare();
  bool link_to(const std::filesystem::path& name);
  [[noreturn]] void fail_to_write() const;

  std::filesystem::path path_, temporary_, spare_;
  int descriptor_ = -1;
};

// Writes under a temporary name in the same folder, then renames, so that `path` is either the old
// file or the whole new one. A symbolic link at `path` is replaced, not followed. Throws IoError
// naming path and reason, and removes the temporary file.
void write_file(const std::filesystem::path& path, std::string_view bytes);

// Returns when everything that was written on the folder's file system would outlast a power cut.
// That is dear: call it once when all is written, before it is said to be finished. Throws IoError.
void make_durable(const std::filesystem::path& folder);

// Takes the numbers of standard streams that are closed, so that no file opened later gets one and
// has messages written into it. What is written to a stream held so is an error like any other.
// Call it before anything is opened.
void hold_standard_streams() noexcept;

// Writes all bytes to standard output, unbuffered. Throws IoError (a full disk, a closed stream);
// ReaderGone if it is a pipe that nobody reads any more.
void write_stdout(std::string_view bytes);

// Writes to standard error what can be written there, unbuffered; the rest is lost.
void write_stderr(std::string_view bytes) noexcept;

// Removes what an earlier write_file left in `folder` when it was killed. Never throws.
void remove_leftovers(const std::filesystem::path& folder) noexcept;

// Makes the folder and its parents. Throws IoError naming path and reason.
void make_folder(const std::filesystem::path& folder);

}  // namespace lantern
