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

// A scenario of src/language/examples/: the page begins with `world`, `atlas` and `level`; others
// show what a table of keys cannot. Below "#: verb" stands there how the verb's example goes on.
std::string_view example(std::string_view name);
std::string_view example_of_verb(std::string_view verb);
// The whole of what a verb's example goes on from, and itself.
std::string example_up_to(std::string_view verb);

// A picture of the page: the last frame of a scenario whose every part stands on it.
struct ExamplePicture {
  std::string name;  // of the file reference/<name>.png
  std::string text;
};
std::vector<ExamplePicture> example_pictures();

}  // namespace lantern::language
