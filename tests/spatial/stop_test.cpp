// The wish to stop is heard in the midst of each algorithm, and what is left behind is fit for what
// its header says. Work after the wish is counted: no clock is asked.
#include "base/stop.hpp"

#include <gtest/gtest.h>

#include "atlas/atlas.hpp"
#include "base/random.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/level/level_bsp.hpp"
#include "spatial/pairs.hpp"
#include "spatial/query.hpp"
#include "spatial/trees/bsp.hpp"
#include "spatial/trees/kd_tree.hpp"
#include "spatial/trees/lecture_quadtree.hpp"
#include "spatial/trees/orthtree.hpp"
#include "spatial/trees/sort_and_sweep.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

constexpr Box<2> kStopBounds{Vec<2>(0.0), Vec<2>(64.0)};
constexpr int kMostAfter = 64;  // events after the wish: those of one node, or of one row of pairs

class HearsStop : public ::testing::Test {
 protected:
  ~HearsStop() override { forget_stop(); }

  // Wishes to stop at the event of this number, and counts those that come after it.
  auto wish_at(int number) {
    return [this, number](const auto&...) {
      if (++events_ == number) ask_to_stop();
      if (events_ > number) ++after_;
    };
  }
  int events_ = 0, after_ = 0;
};

std::vector<Item<2>> stop_items(std::uint32_t count) {
  Random random(7);
  std::vector<Item<2>> items;
  for (std::uint32_t i = 0; i < count; ++i)
    items.push_back({i, Box<2>::around({random.between(0, 64), random.between(0, 64)},
                                       Vec<2>(random.between(0.01, 2)))});
  return items;
}

TEST_F(HearsStop, AnOrthtreeThatIsBuilt) {
  Quadtree tree(testing::TreeConfig<2>{kStopBounds, 2, 8, false, false, std::uint64_t{1} << 22});
  const auto build = [&] {
    tree.clear();
    auto observer = wish_at(5000);
    for (const Item<2>& item : stop_items(2000)) tree.insert(item, observer);
  };
  EXPECT_THROW(build(), Stopped);
  EXPECT_LE(after_, kMostAfter);
  forget_stop();
  EXPECT_NO_THROW(build()) << "it is cleared and used again";
  EXPECT_GT(after_, 1000) << "the wish came at the end: no test";
}

TEST_F(HearsStop, ABspThatIsBuilt) {
  Bsp<2> tree(testing::bsp_config<2>(
      {{{Vec<2>(1, 0), 32}, kNone, false}, {{Vec<2>(0, 1), 32}, 0, true}}, kStopBounds));
  const auto build = [&] {
    tree.clear();
    auto observer = wish_at(3000);
    for (const Item<2>& item : stop_items(2000)) tree.insert(item, observer);
  };
  EXPECT_THROW(build(), Stopped);
  EXPECT_LE(after_, kMostAfter);
}

TEST_F(HearsStop, AKdTreeThatIsBuilt) {
  KdTree<2> tree(testing::KdConfig<2>{2, 16, std::uint64_t{1} << 22});
  const std::vector<Item<2>> items = stop_items(2000);
  EXPECT_THROW(tree.make(items, wish_at(1000)), Stopped);
  EXPECT_LE(after_, kMostAfter);
  forget_stop();
  tree.make(items);
  EXPECT_GE(tree.counters().entries, items.size());
  ask_to_stop();
  EXPECT_NO_THROW(tree.clear()) << "an empty tree is quickly made";
}

TEST_F(HearsStop, AWalkThroughATree) {
  Quadtree tree(testing::TreeConfig<2>{kStopBounds, 2, 8, false, false, std::uint64_t{1} << 22});
  for (const Item<2>& item : stop_items(2000)) tree.insert(item);
  const std::vector<Item<2>> items = stop_items(2000);
  const auto box_of = [&](BodyId id) { return items[id].box; };
  EXPECT_THROW(overlap_query(tree, kStopBounds, box_of, wish_at(500)), Stopped);
  EXPECT_LE(after_, kMostAfter);
}

TEST_F(HearsStop, AWalkThroughTheLecturesTree) {
  LectureQuadtree tree({.bounds = kStopBounds, .capacity = 2, .max_depth = 8});
  for (const Item<2>& item : stop_items(500)) tree.insert(item);
  auto wish = wish_at(100);
  const auto all = [&](const NodeView<2>&) {
    wish();
    return true;
  };
  EXPECT_THROW(tree.visit(all), Stopped);
  EXPECT_EQ(after_, 0) << "it is asked at each node";
}

TEST_F(HearsStop, ThePairsOfLeaves) {
  Quadtree tree(testing::TreeConfig<2>{kStopBounds, 2000, 8, false, false, std::uint64_t{1} << 22});
  for (const Item<2>& item : stop_items(1000)) tree.insert(item);
  auto wish = wish_at(100'000);
  const auto wanted = [&](const Pair&) {
    wish();
    return true;
  };
  EXPECT_THROW(candidate_pairs(tree, 1'000'000, wanted), Stopped);
  EXPECT_LE(after_, 1000) << "more than the rest of one body's row";
  forget_stop();
  std::vector<Pair> pairs = candidate_pairs(tree, 1'000'000).pairs;
  ask_to_stop();
  EXPECT_THROW(sort_pairs(pairs), Stopped);
}

TEST_F(HearsStop, ASweep) {
  SortAndSweep<2> sweep;
  for (const Item<2>& item : stop_items(2000)) sweep.insert(item);
  sweep.sort();
  const auto all = [](BodyId) { return true; };
  EXPECT_THROW(sweep.compare(all, wish_at(1000)), Stopped);
  EXPECT_LE(after_, 2000) << "more than the rest of one body's row";
}

TEST_F(HearsStop, ALevelThatIsCompiled) {
  std::vector<std::vector<Vec<2>>> loops;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) {
      const Vec<2> at(5.0 * i + 2 + 0.1 * j, 5.0 * j + 2 + 0.07 * i);
      loops.push_back({at, at + Vec<2>(0.1, 3), at + Vec<2>(3, 2.9), at + Vec<2>(2.8, 0.2)});
    }
  const std::vector<Wall> walls = walls_of_loops(loops);
  EXPECT_THROW(compile_level(walls, kStopBounds, {}, wish_at(500)), Stopped);
  EXPECT_LE(after_, 1);
}

TEST_F(HearsStop, AnAtlas) {
  atlas::Atlas atlas(4096, 4096);
  auto observer = wish_at(5000);
  const auto pack = [&] {
    for (atlas::TextureId id = 0; id < 1000; ++id) atlas.insert(id, 16, 16, observer);
  };
  EXPECT_THROW(pack(), Stopped);
  EXPECT_LE(after_, 1);
}

template <int D>
std::vector<Proxy<D>> stop_proxies(std::uint32_t count) {
  Random random(11);
  std::vector<Proxy<D>> proxies;
  for (std::uint32_t i = 0; i < count; ++i) {
    Vec<D> at{0.0};
    for (int axis = 0; axis < D; ++axis) at[axis] = random.between(0, 64);
    proxies.push_back({i, Box<D>::around(at, Vec<D>(random.between(0.1, 2))), i % 3 == 0, true});
  }
  return proxies;
}

// Stopped at its start, while it builds the structure of static bodies: the next update must not
// take the unfinished one for that of the same bodies.
template <int D>
void next_update_is_right(StructureKind kind) {
  BroadPhaseConfig<D> config;
  config.kind = kind;
  config.bounds = {Vec<D>(0.0), Vec<D>(64.0)};
  const auto proxies = stop_proxies<D>(2000);
  BroadPhase<D> stopped(config), other(config);
  other.update(proxies);
  ASSERT_GT(other.pairs().size(), 100u);
  ask_to_stop();
  EXPECT_THROW(stopped.update(proxies), Stopped) << to_string(kind);
  EXPECT_TRUE(stopped.pairs().empty());
  forget_stop();
  stopped.update(proxies);
  EXPECT_EQ(stopped.pairs(), other.pairs()) << to_string(kind);
}

TEST_F(HearsStop, ABroadPhaseWhoseNextUpdateIsRight) {
  for (const StructureKind kind : kStructureKinds) {
    if (kind != StructureKind::octree) next_update_is_right<2>(kind);
    next_update_is_right<3>(kind);
  }
}

TEST_F(HearsStop, ALevelWhoseSectorsAreLookedAt) {
  std::vector<std::vector<Vec<2>>> loops = {{{1, 1}, {63, 1}, {63, 63}, {1, 63}}};
  for (int i = 0; i < 4; ++i) {
    const Vec<2> at(9.0 * i + 2, 11.0 * i + 2);
    loops.push_back({at, at + Vec<2>(0.1, 3), at + Vec<2>(3, 2.9), at + Vec<2>(2.8, 0.2)});
  }
  const LevelBsp bsp = compile_level(walls_of_loops(loops), kStopBounds);
  EXPECT_THROW(find_visibility(bsp, {}, wish_at(1)), Stopped);
  EXPECT_EQ(after_, 0) << "not even one sector is finished";
}

}  // namespace
}  // namespace lantern::spatial
