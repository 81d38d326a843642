#include "report/stress_tables.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "measure/records.hpp"

namespace lantern::report {
namespace {

std::string_view verdict_of(const StressResult& result) { return result.good ? "good" : "FAILED"; }

}  // namespace

}  // namespace lantern::report

namespace lantern::measure {

template <class Visit>
void each_field(const StressOutcome& outcome, Visit&& visit) {
  const StressResult& result = outcome.result;
  visit(Field("name"), outcome.of.name);
  visit(Field("group"), outcome.of.group);
  visit(Field("", "verdict"), report::verdict_of(result));
  visit(Field("good", ""), result.good);
  visit(Field("figure"), result.figure);
  visit(Field("sense"), result.at_least ? "at least" : "at most");
  visit(Field("bound"), result.bound);
  visit(Field("unit"), result.unit);
  visit(Field("what"), outcome.of.what);
  visit(Field("detail"), result.detail);
}

}  // namespace lantern::measure

namespace lantern::report {
namespace {

constexpr std::string_view kGroups[] = {"extreme input", "stiff", "stability", "energy", "bars"};

// Whole numbers as such, others with three figures.
std::string figure_text(double figure) {
  if (std::isnan(figure)) return "-";
  if (figure == std::floor(figure) && std::abs(figure) < 1e5) return fmt::format("{:.0f}", figure);
  return std::abs(figure) >= 0.01 && std::abs(figure) < 1e5 ? fmt::format("{:.3g}", figure)
                                                            : fmt::format("{:.1e}", figure);
}

std::string bound_text(const StressResult& result) {
  if (std::isnan(result.figure)) return "-";  // broke off before it knew
  return fmt::format("{} {}", result.at_least ? ">=" : "<=", figure_text(result.bound));
}

std::string row_text(const StressOutcome& outcome, std::size_t name_width) {
  const StressResult& result = outcome.result;
  std::string text =
      fmt::format("  {:<6}  {:<{}}  {:>9}  {:<10}  {}\n", verdict_of(result), outcome.of.name,
                  name_width, figure_text(result.figure), bound_text(result), result.unit);
  if (result.good) return text;
  text += fmt::format("          {}\n", outcome.of.what);
  if (!result.detail.empty()) text += fmt::format("          {}\n", result.detail);
  return text;
}

}  // namespace

std::string to_table(const StressReport& report) {
  std::size_t width = 0;
  for (const StressOutcome& outcome : report.outcomes)
    width = std::max(width, outcome.of.name.size());
  std::string text;
  for (const std::string_view group : kGroups) {
    std::string rows;
    for (const StressOutcome& outcome : report.outcomes)
      if (outcome.of.group == group) rows += row_text(outcome, width);
    if (!rows.empty()) text += fmt::format("{}{}\n{}", text.empty() ? "" : "\n", group, rows);
  }
  return text + (text.empty() ? "" : "\n") + summary(report) + "\n";
}

std::string to_csv(const StressReport& report) { return csv_of(report.outcomes); }

std::string to_json(const StressReport& report) {
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.stress/1");
  json.line().member("version", report.version).line().member("finished", report.finished);
  write_rows("cases", report.outcomes, json);
  json.line().end_object();
  return json.text() + "\n";
}

std::string summary(const StressReport& report) {
  std::string failed;
  std::size_t good = 0;
  for (const StressOutcome& outcome : report.outcomes) {
    good += outcome.result.good;
    if (outcome.result.good) continue;
    failed += (failed.empty() ? ", failed: " : ", ") + std::string(outcome.of.name);
  }
  return fmt::format("{} of {} cases good{}{}", good, report.outcomes.size(), failed,
                     report.finished ? "" : "; interrupted before the end");
}

}  // namespace lantern::report
