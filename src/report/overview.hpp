// All of a measurement on one page: a small plot of each problem, and the bars.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/draw_list.hpp"
#include "measure/row.hpp"

namespace lantern {

// A promise about one quantity. `value` is what was measured; nothing if it was not.
struct Bar {
  std::string name;  // "free fall, 10 s at 1 ms"
  std::optional<double> value;
  double bound = 0;
  std::string unit;       // may be empty
  std::string reference;  // the row that it was read from: "projectile, velocity_verlet, h = 0.001"
  bool at_least = false;  // the value should not be below the bound; otherwise not above it
  std::string elsewhere;  // the best seen in other engines, as text; may be empty

  // Nothing if it was not measured. A value that is not finite misses.
  std::optional<bool> met() const;
};

// In the proportions of A3, 1600 units wide (2263 high) or as much larger as many problems need;
// for fewer than five only as high as these need.
// Each small plot names its scenario's file, so that every number can be found in the rows.
DrawList draw_overview(const Measurement& measurement, const std::vector<Bar>& bars);

}  // namespace lantern
