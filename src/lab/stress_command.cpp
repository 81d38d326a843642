#include <algorithm>

#include <fmt/format.h>

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

struct StressOptions {
  std::vector<std::string> cases;  // names; empty for all that are not slow
  std::string output;              // folder; empty for none
  std::string theme = "light";
  std::string backend = "auto";  // auto, osmesa, egl
  bool list = false;
  bool full = false;  // the slow ones, too
  bool json = false;
};

Options stress_options(StressOptions& o) {
  return {{"CASE", &o.cases, "names of cases; the default is all that are not slow"},
          folder_option(o.output, "folder for stress.csv, stress.json, stability_map.png and .svg"),
          {"--theme", &o.theme, "colours of the stability map", {.words = kThemes}},
          backend_option(o.backend),
          {"--list", &o.list, "list the cases and exit"},
          {"--full", &o.full, "run the slow cases, too"},
          memory_option(),
          json_option(o.json)};
}

// The cases named, in the order of the table; without names all that are not slow, with --full all.
std::vector<StressCase> chosen_cases(const StressOptions& options) {
  std::vector<std::string_view> names;
  for (const StressCase& one : stress_cases()) names.push_back(one.name);
  for (const std::string& name : options.cases)
    if (std::ranges::find(names, name) == names.end()) {
      const std::string hint = suggestion(name, names);
      throw UsageError(fmt::format("there is no case '{}'; {}", name,
                                   hint.empty() ? "see 'lantern stress --list'" : hint));
    }
  std::vector<StressCase> chosen(stress_cases().begin(), stress_cases().end());
  std::erase_if(chosen, [&](const StressCase& one) {
    if (options.cases.empty()) return one.slow && !options.full;
    return std::ranges::find(options.cases, one.name) == options.cases.end();
  });
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

int stress(const StressOptions& options) {
  if (options.list) {
    list_cases(options.json);
    return kGood;
  }
  ReportFolder folder(options.output, "stress");
  const StressReport report = run_all(chosen_cases(options));
  folder.write("stress.csv", to_csv(report));
  folder.write("stress.json", to_json(report));
  options.json ? answer(to_json(report)) : print(to_table(report));
  if (folder.wanted() && report.finished)
    folder.draw({{"stability_map", draw_stability_map(make_stability_map())}}, options.theme,
                options.backend);
  if (stop_asked()) {
    complain("interrupted; what is finished has been reported");
    return kInterrupted;
  }
  folder.finish();
  const bool good =
      std::ranges::all_of(report.outcomes, [](const StressOutcome& o) { return o.result.good; });
  return good ? kGood : kFailed;
}

}  // namespace

app::Run begin_stress(Options& rows) { return command("", "", stress, stress_options).begin(rows); }

}  // namespace lantern::lab
