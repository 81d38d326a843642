// Whole files in, whole files out, and folders that are held open. A reader never sees half a file,
// and no file is written over what the same run was given to read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace lantern {

namespace fs = std::filesystem;

// The bytes of a regular file. Throws IoError if it cannot be read, is a folder or a device, is
// larger than `most_bytes` (found from its size, before it is read), or is what standard output or
// standard error is written to: nothing is written there any more.
std::string read_file(const fs::path& path, std::size_t most_bytes);

// The same of a file that the user gives to be read: an input of this run from then on.
std::string read_input(const fs::path& path, std::size_t most_bytes);

// A folder that is held open. Whatever happens to its path meanwhile, and whatever names somebody
// else has chosen: nothing is read, written or removed but what is right in it. Names are those of
// single entries, and to give a path, "..", or nothing is a broken invariant; an entry that is a
// symbolic link is not followed. Copies hold the same open folder.
class Folder {
 public:
  // That of a path which the user named, "." if it is empty; links on the way are the user's own.
  // Throws IoError naming path and reason, as the calls below do.
  explicit Folder(const fs::path& path);
  // The same, made with its parents where it is missing.
  static Folder made(const fs::path& path);

  // The folder of this name in it, made where it is missing.
  Folder inside(std::string_view name) const;
  // The same; nothing if there is no entry of this name.
  std::optional<Folder> find(std::string_view name) const;

  // How it was named, and an entry of it: for messages.
  const fs::path& path() const { return path_; }
  fs::path path(std::string_view name) const { return path_ / name; }
  int descriptor() const { return *descriptor_; }

  bool is(const Folder& other) const;          // the same one, under whatever path
  bool has_file(std::string_view name) const;  // a regular file
  bool has(std::string_view name) const;       // an entry of any kind
  std::vector<std::string> names() const;      // of all entries, in order
  // The bytes of a regular file, as read_file() has them, or of a longer one the first, unless
  // `all`; nothing if there is no entry of this name.
  std::optional<std::string> read(std::string_view name, std::size_t most_bytes,
                                  bool all = true) const;
  // A file, or a link itself. False if there is none of this name.
  bool remove(std::string_view name) const;
  // Removes what an earlier PartFile left when it was killed. Never throws.
  void remove_leftovers() const noexcept;
  // Returns when everything that was written on the folder's file system would outlast a power cut.
  // That is dear: call it once when all is written, before it is said to be finished.
  void settle() const;

 private:
  Folder(int descriptor, fs::path path);
  friend struct FilePlace;
  static Folder of_file(const fs::path& file);  // in which it stands

  std::shared_ptr<const int> descriptor_;
  fs::path path_;
};

// Makes the folder and its parents. Throws IoError naming path and reason.
void make_folder(const fs::path& folder);

// The folder in a file's path; "." if there is none.
fs::path folder_of(const fs::path& file);

// Where a file stands, or shall stand: the name of an entry of a folder, or a path that the user
// names, whose folder must be there. Throws IoError naming path and reason.
struct FilePlace {
  FilePlace(Folder in, std::string_view called) : folder(std::move(in)), name(called) {}
  template <class Path>
  requires std::is_convertible_v<Path, fs::path> FilePlace(const Path& path)
      : FilePlace(fs::path(path), 0) {}

  fs::path path() const { return folder.path(name); }  // for messages

  Folder folder;
  std::string name;

 private:
  FilePlace(const fs::path& path, int);
};

// Throws IoError where PartFile would: for an input of this run, and for a folder. To be asked
// before anything is removed.
void require_writable(const FilePlace& place);

// A file that gets its name when it is whole: until then what stood there stands, and when this
// goes, nothing is left. A symbolic link of this name is replaced, not followed.
class PartFile {
 public:
  // Throws IoError naming path and reason, as the calls below do; also for an input of this run.
  explicit PartFile(FilePlace place);
  ~PartFile();
  PartFile& operator=(PartFile&&) = delete;  // nor any other copy or move

  void write(std::string_view bytes);
  void give_name();

  // For another process that is to write it: the open file, and the temporary name that it may have
  // beside; empty if it has none and vanishes with this process.
  int descriptor() const { return descriptor_; }
  fs::path temporary() const;
  std::uint64_t bytes() const;  // in it by now

 private:
  void open_spare();
  bool link_to(const std::string& name);
  [[noreturn]] void fail_to_write() const;

  FilePlace place_;
  std::string temporary_, spare_;
  int descriptor_ = -1;
};

// Writes under a temporary name in the same folder, then renames, so that there is either the old
// file or the whole new one. Throws IoError as PartFile does, and removes the temporary file.
void write_file(const FilePlace& place, std::string_view bytes);

// Held until destroyed, or until the process ends, however it does. On disks that know no locks it
// keeps nobody out.
class FolderLock {
 public:
  // Waits up to two seconds for it. Throws IoError if another process holds it then; Stopped if
  // that is wished meanwhile.
  explicit FolderLock(const Folder& folder);
  ~FolderLock();
  FolderLock& operator=(FolderLock&&) = delete;  // nor any other copy or move

 private:
  int descriptor_;
};

// --- what a run reads and where its words go: its inputs, over which nothing is written, and the
// standard streams (streams.cpp) ---

// The bytes of standard input, to its end: an input of this run, too. Throws IoError as read_file()
// does, and Stopped if that is wished while it waits.
std::string read_stdin(std::size_t most_bytes);

// What will be read is an input before it is.
void add_input(const fs::path& path);

// Is what stands at `path` an input of this run, under whatever name? Nothing is written over it.
bool is_input(const fs::path& path);

// Is standard output written to a file that this run has read, an input or not? Nothing is written
// there either.
bool output_is_input();

// What is open at `descriptor` is about to be read. Throws IoError if it is the file that standard
// output or standard error is written to: nothing is written there any more.
void see_read(int descriptor);

// False with errno set if not everything could be written. Waits where a pipe does not.
bool write_all(int descriptor, std::string_view bytes);

// Takes the numbers of standard streams that are closed, so that no file opened later gets one and
// has messages written into it. What is written to a stream held so is an error like any other.
// Call it before anything is opened.
void hold_standard_streams() noexcept;

// Writes all bytes to standard output, unbuffered. Throws IoError (a full disk, a closed stream, an
// input of this run); ReaderGone if it is a pipe that nobody reads any more.
void write_stdout(std::string_view bytes);

// Writes to standard error what can be written there, unbuffered; the rest is lost, and all of it
// where standard error is a file that this run has read.
void write_stderr(std::string_view bytes) noexcept;

}  // namespace lantern
