// What a count or measure is called beside its number.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lantern::draw {

// "leaf" or "leaves", "node visited" or "nodes visited", "energy: bob"; `one` asks for the
// singular, which a measure does not have.
std::string count_words(std::string_view name, bool one);

}  // namespace lantern::draw
