#include "draw/world2d_parts.hpp"

#include <algorithm>
#include <cmath>

namespace lantern {

Polygon page_region(const FrameNode& node, const View2D& map) {
  Polygon region;
  for (const Vec<2>& corner : node.region.empty() ? polygon_of(flat(node.box)) : node.region)
    region.push_back(map.in_reach(map.to_page(corner)));
  return region;
}

std::optional<std::pair<Vec<2>, Vec<2>>> dividing_line(const FrameNode& node) {
  const Plane<2> plane = flat(*node.plane);
  const Polygon region = node.region.empty() ? polygon_of(flat(node.box)) : node.region;
  const Vec<2> along{-plane.normal.y, plane.normal.x};
  std::vector<Vec<2>> hits;
  for (std::size_t i = 0; i < region.size(); ++i) {
    const Vec<2> a = region[i], b = region[(i + 1) % region.size()];
    const double ha = height(a, plane), hb = height(b, plane);
    if (ha == 0) hits.push_back(a);
    if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0)) hits.push_back(a + (b - a) * (ha / (ha - hb)));
  }
  if (hits.size() < 2) return std::nullopt;
  const auto [first, last] =
      std::minmax_element(hits.begin(), hits.end(), [&](const Vec<2>& a, const Vec<2>& b) {
        return a.x * along.x + a.y * along.y < b.x * along.x + b.y * along.y;
      });
  return std::pair{*first, *last};
}

Polygon inset(const Polygon& region, double by) {
  Polygon kept = region;
  for (std::size_t i = 0; i < region.size(); ++i) {
    const Vec<2> a = region[i], along = region[(i + 1) % region.size()] - a;
    const double length = std::hypot(along.x, along.y);
    if (!(length > 0)) continue;
    const Vec<2> inwards = Vec<2>(along.y, -along.x) / length;  // of a page region
    kept = clipped(kept, Plane<2>::through(a + inwards * by, inwards), true);
  }
  return kept;
}

bool inside(const Polygon& polygon, const Vec<2>& point) {
  bool left = false, right = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2> a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double side = (b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x);
    (side < 0 ? left : right) = true;
  }
  return left != right;
}

bool inside(const Polygon& polygon, const Box<2>& box) {
  const Polygon corners = polygon_of(box);
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vec<2>& corner) { return inside(polygon, corner); });
}

Role ground_at(const Grounds& grounds, const Vec<2>& point) {
  for (const Ground& ground : grounds)
    if (inside(ground.region, point)) return ground.role;
  return Role::panel;
}

std::vector<Box<2>> unmade_quarters(const Frame& frame) {
  std::vector<Box<2>> quarters;
  if (frame.structure != StructureKind::quadtree) return quarters;
  std::vector<unsigned> made(frame.nodes.size());  // a bit for each child
  for (const FrameNode& node : frame.nodes)
    if (node.parent != kNone) made[node.parent] |= 1u << node.slot;
  // Of two trees only the dynamic one's: the other's would lie under cells that are there.
  const bool dynamic = std::any_of(frame.nodes.begin(), frame.nodes.end(),
                                   [](const FrameNode& node) { return !node.of_static; });
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    const FrameNode& node = frame.nodes[i];
    if (node.of_static && dynamic) continue;
    for (std::uint32_t slot = 0; slot < 4 && !node.leaf; ++slot) {
      if ((made[i] >> slot & 1u) != 0) continue;
      // In the lecture's order: upper left, upper right, lower left, lower right.
      Box<2> quarter = flat(node.box);
      const Vec<2> middle = quarter.center();
      ((slot & 1u) != 0 ? quarter.lo : quarter.hi).x = middle.x;
      ((slot & 2u) == 0 ? quarter.lo : quarter.hi).y = middle.y;
      quarters.push_back(quarter);
    }
  }
  return quarters;
}

}  // namespace lantern
