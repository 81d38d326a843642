#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/check.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/printable.hpp"
#include "base/stop.hpp"

namespace lantern {
namespace {

bool input_was_closed = false;  // when the program began (hold_standard_streams)

using FileNumber = std::pair<dev_t, ino_t>;

std::optional<FileNumber> number_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return FileNumber(status.st_dev, status.st_ino);
}

// Of a regular file.
std::optional<FileNumber> number_of(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return FileNumber(status.st_dev, status.st_ino);
}

// Is a standard stream written to a file that this run reads, by whatever way it came to read it?
// From then on nothing is written there.
struct WrittenStream {
  int descriptor;
  const char* name;
  std::atomic<bool> is_read = false;

  void require_free() const {
    if (is_read) throw IoError("{} is written to a file that this run reads", name);
  }
};

WrittenStream output_stream{STDOUT_FILENO, "standard output"};
WrittenStream error_stream{STDERR_FILENO, "standard error"};

// What the run was given to read, by name and number. A number counts only while it is that of the
// name: a file that an editor has replaced meanwhile leaves its number to another one.
class Inputs {
 public:
  void add(const fs::path& path) {
    const auto number = number_of(path);
    const std::lock_guard lock(mutex_);
    paths_.insert(path);
    if (number) files_.insert({*number, path});
  }
  void add_stdin() {
    const auto number = number_of(STDIN_FILENO);
    const std::lock_guard lock(mutex_);
    stdin_ = number;
  }

  bool has(const fs::path& path) {
    const auto number = number_of(path);
    if (!number) return false;
    const std::lock_guard lock(mutex_);
    if (stdin_ == number || paths_.contains(path)) return true;
    for (auto file = files_.lower_bound({*number, {}});
         file != files_.end() && file->first == *number; ++file)
      if (number_of(file->second) == number) return true;
    return false;
  }

 private:
  std::mutex mutex_;
  std::set<fs::path> paths_;
  std::set<std::pair<FileNumber, fs::path>> files_;
  std::optional<FileNumber> stdin_;
};

Inputs& inputs() {
  static Inputs all;
  return all;
}

}  // namespace

void see_read(int descriptor) {
  const auto number = number_of(descriptor);
  bool is_written = false;
  for (WrittenStream* stream : {&output_stream, &error_stream})
    if (number && number_of(stream->descriptor) == number) is_written = stream->is_read = true;
  if (!is_written) return;
  output_stream.require_free();
  error_stream.require_free();
}

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

void add_input(const fs::path& path) { inputs().add(path); }

std::string read_stdin(std::size_t most_bytes) {
  inputs().add_stdin();
  see_read(STDIN_FILENO);
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
    if (n < 0)
      throw IoError("cannot read standard input: {}",
                    input_was_closed ? "it is closed" : std::strerror(errno));
    if (n == 0) return bytes;
    bytes.append(part, static_cast<std::size_t>(n));
    if (bytes.size() > most_bytes)
      throw IoError("cannot read standard input: it has more than {} bytes", most_bytes);
  }
}

bool is_input(const fs::path& path) { return inputs().has(path); }

bool output_is_input() { return output_stream.is_read; }

void hold_standard_streams() noexcept {
  int number;
  do {
    number = ::open("/", O_RDONLY | O_DIRECTORY);
    input_was_closed = input_was_closed || number == STDIN_FILENO;
  } while (number >= 0 && number <= STDERR_FILENO);
  if (number >= 0) ::close(number);
}

void write_stdout(std::string_view bytes) {
  output_stream.require_free();
  if (write_all(STDOUT_FILENO, bytes)) return;
  const int code = errno;
  const std::string text = fmt::format("cannot write to standard output: {}", std::strerror(code));
  if (code == EPIPE) throw ReaderGone(text);
  throw IoError(text);
}

void write_stderr(std::string_view bytes) noexcept {
  if (error_stream.is_read) return;
  while (!bytes.empty()) {
    const ssize_t n = ::write(STDERR_FILENO, bytes.data(), bytes.size());
    if (n < 0 && errno != EINTR) return;
    if (n > 0) bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void detail::stop_broken(const std::string& text) {
  write_stderr(printable(text) + "\n");
  std::abort();
}

}  // namespace lantern
