// The bars: bounds on accuracy and strength that Lantern sets itself, each measured by a stress
// case, and the table of what was asked, what was measured, and how far apart they are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/labels.hpp"

namespace lantern::report {

// A bound that one quantity must keep. `value` is what was measured; nothing if it was not.
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

// Runs the stress cases that are bars and not slow.
std::vector<Bar> measured_bars();

double bars_table_height(const std::vector<Bar>& bars);  // page units

// As wide as the place. The strip shows the measured value on a logarithmic scale on which every
// bar is the middle line: left of it is better.
void draw_bars_table(const std::vector<Bar>& bars, const Box<2>& place, DrawList& list,
                     Labels& labels);

}  // namespace lantern::report
