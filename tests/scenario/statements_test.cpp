// scenarios/LECTURE.md: every row is a statement, the step that shows it, what that step expects,
// and a change to the scenario that takes the idea away. A row whose step does not expect what it
// says is a statement that nothing proves; and so is one whose proof holds without the idea.
#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/ranges.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

// | number | statement | `scenario` | `step` | proof; proof | fails with |
struct Row {
  std::string number, statement, scenario, step, proofs, change;
};

std::string trimmed(std::string text, std::string_view edges = " `") {
  const auto is_edge = [&](char c) { return edges.find(c) != std::string_view::npos; };
  while (!text.empty() && is_edge(text.front())) text.erase(0, 1);
  while (!text.empty() && is_edge(text.back())) text.pop_back();
  return text;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) c == at ? parts.emplace_back() : parts.back() += std::string(1, c);
  return parts;
}

std::vector<Row> rows_of(const std::string& page) {
  std::vector<Row> rows;
  for (const std::string& line : split(page, '\n')) {
    const auto cells = split(line, '|');
    if (cells.size() != 8 || !std::isdigit(static_cast<unsigned char>(trimmed(cells[1])[0])))
      continue;
    rows.push_back({trimmed(cells[1]), trimmed(cells[2]), trimmed(cells[3]), trimmed(cells[4]),
                    trimmed(cells[5]), trimmed(cells[6], " ")});
  }
  return rows;
}

std::vector<Row> rows_of_the_lecture() {
  return rows_of(read_text(std::string(LANTERN_ROOT) + "/scenarios/LECTURE.md"));
}

std::vector<std::string> listed_in(const Row& row) {
  return mapped(split(row.proofs, ';'), [](const std::string& proof) { return trimmed(proof); });
}

std::string file_of(const std::string& scenario) {
  return read_text(fmt::format("{}/scenarios/{}.toml", LANTERN_ROOT, scenario));
}

std::size_t step_named(const Scenario& scenario, const std::string& name) {
  const auto step = std::ranges::find(scenario.steps, name, &Step::name);
  return static_cast<std::size_t>(step - scenario.steps.begin());
}

// --- the change ---

// In the tables of this name, or without one in the head of the file, `from` becomes `to`.
struct Change {
  std::string table, from, to;
};

// "in `split`: `planes = [` → `planes = [] # [` and `a` → `b ⏎ c`"; empty if it is not written so.
std::vector<Change> changes_of(const std::string& cell) {
  static const std::regex one("(?:in `([^`]+)`: )?`([^`]+)` → `([^`]*)`(?: and |$)");
  std::vector<Change> changes;
  std::size_t read = 0;
  for (std::sregex_iterator m(cell.begin(), cell.end(), one), end; m != end; ++m) {
    if (static_cast<std::size_t>(m->position()) != read) return {};
    read += static_cast<std::size_t>(m->length());
    changes.push_back(
        {(*m)[1], (*m)[2], std::regex_replace((*m)[3].str(), std::regex(" ⏎ "), "\n")});
  }
  return read == cell.size() ? changes : std::vector<Change>();
}

bool begins_a_step(const std::string& table) {
  return table.starts_with("[[step]]") || table.starts_with("  { do = ");
}

// The text, cut where tables begin: at headings, but for a step's own, and at lists' inline tables.
std::vector<std::string> tables_of(const std::string& text) {
  std::vector<std::string> tables(1);
  for (const std::string& line : split(text, '\n')) {
    if ((line.starts_with("[") && !line.starts_with("[step.")) || line.starts_with("  { "))
      tables.emplace_back();
    tables.back() += line + "\n";
  }
  return tables;
}

// Tells how often it was there.
int replace_all(std::string& text, const std::string& from, const std::string& to) {
  int found = 0;
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()), ++found)
    text.replace(at, from.size(), to);
  return found;
}

std::string changed(const std::string& text, const Change& change) {
  std::vector<std::string> tables = tables_of(text);
  int found = 0;
  bool in_head = true;
  const std::regex name(fmt::format("(^|[ \n]|\\{{ )name = \"{}\"", change.table));
  for (std::string& table : tables) {
    in_head = in_head && !begins_a_step(table);
    if (change.table.empty() ? in_head : std::regex_search(table, name))
      found += replace_all(table, change.from, change.to);
  }
  EXPECT_GT(found, 0) << "not there: " << change.from;
  return fmt::format("{}", fmt::join(tables, ""));
}

// --- what holds without the idea ---

// Up to this step, and nothing is expected before it.
Scenario cut_after(const Scenario& scenario, std::size_t step) {
  ScenarioSpec spec = scenario;
  spec.steps.resize(step + 1);
  for (std::size_t i = 0; i < step; ++i) {
    spec.steps[i].expect.clear();
    spec.steps[i].always.clear();
  }
  for (auto& side : spec.sides) side = std::make_shared<const Scenario>(cut_after(*side, step));
  return Scenario(std::move(spec));
}

// The proofs of this step that do not hold.
std::set<std::string> failed_at(const Scenario& scenario, std::size_t step) {
  Work work;
  const DirectorReport report = direct(
      cut_after(scenario, step), Pace::step, work, [](const Frame&) { return true; }, nullptr,
      Wanted::outcomes);
  std::set<std::pair<int, int>> places;
  for (const Diagnostic& problem : report.unmet.told())
    places.emplace(problem.where.line, problem.where.column);
  std::set<std::string> failed;
  for (const Proof& proof : proofs_of(scenario, step))
    if (places.contains({proof.where.line, proof.where.column})) failed.insert(proof.text);
  return failed;
}

// Of the row's step, once the change has taken the idea away. What the step expects is as it was,
// or nothing is said about the statement.
std::set<std::string> failed_without_the_idea(const Row& row) {
  const auto changes = changes_of(row.change);
  EXPECT_FALSE(changes.empty()) << "not a change: " << row.change;
  std::string text = file_of(row.scenario);
  const Scenario before = parse_scenario(text, row.scenario + ".toml");
  for (const Change& change : changes) text = changed(text, change);
  const Scenario after = parse_scenario(text, row.scenario + ".toml");
  const std::size_t step = step_named(after, row.step);
  EXPECT_EQ(step, step_named(before, row.step)) << "a step was taken out";
  if (step >= after.steps.size()) return {};
  EXPECT_EQ(mapped(proofs_of(after, step), &Proof::text),
            mapped(proofs_of(before, step), &Proof::text))
      << "what is expected was changed";
  return failed_at(after, step);
}

bool proves_nothing(const Row& row, const std::set<std::string>& failed) {
  return std::ranges::none_of(listed_in(row),
                              [&](const std::string& proof) { return failed.contains(proof); });
}

TEST(Statements, EachHasAStepThatShowsItAndAnExpectationThatProvesIt) {
  const auto rows = rows_of_the_lecture();
  ASSERT_GE(rows.size(), 105u);
  std::map<std::string, Scenario> known;
  std::set<std::string> statements;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    SCOPED_TRACE(row.number + " " + row.statement);
    EXPECT_EQ(trimmed(row.number, "*"), std::to_string(i + 1));
    EXPECT_TRUE(statements.insert(row.statement).second) << "stands twice";
    if (!known.contains(row.scenario)) known.emplace(row.scenario, shipped(row.scenario));
    const Scenario& scenario = known.at(row.scenario);
    const std::size_t step = step_named(scenario, row.step);
    ASSERT_LT(step, scenario.steps.size()) << row.scenario << " has no step " << row.step;
    const auto expected = mapped(proofs_of(scenario, step), &Proof::text);
    for (const std::string& proof : listed_in(row))
      EXPECT_NE(std::ranges::count(expected, proof), 0)
          << "not expected: " << proof << "\nbut: " << fmt::format("{}", fmt::join(expected, "; "));
  }
}

TEST(Statements, NoneIsProvedOnceItsIdeaIsTakenAway) {
  std::map<std::string, std::set<std::string>> known;  // rows may share a change
  for (const Row& row : rows_of_the_lecture()) {
    SCOPED_TRACE(row.number + " " + row.statement);
    const std::string run = fmt::format("{} {} {}", row.scenario, row.step, row.change);
    try {
      if (!known.contains(run)) known.emplace(run, failed_without_the_idea(row));
      EXPECT_FALSE(proves_nothing(row, known.at(run)))
          << "holds without the idea: " << row.proofs
          << "\nfails: " << fmt::format("{}", fmt::join(known.at(run), "; "));
    } catch (const std::exception& e) {
      ADD_FAILURE() << "does not run: " << e.what();
    }
  }
}

TEST(Statements, AChangeThatTakesNothingAwayIsFoundOut) {
  const Row row{"1",
                "",
                "pong_bsp",
                "split",
                "pairs = 1; all_pairs = 3",
                "in `red bat`: `color = 1` → `color = 2`"};
  EXPECT_TRUE(proves_nothing(row, failed_without_the_idea(row)));
}

}  // namespace
}  // namespace lantern::run
