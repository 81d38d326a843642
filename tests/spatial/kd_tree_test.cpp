// The fitted kD-tree: its rule, its boxes, and when a moved object makes it wrong.
#include "spatial/trees/kd_tree.hpp"

#include <gtest/gtest.h>

#include "spatial/pairs.hpp"
#include "spatial/picture.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::kSorts;
using testing::Sort;

Item<2> item(BodyId id, double left, double bottom, double right, double top) {
  return {id, {{left, bottom}, {right, top}}};
}

struct Node {
  bool leaf = false;
  Box<2> box;
  double plane = 0;
  std::vector<BodyId> bodies;
};

std::vector<Node> nodes_of(const KdTree<2>& tree) {
  std::vector<Node> nodes;
  tree.visit([&](const NodeView<2>& view) {
    nodes.push_back({view.leaf,
                     view.box,
                     view.plane != nullptr ? view.plane->offset : 0,
                     {view.bodies.begin(), view.bodies.end()}});
    return true;
  });
  return nodes;
}

TEST(KdTree, PlanesLieOnFacesAndBoxesFit) {
  //  1: [0,2]   2: [3,4]   3: [6,9], in a row
  KdTree<2> tree(testing::KdConfig<2>{1, 16});
  tree.make(std::vector{item(3, 6, 0, 9, 2), item(1, 0, 0, 2, 1), item(2, 3, 1, 4, 5)});
  const auto nodes = nodes_of(tree);
  ASSERT_EQ(nodes.size(), 5u);
  EXPECT_EQ(nodes[0].plane, 2)
      << "the median of the centres is 3.5; the face below it is 2, the one "
         "above is 4: both part 1 from 2, and the lower one counts";
  EXPECT_EQ(nodes[0].box, (Box<2>{{0, 0}, {9, 5}}));
  EXPECT_EQ(nodes[1].box, (Box<2>{{0, 0}, {2, 1}})) << "the smallest box around body 1";
  EXPECT_EQ(nodes[1].bodies, std::vector<BodyId>{1});
  EXPECT_EQ(nodes[2].plane, 4) << "through the upper face of body 2";
  EXPECT_EQ(nodes[2].box, (Box<2>{{3, 0}, {9, 5}}));
  EXPECT_EQ(nodes[3].bodies, std::vector<BodyId>{2});
  EXPECT_EQ(nodes[4].bodies, std::vector<BodyId>{3});
  EXPECT_EQ(tree.counters().entries, 3u) << "nothing was cut";
  const std::uint64_t tests = tree.counters().box_tests;
  EXPECT_GT(tests, 0u);
  tree.make(std::vector{item(3, 6, 0, 9, 2), item(1, 0, 0, 2, 1), item(2, 3, 1, 4, 5)});
  EXPECT_EQ(tree.counters().box_tests, tests) << "of this build, not of those before";
}

TEST(KdTree, WhatStraddlesAPlaneLiesOnBothSides) {
  KdTree<2> tree(testing::KdConfig<2>{2, 16});
  tree.make(std::vector{item(1, 0, 0, 2, 1), item(2, 1, 2, 7, 3), item(3, 6, 0, 9, 1),
                        item(4, 0, 4, 1, 5), item(5, 8, 4, 9, 5)});
  const auto nodes = nodes_of(tree);
  std::size_t holds_two = 0;
  for (const Node& node : nodes) {
    holds_two += static_cast<std::size_t>(std::count(node.bodies.begin(), node.bodies.end(), 2u));
    for (const BodyId id : node.bodies)
      EXPECT_TRUE(id != 2 || (node.box.lo.y <= 2 && node.box.hi.y >= 3));
  }
  EXPECT_GE(holds_two, 2u);
}

template <int D>
void is_exact_and_fitted(Sort sort, std::uint64_t seed) {
  Random random(seed);
  auto items = testing::random_world<D>(sort, 80, random);
  const auto capacity = static_cast<std::uint32_t>(random.whole(1, 4));
  KdTree<D> tree(testing::KdConfig<D>{capacity, static_cast<std::uint32_t>(random.whole(0, 12))});
  tree.make(items);
  const auto box_of = [&](BodyId id) { return testing::box_of(items, id); };
  EXPECT_EQ(testing::overlapping_pairs(tree, box_of, 1 << 20), testing::true_overlaps(items))
      << "sort " << static_cast<int>(sort) << ", seed " << seed;

  std::vector<Box<D>> boxes;
  Counters seen;
  tree.visit([&](const NodeView<D>& view) {
    EXPECT_EQ(view.id, seen.nodes++);
    seen.leaves += view.leaf;
    seen.entries += view.bodies.size();
    seen.depth = std::max<std::uint64_t>(seen.depth, view.depth);
    boxes.push_back(view.box);
    if (view.parent != kNone) {
      EXPECT_EQ(united(boxes[view.parent], view.box), boxes[view.parent]) << "a child sticks out";
    }
    Box<D> around;
    for (std::size_t i = 0; i < view.bodies.size(); ++i) {
      const Box<D> box = box_of(view.bodies[i]);
      EXPECT_TRUE(overlap(view.box, box));
      around = i == 0 ? box : united(around, box);
    }
    if (view.leaf && !view.bodies.empty()) {
      EXPECT_EQ(united(around, view.box), around) << "a leaf's box is larger than its bodies";
    }
    return true;
  });
  const Counters c = tree.counters();
  EXPECT_EQ(c.nodes, seen.nodes);
  EXPECT_EQ(c.leaves, seen.leaves);
  EXPECT_EQ(c.entries, seen.entries);
  EXPECT_EQ(c.depth, seen.depth);

  const auto picture = testing::picture_of<D>(tree);
  testing::shuffle(items, random);
  tree.make(items);
  EXPECT_EQ(testing::picture_of<D>(tree), picture) << "the order of the items shows";
  EXPECT_EQ(tree.counters().allocations, c.allocations) << "memory was asked for again";
  EXPECT_EQ(tree.counters().nodes_reused, c.nodes);
  for (const Item<D>& i : items) EXPECT_TRUE(tree.fits(i)) << "nothing moved";
}

TEST(KdTree, IsExactFittedAndDoesNotDependOnTheOrder) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      is_exact_and_fitted<2>(sort, seed);
      is_exact_and_fitted<3>(sort, seed);
    }
}

TEST(KdTree, AMoveMakesItWrongUnlessTheObjectStaysInItsCells) {
  KdTree<2> tree(testing::KdConfig<2>{2, 16});
  tree.make(std::vector{item(1, 0, 0, 4, 4), item(2, 1, 1, 2, 2), item(3, 10, 0, 14, 4),
                        item(4, 11, 1, 12, 2)});
  EXPECT_FALSE(tree.fits(item(1, 0.1, 0, 4.1, 4))) << "it was decisive for its node's box";
  EXPECT_FALSE(tree.fits(item(3, 9.9, 0, 13.9, 4)));
  EXPECT_TRUE(tree.fits(item(2, 2, 1, 3, 2))) << "it still lies within its node's box";
  EXPECT_FALSE(tree.fits(item(2, 3.5, 1, 4.5, 2)));
  EXPECT_FALSE(tree.fits(item(2, 11, 1, 12, 2))) << "it lies in another leaf now";
  EXPECT_FALSE(tree.fits(item(9, 0, 0, 1, 1))) << "there is no such body";
}

// Whatever fits may move without a rebuild: pairs and queries by the old leaves stay right.
TEST(KdTree, AslongAsEachObjectFitsNoPairIsLost) {
  std::size_t moves = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    auto items = testing::random_world<2>(Sort::uniform, 40, random);
    KdTree<2> tree(testing::KdConfig<2>{3, 12});
    tree.make(items);
    for (Item<2>& moved : items) {
      const Vec<2> by = random_point<2>(random, -1, 1);
      const Item<2> tried{moved.id, {moved.box.lo + by, moved.box.hi + by}};
      if (!tree.fits(tried)) continue;
      moved = tried;
      ++moves;
    }
    const auto box_of = [&](BodyId id) { return testing::box_of(items, id); };
    EXPECT_EQ(testing::overlapping_pairs(tree, box_of, 1 << 20), testing::true_overlaps(items))
        << "seed " << seed;
  }
  EXPECT_GT(moves, 30u) << "nothing was tried";
}

TEST(KdTree, NoPlaneThatPartsNothing) {
  std::vector<Item<2>> items;
  for (BodyId id = 0; id < 100'000; ++id) items.push_back(item(id, 1, 1, 2, 2));
  KdTree<2> tree(testing::KdConfig<2>{2, 60});
  std::uint64_t stops = 0;
  tree.make(items, [&](const Event& event) { stops += event.kind == Event::Kind::no_progress; });
  EXPECT_EQ(tree.counters().nodes, 1u);
  EXPECT_EQ(stops, 1u);
  items.push_back(item(100'000, 5, 5, 6, 6));
  tree.make(items);
  EXPECT_EQ(tree.counters().nodes, 3u) << "one plane parts the one that lies apart";
  EXPECT_EQ(tree.counters().entries, items.size());
}

TEST(KdTree, RefusesBadSettingsAndBoxesAndStaysAsItWas) {
  EXPECT_THROW(KdTree<2>(testing::KdConfig<2>{0, 3}), Refused);
  EXPECT_THROW(KdTree<2>(testing::KdConfig<2>{1, KdTree<2>::kDeepest + 1}), Refused);
  KdTree<2> tree(testing::KdConfig<2>{});
  tree.make(std::vector{item(1, 0, 0, 1, 1)});
  EXPECT_THROW(tree.make(std::vector{item(2, 1, 0, 0, 1)}), Refused);
  EXPECT_EQ(tree.counters().entries, 1u);
  tree.clear();
  EXPECT_EQ(tree.counters().entries, 0u);
  EXPECT_EQ(tree.counters().nodes, 1u);
}

}  // namespace
}  // namespace lantern::spatial
