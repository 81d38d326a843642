#include "language/reference.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "language/counts.hpp"
#include "language/language.hpp"
#include "language/specs.hpp"

namespace lantern::language {
namespace {

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
  if (doc.type == KeyType::turn) text += fmt::format(" {{ {}, axis }}", doc.of);
  for (std::size_t i = 0; i < doc.choices.size() && doc.type != KeyType::whole; ++i)
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

std::string picture(std::string_view name) {
  return fmt::format("![{0}](reference/{0}.png)", name);
}

// One row of pictures, each under the choice that it shows.
std::string pictures(std::string_view prefix, const EnumNames& choices) {
  std::string names, rule, row;
  for (const std::string_view choice : choices) {
    names += fmt::format("| `{}` ", choice);
    rule += "|---";
    row += fmt::format("| {} ", picture(fmt::format("{}_{}", prefix, choice)));
  }
  return fmt::format("{}|\n{}|\n{}|\n", names, rule, row);
}

// What a table's rows cannot show.
std::string shown_of(const TableDoc& table) {
  if (table.name.empty())
    return "\nEach of the `panels` alone:\n\n" + pictures("panel", names(Panel()));
  if (table.name == "body")
    return fmt::format("\nThe looks:\n\n{}\n{}\n", block(looks_example()), picture("looks"));
  if (table.name == "pattern")
    return fmt::format("\nHow a pattern is arranged; only `arrange` differs:\n\n{}\n{}",
                       block(pattern_example(arrange_names().front())),
                       pictures("arrange", arrange_names()));
  if (table.name == "map") return fmt::format("\n{}\n{}\n", block(map_example()), picture("map"));
  if (table.name == "chart") return fmt::format("\n{}", block(chart_example()));
  return "";
}

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
  return fmt::format("\n### {}\n\n{}\n\n{}{}{}", heading(table), table.doc, rows(keys),
                     groups_text(table.groups), shown_of(table));
}

std::string verb_section(const TableDoc& verb) {
  const std::size_t common = language_table("step").keys.size();
  const auto own = std::span(verb.keys).first(verb.keys.size() - common);
  std::string text = fmt::format("\n### `{}`\n\n{}\n", verb.heading, verb.doc);
  if (!own.empty()) text += fmt::format("\n{}", rows(own));
  text += groups_text(verb.groups) + fmt::format("\n{}", block(verb.example));
  if (verb_has_picture(verb.name)) text += "\n" + picture("do_" + std::string(verb.name)) + "\n";
  return text;
}

std::string world_count_rows() {
  std::string text = "| count | meaning | counted |\n|---|---|---|\n";
  for (const CountDoc& count : known_counts())
    if (count.for_world())
      text += fmt::format("| `{}` | {} | {} |\n", count.name, count.doc, count.rule.when);
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
                     block(world_example()), block(atlas_example()), block(level_example()),
                     kMostFileBytes >> 20, kMostBodies, kMostTextures, kMostSteps);
}

}  // namespace

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
      "\n### Captions\n\nAt most {} letters. Placeholders are filled in with what the engine "
      "found.\n\n{}",
      kMostCaption, text_rows());
  page += "\n### Counts of a world\n\n" + world_count_rows();
  page +=
      "\n### Measures of one body\n\nWritten with the body's name, as `energy.bob`: in the chart, "
      "in `at_most` and `at_least`, and in captions.\n\n" +
      count_rows("measure", known_body_measures(), [](const CountDoc&) { return true; });
  page += "\n### Counts of an atlas\n\n" +
          count_rows("count", known_counts(), [](const CountDoc& doc) { return doc.for_atlas(); });
  return page;
}

}  // namespace lantern::language
