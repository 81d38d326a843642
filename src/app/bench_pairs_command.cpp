#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands.hpp"
#include "app/interrupts.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/terminal.hpp"
#include "base/counted.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "embedded/version.hpp"
#include "measure/box_files.hpp"
#include "report/bench_pairs.hpp"

namespace lantern::app {
namespace {

std::vector<const BoxWorkload*> workloads_of(const BenchPairsOptions& options) {
  std::vector<const BoxWorkload*> all;
  std::vector<std::string_view> names;
  for (const BoxWorkload& one : box_workloads()) {
    names.push_back(one.name);
    if (options.workloads.empty()) all.push_back(&one);
  }
  for (const std::string& name : options.workloads) {
    const auto found = box_workloads_named(name);
    if (found.empty())
      throw UsageError(with_suggestion(fmt::format("there is no workload '{}'", name), name, names,
                                       names.size()));
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

BoxBenchConfig config_of(const BenchPairsOptions& options) {
  BoxBenchConfig config;
  config.bodies = options.bodies;
  config.full = options.full;
  config.only = options.only;
  config.peers = options.peers;
  config.rounds = options.rounds;
  config.seed = options.seed;
  config.seconds = options.seconds.value_or(options.full ? 4 : config.seconds);
  config.longest = options.longest.value_or(options.full ? 10 : config.longest);
  config.search = options.full ? 4 : config.search;
  if (options.boxes.empty())
    config.workloads = workloads_of(options);
  else
    config.own = read_boxes(options.boxes, options.seed);
  return config;
}

// As it would be typed.
std::string command_text(const BenchPairsOptions& options) {
  std::string text = "lantern bench pairs";
  for (const std::string& name : options.workloads) text += " --workload " + name;
  for (const std::uint64_t n : options.bodies) text += fmt::format(" --bodies {}", n);
  for (const std::string& name : options.only) text += " --only " + name;
  if (!options.boxes.empty()) text += " --boxes " + options.boxes;
  if (options.full) text += " --full";
  if (!options.peers) text += " --no-peers";
  if (options.seconds) text += fmt::format(" --seconds {:g}", *options.seconds);
  if (options.longest) text += fmt::format(" --longest {:g}", *options.longest);
  return text + fmt::format(" --rounds {} --seed {}", options.rounds, options.seed);
}

}  // namespace

int bench_pairs_command(const BenchPairsOptions& options) {
  BoxBenchResult result;
  result.config = config_of(options);
  result.command = command_text(options);
  result.circumstances = here(kVersion, kSourceHash);
  ReportFolder folder(options.output, "bench_pairs");
  const std::size_t stages = box_stages(result.config);
  try {
    Progress progress("bench pairs", stages, "worlds");
    bench_boxes(result, [&](std::size_t stage, const std::string& words) {
      progress.tell(fmt::format("world {} of {}, {}", stage + 1, stages, words));
    });
  } catch (const Stopped&) {
    give_time_to_save();  // worlds that are done are reported
  } catch (const Refused& refused) {
    throw UsageError(refused.what());
  }
  for (const std::string& missing : result.missing) say(missing);
  folder.write("bench_pairs.html", to_html(result));
  folder.write("bench_pairs.csv", to_csv(result));
  folder.write("bench_pairs.json", to_json(result));
  options.json ? answer(to_json(result)) : print(to_table(result));
  if (interrupted()) {
    complain("interrupted; the worlds that were done have been reported");
    return kInterrupted;
  }
  folder.finish();
  return std::ranges::all_of(result.rows, &BoxBenchRow::is_good) ? kGood : kFailed;
}

}  // namespace lantern::app
