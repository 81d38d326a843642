// The lecture's figures in numbers: the counts that each of them states.
#include <gtest/gtest.h>

#include "spatial/pairs.hpp"
#include "spatial/picture.hpp"
#include "spatial/trees/bsp.hpp"
#include "spatial/trees/orthtree.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

constexpr std::uint64_t kBudget = 1'000'000;

testing::TreeConfig<2> ghost_tree(bool eager) {
  testing::TreeConfig<2> config;
  config.bounds = {{0, 0}, {64, 64}};
  config.capacity = 2;
  config.max_depth = 4;
  config.eager_children = eager;
  return config;
}

Item<2> character(BodyId id, double x, double y) {
  return {id, Box<2>::around({x, y}, Vec<2>(4.0))};
}

const Item<2> kRed = character(0, 24, 55);
const Item<2> kPink = character(1, 16, 40);
const Item<2> kPlayer = character(2, 49, 17);
const Item<2> kBlue = character(3, 8, 56);

std::size_t leaves_with(const Quadtree& tree, BodyId id) {
  std::size_t leaves = 0;
  for (const auto& node : testing::picture_of<2>(tree))
    leaves += static_cast<std::size_t>(std::count(node.bodies.begin(), node.bodies.end(), id));
  return leaves;
}

TEST(Figures, GhostsFillAQuadtree) {
  Quadtree tree(ghost_tree(true));
  tree.insert(kRed);
  tree.insert(kPink);
  EXPECT_EQ(tree.counters().nodes, 1u);
  EXPECT_EQ(candidate_pairs(tree, kBudget).pairs, (std::vector<Pair>{{0, 1}}));
  tree.insert(kPlayer);
  EXPECT_EQ(tree.counters().nodes, 5u);
  EXPECT_EQ(candidate_pairs(tree, kBudget).pairs, (std::vector<Pair>{{0, 1}}));
  tree.insert(kBlue);
  EXPECT_EQ(tree.counters().nodes, 9u);
  EXPECT_EQ(tree.counters().leaves, 7u);
  EXPECT_EQ(tree.counters().entries, 5u);
  EXPECT_TRUE(candidate_pairs(tree, kBudget).pairs.empty());
  EXPECT_EQ(leaves_with(tree, kPink.id), 2u) << "pink lies across two children";
  EXPECT_EQ(all_pairs(4), 6u);
}

TEST(Figures, ChildrenOnDemandSpareTheEmptyOnes) {
  Quadtree tree(ghost_tree(false));
  for (const Item<2>& item : {kRed, kPink, kPlayer}) tree.insert(item);
  EXPECT_EQ(tree.counters().nodes, 3u);
  tree.insert(kBlue);
  EXPECT_EQ(tree.counters().nodes, 7u);
  EXPECT_TRUE(candidate_pairs(tree, kBudget).pairs.empty());
}

TEST(Figures, CoincidentObjectsSplitDownToTheDepthLimit) {
  for (const std::uint32_t depth : {0u, 2u, 4u, 6u}) {
    testing::TreeConfig<2> config = ghost_tree(true);
    config.max_depth = depth;
    Quadtree tree(config);
    for (BodyId id = 0; id < 3; ++id) tree.insert({id, Box<2>::around({22, 42}, Vec<2>(5.0))});
    EXPECT_EQ(tree.counters().depth, depth);
    EXPECT_EQ(candidate_pairs(tree, kBudget).pairs, (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}}))
        << "pairs met in many leaves must count once";
    std::size_t most = 0;
    for (const auto& node : testing::picture_of<2>(tree)) most = std::max(most, node.bodies.size());
    EXPECT_EQ(most, 3u);
  }
}

TEST(Figures, OneBodyAsideMakesAFutileNodeWorthSplitting) {
  testing::TreeConfig<2> config = ghost_tree(true);
  config.no_progress_stop = true;
  Quadtree tree(config);
  for (BodyId id = 0; id < 3; ++id) tree.insert({id, Box<2>::around({22, 42}, Vec<2>(5.0))});
  EXPECT_EQ(tree.counters().nodes, 1u) << "no split can part these";
  EXPECT_EQ(candidate_pairs(tree, kBudget).pair_tests, 3u);
  tree.insert(kPlayer);
  EXPECT_EQ(tree.counters().nodes, 5u) << "a split parts the player from the three";
}

TEST(Figures, AnOctreePartsWhatAQuadtreeOnXAndZCannot) {
  testing::TreeConfig<2> flat = ghost_tree(false);
  flat.capacity = 1;
  Quadtree quadtree(flat);
  testing::TreeConfig<3> config;
  config.bounds = {Vec<3>(0.0), Vec<3>(64.0)};
  config.capacity = 1;
  Octree octree(config);
  for (BodyId id = 0; id < 2; ++id) {
    const double y = id == 0 ? 5 : 60;
    quadtree.insert({id, Box<2>::around({20, 20}, Vec<2>(2.0))});
    octree.insert({id, Box<3>::around({20, y, 20}, Vec<3>(2.0))});
  }
  EXPECT_EQ(candidate_pairs(quadtree, kBudget).pairs.size(), 1u);
  EXPECT_EQ(candidate_pairs(octree, kBudget).pairs.size(), 0u);
}

TEST(Figures, PongIsDividedByItsNet) {
  Bsp<2> bsp(testing::bsp_config<2>({{Plane<2>::through({32, 0}, {1, 0}), kNone, false}},
                                    {{0, 0}, {64, 36}}));
  const auto pairs_with_ball_at = [&](double x) {
    bsp.clear();
    bsp.insert({0, Box<2>::around({4, 17}, {1, 5})});   // blue bat
    bsp.insert({1, Box<2>::around({60, 20}, {1, 5})});  // red bat
    bsp.insert({2, Box<2>::around({x, 24}, Vec<2>(1.25))});
    return candidate_pairs(bsp, kBudget).pairs;
  };
  EXPECT_EQ(pairs_with_ball_at(52), (std::vector<Pair>{{1, 2}}));
  EXPECT_EQ(pairs_with_ball_at(32), (std::vector<Pair>{{0, 2}, {1, 2}}));
  EXPECT_EQ(pairs_with_ball_at(33.25), (std::vector<Pair>{{0, 2}, {1, 2}})) << "touching counts";
  EXPECT_EQ(pairs_with_ball_at(12), (std::vector<Pair>{{0, 2}}));
}

}  // namespace
}  // namespace lantern::spatial
