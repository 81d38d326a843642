// Who sees whom in a level, against lines of sight at random and against each sight's own witness.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "spatial/level/level_bsp.hpp"
#include "spatial/level_oracles.hpp"
#include "spatial/levels.hpp"

namespace lantern::spatial::testing {
namespace {

double cross(const Vec<2>& a, const Vec<2>& b) { return a.x * b.y - a.y * b.x; }

// Does the segment meet the wall, or come closer than `near` to one of its ends?
bool meets(const Segment<2>& sight, const Segment<2>& wall, double near) {
  if (distance_to(sight, wall.a) < near || distance_to(sight, wall.b) < near) return true;
  const Vec<2> along = sight.b - sight.a, across = wall.b - wall.a;
  const double a = cross(along, wall.a - sight.a), b = cross(along, wall.b - sight.a);
  const double c = cross(across, sight.a - wall.a), d = cross(across, sight.b - wall.a);
  return (a > 0) != (b > 0) && (c > 0) != (d > 0);
}

bool is_clear(const Segment<2>& sight, const LevelBsp& bsp, double near) {
  return std::ranges::none_of(bsp.walls(), [&](const Wall& wall) {
    return !wall.two_sided && meets(sight, wall.line, near);
  });
}

void expect_witnesses(const LevelBsp& bsp, const LevelVisibility& seen) {
  std::uint64_t pairs = 0;
  for (std::uint32_t a = 0; a < seen.sectors; ++a)
    for (std::uint32_t b = 0; b < seen.sectors; ++b) {
      EXPECT_EQ(seen.sees(a, b), seen.sees(b, a));
      EXPECT_TRUE(seen.sees(a, a));
      pairs += a < b && seen.sees(a, b);
    }
  EXPECT_EQ(seen.sights.size(), pairs) << "a pair sees each other without a line of sight";
  for (const Sight& sight : seen.sights) {
    EXPECT_TRUE(seen.sees(sight.from, sight.to));
    EXPECT_TRUE(is_clear(sight.line, bsp, 0)) << sight.from << " to " << sight.to;
    for (const auto& [sector, end] :
         {std::pair{sight.from, sight.line.a}, std::pair{sight.to, sight.line.b}})
      EXPECT_GT(depth_in(bsp.sectors()[sector].floor, end), 0) << "it does not end in the sector";
  }
}

// A point of a sector's floor.
Vec<2> place_in(const LevelBsp& bsp, std::uint32_t sector, Random& random) {
  const Polygon& floor = bsp.sectors()[sector].floor;
  Vec<2> place{0.0};
  double all = 0;
  for (const Vec<2>& corner : floor) {
    const double weight = random.between(0.01, 1);
    place += corner * weight;
    all += weight;
  }
  return place / all;
}

// Lines that meet no wall join sectors that see each other. Returns how many there were.
int expect_lines(const LevelBsp& bsp, const LevelVisibility& seen, Random& random, int lines) {
  int clear = 0;
  for (int i = 0; i < lines; ++i) {
    const auto n = static_cast<double>(seen.sectors) - 1e-9;
    const auto a = static_cast<std::uint32_t>(random.between(0, n));
    const auto b = static_cast<std::uint32_t>(random.between(0, n));
    const Segment<2> line{place_in(bsp, a, random), place_in(bsp, b, random)};
    if (!is_clear(line, bsp, slack(bsp))) continue;
    ++clear;
    EXPECT_TRUE(seen.sees(a, b)) << a << " and " << b << " see each other";
  }
  return clear;
}

TEST(LevelVisibility, IsWhatLinesOfSightSay) {
  Random random(7);
  const LevelBsp bsp = compile_level(watchtower().walls, kWatchtowerBounds);
  const LevelVisibility seen = find_visibility(bsp);
  expect_witnesses(bsp, seen);
  EXPECT_GT(expect_lines(bsp, seen, random, 4000), 200);
  const std::uint64_t n = seen.sectors;
  EXPECT_LT(seen.sights.size(), n * (n - 1) / 2) << "nothing is hidden: the level tests nothing";
}

TEST(LevelVisibility, HoldsForAnyLevel) {
  for (const Style style : kStyles)
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE(fmt::format("style {} seed {}", static_cast<int>(style), seed));
      Random random(seed);
      const Level level = random_level(style, 6, random);
      const LevelBsp bsp = compile_level(level.walls, level.bounds);
      const LevelVisibility seen = find_visibility(bsp);
      expect_witnesses(bsp, seen);
      expect_lines(bsp, seen, random, 600);
    }
}

// Two rooms whose doors lead the same way into one passage: out of one door nobody sees back into
// the other.
TEST(LevelVisibility, SeesThePassageButNotBackThroughTheOtherDoor) {
  const Loops loops = {{{0, 0},
                        {4, 0},
                        {4, 1},
                        {7, 1},
                        {7, 10},
                        {4, 10},
                        {4, 11},
                        {0, 11},
                        {0, 7},
                        {4, 7},
                        {4, 9},
                        {6, 9},
                        {6, 2},
                        {4, 2},
                        {4, 4},
                        {0, 4}}};
  const LevelBsp bsp = compile_level(walls_of_loops(loops), {{0, 0}, {12, 12}});
  const LevelVisibility seen = find_visibility(bsp);
  const auto sector = [&](const Vec<2>& p) { return bsp.locate(p)->sector; };
  expect_witnesses(bsp, seen);
  EXPECT_TRUE(seen.sees(sector({1, 3.5}), sector({6.5, 1.5})));
  EXPECT_FALSE(seen.sees(sector({1, 3.5}), sector({1, 7.5})));
}

// Both halves of an L border on the other, and on nothing else but walls.
TEST(LevelVisibility, APortalLiesBetweenTwoSectors) {
  const Loops loops = {{{1, 1}, {4, 1}, {4, 4}, {7, 4}, {7, 7}, {1, 7}}};
  const LevelBsp bsp = compile_level(walls_of_loops(loops), {{0, 0}, {8, 8}});
  const LevelVisibility seen = find_visibility(bsp);
  ASSERT_EQ(seen.portals.size(), 1u);
  EXPECT_EQ(seen.portals[0].a, 0u);
  EXPECT_EQ(seen.portals[0].b, 1u);
  EXPECT_NEAR(length(seen.portals[0].line), 3, 1e-9);
}

TEST(LevelVisibility, TellsThePortalsAndThenEachSector) {
  const LevelBsp bsp = compile_level(watchtower().walls, kWatchtowerBounds);
  std::vector<std::uint32_t> done;
  find_visibility(bsp, {}, [&](const LevelVisibility& so_far) {
    EXPECT_FALSE(so_far.portals.empty());
    done.push_back(so_far.done);
  });
  ASSERT_EQ(done.size(), bsp.sectors().size() + 1);
  for (std::uint32_t i = 0; i < done.size(); ++i) EXPECT_EQ(done[i], i);
}

TEST(LevelVisibility, RefusesMoreThanItIsAllowed) {
  const LevelBsp bsp = compile_level(watchtower().walls, kWatchtowerBounds);
  EXPECT_THROW(find_visibility(bsp, {.most_sectors = 3}), Refused);
  EXPECT_THROW(find_visibility(bsp, {.most_tests = 10}), Refused);
  EXPECT_EQ(find_visibility(compile_level({}, kWatchtowerBounds)).sectors, 1u);
}

}  // namespace
}  // namespace lantern::spatial::testing
