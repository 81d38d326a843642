// What `bench atlas` measured, as tables for people, as CSV, as JSON and as a page.
#pragma once

#include <string>

#include "measure/atlas_bench.hpp"

namespace lantern::report {

// A table a set: how full, how long, and ours beside the fullest peer.
std::string to_table(const AtlasBenchResult& result);

// One line a contestant and set.
std::string to_csv(const AtlasBenchResult& result);

// Format "lantern.bench.atlas/1".
std::string to_json(const AtlasBenchResult& result);

// A page that stands alone: of each set how full against how long, contestants to be shown or
// hidden, and the numbers.
std::string to_html(const AtlasBenchResult& result);

}  // namespace lantern::report
