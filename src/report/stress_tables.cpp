#include "report/stress_tables.hpp"

#include "geometry/elementary.hpp"
#include "measure/records.hpp"

namespace lantern::report {
namespace {

std::string_view verdict_of(const StressResult& result) { return result.good ? "good" : "FAILED"; }

}  // namespace

}  // namespace lantern::report

namespace lantern::measure {

void each_field(const StressOutcome& outcome, auto&& visit) {
  const StressResult& result = outcome.result;
  visit_fields(visit, "name", outcome.of.name, "group", outcome.of.group);
  visit(Field("", "verdict"), report::verdict_of(result));
  visit(Field("good", ""), result.good);
  visit_fields(visit, "figure", result.figure, "sense", result.at_least ? "at least" : "at most",
               "bound", result.bound, "unit", result.unit, "what", outcome.of.what, "detail",
               result.detail);
}

}  // namespace lantern::measure

namespace lantern::report {
namespace {

constexpr std::string_view kGroups[] = {"extreme input", "stiff", "stability",
                                        "energy",        "laws",  "bars"};

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

// The best that we saw of other engines, or read in their own tests: for orientation only, the
// bounds are Lantern's.
std::string seen_elsewhere(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> kSeen[] = {
      {"free_fall", "0.0245 m"},           {"torque_free", "6e-3 of its momentum"},
      {"elastic_bounce", "5.7e-6"},        {"stack_of_60", "0.1 mm (Jolt)"},
      {"heavy_on_light", "11 mm (Jolt)"},  {"chain_of_rods", "13 mm (Jolt)"},
      {"sliding", "1e-2 m (Jolt's test)"}, {"far_from_origin", "1e-3 m (Box2D's test)"},
  };
  for (const auto& [known, seen] : kSeen)
    if (known == name) return std::string(seen);
  return {};
}

// "1 hash" of hashes.
std::string with_unit(const std::string& number, const std::string& unit) {
  if (number == "1" && (unit.ends_with("shes") || unit.ends_with("xes")))
    return number + " " + unit.substr(0, unit.size() - 2);
  return unit.empty() ? number : number + " " + unit;
}

std::string measured_text(const Bar& b) {
  if (!b.value) return "–";
  return std::isfinite(*b.value) ? with_unit(figure(*b.value), b.unit) : "not finite";
}

std::string distance_text(const Bar& b) {
  const auto far = b.distance();
  if (!far) return "–";
  return std::abs(*far) > 99 ? (*far < 0 ? "–∞" : "∞") : fmt::format("{:+.1f}", *far);
}

}  // namespace

std::string to_table(const StressReport& report) {
  const auto width = greatest_of<std::size_t>(
      0, report.outcomes, [](const StressOutcome& outcome) { return outcome.of.name.size(); });
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

std::optional<bool> Bar::met() const {
  if (!value) return std::nullopt;
  return at_least ? *value >= bound : *value <= bound;  // false for NaN
}

std::optional<double> Bar::distance() const {
  if (!value) return std::nullopt;
  if (!std::isfinite(*value)) return 1e9;
  if (*value == bound) return 0;
  if (bound <= 0 || *value <= 0) return (*value < bound) == at_least ? 1e9 : -1e9;
  const double decades = geometry::log10(*value / bound);
  return at_least ? -decades : decades;
}

std::vector<Bar> measured_bars() {
  std::vector<Bar> bars;
  for (const StressCase& one : stress_cases()) {
    if (one.group != "bars" || one.slow) continue;
    const StressResult result = run_case(one).result;
    const auto value = std::isfinite(result.figure) ? std::optional(result.figure) : std::nullopt;
    bars.push_back({std::string(one.name), value, result.bound, result.unit,
                    fmt::format("stress {}", one.name), result.at_least, seen_elsewhere(one.name)});
    std::ranges::replace(bars.back().name, '_', ' ');
  }
  return bars;
}

Table table_of(const std::vector<Bar>& bars) {
  Table table{"", columns_of({"quantity|", "bar|", "measured|", "decades from the bar", "|",
                              "best seen elsewhere|", "read from|"})};
  for (const Bar& b : bars) {
    const auto met = b.met();
    table.lines.push_back({{},
                           {b.name,
                            (b.at_least ? "≥ " : "≤ ") + with_unit(figure(b.bound), b.unit),
                            measured_text(b),
                            distance_text(b),
                            {!met   ? "not run"
                             : *met ? "met"
                                    : "missed",
                             met == false},
                            b.elsewhere.empty() ? "–" : b.elsewhere,
                            b.reference}});
  }
  return table;
}

}  // namespace lantern::report
