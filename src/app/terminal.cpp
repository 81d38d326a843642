#include "app/terminal.hpp"

#include <cstdlib>

#include <fmt/format.h>
#include <unistd.h>

#include "base/file.hpp"
#include "base/printable.hpp"

namespace lantern {
namespace {

constexpr double kRedraw = 0.1;     // seconds between two drawings on a terminal
constexpr double kPlainLine = 5.0;  // and between two plain lines elsewhere

constexpr std::string_view kError = "error:";

std::string_view error_word() { return colourful() ? "\033[1;31merror:\033[0m" : kError; }

// What there is no memory to say, or nobody to hear, is lost: the work goes on.
template <class Make>
void write(const Make& make_text) noexcept {
  try {
    write_stderr(make_text());
  } catch (const std::exception&) {
  }
}

}  // namespace

bool animated() { return ::isatty(STDERR_FILENO) == 1; }

bool colourful() {
  const char* no_color = std::getenv("NO_COLOR");
  return animated() && (no_color == nullptr || *no_color == '\0');
}

void say(std::string_view message) noexcept {
  write([&] { return printable(message) + '\n'; });
}

void complain(std::string_view message) noexcept {
  write([&] { return fmt::format("lantern: {} {}\n", error_word(), printable(message)); });
}

void complain(const BackendError& error) noexcept {
  write(
      [&] { return fmt::format("lantern: {} {}\n", error_word(), printable_lines(error.what())); });
}

void complain(const ScenarioError& error) noexcept {
  for (const Diagnostic& diagnostic : error.diagnostics())
    write([&] {
      std::string text = to_string(diagnostic) + '\n';
      const auto at = text.find(kError);
      return at == std::string::npos ? text : text.replace(at, kError.size(), error_word());
    });
}

void print(std::string_view text) { write_stdout(printable_lines(text)); }

Progress::Progress(std::string name, std::uint64_t total, std::string unit)
    : name_(std::move(name)), total_(total), unit_(std::move(unit)) {}

Progress::~Progress() {
  if (shown_ && animated()) write_stderr("\r\033[K");
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
    write([&] { return fmt::format("\r{}\033[K", printable(line)); });
  else
    say(line);
  shown_ = true;
}

}  // namespace lantern
