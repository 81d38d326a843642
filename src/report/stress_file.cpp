// stress.json, read back.
#include <algorithm>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "report/stress_tables.hpp"

namespace lantern::report {
namespace {

StressOutcome read_outcome(const nlohmann::json& json, const StressCase& of) {
  StressOutcome outcome{of, {}};
  StressResult& result = outcome.result;
  json.at("good").get_to(result.good);
  const auto& figure = json.at("figure");
  result.figure =
      figure.is_null() ? std::numeric_limits<double>::quiet_NaN() : figure.get<double>();
  json.at("bound").get_to(result.bound);
  json.at("unit").get_to(result.unit);
  json.at("detail").get_to(result.detail);
  result.at_least = json.at("sense") == "at least";
  return outcome;
}

}  // namespace

std::optional<StressReport> read_stress(std::string_view text) try {
  const auto json = nlohmann::json::parse(text.begin(), text.end());
  if (json.at("format") != "lantern.stress/1") return std::nullopt;
  StressReport report;
  json.at("version").get_to(report.version);
  json.at("finished").get_to(report.finished);
  for (const auto& one : json.at("cases")) {
    const std::string name = one.at("name");
    const auto of = std::ranges::find(stress_cases(), name, &StressCase::name);
    if (of == stress_cases().end()) return std::nullopt;
    report.outcomes.push_back(read_outcome(one, *of));
  }
  return report;
} catch (const nlohmann::json::exception&) {
  return std::nullopt;
}

}  // namespace lantern::report
