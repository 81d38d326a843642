// The published page and schema say what the parser does.
#include <algorithm>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/printable.hpp"
#include "base/random.hpp"
#include "language/counts.hpp"
#include "language/language.hpp"
#include "language/text/problems.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

using nlohmann::json;

TEST(Reference, CommittedCopiesAreTheGeneratedOnes) {
  EXPECT_EQ(read_text(LANTERN_ROOT "/scenarios/REFERENCE.md"), reference_page())
      << "write it anew: build/lantern reference > scenarios/REFERENCE.md";
  EXPECT_EQ(read_text(LANTERN_ROOT "/scenarios/scenario.schema.json"), json_schema())
      << "write it anew: build/lantern schema > scenarios/scenario.schema.json";
}

// An example goes on from the scenario of what it works on.
std::string& example_of(std::string_view verb, std::string& world, std::string& atlas,
                        std::string& level) {
  if (verb == "pack" || verb == "ask_room" || verb == "draw") return atlas;
  return verb == "compile" || verb == "locate" || verb == "order" || verb == "see" ? level : world;
}

std::vector<std::string> toml_blocks(const std::string& page) {
  std::vector<std::string> found;
  const std::string fence = "```toml\n";
  for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
    at += fence.size();
    found.push_back(page.substr(at, page.find("```", at) - at));
  }
  return found;
}

// That they keep their promises, too, is in examples_test.cpp.
TEST(Reference, EveryExampleGoesOnFromTheScenariosOfThePage) {
  std::vector<std::string> blocks = toml_blocks(reference_page());
  std::erase_if(blocks, [&](const std::string& block) {
    const bool is_whole = block.starts_with("title = ") && block != example("world") &&
                          block != example("atlas") && block != example("level");
    if (is_whole) {
      EXPECT_TRUE(mistakes(block).empty()) << block << shown(mistakes(block));
    }
    return is_whole;
  });
  ASSERT_EQ(blocks.size(), 3 + language_verbs().size()) << "three scenarios, an example a verb";
  EXPECT_EQ(blocks[0], example("world"));
  EXPECT_EQ(blocks[1], example("atlas"));
  EXPECT_EQ(blocks[2], example("level"));
  std::string world = blocks[0], atlas = blocks[1], level = blocks[2];
  for (std::size_t i = 0; i < language_verbs().size(); ++i) {
    const std::string_view verb = language_verbs()[i].name;
    EXPECT_NE(blocks[i + 3].find("do = \"" + std::string(verb) + "\""), std::string::npos);
    std::string& text = example_of(verb, world, atlas, level);
    text += "\n" + blocks[i + 3];
    EXPECT_TRUE(mistakes(text).empty()) << text << shown(mistakes(text));
  }
}

TEST(Reference, PicturesAreOfGoodScenariosAndAllAreShown) {
  const std::string page = reference_page();
  std::set<std::string> names;
  for (const ExamplePicture& picture : example_pictures()) {
    EXPECT_TRUE(names.insert(picture.name).second) << picture.name;
    EXPECT_NE(page.find("](reference/" + picture.name + ".png)"), std::string::npos);
    EXPECT_TRUE(mistakes(picture.text).empty()) << picture.text << shown(mistakes(picture.text));
  }
  for (std::size_t at = page.find("](reference/"); at != page.npos;
       at = page.find("](reference/", at + 1)) {
    const std::size_t from = at + 12;
    EXPECT_TRUE(names.contains(page.substr(from, page.find(".png)", from) - from)));
  }
}

TEST(Reference, NamesEveryKeyAndCount) {
  const std::string page = reference_page();
  const auto has = [&](std::string_view name) {
    return page.find("`" + std::string(name) + "`") != std::string::npos;
  };
  for (const auto tables : {language_tables(), language_verbs()})
    for (const TableDoc& table : tables)
      for (const KeyDoc& key : table.keys) {
        EXPECT_TRUE(has(key.key)) << key.key;
        EXPECT_FALSE(key.doc.empty()) << key.key;
      }
  for (const CountDoc& text : known_texts()) EXPECT_TRUE(has("{" + std::string(text.name) + "}"));
}

TEST(Reference, DefaultsAreWhatTheParserTakes) {
  const Scenario s = good(
      "title = \"x\"\n[world]\nsize = [1, 1]\n[structure]\nkind = \"quadtree\"\n[[body]]\nname = "
      "\"a\"\nradius = 1\nposition = [0, 0]\n[[step]]\ndo = \"show\"\n");
  const auto fallback = [](const char* table, const char* key) {
    return std::string(language_table(table).find(key)->fallback);
  };
  EXPECT_EQ(fallback("", "seed"), std::to_string(s.seed));
  EXPECT_EQ(fallback("structure", "capacity"), std::to_string(s.structure.capacity));
  EXPECT_EQ(fallback("structure", "max_depth"), std::to_string(s.structure.max_depth));
  EXPECT_EQ(fallback("body", "color"), std::to_string(s.bodies[0].color));
  EXPECT_EQ(language_table("world").find("time_step")->otherwise, "1/60");
  EXPECT_EQ(s.world.time_step, 1.0 / 60);
  EXPECT_FALSE(s.structure.eager_children);
  EXPECT_EQ(s.pace, Pace::step);
  EXPECT_FALSE(s.structure.no_progress_stop);
  EXPECT_EQ(s.bodies[0].kind, BodyKind::dynamic_body);
}

// --- the schema ---

json to_json(const TomlValue& value);

struct ToJson {
  json operator()(const TomlDate&) const { return "a date"; }
  json operator()(const TomlArray& list) const {
    json array = json::array();
    for (const TomlValue& element : list) array.push_back(to_json(element));
    return array;
  }
  json operator()(const TomlTable& table) const {
    json object = json::object();
    for (const TomlEntry& e : table) object[e.key] = to_json(e.value);
    return object;
  }
  template <class T>
  json operator()(const T& plain) const {
    return plain;
  }
};

json to_json(const TomlValue& value) { return std::visit(ToJson(), value.data); }

json to_json(const std::string& text) {
  Problems problems;
  return to_json(TomlValue{{}, read_toml(text, problems)});
}

// Checks what the schema uses of JSON Schema, and fails at what it should not use.
class SchemaCheck {
 public:
  explicit SchemaCheck(const json& root) : root_(root) {}

  bool holds(const json& schema, const json& value) const {
    if (schema.contains("type") && !has_type(schema["type"].get<std::string>(), value))
      return false;
    for (const auto& [word, rule] : schema.items())
      if (!holds(word, rule, schema, value)) return false;
    return true;
  }

 private:
  bool holds(const std::string& word, const json& rule, const json& schema,
             const json& value) const {
    const auto all = [&](const json& list, auto&& f) {
      return std::all_of(list.begin(), list.end(), f);
    };
    const auto fitting = [&] {
      return std::count_if(rule.begin(), rule.end(),
                           [&](const json& s) { return holds(s, value); });
    };
    if (word == "$schema" || word == "title" || word == "description" || word == "default" ||
        word == "$defs" || word == "type")
      return true;
    if (word == "$ref")
      return holds(root_.at(json::json_pointer(rule.get<std::string>().substr(1))), value);
    if (word == "enum") return std::find(rule.begin(), rule.end(), value) != rule.end();
    if (word == "const") return rule == value;
    if (word == "oneOf") return fitting() == 1;
    if (word == "anyOf") return fitting() >= 1;
    if (word == "required")
      return all(rule, [&](const json& key) { return value.contains(key.get<std::string>()); });
    if (word == "properties") {
      for (const auto& [key, s] : rule.items())
        if (value.contains(key) && !holds(s, value[key])) return false;
      return true;
    }
    if (word == "additionalProperties") {
      for (const auto& [key, v] : value.items()) {
        const bool known = schema.contains("properties") && schema["properties"].contains(key);
        if (!known && (rule.is_boolean() ? !rule.get<bool>() : !holds(rule, v))) return false;
      }
      return true;
    }
    if (word == "items") return all(value, [&](const json& v) { return holds(rule, v); });
    if (word == "minItems") return value.size() >= rule.get<std::size_t>();
    if (word == "maxItems") return value.size() <= rule.get<std::size_t>();
    if (word == "uniqueItems")
      return std::set<json>(value.begin(), value.end()).size() == value.size();
    if (word == "minimum") return value >= rule;
    if (word == "maximum") return value <= rule;
    if (word == "exclusiveMinimum") return value > rule;
    if (word == "minLength") return letters(value.get<std::string>()) >= rule.get<std::size_t>();
    if (word == "maxLength") return letters(value.get<std::string>()) <= rule.get<std::size_t>();
    if (word == "pattern")
      return std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>()));
    ADD_FAILURE() << "the schema uses '" << word << "', which this test does not know";
    return false;
  }

  // Asked before all else, since the other rules take it for granted.
  static bool has_type(const std::string& type, const json& value) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    return type == "boolean" && value.is_boolean();
  }

  const json& root_;
};

bool schema_takes(const std::string& text) {
  static const json schema = json::parse(json_schema());
  return SchemaCheck(schema).holds(schema, to_json(text));
}

TEST(Schema, TakesWhatComesWithLantern) {
  for (const std::string& text : good_texts()) EXPECT_TRUE(schema_takes(text)) << text;
}

TEST(Schema, RefusesWhatTheParserRefuses) {
  const std::string text(example("world"));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return changed.replace(at, from.size(), to);
  };
  for (const std::string& bad :
       {with("title", "titel"), with("[16, 9]", "[16, 0]"), with("[16, 9]", "[16]"),
        with("\"quadtree\"", "\"octre\""), with("capacity = 2", "capacity = 0"),
        with("capacity = 2", "capacity = 2.5"), with("capacity = 2", "capcity = 2"),
        with("name = \"red\"", "name = \"red/\""), with("name = \"red\"", ""),
        with("radius = 0.8", "radius = 0.8\nhalf_size = [1, 1]"), with("radius = 0.8", ""),
        with("do = \"insert\"", "do = \"insret\""), with("do = \"insert\"", "do = \"run\""),
        with("pairs = 1", "piars = 1"), with("pairs = 1", "pairs = -1"),
        with("[[\"red\", \"pink\"]]", "[[\"red\"]]")}) {
    EXPECT_FALSE(mistakes(bad).empty()) << "the test itself is wrong:\n" << bad;
    EXPECT_FALSE(schema_takes(bad)) << bad;
  }
}

// An editor must never mark what is good.
TEST(Schema, TakesAllThatTheParserTakes) {
  constexpr std::string_view kValues[] = {"1",         "0",         "2.5",     "\"a\"",
                                          "true",      "[1, 2]",    "[]",      "{}",
                                          "\"event\"", "\"ghost\"", "\"bsp\"", "[\"red\"]"};
  const std::vector<std::string> seeds = good_texts();
  Random random(11);
  int good = 0;
  for (int round = 0; round < 1200; ++round) {
    std::string text = seeds[static_cast<std::size_t>(random.whole(0, 1))];
    // Another value behind the n-th '='.
    std::size_t at = 0;
    for (std::int64_t n = random.whole(1, 40); n > 0; --n) {
      const std::size_t next = text.find(" = ", at + 1);
      if (next != std::string::npos) at = next;
    }
    const std::size_t end = text.find('\n', at);
    text.replace(at + 3, end - at - 3,
                 kValues[static_cast<std::size_t>(random.whole(0, std::size(kValues) - 1))]);
    if (!mistakes(text).empty()) continue;
    ++good;
    EXPECT_TRUE(schema_takes(text)) << text;
  }
  EXPECT_GT(good, 50);
}

}  // namespace
}  // namespace lantern::run
