#include "scenario/parsing.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "language/language.hpp"

namespace lantern::run {

const std::string_view kSolid = R"(title = "solid"
panels = ["world", "tree", "memory", "chart"]
[world]
size = [16, 9, 16]
gravity = [0, -9.81, 0]
contacts = "soft"
may_sleep = true
camera_eye = [0, 5, 20]
camera_target = [8, 4, 8]
[structure]
kind = "octree"
split_static = true
[[body]]
name = "floor"
ground = [0, 1, 0]
position = [0, 0, 0]
[[pattern]]
name = "tower"
count = 5
half_size = [1, 0.5, 1]
oriented = true
arrange = "stack"
mass = 2
[[pattern]]
name = "chain"
capsule = [0.2, 0.4]
count = 4
arrange = "line"
min = [1, 8, 1]
max = [5, 8, 1]
[[body]]
name = "bat"
kind = "kinematic"
half_size = [1, 1, 1]
follow = "ball"
follow_axes = [1, 0, 0]
speed = 3
position = [8, 1, 1]
[[body]]
name = "ball"
radius = 0.5
position = [8, 8, 1]
restitution = 0.9
wander = true
speed = 2
[[spring]]
along = "chain"
stiffness = 100
[[joint]]
kind = "pin"
a = "chain1"
to = [1, 9, 1]
[chart]
x = "bodies"
y = ["pairs", "all_pairs"]
[[step]]
do = "insert"
bodies = ["floor", "tower", "chain", "bat", "ball"]
plot = "a"
[[step]]
do = "wait"
event = "asleep"
bodies = ["tower"]
at_most = 10
every = 10
expect = { asleep = ["tower"], at_most = { penetration = 0.1, contacts = 30 }, awake = 4 }
[[step]]
do = "ray"
from = [0, 1, 1]
to = [16, 1, 1]
hits = "all"
expect = { hits_are = ["bat"], energy = 3, tolerance = 0.1, velocity = { bat = [0, 0, 0] } }
)";

std::string steps(const std::vector<std::string>& list) {
  std::string text;
  for (const std::string& step : list) text += "[[step]]\n" + step + "\n";
  return text;
}

std::vector<Diagnostic> mistakes(const std::string& text) {
  try {
    parse_scenario(text, "ghosts.toml");
  } catch (const ScenarioError& error) {
    EXPECT_FALSE(error.diagnostics().empty()) << "an error without a mistake:\n" << text;
    return error.diagnostics();
  }
  return {};
}

std::string shown(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics) text += to_string(d) + "\n";
  return text;
}

void expect_mistakes(const std::string& text, const std::vector<std::string>& words) {
  std::string clean;
  std::vector<std::pair<int, int>> marks;
  int line = 1, column = 1;
  for (const char c : text) {
    if (c == '@') {
      marks.emplace_back(line, column);
      continue;
    }
    clean += c;
    if ((c & 0xc0) != 0x80) ++column;
    if (c == '\n') ++line, column = 1;
  }
  const std::vector<Diagnostic> found = mistakes(clean);
  ASSERT_EQ(found.size(), marks.size()) << clean << "\n" << shown(found);
  ASSERT_EQ(found.size(), words.size()) << "the test itself is wrong";
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].where.file, "ghosts.toml");
    EXPECT_EQ(std::pair(found[i].where.line, found[i].where.column), marks[i]) << shown(found);
    EXPECT_NE((found[i].message + "\n" + found[i].suggestion).find(words[i]), std::string::npos)
        << "no '" << words[i] << "' in\n"
        << shown(found);
  }
}

Scenario good(const std::string& text) {
  try {
    return parse_scenario(text, "ghosts.toml");
  } catch (const ScenarioError& error) {
    ADD_FAILURE() << error.what() << text;
  }
  return Scenario(ScenarioSpec());
}

std::vector<std::string> good_texts() {
  std::vector<std::string> texts{std::string(example("world")), std::string(example("atlas")),
                                 std::string(example("level")), std::string(kSolid)};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(LANTERN_ROOT "/scenarios"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) texts.push_back(read_text(file.string()));
  return texts;
}

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace lantern::run
