// `structure bench`: structures beside each other, in turns.
#include <algorithm>

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands/command.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/structure_names.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "spatial/structure_trial.hpp"

namespace lantern::app {
namespace {

struct StructureBenchOptions {
  std::vector<std::string> names;  // empty for all
  std::vector<int> bodies;         // empty for the usual numbers
  std::uint64_t seed = 1;
  int rounds = 9;
  std::string output;  // folder; empty for none
  bool json = false;
};

Options structure_bench_options(StructureBenchOptions& o) {
  return {{"NAME", &o.names, "structures; the default is all of them"},
          {"--bodies",
           &o.bodies,
           "how many bodies; the default is 100, 400 and 1600",
           {.value = "N", .least = 2, .most = 1'000'000, .one_each = true}},
          seed_option(o.seed, "of the random worlds"),
          {"--rounds", &o.rounds, "repeats; the median counts", {.least = 1, .most = 1000}},
          {"-o,--output", &o.output, "folder for bench_structure.csv and .json", {.value = "DIR"}},
          memory_option(),
          json_option(o.json)};
}

int bench(const StructureBenchOptions& options) {
  StructureBench trial;
  trial.kinds = structures_called(options.names);
  // What all the others are held against.
  if (std::ranges::find(trial.kinds, StructureKind::brute_force) == trial.kinds.end())
    trial.kinds.insert(trial.kinds.begin(), StructureKind::brute_force);
  trial.bodies.assign(options.bodies.begin(), options.bodies.end());
  if (trial.bodies.empty()) trial.bodies = {100, 400, 1600};
  trial.seed = options.seed;
  trial.rounds = options.rounds;
  ReportFolder folder(options.output, "bench_structure");
  std::vector<StructureTime> rows;
  {
    Progress progress("structure bench", structure_bench_rows(trial), "rows");
    std::uint64_t done = 0;
    rows = bench_structures(trial, [&] { progress.done(++done); });
  }
  const std::string json = to_json(rows, options.seed);
  folder.write("bench_structure.csv", to_csv(rows));
  folder.write("bench_structure.json", json);
  folder.finish();
  options.json ? answer(json) : print(to_table(rows));
  const bool good = std::ranges::all_of(rows, [](const StructureTime& row) {
    return row.fault.empty() && row.missed + row.invented == 0;
  });
  return good ? kGood : kFailed;
}

}  // namespace

Command structure_bench_command() {
  return command("bench", "Time structures beside each other and brute force, in turns", bench,
                 structure_bench_options);
}

}  // namespace lantern::app
