#include "report/bars.hpp"

#include <cmath>

#include <fmt/format.h>

#include "measure/stress.hpp"

namespace lantern {

std::vector<Bar> measured_bars(const std::function<bool()>& stop) {
  std::vector<Bar> bars;
  for (const StressCase& one : stress_cases()) {
    if (one.group != "bars" || one.slow) continue;
    if (stop()) break;
    const StressResult result = run_case(one).result;
    Bar bar;
    bar.name = one.what;
    if (std::isfinite(result.figure)) bar.value = result.figure;
    bar.bound = result.bound;
    bar.unit = result.unit;
    bar.at_least = result.at_least;
    bar.reference = fmt::format("stress {}", one.name);
    bars.push_back(std::move(bar));
  }
  return bars;
}

}  // namespace lantern
