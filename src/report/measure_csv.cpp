#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "report/measure_tables.hpp"

namespace lantern {
namespace {

class Records {
 public:
  Records& text(std::string_view field) {
    if (!fresh_) out_ += ',';
    fresh_ = false;
    if (field.find_first_of(",\"\r\n") == std::string_view::npos) {
      out_ += field;
      return *this;
    }
    out_ += '"';
    for (const char c : field) (c == '"' ? out_ += c : out_) += c;
    out_ += '"';
    return *this;
  }
  Records& number(double d) { return text(std::isfinite(d) ? fmt::format("{:.17g}", d) : ""); }
  Records& number(const std::optional<double>& d) { return d ? number(*d) : text(""); }
  Records& count(std::uint64_t n) { return text(fmt::format("{}", n)); }
  void end() {
    out_ += "\r\n";
    fresh_ = true;
  }
  const std::string& all() const { return out_; }

 private:
  std::string out_;
  bool fresh_ = true;
};

constexpr std::string_view kBeforeNorms[] = {"problem",   "family",    "variant", "file",
                                             "text_hash", "method",    "version", "step",
                                             "status",    "reference", "reason"};
constexpr std::string_view kAfterNorms[] = {
    "drift_energy", "drift_momentum",    "drift_angular_momentum", "penetration",
    "repeats",      "seconds_median",    "seconds_least",          "seconds_spread",
    "steps",        "force_evaluations", "constraint_rows",        "pair_tests",
    "hash"};

void write_row(const Row& row, std::size_t norms, Records& csv) {
  csv.text(row.problem).text(row.family).text(row.variant);
  csv.text(row.file).text(fmt::format("{:016x}", row.text_hash));
  csv.text(row.method).text(row.version).number(row.step);
  csv.text(to_string(row.status)).text(row.reference).text(row.reason);
  for (std::size_t i = 0; i < norms; ++i) {
    const bool there = i < row.norms.size();
    csv.text(there ? row.norms[i].name : "");
    csv.number(there ? std::optional(row.norms[i].value) : std::nullopt);
  }
  csv.number(row.drift.energy).number(row.drift.momentum).number(row.drift.angular_momentum);
  csv.number(row.penetration);
  const Timing& t = row.timing;
  csv.count(static_cast<std::uint64_t>(std::max(0, t.repeats)));
  for (const double seconds : {t.median, t.least, t.spread})
    csv.number(t.repeats > 0 ? std::optional(seconds) : std::nullopt);
  csv.count(row.counted.steps).count(row.counted.force_evaluations);
  csv.count(row.counted.constraint_rows).count(row.counted.pair_tests);
  csv.text(fmt::format("{:016x}", row.hash)).end();
}

}  // namespace

std::string to_csv(const Measurement& measurement) {
  std::size_t norms = 0;
  for (const Row& row : measurement.rows) norms = std::max(norms, row.norms.size());
  Records csv;
  for (const std::string_view name : kBeforeNorms) csv.text(name);
  for (std::size_t i = 1; i <= norms; ++i)
    csv.text(fmt::format("norm{}_name", i)).text(fmt::format("norm{}", i));
  for (const std::string_view name : kAfterNorms) csv.text(name);
  csv.end();
  for (const Row& row : measurement.rows) write_row(row, norms, csv);
  return csv.all();
}

std::string to_csv(const Circumstances& c) {
  Records csv;
  csv.text("key").text("value").end();
  csv.text("version").text(c.version).end();
  csv.text("sources").text(c.sources).end();
  csv.text("compiler").text(c.compiler).end();
  csv.text("flags").text(c.flags).end();
  csv.text("processor").text(c.processor).end();
  csv.text("seed").count(c.seed).end();
  csv.text("effort").text(c.effort).end();
  return csv.all();
}

}  // namespace lantern
