#include "report/bars.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "measure/stress.hpp"

namespace lantern {
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

}  // namespace

std::optional<bool> Bar::met() const {
  if (!value) return std::nullopt;
  return at_least ? *value >= bound : *value <= bound;  // false for NaN
}

std::vector<Bar> measured_bars() {
  std::vector<Bar> bars;
  for (const StressCase& one : stress_cases()) {
    if (one.group != "bars" || one.slow) continue;
    const StressResult result = run_case(one).result;
    Bar bar;
    bar.name = one.name;
    std::ranges::replace(bar.name, '_', ' ');
    if (std::isfinite(result.figure)) bar.value = result.figure;
    bar.bound = result.bound;
    bar.unit = result.unit;
    bar.at_least = result.at_least;
    bar.elsewhere = seen_elsewhere(one.name);
    bar.reference = fmt::format("stress {}", one.name);
    bars.push_back(std::move(bar));
  }
  return bars;
}

}  // namespace lantern
