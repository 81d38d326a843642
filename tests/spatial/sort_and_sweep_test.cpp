#include "spatial/trees/sort_and_sweep.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::kSorts;
using testing::Sort;

template <int D>
std::vector<Pair> swept(SortAndSweep<D>& sweep, const std::vector<Item<D>>& items) {
  std::vector<Pair> pairs;
  sweep.sort();
  const auto all = [](BodyId) { return true; };
  sweep.compare(all, [&](BodyId a, BodyId b) {
    if (overlap(testing::box_of(items, a), testing::box_of(items, b)))
      pairs.push_back({std::min(a, b), std::max(a, b)});
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(SortAndSweep, FindsEachPairOnceWhateverStoodThereBefore) {
  for (const Sort sort : kSorts) {
    SortAndSweep<3> sweep;
    Random random(static_cast<std::uint64_t>(sort));
    for (int round = 0; round < 20; ++round) {
      const auto count = static_cast<std::size_t>(random.whole(0, 60));
      const auto items = testing::random_world<3>(sort, count, random);
      sweep.clear();
      for (const auto& item : items) sweep.insert(item);
      EXPECT_EQ(swept(sweep, items), testing::true_overlaps(items))
          << "sort " << static_cast<int>(sort);
      for (const auto& item : items) {
        const std::set<BodyId> near = testing::near_in(sweep, item.box);
        for (const auto& other : items)
          EXPECT_TRUE(!overlap(item.box, other.box) || near.contains(other.id));
      }
    }
  }
}

TEST(SortAndSweep, SweepsAlongTheAxisOnWhichCentresVaryTheMost) {
  for (int axis = 0; axis < 2; ++axis) {
    SortAndSweep<2> sweep;
    std::vector<Item<2>> items;
    for (BodyId id = 0; id < 50; ++id) {
      Vec<2> center(1e9);  // far away, digits must be kept
      center[axis] += 3.0 * id;
      items.push_back({id, Box<2>::around(center, Vec<2>(1.0))});
    }
    Box<2> floor{Vec<2>(-kEndless), Vec<2>(kEndless)};
    floor.hi[1 - axis] = 0;  // its centre would make the other axis seem wide
    items.push_back({50, floor});
    for (const Item<2>& item : items) sweep.insert(item);
    EXPECT_TRUE(swept(sweep, items).empty());
    EXPECT_EQ(sweep.arrangement().axis, axis);
    int compared = 0;
    sweep.compare([](BodyId) { return true; }, [&](BodyId, BodyId) { ++compared; });
    EXPECT_EQ(compared, 50) << "the endless one with each, and no other pair";
  }
}

// Swaps are the pairs whose order has changed, and the order is kept from sort to sort.
TEST(SortAndSweep, CountsTheSwapsOfAnOrderThatIsNearlyRight) {
  SortAndSweep<2> sweep({.sweep_axis = 1});
  std::vector<Item<2>> items;
  for (BodyId id = 0; id < 16; ++id)
    items.push_back({id, Box<2>::around(Vec<2>(10.0, -1.0) * double(id), Vec<2>(0.4))});
  sweep.make(items);
  EXPECT_EQ(sweep.arrangement().axis, 1) << "as asked, though x varies more";
  EXPECT_EQ(sweep.counters().swaps, 120u) << "the reverse order: each pair once";
  sweep.make(items);
  EXPECT_EQ(sweep.counters().swaps, 0u) << "nothing has moved";
  std::swap(items[3].box, items[4].box);
  sweep.make(items);
  EXPECT_EQ(sweep.counters().swaps, 1u);
  items[0].box = Box<2>::around(Vec<2>(0, -99), Vec<2>(0.4));
  sweep.make(items);
  EXPECT_EQ(sweep.counters().swaps, 15u) << "one that jumps passes all others";
}

TEST(SortAndSweep, ShowsOneLeafHoweverOftenItIsVisited) {
  SortAndSweep<2> sweep;
  sweep.insert({7, {{0, 0}, {9, 1}}});
  sweep.insert({3, {{4, -2}, {13, 1}}});
  for (int round = 0; round < 2; ++round)
    sweep.visit([&](const NodeView<2>& node) {
      EXPECT_TRUE(node.leaf);
      EXPECT_EQ(node.box, (Box<2>{{0, -2}, {13, 1}}));
      EXPECT_EQ(std::vector<BodyId>(node.bodies.begin(), node.bodies.end()),
                (std::vector<BodyId>{3, 7}));
      return true;
    });
  EXPECT_EQ(sweep.counters().entries, 2u);
  EXPECT_EQ(sweep.counters().nodes, 1u);
  EXPECT_EQ(sweep.counters().leaves, 1u);
}

TEST(SortAndSweep, ComparesOnlyWhatOverlapsOnTheAxisAndWhereOneIsAwake) {
  SortAndSweep<2> sweep;
  //  0 |--------|
  //  1     |--------|
  //  2        |--|
  //  3               |--|
  sweep.insert({0, {{0, 0}, {9, 1}}});
  sweep.insert({1, {{4, 0}, {13, 1}}});
  sweep.insert({2, {{7, 0}, {10, 1}}});
  sweep.insert({3, {{14, 0}, {17, 1}}});
  sweep.sort();
  std::vector<Pair> pairs;
  const auto keep = [&](BodyId a, BodyId b) { pairs.push_back({a, b}); };
  sweep.compare([](BodyId) { return true; }, keep);
  EXPECT_EQ(pairs, (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}}));
  pairs.clear();
  sweep.compare([](BodyId id) { return id == 1; }, keep);
  EXPECT_EQ(pairs, (std::vector<Pair>{{0, 1}, {1, 2}}));
  pairs.clear();
  sweep.compare([](BodyId) { return false; }, keep);
  EXPECT_TRUE(pairs.empty());
}

TEST(SortAndSweep, TellsEachBodyThatItStores) {
  SortAndSweep<2> sweep;
  for (BodyId id = 5; id < 8; ++id) {
    std::vector<Event> told;
    sweep.insert({id, {{0, 0}, {1, 1}}}, [&](const Event& event) { told.push_back(event); });
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0].kind, Event::Kind::store);
    EXPECT_EQ(told[0].body, id);
    EXPECT_EQ(told[0].count, id - 4) << "how many it holds by then";
  }
}

TEST(SortAndSweep, CountsAnewWhenItIsCleared) {
  SortAndSweep<2> sweep;
  for (BodyId id = 0; id < 20; ++id)
    sweep.insert({id, {Vec<2>(40.0 - 2 * id), Vec<2>(41.0 - 2 * id)}});
  sweep.sort();
  EXPECT_GT(sweep.counters().box_tests, 0u);
  sweep.clear();
  EXPECT_EQ(sweep.counters().box_tests, 0u);
}

// Comparisons are told to students: they may not hang on whose std::sort there is.
TEST(SortAndSweep, SortsStablyByTheSameComparisonsEverywhere) {
  Random random(3);
  std::uint64_t all = 0;
  for (std::size_t count = 0; count < 100; ++count) {
    std::vector<std::pair<int, std::size_t>> list;
    for (std::size_t i = 0; i < count; ++i)
      list.emplace_back(static_cast<int>(random.whole(0, 30)), i);
    auto sorted = list;
    std::uint64_t comparisons = 0;
    merge_sort(list, [&](const auto& a, const auto& b) {
      ++comparisons;
      return a.first < b.first;
    });
    std::ranges::sort(sorted);  // by the number, then by where it stood
    EXPECT_EQ(list, sorted);
    const double levels = std::ceil(std::log2(std::max<double>(1, static_cast<double>(count))));
    EXPECT_LE(static_cast<double>(comparisons), static_cast<double>(count) * levels);
    all += comparisons;
  }
  EXPECT_EQ(all, 24307u);
}

}  // namespace
}  // namespace lantern::spatial
