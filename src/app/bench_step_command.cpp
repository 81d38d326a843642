#include <cmath>

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands.hpp"
#include "app/interrupts.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/terminal.hpp"
#include "base/clock.hpp"
#include "base/counted.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "embedded/version.hpp"
#include "report/bench_step.hpp"

namespace lantern::app {
namespace {

StepBenchConfig config_of(const BenchStepOptions& options) {
  StepBenchConfig config;
  config.seconds = options.seconds.value_or(options.full ? 10 : config.seconds);
  config.longest = options.longest.value_or(options.full ? 600 : config.longest);
  config.only = options.only;
  config.peers = options.peers;
  config.piles = options.full ? all_piles() : usual_piles();
  if (!options.piles.empty()) config.piles.clear();
  for (const std::string& name : options.piles) {
    const auto pile = pile_named(name);
    if (!pile)
      throw UsageError(
          fmt::format("there is no pile '{}'; write boxes2d:500, balls2d:500, "
                      "boxes3d:500 or balls3d:500, with 1 to 100000 bodies",
                      name));
    config.piles.push_back(*pile);
  }
  std::vector<std::string_view> kinds;
  for (const StructureKind kind : kStructureKinds) kinds.push_back(to_string(kind));
  const auto kind = structure_named(options.broad_phase);
  if (!kind || *kind == StructureKind::none)
    throw UsageError(
        with_suggestion(fmt::format("there is no broad phase '{}'", options.broad_phase),
                        options.broad_phase, kinds, kinds.size()));
  for (const Pile& pile : config.piles)
    if (!is_possible(*kind, pile.dimension))
      throw UsageError(fmt::format("{}: an octree needs three dimensions", pile.name()));
  config.structure = *kind;
  return config;
}

// As it would be typed.
std::string command_text(const BenchStepOptions& options) {
  std::string text = "lantern bench step";
  for (const std::string& name : options.piles) text += " --pile " + name;
  if (options.seconds) text += fmt::format(" --seconds {:g}", *options.seconds);
  if (options.longest) text += fmt::format(" --longest {:g}", *options.longest);
  for (const std::string& name : options.only) text += " --only " + name;
  if (options.full) text += " --full";
  if (!options.peers) text += " --no-peers";
  return text + " --broad-phase " + options.broad_phase;
}

}  // namespace

int bench_step_command(const BenchStepOptions& options) {
  StepBenchResult result;
  result.config = config_of(options);
  result.command = command_text(options);
  result.circumstances = here(kVersion, kSourceHash);
  ReportFolder folder(options.output, "bench_step");
  const std::size_t piles = result.config.piles.size();
  say(fmt::format("{}; each solver has {} at each", counted(piles, "pile"),
                  duration_text(result.config.longest)));
  std::size_t begun = 0;
  try {
    Progress progress("bench step", piles, "piles");
    bench_steps(result, [&](const Pile& pile, double share) {
      begun += share == 0;
      progress.tell(fmt::format("pile {} of {}, {}: {:.0f}% of the fall", begun, piles, pile.name(),
                                100 * share));
    });
  } catch (const Stopped&) {
    give_time_to_save();  // piles that are done are reported
  } catch (const Refused& refused) {
    throw UsageError(refused.what());
  }
  for (const std::string& missing : result.missing) say(missing);
  folder.write("bench_step.html", to_html(result));
  folder.write("bench_step.csv", to_csv(result));
  folder.write("bench_step.json", to_json(result));
  options.json ? answer(to_json(result)) : print(to_table(result));
  if (interrupted()) {
    complain("interrupted; the piles that were done have been reported");
    return kInterrupted;
  }
  folder.finish();
  return kGood;
}

}  // namespace lantern::app
