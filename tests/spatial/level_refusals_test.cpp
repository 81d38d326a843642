#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "spatial/level/level_bsp.hpp"
#include "spatial/levels.hpp"

namespace lantern::spatial {
namespace {

constexpr Box<2> kBounds{{0, 0}, {8, 8}};

std::string refusal(const std::vector<Wall>& walls, const Box<2>& bounds = kBounds,
                    const LevelConfig& config = {}) {
  try {
    compile_level(walls, bounds, config);
  } catch (const Refused& e) {
    return e.what();
  }
  return "";
}

TEST(LevelRefusals, NameTheWallAndTheField) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const Wall good{{{1, 1}, {7, 1}}, false, "south"};
  EXPECT_EQ(refusal({good, {{{nan, 1}, {2, 2}}, false, ""}}), "wall 1: its end a is not finite");
  EXPECT_EQ(refusal({good, {{{1, 1}, {2, inf}}, false, "gate"}}),
            "wall 1 (gate): its end b is not finite");
  EXPECT_EQ(refusal({{{{1, 1}, {1, 1}}, false, "dot"}}),
            "wall 0 (dot): its ends a and b lie in one place");
  EXPECT_EQ(refusal({{{{1, 1}, {1 + 1e-12, 1}}, false, ""}}),
            "wall 0: its ends a and b lie in one place");
  EXPECT_EQ(refusal({{{{1, 1}, {9, 1}}, false, ""}}),
            "wall 0: its end b lies outside of the level's bounds");
}

TEST(LevelRefusals, BoundsAndConfig) {
  EXPECT_NE(refusal({}, {{0, 0}, {0, 8}}), "");
  EXPECT_NE(refusal({}, {{8, 0}, {0, 8}}), "");
  EXPECT_NE(refusal({}, {{0, 0}, {1e300, 8}}), "");
  EXPECT_NE(refusal({}, {{0, 0}, {1e-200, 1e-200}}), "");
  LevelConfig config;
  config.cut_weight = -1;
  EXPECT_EQ(refusal({}, kBounds, config), "level: its cut_weight must be finite and not negative");
  config = {};
  config.most_candidates = 0;
  EXPECT_NE(refusal({}, kBounds, config), "");
  config = {};
  config.most_depth = 1001;
  EXPECT_NE(refusal({}, kBounds, config), "");
}

// Behind each wall of a round pillar lie all others: no choice of lines makes its tree shallow.
TEST(LevelRefusals, ALevelThatNeedsTooMuchDepthOrTooManyPieces) {
  std::vector<Vec<2>> pillar;
  for (int i = 0; i < 40; ++i) {
    const double angle = i * 0.15707963267948966;
    pillar.push_back({4 + std::cos(angle), 4 + std::sin(angle)});
  }
  const auto walls = walls_of_loops(testing::Loops{{{1, 1}, {7, 1}, {7, 7}, {1, 7}}, pillar});
  EXPECT_EQ(refusal(walls), "");
  LevelConfig config;
  config.most_depth = 10;
  EXPECT_NE(refusal(walls, kBounds, config).find("deeper than 10"), std::string::npos);
  config = {};
  config.most_pieces = 44;
  EXPECT_NE(refusal(walls, kBounds, config).find("more than 44 pieces"), std::string::npos);
}

TEST(LevelRefusals, Loops) {
  const auto why = [](const testing::Loops& loops) {
    try {
      walls_of_loops(loops);
    } catch (const Refused& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(why({{{1, 1}, {2, 1}}}), "loop 0: it needs at least three corners");
  EXPECT_EQ(why({{{1, 1}, {2, 1}, {2, 1}}}), "loop 0: corner 1 and the next one are equal");
  EXPECT_EQ(why({{{1, 1}, {2, 1}, {2, std::nan("")}}}), "loop 0: corner 2 is not finite");
}

TEST(WallsOfLoops, FloorLiesOnTheLeftWhicheverWayALoopRuns) {
  for (int turned = 0; turned < 8; ++turned) {
    testing::Loops loops = {{{1, 1}, {7, 1}, {7, 7}, {1, 7}},
                            {{2, 2}, {6, 2}, {6, 6}, {2, 6}},
                            {{3, 3}, {5, 3}, {5, 5}, {3, 5}}};
    for (std::size_t i = 0; i < 3; ++i)
      if (turned & (1 << i)) std::ranges::reverse(loops[i]);
    const testing::Level level{walls_of_loops(loops), kBounds};
    EXPECT_EQ(testing::floor_area(level), 36 - 16 + 4) << "room, pillar, and a room in the pillar";
  }
}

// Walls that enclose nothing, cross each other, or lie on one another are odd maps, not faults.
TEST(OddMaps, CompileAndKeepEveryWallsLength) {
  Random random(5);
  for (int round = 0; round < 30; ++round) {
    std::vector<Wall> walls;
    for (int i = 0; i < 40; ++i) {
      const auto place = [&] {
        const double x = static_cast<double>(random.whole(0, 8));
        return Vec<2>{x + random.between(-1e-10, 1e-10) * (x > 0 && x < 8),
                      static_cast<double>(random.whole(0, 8))};
      };
      const Wall wall{{place(), place()}, random.bits() % 2 == 0, ""};
      if (length(wall.line) > 0.5) walls.push_back(wall);
    }
    walls.insert(walls.end(), walls.begin(), walls.begin() + 5);
    const LevelBsp bsp = compile_level(walls, kBounds);
    double before = 0, after = 0, regions = 0;
    for (const Wall& wall : bsp.walls()) before += length(wall.line) * (wall.two_sided ? 2 : 1);
    for (const WallPiece& piece : bsp.pieces()) {
      after += length(piece.line);
      ASSERT_LT(piece.sector, bsp.sectors().size()) << "a piece is in no sector";
    }
    for (const LevelSector& s : bsp.sectors()) regions += testing::area(bsp.nodes()[s.node].region);
    EXPECT_NEAR(after, before, 1e-5);
    EXPECT_NEAR(regions, 64, 1e-4);
  }
}

TEST(LevelRefusals, ScalesReachFrom2ToTheMinus300To2ToThe300) {
  const auto bounds = [](int exponent) {  // half of 2^exponent
    return Box<2>{Vec<2>(0.0), Vec<2>(std::ldexp(0.5, exponent))};
  };
  for (const int exponent : {-300, 300}) EXPECT_NO_THROW(LevelGrid{bounds(exponent)}) << exponent;
  for (const int exponent : {-301, 301}) EXPECT_THROW(LevelGrid{bounds(exponent)}, Refused);
}

}  // namespace
}  // namespace lantern::spatial
