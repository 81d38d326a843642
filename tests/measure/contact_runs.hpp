// Problems of scenarios/problems, changed for a test, and runs of them: by the engine, or by hand.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "measure/row.hpp"

namespace lantern::measure {

using Changes = std::vector<std::pair<std::string, std::string>>;
using Norms = std::map<std::string, double>;

// The file `name`, with each first text replaced, everywhere, by the second. The first must be
// there.
Scenario problem(const std::string& name, const Changes& changes = {});

// As the bodies begin.
Observation at_start(const Scenario& scenario);

Norms norms_of(const ErrorMetric& metric);

// By the engine: by `method`, in steps that meet each sample and are no longer than `step`.
Norms run(const Scenario& scenario, const std::string& method, double step);

// Looks at the start, and at what `moved` makes of it at each sample.
template <class F>
Norms looked_at(const Scenario& scenario, F&& moved) {
  const auto metric = metrics_of(scenario)();
  metric->look(at_start(scenario));
  const ProblemSpec& spec = *scenario.problem;
  for (std::uint32_t i = 1; i <= spec.samples; ++i) {
    Observation now = at_start(scenario);
    now.time = spec.seconds * i / spec.samples;
    moved(now);
    metric->look(now);
  }
  return norms_of(*metric);
}

}  // namespace lantern::measure
