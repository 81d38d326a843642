#include "spatial/level/level_bsp.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"

namespace lantern::spatial {

LevelBsp::LevelBsp(std::span<const Wall> walls, const Box<2>& bounds)
    : bounds_(bounds), grid_(bounds), walls_(checked_walls(walls, bounds, grid_)) {
  for (const Wall& wall : walls_) lines_.push_back(line_of(wall.line));
}

void LevelBsp::require_eye(const Vec<2>& eye) {
  for (int i = 0; i < 2; ++i)
    if (!std::isfinite(eye[i])) throw Refused("level: the eye's {} is not finite", "xy"[i]);
}

std::optional<LevelBsp::Place> LevelBsp::locate(const Vec<2>& point) const {
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !contains(bounds_, point)) return {};
  Place place;
  NodeHandle handle = 0;
  for (place.nodes_visited = 1; !nodes_[handle].is_leaf(); ++place.nodes_visited)
    handle = nodes_[handle].first_child + (height(point, nodes_[handle].plane) >= 0 ? 1u : 0u);
  place.sector = nodes_[handle].sector;
  place.floor = true;
  for (const std::uint32_t p : nodes_[handle].pieces)
    if (pieces_[p].node == kNone && grid_.side(lines_[pieces_[p].wall], point) < 0)
      place.floor = false;
  return place;
}

LevelCounters LevelBsp::counters() const {
  LevelCounters c = counted_;
  c.walls = walls_.size();
  c.nodes = nodes_.size();
  c.sectors = sectors_.size();
  c.pieces = pieces_.size();
  for (const LevelNode& node : nodes_) {
    c.depth = std::max<std::uint64_t>(c.depth, node.depth);
    c.chosen_score += node.chosen.score;
    c.first_score += node.first.score;
  }
  return c;
}

// --- the compiler: chooses the lines, cuts the walls, and makes the sectors ---

namespace {

enum class Side { back, front, cut, on };

[[noreturn]] void refuse(const Wall& wall, std::size_t index, const std::string& why) {
  const std::string name = wall.name.empty() ? "" : fmt::format(" ({})", wall.name);
  throw Refused("wall {}{}: {}", index, name, why);
}

// Whether the ray from the point to the right meets the edge. Half open, so that a corner between
// two edges counts once.
bool ray_meets(const Vec<2>& p, const Vec<2>& a, const Vec<2>& b) {
  if ((a.y > p.y) == (b.y > p.y)) return false;
  return p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y));
}

bool is_floor(const Vec<2>& p, std::span<const std::vector<Vec<2>>> loops) {
  bool odd = false;
  for (const auto& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (ray_meets(p, loop[i], loop[(i + 1) % loop.size()])) odd = !odd;
  return odd;
}

void require_loop(const std::vector<Vec<2>>& loop, std::size_t index) {
  if (loop.size() < 3) throw Refused("loop {}: it needs at least three corners", index);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (!std::isfinite(loop[i].x) || !std::isfinite(loop[i].y))
      throw Refused("loop {}: corner {} is not finite", index, i);
    if (loop[i] == loop[(i + 1) % loop.size()])
      throw Refused("loop {}: corner {} and the next one are equal", index, i);
  }
}

}  // namespace

// Builds a level from the root down, what lies behind a line before what lies in front.
//
// It ends: a piece on a dividing line is never a candidate again, so a path through the tree uses
// each wall at most once; and both children of a node hold at least one piece.
class LevelCompiler {
 public:
  LevelCompiler(std::span<const Wall> walls, const Box<2>& bounds, const LevelConfig& config,
                const LevelObserver& observer)
      : level_(walls, bounds), config_(config), observer_(observer) {}

  LevelBsp run() {
    require_config();
    make_root();
    std::vector<NodeHandle> waiting = {0};
    while (!waiting.empty()) {
      const NodeHandle node = waiting.back();
      waiting.pop_back();
      if (!choose_line(node)) {
        make_sector(node);
        continue;
      }
      divide(node);
      waiting.push_back(level_.nodes_[node].first_child + 1);
      waiting.push_back(level_.nodes_[node].first_child);
    }
    return std::move(level_);
  }

 private:
  void require_config() const {
    for (const auto& [name, weight] : {std::pair{"balance_weight", config_.balance_weight},
                                       std::pair{"cut_weight", config_.cut_weight}})
      if (!std::isfinite(weight) || weight < 0)
        throw Refused("level: its {} must be finite and not negative", name);
    if (config_.most_candidates == 0)
      throw Refused("level: its most_candidates must be at least 1");
    if (config_.most_depth > kDeepestBsp)
      throw Refused("level: its most_depth must be at most {}", kDeepestBsp);
  }

  void tell(const LevelEvent& event) const {
    if (observer_) observer_(level_, event);
  }
  void tell(LevelEvent::Kind kind, NodeHandle node, const LineChoice& line) const {
    tell({kind, node, line, {}, kNone});
  }

  void make_root() {
    LevelNode root;
    root.region = polygon_of(level_.bounds_);
    for (std::uint32_t w = 0; w < level_.walls_.size(); ++w) {
      const Wall& wall = level_.walls_[w];
      add_piece(root.pieces, {w, false, wall.line, kNone, kNone});
      if (wall.two_sided)
        add_piece(root.pieces, {w, true, {wall.line.b, wall.line.a}, kNone, kNone});
    }
    level_.nodes_.push_back(std::move(root));
  }

  void add_piece(std::vector<std::uint32_t>& list, const WallPiece& piece) {
    if (level_.pieces_.size() >= config_.most_pieces)
      throw Refused("wall {}: with it the level has more than {} pieces of wall", piece.wall,
                    config_.most_pieces);
    list.push_back(static_cast<std::uint32_t>(level_.pieces_.size()));
    level_.pieces_.push_back(piece);
  }

  // Where a piece lies of the line of a wall.
  Side side_of(const WallPiece& piece, std::uint32_t wall) {
    ++level_.counted_.side_tests;
    if (piece.wall == wall) return Side::on;
    const int a = level_.grid_.side(level_.lines_[wall], piece.line.a);
    const int b = level_.grid_.side(level_.lines_[wall], piece.line.b);
    if (a == 0 && b == 0) return Side::on;
    if (a * b < 0) return Side::cut;
    return a + b > 0 ? Side::front : Side::back;
  }

  // Whether a piece on the wall's line has its floor in front of that line.
  bool faces_front(const WallPiece& piece, std::uint32_t wall) const {
    const Vec<2> along = piece.line.b - piece.line.a;
    const Vec<2>& normal = level_.lines_[wall].normal;
    return along.x * normal.y - along.y * normal.x > 0;
  }

  // Tries the line of piece `at`. Walls on the same line are marked as tried, too.
  LineChoice try_line(const LevelNode& node, std::size_t at, std::vector<char>& tried) {
    stop_if_asked();
    LineChoice line;
    line.wall = level_.pieces_[node.pieces[at]].wall;
    ++level_.counted_.candidates;
    for (std::size_t i = 0; i < node.pieces.size(); ++i) {
      const WallPiece& piece = level_.pieces_[node.pieces[i]];
      const Side side = side_of(piece, line.wall);
      if (side == Side::on) tried[i] = 1;
      if (side == Side::cut)
        ++line.cuts;
      else if (side == Side::front || (side == Side::on && faces_front(piece, line.wall)))
        ++line.front;
      else
        ++line.back;
    }
    const double uneven = std::abs(static_cast<double>(line.front) - line.back);
    line.score = config_.balance_weight * uneven + config_.cut_weight * line.cuts;
    return line;
  }

  // The pieces whose lines are tried, in order, and after them the rest, which is tried only until
  // a line divides.
  struct Candidates {
    std::vector<std::size_t> places;
    std::size_t always = 0;
  };

  Candidates candidates_of(const LevelNode& node) const {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < node.pieces.size(); ++i)
      if (level_.pieces_[node.pieces[i]].node == kNone) all.push_back(i);
    const std::size_t most = config_.most_candidates;
    if (all.size() <= most) return {all, all.size()};
    Candidates chosen;
    for (std::size_t k = 0; k < most; ++k) chosen.places.push_back(all[k * all.size() / most]);
    chosen.always = most;
    chosen.places.insert(chosen.places.end(), all.begin(), all.end());
    return chosen;
  }

  // Decides by which line the node is divided; false when none does, since it is convex.
  bool choose_line(NodeHandle handle) {
    LevelNode& node = level_.nodes_[handle];
    tell(LevelEvent::Kind::consider, handle,
         {.front = static_cast<std::uint32_t>(node.pieces.size())});
    const Candidates candidates = candidates_of(node);
    std::vector<char> tried(node.pieces.size(), 0);
    for (std::size_t k = 0; k < candidates.places.size(); ++k) {
      const bool found = node.chosen.wall != kNone;
      if (found && (k >= candidates.always || config_.choose == LevelConfig::Choose::first_wall))
        break;
      if (tried[candidates.places[k]]) continue;
      const LineChoice line = try_line(node, candidates.places[k], tried);
      tell(LevelEvent::Kind::candidate, handle, line);
      if (!line.divides()) continue;
      if (!found) node.first = line;
      if (!found || line.score < node.chosen.score) node.chosen = line;
    }
    if (node.chosen.wall == kNone) return false;
    node.plane = level_.lines_[node.chosen.wall];
    tell(LevelEvent::Kind::choose, handle, node.chosen);
    return true;
  }

  // Deals the node's pieces to two new children.
  void divide(NodeHandle handle) {
    LevelNode children[2];  // behind, in front
    for (std::uint32_t slot = 0; slot < 2; ++slot) {
      const LevelNode& node = level_.nodes_[handle];
      children[slot].parent = handle;
      children[slot].front = slot == 1;
      children[slot].depth = node.depth + 1;
      children[slot].region = level_.grid_.clipped(node.region, node.plane, slot == 1);
    }
    if (children[0].depth > config_.most_depth)
      throw Refused("wall {}: with its line the level's tree is deeper than {}",
                    level_.nodes_[handle].chosen.wall, config_.most_depth);
    const std::vector<std::uint32_t> pieces = std::move(level_.nodes_[handle].pieces);
    level_.nodes_[handle].pieces.clear();
    stop_if_asked();
    for (const std::uint32_t p : pieces) deal(handle, p, children[0].pieces, children[1].pieces);
    level_.nodes_[handle].first_child = static_cast<NodeHandle>(level_.nodes_.size());
    for (LevelNode& child : children) level_.nodes_.push_back(std::move(child));
    for (const LevelEvent& event : cuts_) tell(event);
    cuts_.clear();
    tell(LevelEvent::Kind::divide, handle, level_.nodes_[handle].chosen);
  }

  void deal(NodeHandle handle, std::uint32_t p, std::vector<std::uint32_t>& back,
            std::vector<std::uint32_t>& front) {
    const std::uint32_t wall = level_.nodes_[handle].chosen.wall;
    WallPiece& piece = level_.pieces_[p];
    const Side side = side_of(piece, wall);
    if (side == Side::cut) return cut(handle, p, back, front);
    if (side != Side::on) return (side == Side::front ? front : back).push_back(p);
    (faces_front(piece, wall) ? front : back).push_back(p);
    if (piece.node != kNone) return;
    piece.node = handle;
    level_.nodes_[handle].pieces.push_back(p);
  }

  void cut(NodeHandle handle, std::uint32_t p, std::vector<std::uint32_t>& back,
           std::vector<std::uint32_t>& front) {
    const Plane<2>& plane = level_.nodes_[handle].plane;
    const WallPiece whole = level_.pieces_[p];
    // Where the whole wall crosses the line: whatever was cut off before does not show.
    const Segment<2>& wall = level_.walls_[whole.wall].line;
    const double a = height(wall.a, plane);
    const double b = height(wall.b, plane);
    const Vec<2> at = level_.grid_.snapped(wall.a + (wall.b - wall.a) * (a / (a - b)));
    const bool starts_in_front = level_.grid_.side(plane, whole.line.a) > 0;
    level_.pieces_[p].line.b = at;
    (starts_in_front ? front : back).push_back(p);
    WallPiece rest = whole;
    rest.line.a = at;
    std::vector<std::uint32_t>& far = starts_in_front ? back : front;
    add_piece(far, rest);
    if (rest.node != kNone) level_.nodes_[rest.node].pieces.push_back(far.back());
    ++level_.counted_.cuts;
    LevelEvent event{LevelEvent::Kind::cut, handle, {}, at, kNone};
    event.line.wall = whole.wall;
    cuts_.push_back(event);
  }

  void make_sector(NodeHandle handle) {
    LevelNode& node = level_.nodes_[handle];
    node.sector = static_cast<std::uint32_t>(level_.sectors_.size());
    LevelSector sector{handle, node.region};
    for (const std::uint32_t p : node.pieces) {
      WallPiece& piece = level_.pieces_[p];
      piece.sector = node.sector;
      if (piece.node == kNone)
        sector.floor = level_.grid_.clipped(sector.floor, level_.lines_[piece.wall], true);
    }
    level_.sectors_.push_back(std::move(sector));
    tell({LevelEvent::Kind::sector, handle, {}, {}, node.sector});
  }

  LevelBsp level_;
  const LevelConfig& config_;
  const LevelObserver& observer_;
  std::vector<LevelEvent> cuts_;  // of the node that is being divided: told when it is whole again
};

LevelBsp compile_level(std::span<const Wall> walls, const Box<2>& bounds, const LevelConfig& config,
                       const LevelObserver& observer) {
  return LevelCompiler(walls, bounds, config, observer).run();
}

LevelGrid::LevelGrid(const Box<2>& bounds) {
  if (!is_valid(bounds)) throw Refused("level: its bounds are not finite or inverted");
  double largest = 0;
  for (int i = 0; i < 2; ++i) {
    if (bounds.lo[i] == bounds.hi[i])
      throw Refused("level: its bounds have no extent on axis {}", "xy"[i]);
    largest = std::max({largest, std::abs(bounds.lo[i]), std::abs(bounds.hi[i])});
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  if (exponent < -300 || exponent > 300)
    throw Refused("level: the coordinates of its bounds are too large or too small");
  spacing_ = std::ldexp(1.0, exponent - 46);
  tolerance_ = std::ldexp(1.0, exponent - 38);
}

Vec<2> LevelGrid::snapped(const Vec<2>& point) const {
  return {std::nearbyint(point.x / spacing_) * spacing_,
          std::nearbyint(point.y / spacing_) * spacing_};
}

int LevelGrid::side(const Plane<2>& line, const Vec<2>& point) const {
  const double h = height(point, line);
  return h > tolerance_ ? 1 : h < -tolerance_ ? -1 : 0;
}

Polygon LevelGrid::clipped(const Polygon& polygon, const Plane<2>& line, bool keep_front) const {
  const int wanted = keep_front ? 1 : -1;
  Polygon kept;
  bool any = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>& from = polygon[i];
    const Vec<2>& to = polygon[(i + 1) % polygon.size()];
    const int s = side(line, from) * wanted;
    if (s >= 0) kept.push_back(from);
    any = any || s > 0;
    if (s * side(line, to) * wanted >= 0) continue;
    const double a = height(from, line);
    const double b = height(to, line);
    kept.push_back(snapped(from + (to - from) * (a / (a - b))));
  }
  if (kept.size() < 3 || !any) kept.clear();
  return kept;
}

std::vector<Wall> checked_walls(std::span<const Wall> walls, const Box<2>& bounds,
                                const LevelGrid& grid) {
  std::vector<Wall> checked(walls.begin(), walls.end());
  for (std::size_t i = 0; i < checked.size(); ++i) {
    Wall& wall = checked[i];
    for (Vec<2>* end : {&wall.line.a, &wall.line.b}) {
      const char name = end == &wall.line.a ? 'a' : 'b';
      if (!std::isfinite(end->x) || !std::isfinite(end->y))
        refuse(wall, i, fmt::format("its end {} is not finite", name));
      if (!contains(bounds, *end))
        refuse(wall, i, fmt::format("its end {} lies outside of the level's bounds", name));
      *end = grid.snapped(*end);
    }
    if (!(length(wall.line) >= 4 * grid.tolerance()))
      refuse(wall, i, "its ends a and b lie in one place");
  }
  return checked;
}

std::vector<Wall> walls_of_loops(std::span<const std::vector<Vec<2>>> loops) {
  for (std::size_t i = 0; i < loops.size(); ++i) require_loop(loops[i], i);
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    stop_if_asked();  // each loop is held against all others
    const auto& loop = loops[i];
    const Segment<2> first{loop[0], loop[1]};
    const Vec<2> along = first.b - first.a;
    const Vec<2> beside = first.middle() + Vec<2>(-along.y, along.x) * 0x1p-20;
    const bool keep = is_floor(beside, loops);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      Segment<2> s{loop[k], loop[(k + 1) % loop.size()]};
      if (!keep) std::swap(s.a, s.b);
      walls.push_back({s, false, fmt::format("loop {} wall {}", i, k)});
    }
  }
  return walls;
}

}  // namespace lantern::spatial
