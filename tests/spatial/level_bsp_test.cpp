#include "spatial/level_bsp.hpp"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "spatial/levels.hpp"

namespace lantern {
namespace {

using testing::Level;
using testing::Style;

LevelBsp compile(const Level& level, const LevelConfig& config = {}) {
  return compile_level(level.walls, level.bounds, config);
}

// A length of the map that rounding and snapping together stay well below.
double slack(const LevelBsp& bsp) { return 16 * bsp.tolerance(); }

Vec<2> random_place(const Box<2>& box, Random& random) {
  const double x = random.between(box.lo.x, box.hi.x);
  return {x, random.between(box.lo.y, box.hi.y)};
}

void expect_convex(const Polygon& polygon, double error) {
  for (const Vec<2>& p : polygon)
    EXPECT_GE(testing::depth_in(polygon, p), -error) << "a region is not convex";
}

void expect_regions(const Level& level, const LevelBsp& bsp) {
  const double extent = std::max(level.bounds.size().x, level.bounds.size().y);
  const double error = slack(bsp) * extent * static_cast<double>(bsp.nodes().size());
  double regions = 0, floors = 0;
  for (const LevelSector& sector : bsp.sectors()) {
    const LevelNode& node = bsp.nodes()[sector.node];
    expect_convex(node.region, slack(bsp));
    expect_convex(sector.floor, slack(bsp));
    regions += testing::area(node.region);
    floors += testing::area(sector.floor);
    EXPECT_FALSE(sector.floor.empty()) << "a sector has no floor";
  }
  const Vec<2> size = level.bounds.size();
  EXPECT_NEAR(regions, size.x * size.y, error) << "the leaves do not fill the bounds";
  EXPECT_NEAR(floors, testing::floor_area(level), error)
      << "the sectors' floors are not the floor that the walls enclose";
}

void expect_pieces_in_one_place(const LevelBsp& bsp) {
  std::vector<int> in_leaves(bsp.pieces().size(), 0), on_nodes(bsp.pieces().size(), 0);
  for (NodeHandle n = 0; n < bsp.nodes().size(); ++n) {
    const LevelNode& node = bsp.nodes()[n];
    for (const std::uint32_t p : node.pieces) {
      const WallPiece& piece = bsp.pieces()[p];
      ++(node.is_leaf() ? in_leaves : on_nodes)[p];
      if (node.is_leaf())
        EXPECT_EQ(piece.sector, node.sector);
      else
        EXPECT_EQ(piece.node, n);
    }
  }
  for (std::size_t p = 0; p < bsp.pieces().size(); ++p) {
    const WallPiece& piece = bsp.pieces()[p];
    ASSERT_EQ(in_leaves[p], 1) << "a piece is not in exactly one leaf";
    EXPECT_EQ(on_nodes[p], piece.node == kNone ? 0 : 1);
    const Polygon& floor = bsp.sectors()[piece.sector].floor;
    for (const Vec<2>& end : {piece.line.a, piece.line.b})
      EXPECT_NEAR(testing::depth_in(floor, end), 0, slack(bsp))
          << "a piece does not lie on the border of its sector's floor";
    EXPECT_GT(testing::depth_in(
                  floor, piece.line.middle() + line_of(piece.line).normal * (2 * slack(bsp))),
              0)
        << "the floor is not on the piece's left";
  }
}

// The pieces of each side of each wall, end to end, are the wall.
void expect_walls_whole(const LevelBsp& bsp) {
  std::map<std::pair<std::uint32_t, bool>, std::vector<Segment>> sides;
  for (const WallPiece& piece : bsp.pieces()) sides[{piece.wall, piece.back}].push_back(piece.line);
  std::size_t expected = 0;
  for (const Wall& wall : bsp.walls()) expected += wall.two_sided ? 2 : 1;
  EXPECT_EQ(sides.size(), expected);
  for (auto& [side, parts] : sides) {
    Segment whole = bsp.walls()[side.first].line;
    if (side.second) std::swap(whole.a, whole.b);
    std::ranges::sort(parts, {},
                      [&](const Segment& s) { return glm::dot(s.a, whole.b - whole.a); });
    double total = 0;
    for (const Segment& part : parts) total += length(part);
    EXPECT_NEAR(total, length(whole), slack(bsp)) << "splitting changed a wall's length";
    EXPECT_EQ(parts.front().a, whole.a);
    EXPECT_EQ(parts.back().b, whole.b);
    for (std::size_t i = 1; i < parts.size(); ++i) EXPECT_EQ(parts[i - 1].b, parts[i].a);
  }
}

void expect_located(const Level& level, const LevelBsp& bsp, Random& random) {
  for (int i = 0; i < 100; ++i) {
    const Vec<2> p = random_place(level.bounds, random);
    const auto place = bsp.locate(p);
    ASSERT_TRUE(place.has_value());
    const LevelNode& leaf = bsp.nodes()[bsp.sectors()[place->sector].node];
    EXPECT_EQ(place->nodes_visited, leaf.depth + 1);
    for (std::uint32_t s = 0; s < bsp.sectors().size(); ++s) {
      const Polygon& region = bsp.nodes()[bsp.sectors()[s].node].region;
      if (s == place->sector)
        EXPECT_GE(testing::depth_in(region, p), -slack(bsp)) << "the sector is another one";
      else
        EXPECT_LE(testing::depth_in(region, p), slack(bsp)) << "another sector holds the point";
    }
    const bool on_wall = std::ranges::any_of(level.walls, [&](const Wall& wall) {
      return testing::distance_to(wall.line, p) < slack(bsp);
    });
    if (!on_wall) {
      EXPECT_EQ(place->floor, testing::is_floor(level, p)) << "floor taken for stone";
    }
  }
}

// From where to where a ray is inside of a convex polygon; from > to when nowhere.
std::pair<double, double> span_inside(const Polygon& polygon, const Vec<2>& eye,
                                      const Vec<2>& along) {
  double from = 0, to = 1e300;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Segment edge{polygon[i], polygon[(i + 1) % polygon.size()]};
    const Plane<2> line = line_of(edge);
    const double h = height_over(line, eye);
    const double rise = glm::dot(line.normal, along);
    if (rise > 0) from = std::max(from, -h / rise);
    if (rise < 0) to = std::min(to, -h / rise);
    if (rise == 0 && h < 0) return {1, 0};
  }
  return {from, to};
}

void expect_ordered(const Level& level, const LevelBsp& bsp, Random& random) {
  for (int e = 0; e < 5; ++e) {
    const Vec<2> eye = random_place(level.bounds, random);
    std::vector<std::uint32_t> order, reverse;
    bsp.front_to_back(eye, [&](std::uint32_t s) { return order.push_back(s), true; });
    bsp.back_to_front(eye, [&](std::uint32_t s) { return reverse.push_back(s), true; });
    ASSERT_EQ(order.size(), bsp.sectors().size());
    EXPECT_EQ(order[0], bsp.locate(eye)->sector) << "the eye's own sector is not the first";
    std::ranges::reverse(reverse);
    EXPECT_EQ(order, reverse) << "the painter's order is not the reverse";
    for (int r = 0; r < 20; ++r) {
      const Vec<2> along = glm::normalize(random_place(level.bounds, random) - eye);
      double reached = 0;
      for (const std::uint32_t s : order) {
        const auto [from, to] = span_inside(bsp.nodes()[bsp.sectors()[s].node].region, eye, along);
        if (to - from <= 4 * slack(bsp)) continue;
        EXPECT_GE(from, reached - 4 * slack(bsp)) << "a sector farther along a ray came first";
        reached = to;
      }
    }
  }
}

void expect_chosen_well(const LevelBsp& bsp) {
  for (const LevelNode& node : bsp.nodes())
    if (!node.is_leaf()) {
      EXPECT_LE(node.chosen.score, node.first.score);
      EXPECT_TRUE(node.chosen.divides());
      EXPECT_GT(node.chosen.front + node.chosen.cuts, 0u);
    }
}

void expect_sound(const Level& level, const LevelBsp& bsp, Random& random) {
  expect_regions(level, bsp);
  expect_pieces_in_one_place(bsp);
  expect_walls_whole(bsp);
  expect_located(level, bsp, random);
  expect_ordered(level, bsp, random);
  expect_chosen_well(bsp);
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

TEST(LevelBsp, ItsPlanesMakeABspForBodies) {
  const LevelBsp level = compile(testing::watchtower());
  Bsp<2> bodies(level.planes(), level.bounds());
  EXPECT_EQ(bodies.counters().nodes, level.counters().nodes);
  EXPECT_EQ(bodies.counters().depth, level.counters().depth);
  std::vector<const Plane<2>*> planes;
  level.visit([&](const LevelNodeView& view) { return planes.push_back(view.plane), true; });
  std::size_t i = 0;
  bodies.visit([&](const NodeView<2>& view) {
    EXPECT_EQ(view.plane == nullptr, planes[i] == nullptr);
    if (view.plane && planes[i]) {
      EXPECT_EQ(view.plane->normal, planes[i]->normal);
    }
    return ++i, true;
  });
  EXPECT_EQ(i, planes.size());
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
  int walked = 0;
  bsp.front_to_back({4, 4}, [&](std::uint32_t) { return ++walked < 3; });
  EXPECT_EQ(walked, 3) << "the walk does not end when it is told to";
}

}  // namespace
}  // namespace lantern
