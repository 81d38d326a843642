#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include <fmt/format.h>

#include "draw/keys.hpp"
#include "draw/world/world3d_parts.hpp"
#include "geometry/elementary.hpp"

namespace lantern::draw {
namespace {

// What reaches without end, as a box around the ground does, has no picture.
bool is_drawable(const Box<3>& box) {
  constexpr double kFar = 1e12;
  return is_valid(box) && contains(Box<3>{Vec<3>(-kFar), Vec<3>(kFar)}, box.lo) &&
         contains(Box<3>{Vec<3>(-kFar), Vec<3>(kFar)}, box.hi);
}

constexpr std::size_t kMostEdges = 500;
constexpr std::size_t kMostEdgesInCrowd = 250;  // lines must not hide a crowd of dots
constexpr std::size_t kMostFills3d = 300;

// How strongly an edge is drawn. Smaller is stronger, and wins where edges of several cells lie on
// one line.
struct Strength {
  int lit = 1;              // 0 of a lit cell
  std::uint32_t depth = 0;  // of the cell
  int dashed = 0;           // 1 of a cell that sleeps, 2 of the tree of what never moves
  int quiet = 0;            // 1 where it lies before the cell's inside, or upright in a column
  auto operator<=>(const Strength&) const = default;
};

// What is farther away is thinner and, in the last part of the way, lighter: `far` is 0 at the
// nearest and 1 at the farthest corner of the bounds.
Stroke stroke_of(Strength s, double far) {
  constexpr double kWidths[] = {2.8, 2.1, 1.5, 1.1, 0.9};
  constexpr double kLighter = 0.6;
  const double width = (s.depth < 5 ? kWidths[s.depth] : 0.9) * (1.25 - 0.55 * far);
  if (s.lit == 0) return {Role::lit, (s.quiet != 0 ? 1.7 : 2.5) * (1.2 - 0.4 * far)};
  if (far > kLighter) ++s.depth;
  const double dash = s.dashed == 2 ? 16 : 6 * s.dashed;
  if (s.quiet != 0) return {cell_line_role(s.depth + 1), std::max(0.8, 0.6 * width), dash};
  return {cell_line_role(s.depth), width, dash};
}

// A part of a line along one axis, at two fixed places on the other two.
struct Edge {
  int axis = 0;
  double at[2] = {0, 0};
  double from = 0, to = 0;
  Strength strength;
  std::uint32_t node = 0;  // whose edge it is, if one says so
  int corner = 0;          // which of the four along this axis

  auto line() const { return std::tie(axis, at[0], at[1]); }
  Vec<3> point(double along) const {
    Vec<3> p{0.0};
    p[axis] = along;
    p[(axis + 1) % 3] = at[0];
    p[(axis + 2) % 3] = at[1];
    return p;
  }
};

// Edges of one line, each place once, as strong as the strongest that lies there.
void merge(std::vector<Edge> on_line, std::vector<Edge>& merged) {
  std::vector<double> ends;
  for (const Edge& e : on_line) ends.insert(ends.end(), {e.from, e.to});
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::ranges::stable_sort(on_line, {}, &Edge::strength);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const auto strongest = std::ranges::find_if(
        on_line, [&](const Edge& e) { return e.from <= ends[i] && ends[i + 1] <= e.to; });
    if (strongest == on_line.end()) continue;
    Edge part = *strongest;
    part.from = ends[i];
    part.to = ends[i + 1];
    if (i > 0 && !merged.empty() && merged.back().line() == part.line() &&
        merged.back().to == part.from && merged.back().strength == part.strength)
      merged.back().to = part.to;
    else
      merged.push_back(part);
  }
}

class Edges {
 public:
  Edges(const View3D& view, bool may_sleep) : view_(view), may_sleep_(may_sleep) {}

  // The twelve edges of a cell. In a column's cell those at the top are left out,
  // unless it is lit.
  void add(const FrameNode& node, bool column, std::uint32_t number = 0) {
    if (!is_drawable(node.box)) return;
    const Box<3>& box = node.box;
    for (int axis = 0; axis < 3; ++axis)
      for (unsigned corner = 0; corner < 4; ++corner) {
        const int j = (axis + 1) % 3, k = (axis + 2) % 3;
        const bool high_j = (corner & 1) != 0, high_k = (corner & 2) != 0;
        const bool top = (j == 1 && high_j) || (k == 1 && high_k);
        if (column && axis != 1 && top && node.depth > 0 && node.mark != Mark::lit) continue;
        const bool before = faces_eye(box, j, high_j) && faces_eye(box, k, high_k);
        const bool faint = column && (axis == 1 || top) && node.depth > 0;
        const int dashed = node.of_static ? 2 : node.awake || !may_sleep_ ? 0 : 1;
        edges_.push_back(
            {axis,
             {rounded(high_j ? box.hi[j] : box.lo[j]), rounded(high_k ? box.hi[k] : box.lo[k])},
             rounded(box.lo[axis]),
             rounded(box.hi[axis]),
             {node.mark != Mark::lit, node.depth, dashed, before || faint},
             number,
             static_cast<int>(corner)});
      }
  }

  // In a fixed order; of too many the deepest levels are left out, but for lit cells, and the
  // answer is false.
  bool take(std::size_t most, std::vector<Edge>& merged) {
    std::ranges::sort(edges_, {}, [](const Edge& e) {
      return std::tie(e.axis, e.at[0], e.at[1], e.from, e.to, e.strength, e.node);
    });
    for (std::size_t i = 0; i < edges_.size();) {
      std::size_t end = i;
      while (end < edges_.size() && edges_[end].line() == edges_[i].line()) ++end;
      merge({edges_.begin() + static_cast<std::ptrdiff_t>(i),
             edges_.begin() + static_cast<std::ptrdiff_t>(end)},
            merged);
      i = end;
    }
    bool complete = true;
    while (merged.size() > most) {
      std::uint32_t deepest = 0;
      for (const Edge& e : merged)
        if (e.strength.lit != 0) deepest = std::max(deepest, e.strength.depth);
      if (deepest == 0) break;
      std::erase_if(merged, [&](const Edge& e) {
        return e.strength.lit != 0 && e.strength.depth == deepest;
      });
      complete = false;
    }
    return complete;
  }

 private:
  // Neighbours compute the same border by different sums.
  double rounded(double x) const { return std::round(x / grain_) * grain_; }

  bool faces_eye(const Box<3>& box, int axis, bool high) const {
    return high ? view_.eye()[axis] > box.hi[axis] : view_.eye()[axis] < box.lo[axis];
  }

  const View3D& view_;
  bool may_sleep_;
  double grain_ = std::ldexp(1.0, int(std::ceil(geometry::log2(view_.size()))) - 32);
  std::vector<Edge> edges_;
};

// The faces whose inner side the eye sees: the floor of the cell, and its walls at the back.
void fill_inside(const Box<3>& box, Role floor, Role wall, const View3D& view, DrawList& list) {
  const std::vector<Vec<3>> c = corners_of(box);
  for (int axis = 0; axis < 3; ++axis)
    for (const unsigned high : {0u, 1u}) {
      const bool back =
          high != 0 ? view.eye()[axis] < box.hi[axis] : view.eye()[axis] > box.lo[axis];
      if (!back) continue;
      const unsigned a = 1u << axis, u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
      const unsigned base = high * a;
      Pen(list, view.panel())
          .polygon(view.polygon({c[base], c[base + u], c[base + u + v], c[base + v]}),
                   axis == 1 ? floor : wall);
    }
}

// An edge that leads away from the eye, in parts that get weaker.
void add_faded(const Edge& edge, Marks3D& marks) {
  constexpr double kParts = 4;  // from the nearest corner of the bounds to the farthest
  const Vec<3> from = edge.point(edge.from), to = edge.point(edge.to);
  const double far = std::abs(marks.view.farness(to) - marks.view.farness(from));
  const int parts = std::max(1, static_cast<int>(std::lround(kParts * far)));
  for (int i = 0; i < parts; ++i) {
    const Vec<3> a = from + (to - from) * (double(i) / parts);
    const Vec<3> b = i + 1 == parts ? to : from + (to - from) * (double(i + 1) / parts);
    marks.line(a, b, stroke_of(edge.strength, marks.view.farness((a + b) * 0.5)));
  }
}

// The part of a plane, normal . x = offset, that lies in the box.
std::vector<Vec<3>> part_in(const Box<3>& box, const Vec<3>& normal, double offset) {
  const double length = glm::length(normal);
  if (!(length > 0)) return {};
  const Vec<3> n = normal / length;
  const Vec<3> middle = box.center() - n * (glm::dot(n, box.center()) - offset / length);
  const Vec<3> u = across(n) * (2 * glm::length(box.size())), v = glm::cross(n, u);
  std::vector<Vec<3>> part = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
  for (int axis = 0; axis < 3; ++axis) {
    Vec<3> along{0.0};
    along[axis] = 1;
    part = clipped(part, along, box.lo[axis]);
    part = clipped(part, -along, -box.hi[axis]);
  }
  if (part.size() < 3) part.clear();
  return part;
}

// The planes of nodes that the step has divided, within their cells; of many only the first one's.
std::vector<std::vector<Vec<3>>> cuts_of(const Frame& frame) {
  constexpr std::ptrdiff_t kMostCut = 2;  // nodes; more would hide each other
  std::vector<std::vector<Vec<3>>> cuts;
  const bool many = std::ranges::count_if(frame.nodes, &FrameNode::split) > kMostCut;
  for (const FrameNode& node : frame.nodes) {
    if (!node.split || !is_drawable(node.box)) continue;
    if (many && !cuts.empty()) break;
    if (node.plane) {
      cuts.push_back(part_in(node.box, node.plane->normal, node.plane->offset));
      continue;
    }
    if (!traits_of(frame.structure).splits) continue;
    const Vec<3> c = node.box.center();
    for (const int axis : {1, 0, 2}) {
      if (axis == 1 && traits_of(frame.structure).ignores_height) continue;
      Vec<3> normal{0.0};
      normal[axis] = 1;
      cuts.push_back(part_in(node.box, normal, c[axis]));
    }
  }
  return cuts;
}

}  // namespace

void draw_cut_grounds(const Frame& frame, const View3D& view, DrawList& list) {
  for (const std::vector<Vec<3>>& cut : cuts_of(frame))
    Pen(list, view.panel()).polygon(view.polygon(cut), Role::passed_fill);
}

void add_cuts(const Frame& frame, Marks3D& marks) {
  const std::size_t first = marks.pieces.size();
  for (const std::vector<Vec<3>>& cut : cuts_of(frame))
    for (std::size_t i = 0; i < cut.size(); ++i)
      marks.line(cut[i], cut[(i + 1) % cut.size()], {Role::lit, 1.6, 7});
  for (std::size_t i = first; i < marks.pieces.size(); ++i) marks.pieces[i].yields = true;
}

void draw_cell_grounds(const Frame& frame, const View3D& view, DrawList& list) {
  // A lit node with lit nodes inside is not painted as a whole.
  std::vector<bool> lit_inside(frame.nodes.size());
  for (std::size_t i = frame.nodes.size(); i-- > 0;) {
    const FrameNode& node = frame.nodes[i];
    if (node.parent != kNone && node.parent < i && (node.mark == Mark::lit || lit_inside[i]))
      lit_inside[node.parent] = true;
  }
  std::vector<const FrameNode*> filled;
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    const FrameNode& node = frame.nodes[i];
    const bool shown =
        node.leaf || (node.mark == Mark::lit && !lit_inside[i] && !has_cells(frame.structure));
    if (shown && node.mark != Mark::quiet && is_drawable(node.box)) filled.push_back(&node);
  }
  if (filled.size() > kMostFills3d) return;
  std::ranges::stable_sort(filled, {}, [&](const FrameNode* n) {
    return std::pair{n->mark == Mark::lit, -view.depth(n->box.center())};
  });
  for (const FrameNode* node : filled) {
    const DrawList::Scope scope(list, node_key("world/ground", frame.nodes, *node),
                                parent_key("world/ground", frame.nodes, *node));
    const bool lit = node->mark == Mark::lit;
    list.marks.add(lit ? MarkKind::lit : MarkKind::passed);
    fill_inside(node->box, lit ? Role::lit_fill : Role::passed_fill, Role::passed_fill, view, list);
    if (lit) continue;
    std::vector<Vec<3>> floor = corners_of(node->box);
    floor = {floor[0], floor[1], floor[5], floor[4]};
    for (Vec<3>& p : floor) p += (node->box.center() - p) * Vec<3>(0.07, 0, 0.07);
    Pen(list, view.panel()).polygon(view.polygon(floor), Role::none, kPassedStroke);
  }
}

bool add_cells(const Frame& frame, Marks3D& marks) {
  Edges edges(marks.view, frame.get<FrameStructure>().may_sleep);
  const bool flat = traits_of(frame.structure).ignores_height;
  const bool shown = frame.display.cells && !frame.nodes.empty();
  for (std::uint32_t i = 0; shown && i < frame.nodes.size(); ++i)
    // A level or bucket of a grid is nowhere: its cells are.
    if (const FrameNode& node = frame.nodes[i];
        !has_cells(frame.structure) || node.depth == 0 || node.leaf)
      edges.add(node, flat, i);
  if (!shown) {
    FrameNode whole;
    whole.box = frame.bounds;
    whole.depth = 2;  // a quiet line
    edges.add(whole, false);
  }
  std::vector<Edge> merged;
  const bool crowd = marks.bodies.empty() && !frame.bodies.empty();
  const bool complete = edges.take(crowd ? kMostEdgesInCrowd : kMostEdges, merged);
  // Deep ones first: of pieces equally far away the stronger lies on top.
  std::ranges::stable_sort(merged, std::greater(), &Edge::strength);
  const std::size_t first = marks.pieces.size();
  for (const Edge& e : merged) {
    const std::string cell =
        shown ? node_key("world/cell", frame.nodes, e.node) : "world/cell/root";
    const std::string key = fmt::format("{}/{}{}", cell, "xyz"[e.axis], e.corner);
    const Marks::Scope scope(marks, key, key);
    add_faded(e, marks);
  }
  for (std::size_t i = first; i < marks.pieces.size(); ++i) marks.pieces[i].yields = true;
  return complete;
}

}  // namespace lantern::draw
