#include "app/terminal.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>
#include <unistd.h>

#include "base/stop.hpp"

namespace lantern {
namespace {

constexpr double kRedraw = 0.1;     // seconds between two drawings on a terminal
constexpr double kPlainLine = 5.0;  // and between two plain lines elsewhere

}  // namespace

bool animated() { return ::isatty(STDERR_FILENO) == 1; }

bool colourful() {
  const char* no_color = std::getenv("NO_COLOR");
  return animated() && (no_color == nullptr || *no_color == '\0');
}

void say(std::string_view message) { fmt::print(stderr, "{}\n", message); }

void complain(std::string_view message) {
  say(fmt::format("lantern: {} {}", colourful() ? "\033[1;31merror:\033[0m" : "error:", message));
}

void complain(const ScenarioError& error) {
  for (const Diagnostic& diagnostic : error.diagnostics()) {
    std::string text = to_string(diagnostic);
    if (const auto at = text.find("error:"); colourful() && at != std::string::npos)
      text.replace(at, 6, "\033[1;31merror:\033[0m");
    say(text);
  }
}

Progress::Progress(std::string name, std::uint64_t total, std::string unit)
    : name_(std::move(name)), total_(total), unit_(std::move(unit)) {}

Progress::~Progress() {
  if (shown_ && animated()) fmt::print(stderr, "\r\033[K");
}

void Progress::done(std::uint64_t count) {
  count_ = count;
  const double rate = static_cast<double>(count_) / watch_.seconds();
  const double left = rate > 0 ? static_cast<double>(total_ - count_) / rate : 0;
  tell(fmt::format("{} of {} {}, {:.0f} a second, {:.1f} s left", count_, total_, unit_, rate,
                   left));
}

void Progress::tell(const std::string& words) {
  const double now = watch_.seconds();
  if (now - last_shown_ < (animated() ? kRedraw : kPlainLine)) return;
  last_shown_ = now;
  const std::string line = fmt::format("{}: {}", name_, words);
  if (animated())
    fmt::print(stderr, "\r{}\033[K", line);
  else
    say(line);
  std::fflush(stderr);
  shown_ = true;
}

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = [](int) { ask_to_stop(); };
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  // A closed pipe and a file that may not grow are failed writes like any other.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() { return stop_asked(); }

}  // namespace lantern
