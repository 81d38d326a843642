#include "base/child.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <sstream>
#include <utility>

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "base/stop.hpp"

namespace lantern {

std::optional<std::filesystem::path> find_program(std::string_view name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::error_code error;
    const auto file = std::filesystem::path(folder) / name;
    if (std::filesystem::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0)
      return file;
  }
  return std::nullopt;
}

namespace {

constexpr std::size_t kMostSaid = 4096;
constexpr int kHearing = 20;             // milliseconds after which a wish to stop is heard
constexpr int kPipeBytes = 1024 * 1024;  // a pipe's usual room is small beside a picture

// A pipe that nobody reads is an error like any other, whatever this process does about SIGPIPE.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    ::sigemptyset(&pipe_);
    ::sigaddset(&pipe_, SIGPIPE);
    ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoPipeSignal() {
    const timespec at_once{};
    while (::sigtimedwait(&pipe_, nullptr, &at_once) < 0 && errno == EINTR) continue;
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoPipeSignal& operator=(NoPipeSignal&&) = delete;  // nor any other copy or move

 private:
  sigset_t pipe_{}, before_{};
};

void close_once(int& number) {
  if (number >= 0) ::close(number);
  number = -1;
}

// All that a process needs to start another one; what is left of it is closed.
struct Streams {
  int input[2] = {-1, -1}, words[2] = {-1, -1};  // ends to read and to write
  int nowhere = -1;
  std::optional<int> handed_on;

  Streams(const std::string& program, std::optional<int> handed) : handed_on(handed) {
    if (::pipe2(input, O_CLOEXEC) == 0 && ::pipe2(words, O_CLOEXEC) == 0 &&
        (nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC)) >= 0)
      return;
    const int code = errno;
    close_all();
    throw IoError("cannot run '{}': {}", printable(program), std::strerror(code));
  }
  ~Streams() { close_all(); }
  Streams& operator=(Streams&&) = delete;  // nor any other copy or move
  void close_all() {
    for (int* number : {&input[0], &input[1], &words[0], &words[1], &nowhere}) close_once(*number);
  }
};

// What the new process does until it is the other program: nothing that takes memory or a lock.
[[noreturn]] void become(const std::vector<char*>& words, const Streams& streams, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::dup2(streams.input[0], STDIN_FILENO);
  ::dup2(streams.nowhere, STDOUT_FILENO);
  ::dup2(streams.words[1], STDERR_FILENO);
  if (streams.handed_on) {
    if (*streams.handed_on == Child::kHandedOn)
      ::fcntl(Child::kHandedOn, F_SETFD, 0);
    else
      ::dup2(*streams.handed_on, Child::kHandedOn);
  }
  ::execv(words[0], words.data());
  const char* const why = std::strerror(errno);
  static_cast<void>(!::write(STDERR_FILENO, why, std::strlen(why)));
  ::_exit(127);
}

}  // namespace

Child::Child(const std::vector<std::string>& words, std::optional<int> handed_on) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  Streams streams(words.front(), handed_on);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) become(pointers, streams, parent);
  if (process_ < 0)
    throw IoError("cannot run '{}': {}", printable(words.front()), std::strerror(errno));
  ::setpgid(process_, process_);  // whoever is first
  input_ = std::exchange(streams.input[1], -1);
  words_ = std::exchange(streams.words[0], -1);
  ::fcntl(input_, F_SETFL, O_NONBLOCK);
  ::fcntl(words_, F_SETFL, O_NONBLOCK);
  ::fcntl(input_, F_SETPIPE_SZ, kPipeBytes);  // as much as the system allows
}

Child::~Child() {
  close_once(input_);
  close_once(words_);
  if (process_ < 0) return;
  end();
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
}

void Child::end() noexcept {
  const std::lock_guard lock(waiting_);
  if (process_ < 0) return;
  ::kill(-process_, SIGKILL);
  ::kill(process_, SIGKILL);  // should it have no group yet
}

// What it has said by now. Without this it would wait for ever, once the pipe is full.
void Child::listen() {
  std::array<char, 1024> text;
  while (words_ >= 0) {
    const ssize_t n = ::read(words_, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) return;
    if (n <= 0) return close_once(words_);
    said_.append(text.data(), static_cast<std::size_t>(n));
    if (said_.size() > kMostSaid) said_.erase(0, said_.size() - kMostSaid);
  }
}

bool Child::write(std::string_view bytes) {
  const NoPipeSignal quiet;
  while (!bytes.empty() && input_ >= 0) {
    stop_if_asked();
    std::array<pollfd, 2> both = {{{input_, POLLOUT, 0}, {words_, POLLIN, 0}}};
    ::poll(both.data(), both.size(), kHearing);
    listen();
    const ssize_t n = ::write(input_, bytes.data(), bytes.size());
    if (n >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(n));
    else if (errno != EINTR && errno != EAGAIN)
      close_once(input_);
  }
  return bytes.empty();
}

// A number that was waited for may be another process's, and -1 is every process: end() must see
// neither.
bool Child::has_ended() {
  const std::lock_guard lock(waiting_);
  const pid_t ended = ::waitpid(process_, &status_, WNOHANG);
  if (ended == 0 || (ended < 0 && errno == EINTR)) return false;
  process_ = -1;
  return true;
}

int Child::finish() {
  close_once(input_);
  while (process_ >= 0) {
    stop_if_asked();
    listen();
    if (!has_ended()) {
      pollfd words{words_, POLLIN, 0};
      ::poll(&words, 1, words_ >= 0 ? kHearing : 1);
    }
  }
  listen();
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
}

Library::Library(std::initializer_list<const char*> names) {
  for (const char* name : names) {
    name_ = name;
    handle_ = ::dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (handle_) return;
    const char* why = ::dlerror();
    problem_ = why ? why : "it cannot be loaded";
  }
}

void* Library::symbol(const char* name) const { return handle_ ? ::dlsym(handle_, name) : nullptr; }

}  // namespace lantern
