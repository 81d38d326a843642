// `structure bench`: structures beside each other, in turns.
#include <algorithm>

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/structure_names.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "measure/structure_bench.hpp"

namespace lantern::app {

int structure_bench_command(const StructureBenchOptions& options) {
  StructureBench bench;
  bench.kinds = structures_called(options.names);
  // What all the others are held against.
  if (std::ranges::find(bench.kinds, StructureKind::brute_force) == bench.kinds.end())
    bench.kinds.insert(bench.kinds.begin(), StructureKind::brute_force);
  bench.bodies.assign(options.bodies.begin(), options.bodies.end());
  if (bench.bodies.empty()) bench.bodies = {100, 400, 1600};
  bench.seed = options.seed;
  bench.rounds = options.rounds;
  ReportFolder folder(options.output, "bench_structure");
  std::vector<StructureTime> rows;
  {
    Progress progress("structure bench", structure_bench_rows(bench), "rows");
    std::uint64_t done = 0;
    rows = bench_structures(bench, [&] { progress.done(++done); });
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

}  // namespace lantern::app
