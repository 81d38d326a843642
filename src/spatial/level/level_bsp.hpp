// A level compiled into a binary space partition, as the levels of Doom were: the lines that divide
// it are chosen from its own walls, and each leaf is a convex sector of floor.
//
//      +-----------+            [A's line]           The line of wall A divides the L-shaped room
//      |  1  : 0   |             /      \            into two convex sectors. What lies behind is
//      |     :     |        sector 0  sector 1       child 0, what lies in front child 1. A wall
//      |     A-----+                                 that crosses the line is cut in two.
//      |     |
//      +-----+
//
// A region is divided as long as a wall there has another one, or a part of it, behind its line
// (Fuchs, Kedem and Naylor 1980, "On visible surface generation by a priori tree structures", with
// the leaves of Doom: walls wait for a sector instead of ending on a node). So every leaf holds
// walls, and has floor in front of them; the stone behind its walls belongs to the same leaf, and
// to no floor. A wall on a dividing line goes to the side that it faces, so that each piece borders
// exactly one sector; a two-sided wall has one piece for each side.
#pragma once

#include "base/stop.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

// --- the walls, seen from above, and the grid on which their corners lie ---

// A wall's floor lies on its left, so the walls of a room run counter-clockwise, those of a pillar
// in it clockwise:
//
//     <-------------
//     |   floor    ^        Behind a one-sided wall, on its right, is solid stone. A two-sided
//     |   .--->    |        wall, such as a step or a window, has floor on both sides.
//     |   ^   |    |
//     |   <---v    |
//     v            |
//     ------------->
struct Wall {
  Segment<2> line;
  bool two_sided = false;
  std::string name;  // for messages; may be empty
};

// Map lengths below which a level does not distinguish. The scale is the largest coordinate of the
// bounds, rounded up to a power of two; corners are snapped to multiples of scale * 2^-46, and
// what lies within scale * 2^-38 of a line lies on it. Corners that are written with few binary
// digits do not move at all.
class LevelGrid {
 public:
  // Throws Refused for bounds that are not valid, have no width or height, or whose scale is not
  // within 2^-300 ... 2^300.
  explicit LevelGrid(const Box<2>& bounds);

  double tolerance() const { return tolerance_; }
  Vec<2> snapped(const Vec<2>& point) const;

  // The side of the line on which the point lies: 1 in front, -1 behind, 0 on it.
  int side(const Plane<2>& line, const Vec<2>& point) const;

  // As lantern::clipped, but corners within the tolerance lie on the line, and new ones are
  // snapped: a line that grazes a corner makes no sliver. Keeps nothing when no corner lies off the
  // line on the side that is kept.
  Polygon clipped(const Polygon& polygon, const Plane<2>& line, bool keep_front) const;

 private:
  double spacing_ = 0;
  double tolerance_ = 0;
};

// The walls, snapped. Throws Refused, naming the wall and the field, for an end that is not finite
// or lies outside of the bounds, and for a wall shorter than four tolerances.
std::vector<Wall> checked_walls(std::span<const Wall> walls, const Box<2>& bounds,
                                const LevelGrid& grid);

// One-sided walls round the floor that closed loops of corners enclose: what lies within an odd
// number of loops is floor, so a pillar is a loop within a room's. Each loop may run either way;
// it is turned so that its floor lies on its left. Loops must not cross. The walls are named
// "loop 2 wall 0", counted from 0. Throws Refused for a loop of fewer than three corners, a corner
// that is not finite, and two equal corners in succession.
std::vector<Wall> walls_of_loops(std::span<const std::vector<Vec<2>>> loops);

// --- the tree ---

// A part of one side of a wall. Its floor lies on the left.
struct WallPiece {
  std::uint32_t wall = 0;
  bool back = false;  // the back of a two-sided wall
  Segment<2> line;
  NodeHandle node = kNone;  // on whose dividing line it lies; kNone when only a sector's border
  std::uint32_t sector = kNone;
};

// A line that may divide a region, and what it does to the pieces there.
struct LineChoice {
  std::uint32_t wall = kNone;
  std::uint32_t front = 0;  // pieces wholly in front, or on the line and facing the front
  std::uint32_t back = 0;
  std::uint32_t cuts = 0;  // pieces that it cuts in two, one for each side
  double score = 0;        // smaller is better

  bool divides() const { return back > 0 || cuts > 0; }
};

struct LevelNode {
  NodeHandle parent = kNone;
  bool front = false;  // which child of its parent
  std::uint32_t depth = 0;
  NodeHandle first_child = kNone;     // the one behind; the one in front is next to it
  Polygon region;                     // the part of the bounds that it stands for, convex
  Plane<2> plane;                     // of an inner node; unit normal, the side its wall faces
  LineChoice chosen;                  // of an inner node
  LineChoice first;                   // the line of the first wall that would divide it, to compare
  std::uint32_t sector = kNone;       // of a leaf, once it is known to be convex
  std::vector<std::uint32_t> pieces;  // leaf: all in it; inner node: those on its line

  bool is_leaf() const { return first_child == kNone; }
};

struct LevelSector {
  NodeHandle node = 0;
  Polygon floor;  // convex: the leaf's region in front of all its walls; empty only where a map's
                  // walls enclose nothing
};

struct LevelNodeView : NodeView<2> {
  const Polygon* region = nullptr;
  std::span<const std::uint32_t> pieces;  // leaf: all in it; inner node: those on its line
  std::uint32_t sector = kNone;           // of a leaf that is convex
};

struct LevelCounters {
  std::uint64_t walls = 0;
  std::uint64_t nodes = 0;
  std::uint64_t sectors = 0;
  std::uint64_t depth = 0;
  std::uint64_t pieces = 0;
  std::uint64_t cuts = 0;
  std::uint64_t candidates = 0;  // lines tried
  std::uint64_t side_tests = 0;  // of a piece against a line
  double chosen_score = 0;       // sum over the inner nodes
  double first_score = 0;        // the same, had each of them taken the first wall that divides
};

struct LevelConfig {
  enum class Choose { best_score, first_wall };
  Choose choose = Choose::best_score;

  // score = balance_weight * |front - back| + cut_weight * cuts; of equal scores the wall with the
  // lower index wins. A cut costs more than a slightly uneven split, since its pieces stay.
  double balance_weight = 1;
  double cut_weight = 3;

  // A region of more walls tries this many of them, evenly spread over their order; more only
  // until one divides. Keeps the compile of n walls near n log n.
  std::uint32_t most_candidates = 256;
  std::uint32_t most_depth = kDeepestBsp;
  std::uint32_t most_pieces = std::uint32_t{1} << 20;
};

// What the compiler does, told while it does it.
struct LevelEvent {
  enum class Kind {
    consider,   // the node's `line.front` pieces are looked at
    candidate,  // the line of a wall was tried; `line` says with which result
    choose,     // the node's line is `line`
    cut,        // the node has got its children; its line cut a piece of `line.wall` at `point`
    divide,     // the node has got its children, and all cuts were told
    sector,     // the node is convex, and becomes `sector`
  };
  Kind kind{};
  NodeHandle node = 0;
  LineChoice line;
  Vec<2> point{0.0};
  std::uint32_t sector = kNone;
};

class LevelBsp;
using LevelObserver = std::function<void(const LevelBsp&, const LevelEvent&)>;

class LevelBsp {
 public:
  struct Place {
    std::uint32_t sector = 0;
    bool floor = false;               // false: in the stone behind one of the sector's walls
    std::uint32_t nodes_visited = 0;  // inner nodes and the leaf
  };

  const Box<2>& bounds() const { return bounds_; }
  double tolerance() const { return grid_.tolerance(); }
  std::span<const Wall> walls() const { return walls_; }  // snapped
  std::span<const WallPiece> pieces() const { return pieces_; }
  std::span<const LevelNode> nodes() const { return nodes_; }  // parents first
  std::span<const LevelSector> sectors() const { return sectors_; }
  LevelCounters counters() const;

  // The sector at a point; what lies on a dividing line counts as in front of it, what lies on a
  // wall as floor. Nothing outside of the bounds and for a point that is not finite.
  std::optional<Place> locate(const Vec<2>& point) const;

  // f(sector) -> bool for each sector, so that what hides another from the eye comes first; false
  // ends the walk, as Doom ends it when no column of the picture is open. Pieces that face the eye
  // within one sector do not hide each other. The eye may be anywhere; throws Refused unless it is
  // finite.
  template <class F>
  void front_to_back(const Vec<2>& eye, F&& f) const {
    require_eye(eye);
    walk(0, eye, f);
  }

  // f(LevelNodeView) -> bool as every spatial structure does: parents before children, behind
  // before in front; false skips the branch. While the level is compiled, a leaf without a sector
  // still waits.
  template <class F>
  void visit(F&& f) const {
    std::uint32_t next_id = 0;
    visit_from(0, kNone, next_id, f);
  }

 private:
  friend class LevelCompiler;
  LevelBsp(std::span<const Wall> walls, const Box<2>& bounds);
  static void require_eye(const Vec<2>& eye);

  template <class F>
  bool walk(NodeHandle handle, const Vec<2>& eye, F& f) const {
    const LevelNode& node = nodes_[handle];
    if (node.is_leaf()) return f(node.sector);
    const NodeHandle near = height(eye, node.plane) >= 0 ? 1 : 0;
    return walk(node.first_child + near, eye, f) && walk(node.first_child + 1 - near, eye, f);
  }

  template <class F>
  void visit_from(NodeHandle handle, std::uint32_t parent, std::uint32_t& next_id, F& f) const {
    stop_if_asked();
    const LevelNode& node = nodes_[handle];
    const LevelNodeView view{{.handle = handle,
                              .id = next_id++,
                              .parent = parent,
                              .slot = node.front ? 1u : 0u,
                              .depth = node.depth,
                              .leaf = node.is_leaf(),
                              .box = bounds_,
                              .plane = node.is_leaf() ? nullptr : &node.plane},
                             &node.region,
                             node.pieces,
                             node.sector};
    if (!f(view) || view.leaf) return;
    visit_from(node.first_child, view.id, next_id, f);
    visit_from(node.first_child + 1, view.id, next_id, f);
  }

  Box<2> bounds_;
  LevelGrid grid_;
  std::vector<Wall> walls_;
  std::vector<Plane<2>> lines_;  // of each wall, in the direction that it faces
  std::vector<WallPiece> pieces_;
  std::vector<LevelNode> nodes_;
  std::vector<LevelSector> sectors_;
  LevelCounters counted_;  // cuts, candidates and tests
};

// Compiles a level. No walls give a single sector. Throws Refused for walls and bounds as
// checked_walls and LevelGrid do, for weights that are negative or not finite, and for a level that
// needs more depth or pieces than the config allows. What the observer was shown is gone then, as
// after Stopped.
LevelBsp compile_level(std::span<const Wall> walls, const Box<2>& bounds,
                       const LevelConfig& config = {}, const LevelObserver& observer = {});

// --- which sectors of a level can see which (level_visibility.cpp) ---

// The visibility matrix that Quake's levels were shipped
// with, exact for a map seen from above.
//
//      +---------+      A portal is the part of two sectors' common border that is no wall. Who
//      | 0  |L   |      looks from sector 0 through portals into sector 2 has all their left ends
//      |    :  1 |      on the left of the line of sight, all their right ends on its right:
//      |    |R   |      sector 2 is visible through them exactly if a line parts the left ends
//      |    +L..R+      from the right ones. The search goes from sector to sector, through all
//      |    | 2  |      portals that such a line still passes together with those before.
//      +---------+
//
// Portals and rows of the matrix: Airey, "Increasing update rates in the building walkthrough
// system with automatic model-space subdivision and potentially visible set calculations" (1990).
// The parting line: Teller, "Visibility computations in densely occluded polyhedral environments"
// (1992). It parts the ends if its normal n has n · (left - right) > 0 for each left and each right
// end: if their differences lie within less than half a turn, which two of them bound.
//
// One-sided walls hide what is behind them; two-sided ones, steps and windows, do not. A beam
// narrower than the level's tolerance does not count: who only touches a corner sees nothing.

// An opening between two sectors.
struct Portal {
  std::uint32_t a = 0;
  std::uint32_t b = 0;  // greater than a
  Segment<2> line;      // a's floor lies on its left, b's on its right
};

// Two sectors that see each other, and a line of sight from the floor of one to that of the other.
struct Sight {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  Segment<2> line;  // crosses no one-sided wall
};

struct VisibilityConfig {
  std::uint32_t most_sectors = 4096;
  std::uint64_t most_tests = std::uint64_t{1} << 24;  // of a portal against a view
};

struct LevelVisibility {
  std::uint32_t sectors = 0;
  std::uint32_t done = 0;  // sectors below this one are: all that they see is known
  std::vector<Portal> portals;
  std::vector<Sight> sights;         // of each pair that sees each other
  std::uint64_t portals_tested = 0;  // how often a portal was held against the view through others
  std::vector<char> seen = {};       // row by row

  // Each sector sees itself.
  bool sees(std::uint32_t a, std::uint32_t b) const { return seen[a * sectors + b] != 0; }
};

// Told when the portals are known, before any sector is done, and then after each sector.
using VisibilityObserver = std::function<void(const LevelVisibility&)>;

// The whole matrix. Throws Refused for a level of more sectors, or that needs more tests, than the
// config allows.
LevelVisibility find_visibility(const LevelBsp& level, const VisibilityConfig& config = {},
                                const VisibilityObserver& observer = {});

}  // namespace lantern::spatial
