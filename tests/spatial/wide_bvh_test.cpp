// A wide BVH and the rows of which it is made. What it finds: query_test.cpp, broad_phase_test.cpp.
#include "spatial/trees/wide_bvh.hpp"

#include <gtest/gtest.h>

#include "counted_memory.hpp"
#include "spatial/query.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::Sort;

// Decoded boxes hold those that were written, and on each side one step more would be too much.
template <int D>
void expect_tight_rows(double scale, double far) {
  Random random(3);
  for (std::uint32_t count = 1; count <= kRowBlock; ++count)
    for (const Sort sort : testing::kSorts) {
      std::vector<AabbNode<D>> nodes;
      for (const Item<D>& item : testing::random_world<D>(sort, count, random)) {
        const Vec<D> at = random_point<D>(random, -far, far);
        nodes.push_back(
            AabbNode<D>::leaf({item.id, {item.box.lo * scale + at, item.box.hi * scale + at}}, 0));
      }
      ASSERT_EQ(nodes.size(), count);
      std::vector<std::uint32_t> words(PackedRow<D>::words(count) + 4);
      PackedRow<D>::write(
          words.data(), count, true, [&](std::uint32_t i) -> auto& { return nodes[i]; },
          [&](std::uint32_t i) { return nodes[i].link; });
      const PackedRow<D> row(words.data());
      ASSERT_EQ(row.count(), count);
      ASSERT_TRUE(row.holds_bodies());
      for (std::uint32_t i = 0; i < count; ++i) {
        ASSERT_EQ(row.id(i), nodes[i].link);
        const Box<D> box = row.box(i);
        for (int axis = 0; axis < D; ++axis) {
          const float lo = nodes[i].lo[axis], hi = nodes[i].hi[axis], step = row.step(axis);
          ASSERT_TRUE(box.lo[axis] <= lo || std::isinf(lo)) << scale;
          ASSERT_TRUE(box.hi[axis] >= hi || std::isinf(hi)) << scale;
          ASSERT_TRUE(lo < box.lo[axis] + step || std::abs(lo) >= row.kFar) << scale;
          ASSERT_TRUE(hi > box.hi[axis] - step || std::abs(hi) >= row.kFar) << scale;
          ASSERT_EQ(row.is_endless() && box.lo[axis] < -1e300, std::abs(lo) >= row.kFar);
        }
      }
    }
}

TEST(WideBvh, RowsHoldTheirBoxesTightly) {
  for (const double scale : {1e-90, 1e-43, 1e-39, 1e-20, 1.0, 1e20, 1e35, 1e90})
    for (const double far : {0.0, 1.0, 1e12, 1e38}) {
      expect_tight_rows<2>(scale, far);
      expect_tight_rows<3>(scale, far);
    }
}

template <int D>
std::vector<Item<D>> spread(std::uint32_t bodies, Random& random) {
  std::vector<Item<D>> items;
  const double width = std::pow(bodies, 1.0 / D) * 2;
  for (BodyId id = 0; id < bodies; ++id)
    items.push_back({id, Box<D>::around(random_point<D>(random, 0, width), Vec<D>(0.5))});
  return items;
}

// Beyond the last step of a row, and beyond float.
TEST(WideBvh, BodiesFarOutAreFoundExactly) {
  Random random(4);
  const auto point = [&] {
    Vec<2> p;
    for (int i = 0; i < 2; ++i)
      p[i] = (random.bits() % 2 == 0 ? std::pow(10, random.between(36, 40))
                                     : random.between(0.98, 1.02) * PackedRow<2>::kFar) *
             (random.bits() % 2 == 0 ? 1 : -1);
    return p;
  };
  const auto box = [&] {
    const Vec<2> a = point(), b = point();
    return Box<2>{glm::min(a, b), glm::max(a, b)};
  };
  for (int world = 0; world < 20; ++world) {
    std::vector<Item<2>> items;
    for (BodyId id = 0; id < 60; ++id) items.push_back({id, box()});
    WideBvh<2> bvh;
    bvh.make(items);
    for (int i = 0; i < 20; ++i) {
      const Box<2> asked = box();
      std::vector<BodyId> expected;
      for (const Item<2>& item : items)
        if (overlap(item.box, asked)) expected.push_back(item.id);
      const auto box_of = [&](BodyId id) { return items[id].box; };
      EXPECT_EQ(overlap_query<2>(bvh, asked, box_of).ids, expected);
    }
  }
}

template <template <int> class Tree, int D>
double bytes_a_body() {
  Random random(8);
  const std::vector<Item<D>> items = spread<D>(50'000, random);
  const std::int64_t before = counted_memory::held_bytes;
  Tree<D> tree;
  tree.make(items);
  return static_cast<double>(counted_memory::held_bytes - before) / static_cast<double>(items.size());
}

TEST(WideBvh, TakesAFewBytesABody) {
  EXPECT_LT((bytes_a_body<WideBvh, 2>()), 10.5);
  EXPECT_LT((bytes_a_body<WideBvh, 3>()), 13);
  EXPECT_LT((bytes_a_body<AabbTree, 2>()), 56) << "the leaves of which it is built are kept";
  EXPECT_LT((bytes_a_body<AabbTree, 3>()), 73);
}

TEST(WideBvh, FitsAsLongAsBodiesStayInTheirRoundedBoxes) {
  Random random(5);
  const std::vector<Item<3>> items = spread<3>(2000, random);
  WideBvh<3> bvh;
  bvh.make(items);
  EXPECT_FALSE(bvh.fits({2000, items[0].box}));
  for (const Item<3>& item : items) {
    EXPECT_TRUE(bvh.fits(item));
    EXPECT_FALSE(bvh.fits({item.id, {item.box.lo + 1.0, item.box.hi + 1.0}}));
  }
}

// Nodes of the view: each body in one leaf, each box within that of its parent but for a step.
TEST(WideBvh, IsSeenWhole) {
  Random random(6);
  const std::vector<Item<2>> items = spread<2>(3000, random);
  WideBvh<2> bvh;
  bvh.make(items);
  for (const Vec<2> toward : {Vec<2>(0.0), Vec<2>(-3, 1)}) {
    std::set<BodyId> found;
    std::vector<double> along;
    std::uint64_t nodes = 0, leaves = 0;
    bvh.visit(
        [&](const NodeView<2>& node) {
          ++nodes;
          leaves += node.leaf;
          for (const BodyId id : node.bodies) {
            EXPECT_TRUE(found.insert(id).second);
            EXPECT_EQ(united(node.box, items[id].box), node.box);
          }
          if (node.depth == 1) along.push_back(glm::dot(node.box.center(), toward));
          return true;
        },
        toward);
    EXPECT_EQ(found.size(), items.size());
    constexpr double kRounding = 3;  // of places from -330 to 110 along the ray
    for (std::size_t i = 1; i < along.size(); ++i)
      EXPECT_GT(along[i], along[i - 1] - kRounding) << "not in the order of the ray";
    EXPECT_EQ(nodes, bvh.counters().nodes);
    EXPECT_EQ(leaves, bvh.counters().leaves);
  }
}

}  // namespace
}  // namespace lantern::spatial
