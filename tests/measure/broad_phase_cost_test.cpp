// The counts of the broad phases' costs against recounts that know no structure.
#include "measure/broad_phase_cost.hpp"

#include <set>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/stop.hpp"

namespace lantern::measure {
namespace {

constexpr std::size_t kBodies = 150;

BroadPhaseCostConfig quick() {
  BroadPhaseCostConfig config;
  config.capacities = {1, 4, 16};
  config.depth_limits = {2, 5, 10};
  config.timing.repeats = 0;
  return config;
}

std::vector<BroadPhaseCost> measured(const BoxScene& scene) {
  return measure_broad_phases(scene, quick(), [] {});
}

TEST(BroadPhaseCost, NoStructureMissesOrInventsAPair) {
  for (const std::uint64_t seed : {1, 2, 3})
    for (const BoxScene& scene : seeded_box_scenes(kBodies, seed))
      for (const BroadPhaseCost& row : measured(scene)) {
        EXPECT_EQ(row.counts.missed, 0u) << scene.name << ' ' << to_string(row.kind);
        EXPECT_EQ(row.counts.invented, 0u) << scene.name << ' ' << to_string(row.kind);
        EXPECT_GT(row.counts.true_pairs, 0u) << scene.name << " would test nothing";
      }
}

TEST(BroadPhaseCost, WithheldPairsAreMissedAndAddedOnesInvented) {
  const std::vector<Pair> truth = {{0, 1}, {0, 7}, {2, 3}, {2, 9}, {5, 6}};
  EXPECT_EQ(count_missing(truth, truth), 0u);
  EXPECT_EQ(count_missing(truth, {}), 5u) << "nothing was found, so all are missed";
  for (std::size_t gone = 0; gone < truth.size(); ++gone) {
    std::vector<Pair> found = truth;
    found.erase(found.begin() + static_cast<std::ptrdiff_t>(gone));
    EXPECT_EQ(count_missing(truth, found), 1u) << "pair " << gone << " was withheld";
    EXPECT_EQ(count_missing(found, truth), 0u) << "what is too much is not missing";
  }
  const std::vector<Pair> others = {{0, 2}, {2, 3}, {8, 9}};
  EXPECT_EQ(count_missing(truth, others), 4u);
  EXPECT_EQ(count_missing(others, truth), 2u);
}

// Every pair compared at least once: all that is true is among the candidates.
TEST(BroadPhaseCost, CandidatesLieBetweenTruePairsAndTests) {
  for (const BoxScene& scene : seeded_box_scenes(kBodies, 4))
    for (const BroadPhaseCost& row : measured(scene)) {
      const std::uint64_t all = kBodies * (kBodies - 1) / 2 * row.updates;
      EXPECT_GE(row.counts.candidates, row.counts.true_pairs) << scene.name;
      EXPECT_LE(row.counts.candidates, row.counts.pair_tests) << scene.name;
      EXPECT_LE(row.counts.candidates, all) << "a pair was counted twice in " << scene.name;
      EXPECT_GE(row.counts.entries, kBodies * row.updates) << "a body lies in no leaf";
      if (row.kind == StructureKind::sort_and_sweep) {
        EXPECT_EQ(row.counts.work(), row.counts.pair_tests) << "a pair counts twice";
      }
      if (row.kind == StructureKind::brute_force) {
        EXPECT_EQ(row.counts.pair_tests, all);
        EXPECT_EQ(row.counts.work(), all) << "it compares nothing but pairs";
        EXPECT_EQ(row.counts.false_candidates(), all - row.counts.true_pairs);
      }
    }
}

// The tree once more, from outside: leaves of a plain quadtree, their pairs in a set.
TEST(BroadPhaseCost, TheQuadtreesCountsAreThoseOfARecount) {
  for (const BoxScene& scene : seeded_box_scenes(kBodies, 5)) {
    if (scene.dimension() != 2 || scene.name == "moving_2d") continue;
    const auto& boxes = std::get<BoxUpdates<2>>(scene.boxes);
    const std::vector<BroadPhaseCost> rows = measured(scene);
    for (const std::uint32_t capacity : quick().capacities) {
      const auto tree = make_structure<2>(
          StructureKind::quadtree, {.bounds = boxes.bounds, .capacity = capacity, .max_depth = 5});
      for (const Proxy<2>& box : boxes.frames[0]) tree->insert({box.id, box.box});
      std::set<std::pair<BodyId, BodyId>> candidates;
      std::uint64_t tests = 0, entries = 0;
      tree->visit([&](const NodeView<2>& node) {
        entries += node.bodies.size();
        for (const BodyId a : node.bodies)
          for (const BodyId b : node.bodies)
            if (a < b) {
              candidates.insert({a, b});
              ++tests;
            }
        return true;
      });
      const BroadPhaseCost* row = row_of(rows, scene.name, StructureKind::quadtree, capacity, 5);
      ASSERT_NE(row, nullptr);
      EXPECT_EQ(row->counts.candidates, candidates.size()) << scene.name << ' ' << capacity;
      EXPECT_EQ(row->counts.pair_tests, tests) << scene.name << ' ' << capacity;
      EXPECT_EQ(row->counts.entries, entries) << scene.name << ' ' << capacity;
    }
  }
}

TEST(BroadPhaseCost, CountsRepeatExactly) {
  const BoxScene a = seeded_box_scenes(kBodies, 6)[1], b = seeded_box_scenes(kBodies, 6)[1];
  const std::vector<BroadPhaseCost> first = measured(a), second = measured(b);
  ASSERT_EQ(first.size(), second.size());
  ASSERT_EQ(first.size(), broad_phase_rows(a, quick()));
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_EQ(first[i].counts, second[i].counts) << "row " << i << " depends on more than the seed";
  const std::vector<BroadPhaseCost> other = measured(seeded_box_scenes(kBodies, 7)[1]);
  EXPECT_FALSE(
      std::ranges::equal(other, first, {}, &BroadPhaseCost::counts, &BroadPhaseCost::counts))
      << "another seed gives the same boxes";
}

TEST(BroadPhaseCost, TheCheapestRowIsNoDearerThanAnyOther) {
  for (const BoxScene& scene : seeded_box_scenes(kBodies, 8)) {
    const std::vector<BroadPhaseCost> rows = measured(scene);
    for (const StructureKind kind : kStructureKinds) {
      const BroadPhaseCost* best = cheapest(rows, scene.name, kind, CostBy::work);
      for (const BroadPhaseCost& row : rows) {
        if (row.kind != kind) continue;
        ASSERT_NE(best, nullptr);
        EXPECT_LE(best->counts.work(), row.counts.work());
        if (best->counts.work() == row.counts.work()) {
          EXPECT_LE(best->depth_limit, row.depth_limit) << "among equals the shallower limit";
        }
      }
    }
  }
}

TEST(BroadPhaseCost, EndsWhenToldTo) {
  const BoxScene scene = seeded_box_scenes(kBodies, 9)[0];
  int rows = 0;
  const auto told = [&] {
    if (++rows == 5) ask_to_stop();
  };
  EXPECT_THROW(measure_broad_phases(scene, quick(), told), Stopped);
  forget_stop();
  EXPECT_EQ(rows, 5);
}

TEST(BroadPhaseCost, ASceneOfAScenarioHasTheBodiesThatEnter) {
  const char* text = R"(
title = "two and a late one"
[world]
min = [0, 0]
max = [16, 16]
[structure]
kind = "quadtree"
[[body]]
name = "a"
position = [2, 2]
half_size = [1, 1]
[[body]]
name = "b"
position = [3, 3]
half_size = [1, 1]
[[body]]
name = "late"
position = [3, 3]
half_size = [1, 1]
[[step]]
do = "insert"
bodies = ["a"]
[[step]]
do = "insert"
bodies = ["b"]
[[step]]
do = "run"
seconds = 0.1
[[step]]
do = "insert"
bodies = ["late"]
)";
  const BoxScene scene = box_scene_of(parse_scenario(text, "two.toml"));
  EXPECT_EQ(scene.name, "two");
  const auto& boxes = std::get<BoxUpdates<2>>(scene.boxes);
  ASSERT_EQ(boxes.frames.size(), 1u);
  ASSERT_EQ(boxes.frames[0].size(), 2u) << "what enters after the run is of another moment";
  EXPECT_EQ(boxes.frames[0][1].box, (Box<2>{{2, 2}, {4, 4}}));
  EXPECT_EQ(boxes.bounds, (Box<2>{{0, 0}, {16, 16}}));
  for (const BroadPhaseCost& row : measured(scene)) EXPECT_EQ(row.counts.true_pairs, 1u);
}

}  // namespace
}  // namespace lantern::measure
