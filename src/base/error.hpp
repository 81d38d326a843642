// The kinds of error that Lantern keeps apart. A broken invariant is the fourth: see check.hpp.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "rooms.hpp"

namespace lantern {

// A place in a text file. Lines and columns count from 1; 0 means "the file as a whole".
struct SourcePosition {
  std::string file;
  int line = 0;
  int column = 0;
};

// An error is in the way; a warning is about what is allowed and surely not meant.
enum class Severity { error, warning };

// One mistake in a user's file, with what is needed to mend it.
struct Diagnostic {
  SourcePosition where;
  std::string message;      // "unknown key 'capcity'"
  std::string source_line;  // the offending line as written; may be empty
  std::string suggestion;   // "did you mean 'capacity'?"; may be empty
  Severity severity = Severity::error;
};

// "error:", "warning:"
std::string_view to_string(Severity severity);

// `file:line:column: error: message`, or `warning:`, the line, a caret under the column, and the
// suggestion. All of them printable (see printable.hpp); only the line breaks between them are
// left.
std::string to_string(const Diagnostic& diagnostic);

// Diagnostics that may be very many: the first are told, all are counted.
class Diagnostics {
 public:
  explicit Diagnostics(std::size_t most_told = 10) : most_(most_told) {}
  // `make` gives one, and is asked only for those that are told.
  template <class Make>
  void add(Make&& make) {
    if (told_.size() < most_) told_.push_back(make());
    ++count_;
  }
  void add_all(const Diagnostics& others);

  bool empty() const { return count_ == 0; }
  std::size_t count() const { return count_; }
  const std::vector<Diagnostic>& told() const { return told_; }
  // Then one of the file as a whole, "7 more <others>", if there are more.
  std::vector<Diagnostic> list(std::string_view others) const;

 private:
  std::size_t most_, count_ = 0;
  std::vector<Diagnostic> told_;
};

// The user's scenario is wrong: every mistake found in one pass. Exit code 3.
class ScenarioError : public std::runtime_error {
 public:
  explicit ScenarioError(std::vector<Diagnostic> diagnostics);
  explicit ScenarioError(Diagnostic diagnostic);
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

// A structure that the program was given (spatial/own_structure.hpp) cannot be used: the scenario
// is right, and says where it happened. Exit code 1.
class BrokenStructure : public ScenarioError {
 public:
  using ScenarioError::ScenarioError;
};

// An error whose message is a text, or a format and what fills it.
template <class Kind>
class Told : public Kind {
 public:
  explicit Told(const std::string& message) : Kind(message) {}
  template <class First, class... Rest>
  Told(fmt::format_string<First, Rest...> format, First&& first, Rest&&... rest)
      : Kind(fmt::format(format, std::forward<First>(first), std::forward<Rest>(rest)...)) {}
};

// A value that an engine room refuses where it enters (NaN, negative size, more than a stated
// budget). The message names the object and the field; whoever was called is left as it was,
// unless it says otherwise. The scenario room turns it into a ScenarioError with a position.
class Refused : public Told<std::invalid_argument> {
 public:
  using Told::Told;
};

// A file or stream could not be read or written. Exit code 1.
class IoError : public Told<std::runtime_error> {
 public:
  using Told::Told;
};

// Whoever read standard output has seen enough (`| head`). Exit code 1 without a word, as for any
// program that such a pipe stops.
class ReaderGone : public IoError {
 public:
  using IoError::IoError;
};

// No graphics backend could be started. Exit code 4.
class BackendError : public Told<std::runtime_error> {
 public:
  using Told::Told;
};

}  // namespace lantern
