// The finished tree is the one that the definition asks for, whatever the world and the order.
#include "spatial/trees/orthtree.hpp"

#include <gtest/gtest.h>

#include "spatial/pairs.hpp"
#include "spatial/picture.hpp"
#include "spatial/trees/lecture_quadtree.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::kSorts;
using testing::Picture;
using testing::picture_of;
using testing::ReferenceTree;
using testing::Sort;

constexpr std::uint64_t kFewEntries = 4000;

template <int D>
testing::TreeConfig<D> random_config(Sort sort, Random& random) {
  testing::TreeConfig<D> config;
  config.bounds = testing::bounds_of<D>(sort);
  config.capacity = static_cast<std::uint32_t>(random.whole(1, 8));
  config.max_depth = static_cast<std::uint32_t>(random.whole(0, 10));
  config.eager_children = random.bits() % 2 == 0;
  config.no_progress_stop = random.bits() % 2 == 0;
  config.most_entries = kFewEntries;
  return config;
}

// False if the tree refused to grow further.
template <int D>
bool build(Orthtree<D>& tree, const std::vector<Item<D>>& items) {
  tree.clear();
  try {
    for (const Item<D>& item : items) tree.insert(item);
  } catch (const Refused&) {
    return false;
  }
  return true;
}

// All at once gives the tree that insertions give, counts the same, and keeps the same budget.
template <int D>
void expect_same_at_once(const testing::TreeConfig<D>& config, const Orthtree<D>& taught,
                         bool refused, const std::vector<Item<D>>& items) {
  Orthtree<D> tree(config);
  if (refused) {
    EXPECT_THROW(tree.make(items), Refused);
    return;
  }
  for (int again = 0; again < 2; ++again) {
    tree.make(items);
    EXPECT_EQ(picture_of<D>(tree), picture_of<D>(taught)) << "built at once it is another tree";
  }
  const Counters a = tree.counters(), b = taught.counters();
  EXPECT_EQ(std::tuple(a.nodes, a.leaves, a.depth, a.entries, a.box_tests, a.splits),
            std::tuple(b.nodes, b.leaves, b.depth, b.entries, b.box_tests, b.splits));
}

template <int D>
void expect_defined_tree(Sort sort, std::uint64_t seed) {
  SCOPED_TRACE(fmt::format("{}D, sort {}, seed {}", D, static_cast<int>(sort), seed));
  Random random(seed);
  auto config = random_config<D>(sort, random);
  std::vector<Item<D>> items =
      testing::random_world<D>(sort, static_cast<std::size_t>(random.whole(0, 30)), random);
  const ReferenceTree<D> reference(config, items);
  Orthtree<D> tree(config);
  ASSERT_EQ(build(tree, items), !reference.too_large()) << "the budget is not kept exactly";
  expect_same_at_once<D>(config, tree, reference.too_large(), items);
  if (reference.too_large()) return;
  const Picture<D> picture = picture_of<D>(tree);
  ASSERT_EQ(picture, reference.picture()) << "the tree is not the one defined";

  const std::vector<Pair> overlaps = testing::true_overlaps(items);
  const CandidatePairs candidates = candidate_pairs(tree, 1'000'000);
  EXPECT_TRUE(std::includes(candidates.pairs.begin(), candidates.pairs.end(), overlaps.begin(),
                            overlaps.end()))
      << "an overlapping pair shares no leaf: it would never collide";
  EXPECT_EQ(std::adjacent_find(candidates.pairs.begin(), candidates.pairs.end()),
            candidates.pairs.end())
      << "a pair is reported twice";

  testing::shuffle(items, random);
  ASSERT_TRUE(build(tree, items));
  ASSERT_EQ(picture_of<D>(tree), picture) << "the tree depends on the order of insertion";

  if (!config.eager_children) return;
  config.eager_children = false;
  Orthtree<D> lazy(config);
  ASSERT_TRUE(build(lazy, items));
  EXPECT_EQ(picture_of<D>(lazy), testing::without_empty_leaves(picture))
      << "children made on demand give another tree";
}

template <int D>
void expect_defined_trees(int rounds) {
  for (const Sort sort : kSorts)
    for (int round = 0; round < rounds && !::testing::Test::HasFatalFailure(); ++round)
      expect_defined_tree<D>(sort, static_cast<std::uint64_t>(round));
}

TEST(Orthtree, IsTheTreeThatIsDefinedIn2D) { expect_defined_trees<2>(150); }
TEST(Orthtree, IsTheTreeThatIsDefinedIn3D) { expect_defined_trees<3>(80); }

TEST(Orthtree, VisitsParentsFirstAndChildrenInTheLecturesOrder) {
  Random random(5);
  testing::TreeConfig<2> config;
  config.bounds = testing::bounds_of<2>(Sort::uniform);
  config.eager_children = true;
  Quadtree tree(config);
  for (const auto& item : testing::random_world<2>(Sort::uniform, 40, random)) tree.insert(item);

  std::vector<NodeView<2>> seen;
  tree.visit([&](const NodeView<2>& view) {
    EXPECT_EQ(view.id, seen.size()) << "ids are not the order of visiting";
    EXPECT_TRUE(std::is_sorted(view.bodies.begin(), view.bodies.end()));
    if (view.parent != kNone) {
      const NodeView<2>& parent = seen.at(view.parent);
      EXPECT_EQ(view.depth, parent.depth + 1);
      EXPECT_FALSE(parent.leaf);
      // Upper left, upper right, lower left, lower right.
      EXPECT_EQ(view.slot % 2 == 0, view.box.lo.x == parent.box.lo.x);
      EXPECT_EQ(view.slot / 2 == 0, view.box.hi.y == parent.box.hi.y);
    }
    seen.push_back(view);
    return true;
  });
  EXPECT_EQ(seen.size(), tree.counters().nodes);
  EXPECT_GT(seen.size(), 20u) << "the test would prove nothing";
}

TEST(Orthtree, AnOctreesHighHalfComesLast) {
  testing::TreeConfig<3> config;
  config.bounds = testing::bounds_of<3>(Sort::uniform);
  config.capacity = 1;
  config.max_depth = 1;
  config.eager_children = true;
  Octree tree(config);
  for (BodyId id = 0; id < 2; ++id) tree.insert({id, {Vec<3>(1.0), Vec<3>(2.0)}});
  std::vector<Vec<3>> corners;
  tree.visit([&](const NodeView<3>& view) {
    if (view.leaf) corners.push_back(view.box.lo);
    return true;
  });
  const std::vector<Vec<3>> expected = {{0, 32, 0},  {32, 32, 0},  {0, 0, 0},  {32, 0, 0},
                                        {0, 32, 32}, {32, 32, 32}, {0, 0, 32}, {32, 0, 32}};
  EXPECT_EQ(corners, expected);
}

TEST(Orthtree, AVetoSkipsTheBranch) {
  testing::TreeConfig<2> config;
  config.bounds = testing::bounds_of<2>(Sort::uniform);
  config.eager_children = true;
  config.capacity = 1;
  Quadtree tree(config);
  for (BodyId id = 0; id < 2; ++id) tree.insert({id, {Vec<2>(1.0), Vec<2>(2.0)}});
  int visits = 0;
  tree.visit([&](const NodeView<2>& view) {
    ++visits;
    return view.depth == 0;
  });
  EXPECT_EQ(visits, 5) << "a skipped branch was entered, or a sibling of one was not";
}

template <int D>
void expect_exact_queries(Sort sort, std::uint64_t seed) {
  SCOPED_TRACE(fmt::format("{}D, sort {}, seed {}", D, static_cast<int>(sort), seed));
  Random random(seed);
  const auto config = random_config<D>(sort, random);
  const auto items = testing::random_world<D>(sort, 20, random);
  Orthtree<D> tree(config);
  if (!build(tree, items)) return;
  const Box<D> window = testing::random_box<D>(sort, random);
  // A leaf reaches as far as its box, but without end at the rim of the world.
  std::set<BodyId> expected;
  for (const auto& node : picture_of<D>(tree)) {
    if (!node.leaf) continue;
    Box<D> zone = node.box;
    for (int i = 0; i < D; ++i) {
      if (zone.lo[i] == config.bounds.lo[i]) zone.lo[i] = -HUGE_VAL;
      if (zone.hi[i] == config.bounds.hi[i]) zone.hi[i] = HUGE_VAL;
    }
    if (overlap(zone, window)) expected.insert(node.bodies.begin(), node.bodies.end());
  }
  EXPECT_EQ(testing::near_in(tree, window), expected)
      << "not the bodies of the leaves that the window reaches";
}

TEST(Orthtree, AQueryGivesTheBodiesOfTheLeavesReachedOnceEach) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      expect_exact_queries<2>(sort, seed);
      expect_exact_queries<3>(sort, seed);
    }
}

TEST(FlatQuadtree, ShowsTheQuadtreeOfXAndZ) {
  Random random(8);
  testing::TreeConfig<2> config;
  config.bounds = {{0, 0}, {64, 64}};
  Quadtree tree(config);
  Upright<Quadtree> tall({.bounds = {{0, -5, 0}, {64, 5, 64}},
                          .capacity = config.capacity,
                          .max_depth = config.max_depth,
                          .no_progress_stop = config.no_progress_stop});
  for (const Item<3>& item : testing::random_world<3>(Sort::uniform, 40, random)) {
    tall.insert(item);
    tree.insert({item.id, {{item.box.lo.x, item.box.lo.z}, {item.box.hi.x, item.box.hi.z}}});
  }
  std::vector<std::string> expected, shown;
  const auto text = [](const auto& n) {
    return fmt::format("{} {} {} {} {} {} {} {} {}", n.handle, n.id, n.parent, n.slot, n.depth,
                       n.leaf, fmt::join(n.bodies, ","), n.first, n.room);
  };
  tree.visit([&](const NodeView<2>& node) {
    EXPECT_EQ(node.first == kNone, node.bodies.empty()) << "an empty leaf has no place";
    EXPECT_EQ(node.room == 0, node.bodies.empty());
    return expected.push_back(text(node)), true;
  });
  tall.visit([&](const NodeView<3>& node) {
    EXPECT_EQ(node.box.lo.y, -5);
    EXPECT_EQ(node.box.hi.y, 5);
    return shown.push_back(text(node)), true;
  });
  EXPECT_GT(shown.size(), 9u);
  EXPECT_EQ(shown, expected);
}

TEST(LectureQuadtree, CountsTheNodesThatItShows) {
  Random random(12);
  StructureConfig<2> config;
  config.bounds = testing::bounds_of<2>(Sort::uniform);
  config.capacity = 3;
  config.max_depth = 6;
  LectureQuadtree tree(config);
  for (const Item<2>& item : testing::random_world<2>(Sort::uniform, 60, random)) tree.insert(item);
  std::uint64_t nodes = 0, leaves = 0;
  tree.visit([&](const NodeView<2>& node) {
    ++nodes;
    leaves += node.leaf;
    return true;
  });
  const Counters counters = tree.counters();
  EXPECT_GT(counters.splits, 1u) << "it was not split: no test";
  EXPECT_EQ(counters.nodes, nodes);
  EXPECT_EQ(counters.leaves, leaves);
}

}  // namespace
}  // namespace lantern::spatial
