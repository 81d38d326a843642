// What the stress cases gave, as a table for people, as CSV and as JSON.
#pragma once

#include <span>
#include <string>

#include "measure/stress.hpp"

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

}  // namespace lantern::report
