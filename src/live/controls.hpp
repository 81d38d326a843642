// What a hand may change of a scene, and what may be written at a place of its text: both made from
// the language's own table.
#pragma once

#include <string>
#include <string_view>

#include "language/scenario.hpp"
#include "rooms.hpp"

namespace lantern::live {

// JSON: {"controls": [{"path", "table", "key", "means", "type", "least", "most", "step", "choices",
// "unit", "value", "written"}…]}, at most twelve. `value` is what is written, or else the default;
// a point's `least` and `most` are of each of its numbers. Each choice and both ends were tried:
// the text with that value in place of its own is a scenario. `text` is that of the scenario.
std::string controls_json(std::string_view text, const language::Scenario& scenario);

// JSON: {"from": 3, "words": [{"word", "means"}…]}: what may stand from that column on, up to the
// column that is asked for. The text may be wrong there and everywhere else.
std::string complete_json(std::string_view text, int line, int column);

}  // namespace lantern::live
