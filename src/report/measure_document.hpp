// Measurements of problems as a document.
#pragma once

#include "report/stress_tables.hpp"

namespace lantern::report {

// A chapter a problem: its plots, each method's most exact run, and all runs. Of several
// measurements, one a machine, each problem's runs lie in one plot, and it is told which of them
// ended in the same states. With bars a chapter of them.
Document document_of(std::span<const Measurement> measurements, const std::vector<Bar>& bars);

// How other engines were run.
Table engines_table(std::span<const PeerRecord> peers);

// The table of a terminal. Without any row it is empty.
std::string to_table(const Measurement& measurement);

// A measurement as files for other programs.

// RFC 4180: a header, one record a row, lines end with CR LF. As many pairs norm1_name, norm1, ...
// as the longest list of norms needs. Numbers have 17 digits; what is not there, or not finite, is
// an empty field.
std::string to_csv(const Measurement& measurement);

// The same for how errors and energies went with time: a record for each of a row's samples, by
// problem, method, version and step, with `time` in seconds since the start, `error`, the main norm
// so far, and `energy`, its drift so far, empty where the problem does not keep it. In JSON they
// stand in a row's list `samples`.
std::string drift_csv(const Measurement& measurement);

// The same for how and where it was made: records of a key and a value.
std::string to_csv(const Circumstances& circumstances);

// The same for how each engine was run, a record each.
std::string to_csv(const std::vector<PeerRecord>& peers);

// lantern.measure/2: circumstances, peers and rows, one row a line. What is not finite becomes
// null; bytes of texts that are no UTF-8 become U+FFFD.
std::string to_json(const Measurement& measurement);

// What to_json wrote; null is read as NaN. Nothing for a text that is damaged or of another format:
// `why` gets the member and its value.
std::optional<Measurement> read_measurement(std::string_view json, std::string* why = nullptr);

}  // namespace lantern::report
