// The files of a measurement, in one folder: measure.json (which an interrupted run goes on from),
// measure.csv, a page of plots for each problem, and the overview, as PNG and SVG.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "measure/row.hpp"

namespace lantern {

class MeasureFiles {
 public:
  explicit MeasureFiles(const std::string& folder) : folder_(folder) {}

  // Makes the folder and tries whether a file can be written there. Throws IoError.
  static void require_writable(const std::string& folder);

  // Rows of an earlier run under the same circumstances; none if there are none, or if the file is
  // damaged.
  std::vector<Row> finished_rows(const Circumstances& circumstances) const;

  void save_rows(const Measurement& measurement) const;  // measure.json
  // All the rest. Throws BackendError after the SVG files if there is no OpenGL for the others.
  void save_pages(const Measurement& measurement, const std::string& backend) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace lantern
