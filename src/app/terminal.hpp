// Messages to a person, on standard error. None of them throws: one that cannot be said is lost,
// and the work goes on. Whatever stands in them, a terminal gets printable text
// (base/printable.hpp). What is in the way or was surely not meant is kept, too, for the program
// that reads a command's JSON.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace lantern {
class JsonWriter;
}

namespace lantern::app {

// With --quiet nothing is said but errors and warnings, and no progress is shown.
void be_quiet() noexcept;
bool is_quiet() noexcept;

// When words have colour: as NO_COLOR, CLICOLOR_FORCE and the terminal want it, or as told.
enum class ColourMode { automatic, always, never };
void set_colour(ColourMode mode) noexcept;

// Standard error is a terminal that a person looks at: progress is drawn in place.
bool animated();

void say(std::string_view message) noexcept;         // a line, unless quiet
void warn(std::string_view message) noexcept;        // a line "lantern: warning: ..."
void complain(std::string_view message) noexcept;    // a line "lantern: error: ..."
void complain(const BackendError& error) noexcept;   // the same, and a line a backend
void complain(const ScenarioError& error) noexcept;  // each of its diagnostics
void complain(const std::vector<Diagnostic>& diagnostics) noexcept;  // errors and warnings

// From here on errors are added to these lines, too; null for no more.
void hear_errors(std::string* lines) noexcept;

// Lines for a person on standard output, printable, too. Throws IoError as write_stdout does.
void print(std::string_view text);

// Columns of text: rows of equally many cells, each a printable line, padded to columns.
std::string table(std::vector<std::vector<std::string>> rows);

// Letters in a line of standard output, if it is a terminal.
std::optional<std::size_t> terminal_width();

// What a bad word on the command line gets. Exit code 2.
class UsageError : public Told<std::runtime_error> {
 public:
  using Told::Told;
};

// One line below all messages, rewritten in place and taken away again. Only on a terminal:
// elsewhere nothing happens. Messages and this may come from several threads.
void show_status(std::string_view line) noexcept;
void clear_status() noexcept;

// ---- What a command answers a program that said --json: one JSON object on standard output,
// whatever happens. Its first member is `format`, "lantern.check/1"; then comes what the command
// found, as far as it came; then `diagnostics`, all errors and warnings, and `exit_code`. Every
// member is told of in scenarios/JSON.md.

// Begins an object with the format of version 1 of a command ("check", "bench.step").
JsonWriter answer_of(std::string_view command);

// What the command found: a whole JSON object whose first member is `format`. It is kept until the
// exit code is known; a later one replaces it.
void answer(std::string object);

// From here on an answer is owed, of this command if it never gives one of its own. Errors and
// warnings are kept as they are told, and room for the words that there is no memory.
void owe_answer(std::string_view command);
// Standard output is for something else, such as help.
void owe_no_answer() noexcept;

// Writes what is owed, if anything is, and owes nothing any more. Throws as write_stdout does.
void write_answer(int exit_code);
// The same when there is no memory: only that there was none. Needs none; throws nothing.
void write_answer_without_memory() noexcept;

}  // namespace lantern::app
