// What the parts of the world panel share.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "draw/labels.hpp"
#include "geometry/flat.hpp"
#include "scenario/frame.hpp"

namespace lantern {

// From world to page: one scale for both axes, y turned over, the bounds centred in the panel.
struct WorldMap {
  Box<2> panel;
  Box<2> rect;  // of the bounds, on the page
  Vec<2> origin{0.0};
  double scale = 1;  // page units a world unit

  WorldMap(const Box<2>& bounds, const Box<2>& panel_box) : panel(panel_box) {
    constexpr double kMargin = 3;  // half of the thickest line
    const Vec<2> room = shrunk(panel, kMargin).size();
    const Vec<2> size = bounds.size();
    scale = std::min(size.x > 0 ? room.x / size.x : 1e300, size.y > 0 ? room.y / size.y : 1e300);
    if (scale == 1e300) scale = 1;
    origin = panel.center() - Vec<2>(bounds.center().x, -bounds.center().y) * scale;
    rect = to_page(bounds);
  }

  Vec<2> to_page(const Vec<2>& p) const { return origin + Vec<2>(p.x, -p.y) * scale; }
  Vec<2> to_page(const Vec<3>& p) const { return to_page(flat(p)); }
  Box<2> to_page(const Box<3>& box) const { return to_page(flat(box)); }
  Box<2> to_page(const Box<2>& box) const {
    return {in_reach(to_page(Vec<2>(box.lo.x, box.hi.y))),
            in_reach(to_page(Vec<2>(box.hi.x, box.lo.y)))};
  }

  // The cells that hold a half-space reach to the end of the numbers, far beyond what a renderer
  // takes: what lies out of all sight ends nearer.
  static Vec<2> in_reach(const Vec<2>& p) {
    constexpr double kReach = 4e5;
    return {std::clamp(p.x, -kReach, kReach), std::clamp(p.y, -kReach, kReach)};
  }
};

// A node's region on the page.
Polygon page_region(const FrameNode& node, const WorldMap& map);

// The piece of a node's dividing line that lies in its region, in the world; nothing if it misses
// it.
std::optional<std::pair<Vec<2>, Vec<2>>> dividing_line(const FrameNode& node);

// A convex region of the page whose border moved inwards, so that a line on it shows beside the
// dividing lines.
Polygon inset(const Polygon& region, double by);

// A region whose ground is not the panel's, so that a label's halo can match it.
struct Ground {
  Polygon region;  // on the page; clockwise there
  Role role = Role::panel;
};
using Grounds = std::vector<Ground>;

Role ground_at(const Grounds& grounds, const Vec<2>& point);

// The polygon holds the point; any convex polygon, either way round.
bool inside(const Polygon& polygon, const Vec<2>& point);

// The quarters of quadtree nodes for which no child was made, in the world.
std::vector<Box<2>> unmade_quarters(const Frame& frame);

// Cells and dividing lines; leaves what it painted in `grounds`. False if there are too many cells,
// and the smallest are left out.
bool draw_cells(const Frame& frame, const WorldMap& map, DrawList& list, Grounds& grounds);

// The lines of cells smaller than `place`, a body's box on the page, once more over what is drawn
// there: a body hides the splits that it causes.
void draw_cells_over(const Frame& frame, const WorldMap& map, const Box<2>& place, DrawList& list);

// The names of leaves in their corners, and of dividing lines. Bodies cover cells, so names keep
// clear of `bodies`, their boxes on the page.
void label_cells(const Frame& frame, const WorldMap& map, const std::vector<Box<2>>& bodies,
                 const Grounds& grounds, DrawList& list, Labels& labels);

}  // namespace lantern
