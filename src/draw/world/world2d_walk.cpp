// What a ray, view or region left out of a 2D world and in which order a ray meets its cells, and
// the coordinates of the way down.
#include <algorithm>
#include <set>

#include "draw/number_text.hpp"
#include "draw/world/world2d_parts.hpp"

namespace lantern::draw {
namespace {

constexpr double kFromEdge = 22;  // of a cell, to a mark in its corner

// Places for a mark in a cell: its corners, the upper right one first, then its middle.
std::vector<Vec<2>> places_in(const Box<2>& cell) {
  const Box<2> corners = shrunk(cell, kFromEdge);
  if (corners.lo.x >= corners.hi.x || corners.lo.y >= corners.hi.y) return {cell.center()};
  return {{corners.hi.x, corners.lo.y},
          corners.hi,
          {corners.lo.x, corners.hi.y},
          corners.lo,
          cell.center()};
}

bool is_topmost_skipped(const FrameNode& node, const Frame& frame) {
  return node.skipped && (node.parent == kNone || !frame.nodes[node.parent].skipped);
}

// Draws at the first place that is free of bodies and of labels.
template <class Draw>
bool at_free_place(const Box<2>& cell, double radius, const std::vector<Box<2>>& bodies,
                   const Box<2>& room, Labels& labels, const Draw& draw) {
  for (const Vec<2>& at : places_in(cell)) {
    const Box<2> box = Box<2>::around(at, Vec<2>(radius));
    if (touches(bodies, box) || !labels.is_free(box, room) || !draw(at)) continue;
    labels.block(box);
    return true;
  }
  return false;
}

}  // namespace

void mark_walk(const Frame& frame, const View2D& map, const std::vector<Box<2>>& bodies,
               DrawList& list, Labels& labels) {
  constexpr std::size_t kMostMarks = 80;
  const Box<2> room = shrunk(map.picture(), 3);
  std::size_t drawn = 0;
  bool all = true;
  for (const FrameNode& node : frame.nodes) {
    const bool skipped = is_topmost_skipped(node, frame);
    if (!skipped && node.met == kNone) continue;
    if (++drawn > kMostMarks) return;
    const Box<2> cell = map.to_page(node.box);
    if (skipped)
      all &= at_free_place(cell, kSkipRadius + 1, bodies, room, labels, [&](const Vec<2>& at) {
        draw_skipped(at, list);
        return true;
      });
    else
      at_free_place(cell, 1, bodies, room, labels,
                    [&](const Vec<2>& at) { return draw_met(node.met, at, room, list, labels); });
  }
  if (drawn > 0 && all) list.referents.emplace("nodes_skipped");
}

void draw_coordinates(const Frame& frame, const View2D& map, DrawList& list, Labels& labels) {
  if (!frame.display.coordinates) return;
  const TextStyle style{std::max(kLabel, 22.0), Weight::semibold, Role::lit_ink, Role::panel};
  const Box<2>& picture = map.picture();
  constexpr double kTick = 12;
  std::set<double> done[2];
  for (const bool root : {true, false})
    for (const FrameNode& node : frame.nodes) {
      if ((node.depth == 0) != root || (!root && node.mark == Mark::quiet)) continue;
      for (int axis = 0; axis < 2; ++axis)
        for (const double at : {node.box.lo[axis], node.box.hi[axis]}) {
          if (!done[axis].insert(at).second) continue;
          const Vec<2> p = map.in_reach(map.to_page(axis == 0 ? Vec<2>(at, 0) : Vec<2>(0, at)));
          const std::string text = short_number(at);
          if (axis == 0) {
            const double y = picture.hi.y, align = p.x < picture.lo.x + 8   ? 0
                                                   : p.x > picture.hi.x - 8 ? 1
                                                                            : 0.5;
            list.line({p.x, y - kTick}, {p.x, y}, {Role::lit, 3.4});
            const double inwards = align == 0 ? 8 : align == 1 ? -8 : 0;
            labels.try_add(text, {{{p.x + inwards, y - kTick - 5}, align}}, style, picture);
          } else {
            const double x = picture.lo.x;
            const double below = p.y < picture.lo.y + 8   ? style.size
                                 : p.y > picture.hi.y - 8 ? -2 * style.size
                                                          : 0.36 * style.size;
            list.line({x, p.y}, {x + kTick, p.y}, {Role::lit, 3.4});
            labels.try_add(text, {{{x + kTick + 5, p.y + below}, 0}}, style, picture);
          }
        }
    }
}

}  // namespace lantern::draw
