#include "app/terminal.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <mutex>

#include <fmt/format.h>
#include <unistd.h>

#include "base/file.hpp"
#include "base/printable.hpp"

namespace lantern::app {
namespace {

constexpr std::string_view kClear = "\r\033[K";  // the line that the cursor is in

std::mutex writing;  // who holds it may write to standard error
bool status_shown = false;
bool keeps = false;
std::vector<Diagnostic> kept;

std::atomic<bool> quiet{false};
std::atomic<ColourMode> colour{ColourMode::automatic};

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

void keep(const Diagnostic& diagnostic) noexcept try {
  const std::lock_guard guard(writing);
  if (keeps) kept.push_back(diagnostic);
} catch (const std::exception&) {  // no room for it: it is still said
}

void keep(Severity severity, std::string_view message) noexcept try {
  Diagnostic diagnostic;
  diagnostic.message = message;
  diagnostic.severity = severity;
  keep(diagnostic);
} catch (const std::exception&) {
}

// What there is no memory to say, or nobody to hear, is lost: the work goes on.
template <class Make>
void write_line(const Make& make_text) noexcept {
  try {
    const std::string text = make_text() + '\n';
    const std::lock_guard guard(writing);
    if (status_shown) write_stderr(kClear);
    status_shown = false;
    write_stderr(text);
  } catch (const std::exception&) {
  }
}

// The word in the colour of its severity.
std::string coloured(Severity severity) {
  const std::string_view word = to_string(severity);
  if (!colourful()) return std::string(word);
  return fmt::format("\033[1;{}m{}\033[0m", severity == Severity::error ? 31 : 33, word);
}

std::string with_prefix(Severity severity, std::string_view printable_text) {
  return fmt::format("lantern: {} {}", coloured(severity), printable_text);
}

}  // namespace

bool animated() { return ::isatty(STDERR_FILENO) == 1; }

void be_quiet() noexcept { quiet = true; }
bool is_quiet() noexcept { return quiet; }

void set_colour(ColourMode mode) noexcept { colour = mode; }

bool colourful() {
  if (colour != ColourMode::automatic) return colour == ColourMode::always;
  if (is_set("NO_COLOR")) return false;
  if (is_set("CLICOLOR_FORCE") && std::string_view(std::getenv("CLICOLOR_FORCE")) != "0")
    return true;
  return animated();
}

void say(std::string_view message) noexcept {
  if (!quiet) write_line([&] { return printable(message); });
}

void warn(std::string_view message) noexcept {
  keep(Severity::warning, message);
  write_line([&] { return with_prefix(Severity::warning, printable(message)); });
}

void complain(std::string_view message) noexcept {
  keep(Severity::error, message);
  write_line([&] { return with_prefix(Severity::error, printable(message)); });
}

void complain(const BackendError& error) noexcept {
  keep(Severity::error, error.what());
  write_line([&] { return with_prefix(Severity::error, printable_lines(error.what())); });
}

void complain(const ScenarioError& error) noexcept { complain(error.diagnostics()); }

void complain(const std::vector<Diagnostic>& diagnostics) noexcept {
  for (const Diagnostic& diagnostic : diagnostics) {
    keep(diagnostic);
    write_line([&] {
      std::string text = to_string(diagnostic);
      const std::string_view word = to_string(diagnostic.severity);
      if (const auto at = text.find(word); at != std::string::npos)
        text.replace(at, word.size(), coloured(diagnostic.severity));
      return text;
    });
  }
}

void keep_diagnostics() noexcept {
  const std::lock_guard guard(writing);
  keeps = true;
}

std::vector<Diagnostic> kept_diagnostics() {
  const std::lock_guard guard(writing);
  return kept;
}

void print(std::string_view text) { write_stdout(printable_lines(text)); }

std::string table(std::vector<std::vector<std::string>> rows) {
  std::vector<std::size_t> widths;
  for (auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i] = printable(row[i]);
      widths[i] = std::max(widths[i], letters(row[i]));
    }
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i)
      text += row[i] + (i + 1 < row.size() ? std::string(widths[i] - letters(row[i]) + 2, ' ')
                                           : std::string());
    text += '\n';
  }
  return text;
}

void show_status(std::string_view line) noexcept {
  if (quiet || !animated()) return;
  try {
    const std::string text = fmt::format("\r{}\033[K", printable(line));
    const std::lock_guard guard(writing);
    write_stderr(text);
    status_shown = true;
  } catch (const std::exception&) {
  }
}

void clear_status() noexcept {
  const std::lock_guard guard(writing);
  if (status_shown) write_stderr(kClear);
  status_shown = false;
}

}  // namespace lantern::app
