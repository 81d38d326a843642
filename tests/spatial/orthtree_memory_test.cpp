// The lecture's advice on memory: one array for all leaves, and nodes that are used again.
#include <bit>
#include <map>

#include <gtest/gtest.h>

#include "spatial/picture.hpp"
#include "spatial/trees/node_parts.hpp"
#include "spatial/trees/orthtree.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::Sort;

TEST(OrthtreeMemory, TheNextBuildReusesAllOfIt) {
  Random random(3);
  const auto items = testing::random_world<2>(Sort::uniform, 500, random);
  for (const bool stop : {false, true}) {
    testing::TreeConfig<2> config;
    config.bounds = testing::bounds_of<2>(Sort::uniform);
    config.no_progress_stop = stop;
    Quadtree tree(config);
    for (const auto& item : items) tree.insert(item);
    const Counters first = tree.counters();
    EXPECT_EQ(first.nodes_reused, 0u) << "there was nothing to reuse";
    EXPECT_GT(first.allocations, 0u);
    const auto picture = testing::picture_of<2>(tree);
    tree.clear();
    EXPECT_EQ(tree.counters().nodes, 1u);
    EXPECT_EQ(tree.counters().entries, 0u);
    for (const auto& item : items) tree.insert(item);
    const Counters second = tree.counters();
    EXPECT_EQ(second.allocations, first.allocations) << "memory was asked for again";
    EXPECT_EQ(second.nodes_reused, second.nodes);
    EXPECT_EQ(second.box_tests, first.box_tests) << "the count of tests was not begun anew";
    EXPECT_EQ(testing::picture_of<2>(tree), picture) << "something of the old tree is left";
  }
}

TEST(OrthtreeMemory, CountersAgreeWithTheTreeThatStands) {
  Random random(4);
  testing::TreeConfig<3> config;
  config.bounds = testing::bounds_of<3>(Sort::clustered);
  Octree tree(config);
  for (const auto& item : testing::random_world<3>(Sort::clustered, 100, random)) tree.insert(item);
  Counters seen;
  tree.visit([&](const NodeView<3>& view) {
    ++seen.nodes;
    seen.leaves += view.leaf;
    seen.depth = std::max<std::uint64_t>(seen.depth, view.depth);
    seen.entries += view.bodies.size();
    return true;
  });
  const Counters c = tree.counters();
  EXPECT_EQ(c.nodes, seen.nodes);
  EXPECT_EQ(c.leaves, seen.leaves);
  EXPECT_EQ(c.depth, seen.depth);
  EXPECT_EQ(c.entries, seen.entries);
}

TEST(OrthtreeMemory, AHundredThousandAtOnePlaceNeitherHangNorSwell) {
  const Box<2> corner{Vec<2>(32.0), Vec<2>(32.0)};  // in all four children of the root
  testing::TreeConfig<2> config;
  config.bounds = {{0, 0}, {64, 64}};
  config.max_depth = 10;
  Quadtree deep(config);
  for (BodyId id = 0; id < 100'000; ++id) deep.insert({100'000 - id, corner});
  EXPECT_EQ(deep.counters().entries, 400'000u) << "4 leaves meet at the corner, each holds all";
  EXPECT_EQ(deep.counters().nodes, 1u + 4u * 10u);

  config.no_progress_stop = true;
  Quadtree shallow(config);
  for (BodyId id = 0; id < 100'000; ++id) shallow.insert({id, corner});
  EXPECT_EQ(shallow.counters().nodes, 1u);
}

TEST(OrthtreeMemory, TheBudgetIsKeptAndTheTreeCanBeClearedAfterwards) {
  testing::TreeConfig<2> config;
  config.bounds = {{0, 0}, {64, 64}};
  config.capacity = 1;
  config.max_depth = 32;
  config.most_entries = 1000;
  Quadtree tree(config);
  tree.insert({1, {Vec<2>(8.0), Vec<2>(56.0)}});
  try {
    tree.insert({2, {Vec<2>(8.0), Vec<2>(56.0)}});
    FAIL() << "a tree of 4^32 nodes was built";
  } catch (const Refused& refused) {
    const std::string text = refused.what();
    for (const char* part : {"body 2", "1000", "max_depth (32)", "capacity (1)", "no-progress"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
  EXPECT_LE(tree.counters().nodes, 1000u);
  EXPECT_LE(tree.counters().entries, 1000u);
  EXPECT_EQ(testing::picture_of<2>(tree).size(), tree.counters().nodes) << "cannot be visited";
  tree.clear();
  tree.insert({3, {Vec<2>(8.0), Vec<2>(56.0)}});
  EXPECT_EQ(testing::picture_of<2>(tree).at(0).bodies, std::vector<BodyId>{3});
}

// How often a list that doubles asks for memory until it has n elements.
std::uint64_t doublings(std::uint64_t n) {
  return static_cast<std::uint64_t>(std::bit_width(n - 1)) + 1;
}

TEST(OrthtreeMemory, BlocksOfSplitLeavesGoToNewOnes) {
  Random random(8);
  testing::TreeConfig<2> config;
  config.bounds = {{0, 0}, {64, 64}};
  config.capacity = 1;
  config.max_depth = 32;
  Quadtree tree(config);
  for (BodyId pair = 0; pair < 64; ++pair) {
    const Vec<2> p = random_point<2>(random, 0, 64);
    for (BodyId i = 0; i < 2; ++i) tree.insert({2 * pair + i, {p, p}});
  }
  const Counters c = tree.counters();
  ASSERT_GT(c.splits, 10 * (c.depth + c.leaves)) << "the test would prove nothing";
  // One block for each leaf, and those on the way down that wait until all are handed down.
  EXPECT_LE(c.allocations, doublings(c.nodes) + doublings(c.splits) + doublings(128) +
                               doublings(c.depth + c.leaves));
}

TEST(LeafArray, BlocksGivenBackAreUsedAgain) {
  LeafArray array(3);
  LeafArray::Run run;
  for (std::uint32_t i = 0; i < 1000; ++i) array.append(run, i);
  array.release(run);
  const std::size_t places = array.places();
  EXPECT_EQ(places, 2048u - 4u) << "blocks of 4, 8, ... 1024";
  LeafArray::Run next;
  for (std::uint32_t i = 0; i < 1000; ++i) array.append(next, i);
  EXPECT_EQ(array.places(), places);
  array.clear();
  EXPECT_EQ(array.places(), 0u);
  const std::uint64_t allocations = array.allocations();
  LeafArray::Run again;
  for (std::uint32_t i = 0; i < 1000; ++i) array.append(again, i);
  EXPECT_EQ(array.allocations(), allocations);
}

// Runs that grow, are given back and grow again never overlap, against a map as the oracle.
TEST(LeafArray, KeepsEveryRunWhole) {
  Random random(6);
  LeafArray array(3);
  std::map<int, std::vector<std::uint32_t>> expected;
  std::map<int, LeafArray::Run> runs;
  for (std::uint32_t step = 0; step < 20'000; ++step) {
    const int leaf = static_cast<int>(random.whole(0, 30));
    if (random.whole(0, 40) == 0) {
      array.release(runs[leaf]);
      runs[leaf] = {};
      expected[leaf].clear();
    } else {
      array.append(runs[leaf], step);
      expected[leaf].push_back(step);
    }
    const auto values = array.values(runs[leaf]);
    ASSERT_TRUE(
        std::equal(values.begin(), values.end(), expected[leaf].begin(), expected[leaf].end()));
  }
  for (const auto& [leaf, run] : runs) {
    const auto values = array.values(run);
    ASSERT_TRUE(
        std::equal(values.begin(), values.end(), expected[leaf].begin(), expected[leaf].end()));
  }
}

}  // namespace
}  // namespace lantern::spatial
