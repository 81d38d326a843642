#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "draw/font.hpp"
#include "draw/pen.hpp"
#include "draw/world2d_parts.hpp"

namespace lantern::draw {
namespace {

constexpr std::size_t kMostSectors = 400;
constexpr std::size_t kMostWalls = 900;

// Two convex polygons that share more than a corner of their borders.
bool are_neighbours(const Polygon& a, const Polygon& b, double close) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec<2> p = a[i], along = a[(i + 1) % a.size()] - p;
    const double length = std::hypot(along.x, along.y);
    if (!(length > close)) continue;
    const Vec<2> unit = along / length;
    for (std::size_t j = 0; j < b.size(); ++j) {
      double at[2];
      bool on_line = true;
      for (const int end : {0, 1}) {
        const Vec<2> way = b[(j + static_cast<std::size_t>(end)) % b.size()] - p;
        on_line &= std::abs(unit.x * way.y - unit.y * way.x) < close;
        at[end] = unit.x * way.x + unit.y * way.y;
      }
      const double from = std::max(0.0, std::min(at[0], at[1]));
      const double to = std::min(length, std::max(at[0], at[1]));
      if (on_line && to - from > close) return true;
    }
  }
  return false;
}

std::vector<const FrameNode*> sectors_of(const Frame& frame) {
  std::vector<const FrameNode*> sectors;
  for (const FrameNode& node : frame.nodes)
    if (node.leaf && node.region.size() >= 3) sectors.push_back(&node);
  if (sectors.size() > kMostSectors) sectors.clear();
  return sectors;
}

// Each sector in turn takes the first tone that no neighbour before it has, or else the one that
// fewest have.
std::vector<unsigned> tones_of(const std::vector<Polygon>& regions) {
  constexpr double kClose = 0.5;  // page units
  std::vector<unsigned> tones;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    unsigned used[kSectorTones] = {};
    for (std::size_t j = 0; j < i; ++j)
      if (are_neighbours(regions[i], regions[j], kClose)) ++used[tones[j]];
    tones.push_back(static_cast<unsigned>(std::min_element(used, used + kSectorTones) - used));
  }
  return tones;
}

// The polygon's centre of area.
Vec<2> centroid(const Polygon& polygon) {
  Vec<2> sum{0.0};
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2> a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
    const double cross = a.x * b.y - a.y * b.x;
    sum += (a + b) * cross;
    area += cross;
  }
  return std::abs(area) > 1e-9 ? polygon[0] + sum / (3 * area) : polygon[0];
}

// Short strokes across the wall where it was cut in two.
void draw_cuts(const Frame& frame, const View2D& map, Pen& pen) {
  const auto drawn = first_of(frame.walls, kMostWalls);
  std::vector<FrameWall> walls(drawn.begin(), drawn.end());
  std::ranges::stable_sort(walls, {}, &FrameWall::wall);
  for (std::size_t i = 0; i < walls.size(); ++i)
    for (std::size_t j = i + 1; j < walls.size(); ++j) {
      const FrameWall &a = walls[i], &b = walls[j];
      if (a.wall != b.wall) break;
      const Vec<2> way = map.to_page(a.to) - map.to_page(a.from);
      const double length = std::hypot(way.x, way.y);
      if (!(length > 1e-6)) continue;
      const Vec<2> across = Vec<2>(-way.y, way.x) / length * 9.0;
      for (const Vec<2>& p : {map.to_page(a.from), map.to_page(a.to)})
        for (const Vec<2>& q : {map.to_page(b.from), map.to_page(b.to)})
          if (std::abs(p.x - q.x) < 0.5 && std::abs(p.y - q.y) < 0.5) {
            pen.line(p - across, p + across, {Role::panel, 6});
            pen.line(p - across, p + across, {Role::ink, 2.4});
          }
    }
}

}  // namespace

bool is_level(const Frame& frame) {
  if (!frame.walls.empty() || frame.eye) return true;
  return std::ranges::any_of(frame.nodes,
                             [](const FrameNode& n) { return n.solid || n.order != kNone; });
}

void fill_sectors(const Frame& frame, const View2D& map, DrawList& list, Grounds& grounds) {
  const std::vector<const FrameNode*> sectors = sectors_of(frame);
  std::vector<Polygon> regions;
  for (const FrameNode* sector : sectors) regions.push_back(page_region(*sector, map));
  const std::vector<unsigned> tones = tones_of(regions);
  Pen pen(list, map.picture());
  for (std::size_t i = 0; i < sectors.size(); ++i) {
    if (sectors[i]->mark != Mark::quiet) continue;  // painted as lit or passed
    const Role role = sectors[i]->solid ? Role::free_space : sector_role(tones[i]);
    pen.polygon(regions[i], role);
    grounds.push_back({regions[i], role});
  }
  for (std::size_t i = 0; i < sectors.size(); ++i)
    if (sectors[i]->solid) pen.hatch(regions[i], 13, 1, {Role::cell_line_3, 1.5}, 60);
}

void number_sectors(const Frame& frame, const View2D& map, const Grounds& grounds, Labels& labels) {
  for (const FrameNode* sector : sectors_of(frame)) {
    if (sector->order == kNone) continue;
    const Polygon region = page_region(*sector, map);
    const Vec<2> c = centroid(region);
    TextStyle style{30, Weight::semibold, Role::ink};
    const std::string number = fmt::format("{}", sector->order + 1);
    for (const double size : {34.0, 26.0, 20.0}) {
      style.size = size;
      const Anchor anchor = centred(c, style);
      const Box<2> box = shrunk(Labels::extent(number, anchor, style), -2);
      style.halo = ground_at(grounds, c);
      if (inside(region, box) && labels.try_add(number, {anchor}, style, map.picture())) break;
    }
  }
}

void draw_walls(const Frame& frame, const View2D& map, DrawList& list) {
  Pen pen(list, mark_limit(map));
  for (const Mark mark : {Mark::quiet, Mark::passed, Mark::lit})
    for (const FrameWall& wall : first_of(frame.walls, kMostWalls)) {
      if (wall.mark != mark) continue;
      const Vec<2> from = map.to_page(wall.from), to = map.to_page(wall.to);
      const double width = mark == Mark::lit ? 10 : mark == Mark::passed ? 6.5 : 5;
      pen.line(from, to, {Role::ink, width});
      if (mark == Mark::lit) pen.line(from, to, {Role::lit, 6});
    }
  draw_cuts(frame, map, pen);
}

}  // namespace lantern::draw
