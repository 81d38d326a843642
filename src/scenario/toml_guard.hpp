// What must not be given to toml++ 3.3, which takes well-formed brackets and headers for granted in
// a few places and has no bound on some of its work.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lantern {

struct GuardFinding {
  std::size_t offset = 0;  // in bytes
  std::string message;
};

// The first of these in a text of valid UTF-8, if there is one:
//   a key of very many parts, each of which is a table in a table, torn down by recursion
//   very many dotted keys, whose tables are searched one after another
//   a [header] that does not begin with a name, a '}' in a list that is not closed
//   a letter beyond ASCII that is in no text and no comment
// A text in which nothing is found may still be no TOML; toml++ says so.
std::optional<GuardFinding> harm_in(std::string_view text);

}  // namespace lantern
