#include "scenario/parsing.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "scenario/reference.hpp"

namespace lantern::test {

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
  return {};
}

std::vector<std::string> good_texts() {
  std::vector<std::string> texts{std::string(world_example()), std::string(atlas_example())};
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

}  // namespace lantern::test
