// The lecture's quadtree against all pairs, and each of its mended mistakes.
#include "lecture/quad_tree.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "counted_memory.hpp"

namespace lantern::lecture {
namespace {

struct Thing {
  Vector3 pos;
  Vector3 size;
};
using Entries = std::list<QuadTreeEntry<int>>;
using Pairs = std::set<std::pair<int, int>>;

bool overlap(const Thing& a, const Thing& b) {
  return CollisionDetection::AABBTest(a.pos, b.pos, a.size, b.size);
}

// Pairs that share a leaf.
Pairs shared_leaves(QuadTree<int>& tree) {
  Pairs pairs;
  tree.OperateOnContents([&](Entries& data) {
    for (auto i = data.begin(); i != data.end(); ++i)
      for (auto j = std::next(i); j != data.end(); ++j)
        pairs.insert(std::minmax(i->object, j->object));
  });
  return pairs;
}

std::size_t leaves_of(QuadTree<int>& tree, int object) {
  std::size_t leaves = 0;
  tree.OperateOnContents([&](Entries& data) {
    for (const auto& entry : data) leaves += entry.object == object;
  });
  return leaves;
}

int depth_of(const QuadTreeNode<int>& node) {
  int depth = 0;
  for (const auto& child : node.GetChildren()) depth = std::max(depth, 1 + depth_of(child));
  return depth;
}

Thing random_thing(Random& random, double spread, double largest) {
  const auto somewhere = [&](double most) {
    return Vector3(random.between(-most, most), random.between(-most, most),
                   random.between(-most, most));
  };
  const Vector3 size = somewhere(largest);
  return {somewhere(spread), Vector3(std::abs(size.x), std::abs(size.y), std::abs(size.z))};
}

TEST(LectureQuadTree, NoPairThatOverlapsIsMissed) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const double spread = seed % 4 == 0 ? 200 : 60;  // of a tree that ends at 64
    QuadTree<int> tree(Vector2(64.0), static_cast<int>(seed % 7), 1 + static_cast<int>(seed % 3),
                       Vector2(seed % 2 == 0 ? 0.0 : 0.1));
    std::vector<Thing> things;
    for (int i = 0; i < 80; ++i) {
      things.push_back(random_thing(random, spread, seed % 5 == 0 ? 40 : 6));
      tree.Insert(i, things.back().pos, things.back().size);
    }
    const Pairs found = shared_leaves(tree);
    for (int i = 0; i < 80; ++i) {
      std::set<int> near;
      tree.OperateOnContents(
          [&](const Entries& data) {
            for (const auto& entry : data) near.insert(entry.object);
          },
          things[i].pos, things[i].size);
      for (int j = i + 1; j < 80; ++j)
        if (overlap(things[i], things[j])) {
          EXPECT_TRUE(found.contains({i, j})) << seed << ": " << i << ", " << j;
          EXPECT_TRUE(near.contains(j)) << seed << ": " << i << ", " << j;
        }
    }
  }
}

// The lecture's ghosts: capacity 2, then one more, then another one.
TEST(LectureQuadTree, SplitsAsTheFiguresShow) {
  QuadTree<int> tree(Vector2(8.0), 6, 2);
  enum { red, pink, yellow, blue };
  tree.Insert(red, {-6, 0, 2}, Vector3(0.5));
  tree.Insert(pink, {-4, 0, 6}, Vector3(0.5));
  EXPECT_TRUE(tree.GetRoot().GetChildren().empty());
  EXPECT_EQ(shared_leaves(tree), (Pairs{{red, pink}}));
  tree.Insert(yellow, {5, 0, -5}, Vector3(0.5));
  EXPECT_EQ(depth_of(tree.GetRoot()), 1);
  EXPECT_EQ(shared_leaves(tree), (Pairs{{red, pink}}));
  tree.Insert(blue, {-2, 0, 2}, Vector3(0.5));
  EXPECT_EQ(depth_of(tree.GetRoot()), 2);
  EXPECT_EQ(leaves_of(tree, pink), 2u) << "it lies across two children";
  EXPECT_EQ(shared_leaves(tree), Pairs{});
}

TEST(LectureQuadTree, CoincidentObjectsSplitDownToTheDepthLimit) {
  QuadTree<int> tree(Vector2(64.0), 5, 2);
  for (int i = 0; i < 3; ++i) tree.Insert(i, {10.3, 0, 7.7}, Vector3(0.001));
  EXPECT_EQ(depth_of(tree.GetRoot()), 5);
  EXPECT_EQ(shared_leaves(tree), (Pairs{{0, 1}, {0, 2}, {1, 2}}));
}

TEST(LectureQuadTree, MendedTouchingIsOverlap) {
  EXPECT_TRUE(CollisionDetection::AABBTest({0, 0, 0}, {3, 0, 0}, Vector3(1.0), Vector3(2.0)));
  QuadTree<int> tree(Vector2(8.0), 1, 1);
  tree.Insert(0, {-1, 0, 3}, Vector3(1.0));  // ends at the border
  tree.Insert(1, {1, 0, 3}, Vector3(1.0));   // begins there
  EXPECT_EQ(shared_leaves(tree), (Pairs{{0, 1}}));
}

// Each child is told of when it covers its quarter, and the later ones cover nothing yet.
TEST(LectureQuadTree, SplitMakesOneChildAfterTheOther) {
  struct Looking : NobodyWatches {
    const QuadTree<int>* tree;
    std::vector<std::string> made = {};
    void Made(QuadTreeNode<int>&) {
      std::string& covered = made.emplace_back();
      for (const auto& child : tree->GetRoot().GetChildren()) {
        char is_there = '-';
        for (const double x : {-4, 4})
          for (const double z : {-4, 4})
            child.OperateOnContents([&](const Entries&) { is_there = '+'; }, {x, 0, z},
                                    Vector3(1.0));
        covered += is_there;
      }
    }
  };
  QuadTree<int> tree(Vector2(8.0), 1, 1);
  Looking watch{{}, &tree};
  tree.Insert(0, {-4, 0, 4}, Vector3(1.0), watch);
  tree.Insert(1, {4, 0, 4}, Vector3(1.0), watch);
  EXPECT_EQ(watch.made, (std::vector<std::string>{"+---", "++--", "+++-", "++++"}));
}

TEST(LectureQuadTree, AsPrintedWhatLiesOutsideIsLost) {
  for (const bool printed : {true, false}) {
    QuadTree<int> tree(Vector2(8.0), 2, 1, Vector2(0.0), printed);
    tree.Insert(0, {20, 0, 3}, Vector3(1.0));
    tree.Insert(1, {21, 0, 3}, Vector3(1.0));
    EXPECT_EQ(leaves_of(tree, 0) > 0, !printed);
    EXPECT_EQ(shared_leaves(tree), printed ? Pairs{} : (Pairs{{0, 1}}));
    tree.Insert(2, {-4, 0, -4}, Vector3(1.0));
    tree.Insert(3, {-5, 0, -4}, Vector3(1.0));
    EXPECT_TRUE(shared_leaves(tree).contains({2, 3})) << "inside nothing is";
  }
}

TEST(LectureQuadTree, AsPrintedTwoPairsMayHaveOneKey) {
  using Info = CollisionDetection::CollisionInfoAsPrinted;
  EXPECT_EQ((Info{8096, 9984}.GetHash()), 8096u + 256u * 9984u);
  EXPECT_EQ((std::set<Info>{{8096, 9984}, {4000, 10000}}.size()), 1u);
  EXPECT_EQ((std::set<Info>{{8096, 9984}, {4000, 10001}}.size()), 2u);
  const Info low{1, 2}, high{2, 2};
  EXPECT_TRUE(low < high && !(high < low) && low.GetHash() < high.GetHash());
}

TEST(LectureQuadTree, MendedWhatLiesOutsideIsKept) {
  QuadTree<int> tree(Vector2(8.0), 4, 1);
  tree.Insert(0, {100, 0, 50}, Vector3(1.0));
  tree.Insert(1, {101, 0, 51}, Vector3(1.0));
  tree.Insert(2, {-3, 0, 1e9}, Vector3(1.0));
  tree.Insert(3, {-3, 0, -3}, Vector3(1.0));
  for (int i = 0; i < 4; ++i) EXPECT_GE(leaves_of(tree, i), 1u) << i;
  EXPECT_TRUE(shared_leaves(tree).contains({0, 1}));
}

TEST(LectureQuadTree, MendedWhatFliesHighIsKept) {
  QuadTree<int> tree(Vector2(8.0));
  tree.Insert(0, {1, 5000, 1}, Vector3(1.0));
  EXPECT_EQ(leaves_of(tree, 0), 1u);
}

// The middles of 0.1 ± 0.3 / 2^n are rounded; each point beside a border must lie somewhere.
TEST(LectureQuadTree, MendedNoGapBetweenNeighbours) {
  const double half = 0.3, at = 0.1;
  QuadTree<int> tree(Vector2(half), 12, 1, Vector2(at));
  std::vector<double> places;
  for (int i = 0; i <= 64; ++i) {
    const double border = at - half + 2 * half * i / 64;
    places.insert(places.end(),
                  {std::nextafter(border, -9.0), border, std::nextafter(border, 9.0)});
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    tree.Insert(static_cast<int>(i), {places[i], 0, at + 0.01}, Vector3(0.0));
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_GE(leaves_of(tree, static_cast<int>(i)), 1u) << places[i];
}

TEST(LectureQuadTree, MendedMemoryIsGivenBack) {
  const std::int64_t before = counted_memory::held;
  {
    QuadTree<int> tree(Vector2(64.0), 7, 1);
    Random random(3);
    for (int i = 0; i < 200; ++i) {
      const Thing thing = random_thing(random, 64, 4);
      tree.Insert(i, thing.pos, thing.size);
    }
    EXPECT_GT(counted_memory::held, before + 200);
    const QuadTree<int> copy = tree;
    EXPECT_EQ(depth_of(copy.GetRoot()), depth_of(tree.GetRoot()));
  }
  EXPECT_EQ(counted_memory::held, before);
}

struct Counts {
  long tested = 0, stored = 0, handed_down = 0, splits = 0;
  void Tested(const QuadTreeNode<int>&, int, bool) { ++tested; }
  void Stored(const QuadTreeNode<int>&, int, int) { ++stored; }
  void HandedDown(const QuadTreeNode<int>&, int) { ++handed_down; }
  void Split(const QuadTreeNode<int>&, int, int) { ++splits; }
  void Made(QuadTreeNode<int>&) {}
};

TEST(LectureQuadTree, AsksForMemoryOnceAnEntryAndOnceASplit) {
  QuadTree<int> tree(Vector2(64.0), 6, 2);
  Random random(4);
  Counts counts;
  const std::uint64_t before = counted_memory::calls;
  for (int i = 0; i < 300; ++i) {
    const Thing thing = random_thing(random, 64, 2);
    tree.Insert(i, thing.pos, thing.size, counts);
  }
  EXPECT_GT(counts.splits, 50);
  EXPECT_EQ(counted_memory::calls - before, counts.stored + counts.splits);
  EXPECT_GT(counts.tested, counts.stored + 4 * counts.handed_down);
}

}  // namespace
}  // namespace lantern::lecture
