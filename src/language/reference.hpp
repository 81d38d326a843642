// The scenario language, printed from its one table.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lantern::language {

// A JSON Schema, draft 2020-12, for editors and other checkers: what it refuses, the parser
// refuses, too. Names, places in the script and sums are left to the parser.
std::string json_schema();

// The reference page, Markdown.
std::string reference_page();

// The scenarios that the page begins with; the examples of the verbs go on from them.
std::string_view world_example();
std::string_view atlas_example();
std::string_view level_example();

// Scenarios that show what a table of keys cannot.
std::string_view map_example();
std::string_view chart_example();
std::string_view collisions_example();
std::string looks_example();
std::string pattern_example(std::string_view arrange);
std::vector<std::string_view> arrange_names();

// A picture of the page: the last frame of a scenario whose every part stands on it.
struct ExamplePicture {
  std::string name;  // of the file reference/<name>.png
  std::string text;
};
std::vector<ExamplePicture> example_pictures();
bool verb_has_picture(std::string_view verb);

}  // namespace lantern::language
