// What the stress cases gave, as a table for people, as CSV and as JSON.
#pragma once

#include "measure/stress.hpp"
#include "report/document.hpp"

namespace lantern::report {

// Where and by what the cases were run.
struct StressReport {
  std::string version;
  std::vector<StressOutcome> outcomes;
  bool finished = true;  // false: interrupted, and some cases are missing
};

// Groups under headings: verdict, case, figure, bound, unit; a failed case with its detail below.
std::string to_table(const StressReport& report);

// One line a case: name,group,verdict,figure,sense,bound,unit,what,detail. A figure that is not a
// number is left empty.
std::string to_csv(const StressReport& report);

// Format "lantern.stress/1". A figure that is not finite is null.
std::string to_json(const StressReport& report);

// "70 of 72 good, 2 failed: overflow, ..."
std::string summary(const StressReport& report);

// The bars: bounds on accuracy and strength that Lantern sets itself, each measured by a stress
// case, and the table of what was asked, what was measured, and how far apart they are.

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
  // Decades from the bound: below 0 is better. Nothing if it was not measured.
  std::optional<double> distance() const;
};

// Runs the stress cases that are bars and not slow.
std::vector<Bar> measured_bars();

// A line a bar. The column kBarDistance has its distance in decades.
inline constexpr std::size_t kBarDistance = 3;
Table table_of(const std::vector<Bar>& bars);

}  // namespace lantern::report
