#include "base/file.hpp"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.hpp"

namespace lantern {
namespace {

constexpr std::string_view kTemporary = ".lantern-part-";

[[noreturn]] void fail(const char* what, const std::filesystem::path& path, int code) {
  throw IoError(fmt::format("cannot {} '{}': {}", what, path.string(), std::strerror(code)));
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
  void open(const std::filesystem::path& path) {
    number_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  }
  // Closes now and tells whether that went well: some disks report a failed write only here.
  bool close() {
    const int number = number_;
    number_ = -1;
    return ::close(number) == 0;
  }

 private:
  int number_;
};

// False with errno set if not everything could be written.
bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
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
    throw IoError(fmt::format("cannot read '{}': not a regular file", path.string()));
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > most_bytes)
    throw IoError(fmt::format("cannot read '{}': it has {} bytes, the limit is {}", path.string(),
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

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  static std::atomic<unsigned> serial{0};
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const std::filesystem::path part =
      folder / fmt::format("{}{}-{}", kTemporary, ::getpid(), serial++);
  // A file without a name vanishes with a killed process; only whole ones are given a name.
  Descriptor file(::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666));
  const bool nameless = file.number() >= 0;
  if (!nameless) file.open(part);
  if (file.number() < 0) fail("write", path, errno);
  const std::string self = fmt::format("/proc/self/fd/{}", file.number());
  const auto give_name = [&](const std::filesystem::path& name) {
    return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  };
  bool good = write_all(file.number(), bytes);
  // A new file gets its own name at once; only one that replaces another needs a name in between.
  if (good && nameless && give_name(path)) return;
  good = good && (!nameless || give_name(part)) && file.close() &&
         ::rename(part.c_str(), path.c_str()) == 0;
  if (!good) {
    const int code = errno;
    ::unlink(part.c_str());
    fail("write", path, code);
  }
}

void write_stdout(std::string_view bytes) {
  if (!write_all(STDOUT_FILENO, bytes))
    throw IoError(fmt::format("cannot write to standard output: {}", std::strerror(errno)));
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
    throw IoError(fmt::format("cannot make the folder '{}': {}", folder.string(),
                              error ? error.message() : "something else has this name"));
}

}  // namespace lantern
