#include "app/stress_files.hpp"

#include <algorithm>

#include "measure/stability_map.hpp"
#include "report/pages.hpp"

namespace lantern::app {

void save_stress_tables(ReportFolder& folder, const StressReport& report) {
  folder.write("stress.csv", to_csv(report));
  folder.write("stress.json", to_json(report));
}

void draw_stress_map(const ReportFolder& folder, const StressReport& report,
                     const std::string& theme, const std::string& backend) {
  if (!folder.wanted() || !report.finished) return;
  const StabilityMap map = make_stability_map();
  folder.draw({{"stability_map", draw_stability_map(map)}}, theme, backend);
}

bool is_good(const StressReport& report) {
  return std::ranges::all_of(report.outcomes, [](const StressOutcome& o) { return o.result.good; });
}

}  // namespace lantern::app
