// Measurements of problems as a document.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/bars.hpp"
#include "report/document.hpp"

namespace lantern::report {

// A chapter a problem: its plots, each method's most exact run, and all runs. Of several
// measurements, one a machine, each problem's runs lie in one plot, and it is told which of them
// ended in the same states. With bars a chapter of them.
Document document_of(std::span<const Measurement> measurements, const std::vector<Bar>& bars);

// How other engines were run.
Table engines_table(std::span<const PeerRecord> peers);

// The table of a terminal. Without any row it is empty.
std::string to_table(const Measurement& measurement);

}  // namespace lantern::report
