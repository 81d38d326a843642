// What `bench pairs` measured, as tables for people, as CSV, as JSON and as a page.
#pragma once

#include <string>

#include "measure/box_bench.hpp"

namespace lantern::report {

// A table a stage: times, what was counted, the ratio to the quickest other library.
std::string to_table(const BoxBenchResult& result);

// One line a contestant and stage.
std::string to_csv(const BoxBenchResult& result);

// Format "lantern.bench.pairs/1".
std::string to_json(const BoxBenchResult& result);

// A page that stands alone: time a box against the number of boxes, and how many times as quick as
// the quickest other library, contestants to be shown or hidden.
std::string to_html(const BoxBenchResult& result);

}  // namespace lantern::report
