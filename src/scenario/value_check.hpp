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

}  // namespace lantern
