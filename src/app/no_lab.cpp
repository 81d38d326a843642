// What stands in for the lab in a build without it (LANTERN_LAB=OFF).
#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/terminal.hpp"
#include "measure/error_metric.hpp"
#include "measure/peers.hpp"

namespace lantern::app {
namespace {

constexpr const char* kNoLab = "this build has no lab; configure it with -DLANTERN_LAB=ON";

int refused(const char* command) {
  complain(fmt::format("{}: {}", command, kNoLab));
  return kUsage;
}

}  // namespace

int measure_command(const MeasureOptions&) { return refused("measure"); }
int stress_command(const StressOptions&) { return refused("stress"); }
int bench_frames_command(const BenchOptions&) { return refused("bench frames"); }
int structure_bench_command(const StructureBenchOptions&) { return refused("structure bench"); }
int bench_atlas_command(const BenchAtlasOptions&) { return refused("bench atlas"); }
int bench_pairs_command(const BenchPairsOptions&) { return refused("bench pairs"); }
int bench_step_command(const BenchStepOptions&) { return refused("bench step"); }

}  // namespace lantern::app

namespace lantern::measure {

// No problem is known, so that none is another one's.
void require_problem(const Scenario&) {}

// As doctor asks for them.
std::vector<std::unique_ptr<Solver>> load_peers(std::vector<std::string>& missing) {
  missing.emplace_back(app::kNoLab);
  return {};
}

std::vector<std::string> box_peer_names(std::vector<std::string>& missing) {
  missing.emplace_back(app::kNoLab);
  return {};
}

}  // namespace lantern::measure
