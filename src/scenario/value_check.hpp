// Does one value fit its key of the language?
#pragma once

#include "scenario/language.hpp"
#include "scenario/problems.hpp"
#include "scenario/toml_tree.hpp"

namespace lantern {

// Adds a problem for each thing that is wrong with the value; true if there was none. What is in a
// table of its own (KeyType::table and tables) is left to that table's reader. `dimension` is the
// world's, 0 where it is not known.
bool check_value(const TomlValue& value, const KeyDoc& doc, int dimension, Problems& problems);

// How the reference calls a type, and a value of it; of some types the value depends on the key.
struct TypeWords {
  std::string_view name;
  std::string_view example;
};
const TypeWords& words_of(KeyType type);

// How a key is written: "position = [1.5, 2]".
std::string form_of(const KeyDoc& key, int dimension);

// "0 to 32", "above 0, at most 1000"; empty if the key has no range.
std::string range_text(const KeyDoc& doc);

}  // namespace lantern
