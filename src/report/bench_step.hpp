// What a step of many bodies costs, as tables for people, as CSV, as JSON and as a page.
#pragma once

#include <string>

#include "measure/step_bench.hpp"

namespace lantern::report {

// A table a pile: times, how exact it was, what ours counted, and ours beside each peer.
std::string to_table(const StepBenchResult& result);

// One line a solver and pile.
std::string to_csv(const StepBenchResult& result);

// Format "lantern.bench.step/1".
std::string to_json(const StepBenchResult& result);

// A page that stands alone: of each pile the cost of a step against the overlap that it leaves,
// contestants to be shown or hidden, and the numbers.
std::string to_html(const StepBenchResult& result);

}  // namespace lantern::report
