// The benches, each as what a command runs and as the texts of what it found.
#pragma once

#include "draw/theme.hpp"
#include "measure/atlas_bench.hpp"
#include "measure/boxes/bench.hpp"
#include "measure/broad_phase_cost.hpp"
#include "measure/step_bench.hpp"
#include "render/context.hpp"
#include "report/experiment.hpp"

namespace lantern::report {

// How fast draw lists become files, beside cairo with its own PNG writer in the same run.

// The frames of a scenario, one after another.
struct FrameSequence {
  std::string name;
  std::vector<DrawList> lists;
};

struct FrameBenchConfig {
  int width = 1920, height = 1080;
  std::size_t most_frames = 40;  // of a sequence; those that differ from the one before
  int rounds = 5;                // writers take turns
  int threads = 2;               // that encode, beside the one that draws
  Backend backend = Backend::automatic;
  Theme theme;
};

// One writer at one sequence. Medians and quartiles of the rounds; what is counted is the same in
// all of them.
struct FrameRow {
  std::string sequence, writer;
  std::size_t frames = 0;        // each differs from the one before
  double frames_per_second = 0;  // from draw list to file
  double lower_quartile = 0, upper_quartile = 0;
  std::optional<double> against_cairo;  // times as fast as cairo on one thread in the same round
  double bytes_per_file = 0;
  // Of ours alone.
  std::optional<std::uint64_t> pixels_drawn, bands_packed, bands_kept;
};

// Over all sequences, each counting as much.
struct FrameMean {
  std::string writer;
  std::optional<double> against_cairo;
  double bytes_per_file = 0;
};

// From the start of a new process: medians, in seconds.
struct StartTimes {
  bool shaders_known = false;  // whether Mesa kept compiled shaders from an earlier process
  double bare_context = 0;
  double first_file = 0;  // a finished frame of 1280 x 720 on disk
};

struct FrameBenchResult : BenchResult<FrameBenchConfig, FrameRow> {
  std::string cairo;  // version; empty without it
  std::vector<StartTimes> starts;
};

// Writes into `folder`, which must
// be there, and removes its files again. `begun` is called before each sequence, with its number.
// Forks to measure starts: to be called before other threads or a graphics library are there.
// Without cairo its rows are missing. Throws Refused (no sequences, one in which nothing changes,
// no rounds), BackendError, IoError, and Stopped, with the sequences that were done in the result.
void bench_frames(FrameBenchResult& result, std::vector<FrameSequence> sequences,
                  const std::filesystem::path& folder,
                  const std::function<void(std::size_t)>& begun);

std::vector<FrameMean> means_of(const FrameBenchResult& result);

// The file of the scenario that a word means.
using ScenarioFinder = std::function<std::string(const std::string&)>;

std::unique_ptr<Experiment> frames_bench(ScenarioFinder find);
std::unique_ptr<Experiment> pairs_bench();
std::unique_ptr<Experiment> atlas_bench();
std::unique_ptr<Experiment> step_bench();
// Of scenario files; without any of seeded scenes. `full`: more and longer repeats.
std::unique_ptr<Experiment> broad_phases(std::vector<std::string> files, bool full);

// Of formats "lantern.bench.frames/2", "lantern.bench.pairs/1" and so on; CSV has a line a
// contestant and stage.
Texts texts_of(const FrameBenchResult& result);
Texts texts_of(const BoxBenchResult& result);
Texts texts_of(const AtlasBenchResult& result);
Texts texts_of(const StepBenchResult& result);
Texts texts_of(const BroadPhaseResult& result);  // its table and page have the cheapest settings

// One whose result is a BenchResult.
template <class Result>
class ExperimentOf : public Experiment {
 public:
  void set_circumstances(Circumstances circumstances, std::string command) override {
    result_.circumstances = std::move(circumstances);
    result_.command = std::move(command);
  }
  std::vector<std::string> missing() const override { return result_.missing; }
  Texts texts() const override { return texts_of(result_); }

 protected:
  Result result_;
};

}  // namespace lantern::report
