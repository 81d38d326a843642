// Levels for the tests of the level's BSP: one made by hand, and seeded random ones.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "base/random.hpp"
#include "spatial/level/level_bsp.hpp"

namespace lantern::spatial::testing {

using Loops = std::vector<std::vector<Vec<2>>>;

// A map of 32 x 18: a hall in the west, a courtyard with two pillars, a tower in the east, a
// storeroom and a cellar in the south, and corridors that join them round two blocks of stone.
inline Loops watchtower_loops() {
  return {{{1, 1},     {31, 1},  {31, 6},      {30, 6},      {30, 9},    {31, 10.5}, {31, 14.5},
           {29.5, 16}, {27, 16}, {25.5, 14.5}, {25.5, 12.5}, {23, 12.5}, {23, 14},   {21, 16},
           {14, 16},   {12, 14}, {12, 11},     {9, 11},      {9, 12.5},  {7.5, 14},  {2.5, 14},
           {1, 12.5},  {1, 7.5}, {2.5, 6},     {4, 6},       {4, 4},     {1, 4}},
          {{9, 3},
           {16.5, 3},
           {16.5, 4},
           {14, 4},
           {12, 6},
           {12, 9},
           {9, 9},
           {9, 7.5},
           {7.5, 6},
           {6, 6},
           {6, 4},
           {9, 4}},
          {{18.5, 3},
           {24, 3},
           {24, 6},
           {28, 6},
           {28, 9},
           {27, 9},
           {25.5, 10.5},
           {23, 10.5},
           {23, 6},
           {21, 4},
           {18.5, 4}},
          {{14.5, 12}, {15.5, 11}, {16.5, 12}, {15.5, 13}},
          {{18.5, 8}, {19.5, 7}, {20.5, 8}, {19.5, 9}}};
}
inline constexpr Box<2> kWatchtowerBounds{{0, 0}, {32, 18}};

struct Level {
  std::vector<Wall> walls;
  Box<2> bounds;
};

inline Level watchtower() { return {walls_of_loops(watchtower_loops()), kWatchtowerBounds}; }

enum class Style {
  aligned,  // many walls lie on one line, and many lines meet in one point
  crooked,  // every corner is moved a little: no two walls lie on one line
  turned,   // as aligned, but turned, so that lines agree only up to rounding
  far,      // as crooked, 1e6 from the origin
  tiny,     // as turned, a millionth of the size
};
inline constexpr std::array kStyles = {Style::aligned, Style::crooked, Style::turned, Style::far,
                                       Style::tiny};

// Rooms, corridors and pillars: open cells of a grid, in a frame of stone. Between two open cells
// there is a two-sided wall now and then.
inline Level random_level(Style style, int cells, Random& random) {
  const int n = cells + 2;
  const auto at = [n](int x, int y) { return static_cast<std::size_t>(y * (n + 1) + x); };
  std::vector<Vec<2>> corners;
  std::vector<char> open(static_cast<std::size_t>((n + 1) * (n + 1)), 0);
  const double wobble = style == Style::crooked || style == Style::far ? 0.25 : 0;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      const double dx = random.between(-wobble, wobble), dy = random.between(-wobble, wobble);
      Vec<2> p{x + dx, y + dy};
      if (style == Style::turned || style == Style::tiny)
        p = {p.x * 0.6 - p.y * 0.8, p.x * 0.8 + p.y * 0.6};
      if (style == Style::tiny) p *= 1e-6;
      if (style == Style::far) p += 1e6;
      corners.push_back(p);
      const bool inside = x > 0 && y > 0 && x + 1 < n && y + 1 < n;
      open[at(x, y)] = inside && random.bits() % 5 < 3 ? 1 : 0;
    }
  Level level;
  const int steps[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  for (int y = 1; y < n; ++y)
    for (int x = 1; x < n; ++x) {
      if (!open[at(x, y)]) continue;
      const std::size_t ring[5] = {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1),
                                   at(x, y)};
      for (int k = 0; k < 4; ++k) {
        const bool floor_beyond = open[at(x + steps[k][0], y + steps[k][1])] != 0;
        if (floor_beyond && (k < 2 || random.bits() % 8 != 0)) continue;
        level.walls.push_back({{corners[ring[k]], corners[ring[k + 1]]}, floor_beyond, ""});
      }
    }
  level.bounds = {corners[0], corners[0]};
  for (const Vec<2>& p : corners) level.bounds = united(level.bounds, {p, p});
  return level;
}

// Twice the area on the left of a closed loop, seen from `origin`.
inline double doubled_area(const Segment<2>& s, const Vec<2>& origin) {
  const Vec<2> a = s.a - origin, b = s.b - origin;
  return a.x * b.y - a.y * b.x;
}

inline double area(const Polygon& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum += doubled_area({polygon[i], polygon[(i + 1) % polygon.size()]}, polygon[0]);
  return sum / 2;
}

// Of the floor that closed loops of one-sided walls enclose.
inline double floor_area(const Level& level) {
  double sum = 0;
  for (const Wall& wall : level.walls)
    if (!wall.two_sided) sum += doubled_area(wall.line, level.bounds.lo);
  return sum / 2;
}

// Whether a ray to the right of the point crosses an odd number of one-sided walls.
inline bool is_floor(const Level& level, const Vec<2>& p) {
  bool odd = false;
  for (const Wall& wall : level.walls) {
    const auto& [a, b] = wall.line;
    if (wall.two_sided || (a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y))) odd = !odd;
  }
  return odd;
}

// The least height of the point over the polygon's edges: positive inside.
inline double depth_in(const Polygon& polygon, const Vec<2>& p) {
  double least = polygon.empty() ? -1e300 : 1e300;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Segment<2> edge{polygon[i], polygon[(i + 1) % polygon.size()]};
    if (edge.a != edge.b) least = std::min(least, height(p, line_of(edge)));
  }
  return least;
}

inline double distance_to(const Segment<2>& s, const Vec<2>& p) {
  const Vec<2> along = s.b - s.a;
  const double t = std::clamp(glm::dot(p - s.a, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::length(p - (s.a + along * t));
}

}  // namespace lantern::spatial::testing
