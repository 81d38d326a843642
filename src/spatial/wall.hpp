// The walls of a level seen from above, and the grid on which their corners lie.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/polygon.hpp"
#include "geometry/segment.hpp"

namespace lantern::spatial {

// A wall's floor lies on its left, so the walls of a room run counter-clockwise, those of a pillar
// in it clockwise:
//
//     <-------------
//     |   floor    ^        Behind a one-sided wall, on its right, is solid stone. A two-sided
//     |   .--->    |        wall, such as a step or a window, has floor on both sides.
//     |   ^   |    |
//     |   <---v    |
//     v            |
//     ------------->
struct Wall {
  Segment<2> line;
  bool two_sided = false;
  std::string name;  // for messages; may be empty
};

// Map lengths below which a level does not distinguish. The scale is the largest coordinate of the
// bounds, rounded up to a power of two; corners are snapped to multiples of scale * 2^-46, and
// what lies within scale * 2^-38 of a line lies on it. Corners that are written with few binary
// digits do not move at all.
class LevelGrid {
 public:
  // Throws Refused for bounds that are not valid, have no width or height, or whose scale is not
  // within 2^-300 ... 2^300.
  explicit LevelGrid(const Box<2>& bounds);

  double tolerance() const { return tolerance_; }
  Vec<2> snapped(const Vec<2>& point) const;

  // The side of the line on which the point lies: 1 in front, -1 behind, 0 on it.
  int side(const Plane<2>& line, const Vec<2>& point) const;

  // As lantern::clipped, but corners within the tolerance lie on the line, and new ones are
  // snapped: a line that grazes a corner makes no sliver. Keeps nothing when no corner lies off the
  // line on the side that is kept.
  Polygon clipped(const Polygon& polygon, const Plane<2>& line, bool keep_front) const;

 private:
  double spacing_ = 0;
  double tolerance_ = 0;
};

// The walls, snapped. Throws Refused, naming the wall and the field, for an end that is not finite
// or lies outside of the bounds, and for a wall shorter than four tolerances.
std::vector<Wall> checked_walls(std::span<const Wall> walls, const Box<2>& bounds,
                                const LevelGrid& grid);

// One-sided walls round the floor that closed loops of corners enclose: what lies within an odd
// number of loops is floor, so a pillar is a loop within a room's. Each loop may run either way;
// it is turned so that its floor lies on its left. Loops must not cross. The walls are named
// "loop 2 wall 0", counted from 0. Throws Refused for a loop of fewer than three corners, a corner
// that is not finite, and two equal corners in succession.
std::vector<Wall> walls_of_loops(std::span<const std::vector<Vec<2>>> loops);

}  // namespace lantern::spatial
