#include "report/bars.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "measure/stress.hpp"
#include "report/words.hpp"

namespace lantern::report {
namespace {

// The best that we saw of other engines, or read in their own tests: for orientation only, the
// bounds are Lantern's.
std::string seen_elsewhere(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> kSeen[] = {
      {"free_fall", "0.0245 m"},           {"torque_free_momentum", "6e-3"},
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

std::optional<bool> Bar::met() const {
  if (!value) return std::nullopt;
  return at_least ? *value >= bound : *value <= bound;  // false for NaN
}

std::optional<double> Bar::distance() const {
  if (!value) return std::nullopt;
  if (!std::isfinite(*value)) return 1e9;
  if (*value == bound) return 0;
  if (bound <= 0 || *value <= 0) return (*value < bound) == at_least ? 1e9 : -1e9;
  const double decades = std::log10(*value / bound);
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
  Table table{"",
              {{"quantity", false},
               {"bar", false},
               {"measured", false},
               {"decades from the bar"},
               {"", false},
               {"best seen elsewhere", false},
               {"read from", false}}};
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
