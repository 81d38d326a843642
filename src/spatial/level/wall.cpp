#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/stop.hpp"
#include "spatial/level/level_bsp.hpp"

namespace lantern::spatial {

namespace {

[[noreturn]] void refuse(const Wall& wall, std::size_t index, const std::string& why) {
  const std::string name = wall.name.empty() ? "" : fmt::format(" ({})", wall.name);
  throw Refused(fmt::format("wall {}{}: {}", index, name, why));
}

// Whether the ray from the point to the right meets the edge. Half open, so that a corner between
// two edges counts once.
bool ray_meets(const Vec<2>& p, const Vec<2>& a, const Vec<2>& b) {
  if ((a.y > p.y) == (b.y > p.y)) return false;
  return p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y));
}

bool is_floor(const Vec<2>& p, std::span<const std::vector<Vec<2>>> loops) {
  bool odd = false;
  for (const auto& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (ray_meets(p, loop[i], loop[(i + 1) % loop.size()])) odd = !odd;
  return odd;
}

void require_loop(const std::vector<Vec<2>>& loop, std::size_t index) {
  if (loop.size() < 3)
    throw Refused(fmt::format("loop {}: it needs at least three corners", index));
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (!std::isfinite(loop[i].x) || !std::isfinite(loop[i].y))
      throw Refused(fmt::format("loop {}: corner {} is not finite", index, i));
    if (loop[i] == loop[(i + 1) % loop.size()])
      throw Refused(fmt::format("loop {}: corner {} and the next one are equal", index, i));
  }
}

}  // namespace

LevelGrid::LevelGrid(const Box<2>& bounds) {
  if (!is_valid(bounds)) throw Refused("level: its bounds are not finite or inverted");
  double largest = 0;
  for (int i = 0; i < 2; ++i) {
    if (bounds.lo[i] == bounds.hi[i])
      throw Refused(fmt::format("level: its bounds have no extent on axis {}", "xy"[i]));
    largest = std::max({largest, std::abs(bounds.lo[i]), std::abs(bounds.hi[i])});
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  if (exponent < -300 || exponent > 300)
    throw Refused("level: the coordinates of its bounds are too large or too small");
  spacing_ = std::ldexp(1.0, exponent - 46);
  tolerance_ = std::ldexp(1.0, exponent - 38);
}

Vec<2> LevelGrid::snapped(const Vec<2>& point) const {
  return {std::nearbyint(point.x / spacing_) * spacing_,
          std::nearbyint(point.y / spacing_) * spacing_};
}

int LevelGrid::side(const Plane<2>& line, const Vec<2>& point) const {
  const double h = height(point, line);
  return h > tolerance_ ? 1 : h < -tolerance_ ? -1 : 0;
}

Polygon LevelGrid::clipped(const Polygon& polygon, const Plane<2>& line, bool keep_front) const {
  const int wanted = keep_front ? 1 : -1;
  Polygon kept;
  bool any = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>& from = polygon[i];
    const Vec<2>& to = polygon[(i + 1) % polygon.size()];
    const int s = side(line, from) * wanted;
    if (s >= 0) kept.push_back(from);
    any = any || s > 0;
    if (s * side(line, to) * wanted >= 0) continue;
    const double a = height(from, line);
    const double b = height(to, line);
    kept.push_back(snapped(from + (to - from) * (a / (a - b))));
  }
  if (kept.size() < 3 || !any) kept.clear();
  return kept;
}

std::vector<Wall> checked_walls(std::span<const Wall> walls, const Box<2>& bounds,
                                const LevelGrid& grid) {
  std::vector<Wall> checked(walls.begin(), walls.end());
  for (std::size_t i = 0; i < checked.size(); ++i) {
    Wall& wall = checked[i];
    for (Vec<2>* end : {&wall.line.a, &wall.line.b}) {
      const char name = end == &wall.line.a ? 'a' : 'b';
      if (!std::isfinite(end->x) || !std::isfinite(end->y))
        refuse(wall, i, fmt::format("its end {} is not finite", name));
      if (!contains(bounds, *end))
        refuse(wall, i, fmt::format("its end {} lies outside of the level's bounds", name));
      *end = grid.snapped(*end);
    }
    if (!(length(wall.line) >= 4 * grid.tolerance()))
      refuse(wall, i, "its ends a and b lie in one place");
  }
  return checked;
}

std::vector<Wall> walls_of_loops(std::span<const std::vector<Vec<2>>> loops) {
  for (std::size_t i = 0; i < loops.size(); ++i) require_loop(loops[i], i);
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    stop_if_asked();  // each loop is held against all others
    const auto& loop = loops[i];
    const Segment<2> first{loop[0], loop[1]};
    const Vec<2> along = first.b - first.a;
    const Vec<2> beside = first.middle() + Vec<2>(-along.y, along.x) * 0x1p-20;
    const bool keep = is_floor(beside, loops);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      Segment<2> s{loop[k], loop[(k + 1) % loop.size()]};
      if (!keep) std::swap(s.a, s.b);
      walls.push_back({s, false, fmt::format("loop {} wall {}", i, k)});
    }
  }
  return walls;
}

}  // namespace lantern::spatial
