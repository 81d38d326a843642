#include "spatial/grid/grid.hpp"

#include <map>

#include <gtest/gtest.h>

#include "geometry/not_finite.hpp"
#include "geometry/random_vec.hpp"
#include "spatial/picture.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::kSorts;
using testing::Sort;

template <int D>
StructureConfig<D> grid_config_of(Sort sort, Random& random) {
  constexpr double kCells[] = {0, 0, 0.7, 4, 9, 300};
  StructureConfig<D> config;
  config.bounds = testing::bounds_of<D>(sort);
  config.cell = kCells[random.whole(0, 5)];
  config.levels = static_cast<std::uint32_t>(random.whole(1, 4));
  config.open = random.bits() % 2 == 0;
  return config;
}

// Called 0, 1, 2, ... in their order, as a broad phase does.
template <int D>
std::vector<Item<D>> numbered_world(Sort sort, Random& random) {
  auto items =
      testing::random_world<D>(sort, static_cast<std::size_t>(random.whole(0, 90)), random);
  for (BodyId id = 0; id < items.size(); ++id) items[id].id = id;
  if (random.whole(0, 4) == 0 && !items.empty())  // a floor without end
    items.front().box = {Vec<D>(-1e9), Vec<D>(testing::bounds_of<D>(sort).lo[0] + 7)};
  if (random.whole(0, 4) == 0 && items.size() > 1) items[1].box = {Vec<D>(1e300), Vec<D>(1e300)};
  return items;
}

template <int D>
std::vector<Pair> pairs_in(const FoundPairs& found) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < found.size(); ++i)
    pairs.push_back({std::min(found.first()[i], found.second()[i]),
                     std::max(found.first()[i], found.second()[i])});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template <int D>
void pairs_are_exact(Sort sort, std::uint64_t seed) {
  Random random(1000 * seed + static_cast<std::uint64_t>(sort));
  Grid<D> grid(grid_config_of<D>(sort, random));
  for (int round = 0; round < 3; ++round) {
    const auto items = numbered_world<D>(sort, random);
    grid.make(items);
    FoundPairs found;
    const std::uint64_t compared = grid.find_pairs(testing::boxes_of(items), found);
    ASSERT_EQ(pairs_in<D>(found), testing::true_overlaps(items))
        << D << "D, sort " << static_cast<int>(sort) << ", seed " << seed;
    std::set<Pair> met;
    std::uint64_t half_awake = 0, met_awake = 0;
    const auto awake = [](BodyId id) { return id % 3 == 0; };
    const auto meet = [&](BodyId a, BodyId b) {
      ASSERT_TRUE(met.insert({std::min(a, b), std::max(a, b)}).second)
          << a << " and " << b << " are compared twice, seed " << seed;
      half_awake += awake(a) || awake(b);
    };
    grid.compare([](BodyId) { return true; }, meet);
    ASSERT_EQ(met.size(), compared);
    grid.compare(awake, [&](BodyId, BodyId) { ++met_awake; });
    ASSERT_EQ(met_awake, half_awake);
    for (const Item<D>& item : items) {
      std::vector<BodyId> near, expected;
      grid.near(item.box, near);
      for (const Item<D>& other : items)
        if (overlap(item.box, other.box)) expected.push_back(other.id);
      std::sort(near.begin(), near.end());
      ASSERT_EQ(near, expected) << "seed " << seed;
    }
  }
}

TEST(Grid, FindsEachPairOnceIn2D) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < 25; ++seed) pairs_are_exact<2>(sort, seed);
}
TEST(Grid, FindsEachPairOnceIn3D) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < 25; ++seed) pairs_are_exact<3>(sort, seed);
}

// A row of cells far apart, and bodies that stand in the same place of each: they share buckets.
TEST(Grid, BodiesThatShareABucketFromAfarAreNoPair) {
  for (const bool open : {false, true}) {
    StructureConfig<2> config;
    config.bounds = {{0, 0}, {1e9, 1e9}};
    config.cell = open ? 1 : 1e5;
    config.open = open;
    Grid<2> grid(config);
    std::vector<Item<2>> items;
    for (BodyId id = 0; id < 400; ++id) {
      const Vec<2> at = Vec<2>(id % 20, id / 20) * (config.cell * 7919.0 / 20 * (open ? 997 : 1));
      items.push_back({id, {at, at + 0.9 * config.cell}});
    }
    grid.make(items);
    FoundPairs found;
    EXPECT_LT(grid.find_pairs(testing::boxes_of(items), found), 4000u) << "compared";
    EXPECT_EQ(found.size(), 0u);
  }
}

// By sums that are exact here: cells of 4, 8, 16, ... from the corner of the bounds on, without
// their upper edge; those at the rim without end.
template <int D>
std::uint64_t expect_cells(const Grid<D>& grid, const std::vector<Item<D>>& items,
                           const StructureConfig<D>& config) {
  std::uint64_t entries = 0;
  std::set<NodeHandle> handles;
  std::uint32_t next = 0;
  std::map<std::uint32_t, std::uint32_t> last_slot;
  std::set<BodyId> large;  // are in no cell
  grid.visit([&](const NodeView<D>& node) {
    if (node.slot == kGridLarge) large.insert(node.bodies.begin(), node.bodies.end());
    return true;
  });
  const auto level_of = [&](const Box<D>& box) {
    std::uint32_t level = 0;
    double most = 0;
    for (int i = 0; i < D; ++i) most = std::max(most, box.size()[i]);
    while (level + 1 < config.levels && most > config.cell * (1 << level)) ++level;
    return level;
  };
  grid.visit([&](const NodeView<D>& node) {
    EXPECT_EQ(node.id, next++);
    EXPECT_TRUE(handles.insert(node.handle).second && node.handle < grid.counters().nodes);
    if (node.parent != kNone) {
      EXPECT_TRUE(!last_slot.contains(node.parent) || last_slot[node.parent] < node.slot);
      last_slot[node.parent] = node.slot;
    }
    if (!node.leaf || node.parent == kNone || node.slot == kGridLarge) return true;
    std::vector<BodyId> reach;
    for (const Item<D>& item : items) {
      bool inside = !large.contains(item.id) &&
                    node.box.size()[0] <= config.cell * (1 << level_of(item.box)) &&
                    node.box.size()[0] * 2 > config.cell * (1 << level_of(item.box));
      for (int i = 0; i < D; ++i) {
        const bool first = !config.open && node.box.lo[i] == config.bounds.lo[i];
        const bool last = !config.open && node.box.hi[i] == config.bounds.hi[i];
        inside = inside && (first || item.box.hi[i] >= node.box.lo[i]) &&
                 (last || item.box.lo[i] < node.box.hi[i]);
      }
      if (inside) reach.push_back(item.id);
    }
    std::sort(reach.begin(), reach.end());
    EXPECT_EQ(std::vector(node.bodies.begin(), node.bodies.end()), reach);
    entries += reach.size();
    return true;
  });
  EXPECT_EQ(next, grid.counters().nodes);
  return entries + large.size();
}

template <int D>
void cells_hold_what_reaches_them(Sort sort, std::uint64_t seed) {
  Random random(seed);
  StructureConfig<D> config;
  config.bounds = testing::bounds_of<D>(sort);
  config.cell = 4;
  config.levels = static_cast<std::uint32_t>(random.whole(1, 4));
  config.open = random.bits() % 2 == 0;
  Grid<D> built(config), grown(config), shuffled(config);
  auto items = testing::random_world<D>(sort, sort == Sort::ratios ? 8 : 30, random);
  built.make(items);
  std::uint64_t entries = 0;
  for (const Item<D>& item : items)
    grown.insert(item, [&](const Event& e) { entries += e.kind == Event::Kind::store; });
  const std::uint64_t in_cells = expect_cells(built, items, config);
  EXPECT_EQ(built.counters().entries, in_cells);
  EXPECT_EQ(testing::picture_of<D>(grown), testing::picture_of<D>(built));
  EXPECT_EQ(entries, built.counters().entries) << "each is told once";
  testing::shuffle(items, random);
  shuffled.make(items);
  EXPECT_EQ(testing::picture_of<D>(shuffled), testing::picture_of<D>(built));
}

TEST(Grid, ACellHoldsAllThatReachItWhateverTheOrder) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      cells_hold_what_reaches_them<2>(sort, seed);
      if (sort != Sort::ratios) cells_hold_what_reaches_them<3>(sort, seed);
    }
}

TEST(Grid, CellsStandInRowsFromTheTop) {
  Grid<2> grid({.bounds = {{0, 0}, {10, 8}}, .cell = 4});
  grid.insert({1, {{1, 1}, {2, 2}}});
  grid.insert({2, {{9, 1}, {9, 5}}});
  grid.insert({3, {{-5, 7}, {-4, 90}}});
  std::vector<std::pair<std::uint32_t, Box<2>>> cells;
  grid.visit([&](const NodeView<2>& node) {
    if (node.leaf) cells.emplace_back(node.slot, node.box);
    return true;
  });
  EXPECT_EQ(cells, (std::vector<std::pair<std::uint32_t, Box<2>>>{{0, {{0, 4}, {4, 8}}},
                                                                  {2, {{8, 4}, {10, 8}}},
                                                                  {3, {{0, 0}, {4, 4}}},
                                                                  {5, {{8, 0}, {10, 4}}}}));
}

TEST(Grid, TellsTheCellsThatABodyReaches) {
  Grid<2> grid({.bounds = {{0, 0}, {8, 4}}, .cell = 4});
  std::vector<std::string> told;
  const auto tell = [&](const Event& e) {
    constexpr const char* kNames[] = {"test", "miss", "make", "store"};
    told.push_back(
        fmt::format("{} {} of {}: {}", kNames[static_cast<int>(e.kind)], e.node, e.body, e.count));
  };
  grid.insert({7, {{1, 1}, {2, 2}}}, tell);
  grid.insert({4, {{3, 1}, {5, 2}}}, tell);
  EXPECT_EQ(told, (std::vector<std::string>{"test 0 of 7: 0", "make 1 of 7: 0", "test 1 of 7: 0",
                                            "store 1 of 7: 1", "test 0 of 4: 0", "test 1 of 4: 0",
                                            "store 1 of 4: 2", "make 2 of 4: 0", "test 2 of 4: 0",
                                            "store 2 of 4: 1"}));
}

// What a look at all cells says of the way to those that hold the body: a cell that holds it alone
// was made for it, and so was what lies above and holds nothing else.
template <int D>
std::vector<std::string> way_to(const Grid<D>& grid, BodyId id) {
  std::vector<NodeView<D>> nodes;
  std::vector<std::size_t> count, others;  // in each node; bodies below it, besides
  std::vector<bool> holds;
  grid.visit([&](const NodeView<D>& node) {
    nodes.push_back(node);
    count.push_back(node.bodies.size());
    holds.push_back(std::ranges::count(node.bodies, id) > 0);
    others.push_back(count.back() - holds.back());
    return true;
  });
  for (std::size_t i = nodes.size(); i-- > 1;) {
    others[nodes[i].parent] += others[i];
    if (holds[i]) holds[nodes[i].parent] = true;
  }
  std::vector<std::string> told;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!holds[i]) continue;
    if (i > 0 && others[i] == 0) told.push_back(fmt::format("make {}", nodes[i].handle));
    told.push_back(fmt::format("test {}", nodes[i].handle));
    if (nodes[i].leaf) told.push_back(fmt::format("store {}: {}", nodes[i].handle, count[i]));
  }
  return told;
}

template <int D>
void tells_the_way_to_its_cells(Sort sort, std::uint64_t seed) {
  Random random(7000 * seed + static_cast<std::uint64_t>(sort));
  StructureConfig<D> config = grid_config_of<D>(sort, random);
  config.most_entries = static_cast<std::uint64_t>(random.whole(20, 400));
  const bool looks = random.bits() % 2 == 0;  // all the time, whoever is told
  Grid<D> grid(config);
  for (int round = 0; round < 2; ++round) {
    for (const Item<D>& item : testing::random_world<D>(sort, 40, random)) {
      std::vector<std::string> told;
      const auto tell = [&](const Event& e) {
        EXPECT_EQ(e.body, item.id);
        EXPECT_TRUE(!looks || grid.counters().nodes > e.node);
        if (e.kind == Event::Kind::make_child) told.push_back(fmt::format("make {}", e.node));
        if (e.kind == Event::Kind::test) told.push_back(fmt::format("test {}", e.node));
        if (e.kind == Event::Kind::store)
          told.push_back(fmt::format("store {}: {}", e.node, e.count));
      };
      const bool told_of = random.whole(0, 3) != 0;
      grid.insert(item, told_of ? EventWatch(tell) : EventWatch());
      if (random.whole(0, 3) == 0) grid.sort();
      EXPECT_EQ(told, told_of ? way_to(grid, item.id) : told) << "seed " << seed;
    }
    grid.clear();
  }
}

TEST(Grid, TellsTheWayToTheCellsThatALookAtAllOfThemShows) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      tells_the_way_to_its_cells<2>(sort, seed);
      if (sort != Sort::ratios) tells_the_way_to_its_cells<3>(sort, seed);
    }
}

TEST(Grid, OfSeveralLevelsABodyIsOnTheFinestThatIsAsLargeAsItIs) {
  Grid<2> grid({.bounds = {{0, 0}, {16, 16}}, .cell = 2, .levels = 3});
  grid.insert({1, {{0, 0}, {2, 1}}});
  grid.insert({2, {{0, 0}, {2.5, 1}}});
  grid.insert({3, {{0, 0}, {15, 1}}});
  std::map<BodyId, std::uint32_t> level;
  std::uint32_t at = 0;
  grid.visit([&](const NodeView<2>& node) {
    if (node.depth == 1) at = node.slot;
    for (const BodyId id : node.bodies) level[id] = at;
    EXPECT_EQ(node.leaf, node.depth == 2);
    return true;
  });
  EXPECT_EQ(level, (std::map<BodyId, std::uint32_t>{{1, 0}, {2, 1}, {3, 2}}));
}

TEST(Grid, AHashedGridShowsItsBuckets) {
  Grid<2> grid({.bounds = {{0, 0}, {16, 16}}, .cell = 1, .open = true});
  for (BodyId id = 0; id < 60; ++id)
    grid.insert({id, Box<2>::around({id * 3.0 + 0.5, (id * id % 97) + 0.5}, Vec<2>(0.2))});
  std::uint64_t buckets = 0, cells = 0;
  std::uint32_t last = kNone;
  Box<2> root, all;
  grid.visit([&](const NodeView<2>& node) {
    if (node.depth == 0) root = node.box;
    if (node.depth == 2) all = cells == 0 ? node.box : united(all, node.box);
    buckets += node.depth == 1;
    cells += node.depth == 2;
    EXPECT_TRUE(node.depth != 1 || last == kNone || last < node.slot) << "in order";
    if (node.depth == 1) last = node.slot;
    return true;
  });
  EXPECT_EQ(root, all) << "without bounds of its own, it is as large as its cells";
  EXPECT_EQ(grid.work().nodes, 1u);
  EXPECT_EQ(grid.work().leaves, 1u);
  EXPECT_EQ(grid.work().entries, 60u);
  EXPECT_EQ(cells, 60u);
  EXPECT_LT(buckets, 60u) << "some share one";
  EXPECT_GT(buckets, 30u);
}

TEST(Grid, AHashedGridIsNoLargerThanItsCellsEvenFarFromItsBounds) {
  Grid<2> grid({.bounds = {{0, 0}, {16, 16}}, .cell = 1, .open = true});
  grid.insert({0, Box<2>::around({100.5, 200.5}, Vec<2>(0.2))});
  grid.insert({1, Box<2>::around({103.5, 201.5}, Vec<2>(0.2))});
  std::vector<Box<2>> boxes;
  grid.visit([&](const NodeView<2>& node) {
    if (node.depth != 1) boxes.push_back(node.box);  // the root, and the cells
    return true;
  });
  ASSERT_EQ(boxes.size(), 3u);
  EXPECT_EQ(boxes[0], united(boxes[1], boxes[2]));
  EXPECT_EQ(boxes[0], (Box<2>{{100, 200}, {104, 202}}));
}

// A solid one's slices follow one another.
TEST(Grid, IsArrangedInRowsOfItsCells) {
  Grid<2> flat({.bounds = {{0, 0}, {10, 6}}, .cell = 2});
  const Arrangement rows = flat.arrangement();
  ASSERT_EQ(rows.levels.size(), 1u);
  EXPECT_EQ(rows.levels[0].side, 2);
  EXPECT_EQ(rows.levels[0].columns, 5u);
  EXPECT_EQ(rows.levels[0].rows, 3u);
  Grid<3> solid({.bounds = {{0, 0, 0}, {10, 6, 8}}, .cell = 2});
  const Arrangement slices = solid.arrangement();
  ASSERT_EQ(slices.levels.size(), 1u);
  EXPECT_EQ(slices.levels[0].columns, 5u);
  EXPECT_EQ(slices.levels[0].rows, 3u * 4u);
}

TEST(Grid, ChoosesCellsThatSuitItsBodies) {
  Random random(3);
  for (const double size : {1e-6, 1.0, 1e6}) {
    std::vector<Item<2>> items;
    for (BodyId id = 0; id < 1000; ++id)
      items.push_back({id, Box<2>::around(random_point<2>(random, 0, 60 * size),
                                          Vec<2>(size * random.between(0.25, 0.75)))});
    items[5].box = {Vec<2>(-1e9 * size), Vec<2>(0.0)};
    Grid<2> grid({.bounds = {{0, 0}, Vec<2>(60 * size)}});
    grid.make(items);
    EXPECT_GT(grid.arrangement().levels[0].side, 1.3 * size);
    EXPECT_LT(grid.arrangement().levels[0].side, 3 * size);
    FoundPairs found;
    EXPECT_LT(grid.find_pairs(testing::boxes_of(items), found), 10'000u);
  }
  std::vector<Item<2>> points;
  for (BodyId id = 0; id < 1000; ++id) {
    const Vec<2> at = random_point<2>(random, 0, 64);
    points.push_back({id, {at, at}});
  }
  Grid<2> grid({.bounds = {{0, 0}, {64, 64}}});
  grid.make(points);
  EXPECT_GT(grid.arrangement().levels[0].side, 0.3);
  EXPECT_LT(grid.arrangement().levels[0].side, 4);
  for (const double apart : {0.5, 2.0}) {  // points in rows: half of how far apart they are
    for (BodyId id = 0; id < 1000; ++id) {
      const Vec<2> at(apart * (id % 32), apart * (id / 32));
      points[id].box = {at, at};
    }
    grid.make(points);
    EXPECT_NEAR(grid.arrangement().levels[0].side, apart / 2, 0.1 * apart);
  }
}

TEST(Grid, NothingAndOneAndAllInOnePlace) {
  for (const bool open : {false, true}) {
    Grid<2> grid({.bounds = {{0, 0}, {64, 64}}, .open = open});
    EXPECT_EQ(grid.counters().nodes, 1u);
    EXPECT_EQ(grid.counters().leaves, 1u);
    std::vector<BodyId> near;
    grid.near({{0, 0}, {64, 64}}, near);
    EXPECT_TRUE(near.empty());
    grid.insert({3, {{1, 1}, {1, 1}}});
    grid.near({{1, 1}, {1, 1}}, near);
    EXPECT_EQ(near, std::vector<BodyId>{3});
    std::vector<Item<2>> items(50, {0, {{9, 9}, {9, 9}}});
    for (BodyId id = 0; id < 50; ++id) items[id].id = id;
    grid.make(items);
    FoundPairs found;
    EXPECT_EQ(grid.find_pairs(testing::boxes_of(items), found), 50u * 49 / 2);
    EXPECT_EQ(found.size(), 50u * 49 / 2);
  }
}

TEST(Grid, RefusesNonsenseAndStaysAsItWas) {
  const Box<2> world{{0, 0}, {64, 64}};
  const auto refuses = [](const StructureConfig<2>& config) {
    EXPECT_THROW(Grid<2>{config}, Refused);
  };
  for (const double cell : {-1.0, kNan, kInfinity, 1e-200, 1e-9})
    refuses({.bounds = world, .cell = cell});
  for (const std::uint32_t levels : {0u, 17u}) refuses({.bounds = world, .levels = levels});
  refuses({.bounds = {{0, 1}, {64, 0}}});
  EXPECT_NO_THROW((Grid<2>{{.bounds = world, .cell = 1e-9, .open = true}}));
  Grid<2> grid({.bounds = world, .most_entries = 10, .cell = 4});
  const auto watch = [](const Event&) {};
  grid.insert({1, {{1, 1}, {2, 2}}}, watch);
  grid.insert({2, {{1, 1}, {20, 20}}}, watch);  // 36 cells are too many
  grid.insert({4, {{1, 1}, {5, 2}}}, watch);
  EXPECT_EQ(grid.counters().entries, 4u);
  const auto before = testing::picture_of<2>(grid);
  EXPECT_EQ(before.back().bodies, std::vector<BodyId>{2}) << "in the leaf for all of these";
  EXPECT_THROW(grid.insert({3, {{kNan, 0}, {1, 1}}}), Refused);
  EXPECT_EQ(testing::picture_of<2>(grid), before);
}

TEST(Grid, TellsHowManyCellsAreTooMany) {
  StructureConfig<2> config;
  config.bounds = {Vec<2>(0.0), Vec<2>(1e6)};
  config.cell = 0.5;
  config.levels = 1;
  config.open = false;
  try {
    Grid<2> grid(config);
    FAIL() << "4e12 cells";
  } catch (const Refused& why) {
    EXPECT_STREQ(why.what(),
                 "grid: 4e+12 cells of 0.5 are too many; take larger ones, or an open grid");
  }
}

TEST(GridRaster, CountsItsCells) {
  const GridRaster<2> raster({Vec<2>(0.0), Vec<2>(10, 4)}, 2, false);
  EXPECT_EQ(raster.cells(0), 5u);
  EXPECT_EQ(raster.cells(1), 2u);
  EXPECT_EQ(raster.cells(), 10);
}

// A query may ask for cells before the first that is in use.
TEST(GridLevel, HasABucketForEachCellOnBothSidesOfItsBase) {
  GridLevel<2> level;
  level.base = {3, -2};
  level.fold = {64, 64};
  const std::int64_t columns = level.buckets(0), rows = level.buckets(1);
  for (std::int64_t x = -columns; x <= columns; ++x)
    for (const std::int64_t y : {-rows, -rows + 1, std::int64_t{-1}, std::int64_t{0}}) {
      const std::uint32_t bucket = level.bucket({3 + x, -2 + y});
      EXPECT_LT(bucket, columns * rows);
      EXPECT_EQ(bucket, level.bucket({3 + x + columns, -2 + y + rows})) << x << ", " << y;
    }
}

}  // namespace
}  // namespace lantern::spatial
