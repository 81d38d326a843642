#include "draw/world2d_parts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "draw/font.hpp"
#include "draw/keys.hpp"

namespace lantern::draw {
namespace {

constexpr std::size_t kMostLabels = 120;

// A dividing line's name, on a plate that sits on the line.
void label_planes(const Frame& frame, const View2D& map, const std::vector<Box<2>>& bodies,
                  DrawList& list, Labels& labels) {
  const TextStyle style{kLabel, Weight::semibold, Role::ink};
  for (std::uint32_t i = 0; i < frame.nodes.size(); ++i) {
    const FrameNode& node = frame.nodes[i];
    if (!node.plane || node.plane_name.empty()) continue;
    const DrawList::Scope scope(list, node_key("world/plane name", frame.nodes, i));
    const auto line = dividing_line(node);
    if (!line) continue;
    Vec<2> a = map.in_reach(map.to_page(line->first));
    Vec<2> b = map.in_reach(map.to_page(line->second));
    if (b.y < a.y) std::swap(a, b);
    // Near the end of the first line; the others end on a line, where it would not be clear whose
    // name it is.
    for (const double t : {node.depth == 0 ? 0.92 : 0.7, 0.3, 0.5, 0.8, 0.2, 0.6, 0.4}) {
      const Vec<2> p = a + (b - a) * t;
      const Box<2> plate = plate_of(node.plane_name, p, style, {9, 7});
      if (touches(bodies, plate) || !labels.is_free(plate, shrunk(map.picture(), 6))) continue;
      const Role role = node.mark == Mark::lit ? Role::lit : cell_line_role(node.depth);
      list.rect(plate, Role::panel, {role, 1.8}, 6);
      labels.add(node.plane_name, centred(p, style), style, map.picture());
      labels.block(plate);
      break;
    }
  }
}

// A leaf's name in the corner of its cell that no body covers; without one it has none.
void label_cell(const FrameNode& node, const View2D& map, const std::vector<Box<2>>& bodies,
                const Grounds& grounds, Labels& labels) {
  const Box<2> whole = map.to_page(node.box), &picture = map.picture();
  const Box<2> cell{glm::clamp(whole.lo, picture.lo, picture.hi),
                    glm::clamp(whole.hi, picture.lo, picture.hi)};
  TextStyle style{kLeastLabel, Weight::semibold, Role::quiet_ink};
  if (node.mark == Mark::lit) style.role = Role::lit_ink;
  const double width = text_width(node.label, style);
  constexpr double kInset = 9;
  if (cell.size().x < width + 2 * kInset || cell.size().y < style.size + 2 * kInset) return;
  const double cap = cap_height(style.weight) * style.size;
  const double top = cell.lo.y + kInset + cap + 1, bottom = cell.hi.y - kInset;
  const Polygon region = inset(page_region(node, map), 5);
  const Anchor anchors[] = {{{cell.lo.x + kInset, top}, 0},
                            {{cell.hi.x - kInset, top}, 1},
                            {{cell.lo.x + kInset, bottom}, 0},
                            {{cell.hi.x - kInset, bottom}, 1},
                            centred(cell.center(), style)};
  const Anchor* free = labels.free_anchor(
      node.label, anchors, style, map.picture(),
      [&](const Box<2>& box) { return !touches(bodies, box) && inside(region, box); });
  if (!free) return;
  style.halo = ground_at(grounds, Labels::extent(node.label, *free, style).center());
  labels.add(node.label, *free, style, map.picture());
}

void label_unmade(const Frame& frame, const View2D& map, const std::vector<Box<2>>& bodies,
                  Labels& labels) {
  const TextStyle style{kLabel, Weight::regular, Role::quiet_ink, Role::paper};
  constexpr std::size_t kMostNamed = 3;  // then the hatching is known
  std::vector<Box<2>> quarters = unmade_quarters(frame);
  std::ranges::stable_sort(quarters, std::greater(), [](const Box<2>& q) { return q.size().x; });
  std::size_t named = 0;
  for (const Box<2>& quarter : quarters) {
    if (named == kMostNamed) return;
    const Box<2> box = map.to_page(quarter);
    const Anchor anchor{{box.center().x, box.center().y + 6}, 0.5};
    const Box<2> extent = Labels::extent("not made", anchor, style);
    if (!touches(bodies, extent) && holds(shrunk(box, 8), extent))
      named += labels.try_add("not made", {anchor}, style, map.picture());
  }
}

}  // namespace

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
  return std::ranges::all_of(corners,
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
  const bool dynamic =
      std::ranges::any_of(frame.nodes, [](const FrameNode& node) { return !node.of_static; });
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

void label_cells(const Frame& frame, const Staging& staging, const View2D& map,
                 const std::vector<Box<2>>& bodies, const Grounds& grounds, DrawList& list,
                 Labels& labels) {
  if (!frame.display.cells) return;
  label_planes(frame, map, bodies, list, labels);
  // Of two trees only one has its leaves named, or the same names would stand there twice.
  const bool dynamic =
      std::ranges::any_of(frame.nodes, [](const FrameNode& node) { return !node.of_static; });
  std::vector<const FrameNode*> leaves;
  for (const FrameNode& node : frame.nodes)
    if (node.leaf && !node.label.empty() && !(node.of_static && dynamic) && shows_id(staging, node))
      leaves.push_back(&node);
  std::ranges::stable_sort(leaves, {}, &FrameNode::depth);
  if (leaves.size() > kMostLabels) leaves.resize(kMostLabels);
  for (const FrameNode* leaf : leaves) {
    const auto at = static_cast<std::uint32_t>(leaf - frame.nodes.data());
    const DrawList::Scope scope(list, node_key("world/cell name", frame.nodes, at));
    label_cell(*leaf, map, bodies, grounds, labels);
  }
  if (frame.display.not_made) label_unmade(frame, map, bodies, labels);
}

}  // namespace lantern::draw
