#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/interrupts.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/terminal.hpp"
#include "base/json_writer.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "lab/commands.hpp"
#include "measure/stress.hpp"
#include "report/pages.hpp"
#include "report/stress_tables.hpp"

namespace lantern::lab {
namespace {

// The cases named, in the order of the table; without names all that are not slow, with --full all.
std::vector<StressCase> chosen_cases(const StressOptions& options) {
  std::vector<std::string_view> names;
  for (const StressCase& one : stress_cases()) names.push_back(one.name);
  for (const std::string& name : options.cases)
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      const std::string hint = suggestion(name, names);
      throw UsageError(fmt::format("there is no case '{}'; {}", name,
                                   hint.empty() ? "see 'lantern stress --list'" : hint));
    }
  std::vector<StressCase> chosen;
  for (const StressCase& one : stress_cases()) {
    const bool named =
        std::find(options.cases.begin(), options.cases.end(), one.name) != options.cases.end();
    if (options.cases.empty() ? options.full || !one.slow : named) chosen.push_back(one);
  }
  return chosen;
}

void list_cases(bool as_json) {
  std::vector<std::vector<std::string>> rows;
  JsonWriter json = answer_of("stress.list");
  json.line().key("cases").begin_array();
  for (const StressCase& one : stress_cases()) {
    rows.push_back({std::string(one.group), std::string(one.name),
                    std::string(one.what) + (one.slow ? " (with --full)" : "")});
    json.line().begin_object().member("name", one.name).member("group", one.group);
    json.member("slow", one.slow).member("what", one.what).end_object();
  }
  json.line().end_array().line().end_object();
  as_json ? answer(json.text()) : print(table(rows));
}

StressReport run_all(const std::vector<StressCase>& cases) {
  StressReport report{here().version, {}, true};
  Progress progress("stress", cases.size(), "cases");
  try {
    for (const StressCase& one : cases) {
      stop_if_asked();
      progress.tell(
          fmt::format("{} of {}, {}", report.outcomes.size() + 1, cases.size(), one.name));
      report.outcomes.push_back(run_case(one));
    }
  } catch (const Stopped&) {
    give_time_to_save();  // what is finished is reported
  }
  report.finished = report.outcomes.size() == cases.size();
  return report;
}

// The stability map, of a finished run.
void draw_stress_map(const ReportFolder& folder, const StressReport& report,
                     const StressOptions& options) {
  if (!folder.wanted() || !report.finished) return;
  const StabilityMap map = make_stability_map();
  folder.draw({{"stability_map", draw_stability_map(map)}}, options.theme, options.backend);
}

bool is_good(const StressReport& report) {
  return std::ranges::all_of(report.outcomes, [](const StressOutcome& o) { return o.result.good; });
}

}  // namespace

int stress_command(const StressOptions& options) {
  if (options.list) {
    list_cases(options.json);
    return kGood;
  }
  ReportFolder folder(options.output, "stress");
  const StressReport report = run_all(chosen_cases(options));
  folder.write("stress.csv", to_csv(report));
  folder.write("stress.json", to_json(report));
  options.json ? answer(to_json(report)) : print(to_table(report));
  draw_stress_map(folder, report, options);
  if (interrupted()) {
    complain("interrupted; what is finished has been reported");
    return kInterrupted;
  }
  folder.finish();
  return is_good(report) ? kGood : kFailed;
}

}  // namespace lantern::lab
