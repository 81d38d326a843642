// Measurements as they might come out, seeded: orders 1, 2 and 4 down to a floor, runs that
// diverge, peers, contact problems, whole numbers of hits.
#pragma once

#include <cstdint>
#include <string>

#include "measure/row.hpp"
#include "report/pages.hpp"

namespace lantern::report::samples {

// A row that is ok, timed, and has this error and cost.
Row row(const std::string& method, double step, double error, double seconds,
        std::uint64_t evaluations);

// 9 problems, or as many as are asked for by repeating them under other names.
Measurement measurement(std::size_t problems = 9, std::uint64_t seed = 1);

// Those of an analyst's wish list: met, missed, not run, of no unit, at least.
std::vector<Bar> bars();

}  // namespace lantern::report::samples
