// What commands print with --json: one object each, as scenarios/output.schema.json says, whatever
// happens.
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const json& schema() {
  static const json all = json::parse(read_text(repository("scenarios/output.schema.json")));
  return all;
}

bool is_of_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  ADD_FAILURE() << "the schema has a type that this test does not know: " << type;
  return false;
}

// The part of JSON Schema that the file uses; anything else in it fails.
void expect_valid(const json& value, const json& rule, const std::string& at);

void expect_members(const json& object, const json& rule, const std::string& at) {
  for (const json& name : rule.value("required", json::array()))
    EXPECT_TRUE(object.contains(name)) << at << " has no " << name;
  const json properties = rule.value("properties", json::object());
  const json others = rule.value("additionalProperties", json(true));
  for (const auto& [name, member] : object.items()) {
    if (properties.contains(name))
      expect_valid(member, properties[name], at + "." + name);
    else if (others.is_object())
      expect_valid(member, others, at + "." + name);
    else
      EXPECT_TRUE(others.get<bool>()) << at << " has '" << name << "', which is nowhere told of";
  }
}

void expect_valid(const json& value, const json& rule, const std::string& at) {
  for (const auto& [word, means] : rule.items()) {
    if (word == "$ref") {
      const std::string name = means.get<std::string>().substr(std::string("#/$defs/").size());
      expect_valid(value, schema()["$defs"].at(name), at);
    } else if (word == "type") {
      const json types = means.is_array() ? means : json::array({means});
      const bool fits = std::any_of(types.begin(), types.end(),
                                    [&](const json& type) { return is_of_type(value, type); });
      EXPECT_TRUE(fits) << at << " is " << value << ", allowed is " << means;
      if (!fits) return;
    } else if (word == "const") {
      EXPECT_EQ(value, means) << at;
    } else if (word == "enum") {
      EXPECT_NE(std::find(means.begin(), means.end(), value), means.end()) << at << ": " << value;
    } else if (word == "items") {
      for (std::size_t i = 0; i < value.size(); ++i)
        expect_valid(value[i], means, at + "[" + std::to_string(i) + "]");
    } else if (word != "description" && word != "required" && word != "properties" &&
               word != "additionalProperties") {
      ADD_FAILURE() << "the schema has a word that this test does not know: " << word;
    }
  }
  if (value.is_object()) expect_members(value, rule, at);
}

// The format without its version; "" if `text` is no answer at all.
std::string command_of(const std::string& text, const json& answer) {
  EXPECT_TRUE(text.starts_with("{\n\"format\": \"lantern.")) << text.substr(0, 80);
  const std::string format = answer.value("format", "");
  EXPECT_TRUE(format.ends_with("/1") || format == "lantern.measure/2") << format;
  return format.substr(0, format.size() - 2);
}

json answer_to(const std::string& words, int code) {
  const Outcome o = shell("lantern " + words);
  EXPECT_EQ(o.code, code) << words << ": " << o.err;
  const json answer = json::parse(o.out, nullptr, false);
  EXPECT_FALSE(answer.is_discarded()) << words << " printed no JSON: " << o.out;
  if (answer.is_discarded()) return {};
  EXPECT_EQ(answer["exit_code"], code) << words;
  const std::string command = command_of(o.out, answer);
  const json& kinds = schema()["$defs"];
  const bool failed = !kinds.contains(command) || (code != 0 && answer.size() == 3);
  expect_valid(answer, kinds.at(failed ? "failed" : command), command);
  return answer;
}

TEST(JsonStyle, EveryCommandAnswersAsItsSchemaSays) {
  const fs::path out = fresh_folder("json-style");
  const std::string to = " -o " + out.string();
  EXPECT_EQ(answer_to("check --json " + kGhosts, 0)["scenarios"][0]["name"], "ghost_quadtree");
  EXPECT_GT(answer_to("list --json " + repository("scenarios").string(), 0)["scenarios"].size(),
            20u);
  EXPECT_EQ(answer_to("explain --json " + kGhosts, 0)["frames"], 8);
  answer_to("doctor --json", 0);
  answer_to("render --json --size 160x90 --frames 0-1 " + kGhosts + to, 0);
  const std::string picture = (out / "ghost_quadtree" / "ghost_quadtree_000").string();
  answer_to("compare --json " + picture + "0.png " + picture + "0.png", 0);
  const json different = answer_to("compare --json " + picture + "0.png " + picture + "1.png", 1);
  EXPECT_FALSE(different["files"][0]["equal"]);
  EXPECT_NE(answer_to("reference --json", 0)["markdown"].get<std::string>().find("# "),
            std::string::npos);
}

TEST(JsonStyle, CheckTellsTheHashesOfFramesWhereItIsAskedFor) {
  const fs::path out = fresh_folder("json-hashes");
  for (const char* pace : {"step", "event"}) {
    const std::string words = std::string("--json --pace ") + pace + " " + kGhosts;
    EXPECT_FALSE(answer_to("check " + words, 0)["scenarios"][0].contains("hashes"));
    const json told = answer_to("check --hashes " + words, 0)["scenarios"][0];
    ASSERT_EQ(told["hashes"].size(), told["frames"]) << pace;
    answer_to("render --format svg -o " + (out / pace).string() + " " + words, 0);
    for (std::size_t i = 0; i < told["hashes"].size(); ++i) {
      const fs::path file = fmt::format("ghost_quadtree/ghost_quadtree_{:04}.json", i);
      const json facts = json::parse(read_text(out / pace / file));
      EXPECT_EQ(told["hashes"][i], facts["hash"]) << pace << " " << i;
    }
  }
  EXPECT_EQ(shell("lantern check --hashes " + kGhosts).code, 2) << "there is no table of them";
}

TEST(JsonStyle, SoDoGoldenFramesShardsAndStructures) {
  const fs::path out = fresh_folder("json-more");
  const std::string small = "golden --json --size 64x36 --dir " + (out / "golden").string() +
                            " --report " + (out / "g.html").string() + " " + kGhosts;
  answer_to(
      "golden --json --size 64x36 --update --dir " + (out / "golden").string() + " " + kGhosts, 0);
  EXPECT_EQ(answer_to(small, 0)["scenarios"][0]["differing"], 0);
  const std::string facts = (out / "golden/ghost_quadtree/ghost_quadtree_0001.json").string();
  write_text(facts, "{}");
  EXPECT_EQ(answer_to(small, 1)["scenarios"][0]["differing"], 1);
  const std::string parts = (out / "parts").string();
  answer_to("render --json --size 64x36 --shard 1/2 -o " + parts + " " + kGhosts, 0);
  EXPECT_EQ(answer_to("merge --json " + parts, 1)["missing"], json::array({2}));
  answer_to("render --json --size 64x36 --shard 2/2 -o " + parts + " " + kGhosts, 0);
  EXPECT_EQ(answer_to("merge --json " + parts, 0)["merged"], true);
  EXPECT_GT(answer_to("structure list --json", 0)["structures"].size(), 5u);
  answer_to("structure check quadtree --worlds 3 --json", 0);
  answer_to("structure bench quadtree --bodies 10 --rounds 1 --json", 0);
}

TEST(JsonStyle, SoDoesTheLab) {
  const std::string to = " -o " + fresh_folder("json-style-lab").string();
  EXPECT_GT(answer_to("measure --list --json", 0)["problems"].size(), 20u);
  EXPECT_GT(answer_to("stress --list --json", 0)["cases"].size(), 60u);
  answer_to("stress --json overflow", 0);
  answer_to("bench atlas --json --set glyphs --count 20 --rounds 1 --no-peers", 0);
  answer_to("bench step --json --pile balls2d:2 --seconds 1 --only soft:1 --no-peers", 0);
  answer_to("bench pairs --json --workload uniform_2d --bodies 50 --only quadtree --no-peers", 0);
  answer_to("measure oscillator --json --quick --no-peers --method velocity_verlet --step 0.1" + to,
            0);
  answer_to("measure --json --from" + to.substr(3) + to + "/page", 0);
}

TEST(JsonStyle, MistakesOfAScenarioHaveTheirPlace) {
  const fs::path folder = fresh_folder("json-mistakes");
  write_text(folder / "bad.toml", "title = \"t\"\ntitel = 1\n[[step]]\ndo = \"show\"\n");
  const std::string bad = (folder / "bad.toml").string();
  for (const char* command : {"check", "render", "explain", "list"}) {
    const json answer = answer_to(std::string(command) + " --json " + bad, 3);
    ASSERT_EQ(answer["diagnostics"].size(), 1u) << command;
    json told = answer["diagnostics"][0];
    const std::string suggestion = told["suggestion"];
    EXPECT_TRUE(suggestion.starts_with("did you mean 'title'? known here: ")) << suggestion;
    told.erase("suggestion");
    EXPECT_EQ(told, (json{{"severity", "error"},
                          {"file", bad},
                          {"line", 2},
                          {"column", 1},
                          {"message", "unknown key 'titel'"},
                          {"source_line", "titel = 1"}}))
        << command;
  }
}

TEST(JsonStyle, SoIsWhatNoScenarioIsToBlameFor) {
  const auto message = [](const json& answer) {
    EXPECT_EQ(answer["diagnostics"].size(), 1u) << answer;
    EXPECT_TRUE(answer["diagnostics"][0]["file"].is_null());
    return answer["diagnostics"][0]["message"].get<std::string>();
  };
  EXPECT_NE(message(answer_to("rendr x --json", 2)).find("did you mean 'render'?"),
            std::string::npos);
  const json wrong = answer_to("check --json --pace fast x.toml", 2);
  EXPECT_EQ(wrong["format"], "lantern.check/1");
  EXPECT_NE(message(wrong).find("--pace"), std::string::npos);
  EXPECT_EQ(answer_to("bench step --json --pile cats:1", 2)["format"], "lantern.bench.step/1");
  EXPECT_EQ(answer_to("--json", 2)["format"], "lantern.error/1");
  EXPECT_NE(message(answer_to("check --json no/such.toml", 1)).find("no/such.toml"),
            std::string::npos);
  EXPECT_NE(message(answer_to("render --json -o - " + kGhosts, 2)).find("--json"),
            std::string::npos);
  EXPECT_NE(message(answer_to("measure --json oscilator", 2)).find("oscillator"),
            std::string::npos);
}

TEST(JsonStyle, WarningsAreToldAndStrictMakesThemErrors) {
  const fs::path folder = fresh_folder("json-warnings");
  write_text(folder / "away.toml",
             "title = \"t\"\n[world]\nsize = [4, 4]\n[[body]]\nname = \"a\"\nradius = 0.1\n"
             "position = [9, 9]\n[[step]]\ndo = \"insert\"\nbodies = [\"a\"]\n");
  const std::string file = (folder / "away.toml").string();
  const json told = answer_to("check --json " + file, 0);
  EXPECT_EQ(told["diagnostics"].size(), 2u) << told;
  for (const json& d : told["diagnostics"]) EXPECT_EQ(d["severity"], "warning");
  const json strict = answer_to("check --json --strict " + file, 3);
  for (const json& d : strict["diagnostics"]) EXPECT_EQ(d["severity"], "error");
}

TEST(JsonStyle, ThePagesAgree) {
  const std::string page = read_text(repository("scenarios/JSON.md"));
  const json& kinds = schema()["$defs"];
  std::size_t named = 0;
  for (const json& one : schema()["anyOf"]) {
    const std::string name = one["$ref"].get<std::string>().substr(8);
    if (name == "failed") continue;
    ++named;
    for (const auto& [member, rule] : kinds.at(name)["properties"].items())
      EXPECT_NE(page.find('`' + member), std::string::npos) << name << ": " << member;
  }
  EXPECT_EQ(named, 22u);
  EXPECT_EQ(shell("lantern schema --of output").out,
            read_text(repository("scenarios/output.schema.json")));
}

}  // namespace
}  // namespace lantern::app
