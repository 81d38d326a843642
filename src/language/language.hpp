// The scenario language as one table of its tables: every key with its type, range, default, what
// it means and what it fills. The parser checks and reads by it; the JSON Schema and the reference
// page are printed from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "language/text/problems.hpp"

namespace lantern::language {

// Bounds on a scenario as a whole; what a single key may hold is in the tables.
inline constexpr std::size_t kMostFileBytes = std::size_t{4} << 20;
inline constexpr std::size_t kMostBodies = 20'000;
inline constexpr std::size_t kMostTextures = 20'000;
inline constexpr std::size_t kMostSteps = 10'000;
inline constexpr std::size_t kMostNamed = 1'000'000;         // bodies and textures, over all steps
inline constexpr std::uint64_t kMostScriptFrames = 100'000;  // in step pace
inline constexpr std::uint64_t kMostWorldSteps = 1'000'000;  // over all steps of the script
inline constexpr std::size_t kMostLinks = 20'000;            // springs and joints
inline constexpr std::size_t kMostWalls = 2'000;             // of a level
inline constexpr std::size_t kMostPrototypes = 1'000;
inline constexpr double kMostInOrder = 9'999;     // scenarios of a lecture
inline constexpr std::size_t kMostCaption = 180;  // letters
inline constexpr std::size_t kMostNotesText = 2000;
inline constexpr std::size_t kMostSides = 4;
inline constexpr std::size_t kMostHeadline = 3;   // counts and measures
inline constexpr std::size_t kMostRulers = 8;     // of a step
inline constexpr std::size_t kMostElements = 48;  // of a screen
inline constexpr std::size_t kMostWays = 4;       // in which a script draws it

enum class KeyType {
  text,            // on one line; `least` to `most` letters
  whole,           // a whole number; always has a range
  number,          // whole or with a fraction
  truth,           // true or false
  choice,          // one of `choices`
  point,           // [x, y] or [x, y, z], as many as the world has dimensions, within the range
  two_numbers,     // a list of two numbers, written as `form`
  size,            // [width, height], whole numbers; always has a range
  texts,           // a list of texts, at least one
  names,           // a list of texts, which may be empty
  loops,           // closed polygons: lists of three or more [x, y]
  whole_or_names,  // a whole number, or a list of texts, at least one
  choices_list,    // a list of `choices`, at least one, each once
  lines,           // a text of one or more lines
  turn,            // a number, called `of`, or a table of it and the axis that it goes about
  table,           // the table `of`
  tables,          // many of the table `of`; `most` of them
  part,            // some keys of the table `of`
  name_pairs,      // a list of pairs of names
  name_wholes,     // a table from names to whole numbers
  name_numbers,    // a table from names to numbers
  name_points,     // a table from names to points
  name_texts,      // a table from letters to names
};

// Which letters a name may have. Groups of letters are written as between the brackets of a regular
// expression: "a-z0-9_".
struct NamePattern {
  std::string_view first;         // what it may begin with
  std::string_view rest;          // and what may follow
  std::size_t most = 1;           // letters
  std::string_view words;         // the same for people
  std::string_view example = {};  // in place of one made of what was written
  std::string_view more = {};     // to be said behind that

  // The same as a regular expression, for the JSON Schema.
  std::string expression() const;
};

// Does the whole text match?
bool matches(std::string_view text, const NamePattern& pattern);

// A name that matches and looks like `text`: small letters where large ones are not allowed, '_'
// for what else is not.
std::string legal_name(std::string_view text, const NamePattern& pattern);

// Whether a hand may change a key's value on a live page, and between which ends.
struct ByHand {
  bool may = false;
  double least = 0, most = 0;  // of a number, in the file's unit
  bool of_world = false;       // these are parts of the world's shortest side
};

struct KeyDoc {
  std::string_view key;
  KeyType type = KeyType::text;
  std::string_view doc = {};  // one sentence or two
  bool required = false;
  std::string fallback = {};        // the default as TOML, and JSON, writes it
  std::string_view otherwise = {};  // the default in words, where it depends on other things
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above_least = false;   // `least` itself is not allowed
  bool may_be_empty = false;  // of a list
  std::string_view unit = {};
  double scale = 1;                            // from the file's unit to the program's
  std::vector<std::string_view> choices = {};  // of a whole number, what 1, 2, … are called
  std::optional<NamePattern> pattern = {};     // of a text
  std::string_view of = {};
  std::string_view form = {};    // of two numbers: "[x, y]"
  std::string_view advice = {};  // to who writes a choice that is not known, nor like one
  ByHand by_hand = {};
  std::string at_first = {};  // of a key by hand, if nothing is written, as TOML

  // Writes a good value, times the scale, into the member that the key is bound to, `offset` bytes
  // into an `owner`. A key without an owner is read by the reader of its table.
  const std::type_info* owner = nullptr;
  std::size_t offset = 0;
  void (*fill)(const TomlValue& value, const KeyDoc& key, void* member) = nullptr;
};

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

// Of several groups of keys, exactly one must be given, or at least one.
struct KeyGroups {
  std::vector<std::vector<std::string_view>> groups = {};
  bool exactly_one = true;
};

struct TableDoc {
  std::string_view name = {};  // "world", "structure.planes"; of the file's own keys ""
  std::string heading = {};    // "[world]", "[[body]]", "do = \"insert\""
  std::string_view doc = {};
  std::vector<KeyDoc> keys = {};
  KeyGroups groups = {};
  bool by_side = false;           // it may hold one of its own for each side, by the side's name
  std::string_view example = {};  // of a verb: steps that may follow the reference page's scenario

  const KeyDoc* find(std::string_view key) const;
};

// All tables but the verbs, in the order of the reference page; the file's own keys first.
std::span<const TableDoc> language_tables();

// The table of that name, which must exist.
const TableDoc& language_table(std::string_view name);

// One table a verb of the script: `name` is the verb; its own keys, then those of every step.
std::span<const TableDoc> language_verbs();

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
