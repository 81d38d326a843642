#include "spatial/box_table.hpp"

#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace lantern::spatial {
namespace {

using Limits = std::numeric_limits<double>;

// What runs of all with all find, by hand.
template <int D>
std::vector<Pair> by_force(const std::vector<Box<D>>& boxes) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      if (overlap(boxes[i], boxes[j]))
        pairs.push_back({static_cast<BodyId>(i), static_cast<BodyId>(j)});
  return pairs;
}

template <int D>
std::vector<Pair> scanned(const std::vector<Box<D>>& boxes) {
  BoxTable<D> table;
  table.resize(boxes.size());
  for (BodyId id = 0; id < boxes.size(); ++id) table.set(id, id, boxes[id]);
  FoundPairs found;
  RunScanner<D> runs(table, table, boxes, found);
  const auto size = static_cast<std::uint32_t>(boxes.size());
  for (std::uint32_t i = 0; i < size; ++i) runs.add(i, i + 1, size);
  runs.finish();
  EXPECT_EQ(runs.compared(), boxes.size() * (boxes.size() - 1) / 2);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < found.size(); ++i)
    pairs.push_back({found.first()[i], found.second()[i]});
  return pairs;
}

template <int D>
void scans_as_by_force(const std::function<double(std::mt19937_64&)>& corner,
                       const std::function<double(std::mt19937_64&)>& extent) {
  std::mt19937_64 random(7);
  for (const BodyId size : {2u, 3u, 15u, 16u, 17u, 70u, 400u}) {
    std::vector<Box<D>> boxes(size);
    for (Box<D>& box : boxes)
      for (int axis = 0; axis < D; ++axis) {
        box.lo[axis] = corner(random);
        box.hi[axis] = box.lo[axis] + extent(random);
      }
    EXPECT_EQ(scanned<D>(boxes), by_force<D>(boxes)) << size << " boxes";
  }
}

TEST(BoxTable, RoundsOutwardToTheNearestFloatOfAnyNumber) {
  std::mt19937_64 random(1);
  std::vector<double> numbers = {0.0,
                                 -0.0,
                                 1.0,
                                 -1.0,
                                 0.1,
                                 -0.1,
                                 1e300,
                                 -1e300,
                                 1e-300,
                                 -1e-300,
                                 Limits::max(),
                                 Limits::lowest(),
                                 Limits::denorm_min(),
                                 16777217.0};
  std::uniform_real_distribution<double> exponent(-60, 60), part(-1, 1);
  for (int i = 0; i < 10'000; ++i)
    numbers.push_back(part(random) * std::pow(2.0, exponent(random)));
  for (const double x : numbers) {
    const float down = BoxTable<2>::rounded_down(x), up = BoxTable<2>::rounded_up(x);
    EXPECT_LE(down, x);
    EXPECT_GE(up, x);
    if (static_cast<float>(x) == x)
      EXPECT_TRUE(down == x && up == x) << x;
    else
      EXPECT_EQ(std::nextafter(down, std::numeric_limits<float>::infinity()), up) << x;
  }
}

TEST(BoxTable, FindsWhatComparisonsInDoubleFind) {
  const auto uniform = [](double from, double to) {
    return [=](std::mt19937_64& random) {
      return std::uniform_real_distribution<double>(from, to)(random);
    };
  };
  scans_as_by_force<2>(uniform(0, 40), uniform(0.5, 3));
  scans_as_by_force<3>(uniform(0, 10), uniform(0.5, 3));
  scans_as_by_force<3>(uniform(0, 1), uniform(1, 2));  // all with all
}

TEST(BoxTable, DecidesInDoubleWhatFloatCannot) {
  // Boxes of whole numbers touch; those far from the origin differ by less than a float can say.
  const auto whole = [](std::mt19937_64& random) {
    return static_cast<double>(std::uniform_int_distribution<int>(0, 12)(random));
  };
  const auto one = [](std::mt19937_64&) { return 1.0; };
  scans_as_by_force<2>(whole, one);
  scans_as_by_force<3>(whole, one);
  const auto far = [&](std::mt19937_64& random) { return 1e9 + whole(random); };
  scans_as_by_force<2>(far, one);
  const auto beyond_float = [&](std::mt19937_64& random) { return 1e300 * (1 + whole(random)); };
  scans_as_by_force<2>(beyond_float, [](std::mt19937_64&) { return 1e300; });
  const auto tiny = [&](std::mt19937_64& random) { return 1e-310 * whole(random); };
  scans_as_by_force<2>(tiny, [](std::mt19937_64&) { return 1e-310; });
}

TEST(BoxTable, AsksBeforeItsListsGrow) {
  std::vector<Box<2>> boxes(100);
  for (BodyId i = 0; i < boxes.size(); ++i) boxes[i] = {{0, 0}, {1, 1}};
  BoxTable<2> table;
  table.resize(boxes.size());
  for (BodyId id = 0; id < boxes.size(); ++id) table.set(id, id, boxes[id]);
  FoundPairs found;
  found.ask_before_growing([](BodyId, std::size_t pairs) {
    if (pairs > 2000) throw std::length_error("too many");
  });
  RunScanner<2> runs(table, table, boxes, found);
  for (std::uint32_t i = 0; i < 100; ++i) runs.add(i, i + 1, 100);
  EXPECT_THROW(runs.finish(), std::length_error);
  EXPECT_LE(found.size(), 2000u);
}

// However far back the places lie: room is asked for the length of a run.
TEST(BoxTable, AShortRunAsksForLittleRoom) {
  std::vector<Box<2>> boxes(20'000);
  for (BodyId i = 0; i < boxes.size(); ++i) boxes[i] = {{3.0 * i, 0}, {3.0 * i + 1, 1}};
  BoxTable<2> table;
  table.resize(boxes.size());
  for (BodyId id = 0; id < boxes.size(); ++id) table.set(id, id, boxes[id]);
  FoundPairs found;
  found.ask_before_growing(
      [](BodyId, std::size_t pairs) { EXPECT_LT(pairs, 1000u) << "for a run of nine places"; });
  RunScanner<2> runs(table, table, boxes, found);
  runs.add(19'990, 19'991, 20'000);
  runs.finish();
  EXPECT_EQ(found.size(), 0u);
}

// By their numbers, below `numbers`.
void order_pairs(std::vector<Pair>& pairs, std::uint32_t numbers) {
  FoundPairs found;
  found.reserve(pairs.size(), 0);
  for (const Pair& pair : pairs) found.add(pair.a, pair.b);
  PairOrder().order(found, numbers, {}, pairs);
}

TEST(PairOrder, PutsPairsInOrderAndEachOnce) {
  std::mt19937_64 random(3);
  for (const auto& [numbers, count] :
       {std::pair(2u, 5u), std::pair(50u, 4000u), std::pair(3000u, 1000u), std::pair(900u, 90'000u),
        std::pair(100'000u, 5000u)}) {
    std::uniform_int_distribution<BodyId> any(0, numbers - 1);
    std::vector<Pair> pairs, expected;
    while (pairs.size() < count) {
      const BodyId a = any(random), b = pairs.size() % 3 == 0 ? 0 : any(random);
      if (a == b) continue;
      pairs.push_back({a, b});
      expected.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    order_pairs(pairs, numbers);
    EXPECT_EQ(pairs, expected);
    order_pairs(pairs, numbers);  // they are in order already
    EXPECT_EQ(pairs, expected);
  }
}

TEST(FoundPairs, MayBeScannedForBySoManyThreads) {
  FoundPairs found;
  EXPECT_EQ(found.threads(), 1u);
  for (const unsigned threads : {2u, 3u, 8u, 1u}) {
    found.set_threads(threads);
    EXPECT_EQ(found.threads(), threads);
  }
}

}  // namespace
}  // namespace lantern::spatial
