// The options of a command as a table: what reads the command line, its help, manual pages and
// completions are told the same rows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace lantern {

// Where the value of an option goes; its type says what may stand there. A vector takes several, an
// optional tells whether the option was given, a function is called while the line is read: without
// a value, or with a word, of which it gives what is wrong, if anything is.
using OptionTarget =
    std::variant<bool*, std::string*, int*, double*, std::uint64_t*, std::optional<int>*,
                 std::optional<double>*, std::optional<std::uint64_t>*, std::vector<std::string>*,
                 std::vector<int>*, std::vector<double>*, std::vector<std::uint64_t>*, void (*)(),
                 std::optional<std::string> (*)(const std::string&)>;

// What it takes: the type of a number, or of each of several.
template <class T>
struct TakenBy {
  using Type = T;
};
template <class T>
struct TakenBy<std::optional<T>> : TakenBy<T> {};
template <class T>
struct TakenBy<std::vector<T>> : TakenBy<T> {};

using Words = std::vector<std::string>;

// What else may be said of an option.
struct OptionTraits {
  const char* value = "";      // what stands for its value, "PATH"; empty: its type
  Words words = {};            // one of these, and nothing else
  double least = 0, most = 0;  // if that is not the same: within these
  bool above_0 = false;
  bool required = false;
  bool one_each = false;     // of several values each has the option's name before it
  bool* given = nullptr;     // becomes true if it is given
  const char* without = "";  // options above it, "--set,--count", that must not be given beside it
};

// A row of a command's options.
struct Option {
  const char* names;  // "-o,--output"; "FILE" stands by itself; "!--no-peers" makes false
  OptionTarget to;
  const char* help;  // in a line; what it is by default is told with it if `to` has any
  OptionTraits is = {};
};
using Options = std::vector<Option>;

inline Option seed_option(const char* help, std::uint64_t& seed) {
  return {"--seed", &seed, help, {.value = "S", .most = 0x1p53}};
}

}  // namespace lantern
