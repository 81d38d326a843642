#include "base/error.hpp"

#include <utility>

#include <gtest/gtest.h>

#include "base/printable.hpp"

namespace lantern {
namespace {

Diagnostic diagnostic(int line, int column, std::string source_line, std::string suggestion = "") {
  SourcePosition where{std::string("f"), line, column};
  return {std::move(where), std::string("m"), std::move(source_line), std::move(suggestion)};
}

TEST(Diagnostic, PointsAtTheColumn) {
  Diagnostic d = diagnostic(7, 3, "  capcity = 2", "did you mean 'capacity'?");
  d.where.file = "a.toml";
  d.message = "unknown key 'capcity'";
  EXPECT_EQ(to_string(d),
            "a.toml:7:3: error: unknown key 'capcity'\n"
            "    capcity = 2\n"
            "    ^\n"
            "  did you mean 'capacity'?");
}

TEST(Diagnostic, LeavesOutWhatItDoesNotKnow) {
  EXPECT_EQ(to_string(diagnostic(0, 0, "")), "f: error: m");
  EXPECT_EQ(to_string(diagnostic(2, 5, "")), "f:2:5: error: m");
  EXPECT_EQ(to_string(diagnostic(0, 0, "text", "try")), "f: error: m\n  try");
}

// The caret must stand under the named column, also of a line that is cut to be shown.
TEST(Diagnostic, KeepsTheCaretInViewOfLongLines) {
  for (const int column : {1, 60, 99, 100, 101, 250, 1000}) {
    std::string line(1000, '.');
    line[static_cast<std::size_t>(column) - 1] = 'X';
    const std::string text = to_string(diagnostic(1, column, line));
    const std::size_t shown = text.find('\n') + 1;
    const std::size_t caret = text.find('\n', shown) + 1;
    ASSERT_NE(text.find('X', shown), std::string::npos) << "column " << column;
    EXPECT_EQ(text.find('X', shown) - shown, text.find('^', caret) - caret) << "column " << column;
    EXPECT_LT(text.size(), 400u) << "a long line floods the terminal";
  }
}

TEST(Diagnostic, LetsNoControlCharactersThrough) {
  const std::string text = to_string(diagnostic(1, 2, "\tx\x1b[31m\x7f"));
  EXPECT_EQ(text, "f:1:2: error: m\n   x\\x1b[31m\\x7f\n   ^") << "a tab moves the caret";
  Diagnostic d = diagnostic(1, 1, "x", "\u202e\n");
  d.where.file = "\x1b]0;f\x07";
  d.message = "\u009b\xff";
  EXPECT_EQ(to_string(d), "\\x1b]0;f\\x07:1:1: error: \\u009b\\xff\n  x\n  ^\n  \\u202e\\n");
}

// Letters of several bytes, escapes and a cut before the column: the caret stands under its letter.
TEST(Diagnostic, CountsLettersUpToTheCaret) {
  for (const char* before : {"é", "漢", "\x1b", "\u202e"})
    for (const int count : {1, 20, 99, 130}) {
      std::string line;
      for (int i = 0; i < count; ++i) line += before;
      const std::string text = to_string(diagnostic(1, count + 1, line + "X" + line));
      const std::size_t shown = text.find('\n') + 1;
      const std::size_t caret = text.find('\n', shown) + 1;
      ASSERT_NE(text.find('X', shown), std::string::npos) << text;
      EXPECT_EQ(letters(text.substr(shown, text.find('X', shown) - shown)), text.find('^') - caret)
          << text;
      EXPECT_LT(letters(text), 400u) << "a long line floods the terminal";
    }
}

TEST(Diagnostic, SurvivesAnyColumn) {
  for (const int column : {-5, 0, 1, 4, 5, 100000})
    EXPECT_NE(to_string(diagnostic(1, column, "abc")).find('^'), std::string::npos);
}

TEST(ScenarioError, HoldsEveryMistake) {
  const ScenarioError error(std::vector<Diagnostic>{diagnostic(1, 1, ""), diagnostic(2, 1, "")});
  EXPECT_EQ(error.diagnostics().size(), 2u);
  EXPECT_STREQ(error.what(), "f:1:1: error: m\nf:2:1: error: m\n");
}

}  // namespace
}  // namespace lantern
