// What the language's table offers to a hand, held against the reader of the language: each value
// that is offered makes a text that is read.
#include "live/controls.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "live/edit.hpp"

namespace lantern::live {
namespace {

using nlohmann::json;

std::string lesson_text(const std::string& name) {
  return read_file(fmt::format("{}/scenarios/{}.toml", LANTERN_ROOT, name), 1 << 22);
}

json controls_of(const std::string& text) {
  const auto scenario = language::parse_scenario(text, "x.toml");
  return json::parse(controls_json(text, scenario))["controls"];
}

// "path = value", with its choices or ends.
std::string told(const json& control) {
  std::string line =
      fmt::format("{} = {}{}", control["path"].get<std::string>(), control["value"].dump(),
                  control["written"].get<bool>() ? "" : " (default)");
  if (control.contains("choices"))
    for (const json& choice : control["choices"]) line += " " + choice.get<std::string>();
  if (control.contains("least"))
    line += fmt::format(" {} to {} by {}", control["least"].dump(), control["most"].dump(),
                        control["step"].dump());
  return line;
}

std::vector<std::string> all_told(const std::string& text) {
  std::vector<std::string> lines;
  for (const json& control : controls_of(text)) lines.push_back(told(control));
  return lines;
}

using Lines = std::vector<std::string>;

TEST(Controls, OfAQuadtreeThatLetsNoTimePass) {
  EXPECT_EQ(
      all_told(lesson_text("ghost_quadtree")),
      Lines({R"(structure.kind = "quadtree" quadtree kd_tree lecture_quadtree)",
             R"(structure.capacity = 2 1 to 8 by 1)", R"(structure.max_depth = 4 0 to 8 by 1)",
             R"(structure.children = "eager" lazy eager)",
             R"(structure.no_progress_stop = false (default))"}));
}

TEST(Controls, OfBodiesThatFall) {
  EXPECT_EQ(
      all_told(lesson_text("falling_boxes")),
      Lines(
          {R"(structure.kind = "aabb_tree" auto brute_force sort_and_sweep )"
           R"(quadtree kd_tree lecture_quadtree grid aabb_tree)",
           R"(structure.split_static = false (default))",
           R"(structure.margin = 0 (default) 0.0 to 1.0 by 0.02)",
           R"(structure.following = "auto" (default) auto reinsert refit)",
           R"(world.gravity = [0,-10] -20.0 to 20.0 by 0.5)",
           R"(world.contacts = "soft" impulse soft direct lecture)",
           R"(world.integrator = "semi_implicit_euler" (default) explicit_euler )"
           R"(semi_implicit_euler velocity_verlet runge_kutta_4 implicit_midpoint implicit_euler)",
           R"(world.sub_steps = 8 (default) 1 to 16 by 1)",
           R"(prototype[0].restitution = 0 (default) 0.0 to 1.0 by 0.02)",
           R"(prototype[0].friction = 1 0.0 to 2.0 by 0.02)",
           R"(body[0].friction = 1 0.0 to 2.0 by 0.02)",
           R"(body[6].friction = 1 0.0 to 2.0 by 0.02)"}));
}

TEST(Controls, OfAnAtlas) {
  EXPECT_EQ(all_told(lesson_text("kdtree_atlas")),
            Lines({R"(atlas.rule = "first_fit" (default) first_fit best_texture)",
                   R"(atlas.turn = false (default))", R"(atlas.trials = 18 (default) 1 to 18 by 1)",
                   R"(texture_pattern[0].count = 32 32 to 100 by 1)",
                   R"(texture_pattern[0].order = "tallest_first" as_made tallest_first)"}));
}

TEST(Controls, TellValuesHoweverTheyAreWritten) {
  const json controls = controls_of(R"(title = "x"
structure = { "kind" = '''quadtree''', max_depth = 0x3, capacity = +1_0 }
[world]
size = [64, 32]
"gravity" = [ 0,  # none
  -1_0.5e0, ]
[[body]]
name = "red"
radius = 1
position = [5, 5]
[[step]]
do = "insert"
bodies = ["red"]
[[step]]
do = "run"
seconds = 1
)");
  std::vector<std::string> values;
  for (const json& control : controls)
    if (control["written"])
      values.push_back(control["key"].get<std::string>() + control["value"].dump());
  EXPECT_EQ(values, Lines({"kind\"quadtree\"", "capacity10", "max_depth3", "gravity[0,-10.5]"}));
}

TEST(Controls, OfALevel) {
  EXPECT_EQ(
      all_told(lesson_text("doom_level_bsp")),
      Lines({R"(level.balance = 1 0.0 to 10.0 by 0.2)", R"(level.cuts = 3 0.0 to 10.0 by 0.2)",
             R"(level.choose = "score" score first_wall)"}));
}

// All that the page may send, as it would: bare choices get their quotes, points their brackets.
std::vector<std::string> values_of(const json& control) {
  if (control["type"] == "truth") return {"true", "false"};
  std::vector<std::string> values;
  if (control["type"] == "choice")
    for (const json& choice : control["choices"]) values.push_back(choice.dump());
  else
    for (const char* end : {"least", "most"}) values.push_back(control[end].dump());
  if (control["type"] != "point") return values;
  for (std::string& value : values) {
    std::string list = "[" + value;
    for (std::size_t i = 0; i + 1 < control["value"].size(); ++i) list += ", " + value;
    value = list + "]";
  }
  return values;
}

TEST(Controls, EachValueOfEachLessonIsRead) {
  std::size_t tried = 0;
  for (const auto& entry : std::filesystem::directory_iterator(LANTERN_ROOT "/scenarios")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string text = read_file(entry.path().string(), 1 << 22);
    const json controls = controls_of(text);
    EXPECT_LE(controls.size(), 12U);
    for (const json& control : controls)
      for (const std::string& value : values_of(control)) {
        const std::string path = control["path"];
        EXPECT_NO_THROW(language::parse_scenario(with_value(text, path, value), "x.toml"))
            << entry.path() << ": " << path << " = " << value;
        ++tried;
      }
  }
  EXPECT_GT(tried, 400U);
}

// --- completion ---

// The text has a | where the cursor is. "from: words".
std::string completed_at(std::string text) {
  const std::size_t bar = text.find('|');
  text.erase(bar, 1);
  const auto line = static_cast<int>(std::count(text.begin(), text.begin() + long(bar), '\n')) + 1;
  const std::size_t begin = bar == 0 ? 0 : text.rfind('\n', bar - 1) + 1;
  const json answer = json::parse(complete_json(text, line, static_cast<int>(bar - begin) + 1));
  std::string words = fmt::format("{}:", answer["from"].get<int>());
  for (const json& word : answer["words"]) {
    EXPECT_TRUE(word["means"].is_string());
    words += " " + word["word"].get<std::string>();
  }
  return words;
}

TEST(Completion, OffersKeysThatAreNotWritten) {
  EXPECT_EQ(completed_at("[structure]\ncapacity = 2\nc|\nchildren = \"lazy\"\n"), "1: cell");
  EXPECT_EQ(completed_at("[atlas]\nsize = [8, 8]\n|"), "1: rule turn trials screen quiet");
  EXPECT_EQ(completed_at("[atlas]\n  tu|rn = true\n"), "3: turn");
  EXPECT_EQ(completed_at("s|\n[world]\nsize = [8, 8]\n"), "1: source seed");
}

TEST(Completion, OffersAStepWhatItsVerbHas) {
  EXPECT_EQ(completed_at("[[step]]\ndo = \"wait\"\ne|\n"), "1: event every ending expect");
  EXPECT_EQ(completed_at("[[step]]\ne|\ndo = \"order\"\n"), "1: eye ending expect");
  EXPECT_EQ(completed_at("[[step]]\nd|\n"), "1: do display");
  EXPECT_EQ(completed_at("[[step]]\ndo = \"ins|"), "7: insert");
  EXPECT_EQ(completed_at("[[step]]\ndo = |\n").substr(0, 18), "6: \"show\" \"insert\"");
}

TEST(Completion, OffersTheKeysOfAnInlineTable) {
  EXPECT_EQ(completed_at("[[step]]\ndo = \"show\"\ncamera = { eye = [1, 2, 3], |"), "29: target");
  EXPECT_EQ(completed_at("[[step]]\nnote = [{ text = \"a\" },\n  { te|"), "5: text");
  EXPECT_EQ(completed_at("[[step]]\nexpect.eager = { pairs_a|"), "18: pairs_are");
  EXPECT_EQ(completed_at("[[step]]\nexpect.pairs_a|"), "8: pairs_are");
  EXPECT_EQ(completed_at("[[step]]\n[step.expect]\npairs_a|"), "1: pairs_are");
}

TEST(Completion, OffersChoicesAndTruths) {
  EXPECT_EQ(completed_at("[structure]\nkind = \"qu|\""), "9: quadtree");
  EXPECT_EQ(completed_at("[structure]\nchildren = |"), "12: \"lazy\" \"eager\"");
  EXPECT_EQ(completed_at("[world]\nmay_sleep = t|"), "13: true");
  EXPECT_EQ(completed_at("panels = [\"world\", \"tr|"), "21: tree");
}

constexpr const char* kTwoBodies =
    "[[body]]\nname = \"red\"\n[[body]]\nname = \"röd\"\n[[prototype]]\nname = \"ghost\"\n";

TEST(Completion, OffersNamesThatTheTextHas) {
  EXPECT_EQ(
      completed_at(std::string(kTwoBodies) + "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"r|"),
      "19: red röd");
  EXPECT_EQ(completed_at(std::string(kTwoBodies) + "[[body]]\nlike = |"), "8: \"ghost\"");
  EXPECT_EQ(completed_at(std::string(kTwoBodies) + "[[step]]\nexpect = { in_leaves = { |"),
            "26: red röd");
  EXPECT_EQ(completed_at(std::string(kTwoBodies) + "[[step]]\nlit = [|"), "8: \"red\" \"röd\"");
}

TEST(Completion, OffersHeadings) {
  EXPECT_EQ(completed_at("[world]\nsize = [8, 8]\n[w|"), "1:");
  EXPECT_EQ(completed_at("[w|"), "1: [world]");
  EXPECT_EQ(completed_at("[world]\n[[b|"), "1: [[body]]");
}

TEST(Completion, BearsATextThatIsBrokenElsewhere) {
  EXPECT_EQ(completed_at("[level]\nloops = [[[1, 2], [3\n[structure]\ncap|"), "1: capacity");
  EXPECT_EQ(completed_at("title = \"open\n= = {\n[structure]\ncap|"), "1: capacity");
  EXPECT_EQ(completed_at("[level]\nloops = [\n  [[1, 4], [3, 2]],\n]\ncu|"), "1: cuts");
  EXPECT_EQ(completed_at("[nowhere]\nx|"), "1:");
  EXPECT_EQ(completed_at("# [wor|"), "7:");
  EXPECT_EQ(completed_at("|"), completed_at("|\n"));
}

// Whatever is there and wherever one asks, it answers.
TEST(Completion, AnswersEverywhere) {
  EXPECT_TRUE(json::accept(complete_json("[[body]]\nname = \"\xff\"\n[[step]]\nlit = [", 4, 8)));
  for (const auto& [begin, open] :
       {std::pair("x = ", "["), std::pair("x = ", "{ x = "), std::pair("", "x.")}) {
    std::string deep = begin;
    for (int i = 0; i < 100'000; ++i) deep += open;
    EXPECT_TRUE(json::accept(complete_json(deep, 1, 1 << 20)));
  }
  const std::string text = lesson_text("children_on_demand");
  for (std::size_t cut = 0; cut < text.size(); cut += 37)
    for (const int column : {0, 1, 7, 1000}) {
      const auto line = static_cast<int>(std::count(text.begin(), text.begin() + long(cut), '\n'));
      EXPECT_TRUE(json::accept(complete_json(text.substr(0, cut), line + column % 3, column)));
      EXPECT_TRUE(json::accept(complete_json(text.substr(cut), 1, column)));
    }
}

}  // namespace
}  // namespace lantern::live
