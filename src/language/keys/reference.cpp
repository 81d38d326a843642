// What is printed of the language: the reference page with its examples, and the JSON Schema.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/check.hpp"
#include "embedded/examples.hpp"
#include "geometry/elementary.hpp"
#include "language/counts.hpp"
#include "language/language.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {
namespace {

// 1000000000 -> 1e9, 9007199254740992 -> 2^53
std::string short_number(double x) {
  if (x == 0x1p53) return "2^53";
  if (std::abs(x) < 1e6) return fmt::format("{}", x);
  const int exponent = static_cast<int>(std::floor(geometry::log10(std::abs(x))));
  return fmt::format("{}e{}", x / geometry::pow(10.0, exponent), exponent);
}

std::string short_range(const KeyDoc& doc) {
  if (doc.pattern) return std::string(doc.pattern->words);
  if (!std::isfinite(doc.most)) return "";
  if (doc.least == -doc.most) return std::string(doc.unit);  // said once for all coordinates
  if (doc.type == KeyType::tables || doc.may_be_empty) return "up to " + short_number(doc.most);
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

// The arrangements of a pattern, and one of them.
const std::vector<std::string_view>& arrangements() {
  return language_table("pattern").find("arrange")->choices;
}

std::string pattern_example(std::string_view arrange) {
  std::string text(example("pattern"));
  return text.replace(text.find(arrangements()[0]), arrangements()[0].size(), arrange);
}

// One row of pictures, each under the choice that it shows.
std::string pictures(std::string_view prefix, const std::vector<std::string_view>& choices) {
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
    return fmt::format("\nThe looks:\n\n{}\n{}\n", block(example("looks")), picture("looks"));
  if (table.name == "pattern")
    return fmt::format("\nHow a pattern is arranged; only `arrange` differs:\n\n{}\n{}",
                       block(example("pattern")), pictures("arrange", arrangements()));
  if (table.name == "map") return fmt::format("\n{}\n{}\n", block(example("map")), picture("map"));
  if (table.name == "chart") return fmt::format("\n{}", block(example("chart")));
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
    keys =
        keys.first(static_cast<std::size_t>(std::ranges::find_if(keys, is_count) - keys.begin()));
  }
  return fmt::format("\n### {}\n\n{}\n\n{}{}{}", heading(table), table.doc, rows(keys),
                     groups_text(table.groups), shown_of(table));
}

bool verb_has_picture(std::string_view verb) { return verb != "show"; }

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
                     block(example("world")), block(example("atlas")), block(example("level")),
                     kMostFileBytes >> 20, kMostBodies, kMostTextures, kMostSteps);
}

constexpr std::string_view kMark = "\n#: ";  // above a verb's example, with its name
std::string mark_of(std::string_view verb) { return fmt::format("{}{}\n", kMark, verb); }

std::string_view file_with(std::string_view mark) {
  for (const auto& [name, text] : examples::files())
    if (text.find(mark) != text.npos) return text;
  LANTERN_CHECK(mark, ==, "a verb's example");
  return {};
}

using Json = nlohmann::ordered_json;

// Whole numbers without a point.
Json json_number(double x) {
  if (std::trunc(x) == x && std::abs(x) <= 0x1p53) return static_cast<std::int64_t>(x);
  return x;
}

Json typed(const char* type) { return Json::object({{"type", type}}); }

// A number, of the key's range.
Json number_schema(const KeyDoc& doc, const char* type) {
  Json schema = typed(type);
  if (std::isfinite(doc.least))
    schema[doc.above_least ? "exclusiveMinimum" : "minimum"] = json_number(doc.least);
  if (std::isfinite(doc.most)) schema["maximum"] = json_number(doc.most);
  return schema;
}

// Without a limit if `most` is 0.
Json list_of(Json items, std::size_t least, std::size_t most = 0) {
  Json schema = typed("array");
  schema["items"] = std::move(items);
  if (least > 0) schema["minItems"] = least;
  if (most > 0) schema["maxItems"] = most;
  return schema;
}

Json names_to(Json values) {
  Json schema = typed("object");
  schema["additionalProperties"] = std::move(values);
  return schema;
}

Json part_schema(std::string_view table);

Json reference(std::string_view table) {
  return Json::object({{"$ref", fmt::format("#/$defs/{}", table)}});
}

Json text_schema(const KeyDoc& doc) {
  Json schema = typed("string");
  if (doc.pattern) schema["pattern"] = doc.pattern->expression();
  if (std::isfinite(doc.least)) schema["minLength"] = json_number(doc.least);
  if (std::isfinite(doc.most)) schema["maxLength"] = json_number(doc.most);
  return schema;
}

// What a value of the key must be.
Json value_schema(const KeyDoc& doc) {
  const Json choices = Json::object({{"enum", doc.choices}});
  // Two numbers in a 2D world, three in a 3D one: the parser knows which.
  const Json point = list_of(number_schema(doc, "number"), 2, 3);
  switch (doc.type) {
    case KeyType::text:
    case KeyType::lines:
      return text_schema(doc);
    case KeyType::whole:
      return number_schema(doc, "integer");
    case KeyType::number:
      return number_schema(doc, "number");
    case KeyType::truth:
      return typed("boolean");
    case KeyType::choice:
      return choices;
    case KeyType::point:
      return point;
    case KeyType::two_numbers:
      return list_of(number_schema(doc, "number"), 2, 2);
    case KeyType::size:
      return list_of(number_schema(doc, "integer"), 2, 2);
    case KeyType::loops:
      return list_of(list_of(list_of(number_schema(doc, "number"), 2, 2), 3), 1);
    case KeyType::whole_or_names:
      return Json::object(
          {{"anyOf", Json::array({number_schema(doc, "integer"), list_of(typed("string"), 1)})}});
    case KeyType::names:
    case KeyType::texts:
      return list_of(typed("string"), doc.may_be_empty || doc.type == KeyType::names ? 0 : 1,
                     std::isfinite(doc.most) ? static_cast<std::size_t>(doc.most) : 0);
    case KeyType::choices_list: {
      Json schema = list_of(choices, 1);
      schema["uniqueItems"] = true;
      return schema;
    }
    case KeyType::turn: {
      Json turn = typed("object");
      turn["properties"] = {{doc.of, number_schema(doc, "number")},
                            {"axis", list_of(typed("number"), 2, 3)}};
      turn["required"] = Json::array({doc.of});
      turn["additionalProperties"] = false;
      return Json::object({{"anyOf", Json::array({number_schema(doc, "number"), turn})}});
    }
    case KeyType::table:
      return reference(doc.of);
    case KeyType::tables:
      return list_of(reference(doc.of), 0, static_cast<std::size_t>(doc.most));
    case KeyType::part:
      return part_schema(doc.of);
    case KeyType::name_pairs:
      return list_of(list_of(typed("string"), 2, 2), 0);
    case KeyType::name_wholes:
      return names_to(number_schema(doc, "integer"));
    case KeyType::name_numbers: {  // energy.bob, without quotes, is a table in the table
      const Json number = number_schema(doc, "number");
      return names_to(Json::object({{"anyOf", Json::array({number, names_to(number)})}}));
    }
    case KeyType::name_points:
      return names_to(point);
    case KeyType::name_texts:
      return names_to(typed("string"));
  }
  return {};
}

Json key_schema(const KeyDoc& doc) {
  Json schema = Json::object({{"description", doc.doc}});
  schema.update(value_schema(doc));
  if (!doc.fallback.empty()) schema["default"] = Json::parse(doc.fallback);
  return schema;
}

Json table_schema(const TableDoc& table) {
  Json properties = Json::object(), required = Json::array(), groups = Json::array();
  for (const KeyDoc& key : table.keys) {
    properties[std::string(key.key)] =
        key.key == "do" ? Json::object({{"const", table.name}}) : key_schema(key);
    if (key.required) required.push_back(key.key);
  }
  for (const auto& group : table.groups.groups)
    groups.push_back(Json::object({{"required", group}}));
  Json schema = Json::object({{"description", table.doc},
                              {"type", "object"},
                              {"properties", properties},
                              {"additionalProperties", false}});
  if (table.by_side) schema["additionalProperties"] = reference(table.name);
  Json all = Json::object();
  if (!required.empty() && !table.by_side) all["required"] = required;
  if (!groups.empty()) all[table.groups.exactly_one ? "oneOf" : "anyOf"] = groups;
  // Who is like a prototype may have the rest from it.
  if (table.find("like") && !all.empty())
    schema["anyOf"] =
        Json::array({Json::object({{"required", Json::array({"name", "like"})}}), all});
  else
    schema.update(all);
  return schema;
}

// Any of the keys that a side may override; what is not there is as in the file.
Json part_schema(std::string_view name) {
  Json properties = Json::object();
  for (const KeyDoc& key : language_table(name).keys)
    if (may_differ(name, key.key)) properties[std::string(key.key)] = value_schema(key);
  return Json::object(
      {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}});
}

}  // namespace

std::string_view example(std::string_view name) {
  const auto files = examples::files();
  const auto file = std::ranges::find(files, name, &decltype(files)::value_type::first);
  LANTERN_CHECK(file == files.end(), ==, false);
  return file->second.substr(0, file->second.find(kMark));
}

std::string_view example_of_verb(std::string_view verb) {
  const std::string mark = mark_of(verb);
  const std::string_view text = file_with(mark), own = text.substr(text.find(mark) + mark.size());
  return own.substr(0, own.find(kMark));
}

std::string example_up_to(std::string_view verb) {
  const std::string_view whole = file_with(mark_of(verb));
  std::string text(whole.substr(0, whole.find(kMark, whole.find(mark_of(verb)) + 1)));
  for (std::size_t at = 0; (at = text.find(kMark.substr(1))) != text.npos;)
    text.erase(at, text.find('\n', at) + 1 - at);
  return text;
}

std::vector<ExamplePicture> example_pictures() {
  std::vector<ExamplePicture> all = {{"looks", std::string(example("looks"))}};
  for (const std::string_view arrange : arrangements())
    all.push_back({fmt::format("arrange_{}", arrange), pattern_example(arrange)});
  all.push_back({"map", std::string(example("map"))});
  for (const PanelKind& kind : panel_kinds())
    all.push_back({fmt::format("panel_{}", kind.name),
                   fmt::format("panels = [\"{}\"]\n{}", kind.name,
                               kind.example ? kind.example() : std::string(example("world")))});
  for (const TableDoc& verb : language_verbs())
    if (verb_has_picture(verb.name))
      all.push_back({fmt::format("do_{}", verb.name), example_up_to(verb.name)});
  return all;
}

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
      "in `equal`, `at_most` and `at_least`, in headlines and in captions; there those that are "
      "counted take a noun, as `{leaves.taxi:leaf/leaves}`.\n\n" +
      count_rows("measure", known_body_measures(), [](const CountDoc&) { return true; });
  page += "\n### Counts of an atlas\n\n" +
          count_rows("count", known_counts(), [](const CountDoc& doc) { return doc.for_atlas(); });
  return page;
}

std::string json_schema() {
  Json root = Json::object(
      {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Lantern scenario"}});
  root.update(table_schema(language_tables()[0]));
  Json verbs = Json::array();
  for (const TableDoc& verb : language_verbs()) verbs.push_back(table_schema(verb));
  for (const TableDoc& table : language_tables().subspan(1))
    root["$defs"][std::string(table.name)] =
        table.name == "step" ? Json::object({{"oneOf", verbs}}) : table_schema(table);
  return root.dump(2) + "\n";
}

}  // namespace lantern::language
