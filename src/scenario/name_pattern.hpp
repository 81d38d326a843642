// Which letters a name may have.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lantern {

// Groups of letters are written as between the brackets of a regular expression: "a-z0-9_".
struct NamePattern {
  std::string_view first;  // what it may begin with
  std::string_view rest;   // and what may follow
  std::size_t most = 1;    // letters
  std::string_view words;  // the same for people

  // The same as a regular expression, for the JSON Schema.
  std::string expression() const;
};

// Does the whole text match?
bool matches(std::string_view text, const NamePattern& pattern);

// A name that matches and looks like `text`: small letters where large ones are not allowed, '_'
// for what else is not.
std::string legal_name(std::string_view text, const NamePattern& pattern);

}  // namespace lantern
