#include "base/attempt.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <memory>
#include <new>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/memory.hpp"
#include "base/stop.hpp"

extern "C" void __asan_init() __attribute__((weak));  // tells of faults by itself, and better

namespace lantern {
namespace {

constexpr int kListening = 20;  // milliseconds after which a wish to stop is heard
constexpr rlim_t kStack = 8 << 20;
constexpr std::uintptr_t kAboutStack = 1 << 20, kPage = 4096;

// What both see.
struct Note {
  std::atomic<std::uint64_t> calls{0};
  const char* call = "";
  std::uint32_t body = 0;
  const char* why = "";  // it crashed
  bool done = false;
};
Note* note = nullptr;         // in the copy
double limit_of_call = 0;     // there, too
std::uintptr_t stack_begins;  // there, too

void watch_call(const char* call, std::uint32_t body) {
  itimerval timer{};
  if (call != nullptr) {
    note->call = call;
    note->body = body;
    const auto whole = static_cast<time_t>(limit_of_call);
    timer.it_value = {whole,
                      static_cast<suseconds_t>(1e6 * (limit_of_call - static_cast<double>(whole)))};
  }
  ++note->calls;
  ::setitimer(ITIMER_PROF, &timer, nullptr);  // SIGPROF ends the copy
}

// The instruction is done again afterwards, and ends the copy.
void on_fault(int, siginfo_t* info, void*) {
  const auto at = reinterpret_cast<std::uintptr_t>(info->si_addr);
  if (at < kPage) note->why = ", a null pointer was followed";
  if (at < stack_begins && stack_begins - at > kStack - kAboutStack &&
      stack_begins - at < kStack + kAboutStack)
    note->why = ", its stack is full; does it call itself for ever?";
}

void explain_faults() {
  static std::array<char, 1 << 16> room;
  stack_begins = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  rlimit stack{};
  ::getrlimit(RLIMIT_STACK, &stack);
  stack.rlim_cur = std::min(kStack, stack.rlim_max);
  ::setrlimit(RLIMIT_STACK, &stack);
  if (__asan_init != nullptr) return;
  const stack_t other{room.data(), 0, room.size()};
  ::sigaltstack(&other, nullptr);
  struct sigaction action {};
  action.sa_sigaction = on_fault;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | static_cast<int>(SA_RESETHAND);
  for (const int fault : {SIGSEGV, SIGBUS}) ::sigaction(fault, &action, nullptr);
}

[[noreturn]] void be_the_copy(const AttemptLimits& limits, FunctionRef<void(Tell)> f, Note* both,
                              int told, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  for (const int wish : {SIGINT, SIGTERM}) std::signal(wish, SIG_IGN);  // the parent hears it
  if (!limits.aloud) ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  const rlimit no_core{};
  ::setrlimit(RLIMIT_CORE, &no_core);
  set_memory_budget(std::min(limits.bytes, memory_budget()));
  enforce_memory_budget();
  explain_faults();
  note = both;
  limit_of_call = limits.by_clock ? 0 : limits.seconds;
  detail::attempt_watch = watch_call;
  try {
    const auto tell = [&](std::string_view text) {
      if (!write_all(told, std::string(text) + '\0')) ::_exit(1);
    };
    f(tell);
    note->done = true;
  } catch (...) {  // our own code's, for want of memory
  }
  std::cout.flush();
  std::fflush(nullptr);
  ::_exit(note->done ? 0 : 1);
}

struct Copy {
  pid_t process = -1;
  pid_t group = -1;  // what it has started, too
  int told = -1;
  int status = 0;

  ~Copy() {
    if (group > 0) ::kill(-group, SIGKILL);
    if (process > 0) {
      ::kill(process, SIGKILL);
      while (::waitpid(process, nullptr, 0) < 0 && errno == EINTR) continue;
    }
    if (told >= 0) ::close(told);
  }
  bool has_ended(int options) {
    if (process < 0) return true;
    if (::waitpid(process, &status, options) != process) return false;
    process = -1;
    return true;
  }
};

// What it tells, until it ends or is ended. False if it hangs without taking time.
bool listen(Copy& copy, const Note& both, double seconds, std::string& text) {
  std::array<char, 4096> room;
  Stopwatch since;
  for (std::uint64_t calls = 0;;) {
    stop_if_asked();
    pollfd told{copy.told, POLLIN, 0};
    ::poll(&told, 1, kListening);
    const bool ended = copy.has_ended(WNOHANG);
    ssize_t n = 0;
    while ((n = ::read(copy.told, room.data(), room.size())) > 0)
      text.append(room.data(), static_cast<std::size_t>(n));
    if (ended) return true;
    if (n == 0) return copy.has_ended(0);
    if (calls != both.calls) since = {};
    calls = both.calls;
    if (calls % 2 == 1 && since.seconds() > 10 * seconds) return false;
  }
}

std::string end_of(int status, const Note& both) {
  if (WIFEXITED(status))
    return fmt::format("ended the program, with exit code {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  return fmt::format("crashed (SIG{}: {}{})", ::sigabbrev_np(signal), ::strsignal(signal),
                     both.why);
}

}  // namespace

Attempt attempt(const AttemptLimits& limits, FunctionRef<void(Tell)> f) {
  struct Unmap {
    void operator()(Note* both) const { ::munmap(both, sizeof(Note)); }
  };
  void* const shared =
      ::mmap(nullptr, sizeof(Note), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) throw std::bad_alloc();
  const std::unique_ptr<Note, Unmap> both(new (shared) Note);
  int told[2] = {-1, -1};
  Copy copy;
  const bool ready = ::pipe2(told, O_CLOEXEC) == 0;
  copy.told = told[0];
  std::cout.flush();
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  if (ready) copy.process = ::fork();
  if (copy.process == 0) be_the_copy(limits, f, both.get(), told[1], parent);
  const int code = errno;
  copy.group = copy.process;
  if (told[1] >= 0) ::close(told[1]);
  if (copy.process < 0)
    throw IoError("cannot try it in a process of its own: {}", std::strerror(code));
  ::fcntl(copy.told, F_SETFL, O_NONBLOCK);

  std::string text;
  Attempt made;
  made.hung = !listen(copy, *both, limits.seconds, text);
  if (copy.process < 0 && WIFSIGNALED(copy.status)) made.hung |= WTERMSIG(copy.status) == SIGPROF;
  if (made.hung)
    made.end = fmt::format("did not return in {:g} s", limits.seconds);
  else if (!both->done)
    made.end = end_of(copy.status, *both);
  for (std::size_t at = 0, end = 0; (end = text.find('\0', at)) != text.npos; at = end + 1)
    made.told.push_back(text.substr(at, end - at));
  made.call = fmt::format("{}{}", both->calls % 2 == 1 ? "" : "after ", both->call);
  made.body = both->body;
  return made;
}

}  // namespace lantern
