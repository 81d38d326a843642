// What all spatial structures share: the items they hold, the one view of their inside, the events
// they report, and what they count.
//
// A structure knows boxes and ids only. It offers
//   insert(item, observer)   store one item as the lecture does, one after another
//   clear()                  forget the items, keep the memory
//   visit(f)                 the only door to the inside: f(NodeView) -> bool, parents before
//                            children, children in the lecture's order; false skips the branch
//   visit(f, room)           the same; `room` is scratch memory, so that nothing is allocated
//   visit_toward(d, f)       the same, but siblings in the order in which a ray along d meets them;
//                            of zero length: as visit
//   near(box, ids)           appends the bodies of all leaves that the box reaches, in any order
//                            and perhaps repeated; returns how many tests of nodes, planes, rows
//                            or other bodies it took to get there, 0 where nobody counts them
//   kZones                   where a node's bodies may be, see Zones
//   kTraits                  what kind of structure it is, see structure_kind.hpp
//   made(config)             an empty one; throws Refused for settings that it does not allow
//   counters()               exact counts of the work done and the tree that stands
// and, if it finds pairs otherwise than leaf by leaf,
//   pair(exact, found)       adds all pairs of its bodies that overlap, each once, in any order, as
//                            RunScanner does; returns how many pairs of boxes it compared
//   compare(awake, f)        the same comparisons made visible: f(item, item) for each, of which at
//                            least one is awake(id); returns how many. A third argument, if not
//                            null, is increased by the tests that it took besides: of nodes with
//                            nodes, of rows, or of the body with which a sweep ends
// and, if what it shows is made only for who looks,
//   work()                   counters() of what is there already
// and, if it can go on from where its bodies were,
//   update(items, watch)     the same bodies, in the same order, in other places; what it does to
//                            follow them is told to `watch`, if there is one
//
// structure_kinds.hpp lists them all; own_structure.hpp brings one of your own.
//
// Ids may be any numbers, but no two items of a structure may have the same one. An observer may
// call `visit` and `counters` while it is told something, but must not change the structure. While
// a split node hands its bodies down, those that still wait are in no leaf.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "geometry/box.hpp"
#include "geometry/plane.hpp"
#include "spatial/structure_kind.hpp"

namespace lantern::spatial {

using BodyId = std::uint32_t;

template <int D>
struct Item {
  BodyId id = 0;
  Box<D> box;
  bool operator==(const Item&) const = default;
};

// Throws Refused, naming the body, unless its box is finite and nowhere inverted.
template <int D>
void require_valid(const Item<D>& item) {
  if (is_valid(item.box)) return;
  for (int i = 0; i < D; ++i) {
    const double lo = item.box.lo[i];
    const double hi = item.box.hi[i];
    if (!std::isfinite(lo) || !std::isfinite(hi) || lo > hi)
      throw Refused(fmt::format(
          "body {}: its box goes from {} to {} on axis {}; both must be finite and in this order",
          item.id, lo, hi, "xyz"[i]));
  }
}

// Two bodies, the lower id first.
struct Pair {
  BodyId a = 0;
  BodyId b = 0;
  auto operator<=>(const Pair&) const = default;
};

// A node while its tree lives: stable from its making until it is cleared, whatever is inserted.
using NodeHandle = std::uint32_t;
inline constexpr std::uint32_t kNone = 0xffffffff;

template <int D>
struct NodeView {
  NodeHandle handle = 0;
  std::uint32_t id = 0;          // position in the order of visiting, from 0
  std::uint32_t parent = kNone;  // id of the parent; kNone for the root
  std::uint32_t slot = 0;        // which child of its parent, in the lecture's order, from 0
  std::uint32_t depth = 0;       // the root has depth 0
  bool leaf = true;
  Box<D> box = {};                      // its bounds, derived on the way down; of a BSP the world's
  double slack = 0;                     // how far its zone may reach beyond, by rounding
  const Plane<D>* plane = nullptr;      // a BSP's inner nodes
  std::span<const BodyId> bodies = {};  // a leaf's contents, ascending
  std::uint32_t first = kNone;  // where they begin in the array that all leaves share, if there
  std::uint32_t room = 0;       // is one, and how many places are theirs
};

// Where the bodies of a node, or at least the parts of them for which the node answers, may lie.
enum class Zones {
  fitted,       // within its box
  endless_rim,  // within its box, but without end where that box lies at the root's rim
  rounded_rim,  // as endless_rim, and beyond the box by its slack
  half_spaces,  // on the node's sides of all planes above it; its box says nothing
};

// A dividing plane of a BSP.
template <int D>
struct BspPlane {
  Plane<D> plane;
  std::uint32_t parent = kNone;  // position in the list of the plane above it; kNone for the root
  bool front = false;            // it divides what lies in front of its parent
};

// What a structure is told when it is made; each reads what concerns it.
template <int D>
struct StructureConfig {
  Box<D> bounds{Vec<D>(-512.0), Vec<D>(512.0)};  // of trees' roots; bodies outside are found, too
  std::uint32_t capacity = 6;                    // of a leaf
  std::uint32_t max_depth = 7;
  bool eager_children = false;
  bool no_progress_stop = true;
  std::vector<BspPlane<D>> planes = {};                 // of a BSP
  std::uint64_t most_entries = std::uint64_t{1} << 22;  // of a tree: entries, and nodes
  double cell = 0;           // of a grid: side of its smallest cells; 0: what suits its bodies
  std::uint32_t levels = 1;  // of a grid: sizes of cells
  bool open = false;         // of a grid: its cells are hashed, and have no rim
  double margin = 0;         // of an aabb_tree: how far boxes are enlarged on every side
  Following following = Following::automatic;  // of an aabb_tree
  std::optional<int> sweep_axis = {};          // of sort_and_sweep; none: that of most variance
};

// What an algorithm does, told while it does it.
struct Event {
  using Kind = EventKind;
  Kind kind{};
  NodeHandle node = 0;
  BodyId body = 0;
  std::uint32_t count = 0;
  std::uint32_t limit = 0;
};

using EventWatch = std::function<void(const Event&)>;

// The default observer: its calls compile to nothing.
struct NoObserver {
  void operator()(const Event&) const {}
};

struct Counters {
  std::uint64_t nodes = 0;  // that stand now
  std::uint64_t leaves = 0;
  std::uint64_t depth = 0;    // of the deepest node
  std::uint64_t entries = 0;  // bodies stored, each once a leaf
  // Of a body against a node or plane, while sorting against another body, of a grid one a body
  // for its cell; since the last clear.
  std::uint64_t box_tests = 0;
  std::uint64_t splits = 0;        // since the last clear
  std::uint64_t allocations = 0;   // calls for memory since the structure was made
  std::uint64_t nodes_reused = 0;  // since the last clear: nodes that took the place of one from
                                   // before it instead of new memory
  std::uint64_t places = 0;        // of the array that all leaves share, if there is one
  std::uint64_t node_bytes = 0;    // that all nodes take, contents apart
  // Of a pool of nodes, as many as it ever held at once: the first `nodes` of them, by their
  // handles, are in use now, and of these the first `nodes_reused` held another before.
  std::uint64_t pool = 0;
  std::uint64_t swaps = 0;  // of a sweep's last sort: neighbours that changed places
  // Of the last time that a tree followed its bodies: those that had left their boxes and were
  // inserted again, or whose boxes were mended where they stand.
  std::uint64_t reinserted = 0;
  std::uint64_t refitted = 0;
};

}  // namespace lantern::spatial
