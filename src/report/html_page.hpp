// A measurement as one web page that stands alone.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "measure/row.hpp"
#include "report/bars.hpp"

namespace lantern::report {

// Every problem with its plots and tables, methods and peers to be shown or hidden, how and where
// all was run. Without network, fonts or libraries; without scripts all is shown and everything but
// the three buttons works. Of several measurements, one a machine, each problem's runs lie in one
// plot, and the page tells which of them ended in the same states. The same measurements give the
// same bytes. Without any the page says so.
std::string to_html(std::span<const Measurement> measurements, const std::vector<Bar>& bars);

}  // namespace lantern::report
