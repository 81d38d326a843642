#include <algorithm>

#include "draw/font.hpp"
#include "draw/world2d_parts.hpp"

namespace lantern {
namespace {

constexpr std::size_t kMostLabels = 120;

// A dividing line's name, on a plate that sits on the line.
void label_planes(const Frame& frame, const View2D& map, const std::vector<Box<2>>& bodies,
                  DrawList& list, Labels& labels) {
  const TextStyle style{kLabel, Weight::semibold, Role::ink};
  for (const FrameNode& node : frame.nodes) {
    if (!node.plane || node.plane_name.empty()) continue;
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
  const Box<2> cell = map.to_page(node.box);
  TextStyle style{node.depth <= 1 ? 20.0 : 18.0, Weight::semibold, Role::quiet_ink};
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
  std::stable_sort(quarters.begin(), quarters.end(),
                   [](const Box<2>& a, const Box<2>& b) { return a.size().x > b.size().x; });
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

void label_cells(const Frame& frame, const View2D& map, const std::vector<Box<2>>& bodies,
                 const Grounds& grounds, DrawList& list, Labels& labels) {
  label_planes(frame, map, bodies, list, labels);
  // Of two trees only one has its leaves named, or the same names would stand there twice.
  const bool dynamic = std::any_of(frame.nodes.begin(), frame.nodes.end(),
                                   [](const FrameNode& node) { return !node.of_static; });
  std::vector<const FrameNode*> leaves;
  for (const FrameNode& node : frame.nodes)
    if (node.leaf && !node.label.empty() && !(node.of_static && dynamic)) leaves.push_back(&node);
  std::stable_sort(leaves.begin(), leaves.end(),
                   [](const FrameNode* a, const FrameNode* b) { return a->depth < b->depth; });
  if (leaves.size() > kMostLabels) leaves.resize(kMostLabels);
  for (const FrameNode* leaf : leaves) label_cell(*leaf, map, bodies, grounds, labels);
  label_unmade(frame, map, bodies, labels);
}

}  // namespace lantern
