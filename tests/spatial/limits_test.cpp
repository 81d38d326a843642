// Where numbers end, and what is refused.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "geometry/not_finite.hpp"
#include "spatial/pairs.hpp"
#include "spatial/picture.hpp"
#include "spatial/trees/brute_force.hpp"
#include "spatial/trees/bsp.hpp"
#include "spatial/trees/orthtree.hpp"
#include "spatial/trees/sort_and_sweep.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

constexpr double kTiny = std::numeric_limits<double>::denorm_min();
constexpr double kHuge = std::numeric_limits<double>::max();

testing::TreeConfig<2> config_for(const Box<2>& bounds) {
  testing::TreeConfig<2> config;
  config.bounds = bounds;
  config.capacity = 1;
  config.max_depth = Quadtree::kDeepest;
  return config;
}

TEST(Limits, ANodeWithoutAMiddleIsNotSplit) {
  const double one = 1.0;
  const double next = std::nextafter(one, 2.0);
  const double after = std::nextafter(next, 2.0);
  // The middle is rounded to the lower bound of the first two, to the upper of the next two.
  for (const Box<2>& bounds :
       {Box<2>{{0, 0}, {kTiny, kTiny}}, Box<2>{{one, one}, {next, next}},
        Box<2>{Vec<2>(2 * kTiny), Vec<2>(3 * kTiny)}, Box<2>{{next, next}, {after, after}},
        Box<2>{{0, one}, {64, next}}, Box<2>{{one, 0}, {next, 64}}}) {
    Quadtree tree(config_for(bounds));
    bool told = false;
    for (BodyId id = 0; id < 3; ++id)
      tree.insert({id, bounds},
                  [&](const Event& e) { told |= e.kind == Event::Kind::depth_limit; });
    EXPECT_EQ(tree.counters().nodes, 1u) << "a child would be as large as its parent, for ever";
    EXPECT_TRUE(told);
    EXPECT_EQ(candidate_pairs(tree, 100).pairs.size(), 3u);
  }
}

TEST(Limits, SmallNodesSplitWhileNumbersLast) {
  // 4 denormal numbers wide: 0 .. 4 is split, 0 .. 2 is split, 0 .. 1 is not.
  Quadtree tree(config_for({{0, 0}, {4 * kTiny, 4 * kTiny}}));
  for (BodyId id = 0; id < 2; ++id) tree.insert({id, {{0, 0}, {0, 0}}});
  EXPECT_EQ(tree.counters().depth, 2u);
}

TEST(Limits, TheLargestWorldHasAMiddle) {
  Quadtree tree(config_for({Vec<2>(-kHuge), Vec<2>(kHuge)}));
  tree.insert({0, {Vec<2>(-kHuge), Vec<2>(-1e308)}});
  tree.insert({1, {Vec<2>(1e308), Vec<2>(kHuge)}});
  EXPECT_EQ(tree.counters().depth, 1u) << "the middle of the largest world overflowed";
  EXPECT_EQ(candidate_pairs(tree, 100).pairs.size(), 0u);

  Quadtree far(config_for({Vec<2>(1e308), Vec<2>(std::nextafter(1e308, kHuge))}));
  for (BodyId id = 0; id < 3; ++id) far.insert({id, {Vec<2>(1e308), Vec<2>(1e308)}});
  EXPECT_EQ(far.counters().nodes, 1u);
}

template <class Structure>
void expect_refuses_bad_boxes(Structure structure) {
  structure.insert({1, {{1, 1}, {2, 2}}});
  const auto before = testing::picture_of<2>(structure);
  for (const Box<2>& box :
       {Box<2>{{kNan, 0}, {1, 1}}, Box<2>{{0, 0}, {1, kInfinity}}, Box<2>{{0, -kInfinity}, {1, 1}},
        Box<2>{{0, 2}, {1, 1}}, Box<2>{{0, 0}, {kNan, kNan}}}) {
    try {
      structure.insert({4321, box});
      FAIL() << "a bad box was taken in";
    } catch (const Refused& refused) {
      EXPECT_NE(std::string(refused.what()).find("body 4321"), std::string::npos) << refused.what();
    }
  }
  EXPECT_EQ(testing::picture_of<2>(structure), before) << "a refusal left something behind";
}

TEST(Limits, ABadBoxIsRefusedByNameAndNothingChanges) {
  const Box<2> world{{0, 0}, {64, 64}};
  expect_refuses_bad_boxes(Quadtree(config_for(world)));
  expect_refuses_bad_boxes(BruteForce<2>());
  expect_refuses_bad_boxes(Bsp<2>(testing::bsp_config<2>({}, world)));
  expect_refuses_bad_boxes(SortAndSweep<2>());
}

TEST(Limits, ABadConfigurationIsRefused) {
  const Box<2> world{{0, 0}, {64, 64}};
  const auto refuses = [](const testing::TreeConfig<2>& config) {
    EXPECT_THROW(Quadtree{config}, Refused);
  };
  refuses(config_for({{0, 0}, {64, 0}}));
  refuses(config_for({{0, 1}, {64, 0}}));
  refuses(config_for({{0, kNan}, {64, 64}}));
  refuses(config_for({{-kInfinity, 0}, {64, 64}}));
  testing::TreeConfig<2> config = config_for(world);
  config.capacity = 0;
  refuses(config);
  config = config_for(world);
  config.max_depth = 33;
  refuses(config);
  config = config_for(world);
  config.most_entries = ~std::uint64_t{0};  // as many as can be numbered
  config.capacity = 0xffffffff;
  EXPECT_NO_THROW(Quadtree{config}) << "the largest values allowed must do no harm";
}

}  // namespace
}  // namespace lantern::spatial
