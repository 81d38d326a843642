// Every structure gives the pairs that brute force gives.
#include "spatial/pairs.hpp"

#include <gtest/gtest.h>

#include "spatial/box_worlds.hpp"
#include "spatial/trees/brute_force.hpp"
#include "spatial/trees/bsp.hpp"
#include "spatial/trees/orthtree.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::Sort;

template <int D>
void expect_equal_pairs(Sort sort, std::uint64_t seed) {
  SCOPED_TRACE(fmt::format("{}D, sort {}, seed {}", D, static_cast<int>(sort), seed));
  Random random(seed);
  const auto items = testing::random_world<D>(sort, 40, random);
  const auto expected = testing::true_overlaps(items);
  const auto pairs_of = [&](auto structure) {
    for (const auto& item : items) structure.insert(item);
    return testing::overlapping_pairs(
        structure, [&](BodyId id) { return testing::box_of(items, id); }, 10'000'000);
  };
  const Box<D> bounds = testing::bounds_of<D>(sort);
  testing::TreeConfig<D> config;
  config.bounds = bounds;
  config.max_depth = 3;
  EXPECT_EQ(pairs_of(BruteForce<D>()), expected);
  EXPECT_EQ(pairs_of(Orthtree<D>(config)), expected);
  Vec<D> normal(1.0);
  normal[0] = -0.3;
  const Vec<D> center = bounds.center();
  EXPECT_EQ(
      pairs_of(Bsp<D>(testing::bsp_config<D>({{Plane<D>::through(center, normal), kNone, false},
                                              {Plane<D>::through(center, Vec<D>(1.0)), 0, true}},
                                             bounds))),
      expected);
}

TEST(Pairs, OverlappingPairsAreTheSameInEveryStructure) {
  for (const Sort sort : testing::kSorts)
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      expect_equal_pairs<2>(sort, seed);
      expect_equal_pairs<3>(sort, seed);
    }
}

TEST(Pairs, TouchingIsOverlapping) {
  testing::TreeConfig<2> config;
  config.bounds = {{0, 0}, {64, 64}};
  config.capacity = 1;
  Quadtree tree(config);
  const std::vector<Item<2>> items = {{1, {{30, 30}, {32, 32}}}, {2, {{32, 32}, {34, 34}}}};
  for (const auto& item : items) tree.insert(item);
  const auto pairs = testing::overlapping_pairs(
      tree, [&](BodyId id) { return testing::box_of(items, id); }, 1000);
  EXPECT_EQ(pairs, (std::vector<Pair>{{1, 2}})) << "two boxes that touch at a split were parted";
}

TEST(Pairs, TooManyAreRefusedBeforeTheyAreCollected) {
  BruteForce<2> all;
  for (BodyId id = 0; id < 100; ++id) all.insert({id, {{0, 0}, {1, 1}}});
  EXPECT_EQ(count_pair_tests(all), 4950u);
  EXPECT_NO_THROW(candidate_pairs(all, 4950));
  EXPECT_THROW(candidate_pairs(all, 4949), Refused);
}

TEST(Pairs, AllPairsOfNone) {
  EXPECT_EQ(all_pairs(0), 0u);
  EXPECT_EQ(all_pairs(1), 0u);
  EXPECT_EQ(all_pairs(4), 6u);
}

TEST(BruteForce, HoldsAllInOneLeafAscending) {
  BruteForce<2> all;
  for (const BodyId id : {9u, 0xffffffffu, 3u})
    all.insert({id, Box<2>::around({1.0 * id, 0}, {1, 1})});
  int nodes = 0;
  all.visit([&](const NodeView<2>& view) {
    ++nodes;
    EXPECT_EQ(std::vector<BodyId>(view.bodies.begin(), view.bodies.end()),
              (std::vector<BodyId>{3, 9, 0xffffffff}));
    EXPECT_EQ(view.box, (Box<2>{{2, -1}, {4294967296.0, 1}}));
    return true;
  });
  EXPECT_EQ(nodes, 1);
  EXPECT_EQ(testing::near_in(all, Box<2>{}).size(), 3u);
  EXPECT_EQ(all.counters().entries, 3u);
  all.clear();
  EXPECT_EQ(all.counters().entries, 0u);
}

// Its one leaf has no limit that a count could pass.
TEST(BruteForce, TellsThatItsLeafHasNoLimit) {
  BruteForce<2> all;
  std::vector<std::uint32_t> counts;
  const auto watch = [&](const Event& event) {
    EXPECT_EQ(event.kind, Event::Kind::store);
    EXPECT_EQ(event.node, 0u);
    EXPECT_EQ(event.limit, 0u);
    counts.push_back(event.count);
  };
  for (BodyId id = 5; id < 8; ++id) all.insert({id, {{0, 0}, {1, 1}}}, watch);
  EXPECT_EQ(counts, (std::vector<std::uint32_t>{1, 2, 3}));
}

template <int D>
void expect_one_huge_box() {
  for (const BoxSort sort : {BoxSort::uniform, BoxSort::clustered, BoxSort::one_huge,
                             BoxSort::in_line, BoxSort::moving}) {
    const BoxUpdates<D> scene = seeded_boxes<D>(sort, 60, 3);
    const double half_a_world = extent_of(scene.bounds) / 2;
    for (const std::vector<Proxy<D>>& frame : scene.frames)
      EXPECT_EQ(std::ranges::count_if(
                    frame, [&](const Proxy<D>& p) { return extent_of(p.box) > half_a_world; }),
                sort == BoxSort::one_huge)
          << D << "D, sort " << static_cast<int>(sort);
  }
}

TEST(SeededBoxes, OneIsHugeOnlyWhereOneShallBe) {
  expect_one_huge_box<2>();
  expect_one_huge_box<3>();
}

}  // namespace
}  // namespace lantern::spatial
