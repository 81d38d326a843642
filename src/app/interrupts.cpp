#include "app/interrupts.hpp"

#include <cerrno>
#include <csignal>
#include <ctime>

#include <poll.h>
#include <unistd.h>

#include "app/commands.hpp"
#include "base/stop.hpp"

namespace lantern::app {
namespace {

// Sanitizers make everything slower, and look for leaks at the end.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr long kSlower = 20;
#else
constexpr long kSlower = 1;
#endif
constexpr long kPatience = 60'000'000 * kSlower;       // nanoseconds from the signal to the end
constexpr long kTimeToSave = 3'000'000'000 * kSlower;  // the same, once it was heard
constexpr long kSameSignal = 50'000'000;  // `timeout` sends its signal twice, a person does not

timer_t backstop{};
bool has_backstop = false;
timespec first_signal{};

long nanoseconds_since(const timespec& then) {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return (now.tv_sec - then.tv_sec) * 1'000'000'000 + (now.tv_nsec - then.tv_nsec);
}

// All of it is safe in a signal handler. A terminal or pipe that takes nothing gets nothing.
[[noreturn]] void end_at_once(int) {
  static constexpr char kWords[] = "lantern: interrupted at once\n";
  pollfd standard_error{STDERR_FILENO, POLLOUT, 0};
  if (::poll(&standard_error, 1, 0) == 1 && (standard_error.revents & POLLOUT) != 0)
    static_cast<void>(!::write(STDERR_FILENO, kWords, sizeof kWords - 1));
  ::_exit(kInterrupted);
}

void end_in(long nanoseconds) {
  const itimerspec when{{0, 0}, {nanoseconds / 1'000'000'000, nanoseconds % 1'000'000'000}};
  if (has_backstop) ::timer_settime(backstop, 0, &when, nullptr);
}

void on_signal(int) {
  const int kept = errno;
  if (!stop_asked()) {
    ::clock_gettime(CLOCK_MONOTONIC, &first_signal);
    ask_to_stop();
    end_in(kPatience);
  } else if (nanoseconds_since(first_signal) > kSameSignal) {
    end_at_once(0);
  }
  errno = kept;
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = end_at_once;
  ::sigaction(SIGALRM, &action, nullptr);
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGALRM;
  sigset_t alarm{};  // may have been blocked by whoever has started us
  ::sigemptyset(&alarm);
  ::sigaddset(&alarm, SIGALRM);
  ::sigprocmask(SIG_UNBLOCK, &alarm, nullptr);
  has_backstop = ::timer_create(CLOCK_MONOTONIC, &event, &backstop) == 0;
  action.sa_handler = on_signal;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() { return stop_asked(); }

void give_time_to_save() {
  if (stop_asked()) end_in(kTimeToSave);
}

}  // namespace lantern::app
