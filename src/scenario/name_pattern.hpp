// Which letters a name may have.
#pragma once

#include <string>
#include <string_view>

namespace lantern {

// A regular expression in little, which a JSON Schema understands as well: a ^, then groups of
// letters in [ ], each of which may be followed by {least,most}, then a $.
struct NamePattern {
  std::string_view expression;
  std::string_view words;  // the same for people
};

// Does the whole text match?
bool matches(std::string_view text, const NamePattern& pattern);

// A name that matches and looks like `text`: small letters where large ones are not allowed, '_'
// for what else is not.
std::string legal_name(std::string_view text, const NamePattern& pattern);

}  // namespace lantern
