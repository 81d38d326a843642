// The lecture's quadtree behind the contract of all structures.
#include <array>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "geometry/random_vec.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/pairs.hpp"
#include "spatial/picture.hpp"
#include "spatial/query.hpp"
#include "spatial/trees/brute_force.hpp"
#include "spatial/trees/lecture_quadtree.hpp"
#include "spatial/trees/orthtree.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::kSorts;
using testing::Sort;

template <int D>
using LectureIn = std::conditional_t<D == 2, LectureQuadtree, Upright<LectureQuadtree>>;

template <int D>
LectureIn<D> tree_of(const Box<D>& bounds, std::uint32_t capacity, std::uint32_t max_depth,
                     std::uint64_t most_entries = 1u << 22) {
  StructureConfig<D> config;
  config.bounds = bounds;
  config.capacity = capacity;
  config.max_depth = max_depth;
  config.most_entries = most_entries;
  return LectureIn<D>(config);
}

template <int D>
LectureIn<D> random_tree(Sort sort, Random& random) {
  return tree_of<D>(testing::bounds_of<D>(sort), static_cast<std::uint32_t>(random.whole(1, 6)),
                    static_cast<std::uint32_t>(random.whole(0, 4)));
}

template <int D>
void expect_exact(std::uint64_t seeds) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      Random random(seed * 31 + static_cast<std::uint64_t>(sort));
      auto items = testing::random_world<D>(sort, 60, random);
      Box<D> floor{Vec<D>(-1e150), Vec<D>(1e150)};
      floor.hi.y = 7;
      if (seed % 2 == 0) items.front().box = floor;
      LectureIn<D> tree = random_tree<D>(sort, random);
      for (const Item<D>& item : items) tree.insert(item);
      const auto box_of = [&](BodyId id) { return testing::box_of(items, id); };
      const auto where = ::testing::Message()
                         << D << "D, sort " << static_cast<int>(sort) << ", seed " << seed;
      EXPECT_EQ(testing::overlapping_pairs(tree, box_of, 1u << 26), testing::true_overlaps(items))
          << where;
      for (const Item<D>& a : items) {
        const std::set<BodyId> near = testing::near_in(tree, a.box);
        for (const Item<D>& b : items)
          EXPECT_TRUE(!overlap(a.box, b.box) || near.contains(b.id)) << where;
      }
    }
}

TEST(LectureQuadtree, PairsEqualBruteForceIn2D) { expect_exact<2>(8); }
TEST(LectureQuadtree, PairsEqualBruteForceIn3D) { expect_exact<3>(6); }

// Where every number is exact it is the engine's tree with all children made, node by node.
template <int D, class Engine>
void expect_same_nodes(Engine engine) {
  Random random(11);
  const Box<D> bounds{Vec<D>(0.0), Vec<D>(64.0)};
  LectureIn<D> tree = tree_of<D>(bounds, 2, 4);
  for (const Item<D>& item : testing::random_world<D>(Sort::aligned, 40, random)) {
    std::vector<Event> told, expected;
    tree.insert(item, [&](const Event& e) { told.push_back(e); });
    engine.insert(item, [&](const Event& e) { expected.push_back(e); });
    const auto count = [](const std::vector<Event>& events, Event::Kind kind) {
      return std::count_if(events.begin(), events.end(),
                           [&](const Event& e) { return e.kind == kind; });
    };
    for (const auto kind :
         {Event::Kind::test, Event::Kind::miss, Event::Kind::store, Event::Kind::split,
          Event::Kind::make_child, Event::Kind::hand_down, Event::Kind::depth_limit})
      EXPECT_EQ(count(told, kind), count(expected, kind)) << static_cast<int>(kind);
  }
  EXPECT_EQ(testing::picture_of<D>(tree), testing::picture_of<D>(engine));
  const Counters a = tree.counters(), b = engine.counters();
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.leaves, b.leaves);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.entries, b.entries);
  EXPECT_EQ(a.splits, b.splits);
  EXPECT_EQ(a.box_tests, b.box_tests);
  EXPECT_GT(a.allocations, b.allocations) << "once an entry and a split";
}

TEST(LectureQuadtree, HasTheNodesOfTheEngines) {
  const testing::TreeConfig<2> same{{Vec<2>(0.0), Vec<2>(64.0)}, 2, 4, true};
  expect_same_nodes<2>(Quadtree(same));
  expect_same_nodes<3>(Upright<Quadtree>({.bounds = {Vec<3>(0.0), Vec<3>(64.0)},
                                          .capacity = 2,
                                          .max_depth = 4,
                                          .eager_children = true,
                                          .no_progress_stop = false}));
}

// Four bodies in one leaf: as many pairs are lost as the lecture's set takes for others.
TEST(LectureQuadtree, AsPrintedOnePairOfAKeyIsKept) {
  BroadPhaseConfig<2> config;
  config.kind = StructureKind::lecture_quadtree;
  config.bounds = {Vec<2>(0.0), Vec<2>(64.0)};
  BroadPhase<2> broad(config);
  std::vector<Proxy<2>> proxies;
  for (BodyId id = 0; id < 4; ++id) proxies.push_back({id, Box<2>::around(Vec<2>(20), Vec<2>(2))});
  broad.build(proxies);
  const auto chain = [&](const std::array<std::uint64_t, 4>& addresses) {
    return broad.pair_chain([](BodyId) { return true; }, 100,
                            [&](BodyId id) { return addresses[id]; });
  };
  const PairChain whole = chain({64, 128, 192, 256}), less = chain({8096, 9984, 4000, 10000});
  EXPECT_EQ(whole.pairs.size(), 6u);
  EXPECT_EQ(whole.lost, 0u);
  EXPECT_EQ(less.lost, 1u);
  EXPECT_EQ(less.pairs, (std::vector<Pair>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}}))
      << "2 and 3 have the key of 0 and 1, which came first";
}

TEST(LectureQuadtree, HandlesAreNumbersBelowTheCountAndStay) {
  Random random(2);
  LectureIn<2> tree = tree_of<2>(testing::bounds_of<2>(Sort::uniform), 1, 6);
  std::map<std::string, NodeHandle> handles;
  for (const Item<2>& item : testing::random_world<2>(Sort::uniform, 50, random)) {
    tree.insert(item);
    std::set<NodeHandle> seen;
    std::vector<std::string> paths;
    tree.visit([&](const NodeView<2>& view) {
      paths.push_back(view.parent == kNone ? "" : paths[view.parent] + std::to_string(view.slot));
      EXPECT_EQ(handles.emplace(paths.back(), view.handle).first->second, view.handle);
      EXPECT_LT(view.handle, tree.counters().nodes);
      EXPECT_TRUE(seen.insert(view.handle).second);
      return true;
    });
    EXPECT_EQ(seen.size(), tree.counters().nodes);
  }
}

TEST(LectureQuadtree, RaysFindWhatBruteForceFinds) {
  for (const Sort sort : {Sort::uniform, Sort::aligned, Sort::outside, Sort::points}) {
    Random random(static_cast<std::uint64_t>(sort));
    const auto items = testing::random_world<3>(sort, 60, random);
    LectureIn<3> tree = random_tree<3>(sort, random);
    BruteForce<3> brute;
    for (const Item<3>& item : items) tree.insert(item), brute.insert(item);
    const auto box_of = [&](BodyId id) { return testing::box_of(items, id); };
    for (int i = 0; i < 60; ++i) {
      const Ray<3> ray{random_point<3>(random, -20, 80), random_direction<3>(random)};
      EXPECT_EQ(raycast_all(tree, ray, box_of).hits, raycast_all(brute, ray, box_of).hits);
      EXPECT_EQ(raycast_nearest(tree, ray, box_of).hit, raycast_nearest(brute, ray, box_of).hit);
      const Ball<3> ball{random_point<3>(random, -20, 80), random.between(0, 20)};
      EXPECT_EQ(overlap_query(tree, ball, box_of).ids, overlap_query(brute, ball, box_of).ids);
    }
  }
}

TEST(LectureQuadtree, RefusesWhatTheQuadtreeRefusesAndMoreThanItsBudget) {
  const Box<2> bounds{Vec<2>(0.0), Vec<2>(64.0)};
  EXPECT_THROW(tree_of<2>(bounds, 0, 4), Refused) << "a capacity of 0";
  EXPECT_THROW(tree_of<2>(bounds, 2, 33), Refused) << "too deep";
  EXPECT_THROW(tree_of<2>({Vec<2>(1.0), Vec<2>(1.0)}, 2, 4), Refused) << "no extent";
  LectureIn<2> tree = tree_of<2>(bounds, 1, 8, 500);
  EXPECT_THROW(tree.insert({0, {Vec<2>(2.0), Vec<2>(1.0)}}), Refused) << "an inverted box";
  EXPECT_EQ(tree.counters().entries, 0u);
  tree.insert({0, bounds});
  EXPECT_THROW(tree.insert({1, bounds}), Refused) << "65 536 leaves hold both";
  EXPECT_EQ(testing::picture_of<2>(tree).size(), tree.counters().nodes) << "it can be looked at";
  const std::uint64_t allocations = tree.counters().allocations;
  tree.clear();
  EXPECT_EQ(tree.counters().nodes, 1u);
  EXPECT_EQ(tree.counters().allocations, allocations) << "of its whole life";
  tree.insert({1, bounds});
  EXPECT_EQ(tree.counters().entries, 1u);
}

TEST(LectureQuadtree, ExtremeNumbersLoseNobody) {
  for (const double scale : {1e-320, 1e-300, 1e150, 1e307}) {
    for (const double from : {0.0, -1.0, 1.0}) {
      LectureIn<2> tree = tree_of<2>({Vec<2>(from * scale), Vec<2>((from + 2) * scale)}, 1, 5);
      std::vector<Item<2>> items;
      for (BodyId id = 0; id < 9; ++id) {
        const Vec<2> at(scale * (id * 0.25 + from), scale * (id * 0.125 + from));
        items.push_back({id, {at, at + scale * 0.2}});
        tree.insert(items.back());
      }
      const auto box_of = [&](BodyId id) { return testing::box_of(items, id); };
      EXPECT_EQ(testing::overlapping_pairs(tree, box_of, 1u << 26), testing::true_overlaps(items))
          << scale;
    }
  }
}

}  // namespace
}  // namespace lantern::spatial
