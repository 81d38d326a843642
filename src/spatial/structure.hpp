// What all spatial structures share: the items they hold, the one face that they have, the one view
// of their inside, the events they report, and what they count.
//
// A structure knows boxes and ids only. Ids may be any numbers, but no two items of a structure may
// have the same one. Who is told an event may call `visit` and `counters` meanwhile, but must not
// change the structure. While a split node hands its bodies down, those that still wait are in no
// leaf.
//
// structure_kind.hpp lists them all; own_structure.hpp brings one of your own.
#pragma once

#include <algorithm>
#include <compare>
#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/function_ref.hpp"
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

// Of ids that are left out where they are places.
inline BodyId id_at(std::span<const BodyId> ids, std::size_t place) {
  return ids.empty() ? static_cast<BodyId>(place) : ids[place];
}

// Bodies in a row: items, or boxes whose ids stand beside them or, if none do, are their places.
template <int D>
class Items {
 public:
  Items() = default;
  template <std::convertible_to<std::span<const Item<D>>> Row>
  Items(const Row& items) : items_(items) {}
  template <std::convertible_to<std::span<const Box<D>>> Row>
  Items(const Row& boxes, std::span<const BodyId> ids = {}) : boxes_(boxes), ids_(ids) {}

  std::size_t size() const { return items_.size() + boxes_.size(); }
  bool empty() const { return size() == 0; }
  const Box<D>& box(std::size_t i) const { return items_.empty() ? boxes_[i] : items_[i].box; }
  BodyId id(std::size_t i) const { return items_.empty() ? id_at(ids_, i) : items_[i].id; }
  bool ids_are_places() const { return items_.empty() && ids_.empty(); }
  Item<D> operator[](std::size_t i) const { return {id(i), box(i)}; }

  struct Place {
    const Items& items;
    std::size_t i;
    Item<D> operator*() const { return items[i]; }
    void operator++() { ++i; }
    bool operator!=(const Place& other) const { return i != other.i; }
  };
  Place begin() const { return {*this, 0}; }
  Place end() const { return {*this, size()}; }

 private:
  std::span<const Item<D>> items_;
  std::span<const Box<D>> boxes_;
  std::span<const BodyId> ids_;
};

// Such a row that is kept.
template <int D>
struct KeptItems {
  std::vector<Box<D>> boxes = {};
  std::vector<BodyId> ids = {};

  void clear() {
    boxes.clear();
    ids.clear();
  }
  void push_back(const Item<D>& item) {
    boxes.push_back(item.box);
    if (ids.empty() && item.id == boxes.size() - 1) return;
    ids.reserve(boxes.capacity());
    while (ids.size() + 1 < boxes.size()) ids.push_back(static_cast<BodyId>(ids.size()));
    ids.push_back(item.id);
  }
  void assign(Items<D> items) {
    ids.clear();
    boxes.resize(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) boxes[i] = items.box(i);
    if (!items.ids_are_places())
      for (std::size_t i = 0; i < items.size(); ++i) ids.push_back(items.id(i));
  }
  BodyId id(std::size_t i) const { return id_at(ids, i); }
  std::size_t places() const { return boxes.capacity() + ids.capacity(); }
  operator Items<D>() const { return {boxes, ids}; }
};

// Throws Refused, naming the body, unless its box is finite and nowhere inverted.
template <int D>
[[noreturn]] void refuse_box(const Item<D>& item);
template <int D>
void require_valid(const Item<D>& item) {
  if (!is_valid(item.box)) refuse_box(item);
}
template <int D>
void require_all_valid(Items<D> items) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (!is_valid(items.box(i))) refuse_box(items[i]);
}

// What is known of a body beside its box.
struct ProxyState {
  bool is_static = false;
  bool awake = true;
  bool operator==(const ProxyState&) const = default;
  bool stirs() const { return awake && !is_static; }
};

// Two bodies, the lower id first.
struct Pair {
  BodyId a = 0;
  BodyId b = 0;
  auto operator<=>(const Pair&) const = default;
};

// A node while its tree lives: stable from its making until it is cleared, whatever is inserted.
using NodeHandle = std::uint32_t;
inline constexpr std::uint32_t kNone = 0xffffffff;
// The slot of a grid's leaf for bodies that reach too many cells.
inline constexpr std::uint32_t kGridLarge = 0xfffffffe;

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

// f(node) -> bool: false skips the branch.
template <int D>
using NodeLook = FunctionRef<bool(const NodeView<D>&)>;

// A walk through all nodes, while it is made.
template <int D>
struct Tour {
  std::vector<BodyId>& ids;   // scratch: what the leaf at hand holds
  Vec<D> toward{0.0};         // siblings are met as a ray along it meets them; zero: in their order
  std::uint32_t next_id = 0;  // of the next node

  // The next node, but for what is in it.
  NodeView<D> view(NodeHandle handle, std::uint32_t parent, std::uint32_t slot, std::uint32_t depth,
                   bool leaf, const Box<D>& box) {
    return {handle, next_id++, parent, slot, depth, leaf, box};
  }
  // The ids in ascending order: as they are if they lie so already, else a sorted copy.
  std::span<const BodyId> ascending(std::span<const BodyId> found) {
    if (std::ranges::is_sorted(found)) return found;
    ids.assign(found.begin(), found.end());
    std::ranges::sort(ids);
    return ids;
  }
};

// A dividing plane of a BSP.
template <int D>
struct BspPlane {
  Plane<D> plane;
  std::uint32_t parent = kNone;  // position in the list of the plane above it; kNone for the root
  bool front = false;            // it divides what lies in front of its parent
};
// Planes of a BSP one below the other.
inline constexpr std::uint32_t kDeepestBsp = 1000;

// What a structure is told when it is made; each reads what concerns it.
template <int D>
struct StructureConfig {
  Box<D> bounds{Vec<D>(-512.0), Vec<D>(512.0)};  // of trees' roots; bodies outside are found, too
  std::uint32_t capacity = 6;                    // of a leaf: one that holds more is split
  std::uint32_t max_depth = 7;                   // of the deepest node; 0: the root is never split
  bool eager_children = false;   // a split makes all children, else each is made when entered
  bool no_progress_stop = true;  // no split of bodies that all share one point
  std::vector<BspPlane<D>> planes = {};                 // of a BSP
  std::uint64_t most_entries = std::uint64_t{1} << 22;  // of a tree: entries, and nodes
  double cell = 0;           // of a grid: side of its smallest cells; 0: what suits its bodies
  std::uint32_t levels = 1;  // of a grid: sizes of cells
  bool open = false;         // of a grid: its cells are hashed, and have no rim
  double margin = 0;         // of an aabb_tree: how far boxes are enlarged on every side
  Following following = Following::automatic;  // of an aabb_tree
  std::optional<int> sweep_axis = {};          // of sort_and_sweep; none: that of most variance
  bool as_printed = false;  // of lecture_quadtree: with the two mistakes of the lecture's text
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

// A level of a grid, as an array.
struct GridExtent {
  double side = 0;  // of a cell
  std::uint64_t columns = 0, rows = 0;
};

// How a structure has arranged its bodies, beyond its nodes.
struct Arrangement {
  std::optional<int> axis = {};         // along which it sorted last, if it sweeps
  std::vector<GridExtent> levels = {};  // of a grid, the finest first
};

// What is wrong with a structure of a user's own.
struct OwnFault {
  std::string text;                 // "node 1.3 does not list {0}, …"
  std::vector<BodyId> bodies = {};  // whom {0} and {1} stand for
};

// With the bodies called so.
std::string text_of(const OwnFault& fault, const std::function<std::string(BodyId)>& name_of);

// A structure that cannot be used any further.
class StructureFault : public std::runtime_error {
 public:
  explicit StructureFault(OwnFault fault);
  const OwnFault& fault() const { return fault_; }

 private:
  OwnFault fault_;
};

// How a structure is built.
enum class Build {
  one_by_one,  // as the lecture inserts them
  at_once,     // the same tree, sooner; its nodes may be numbered otherwise
};

template <int D>
struct RayQuery;
template <int D>
struct VolumeQuery;
template <int D>
struct NearestQuery;
template <int D>
class PairSearch;

// The face of them all. It is virtual once a question, never once a node: what walks through the
// nodes is written in the structure itself (see structure_of.hpp).
template <int D>
class Structure {
 public:
  virtual ~Structure() = default;

  // Stores one item as the lecture does, one after another, and tells `watch`, if there is one.
  // False, and nothing is done, if it is fitted to its bodies and must be built of all of them.
  // Throws Refused for a box that is not valid; nothing changes then. Throws Refused, too, when it
  // would pass `most_entries`, and Stopped: it can then still be visited, but lacks some bodies in
  // some leaves, and must be cleared before further use.
  virtual bool insert(const Item<D>& item, const EventWatch& watch = {}) = 0;
  // That of these items, instead of what was there; memory is used again. Ids ascend. A structure
  // that can do only one of these does it that way. Throws as `insert` does.
  virtual void build(Items<D> items, Build way = Build::one_by_one) = 0;
  // Goes on from where its bodies were: the same, in the same order, in other places; tells `watch`
  // what it does to follow them. False, and nothing is done, if it cannot.
  virtual bool update(Items<D>, const EventWatch& = {}) { return false; }
  // Forgets the items, keeps the memory.
  virtual void clear() = 0;
  // What insertions that nobody watched leave to be done: of one that sorts before it is asked; and
  // of one that is looked at from outside.
  virtual void sort() {}
  virtual void look() {}
  // A copy of one that sorts before it is asked, sorted; null for all others.
  virtual std::unique_ptr<Structure> sorted() const { return nullptr; }

  // All nodes, parents before children, children in the lecture's order; or, along a direction,
  // siblings in the order in which a ray along it meets them.
  virtual void visit(NodeLook<D> f, const Vec<D>& toward = Vec<D>(0.0)) const = 0;
  // Appends the bodies of all leaves that the box reaches, in any order and perhaps repeated.
  // Returns how many tests of nodes, planes, rows or other bodies it took to get there, 0 where
  // nobody counts them.
  virtual std::uint64_t near(const Box<D>& box, std::vector<BodyId>& ids) const = 0;
  // What a ray meets, which bodies reach into a volume, and which is nearest: see query.hpp.
  virtual void ask(RayQuery<D>& query) const = 0;
  virtual void ask(VolumeQuery<D>& query) const = 0;
  virtual void ask(NearestQuery<D>& query) const = 0;
  // Which bodies overlap: see pair_search.hpp.
  virtual void pair(PairSearch<D>& search) = 0;
  // The same comparisons made visible: f(id, id) for each, of which at least one is awake(id), in
  // their order. Returns the tests that it took besides: of nodes with nodes, of rows, or of the
  // body with which a sweep ends. To be called when it is sorted.
  virtual std::uint64_t compare(FunctionRef<bool(BodyId)> awake,
                                FunctionRef<void(BodyId, BodyId)> f) const = 0;
  // Of a structure that is fitted to its bodies: whether it still is, if this one, which it holds,
  // has moved to this box.
  virtual bool fits(const Item<D>&) const { return true; }

  // Exact counts of the work done and of the tree that stands; `work` without making what only a
  // look at it needs.
  virtual Counters counters() const = 0;
  virtual Counters work() const { return counters(); }
  virtual Arrangement arrangement() const { return {}; }
  // Of a user's own: what of it is not so.
  virtual std::span<const OwnFault> faults() const { return {}; }

 protected:
  Structure() = default;
  Structure(const Structure&) = default;
  Structure& operator=(const Structure&) = default;
};

// A structure as it is asked: its bodies may have other names than it has for them.
template <int D>
struct StructureView {
  const Structure<D>* structure;
  // If its bodies are numbered from 0: what they are called instead, if anything, in ascending
  // order, and their boxes. Else they have the ids that it was given.
  std::span<const BodyId> names = {};
  std::span<const Box<D>> boxes = {};

  StructureView(const Structure<D>& s) : structure(&s) {}
  StructureView(const Structure<D>& s, std::span<const BodyId> their_names,
                std::span<const Box<D>> their_boxes)
      : structure(&s), names(their_names), boxes(their_boxes) {}

  BodyId name(BodyId id) const { return id_at(names, id); }
  void visit(NodeLook<D> f, const Vec<D>& toward = Vec<D>(0.0)) const {
    std::vector<BodyId> ids;
    structure->visit(
        [&](NodeView<D> node) {
          ids.clear();
          for (const BodyId id : node.bodies) ids.push_back(name(id));
          node.bodies = ids;
          return f(node);
        },
        toward);
  }
  Counters counters() const { return structure->counters(); }
};

// An empty structure. Throws Refused for settings that it does not allow, for a kind that needs
// another dimension, and for `none` and `automatic`.
template <int D>
std::unique_ptr<Structure<D>> make_structure(StructureKind kind,
                                             const StructureConfig<D>& config = {});

}  // namespace lantern::spatial
