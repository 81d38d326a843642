#include "app/measure_files.hpp"

#include <fmt/format.h>

#include "base/file.hpp"
#include "report/bars.hpp"
#include "report/measure_plots.hpp"
#include "report/measure_tables.hpp"
#include "report/overview.hpp"
#include "report/pictures.hpp"

namespace lantern {
namespace {

constexpr std::size_t kMostBytes = std::size_t{256} << 20;  // of an earlier measure.json

bool same(const Circumstances& a, const Circumstances& b) {
  return a.version == b.version && a.compiler == b.compiler && a.flags == b.flags &&
         a.processor == b.processor && a.effort == b.effort;
}

}  // namespace

void MeasureFiles::require_writable(const std::string& folder) {
  make_folder(folder);
  remove_leftovers(folder);
  const std::filesystem::path probe = std::filesystem::path(folder) / ".writable";
  write_file(probe, "");
  std::filesystem::remove(probe);
}

std::vector<Row> MeasureFiles::finished_rows(const Circumstances& circumstances) const {
  try {
    const auto earlier = read_measurement(read_file(folder_ / "measure.json", kMostBytes));
    if (earlier && same(earlier->circumstances, circumstances)) return earlier->rows;
  } catch (const IoError&) {
    // there is none
  }
  return {};
}

void MeasureFiles::save_rows(const Measurement& measurement) const {
  write_file(folder_ / "measure.json", to_json(measurement));
}

void MeasureFiles::save_pages(const Measurement& m, const std::string& backend) const {
  write_file(folder_ / "measure.csv", to_csv(m));
  write_file(folder_ / "circumstances.csv", to_csv(m.circumstances));
  std::vector<ReportPage> pages;
  pages.push_back({"overview", draw_overview(m, bars_of(m))});
  for (const ProblemRows& problem : by_problem(m.rows))
    pages.push_back({problem.problem, draw_problem(problem, m)});
  save_pictures(folder_, pages, *theme_named("light"), *backend_named(backend));
}

}  // namespace lantern
