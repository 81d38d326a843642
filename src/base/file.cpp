#include "base/file.hpp"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "base/stop.hpp"

namespace lantern {
namespace {

constexpr std::string_view kTemporary = ".lantern-part-";

std::string shown(const std::filesystem::path& path) { return printable(path.string()); }

[[noreturn]] void fail(const char* what, const std::filesystem::path& path, int code) {
  throw IoError(fmt::format("cannot {} '{}': {}", what, shown(path), std::strerror(code)));
}

// An open file descriptor, closed on the way out.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

// False with errno set if not everything could be written. Waits where a pipe does not.
bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) {
      pollfd room{descriptor, POLLOUT, 0};
      ::poll(&room, 1, -1);
      continue;
    }
    if (n < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

}  // namespace

std::string read_file(const std::filesystem::path& path, std::size_t most_bytes) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() < 0) fail("read", path, errno);
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) fail("read", path, errno);
  if (S_ISDIR(status.st_mode)) fail("read", path, EISDIR);
  if (!S_ISREG(status.st_mode))
    throw IoError(fmt::format("cannot read '{}': not a regular file", shown(path)));
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > most_bytes)
    throw IoError(fmt::format("cannot read '{}': it has {} bytes, the limit is {}", shown(path),
                              size, most_bytes));
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

std::string read_stdin(std::size_t most_bytes) {
  std::string bytes;
  char part[1 << 16];
  for (;;) {
    stop_if_asked();
    const ssize_t n = ::read(STDIN_FILENO, part, sizeof part);
    if (n < 0 && errno == EAGAIN) {
      pollfd something{STDIN_FILENO, POLLIN, 0};
      ::poll(&something, 1, -1);
      continue;
    }
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw IoError(fmt::format("cannot read standard input: {}", std::strerror(errno)));
    if (n == 0) return bytes;
    bytes.append(part, static_cast<std::size_t>(n));
    if (bytes.size() > most_bytes)
      throw IoError(
          fmt::format("cannot read standard input: it has more than {} bytes", most_bytes));
  }
}

// A file without a name vanishes with a killed process. Not every file system has those.
PartFile::PartFile(std::filesystem::path path) : path_(std::move(path)) {
  static std::atomic<unsigned> serial{0};
  const std::filesystem::path folder = path_.has_parent_path() ? path_.parent_path() : ".";
  spare_ = folder / fmt::format("{}{}-{}", kTemporary, ::getpid(), serial++);
  descriptor_ = ::open(folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0666);
  if (descriptor_ < 0) open_spare();
}

PartFile::~PartFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void PartFile::open_spare() {
  descriptor_ = ::open(spare_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail_to_write();
  temporary_ = spare_;
}

void PartFile::fail_to_write() const { fail("write", path_, errno); }

void PartFile::write(std::string_view bytes) {
  if (!write_all(descriptor_, bytes)) fail_to_write();
}

// Without /proc it cannot be given a name: then a copy gets it.
bool PartFile::link_to(const std::filesystem::path& name) {
  const std::string self = fmt::format("/proc/self/fd/{}", descriptor_);
  if (::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) return true;
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
  if (temporary_.empty() && link_to(path_)) return;
  if (temporary_.empty() && link_to(spare_)) temporary_ = spare_;
  if (::close(std::exchange(descriptor_, -1)) != 0 ||  // some disks tell only here
      ::rename(temporary_.c_str(), path_.c_str()) != 0)
    fail_to_write();
  temporary_.clear();
}

std::uint64_t PartFile::bytes() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail("read", path_, errno);
  return static_cast<std::uint64_t>(status.st_size);
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  PartFile file(path);
  file.write(bytes);
  file.give_name();
}

void make_durable(const std::filesystem::path& folder) {
  const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.number() >= 0 && ::syncfs(opened.number()) == 0) return;
  if (errno != ENOSYS) fail("save", folder, errno);
  ::sync();  // more than is wanted, where one file system alone cannot be asked for
}

void hold_standard_streams() noexcept {
  int number;
  do number = ::open("/", O_RDONLY | O_DIRECTORY);
  while (number >= 0 && number <= STDERR_FILENO);
  if (number >= 0) ::close(number);
}

void write_stdout(std::string_view bytes) {
  if (write_all(STDOUT_FILENO, bytes)) return;
  const int code = errno;
  const std::string text = fmt::format("cannot write to standard output: {}", std::strerror(code));
  if (code == EPIPE) throw ReaderGone(text);
  throw IoError(text);
}

void write_stderr(std::string_view bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t n = ::write(STDERR_FILENO, bytes.data(), bytes.size());
    if (n < 0 && errno != EINTR) return;
    if (n > 0) bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void remove_leftovers(const std::filesystem::path& folder) noexcept {
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    if (it->path().filename().string().starts_with(kTemporary)) {
      std::error_code ignored;
      std::filesystem::remove(it->path(), ignored);
    }
  }
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder, error))
    throw IoError(fmt::format("cannot make the folder '{}': {}", shown(folder),
                              error ? error.message() : "something else has this name"));
}

}  // namespace lantern
