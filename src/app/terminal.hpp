// Messages to a person, on standard error. None of them throws: one that cannot be said is lost,
// and the work goes on. Whatever stands in them, a terminal gets printable text
// (base/printable.hpp).
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace lantern::app {

// Standard error is a terminal, and NO_COLOR is not set.
bool colourful();
// Standard error is a terminal.
bool animated();

void say(std::string_view message) noexcept;         // a line
void complain(std::string_view message) noexcept;    // a line "lantern: error: ..."
void complain(const BackendError& error) noexcept;   // the same, and a line a backend
void complain(const ScenarioError& error) noexcept;  // each of its diagnostics
void complain(const std::vector<Diagnostic>& diagnostics) noexcept;  // errors and warnings

// Lines for a person on standard output, printable, too. Throws IoError as write_stdout does.
void print(std::string_view text);

// Columns of text: rows of equally many cells, each a printable line, padded to columns.
std::string table(std::vector<std::vector<std::string>> rows);

// What a bad word on the command line gets. Exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// One line below all messages, rewritten in place and taken away again. Only on a terminal:
// elsewhere nothing happens. Messages and this may come from several threads.
void show_status(std::string_view line) noexcept;
void clear_status() noexcept;

}  // namespace lantern::app
