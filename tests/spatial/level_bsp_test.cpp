#include "spatial/level/level_bsp.hpp"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "geometry/not_finite.hpp"
#include "spatial/level_oracles.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::expect_sound;
using testing::Level;
using testing::random_place;
using testing::Style;

LevelBsp compile(const Level& level, const LevelConfig& config = {}) {
  return compile_level(level.walls, level.bounds, config);
}

TEST(LevelBsp, RandomLevelsAreSound) {
  for (const Style style : testing::kStyles)
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      SCOPED_TRACE(fmt::format("style {}, seed {}", static_cast<int>(style), seed));
      Random random(seed);
      const Level level = testing::random_level(style, 3 + static_cast<int>(seed), random);
      LevelConfig config;
      if (seed % 3 == 1) config.choose = LevelConfig::Choose::first_wall;
      if (seed % 3 == 2) config.most_candidates = 5;
      expect_sound(level, compile(level, config), random);
      if (::testing::Test::HasFailure()) return;
    }
}

TEST(LevelBsp, TheWatchtowerHas23Sectors) {
  const Level level = testing::watchtower();
  const LevelBsp bsp = compile(level);
  Random random(1);
  expect_sound(level, bsp, random);
  const LevelCounters c = bsp.counters();
  EXPECT_EQ(c.walls, 58u);
  EXPECT_EQ(c.sectors, 23u);
  EXPECT_EQ(c.nodes, 45u);
  EXPECT_EQ(c.depth, 6u);
  EXPECT_EQ(c.cuts, 5u);
  EXPECT_EQ(c.pieces, c.walls + c.cuts);

  LevelConfig config;
  config.choose = LevelConfig::Choose::first_wall;
  const LevelCounters first = compile(level, config).counters();
  EXPECT_GT(first.depth, c.depth) << "the first wall should make a worse tree";
  EXPECT_GT(first.chosen_score, 3 * c.chosen_score);
  EXPECT_EQ(first.chosen_score, first.first_score);
}

TEST(LevelBsp, SmallRoomsHaveTheSectorsThatOneWouldDraw) {
  const auto sectors = [](const testing::Loops& loops) {
    return compile_level(walls_of_loops(loops), {{0, 0}, {8, 8}}).sectors().size();
  };
  const std::vector<Vec<2>> room = {{1, 1}, {7, 1}, {7, 7}, {1, 7}};
  EXPECT_EQ(sectors({}), 1u) << "without walls all is one sector";
  EXPECT_EQ(sectors({room}), 1u) << "a convex room is one sector";
  EXPECT_EQ(sectors({{{1, 1}, {4, 1}, {4, 4}, {7, 4}, {7, 7}, {1, 7}}}), 2u) << "an L has two";
  EXPECT_EQ(sectors({room, {{3, 3}, {5, 3}, {5, 5}, {3, 5}}}), 4u) << "four round a pillar";
  EXPECT_EQ(sectors({{{1, 1}, {3, 1}, {3, 7}, {1, 7}}, {{4, 1}, {7, 1}, {7, 7}, {4, 7}}}), 2u)
      << "two rooms that do not touch are two sectors";
}

TEST(LevelBsp, ARegionIsConvexOnlyWhenNoWallDividesItHoweverFewAreTried) {
  LevelConfig config;
  config.most_candidates = 1;  // of an L, the first wall has all others in front
  const auto walls =
      walls_of_loops(testing::Loops{{{1, 1}, {4, 1}, {4, 4}, {7, 4}, {7, 7}, {1, 7}}});
  EXPECT_EQ(compile_level(walls, {{0, 0}, {8, 8}}, config).sectors().size(), 2u);
}

TEST(LevelBsp, CornersThatDifferByRoundingAreOneCorner) {
  const Box<2> bounds{{0, 0}, {8, 8}};
  const std::vector<Wall> walls = {{{{0.1 + 0.2, 1}, {7, 1}}, false, ""},
                                   {{{1, 7}, {0.3, 1}}, false, ""}};
  const LevelBsp bsp = compile_level(walls, bounds);
  EXPECT_NE(walls[0].line.a, walls[1].line.b);
  EXPECT_EQ(bsp.walls()[0].line.a, bsp.walls()[1].line.b);
}

TEST(LevelBsp, ATwoSidedWallDividesTheFloorAndHasAPieceForEachSide) {
  auto walls = walls_of_loops(testing::Loops{{{1, 1}, {7, 1}, {7, 7}, {1, 7}}});
  walls.push_back({{{4, 3}, {4, 5}}, true, "step"});
  const LevelBsp bsp = compile_level(walls, {{0, 0}, {8, 8}});
  EXPECT_EQ(bsp.sectors().size(), 2u);
  EXPECT_EQ(bsp.counters().cuts, 2u) << "the step's line cuts the walls below and above";
  const auto left = bsp.locate({2, 4}), right = bsp.locate({6, 4});
  EXPECT_TRUE(left->floor && right->floor) << "stone behind a two-sided wall";
  EXPECT_NE(left->sector, right->sector);
  std::set<std::uint32_t> sides;
  for (const WallPiece& piece : bsp.pieces())
    if (piece.wall == 4) sides.insert(piece.sector);
  EXPECT_EQ(sides.size(), 2u);
}

TEST(LevelBsp, TheSameWallsGiveTheSameBitsAndAnotherOrderTheSameFloor) {
  for (const Style style : testing::kStyles) {
    Random random(7);
    Level level = testing::random_level(style, 8, random);
    const LevelBsp a = compile(level), b = compile(level);
    ASSERT_EQ(a.pieces().size(), b.pieces().size());
    for (std::size_t i = 0; i < a.pieces().size(); ++i) {
      EXPECT_EQ(a.pieces()[i].line, b.pieces()[i].line);
      EXPECT_EQ(a.pieces()[i].sector, b.pieces()[i].sector);
    }
    for (std::size_t i = level.walls.size(); i > 1; --i)
      std::swap(
          level.walls[i - 1],
          level.walls[static_cast<std::size_t>(random.whole(0, static_cast<std::int64_t>(i) - 1))]);
    const LevelBsp shuffled = compile(level);
    expect_sound(level, shuffled, random);
    EXPECT_EQ(shuffled.nodes()[0].chosen.score, a.nodes()[0].chosen.score);
    for (int i = 0; i < 200; ++i) {
      const Vec<2> p = random_place(level.bounds, random);
      EXPECT_EQ(a.locate(p)->floor, shuffled.locate(p)->floor);
    }
  }
}

TEST(LevelBsp, TheObserverSeesTheBestCandidateChosenAndEveryCutAndSector) {
  const Level level = testing::watchtower();
  using Kind = LevelEvent::Kind;
  std::map<Kind, std::uint64_t> told;
  std::vector<LineChoice> candidates;
  const auto observer = [&](const LevelBsp& bsp, const LevelEvent& event) {
    ++told[event.kind];
    std::size_t held = 0;
    bsp.visit([&](const LevelNodeView& view) {
      if (view.leaf) held += view.pieces.size();
      return true;
    });
    EXPECT_EQ(held, bsp.pieces().size()) << "while it compiles, a piece is in no leaf";
    if (event.kind == Kind::consider) candidates.clear();
    if (event.kind == Kind::candidate) candidates.push_back(event.line);
    if (event.kind != Kind::choose) return;
    for (const LineChoice& c : candidates)
      if (c.divides()) {
        EXPECT_GE(std::pair(c.score, c.wall), std::pair(event.line.score, event.line.wall));
      }
  };
  const LevelBsp bsp = compile_level(level.walls, level.bounds, {}, observer);
  const LevelCounters c = bsp.counters();
  EXPECT_EQ(told[Kind::consider], c.nodes);
  EXPECT_EQ(told[Kind::candidate], c.candidates);
  EXPECT_EQ(told[Kind::choose], c.nodes - c.sectors);
  EXPECT_EQ(told[Kind::divide], c.nodes - c.sectors);
  EXPECT_EQ(told[Kind::sector], c.sectors);
  EXPECT_EQ(told[Kind::cut], c.cuts);
}

TEST(LevelBsp, TenThousandWallsNeedAReasonableNumberOfTests) {
  Random random(3);
  const Level level = testing::random_level(Style::crooked, 91, random);
  EXPECT_GT(level.walls.size(), 8000u);
  LevelConfig config;
  config.most_candidates = 32;
  const LevelBsp bsp = compile(level, config);
  const LevelCounters c = bsp.counters();
  EXPECT_LT(c.side_tests, 20'000'000u);
  EXPECT_LT(c.depth, 60u);
  EXPECT_LT(c.pieces, 3 * c.walls);
}

TEST(LevelBsp, PointsThatAreNowhereAreNotLocated) {
  const LevelBsp bsp = compile(testing::watchtower());
  EXPECT_FALSE(bsp.locate({-1, 4}));
  EXPECT_FALSE(bsp.locate({std::nan(""), 4}));
  EXPECT_TRUE(bsp.locate({1, 1})->floor) << "a corner of the walls is floor";
  EXPECT_FALSE(bsp.locate({15.5, 12})->floor) << "the middle of a pillar is stone";
  EXPECT_THROW(bsp.front_to_back({4, std::nan("")}, [](std::uint32_t) { return true; }), Refused);
  EXPECT_THROW(bsp.front_to_back({kNan, 4}, [](std::uint32_t) { return true; }), Refused);
  int walked = 0;
  bsp.front_to_back({4, 4}, [&](std::uint32_t) { return ++walked < 3; });
  EXPECT_EQ(walked, 3) << "the walk does not end when it is told to";
}

// Each corner lies on a dividing line or at the end of one.
TEST(LevelBsp, AnEyeOnALineSeesTheSectorInFrontOfItFirst) {
  const std::vector<Wall> walls =
      walls_of_loops(testing::Loops{{{1, 1}, {4, 1}, {4, 4}, {7, 4}, {7, 7}, {1, 7}}});
  const LevelBsp bsp = compile_level(walls, {{0, 0}, {8, 8}});
  ASSERT_EQ(bsp.sectors().size(), 2u);
  for (const Vec<2> eye : {Vec<2>(4, 5), Vec<2>(4, 6), Vec<2>(2, 4), Vec<2>(3, 4), Vec<2>(2, 2)}) {
    std::vector<std::uint32_t> near_first;
    bsp.front_to_back(eye, [&](std::uint32_t s) { return near_first.push_back(s), true; });
    EXPECT_EQ(near_first.front(), bsp.locate(eye)->sector);
    EXPECT_EQ(near_first[0] + near_first[1], 1u) << "each of the two once";
  }
}

// A square of two walls a side: four lines, each tried once, against each of the eight.
TEST(LevelBsp, WallsOnOneLineAreTriedOnce) {
  const std::vector<Wall> walls = walls_of_loops(
      testing::Loops{{{1, 1}, {4, 1}, {7, 1}, {7, 4}, {7, 7}, {4, 7}, {1, 7}, {1, 4}}});
  const LevelCounters c = compile_level(walls, {{0, 0}, {8, 8}}).counters();
  EXPECT_EQ(c.walls, 8u);
  EXPECT_EQ(c.pieces, 8u);
  EXPECT_EQ(c.candidates, 4u);
  EXPECT_EQ(c.side_tests, 32u);
  EXPECT_EQ(c.nodes, 1u);
  EXPECT_EQ(c.sectors, 1u);
  EXPECT_EQ(c.cuts, 0u);
  EXPECT_EQ(c.depth, 0u);
}

// Far above the origin, and leaning over so that of each side's ends neither tells on which side
// the pillar lies.
TEST(LevelBsp, APillarInALeaningRoomIsStoneWhicheverWayItsCornersRun) {
  const std::vector<Vec<2>> room = {{10, 10}, {14, 10}, {24, 20}, {20, 20}};
  const std::vector<Vec<2>> pillar = {{20.5, 18.5}, {21.5, 18.5}, {21.5, 19.5}, {20.5, 19.5}};
  for (const bool room_turned : {false, true})
    for (const bool pillar_turned : {false, true}) {
      testing::Loops loops = {room, pillar};
      if (room_turned) std::ranges::reverse(loops[0]);
      if (pillar_turned) std::ranges::reverse(loops[1]);
      const LevelBsp bsp = compile_level(walls_of_loops(loops), {{0, 0}, {32, 32}});
      EXPECT_FALSE(bsp.locate({21, 19})->floor) << "in the pillar";
      for (const Vec<2> beside :
           {Vec<2>(20, 19), Vec<2>(22, 19), Vec<2>(20.5, 18), Vec<2>(22, 19.7)})
        EXPECT_TRUE(bsp.locate(beside)->floor) << beside.x << ", " << beside.y;
    }
}

}  // namespace
}  // namespace lantern::spatial
