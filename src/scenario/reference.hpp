// The scenario language, printed from its one table.
#pragma once

#include <string>
#include <string_view>

namespace lantern::scenario {

// A JSON Schema, draft 2020-12, for editors and other checkers: what it refuses, the parser
// refuses, too. Names, places in the script and sums are left to the parser.
std::string json_schema();

// The reference page, Markdown.
std::string reference_page();

// The scenarios that the page begins with; the examples of the verbs go on from them.
std::string_view world_example();
std::string_view atlas_example();
std::string_view level_example();

}  // namespace lantern::scenario
