// The files of a stress run, in its folder.
#pragma once

#include <string>

#include "app/report_folder.hpp"
#include "report/stress_tables.hpp"

namespace lantern::app {

// Throws IoError.
void save_stress_tables(ReportFolder& folder, const StressReport& report);
// The stability map, of a finished run. Throws IoError and BackendError.
void draw_stress_map(const ReportFolder& folder, const StressReport& report,
                     const std::string& theme, const std::string& backend);

// Whether all of its cases are good.
bool is_good(const StressReport& report);

}  // namespace lantern::app
