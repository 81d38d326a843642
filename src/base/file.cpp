#include "base/file.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <thread>

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/check.hpp"
#include "base/error.hpp"
#include "base/printable.hpp"
#include "base/stop.hpp"

namespace lantern {

namespace {

constexpr std::string_view kTemporary = ".lantern-part-";

std::string shown(const fs::path& path) { return printable(path.string()); }

[[noreturn]] void fail(const char* what, const fs::path& path, int code) {
  throw IoError("cannot {} '{}': {}", what, shown(path), std::strerror(code));
}

// An open file descriptor, closed on the way out.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor& operator=(Descriptor&&) = delete;  // nor any other copy or move
  int number() const { return number_; }

 private:
  int number_;
};

// What was opened to be read from `path`: all of it, or its first bytes.
std::string read_opened(const Descriptor& file, const fs::path& path, std::size_t most_bytes,
                        bool all = true) {
  if (file.number() < 0) fail("read", path, errno);
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) fail("read", path, errno);
  if (S_ISDIR(status.st_mode)) fail("read", path, EISDIR);
  if (!S_ISREG(status.st_mode)) throw IoError("cannot read '{}': not a regular file", shown(path));
  see_read(file.number());
  const auto has = static_cast<std::size_t>(status.st_size), size = std::min(has, most_bytes);
  if (all && has > most_bytes)
    throw IoError("cannot read '{}': it has {} bytes, the limit is {}", shown(path), has,
                  most_bytes);
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    const ssize_t n = ::read(file.number(), bytes.data() + done, size - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("read", path, errno);
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  bytes.resize(done);
  return bytes;
}

// As open() takes it: one entry, of which somebody else may have chosen the name.
const char* entry(const std::string& name) {
  const bool is_one = !name.empty() && name != "." && name != ".." &&
                      name.find_first_of(std::string_view("/\0", 2)) == name.npos;
  LANTERN_CHECK(is_one ? name : "the name of one entry", ==, name);
  return name.c_str();
}

int open_folder(const fs::path& path) {
  return ::open(path.empty() ? "." : path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

}  // namespace

std::string read_file(const fs::path& path, std::size_t most_bytes) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  return read_opened(file, path, most_bytes);
}

std::string read_input(const fs::path& path, std::size_t most_bytes) {
  add_input(path);
  return read_file(path, most_bytes);
}

Folder::Folder(int descriptor, fs::path path)
    : descriptor_(new int(descriptor),
                  [](const int* number) {
                    ::close(*number);
                    delete number;
                  }),
      path_(std::move(path)) {}

Folder::Folder(const fs::path& path) : Folder(open_folder(path), path) {
  if (descriptor() < 0) fail("open", path, errno);
}

Folder Folder::made(const fs::path& path) {
  make_folder(path);
  return Folder(path);
}

// That it is missing is told of the file.
Folder Folder::of_file(const fs::path& file) {
  const bool has_name = file.has_filename() && file.filename() != "." && file.filename() != "..";
  if (!has_name) fail("write", file, EISDIR);
  const int number = open_folder(file.parent_path());
  if (number < 0) fail("write", file, errno);
  return {number, file.parent_path()};
}

std::optional<Folder> Folder::find(std::string_view name) const {
  const std::string one(name);
  const int number =
      ::openat(descriptor(), entry(one), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (number >= 0) return Folder(number, path(name));
  if (errno == ENOENT) return std::nullopt;
  if (errno == ENOTDIR || errno == ELOOP)
    throw IoError("'{}' is {}", shown(path(name)),
                  fs::is_symlink(path(name)) ? "a link; links are not followed here" : "no folder");
  fail("open", path(name), errno);
}

Folder Folder::inside(std::string_view name) const {
  if (auto there = find(name)) return *there;
  if (::mkdirat(descriptor(), std::string(name).c_str(), 0777) != 0 && errno != EEXIST)
    throw IoError("cannot make the folder '{}': {}", shown(path(name)), std::strerror(errno));
  if (auto made = find(name)) return *made;
  fail("open", path(name), ENOENT);
}

bool Folder::is(const Folder& other) const {
  struct stat here {
  }, there{};
  return ::fstat(descriptor(), &here) == 0 && ::fstat(other.descriptor(), &there) == 0 &&
         here.st_dev == there.st_dev && here.st_ino == there.st_ino;
}

bool Folder::has_file(std::string_view name) const {
  struct stat status {};
  const std::string one(name);
  return ::fstatat(descriptor(), entry(one), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
         S_ISREG(status.st_mode);
}

bool Folder::has(std::string_view name) const {
  struct stat status {};
  const std::string one(name);
  return ::fstatat(descriptor(), entry(one), &status, AT_SYMLINK_NOFOLLOW) == 0;
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> names;
  // Opened anew: copies of a descriptor would share one place in the list.
  const int number = ::openat(descriptor(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  DIR* list = number < 0 ? nullptr : ::fdopendir(number);
  if (!list) {
    const int code = errno;
    if (number >= 0) ::close(number);
    fail("list", path_, code);
  }
  while (const dirent* one = ::readdir(list)) {
    const std::string_view name = one->d_name;
    if (name != "." && name != "..") names.emplace_back(name);
  }
  ::closedir(list);
  std::ranges::sort(names);
  return names;
}

std::optional<std::string> Folder::read(std::string_view name, std::size_t most_bytes,
                                        bool all) const {
  const std::string one(name);
  const Descriptor file(
      ::openat(descriptor(), entry(one), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW));
  if (file.number() < 0 && errno == ENOENT) return std::nullopt;
  if (file.number() < 0 && errno == ELOOP)
    throw IoError("cannot read '{}': a link, and what it leads to is not touched",
                  shown(path(name)));
  return read_opened(file, path(name), most_bytes, all);
}

bool Folder::remove(std::string_view name) const {
  const std::string one(name);
  if (::unlinkat(descriptor(), entry(one), 0) == 0) return true;
  if (errno == ENOENT) return false;
  fail("remove", path(name), errno);
}

void Folder::remove_leftovers() const noexcept try {
  for (const std::string& name : names())
    if (name.starts_with(kTemporary)) ::unlinkat(descriptor(), name.c_str(), 0);
} catch (const std::exception&) {
  // they take no more than room
}

void Folder::settle() const {
  if (::syncfs(descriptor()) == 0) return;
  if (errno != ENOSYS) fail("save", path_, errno);
  ::sync();  // more than is wanted, where one file system alone cannot be asked for
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error))
    throw IoError("cannot make the folder '{}': {}", shown(folder),
                  error ? error.message() : "something else has this name");
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

FilePlace::FilePlace(const fs::path& path, int)
    : folder(Folder::of_file(path)), name(path.filename().string()) {}

void require_writable(const FilePlace& place) {
  if (is_input(place.path()))
    throw IoError("cannot write '{}': it is what this run has read", shown(place.path()));
  struct stat status {};
  if (::fstatat(place.folder.descriptor(), entry(place.name), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
      S_ISDIR(status.st_mode))
    fail("write", place.path(), EISDIR);
}

// A file without a name vanishes with a killed process. Not every file system has those.
PartFile::PartFile(FilePlace place) : place_(std::move(place)) {
  static std::atomic<unsigned> serial{0};
  require_writable(place_);
  spare_ = fmt::format("{}{}-{}", kTemporary, ::getpid(), serial++);
  descriptor_ = ::openat(place_.folder.descriptor(), ".", O_RDWR | O_TMPFILE | O_CLOEXEC, 0666);
  if (descriptor_ < 0) open_spare();
}

PartFile::~PartFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlinkat(place_.folder.descriptor(), temporary_.c_str(), 0);
}

void PartFile::open_spare() {
  descriptor_ = ::openat(place_.folder.descriptor(), spare_.c_str(),
                         O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail_to_write();
  temporary_ = spare_;
}

fs::path PartFile::temporary() const {
  return temporary_.empty() ? fs::path() : place_.folder.path(temporary_);
}

void PartFile::fail_to_write() const { fail("write", place_.path(), errno); }

void PartFile::write(std::string_view bytes) {
  if (!write_all(descriptor_, bytes)) fail_to_write();
}

// Without /proc it cannot be given a name: then a copy gets it.
bool PartFile::link_to(const std::string& name) {
  const std::string self = fmt::format("/proc/self/fd/{}", descriptor_);
  if (::linkat(AT_FDCWD, self.c_str(), place_.folder.descriptor(), name.c_str(),
               AT_SYMLINK_FOLLOW) == 0)
    return true;
  if (errno == EEXIST) return false;
  const Descriptor nameless(std::exchange(descriptor_, -1));
  open_spare();
  std::string part(std::size_t{1} << 20, '\0');
  for (off_t at = 0;;) {
    const ssize_t n = ::pread(nameless.number(), part.data(), part.size(), at);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_to_write();
    if (n == 0) return false;
    write({part.data(), static_cast<std::size_t>(n)});
    at += n;
  }
}

// At once if it is new, by way of a temporary name if it replaces a file.
void PartFile::give_name() {
  if (temporary_.empty() && link_to(place_.name)) return;
  if (temporary_.empty() && link_to(spare_)) temporary_ = spare_;
  if (::close(std::exchange(descriptor_, -1)) != 0 ||  // some disks tell only here
      ::renameat(place_.folder.descriptor(), temporary_.c_str(), place_.folder.descriptor(),
                 place_.name.c_str()) != 0)
    fail_to_write();
  temporary_.clear();
}

std::uint64_t PartFile::bytes() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail("read", place_.path(), errno);
  return static_cast<std::uint64_t>(status.st_size);
}

void write_file(const FilePlace& place, std::string_view bytes) {
  PartFile file(place);
  file.write(bytes);
  file.give_name();
}

// Opened anew: copies of a descriptor share their locks.
FolderLock::FolderLock(const Folder& folder)
    : descriptor_(::openat(folder.descriptor(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0)
    throw IoError("cannot open '{}': {}", folder.path().string(), std::strerror(errno));
  // A run that was killed a moment ago may not be quite gone.
  constexpr int kTries = 100;
  constexpr auto kPause = std::chrono::milliseconds(20);
  for (int tries = 0; tries < kTries; ++tries) {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    if (stop_asked()) break;
    std::this_thread::sleep_for(kPause);
  }
  ::close(descriptor_);
  stop_if_asked();
  throw IoError("another run is writing into '{}'; wait for it, or give -o another folder",
                folder.path().string());
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace lantern
