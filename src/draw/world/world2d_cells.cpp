#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "draw/world/borders.hpp"
#include "draw/world/world2d_parts.hpp"
#include "frame/parts/asked.hpp"
#include "frame/parts/ground.hpp"
#include "geometry/not_finite.hpp"

namespace lantern::draw {
namespace {

constexpr std::size_t kMostFills = 500;
constexpr std::size_t kMostPlanes = 400;
constexpr Role kSea = sector_role(0);  // around land
constexpr double kLeastCell = 1.5;     // page units; smaller ones are below what a line can show

// By depth, page units.
double line_width(std::uint32_t depth) {
  constexpr double kWidths[] = {4.6, 3.4, 2.3, 1.7, 1.3, 1.1};
  return depth < 6 ? kWidths[depth] : 1.0;
}

// How many children cover their parent without a gap; fitted boxes never do.
std::size_t children_that_cover(StructureKind kind) {
  // Nor do a grid's levels and buckets.
  const StructureTraits& traits = traits_of(kind);
  if (traits.hugs || has_cells(kind)) return ~std::size_t{0};
  return traits.names == NodeNames::sides ? 2 : 4;
}

struct Painted {
  std::size_t node;
  Mark tone;
};

// A level or bucket of a grid is nowhere: its cells are.
bool is_no_cell(const Frame& frame, const FrameNode& node) {
  return has_cells(frame.structure) && node.depth > 0 && !node.leaf;
}

// Which nodes are painted, and how, in order of painting. A node whose children cover it with one
// tone is painted as a whole; a lit inner node is painted when the step is about it alone, with
// nothing lit inside.
std::vector<Painted> painted_of(const Frame& frame) {
  const std::vector<FrameNode>& nodes = frame.nodes;
  // Of a level's regions only the floor is painted, not the stone between.
  const std::size_t all = is_level(frame) ? ~std::size_t{0} : children_that_cover(frame.structure);
  std::vector<std::optional<Mark>> tone(nodes.size());        // of the whole node, if it has one
  std::vector<std::optional<Mark>> child_tone(nodes.size());  // of the children seen so far
  std::vector<std::size_t> alike(nodes.size());
  std::vector<bool> lit_inside(nodes.size()), covered(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const FrameNode& node = nodes[i];
    if (node.leaf || (node.mark == Mark::lit && !lit_inside[i]))
      tone[i] = node.mark;
    else if (alike[i] == all)
      tone[i] = child_tone[i];
    if (node.parent == kNone) continue;
    if (node.mark == Mark::lit || lit_inside[i]) lit_inside[node.parent] = true;
    if (!tone[i] || (alike[node.parent] > 0 && child_tone[node.parent] != tone[i])) continue;
    ++alike[node.parent];
    child_tone[node.parent] = tone[i];
  }
  std::vector<Painted> found;
  // Parents stand before children, so whatever an ancestor covers falls out.
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::uint32_t parent = nodes[i].parent;
    covered[i] = parent != kNone && (covered[parent] || tone[parent].has_value());
    if (!covered[i] && tone[i] && *tone[i] != Mark::quiet) found.push_back({i, *tone[i]});
  }
  return found;
}

// The part of a cell that the picture shows.
Box<2> seen_of(const Box<2>& cell, const View2D& map) {
  return {glm::clamp(cell.lo, map.picture().lo, map.picture().hi),
          glm::clamp(cell.hi, map.picture().lo, map.picture().hi)};
}

// Boxes in an AABB tree end where those within them do. Those of a small tree's inner nodes are
// drawn a little larger, the more levels lie below the larger, so that all can be told apart.
double widening(const Frame& frame, const FrameNode& node) {
  constexpr std::size_t kSmall = 64;  // nodes
  constexpr double kLevel = 6;        // page units
  if (!traits_of(frame.structure).follows || node.leaf || frame.nodes.size() > kSmall) return 0;
  const std::uint32_t deepest = std::ranges::max_element(frame.nodes, {}, &FrameNode::depth)->depth;
  return kLevel * (deepest - node.depth);
}

// On the page. A structure without a rim may have cells beyond the world: of them, what is in it.
Box<2> cell_of(const World2D& w, const FrameNode& node) {
  const bool has_rim = !traits_of(w.frame.structure).follows && !has_cells(w.frame.structure);
  const Box<2> cell = shrunk(w.map.to_page(node.box), -widening(w.frame, node));
  return has_rim ? cell : seen_of(cell, w.map);
}

bool is_drawn(const Box<2>& cell) { return std::min(cell.size().x, cell.size().y) >= kLeastCell; }

// A quarter without a child: hatched from the lower left to the upper right.
void hatch(const Box<2>& box, DrawList& list) {
  constexpr double kSpace = 16;
  const Vec<2> size = box.size();
  for (double d = kSpace; d < size.x + size.y; d += kSpace) {  // x + y on the line, from a corner
    const Vec<2> from(std::min(d, size.x), std::max(0.0, d - size.x));
    const Vec<2> to(std::max(0.0, d - size.y), std::min(d, size.y));
    list.line(box.lo + from, box.lo + to, {Role::cell_line_3, 1.2});
  }
}

void hatch_unmade(const World2D& w) {
  constexpr double kLeastHatched = 30;
  constexpr std::size_t kMostShapes = 1200;
  for (const Unmade& unmade : unmade_quarters(w.frame)) {
    const Box<2> box = seen_of(w.map.to_page(unmade.quarter), w.map);
    if (std::min(box.size().x, box.size().y) < kLeastHatched) continue;
    if (w.list.shapes.size() > kMostShapes) return;
    w.list.crisp_rect(box, Role::paper);
    hatch(box, w.list);
    w.list.marks.add(MarkKind::not_made);
  }
}

// The tone would drown the bodies.
bool nearly_all_lit(const Frame& frame) {
  return frame.bodies.size() > 50 && is_nearly_all_lit(frame.nodes);
}

void paint_cell(World2D& w, const FrameNode& node, Role role) {
  w.grounds.push_back({page_region(node, w.map), role});
  if (node.region.empty())
    w.list.crisp_rect(cell_of(w, node), role);
  else
    w.list.polygon(w.grounds.back().region, role);
}

// What a ray, view or region has left out.
void fill_skipped(World2D& w) {
  std::size_t filled = 0;
  for (const FrameNode& node : w.frame.nodes) {
    if (!is_topmost_skipped(node, w.frame) || !is_drawn(cell_of(w, node))) continue;
    if (++filled > kMostFills) return;
    paint_cell(w, node, Role::free_space);
  }
}

void fill_cells(World2D& w) {
  if (nearly_all_lit(w.frame)) return;
  std::vector<Painted> painted = painted_of(w.frame);
  std::erase_if(painted, [&](const Painted& p) {
    // What the whole world has been passed for tells nothing.
    return (p.node == 0 && p.tone != Mark::lit) || is_no_cell(w.frame, w.frame.nodes[p.node]) ||
           !is_drawn(cell_of(w, w.frame.nodes[p.node]));
  });
  if (painted.size() > kMostFills) return;  // some alone would say what is not so
  for (const auto& [i, tone] : painted) {
    const FrameNode& node = w.frame.nodes[i];
    const DrawList::Scope scope(w.list, node_key("world/cell", w.frame.nodes, node),
                                parent_key("world/cell", w.frame.nodes, node));
    paint_cell(w, node, ground_of(tone));
    if (tone == Mark::passed)
      w.list.polygon(inset(w.grounds.back().region, kPassedInset), Role::none, kPassedStroke);
    w.list.marks.add(tone == Mark::lit ? MarkKind::lit : MarkKind::passed);
  }
}

// In a level the walls are what is strong, and the lines that divide it are thin and dashed; the
// one that is looked at now is not.
Stroke plane_stroke(const Frame& frame, const FrameNode& node, bool level) {
  const bool lit = node.mark == Mark::lit || (level && is_asked_line(frame, node));
  const Role role = lit ? Role::lit : cell_line_role(node.depth);
  if (level) return lit ? Stroke{role, 4, 14} : Stroke{role, 1.8, 6};
  if (node.region.empty()) return {role, lit ? 3.0 : 2.0, 8};  // inside a fitted box
  return {role, std::max(2.4, 4.6 - 0.7 * node.depth), 0};
}

void draw_planes(const World2D& w) {
  const bool level = is_level(w.frame);
  for (std::size_t i = std::min(w.frame.nodes.size(), kMostPlanes); i-- > 0;) {
    const FrameNode& node = w.frame.nodes[i];
    if (!node.plane) continue;
    const auto line = dividing_line(node);
    if (!line) continue;
    const Vec<2> a = w.map.in_reach(w.map.to_page(line->first));
    const Vec<2> b = w.map.in_reach(w.map.to_page(line->second));
    const bool upright = a.x == b.x || a.y == b.y;
    const std::string key = node_key("world/plane", w.frame.nodes, node);
    const DrawList::Scope scope(w.list, key, key);
    w.list.shapes.emplace_back(LineShape{a, b, plane_stroke(w.frame, node, level), upright});
  }
}

// Branches that sleep, each from its highest node on, have a tone: hatching is what is not made.
void tone_asleep(const World2D& w) {
  constexpr std::size_t kMostShapes = 1500;
  for (const FrameNode& node : w.frame.nodes) {
    const bool under_another = node.parent != kNone && !w.frame.nodes[node.parent].awake;
    if (!w.frame.sleeps(node) || under_another || !is_drawn(cell_of(w, node))) continue;
    if (w.list.shapes.size() > kMostShapes) return;
    std::vector<Vec<2>> ground = cut_to(page_region(node, w.map), w.map.picture());
    if (ground.empty()) continue;
    w.list.polygon(std::move(ground), Role::free_space);
    w.list.marks.add(MarkKind::sleeping_cell);
  }
}

// Of a grid of several levels the coarser cells have the stronger lines.
bool is_grid_level(const FrameNode& node) { return node.depth == 1 && node.label.starts_with('L'); }
std::uint32_t line_depth(const Frame& frame, const FrameNode& node, std::uint32_t coarsest) {
  if (!has_cells(frame.structure) || node.depth < 2) return node.depth;
  const FrameNode* above = &node;
  while (above->depth > 1) above = &frame.nodes[above->parent];
  return is_grid_level(*above) ? 1 + coarsest - above->slot : 1;
}

// Of a grid, where the cells lie that hold nothing; not of cells so small that lines would fill
// the picture.
void rule_grid(const World2D& w) {
  constexpr double kLeastRuled = 12;
  if (w.frame.get<FrameStructure>().grid_levels.empty()) return;
  const double side = w.frame.get<FrameStructure>().grid_levels[0].side;
  if (side * w.map.scale() < kLeastRuled) return;
  const DrawList::Scope scope(w.list, "world/ruled");
  const Box<2> picture = w.map.picture();
  for (const int axis : {0, 1})
    for (double at = w.frame.bounds.lo[axis] + side; at < w.frame.bounds.hi[axis]; at += side) {
      Vec<3> on = w.frame.bounds.lo;
      on[axis] = at;
      Vec<2> from = picture.lo, to = picture.hi;
      from[axis] = to[axis] = w.map.to_page(on)[axis];
      if (picture.lo[axis] < from[axis] && from[axis] < picture.hi[axis])
        w.list.crisp_line(from, to, {Role::cell_line_3, 1.2, 5});
    }
}

// Leaves as buckets.
void fill_levels(const World2D& w) {
  for (const FrameNode& node : w.frame.nodes) {
    if (node.of_static || !node.region.empty()) continue;
    if (const auto level = level_in(w.frame, node, cell_of(w, node))) {
      const DrawList::Scope scope(w.list, node_key("world/level", w.frame.nodes, node));
      w.list.crisp_rect(*level, Role::rule);
    }
  }
}

// The borders of the cells of what moves, or, in long dashes over them, of what never does, so that
// both can be told apart in one picture.
bool draw_borders(const World2D& w, bool of_static) {
  const bool fitted = traits_of(w.frame.structure).hugs && !of_static;
  bool complete = true;
  std::uint32_t coarsest = 0;
  for (const FrameNode& node : w.frame.nodes)
    if (is_grid_level(node)) coarsest = std::max(coarsest, node.slot);
  Borders borders;
  for (std::uint32_t i = 0; i < w.frame.nodes.size(); ++i) {
    const FrameNode& node = w.frame.nodes[i];
    // The root is the world, but for one that is fitted.
    if ((node.depth == 0 && !fitted) || !node.region.empty() || node.of_static != of_static ||
        is_no_cell(w.frame, node))
      continue;
    const Box<2> cell = cell_of(w, node);
    if (is_drawn(cell))
      borders.add(cell, line_depth(w.frame, node, coarsest), i);
    else if (overlap(shrunk(w.map.picture(), kLeastCell), w.map.to_page(node.box)))
      complete &= of_static;
  }
  const auto stroke = [&](std::uint32_t depth) {
    if (!of_static) return Stroke{cell_line_role(depth), line_width(depth)};
    return Stroke{Role::cell_line_3, std::max(1.6, 0.6 * line_width(depth)), 16};
  };
  const auto key = [&](std::uint32_t node) {
    return node_key("world/border", w.frame.nodes, node);
  };
  return borders.draw(stroke, key, w.list) && complete;
}

void outline_lit(const World2D& w) {
  if (nearly_all_lit(w.frame)) return;
  Borders borders;
  std::size_t outlined = 0;
  const auto key = [&](std::uint32_t node) { return node_key("world/lit", w.frame.nodes, node); };
  for (std::uint32_t i = 0; i < w.frame.nodes.size(); ++i) {
    const FrameNode& node = w.frame.nodes[i];
    if (node.mark != Mark::lit || !is_drawn(cell_of(w, node)) || is_no_cell(w.frame, node))
      continue;
    if (node.region.empty()) {
      borders.add(cell_of(w, node), std::min(node.depth, 6u), i);
    } else if (outlined++ < kMostFills) {
      const DrawList::Scope scope(w.list, key(i));
      w.list.polygon(inset(page_region(node, w.map), 4), Role::none, {Role::lit, 3.2});
    }
  }
  const auto stroke = [](std::uint32_t depth) {
    return Stroke{Role::lit, std::max(1.2, 3.6 - 0.4 * depth)};
  };
  borders.draw(stroke, key, w.list);
}

// The grounds of views, which lie under the cells.
Grounds fill_views(const World2D& w) {
  Grounds grounds;
  for (const FrameView& view : first_of(w.frame.get<FrameFinding>().views, kMostViews)) {
    const auto corners = mapped(view.corners, [&](const Vec<3>& c) { return w.map.to_page(c); });
    if (corners.size() < 3 || !std::ranges::all_of(corners, is_finite<2>)) continue;
    std::vector<Vec<2>> seen = cut_to(corners, w.map.picture());
    grounds.push_back({seen, Role::view_fill});
    w.list.marks.add(MarkKind::view);
    if (seen.empty()) continue;
    // From its first corner on, and with as many wherever it looks, so that it can turn.
    std::ranges::rotate(seen, std::ranges::min_element(seen, {}, [&](const Vec<2>& p) {
                          return glm::distance(p, corners[0]);
                        }));
    seen.resize(corners.size() + 4, seen.back());
    const DrawList::Scope scope(w.list, fmt::format("world/view/ground {}", grounds.size()));
    w.list.polygon(std::move(seen), Role::view_fill);
  }
  return grounds;
}

}  // namespace

bool draw_cells(World2D& w) {
  const auto& land = w.frame.get<FrameLand>();
  w.list.crisp_rect(w.map.picture(), land.land.empty() || !land.sea ? Role::panel : kSea);
  if (w.frame.display.cells && w.frame.display.not_made) hatch_unmade(w);
  const Grounds under = fill_views(w);  // of what the cells' own grounds lie on
  if (!w.frame.display.cells) {
    w.grounds = under;
    draw_land(w);
    w.list.crisp_rect(w.map.picture(), Role::none, {Role::cell_line_0, line_width(0), 0});
    return true;
  }
  fill_cells(w);
  fill_skipped(w);
  if (is_level(w.frame)) {
    const Grounds sectors = fill_sectors(w);  // over what is painted of inner nodes
    w.grounds.insert(w.grounds.begin(), sectors.begin(), sectors.end());
  }
  w.grounds.insert(w.grounds.end(), under.begin(), under.end());
  draw_land(w);
  tone_asleep(w);
  fill_levels(w);
  rule_grid(w);
  bool complete = draw_borders(w, false);
  complete &= draw_borders(w, true);
  outline_lit(w);
  draw_planes(w);
  const DrawList::Scope scope(w.list, "world/rim");
  if (traits_of(w.frame.structure).follows) {  // its root is not the world
    w.list.crisp_rect(w.map.picture(), Role::none, {Role::rule, 1.6});
    return complete;
  }
  const bool lit =
      !w.frame.nodes.empty() && !nearly_all_lit(w.frame) && w.frame.nodes[0].mark == Mark::lit;
  w.list.crisp_rect(w.map.picture(), Role::none,
                    {lit ? Role::lit : Role::cell_line_0, line_width(0), 0});
  return complete;
}

void draw_cells_over(const World2D& w, const Box<2>& place) {
  if (!w.frame.display.cells) return;
  constexpr double kLeastOver = 20;  // page units; smaller cells would hide the body in turn
  Borders borders;
  for (const FrameNode& node : w.frame.nodes) {
    const Box<2> cell = cell_of(w, node);
    const Vec<2> room = place.size() - cell.size();
    if (node.depth == 0 || !node.region.empty() || is_no_cell(w.frame, node) ||
        !overlap(cell, place) || std::min(cell.size().x, cell.size().y) < kLeastOver ||
        room.x <= 0 || room.y <= 0)
      continue;
    borders.add_inside(place, cell, node.depth);
  }
  borders.draw_plainly({Role::quiet_ink, 0.7}, w.list);
}

}  // namespace lantern::draw
