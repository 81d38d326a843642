// The benches, each as what a command runs and as the texts of what it found.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "measure/atlas_bench.hpp"
#include "measure/boxes/bench.hpp"
#include "measure/broad_phase_cost.hpp"
#include "measure/step_bench.hpp"
#include "report/experiment.hpp"
#include "report/frame_bench.hpp"

namespace lantern::report {

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

}  // namespace lantern::report
