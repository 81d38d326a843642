#include "app/terminal.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "app/commands/command.hpp"
#include "base/check.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "base/printable.hpp"

namespace lantern::app {
namespace {

constexpr std::string_view kClear = "\r\033[K";  // the line that the cursor is in

std::mutex writing;  // who holds it may write to standard error
bool status_shown = false;
bool keeps = false;
std::string* heard = nullptr;
std::vector<Diagnostic> kept;

std::atomic<bool> quiet{false};
std::atomic<ColourMode> colour{ColourMode::automatic};

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

// Do messages have colour? Told nothing: not if NO_COLOR is set, surely if CLICOLOR_FORCE is set to
// anything but 0, and otherwise if standard error is a terminal. See no-color.org and
// bixense.com/clicolors; an empty variable counts as none.
bool colourful() {
  if (colour != ColourMode::automatic) return colour == ColourMode::always;
  if (is_set("NO_COLOR")) return false;
  if (is_set("CLICOLOR_FORCE") && std::string_view(std::getenv("CLICOLOR_FORCE")) != "0")
    return true;
  return animated();
}

void keep(const Diagnostic& diagnostic) noexcept try {
  const std::lock_guard guard(writing);
  if (keeps) kept.push_back(diagnostic);
  if (heard && diagnostic.severity == Severity::error) *heard += to_string(diagnostic) + '\n';
} catch (const std::exception&) {  // no room for it: it is still said
}

// What there is no memory to say, or nobody to hear, is lost: the work goes on.
void write_line(const auto& make_text) noexcept {
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

// Keeps it, and says it with its severity before it.
void tell_and_keep(Severity severity, std::string_view message,
                   std::string (*made_printable)(std::string_view) = printable) noexcept {
  try {
    keep({{}, std::string(message), "", "", severity});
  } catch (const std::exception&) {
  }
  write_line(
      [&] { return fmt::format("lantern: {} {}", coloured(severity), made_printable(message)); });
}

bool owed = false;
std::string given;       // by the command, or an object with nothing but the format
std::string last_words;  // whole, made while there is memory

template <class Value>
void write_or_null(JsonWriter& json, const char* key, const Value& value) {
  json.member(key, value == Value() ? std::nullopt : std::optional(value));
}

// Every member in any case, null where there is nothing to say.
void write(JsonWriter& json, const Diagnostic& d) {
  json.line().begin_object();
  json.member("severity", d.severity == Severity::error ? "error" : "warning");
  write_or_null(json, "file", d.where.file);
  write_or_null(json, "line", d.where.line);
  write_or_null(json, "column", d.where.column);
  json.member("message", d.message);
  write_or_null(json, "source_line", d.source_line);
  write_or_null(json, "suggestion", d.suggestion);
  json.end_object();
}

// The object with the members that it ends with.
std::string ended(std::string object, const std::vector<Diagnostic>& diagnostics, int exit_code) {
  const std::size_t end = object.find_last_of('}');
  LANTERN_CHECK(end, !=, std::string::npos);
  object.resize(object.find_last_not_of(" \n", end - 1) + 1);
  JsonWriter json;
  json.begin_object().line().key("diagnostics").begin_array();
  for (const Diagnostic& d : diagnostics) write(json, d);
  if (!diagnostics.empty()) json.line();
  json.end_array().line().member("exit_code", exit_code).line().end_object();
  return object + "," + json.text().substr(1) + "\n";
}

}  // namespace

bool animated() { return ::isatty(STDERR_FILENO) == 1; }

void be_quiet() noexcept { quiet = true; }
bool is_quiet() noexcept { return quiet; }

void set_colour(ColourMode mode) noexcept { colour = mode; }

void say(std::string_view message) noexcept {
  if (!quiet) write_line([&] { return printable(message); });
}

void warn(std::string_view message) noexcept { tell_and_keep(Severity::warning, message); }
void complain(std::string_view message) noexcept { tell_and_keep(Severity::error, message); }
void complain(const BackendError& error) noexcept {
  tell_and_keep(Severity::error, error.what(), printable_lines);
}
void complain(const ScenarioError& error) noexcept { complain(error.diagnostics()); }

void hear_errors(std::string* lines) noexcept {
  const std::lock_guard guard(writing);
  heard = lines;
}

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

std::optional<std::size_t> terminal_width() {
  winsize size{};
  if (::isatty(STDOUT_FILENO) != 1) return std::nullopt;
  const bool told = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return told ? size.ws_col : 80;
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

// ---- What a program is answered

JsonWriter answer_of(std::string_view command) {
  JsonWriter json;
  json.begin_object().line().member("format", fmt::format("lantern.{}/1", command));
  return json;
}

void answer(std::string object) { given = std::move(object); }

void owe_answer(std::string_view command) {
  given = answer_of(command).end_object().text();
  Diagnostic no_memory;
  no_memory.message = "out of memory";
  last_words = ended(given, {no_memory}, kFailed);
  owed = true;
  const std::lock_guard guard(writing);
  keeps = true;
}

void owe_no_answer() noexcept { owed = false; }

void write_answer(int exit_code) {
  const bool is_told = exit_code != 0;
  if (!owed || (output_is_input() && is_told)) return;
  std::unique_lock guard(writing);
  const std::string text = ended(given, kept, exit_code);
  guard.unlock();
  owed = false;
  write_stdout(text);
}

void write_answer_without_memory() noexcept {
  if (!std::exchange(owed, false)) return;
  try {
    write_stdout(last_words);
  } catch (const std::exception&) {  // it has been told that there is no memory
  }
}

}  // namespace lantern::app
