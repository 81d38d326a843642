// The tables and plots of a measurement, in its folder.
#pragma once

#include <string>

#include "app/report_folder.hpp"
#include "measure/row.hpp"

namespace lantern::app {

struct MeasurePages {
  bool bars = true;  // of all problems: beside the bars that belong to the whole
  std::string theme = "light";
  std::string backend = "auto";
};

// The tables of all, a page of plots for each problem, the overview, and all on one web page.
// Throws IoError and BackendError.
void save_pages(ReportFolder& folder, const Measurement& m, const MeasurePages& as);

}  // namespace lantern::app
