// scenarios/LECTURE.md: every statement of the lecture, the step that shows it, and what that step
// expects. A row that names a step which does not expect it is a statement that nothing proves.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

// | number | statement | `scenario` | `step` | proof; proof |
struct Row {
  std::string number, statement, scenario, step, proofs;
};

std::string trimmed(std::string text) {
  const auto is_edge = [](char c) { return c == ' ' || c == '`'; };
  while (!text.empty() && is_edge(text.front())) text.erase(0, 1);
  while (!text.empty() && is_edge(text.back())) text.pop_back();
  return text;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) c == at ? parts.emplace_back() : parts.back() += std::string(1, c);
  for (std::string& part : parts) part = trimmed(part);
  return parts;
}

std::vector<Row> rows_of(const std::string& page) {
  std::vector<Row> rows;
  for (const std::string& line : split(page, '\n')) {
    const auto cells = split(line, '|');
    if (cells.size() != 7 || cells[1].empty() ||
        !std::isdigit(static_cast<unsigned char>(cells[1][0])))
      continue;
    rows.push_back({cells[1], cells[2], cells[3], cells[4], cells[5]});
  }
  return rows;
}

TEST(Statements, EachHasAStepThatShowsItAndAnExpectationThatProvesIt) {
  const auto rows = rows_of(read_text(std::string(LANTERN_ROOT) + "/scenarios/LECTURE.md"));
  ASSERT_GE(rows.size(), 105u);
  std::map<std::string, Scenario> known;
  std::set<std::string> statements;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    SCOPED_TRACE(row.number + " " + row.statement);
    EXPECT_EQ(row.number, std::to_string(i + 1));
    EXPECT_TRUE(statements.insert(row.statement).second) << "stands twice";
    if (!known.contains(row.scenario)) known.emplace(row.scenario, shipped(row.scenario));
    const Scenario& scenario = known.at(row.scenario);
    const auto step = std::ranges::find(scenario.steps, row.step, &Step::name);
    ASSERT_NE(step, scenario.steps.end()) << row.scenario << " has no step " << row.step;
    const auto expected =
        proofs_of(scenario, static_cast<std::size_t>(step - scenario.steps.begin()));
    for (const std::string& proof : split(row.proofs, ';'))
      EXPECT_NE(std::ranges::count(expected, proof), 0)
          << "not expected: " << proof << "\nbut: " << fmt::format("{}", fmt::join(expected, "; "));
  }
}

}  // namespace
}  // namespace lantern::run
