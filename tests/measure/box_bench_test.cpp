// Worlds of boxes, those who find their pairs, and the bench that runs them.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "measure/boxes/bench.hpp"
#include "measure/broad_phase_cost.hpp"

namespace lantern::measure {
namespace {

std::vector<const BoxWorkload*> all_of(BoxTask task) {
  std::vector<const BoxWorkload*> all;
  for (const BoxWorkload& one : box_workloads())
    if (one.task == task) all.push_back(&one);
  return all;
}

std::vector<BoxContestant> everybody() {
  std::vector<std::string> missing;
  auto all = own_box_contestants();
  for (auto& peer : peer_box_contestants(missing)) all.push_back(std::move(peer));
  return all;
}

std::size_t pairs_at(const BoxStage& stage, std::size_t frame) {
  return BoxTruth(stage, frame).judge({}).missed;
}

TEST(BoxWorkloads, AreAsTheirWordsSay) {
  const auto named = [](const char* name) { return *box_workloads_named(name).at(0); };
  EXPECT_EQ(box_workloads_named("uniform").size(), 2u);
  EXPECT_TRUE(box_workloads_named("unifrom").empty());
  const BoxStage coincident = stage_of(named("coincident_2d"), 40, 1);
  EXPECT_EQ(pairs_at(coincident, 0), 40u * 39 / 2);
  EXPECT_EQ(pairs_at(coincident, coincident.frames() - 1), 40u * 39 / 2);
  // Of two boxes, each 1 wide on average, the centres are nearer than 1 on an axis in 2 of 2
  // sqrt(N).
  EXPECT_NEAR(static_cast<double>(pairs_at(stage_of(named("uniform_2d"), 1000, 1), 0)), 500, 100);
  const BoxStage town = stage_of(named("town_3d"), 1000, 1);
  const auto& boxes = std::get<BoxUpdates<3>>(town.scene.boxes).frames;
  EXPECT_NEAR(static_cast<double>(std::ranges::count(boxes[0], true, &Proxy<3>::is_static)), 980,
              15);
  for (std::size_t i = 0; i < 1000; ++i)
    EXPECT_EQ(boxes[0][i].box == boxes[1][i].box, boxes[0][i].is_static) << i;
  EXPECT_EQ(std::get<BoxUpdates<3>>(stage_of(named("town_3d"), 1000, 1).scene.boxes).frames, boxes);
}

TEST(BoxContest, EverybodyFindsWhatBruteForceFinds) {
  for (const BoxTask task :
       {BoxTask::pairs, BoxTask::rays, BoxTask::first_hits, BoxTask::boxes, BoxTask::balls})
    for (const BoxWorkload* workload : all_of(task)) {
      const BoxStage stage = stage_of(*workload, 90, 7);
      const std::vector<std::size_t> frames = {0, 1 % stage.frames(), stage.frames() - 1};
      std::vector<BoxTruth> truths;
      for (const std::size_t frame : frames) truths.emplace_back(stage, frame);
      for (const auto& who : everybody()) {
        if (!who.can(stage)) continue;
        for (const BoxSetting& setting : {who.likely(stage), BoxSetting{1, 0}}) {
          if (!who.has(setting)) continue;
          const auto run = who.start(stage, setting);
          for (std::size_t i = 0; i < frames.size(); ++i) {
            run->step(frames[i]);
            const auto verdict = truths[i].judge(run->found());
            EXPECT_EQ(verdict.missed + verdict.invented, 0u)
                << workload->name << " " << who.name << " " << frames[i];
            EXPECT_TRUE(std::ranges::is_sorted(run->found()));
          }
        }
      }
    }
}

TEST(BoxContest, PairsAreBroughtIntoOrder) {
  std::vector<Pair> pairs = {{3, 9}, {0, 4}, {3, 5}, {0, 1}, {8, 9}};
  into_order(pairs, 10);
  EXPECT_EQ(pairs, (std::vector<Pair>{{0, 1}, {0, 4}, {3, 5}, {3, 9}, {8, 9}}));
  pairs.clear();
  into_order(pairs, 10);
  EXPECT_TRUE(pairs.empty());
}

TEST(BoxTruth, TellsWhatIsMissedAndInvented) {
  const BoxStage stage = stage_of(*box_workloads_named("uniform_2d")[0], 300, 1);
  std::vector<Pair> found = pairs_by_force<2>(std::get<BoxUpdates<2>>(stage.scene.boxes).frames[0]);
  const BoxTruth truth(stage, 0);
  EXPECT_EQ(truth.judge(found).missed + truth.judge(found).invented, 0u);
  found.erase(found.begin() + 5);
  EXPECT_EQ(truth.judge(found).missed, 1u);
  found.push_back({298, 299});
  EXPECT_EQ(truth.judge(found).invented, 1u);
}

// Of many bodies only the pairs of some are known.
TEST(BoxTruth, KnowsASampleOfMany) {
  const BoxStage stage = stage_of(*box_workloads_named("uniform_3d")[0], kMostForced + 1, 1);
  BroadPhaseConfig<3> config;
  config.kind = StructureKind::octree;
  const auto& scene = std::get<BoxUpdates<3>>(stage.scene.boxes);
  config.bounds = scene.bounds;
  BroadPhase<3> broad_phase(config);
  broad_phase.update(scene.frames[0]);
  const BoxTruth truth(stage, 0);
  EXPECT_TRUE(truth.is_sample());
  const auto verdict = truth.judge(broad_phase.pairs());
  EXPECT_EQ(verdict.missed + verdict.invented, 0u);
  EXPECT_GT(truth.judge({}).missed, 500u);
  EXPECT_EQ(truth.words(), "brute force of every 10th body");
}

BoxBenchConfig small_bench(const char* workload) {
  BoxBenchConfig config;
  config.workloads = box_workloads_named(workload);
  config.bodies = {60};
  config.rounds = 3;
  config.seconds = config.search = 1e-3;
  return config;
}

TEST(BoxBench, GivesARowOfEachContestantAtEachWorld) {
  for (const char* workload : {"uniform_2d", "boxes_3d"}) {
    BoxBenchResult result;
    result.config = small_bench(workload);
    result.config.peers = false;
    std::size_t told = 0;
    bench_boxes(result, [&](std::size_t, const std::string&) { ++told; });
    EXPECT_EQ(box_stages(result.config), 1u);
    ASSERT_GE(result.rows.size(), 5u);
    EXPECT_EQ(told, result.rows.size() + 1);
    for (const BoxBenchRow& row : result.rows) {
      EXPECT_EQ(row.status, "ok") << row.contestant << ": " << row.reason;
      EXPECT_EQ(row.timing.repeats, 3);
      EXPECT_EQ(row.found, result.rows[0].found);
      if (row.frames == 1) {  // what is asked lies still
        EXPECT_EQ(row.checked, "brute force");
        EXPECT_FALSE(row.found_in_all);
        continue;
      }
      EXPECT_EQ(row.frames, 24u);
      EXPECT_EQ(row.checked, "brute force at the first two frames");
      EXPECT_GT(row.found_in_all, static_cast<double>(row.found));
      EXPECT_EQ(row.found_in_all, result.rows[0].found_in_all) << row.contestant;
    }
  }
}

TEST(BoxBench, RefusesBeforeAnyWork) {
  const auto refusal = [](const BoxBenchConfig& config) -> std::string {
    BoxBenchResult result;
    result.config = config;
    try {
      bench_boxes(result, [](std::size_t, const std::string&) { FAIL() << "it began"; });
    } catch (const Refused& refused) {
      return refused.what();
    }
    return "";
  };
  BoxBenchConfig config = small_bench("uniform_2d");
  config.peers = false;
  config.only = {"quadtre"};
  EXPECT_NE(refusal(config).find("there is no contestant 'quadtre'; did you mean 'quadtree'?"),
            std::string::npos);
  config.only = {"quadtree"};
  config.workloads = box_workloads_named("clustered_2d");
  config.bodies = {1000000};
  EXPECT_NE(refusal(config).find("the limit is"), std::string::npos);
  config.workloads = box_workloads_named("uniform_2d");
  config.bodies = {100000000};
  EXPECT_NE(refusal(config).find("the budget is"), std::string::npos);
}

// --- counted work ---

std::string work_of(const BoxContestant& who, const BoxStage& stage) {
  const auto run = who.start(stage, who.likely(stage));
  std::uint64_t before = 0;
  for (std::size_t frame = 0; frame < 6; ++frame) {
    before = *run->allocations();
    run->step(frame);
  }
  const BoxCounts c = run->counts();
  const auto told = [](const std::optional<double>& n) { return n ? fmt::format("{}", *n) : "-"; };
  return fmt::format("{} {} {} {} {} {} {} {} {}", stage.workload, who.name, run->found().size(),
                     told(c.pair_tests), told(c.box_tests), told(c.nodes_visited), told(c.nodes),
                     told(c.entries), *run->allocations() - before);
}

// What each of our structures does in the sixth step of each world of 300 boxes. It may become
// less, and then stands in the file anew; more is a regression, and needs a reason.
TEST(CountedWork, IsAsRecorded) {
  const std::string file = LANTERN_ROOT "/tests/measure/counted_work.txt";
  std::string all =
      "# world, structure, pairs, pair tests, box tests, nodes visited, nodes, entries, calls for "
      "memory\n";
  for (const BoxWorkload* workload : all_of(BoxTask::pairs)) {
    const BoxStage stage = stage_of(*workload, 300, 1);
    for (const auto& who : own_box_contestants())
      if (who.can(stage)) all += work_of(who, stage) + "\n";
  }
  if (std::getenv("LANTERN_SET_COUNTED_WORK") != nullptr) std::ofstream(file) << all;
  std::ifstream in(file);
  std::istringstream now(all);
  const char* kRenew =
      "; if that is meant: LANTERN_SET_COUNTED_WORK=1 build/tests/tests_measure "
      "--gtest_filter='CountedWork.*', and commit tests/measure/counted_work.txt";
  for (std::string recorded, counted; std::getline(now, counted);) {
    ASSERT_TRUE(std::getline(in, recorded)) << "not recorded: " << counted << kRenew;
    EXPECT_EQ(counted, recorded) << kRenew;
  }
  std::string rest;
  EXPECT_FALSE(std::getline(in, rest)) << "no longer counted: " << rest << kRenew;
}

}  // namespace
}  // namespace lantern::measure
