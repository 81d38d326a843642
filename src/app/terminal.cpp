#include "app/terminal.hpp"

#include <algorithm>
#include <cstdlib>
#include <mutex>

#include <fmt/format.h>
#include <unistd.h>

#include "base/file.hpp"
#include "base/printable.hpp"
#include "base/utf8.hpp"

namespace lantern::app {
namespace {

constexpr std::string_view kClear = "\r\033[K";  // the line that the cursor is in

std::mutex writing;  // who holds it may write to standard error
bool status_shown = false;

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

std::string with_prefix(std::string_view printable_text) {
  return fmt::format("lantern: {} {}", coloured(Severity::error), printable_text);
}

}  // namespace

bool animated() { return ::isatty(STDERR_FILENO) == 1; }

bool colourful() {
  const char* no_color = std::getenv("NO_COLOR");
  return animated() && (no_color == nullptr || *no_color == '\0');
}

void say(std::string_view message) noexcept {
  write_line([&] { return printable(message); });
}

void complain(std::string_view message) noexcept {
  write_line([&] { return with_prefix(printable(message)); });
}

void complain(const BackendError& error) noexcept {
  write_line([&] { return with_prefix(printable_lines(error.what())); });
}

void complain(const ScenarioError& error) noexcept { complain(error.diagnostics()); }

void complain(const std::vector<Diagnostic>& diagnostics) noexcept {
  for (const Diagnostic& diagnostic : diagnostics)
    write_line([&] {
      std::string text = to_string(diagnostic);
      const std::string_view word = to_string(diagnostic.severity);
      if (const auto at = text.find(word); at != std::string::npos)
        text.replace(at, word.size(), coloured(diagnostic.severity));
      return text;
    });
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
  if (!animated()) return;
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
