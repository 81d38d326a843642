// The kinds of structures: what each is called, and what it is like. Whoever only names, describes
// or sets one needs no more than this.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

namespace lantern::spatial {

// The list of structures, each by its name as users write it. A new one is a file of its own and a
// line here. A program may be given more of them (own_structure.hpp): they come behind ours.
#define LANTERN_STRUCTURES(KIND) \
  KIND(brute_force)              \
  KIND(sort_and_sweep)           \
  KIND(quadtree)                 \
  KIND(octree)                   \
  KIND(bsp)                      \
  KIND(kd_tree)                  \
  KIND(lecture_quadtree)         \
  KIND(grid)                     \
  KIND(aabb_tree)

enum class StructureKind {
  none,       // nobody asks for one
  automatic,  // "auto": whichever suits the bodies, see structure_choice.hpp
#define LANTERN_KIND(name) name,
  // `own` is the first that this program was given; the others are the numbers behind.
  LANTERN_STRUCTURES(LANTERN_KIND) own,
#undef LANTERN_KIND
  wide_bvh = -1  // what "auto" takes for who only asks: nobody names it, no lesson is about it
};

// All of ours that have a name.
inline constexpr std::array kStructureKinds = {
#define LANTERN_KIND(name) StructureKind::name,
    LANTERN_STRUCTURES(LANTERN_KIND)
#undef LANTERN_KIND
};

// What an aabb_tree does with bodies that have left their boxes: it takes them out and inserts them
// again, mends the boxes where they stand, or whichever is quicker.
enum class Following { automatic, reinsert, refit };

// Some of the values of an enum, a bit each.
using Bits = std::uint32_t;
inline constexpr Bits kAllBits = ~Bits{0};
template <class E>
constexpr Bits bits_of(std::initializer_list<E> some) {
  Bits bits = 0;
  for (const E one : some) bits |= Bits{1} << static_cast<int>(one);
  return bits;
}

// What only some kinds can be told: see StructureConfig. The names are those of a scenario's keys.
enum class Setting {
  capacity,
  max_depth,
  children,
  no_progress_stop,
  cell,
  levels,
  open,
  margin,
  following,
  axis,
  planes,
  as_printed,
  root
};
inline constexpr std::string_view kSettingNames[] = {
    "capacity", "max_depth", "children", "no_progress_stop", "cell",       "levels", "open",
    "margin",   "following", "axis",     "planes",           "as_printed", "root"};
constexpr std::string_view to_string(Setting setting) {
  return kSettingNames[static_cast<std::size_t>(setting)];
}

// What an algorithm does, told while it does it: see Event.
enum class EventKind {
  test,         // the body's box was tested against the node, and reaches it
  miss,         // the body's box was tested against the node, and does not reach it
  make_child,   // the node came to be
  store,        // the body was put into the leaf, which now holds `count`
  split,        // the leaf held `count`, more than `limit`, and becomes an inner node
  hand_down,    // the body goes from the split node to its children
  depth_limit,  // the leaf holds `count`, more than `limit`, but lies at the depth limit, or is
                // so small that no number lies between its bounds
  no_progress,  // the leaf holds `count`, more than `limit`, but a split would part no pair
  rotate,       // a child of the node and the node's sibling have changed places
  leave,        // the body has left the box of its leaf, which will be taken out of the tree
};

// How the nodes of a kind are called, and drawn: after the slot that they have in their parent.
enum class NodeNames {
  numbers,  // 1, 2, ...
  sides,    // of a plane: back, front
  cells,    // numbers, but L1 for a grid's level, B1 for a bucket, and a leaf of what is large
};

// What tells kinds of structures apart for whoever sets, shows or describes them.
struct StructureTraits {
  std::string_view words;       // "sort and sweep": as one would write it
  Bits settings = 0;            // those that it has
  int least_dimension = 2;      // of the worlds in which it is possible
  bool is_tree = true;          // else one list of all bodies
  bool meets_in_leaves = true;  // two bodies meet where they share a leaf; else by `compare`
  bool holds_once = false;      // each body lies in one leaf, which holds no other
  bool splits = true;           // leaves above capacity, down to the depth limit
  bool is_fitted = false;       // to its bodies: built of all of them at once, stale when they move
  bool hugs = false;            // a node's box is the smallest around what it holds
  bool follows = false;         // it goes on from where its bodies were
  bool shares_array = false;    // all leaves' contents lie in one array
  bool ignores_height = false;  // in three dimensions it looks at x and z only
  bool is_plain = false;        // makes all children, has no stop but the depth limit, and asks for
                                // memory anew each time
  bool is_of_lecture = false;   // the lecture's text weighs it against others
  bool is_own = false;          // a user's: seen from outside, its tests and memory are not counted
  NodeNames names = NodeNames::numbers;
  Bits tells = kAllBits;  // EventKinds of an insertion

  constexpr bool has(Setting setting) const { return (settings & bits_of({setting})) != 0; }
  constexpr bool tells_of(EventKind kind) const { return (tells & bits_of({kind})) != 0; }
};

// Of none and automatic: no settings, no tree.
const StructureTraits& traits_of(StructureKind kind);

// Whether its nodes are cells, and what lies above them is nowhere.
inline bool has_cells(StructureKind kind) { return traits_of(kind).names == NodeNames::cells; }

// Whether it is possible in worlds of so many dimensions.
inline bool is_possible(StructureKind kind, int dimension) {
  return dimension >= traits_of(kind).least_dimension;
}

// Those of ours that have it, in the order of the list.
std::vector<StructureKind> kinds_with(Setting setting);

// Ours, and those that this program was given.
std::vector<StructureKind> known_structures();

// "none", "auto", "brute_force", "sort_and_sweep", ...
std::string_view to_string(StructureKind kind);
std::optional<StructureKind> structure_named(std::string_view name);

}  // namespace lantern::spatial
