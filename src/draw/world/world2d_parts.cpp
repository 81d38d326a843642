#include "draw/world/world2d_parts.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <span>

#include "base/words.hpp"
#include "draw/font.hpp"
#include "geometry/elementary.hpp"

namespace lantern::draw {
namespace {

constexpr std::size_t kMostLabels = 120;

// Of a level's many lines only those that are asked.
bool has_plate(const Frame& frame, const FrameNode& node) {
  return node.plane && !node.plane_name.empty() && dividing_line(node) &&
         (is_asked_line(frame, node) || !is_level(frame));
}

// The point and the plate, for each of the places.
std::array<std::pair<Vec<2>, Box<2>>, 7> plates_of(const FrameNode& node, const View2D& map) {
  const auto line = *dividing_line(node);
  Vec<2> a = map.in_reach(map.to_page(line.first));
  Vec<2> b = map.in_reach(map.to_page(line.second));
  if (b.y < a.y) std::swap(a, b);
  // Near the end of the first line; the others end on a line, where it would not be clear whose
  // name it is.
  const std::array<double, 7> places{node.depth == 0 ? 0.92 : 0.7, 0.3, 0.5, 0.8, 0.2, 0.6, 0.4};
  std::array<std::pair<Vec<2>, Box<2>>, 7> plates;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Vec<2> p = a + (b - a) * places[k];
    plates[k] = {p, plate_of(word(node.plane_name), p, kStrong, {9, 7})};
  }
  return plates;
}

// Of a plane, over the frames of a group: on how many each of its places is free of bodies, and its
// plates on the first of them.
struct PlateCounts {
  std::string plane;
  std::array<int, 7> free{};
  std::array<std::pair<Vec<2>, Box<2>>, 7> plates;
};

void count_plates(const Frame& frame, const Box<2>& panel, std::vector<PlateCounts>& counts) {
  const View2D map(flat(frame.bounds), panel, frame.view);
  const std::vector<Box<2>> covered = mapped(stands_of(frame, map), &Stand::box);
  const Box<2> room = shrunk(map.picture(), 6);
  for (std::uint32_t i = 0; i < frame.nodes.size(); ++i) {
    if (!has_plate(frame, frame.nodes[i])) continue;
    const std::string plane = node_key("world/plane name", frame.nodes, i);
    const auto plates = plates_of(frame.nodes[i], map);
    auto found = std::ranges::find(counts, plane, &PlateCounts::plane);
    if (found == counts.end()) found = counts.insert(found, {plane, {}, plates});
    for (std::size_t k = 0; k < plates.size(); ++k)
      found->free[k] += holds(room, plates[k].second) && !touches(covered, plates[k].second);
  }
}

// By the plane's key: its place, the same on all frames of the group, so that no name jumps when a
// body passes.
using PlatePlaces = std::map<std::string, std::size_t, std::less<>>;
const PlatePlaces& chosen_plates(const Staging& staging, const Box<2>& panel) {
  return staging.once<PlatePlaces>("plates of planes", panel, [&] {
    constexpr std::size_t kMostLookedAt = 120;  // frames of a group, here and there
    std::vector<PlateCounts> counts;
    for (const Frame* frame : staging.some_frames(kMostLookedAt))
      count_plates(*frame, panel, counts);
    PlatePlaces places;
    std::vector<Box<2>> taken;
    for (PlateCounts& plane : counts) {
      for (std::size_t k = 0; k < plane.free.size(); ++k)
        if (touches(taken, plane.plates[k].second)) plane.free[k] = -1;
      const auto best = std::ranges::max_element(plane.free) - plane.free.begin();
      places[plane.plane] = static_cast<std::size_t>(best);
      taken.push_back(plane.plates[places[plane.plane]].second);
    }
    return places;
  });
}

// A dividing line's name, on a plate that sits on the line. While something else is there it waits;
// on a frame that stands alone it may stand elsewhere.
void label_planes(const World2D& w) {
  for (const FrameNode& node : w.frame.nodes) {
    if (!has_plate(w.frame, node)) continue;
    const std::string key = node_key("world/plane name", w.frame.nodes, node);
    const DrawList::Scope scope(w.list, key);
    auto plates = plates_of(node, w.map);
    const PlatePlaces& places = chosen_plates(w.staging, w.map.panel());
    if (const auto found = places.find(key); found != places.end())
      std::swap(plates[0], plates[found->second]);
    const std::size_t tried = w.staging.frames().size() > 1 ? 1 : plates.size();
    for (const auto& [at, plate] : std::span(plates).first(tried)) {
      if (touches(w.covered, plate) || !w.labels.is_free(plate, shrunk(w.map.picture(), 6)))
        continue;
      const bool lit = node.mark == Mark::lit || is_level(w.frame);
      const Role role = lit ? Role::lit : cell_line_role(node.depth);
      w.list.rect(plate, Role::panel, {role, 1.8}, 6);
      w.labels.add(word(node.plane_name), centred(at, kStrong), kStrong, w.map.picture());
      w.labels.block(plate);
      break;
    }
  }
}

// A leaf's name in the corner of its cell that no body covers; without one it has none.
bool label_cell(const World2D& w, const FrameNode& node, const std::string& name) {
  const Box<2> whole = w.map.to_page(node.box), &picture = w.map.picture();
  const Box<2> cell{glm::clamp(whole.lo, picture.lo, picture.hi),
                    glm::clamp(whole.hi, picture.lo, picture.hi)};
  TextStyle style{kLeastLabel, Weight::semibold, Role::quiet_ink};
  if (node.mark == Mark::lit) style.role = Role::lit_ink;
  const double width = text_width(name, style);
  constexpr double kInset = 9;
  if (cell.size().x < width + 2 * kInset || cell.size().y < style.size + 2 * kInset) return false;
  const double cap = cap_height(style.weight) * style.size;
  const double top = cell.lo.y + kInset + cap + 1, bottom = cell.hi.y - kInset;
  const Polygon region = inset(page_region(node, w.map), 5);
  const Anchor anchors[] = {{{cell.lo.x + kInset, top}, 0},
                            {{cell.hi.x - kInset, top}, 1},
                            {{cell.lo.x + kInset, bottom}, 0},
                            {{cell.hi.x - kInset, bottom}, 1},
                            centred(cell.center(), style)};
  const Anchor* free = w.labels.free_anchor(
      name, anchors, style, w.map.picture(),
      [&](const Box<2>& box) { return !touches(w.covered, box) && inside(region, box); });
  if (!free) return false;
  style.halo = ground_at(w.grounds, Labels::extent(name, *free, style).center());
  w.labels.add(name, *free, style, w.map.picture());
  return true;
}

void label_unmade(const World2D& w) {
  const TextStyle style{kLabel, Weight::regular, Role::quiet_ink, Role::paper};
  constexpr std::size_t kMostNamed = 3;  // then the hatching is known
  std::vector<Unmade> unmade = unmade_quarters(w.frame);
  std::ranges::stable_sort(unmade, std::greater(),
                           [](const Unmade& one) { return one.quarter.size().x; });
  std::size_t named = 0;
  for (const Unmade& one : unmade) {
    if (named == kMostNamed) return;
    const Box<2> box = w.map.to_page(one.quarter);
    const Anchor anchor{{box.center().x, box.center().y + 6}, 0.5};
    for (const std::string& words : {say("{} not made", one.label), word("not made")}) {
      const Box<2> extent = Labels::extent(words, anchor, style);
      if (touches(w.covered, extent) || !holds(shrunk(box, 8), extent)) continue;
      named += w.labels.try_add(words, {anchor}, style, w.map.picture());
      break;
    }
  }
}

}  // namespace

Polygon page_region(const FrameNode& node, const View2D& map) {
  return mapped(node.region.empty() ? polygon_of(flat(node.box)) : node.region,
                [&](const Vec<2>& corner) { return map.in_reach(map.to_page(corner)); });
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
    const double length = geometry::hypot(along.x, along.y);
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

std::vector<Unmade> unmade_quarters(const Frame& frame) {
  std::vector<Unmade> quarters;
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
      const std::string way = node.parent == kNone ? "" : node.label + ".";
      quarters.push_back({quarter, way + std::to_string(slot + 1)});
    }
  }
  return quarters;
}

void label_cells(const World2D& w) {
  if (!w.frame.display.cells) return;
  label_planes(w);
  // Of two trees only one has its leaves named, or the same names would stand there twice.
  const bool dynamic =
      std::ranges::any_of(w.frame.nodes, [](const FrameNode& node) { return !node.of_static; });
  std::vector<const FrameNode*> leaves;
  for (const FrameNode& node : w.frame.nodes)
    if (node.leaf && !node.label.empty() && !(node.of_static && dynamic) && !is_level(w.frame) &&
        shows_id(w.staging, node))
      leaves.push_back(&node);
  std::ranges::stable_sort(leaves, {}, &FrameNode::depth);
  if (leaves.size() > kMostLabels) leaves.resize(kMostLabels);
  for (const FrameNode* leaf : leaves) {
    const DrawList::Scope scope(w.list, node_key("world/cell name", w.frame.nodes, *leaf));
    for (const std::string& name : leaf_names(w.frame, *leaf))
      if (label_cell(w, *leaf, name)) break;
  }
  if (w.frame.display.not_made) label_unmade(w);
}

}  // namespace lantern::draw
