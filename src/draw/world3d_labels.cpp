#include <algorithm>

#include "draw/font.hpp"
#include "draw/world3d_parts.hpp"

namespace lantern {
namespace {

constexpr std::size_t kMostNamed = 35;          // of more bodies, only those that the step is about
constexpr std::ptrdiff_t kMostQuietCells = 10;  // of more, only lit ones: in space names soon crowd
constexpr std::size_t kMostCells = 16;
constexpr double kWidestName = 210;

// Where no body is covered, so that each name is read as its own body's.
void name_body(const Body3D& b, const std::vector<Body3D>& bodies, const View3D& view,
               Labels& labels) {
  TextStyle style;
  style.halo = Role::panel;
  const std::string text = shortened(b.body->name, kWidestName, style);
  const auto anchors = anchors_around(b.box, 6, style);
  const Anchor* free =
      labels.free_anchor(text, anchors, style, shrunk(view.panel(), 4), [&](const Box<2>& extent) {
        const Outline corners = polygon_of(extent);
        return std::none_of(bodies.begin(), bodies.end(), [&](const Body3D& other) {
          return cover_each_other(other.outline, corners);
        });
      });
  if (free) labels.add(text, *free, style, view.panel());
}

// At the corner of the cell that lies farthest out on the page, so that no two of a node's eight
// children take the same one; on the cell's own side of it.
void name_cell(const FrameNode& node, const std::vector<Body3D>& bodies, const View3D& view,
               DrawList& list, Labels& labels) {
  const bool lit = node.mark == Mark::lit;
  const TextStyle style{18, Weight::semibold, lit ? Role::lit_ink : Role::quiet_ink};
  if (!view.in_front(node.box.center())) return;
  const Vec<2> middle = view.to_page(view.bounds().center());
  const Vec<2> own = view.to_page(node.box.center());
  std::vector<Vec<2>> corners;
  for (const Vec<3>& corner : corners_of(node.box)) {
    if (!view.in_front(corner)) return;
    corners.push_back(view.to_page(corner));
  }
  const Vec<2> size = box_of(corners).size();
  if (size.x < 60 || size.y < 60) return;
  std::stable_sort(corners.begin(), corners.end(), [&](const Vec<2>& a, const Vec<2>& b) {
    return glm::length(a - middle) > glm::length(b - middle);
  });
  const double half = text_width(node.label, style) / 2;
  for (const Vec<2>& corner : corners) {
    const Vec<2> inwards = own - corner;
    const double length = glm::length(inwards);
    if (!(length > 1)) continue;
    const Vec<2> at = corner + inwards * (std::min(0.5 * length, half + 20) / length);
    const Anchor anchor = centred(at, style);
    const Box<2> plate = plate_of(node.label, at, style, {5, 5});
    const Box<2> extent = Labels::extent(node.label, anchor, style);
    const bool covers = std::any_of(bodies.begin(), bodies.end(),
                                    [&](const Body3D& b) { return overlap(b.box, plate); });
    if (covers || !labels.is_free(extent, shrunk(view.panel(), 4))) continue;
    // Edges cross everywhere: a plate keeps them off the name.
    list.rect(plate, lit ? Role::lit_fill : Role::panel, {}, 5);
    return labels.add(node.label, anchor, style, view.panel());
  }
}

}  // namespace

void name_world3d(const Frame& frame, const std::vector<Body3D>& bodies, const View3D& view,
                  DrawList& list, Labels& labels) {
  for (const bool lit : {true, false})
    for (const Body3D& b : bodies)
      if (b.body->lit == lit && !b.body->name.empty() && (lit || bodies.size() <= kMostNamed))
        name_body(b, bodies, view, labels);
  std::vector<const FrameNode*> cells;
  for (const FrameNode& node : frame.nodes)
    if (node.leaf && node.depth > 0 && !node.of_static && !node.label.empty() &&
        is_valid(node.box) && (node.mark == Mark::lit || !node.bodies.empty()))
      cells.push_back(&node);
  const auto is_quiet = [](const FrameNode* n) { return n->mark != Mark::lit; };
  if (std::count_if(cells.begin(), cells.end(), is_quiet) > kMostQuietCells)
    std::erase_if(cells, is_quiet);
  std::stable_sort(cells.begin(), cells.end(), [](const FrameNode* a, const FrameNode* b) {
    return std::pair{a->mark != Mark::lit, a->depth} < std::pair{b->mark != Mark::lit, b->depth};
  });
  if (cells.size() > kMostCells) cells.resize(kMostCells);
  for (const FrameNode* cell : cells) name_cell(*cell, bodies, view, list, labels);
}

}  // namespace lantern
