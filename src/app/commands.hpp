// The lab's commands: what each is told, and its exit code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/command.hpp"

namespace lantern::app {

struct StructureBenchOptions {
  std::vector<std::string> names;  // empty for all
  std::vector<int> bodies;         // empty for the usual numbers
  std::uint64_t seed = 1;
  int rounds = 9;
  std::string output;  // folder; empty for none
  bool json = false;
};
int structure_bench_command(const StructureBenchOptions& options);

struct MeasureOptions {
  std::vector<std::string> problems;  // names, families or files; empty for all
  std::string output = "output/measure";
  std::vector<std::string> methods;  // empty for those of each problem
  std::vector<double> steps;         // seconds; empty for those of each problem
  std::vector<std::string> from;     // earlier measurements: only their page is made
  bool quick = false;
  bool full = false;
  std::optional<double> longest;  // processor seconds of one run; longer ones are left out
  bool peers = true;
  std::string theme = "light";
  std::string backend = "auto";
  bool list = false;
  bool json = false;
};
int measure_command(const MeasureOptions& options);

struct BenchOptions {
  std::vector<std::string> scenarios;  // files; empty for some of those that come with Lantern
  int rounds = 5;
  int frames = 40;     // of a sequence, at most
  std::string output;  // folder; empty for none
  bool json = false;
};
int bench_frames_command(const BenchOptions& options);

struct BenchStepOptions {
  std::vector<std::string> piles;  // "boxes2d:2000"; empty for the usual ones
  std::optional<double> seconds;   // of the fall
  std::optional<double> longest;   // seconds of computing for a solver at a pile
  std::vector<std::string> only;   // solvers; empty for all
  std::string broad_phase = "sort_and_sweep";
  std::string output;  // folder; empty for none
  bool full = false;   // all piles, for as long as it takes
  bool peers = true;
  bool json = false;
};
int bench_step_command(const BenchStepOptions& options);

struct BenchAtlasOptions {
  std::vector<std::string> sets;      // names; empty for all
  std::vector<std::uint64_t> counts;  // textures; empty for the usual numbers
  std::string sizes;                  // a file of one's own textures instead of sets
  std::string atlas;                  // "1024x1024"; empty for the smallest square
  std::vector<std::string> only;      // contestants; empty for all
  int rounds = 15;
  std::uint64_t seed = 1;
  std::string output;  // folder; empty for none
  bool peers = true;
  bool json = false;
};
int bench_atlas_command(const BenchAtlasOptions& options);

struct BenchPairsOptions {
  std::vector<std::string> workloads;  // names; empty for all
  std::vector<std::uint64_t> bodies;   // empty for those of each workload
  std::vector<std::string> only;       // contestants; empty for all
  std::string boxes;                   // a file of one's own, instead of workloads
  std::uint64_t seed = 1;
  int rounds = 9;
  std::optional<double> seconds;  // of each contestant's rounds
  std::optional<double> longest;  // seconds of a step
  std::string output;             // folder; empty for none
  bool full = false;
  bool peers = true;
  bool json = false;
};
int bench_pairs_command(const BenchPairsOptions& options);

struct StressOptions {
  std::vector<std::string> cases;  // names; empty for all that are not slow
  std::string output;              // folder; empty for none
  std::string theme = "light";
  std::string backend = "auto";  // auto, osmesa, egl
  bool list = false;
  bool full = false;  // the slow ones, too
  bool json = false;
};
int stress_command(const StressOptions& options);

struct MeasureBroadPhaseOptions {
  std::vector<std::string> files;  // scenarios; empty for worlds of its own
  std::string output;              // folder of table, CSV, JSON and plots; empty: only the table
  std::string theme = "light";     // of the plots
  bool full = false;               // more and longer repeats
  bool json = false;
};
// Pairs missed, work and time of the broad phases over capacity and depth limit.
int measure_broad_phase_command(const MeasureBroadPhaseOptions& options);

}  // namespace lantern::app
