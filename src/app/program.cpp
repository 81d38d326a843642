#include "app/program.hpp"

#include <cerrno>
#include <csignal>
#include <ctime>
#include <new>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "app/commands/command.hpp"
#include "app/folders/shard.hpp"
#include "app/progress.hpp"
#include "app/run_scenario.hpp"
#include "app/terminal.hpp"
#include "base/memory.hpp"
#include "base/printable.hpp"
#include "base/stop.hpp"

namespace lantern::app {
namespace {

// Sanitizers make everything slower, and look for leaks at the end.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr long kSlower = 20;
#else
constexpr long kSlower = 1;
#endif
// Nanoseconds from the signal to the end, but for those in which others had the processor.
constexpr long kPatience = 60'000'000 * kSlower;
constexpr long kTimeToSave = 3'000'000'000 * kSlower;  // the same, once it was heard
constexpr long kLeastWait = 1'000'000;                 // of the processor, that is made up for
constexpr long kSameSignal = 50'000'000;  // `timeout` sends its signal twice, a person does not

timer_t backstop{};
bool has_backstop = false;
timespec first_signal{};
long waited_before = 0;  // kept_waiting() when the backstop was set

long nanoseconds_since(const timespec& then) {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return (now.tv_sec - then.tv_sec) * 1'000'000'000 + (now.tv_nsec - then.tv_nsec);
}

// All of it is safe in a signal handler. A terminal or pipe that takes nothing gets nothing.
[[noreturn]] void end_at_once(int) {
  static constexpr char kMessage[] = "lantern: interrupted at once\n";
  pollfd standard_error{STDERR_FILENO, POLLOUT, 0};
  if (::poll(&standard_error, 1, 0) == 1 && (standard_error.revents & POLLOUT) != 0)
    static_cast<void>(!::write(STDERR_FILENO, kMessage, sizeof kMessage - 1));
  ::_exit(kInterrupted);
}

// Nanoseconds that the main thread was ready to run and others had the processors, by now; 0 where
// the system does not count them. Safe in a signal handler.
long kept_waiting() {
  char text[64] = {};
  const int file = ::open("/proc/self/schedstat", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  const bool read = ::read(file, text, sizeof text - 1) > 0;
  ::close(file);
  long waited = 0;
  const char* at = text;  // "has run, has waited, slices"
  while (read && *at != ' ' && *at != '\0') ++at;
  while (*at == ' ') ++at;
  for (; *at >= '0' && *at <= '9'; ++at) waited = 10 * waited + (*at - '0');
  return waited;
}

void end_in(long nanoseconds) {
  waited_before = kept_waiting();
  const itimerspec when{{0, 0}, {nanoseconds / 1'000'000'000, nanoseconds % 1'000'000'000}};
  if (has_backstop) ::timer_settime(backstop, 0, &when, nullptr);
}

// On a busy machine the work may not have come to hear the wish: then it gets the time that it
// was kept waiting.
void on_alarm(int) {
  const int kept = errno;
  const long waited = kept_waiting() - waited_before;
  if (waited < kLeastWait) end_at_once(0);
  end_in(waited);
  errno = kept;
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

// Made before it is needed, when there may be no room for it.
std::string out_of_memory = "lantern: error: out of memory\n";

// What a run throws is told, and becomes its exit code.
template <class Callable>  // no std::function, which may need memory before anybody listens
int run_and_report(const Callable& run) noexcept {
  try {
    return run();
  } catch (const UsageError& e) {
    complain(e.what());
    return kUsage;
  } catch (const ScenarioError& e) {
    complain(e);
    return exit_code_of(e);
  } catch (const BackendError& e) {
    complain(e);
    return kNoBackend;
  } catch (const ReaderGone&) {
    return kFailed;
  } catch (const Stopped&) {
    complain("interrupted");
    return kInterrupted;
  } catch (const std::bad_alloc&) {
    write_stderr(out_of_memory);  // and needs none
    write_answer_without_memory();
    return kFailed;
  } catch (const fs::filesystem_error& e) {
    complain(
        fmt::format("cannot look at '{}': {}", printable(e.path1().string()), e.code().message()));
    return kFailed;
  } catch (const std::exception& e) {
    complain(e.what());
    return kFailed;
  } catch (...) {
    complain("something that is no std::exception was thrown");
    return kFailed;
  }
}

// Reads the command line and runs what it asks for.
int run_words(int argc, char** argv) {
  const Run run = read_command_line(argc, argv);
  if (!run) return kGood;
  enforce_memory_budget();
  out_of_memory = fmt::format("lantern: error: out of memory: the budget is {}; --memory sets it\n",
                              memory_text(memory_budget()));
  return run();
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_alarm;
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
  struct sigaction before {};  // nohup has it ignored
  ::sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void give_time_to_save() {
  if (stop_asked()) end_in(kTimeToSave);
}

int run_program(int argc, char** argv, std::vector<OwnKind> own, std::vector<OwnPanel> panels) {
  hold_standard_streams();
  keep_freed_memory();
  catch_interrupts();
  const int code = run_and_report([&] {
    if (argc > 1) command_line_words().assign(argv + 1, argv + argc);
    try {
      know_own_structures(std::move(own));
      for (OwnPanel& panel : panels) draw::add_panel(std::move(panel));
    } catch (const Refused& refused) {
      throw UsageError(refused.what());
    }
    return run_words(argc, argv);
  });
  return run_and_report([&] {
    write_answer(code);
    return code;
  });
}

}  // namespace lantern::app
