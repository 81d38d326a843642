// The rounds of one stage of `bench pairs`: each contestant's best setting, its turns, and whether
// what it found is right.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "measure/box_bench.hpp"
#include "measure/box_truth.hpp"

namespace lantern::measure {

// Seconds of the processor for a step of a fresh run with this setting, warm; infinite if it is
// refused.
double tried(const BoxContestant& who, const BoxStage& stage, const BoxSetting& setting);

class StageBench {
 public:
  // The settings that were best, and for how many bodies; by workload and contestant.
  using Known = std::map<std::pair<std::string, std::string>, std::pair<BoxSetting, std::size_t>>;

  // Both outlive this.
  StageBench(const BoxBenchConfig& config, const BoxStage& stage)
      : config_(config), stage_(stage), second_(stage, 1 % stage.frames()) {}

  // Looks for its best setting, from the one that was best for fewer bodies, and warms it up;
  // nothing of it if there is a reason to leave it out.
  void enter(const BoxContestant& who, const std::optional<std::string>& left_out, Known& known);
  void run_rounds();
  // Judged; to be called once.
  std::vector<BoxBenchRow> rows();

 private:
  // A contestant on its way.
  struct Entry {
    const BoxContestant* who = nullptr;
    BoxBenchRow row = {};
    std::unique_ptr<BoxRun> run = nullptr;
    double step_seconds = 0;  // about
    std::size_t turn = 0;
    std::vector<double> seconds = {};  // of the processor, a step
    std::vector<double> wall = {};     // by the clock
    std::vector<double> calls = {};    // for memory, a step
    std::uint64_t hash = 0;            // of what it found
  };

  static void refuse(Entry& e, const char* status, std::string reason);
  BoxSetting likely(const BoxContestant& who, const Known& known) const;
  void warm_up(Entry& e, const BoxSetting& setting);
  double step(Entry& e);
  void take_turn(Entry& e);
  static void judge(Entry& e, const BoxTruth& truth);
  void check();
  void compare(const std::map<std::uint64_t, int>& how_many);

  const BoxBenchConfig& config_;
  const BoxStage& stage_;
  BoxTruth second_;  // of the second frame, at which each is looked at on its way in
  std::vector<Entry> entries_;
};

}  // namespace lantern::measure
