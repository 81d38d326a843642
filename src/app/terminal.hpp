// Messages to a person, on standard error. None of them throws: one that cannot be said is lost,
// and the work goes on. Whatever stands in them, a terminal gets printable text
// (base/printable.hpp).
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "app/interrupts.hpp"
#include "base/clock.hpp"
#include "base/error.hpp"

namespace lantern {

// Standard error is a terminal, and NO_COLOR is not set.
bool colourful();
// Standard error is a terminal.
bool animated();

void say(std::string_view message) noexcept;         // a line
void complain(std::string_view message) noexcept;    // a line "lantern: error: ..."
void complain(const BackendError& error) noexcept;   // the same, and a line for each backend
void complain(const ScenarioError& error) noexcept;  // each of its diagnostics

// Lines for a person on standard output, printable, too. Throws IoError as write_stdout does.
void print(std::string_view text);

// What a bad word on the command line gets. Exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// "7 of 70 frames, 212 a second, 0.3 s left": one line that is rewritten on a terminal; elsewhere a
// plain line every few seconds of long work.
class Progress {
 public:
  Progress(std::string name, std::uint64_t total, std::string unit = "frames");
  ~Progress();
  void done(std::uint64_t count);
  // The same in other words, for work whose parts are not equally long.
  void tell(const std::string& line);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

 private:
  std::string name_;
  std::uint64_t total_;
  std::string unit_;
  std::uint64_t count_ = 0;
  double last_shown_ = 0;
  bool shown_ = false;
  Stopwatch watch_;
};

}  // namespace lantern
