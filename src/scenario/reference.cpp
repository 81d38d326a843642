#include "scenario/reference.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenario/language.hpp"

namespace lantern::scenario {
namespace {

constexpr std::string_view kWorldExample = R"(title = "Three bodies, four cells"

[world]
size = [16, 9]
contacts = "impulse"
may_sleep = true

[structure]
kind = "quadtree"
capacity = 2

[[body]]
name = "red"
look = "ghost"
half_size = [0.8, 0.8]
position = [3, 6]

[[body]]
name = "pink"
look = "ghost"
color = 2
half_size = [0.8, 0.8]
position = [6, 7]

[[body]]
name = "player"
look = "player"
color = 3
radius = 0.8
position = [12, 2]

[[body]]
name = "blue"
look = "ghost"
color = 4
half_size = [0.8, 0.8]
position = [12, 7]

[[step]]
do = "insert"
bodies = ["red", "pink"]
caption = "Two bodies fit into the root: {pairs:pair} to test."
expect = { nodes = 1, pairs = 1 }

[[step]]
do = "insert"
bodies = ["player"]
caption = "The third overflows it. Still {pairs:pair}, where brute force tests {all_pairs}."
expect = { pairs = 1, all_pairs = 3, pairs_are = [["red", "pink"]] }
)";

constexpr std::string_view kAtlasExample = R"(title = "A small atlas"

[atlas]
size = [128, 128]

[[texture]]
name = "A"
size = [48, 80]

[[texture_pattern]]
name = "tile"
count = 3
min = [16, 16]
max = [32, 32]
multiple = 8

[[step]]
do = "show"
caption = "An empty atlas: {free_leaves:free leaf/free leaves} of {free_area} px."
expect = { free_leaves = 1, textures = 0 }
)";

constexpr std::string_view kLevelExample = R"(title = "A room with a pillar"

[world]
size = [12, 8]

[level]
loops = [
  [[1, 1], [11, 1], [11, 7], [1, 7]],
  [[5, 3], [5, 5], [7, 5], [7, 3]],
]

[[step]]
do = "compile"
caption = "{walls:wall}: four around the room, four around the pillar."
expect = { walls = 8 }
)";

// 1000000000 -> 1e9, 9007199254740992 -> 2^53
std::string short_number(double x) {
  if (x == 0x1p53) return "2^53";
  if (std::abs(x) < 1e6) return fmt::format("{}", x);
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(x))));
  return fmt::format("{}e{}", x / std::pow(10.0, exponent), exponent);
}

std::string short_range(const KeyDoc& doc) {
  if (doc.pattern) return std::string(doc.pattern->words);
  if (!std::isfinite(doc.most)) return "";
  if (doc.least == -doc.most) return std::string(doc.unit);  // said once for all coordinates
  if (doc.type == KeyType::tables) return "up to " + short_number(doc.most);
  std::string text = short_number(doc.most);
  if (std::isfinite(doc.least))
    text = doc.above_least ? fmt::format("above {}, to {}", short_number(doc.least), text)
                           : fmt::format("{} to {}", short_number(doc.least), text);
  if (doc.type == KeyType::text) text += " letters";
  return doc.unit.empty() ? text : fmt::format("{} {}", text, doc.unit);
}

std::string type_column(const KeyDoc& doc) {
  std::string text(doc.form.empty() ? words_of(doc.type).name : doc.form);
  if (doc.type == KeyType::part) text += fmt::format(" `[{}]`", doc.of);
  for (std::size_t i = 0; i < doc.choices.size(); ++i)
    text += fmt::format("{} `{}`", i == 0 ? "" : ",", doc.choices[i]);
  const std::string range = short_range(doc);
  return range.empty() ? text : fmt::format("{}, {}", text, range);
}

std::string default_column(const KeyDoc& doc) {
  if (doc.required) return "**required**";
  if (!doc.otherwise.empty()) return std::string(doc.otherwise);
  return doc.fallback.empty() || doc.fallback == "\"\"" ? "–" : fmt::format("`{}`", doc.fallback);
}

std::string rows(std::span<const KeyDoc> keys) {
  std::string text = "| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const KeyDoc& doc : keys)
    text += fmt::format("| `{}` | {} | {} | {} |\n", doc.key, type_column(doc), default_column(doc),
                        doc.doc);
  return text;
}

std::string groups_text(const KeyGroups& groups) {
  if (groups.groups.empty()) return "";
  std::string text;
  for (const auto& group : groups.groups) {
    text += text.empty() ? "" : " or ";
    for (std::size_t i = 0; i < group.size(); ++i)
      text += fmt::format("{}`{}`", i == 0 ? "" : " with ", group[i]);
  }
  return fmt::format("\nGive {} of {}.\n", groups.exactly_one ? "exactly one" : "at least one",
                     text);
}

std::string block(std::string_view toml) { return fmt::format("```toml\n{}```\n", toml); }

std::string heading(const TableDoc& table) {
  const bool is_code = !table.name.empty() && table.name != "expect";
  return is_code ? fmt::format("`{}`", table.heading) : std::string(table.heading);
}

std::string table_section(const TableDoc& table) {
  std::span<const KeyDoc> keys = table.keys;
  if (table.name == "expect") {  // counts have tables of their own
    const auto is_count = [](const KeyDoc& key) { return key.type == KeyType::whole; };
    keys = keys.first(
        static_cast<std::size_t>(std::find_if(keys.begin(), keys.end(), is_count) - keys.begin()));
  }
  return fmt::format("\n### {}\n\n{}\n\n{}{}", heading(table), table.doc, rows(keys),
                     groups_text(table.groups));
}

std::string verb_section(const TableDoc& verb) {
  const std::size_t common = language_table("step").keys.size();
  const auto own = std::span(verb.keys).first(verb.keys.size() - common);
  std::string text = fmt::format("\n### `{}`\n\n{}\n", verb.heading, verb.doc);
  if (!own.empty()) text += fmt::format("\n{}", rows(own));
  return text + groups_text(verb.groups) + fmt::format("\n{}", block(verb.example));
}

std::string world_count_rows() {
  std::string text = "| count | meaning | counted |\n|---|---|---|\n";
  for (const CountDoc& count : known_counts())
    if (count.for_world())
      text += fmt::format("| `{}` | {} | {} |\n", count.name, count.doc, when_counted(count.need));
  return text;
}

// A chart writes the unit on its axis.
std::string with_unit(const CountDoc& doc) {
  return std::string(doc.doc) + (doc.unit.empty() ? "" : fmt::format(" In {}.", doc.unit));
}

std::string count_rows(std::string_view what, std::span<const CountDoc> docs,
                       bool (*is_listed)(const CountDoc&)) {
  std::string text = fmt::format("| {} | meaning |\n|---|---|\n", what);
  for (const CountDoc& doc : docs)
    if (is_listed(doc)) text += fmt::format("| `{}` | {} |\n", doc.name, with_unit(doc));
  return text;
}

std::string text_rows() {
  std::string text = "| placeholder | stands for |\n|---|---|\n";
  text += "| `{pairs}` | a count: \"2\" |\n";
  text += "| `{pairs:pair}` | a count and its noun: \"1 pair\", \"2 pairs\" |\n";
  text += "| `{leaves:leaf/leaves}` | the same, with an irregular plural |\n";
  for (const CountDoc& doc : known_texts())
    text += fmt::format("| `{{{}}}` | {} |\n", doc.name, doc.doc);
  return text + "| `{{` and `}}` | the braces themselves |\n";
}

std::string introduction() {
  return fmt::format(R"(# The scenario language

A scenario is a [TOML](https://toml.io) file: it says what there is, what happens, and which counts
to expect. It is data, never code. This page is printed by `lantern reference`; editors that know JSON Schema can use
[scenario.schema.json](scenario.schema.json).

## In two minutes

{}
`lantern check` runs it and verifies every expectation; `lantern render` draws it. An atlas looks like this:

{}
And a level like this:

{}
The language is strict. A key that it does not know, a wrong type, a name that does not exist, a number out of range:
all mistakes in a file are reported at once, each with its line and column and, where one can be guessed, the word
you meant.

Lengths and positions are in units of your own, times in seconds, angles in degrees, textures in pixels; x goes to
the right, y up, and z towards the viewer. A point is `[x, y]` in a 2D world and `[x, y, z]` in a 3D one.
Coordinates are at most 1e9, either way. A file has at most {} MiB, {} bodies, {} textures and {} steps.

## What there is
)",
                     block(kWorldExample), block(kAtlasExample), block(kLevelExample),
                     kMostFileBytes >> 20, kMostBodies, kMostTextures, kMostSteps);
}

}  // namespace

std::string_view world_example() { return kWorldExample; }
std::string_view atlas_example() { return kAtlasExample; }
std::string_view level_example() { return kLevelExample; }

std::string reference_page() {
  std::string page = introduction();
  for (const TableDoc& table : language_tables())
    if (table.name != "step" && table.name != "expect") page += table_section(table);
  page += "\n## What happens\n";
  page += table_section(language_table("step"));
  page +=
      "\nA body is used as a script would: inserted before it is moved or removed, and not twice. "
      "Each example\nbelow goes on from the three scenarios above; append them in this order.\n";
  for (const TableDoc& verb : language_verbs()) page += verb_section(verb);
  page += "\n## What is expected and said\n";
  page += table_section(language_table("expect"));
  page += fmt::format(
      "\n### Captions\n\nAt most {} letters. Placeholders are filled in with what "
      "the engine found.\n\n{}",
      kMostCaption, text_rows());
  page += "\n### Counts of a world\n\n" + world_count_rows();
  page +=
      "\n### Measures of one body\n\nWritten with the body's name, as `energy.bob`: in the "
      "chart, in `at_most` and `at_least`, and in captions.\n\n" +
      count_rows("measure", known_body_measures(), [](const CountDoc&) { return true; });
  page += "\n### Counts of an atlas\n\n" +
          count_rows("count", known_counts(), [](const CountDoc& doc) { return doc.for_atlas(); });
  return page;
}

}  // namespace lantern::scenario
