#include "report/stress_tables.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/json_writer.hpp"

namespace lantern {
namespace {

constexpr std::string_view kGroups[] = {"extreme input", "stiff", "stability", "bars"};

std::string_view verdict_of(const StressResult& result) { return result.good ? "good" : "FAILED"; }

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

// With quotes where a comma or quote asks for them (RFC 4180).
std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

// All digits; nothing if there are none to tell.
std::string csv_number(double value) {
  return std::isnan(value) ? std::string() : fmt::format("{:.17g}", value);
}

void add_number(JsonWriter& json, std::string_view name, double value) {
  json.key(name);
  if (std::isfinite(value))
    json.value(value);
  else
    json.null();
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

std::string to_csv(const StressReport& report) {
  std::string text = "name,group,verdict,figure,sense,bound,unit,what,detail\n";
  for (const auto& [of, result] : report.outcomes)
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", of.name, of.group, verdict_of(result),
                        csv_number(result.figure), result.at_least ? "at least" : "at most",
                        csv_number(result.bound), csv_field(result.unit), csv_field(of.what),
                        csv_field(result.detail));
  return text;
}

std::string to_json(const StressReport& report) {
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.stress/1");
  json.line().member("version", report.version).line().member("finished", report.finished);
  json.line().key("cases").begin_array();
  for (const auto& [of, result] : report.outcomes) {
    json.line().begin_object().member("name", of.name).member("group", of.group);
    json.member("good", result.good);
    add_number(json, "figure", result.figure);
    json.member("sense", result.at_least ? "at least" : "at most");
    add_number(json, "bound", result.bound);
    json.member("unit", result.unit).member("what", of.what).member("detail", result.detail);
    json.end_object();
  }
  json.line().end_array().line().end_object();
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

}  // namespace lantern
