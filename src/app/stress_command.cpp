#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/table.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "base/suggest.hpp"
#include "embedded/version.hpp"
#include "measure/stability_map.hpp"
#include "report/pictures.hpp"
#include "report/stability_picture.hpp"
#include "report/stress_tables.hpp"

namespace lantern {
namespace {

namespace fs = std::filesystem;

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

std::string list_text(bool as_json) {
  std::vector<std::vector<std::string>> rows;
  JsonWriter json;
  json.begin_array();
  for (const StressCase& one : stress_cases()) {
    rows.push_back({std::string(one.group), std::string(one.name),
                    std::string(one.what) + (one.slow ? " (with --full)" : "")});
    json.line().begin_object().member("name", one.name).member("group", one.group);
    json.member("slow", one.slow).member("what", one.what).end_object();
  }
  json.line().end_array();
  return as_json ? json.text() + "\n" : table(rows);
}

// Made, and found out to be writable, before the long work. Throws IoError.
void require_writable(const fs::path& folder) {
  make_folder(folder);
  remove_leftovers(folder);
  const fs::path probe = folder / "stress.json";
  std::error_code error;
  const bool was_there = fs::exists(probe, error);
  write_file(was_there ? folder / ".lantern-stress" : probe, "");
  fs::remove(was_there ? folder / ".lantern-stress" : probe, error);
}

// One line on a terminal, rewritten; elsewhere a line for each case that takes long.
class CaseProgress {
 public:
  explicit CaseProgress(std::size_t total) : total_(total) {}
  ~CaseProgress() {
    if (animated()) fmt::print(stderr, "\r\033[K");
  }
  CaseProgress(const CaseProgress&) = delete;
  CaseProgress& operator=(const CaseProgress&) = delete;

  void begin(std::string_view name) {
    ++begun_;
    const std::string line = fmt::format("stress: {} of {}, {}", begun_, total_, name);
    if (animated())
      fmt::print(stderr, "\r{}\033[K", line);
    else if (watch_.seconds() - last_ > kPlainLine)
      say(line);
    else
      return;
    last_ = watch_.seconds();
    std::fflush(stderr);
  }

 private:
  static constexpr double kPlainLine = 5;  // seconds between two plain lines
  std::size_t total_, begun_ = 0;
  double last_ = 0;
  Stopwatch watch_;
};

StressReport run_all(const std::vector<StressCase>& cases) {
  StressReport report{kVersion, {}, true};
  CaseProgress progress(cases.size());
  for (const StressCase& one : cases) {
    if (interrupted()) break;
    progress.begin(one.name);
    report.outcomes.push_back(run_case(one));
  }
  report.finished = report.outcomes.size() == cases.size();
  return report;
}

void write_map(const fs::path& folder, const Theme& theme, Backend backend) {
  const StabilityMap map = make_stability_map([] { return !interrupted(); });
  if (interrupted()) return;
  const ReportPage page{"stability_map", draw_stability_map(map)};
  save_pictures(folder, {&page, 1}, theme, backend);
}

}  // namespace

int stress_command(const StressOptions& options) {
  if (options.list) {
    write_stdout(list_text(options.json));
    return kGood;
  }
  const std::vector<StressCase> cases = chosen_cases(options);
  const fs::path folder = options.output;
  if (!folder.empty()) require_writable(folder);
  const StressReport report = run_all(cases);
  if (!folder.empty()) {
    write_file(folder / "stress.csv", to_csv(report));
    write_file(folder / "stress.json", to_json(report));
  }
  write_stdout(options.json ? to_json(report) : to_table(report));
  if (!folder.empty() && report.finished)
    write_map(folder, *theme_named(options.theme), *backend_named(options.backend));
  if (interrupted()) {
    say("interrupted; what is finished has been reported");
    return kInterrupted;
  }
  const bool good = std::all_of(report.outcomes.begin(), report.outcomes.end(),
                                [](const StressOutcome& o) { return o.result.good; });
  return good ? kGood : kFailed;
}

}  // namespace lantern
