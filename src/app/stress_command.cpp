#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands.hpp"
#include "app/interrupts.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/shard.hpp"
#include "app/shard_record.hpp"
#include "app/stress_files.hpp"
#include "app/terminal.hpp"
#include "base/json_writer.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "embedded/version.hpp"
#include "report/stress_tables.hpp"

namespace lantern::app {
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
  StressReport report{std::string(kVersion), {}, true};
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

// Of the cases those that are the shard's, with the record of it; without --shard all.
class StressShard {
 public:
  StressShard(const StressOptions& options, std::vector<StressCase>& cases)
      : options_(options), shard_(parse_shard(options.shard)), all_(cases) {
    if (!shard_) return;
    if (options.output.empty())
      throw UsageError("--shard needs a folder (-o) for what is to be merged");
    cases.clear();
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (shard_->has(i)) cases.push_back(all_[i]);
  }

  std::string folder() const {
    return shard_ ? shard_->folder_in(options_.output).string() : options_.output;
  }

  void begin() {
    if (!shard_) return;
    ShardRecord record = new_record("stress", *shard_);
    record.settings = {{"theme", options_.theme}};
    for (std::size_t i = 0; i < all_.size(); ++i)
      record.inputs.push_back({std::string(all_[i].name), "", shard_->has(i) ? 1u : 0u});
    folder_.emplace(folder(), std::move(record));
  }

  // The tables of a shard are enough: the map is the same for all, and made when they are merged.
  void finish(const ReportFolder& folder, const StressReport& report) {
    if (!shard_) return draw_stress_map(folder, report, options_.theme, options_.backend);
    if (report.finished) folder_->finish();
  }

 private:
  const StressOptions& options_;
  std::optional<Shard> shard_;
  std::vector<StressCase> all_;
  std::optional<ShardFolder> folder_;
};

}  // namespace

int stress_command(const StressOptions& options) {
  if (options.list) {
    list_cases(options.json);
    return kGood;
  }
  std::vector<StressCase> cases = chosen_cases(options);
  StressShard shard(options, cases);
  ReportFolder folder(shard.folder(), "stress");
  shard.begin();
  const StressReport report = run_all(cases);
  save_stress_tables(folder, report);
  options.json ? answer(to_json(report)) : print(to_table(report));
  shard.finish(folder, report);
  if (interrupted()) {
    complain("interrupted; what is finished has been reported");
    return kInterrupted;
  }
  folder.finish();
  return is_good(report) ? kGood : kFailed;
}

}  // namespace lantern::app
