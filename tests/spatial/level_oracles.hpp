// What must hold of every compiled level, checked by brute force and closed forms.
#pragma once

#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "spatial/level/level_bsp.hpp"
#include "spatial/levels.hpp"

namespace lantern::spatial::testing {

// A length of the map that rounding and snapping together stay well below.
inline double slack(const LevelBsp& bsp) { return 16 * bsp.tolerance(); }

inline Vec<2> random_place(const Box<2>& box, Random& random) {
  const double x = random.between(box.lo.x, box.hi.x);
  return {x, random.between(box.lo.y, box.hi.y)};
}

inline void expect_convex(const Polygon& polygon, double error) {
  for (const Vec<2>& p : polygon)
    EXPECT_GE(depth_in(polygon, p), -error) << "a region is not convex";
}

inline void expect_regions(const Level& level, const LevelBsp& bsp) {
  const double extent = std::max(level.bounds.size().x, level.bounds.size().y);
  const double error = slack(bsp) * extent * static_cast<double>(bsp.nodes().size());
  double regions = 0, floors = 0;
  for (const LevelSector& sector : bsp.sectors()) {
    const LevelNode& node = bsp.nodes()[sector.node];
    expect_convex(node.region, slack(bsp));
    expect_convex(sector.floor, slack(bsp));
    regions += area(node.region);
    floors += area(sector.floor);
    EXPECT_FALSE(sector.floor.empty()) << "a sector has no floor";
  }
  const Vec<2> size = level.bounds.size();
  EXPECT_NEAR(regions, size.x * size.y, error) << "the leaves do not fill the bounds";
  EXPECT_NEAR(floors, floor_area(level), error)
      << "the sectors' floors are not the floor that the walls enclose";
}

inline void expect_pieces_in_one_place(const LevelBsp& bsp) {
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
      EXPECT_NEAR(depth_in(floor, end), 0, slack(bsp))
          << "a piece does not lie on the border of its sector's floor";
    EXPECT_GT(depth_in(floor, piece.line.middle() + line_of(piece.line).normal * (2 * slack(bsp))),
              0)
        << "the floor is not on the piece's left";
  }
}

// The pieces of each side of each wall, end to end, are the wall.
inline void expect_walls_whole(const LevelBsp& bsp) {
  std::map<std::pair<std::uint32_t, bool>, std::vector<Segment<2>>> sides;
  for (const WallPiece& piece : bsp.pieces()) sides[{piece.wall, piece.back}].push_back(piece.line);
  std::size_t expected = 0;
  for (const Wall& wall : bsp.walls()) expected += wall.two_sided ? 2 : 1;
  EXPECT_EQ(sides.size(), expected);
  for (auto& [side, parts] : sides) {
    Segment<2> whole = bsp.walls()[side.first].line;
    if (side.second) std::swap(whole.a, whole.b);
    std::ranges::sort(parts, {},
                      [&](const Segment<2>& s) { return glm::dot(s.a, whole.b - whole.a); });
    double total = 0;
    for (const Segment<2>& part : parts) total += length(part);
    EXPECT_NEAR(total, length(whole), slack(bsp)) << "splitting changed a wall's length";
    EXPECT_EQ(parts.front().a, whole.a);
    EXPECT_EQ(parts.back().b, whole.b);
    for (std::size_t i = 1; i < parts.size(); ++i) EXPECT_EQ(parts[i - 1].b, parts[i].a);
  }
}

inline void expect_located(const Level& level, const LevelBsp& bsp, Random& random) {
  for (int i = 0; i < 100; ++i) {
    const Vec<2> p = random_place(level.bounds, random);
    const auto place = bsp.locate(p);
    ASSERT_TRUE(place.has_value());
    const LevelNode& leaf = bsp.nodes()[bsp.sectors()[place->sector].node];
    EXPECT_EQ(place->nodes_visited, leaf.depth + 1);
    for (std::uint32_t s = 0; s < bsp.sectors().size(); ++s) {
      const Polygon& region = bsp.nodes()[bsp.sectors()[s].node].region;
      if (s == place->sector)
        EXPECT_GE(depth_in(region, p), -slack(bsp)) << "the sector is another one";
      else
        EXPECT_LE(depth_in(region, p), slack(bsp)) << "another sector holds the point";
    }
    const bool on_wall = std::ranges::any_of(
        level.walls, [&](const Wall& wall) { return distance_to(wall.line, p) < slack(bsp); });
    if (!on_wall) {
      EXPECT_EQ(place->floor, is_floor(level, p)) << "floor taken for stone";
    }
  }
}

// From where to where a ray is inside of a convex polygon; from > to when nowhere.
inline std::pair<double, double> span_inside(const Polygon& polygon, const Vec<2>& eye,
                                             const Vec<2>& along) {
  double from = 0, to = 1e300;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Segment<2> edge{polygon[i], polygon[(i + 1) % polygon.size()]};
    const Plane<2> line = line_of(edge);
    const double h = height(eye, line);
    const double rise = glm::dot(line.normal, along);
    if (rise > 0) from = std::max(from, -h / rise);
    if (rise < 0) to = std::min(to, -h / rise);
    if (rise == 0 && h < 0) return {1, 0};
  }
  return {from, to};
}

inline void expect_ordered(const Level& level, const LevelBsp& bsp, Random& random) {
  for (int e = 0; e < 5; ++e) {
    const Vec<2> eye = random_place(level.bounds, random);
    std::vector<std::uint32_t> order;
    bsp.front_to_back(eye, [&](std::uint32_t s) { return order.push_back(s), true; });
    ASSERT_EQ(order.size(), bsp.sectors().size());
    EXPECT_EQ(order[0], bsp.locate(eye)->sector) << "the eye's own sector is not the first";
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

inline void expect_chosen_well(const LevelBsp& bsp) {
  for (const LevelNode& node : bsp.nodes())
    if (!node.is_leaf()) {
      EXPECT_LE(node.chosen.score, node.first.score);
      EXPECT_TRUE(node.chosen.divides());
      EXPECT_GT(node.chosen.front + node.chosen.cuts, 0u);
    }
}

inline void expect_sound(const Level& level, const LevelBsp& bsp, Random& random) {
  expect_regions(level, bsp);
  expect_pieces_in_one_place(bsp);
  expect_walls_whole(bsp);
  expect_located(level, bsp, random);
  expect_ordered(level, bsp, random);
  expect_chosen_well(bsp);
}

}  // namespace lantern::spatial::testing
