// The broad phase: which boxes overlap. One interface, six ways, the same pairs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "spatial/awake.hpp"
#include "spatial/brute_force.hpp"
#include "spatial/bsp.hpp"
#include "spatial/flat_quadtree.hpp"
#include "spatial/kd_tree.hpp"
#include "spatial/orthtree.hpp"
#include "spatial/sort_and_sweep.hpp"

namespace lantern {

enum class BroadPhaseKind { brute_force, sort_and_sweep, quadtree, octree, bsp, kd_tree };

inline constexpr std::array kBroadPhaseKinds = {
    BroadPhaseKind::brute_force, BroadPhaseKind::sort_and_sweep,
    BroadPhaseKind::quadtree,    BroadPhaseKind::octree,
    BroadPhaseKind::bsp,         BroadPhaseKind::kd_tree};

// "brute_force", "sort_and_sweep", ...: as the enumerators are written.
std::string_view name_of(BroadPhaseKind kind);
std::optional<BroadPhaseKind> broad_phase_named(std::string_view name);

template <int D>
struct BroadPhaseConfig {
  BroadPhaseKind kind = D == 3 ? BroadPhaseKind::octree : BroadPhaseKind::quadtree;
  Box<D> bounds{Vec<D>(-512.0), Vec<D>(512.0)};  // of trees' roots; bodies outside are found, too
  std::uint32_t capacity = 6;                    // of a leaf
  std::uint32_t max_depth = 7;
  bool eager_children = false;
  bool no_progress_stop = true;
  std::vector<BspPlane<D>> planes;  // of a BSP
  bool split_static = true;         // static bodies in a structure of their own
  // Of overlaps met, each once for each leaf that both bodies share.
  std::uint64_t most_pairs = std::uint64_t{1} << 26;
};

// What the broad phase knows of a body.
template <int D>
struct Proxy {
  BodyId id = 0;
  Box<D> box;
  bool is_static = false;
  bool awake = true;  // of no matter if static
  bool operator==(const Proxy&) const = default;
};

struct BroadPhaseCounters {
  // Since the broad phase was made.
  std::uint64_t static_builds = 0;
  std::uint64_t dynamic_builds = 0;
  std::uint64_t allocations = 0;  // calls for memory
  // Of the last update.
  std::uint64_t pair_tests = 0;            // boxes compared with boxes
  std::uint64_t nodes_visited = 0;         // of the dynamic structure, while pairing
  std::uint64_t nodes_skipped_asleep = 0;  // whole branches in which all sleep, each counted once
  std::uint64_t nodes_reused = 0;          // of the dynamic structure
};

// A structure whose bodies are numbered from 0 in the order of their ids, seen with the ids.
template <int D, class Structure>
class WithIds {
 public:
  static constexpr Zones kZones = Structure::kZones;

  WithIds(const Structure& structure, std::span<const BodyId> names)
      : structure_(structure), names_(names) {}

  template <class F>
  void visit(F&& f) const {
    std::vector<BodyId> room;
    structure_.visit([&](const NodeView<D>& view) { return f(named(view, room)); });
  }

  template <class F>
  void visit_toward(const Vec<D>& direction, F&& f) const {
    std::vector<BodyId> room;
    structure_.visit_toward(direction,
                            [&](const NodeView<D>& view) { return f(named(view, room)); });
  }

  Counters counters() const { return structure_.counters(); }

 private:
  NodeView<D> named(NodeView<D> view, std::vector<BodyId>& room) const {
    room.clear();
    for (const BodyId number : view.bodies) room.push_back(names_[number]);
    view.bodies = room;
    return view;
  }

  const Structure& structure_;
  std::span<const BodyId> names_;
};

// Pairs are those bodies whose boxes overlap (touching does), of which at least one is awake and
// not static; each once, in order of ids. All kinds give the same pairs.
//
// Static bodies have a structure of their own, which is built once and only asked later (the
// lecture, "Static and dynamic objects"). The one for all others is built anew at each update, in
// the memory of the one before; when none of them is awake there is nothing to pair, and nothing is
// built (the lecture, "Sleeping Objects").
//
// A tree that would grow out of proportion (more than 64 entries a body: many bodies larger than
// most cells) is built with half of its depth instead, again and again until it does not.
template <int D>
class BroadPhase {
 public:
  using Config = BroadPhaseConfig<D>;
  using Structure = std::conditional_t<
      D == 2, std::variant<BruteForce<D>, SortAndSweep<D>, Orthtree<2>, Bsp<D>, KdTree<D>>,
      std::variant<BruteForce<D>, SortAndSweep<D>, FlatQuadtree, Bsp<D>, KdTree<D>, Orthtree<3>>>;

  // Throws Refused for what the structures refuse, and for an octree in two dimensions. In three, a
  // quadtree looks at x and z only.
  explicit BroadPhase(const Config& config);

  // Finds the pairs. Proxies may come in any order. Throws Refused, naming the body, for a box that
  // is not valid and for two proxies of one id; nothing changes then. Throws Refused, too, when
  // more than `most_pairs` meet (coincident bodies have n(n-1)/2 pairs), or when they need more
  // memory than the budget. Whatever is thrown half way, Stopped too: there are no pairs and no
  // structures then, and the next update begins as the first.
  void update(std::span<const Proxy<D>> proxies);

  // Of the last update.
  const std::vector<Pair>& pairs() const { return pairs_; }
  const BroadPhaseCounters& counters() const { return counters_; }
  const Config& config() const { return config_; }

  // f(structure) with the real type of structure (see structure.hpp for what it offers: visit,
  // visit_toward, kZones, counters), its bodies named by their ids: for views and queries. The
  // structures of the last update; if all slept, the dynamic one as it was last built, or empty if
  // bodies have come, gone or moved in their sleep since. Without split_static, the dynamic one
  // holds all.
  template <class F>
  decltype(auto) with_static(F&& f) const {
    return with(static_, f);
  }
  template <class F>
  decltype(auto) with_dynamic(F&& f) const {
    return with(dynamic_, f);
  }

  template <class F>
  void visit_static(F&& f) const {
    with_static([&](const auto& structure) { structure.visit(f); });
  }
  template <class F>
  void visit_dynamic(F&& f) const {
    with_dynamic([&](const auto& structure) { structure.visit(f); });
  }

  // Which nodes of the dynamic structure are awake, in the order of visiting.
  std::vector<bool> awake_dynamic_nodes() const;

 private:
  // A structure and its bodies, by id. The structure knows them by their places in this list.
  struct Store {
    Structure structure;
    std::vector<Proxy<D>> bodies;
    std::vector<std::uint32_t> ranks;  // of each body among all, by id
    std::vector<BodyId> names;         // of the bodies that the structure holds
    std::uint32_t depth = 0;           // of a tree; at most as configured
    std::uint64_t room = 0;            // how many bodies its limits were made for
  };
  struct RankPair {
    std::uint32_t a = 0, b = 0;
  };

  template <class F>
  static decltype(auto) with(const Store& store, F& f) {
    return std::visit(
        [&](const auto& structure) -> decltype(auto) {
          return f(WithIds<D, std::remove_cvref_t<decltype(structure)>>(structure, store.names));
        },
        store.structure);
  }

  static bool stirs(const Proxy<D>& proxy) { return proxy.awake && !proxy.is_static; }
  static bool same_boxes(const std::vector<Proxy<D>>& a, const std::vector<Proxy<D>>& b);

  Structure made(std::uint32_t depth, std::uint64_t room) const;
  void sort_and_check(std::span<const Proxy<D>> proxies);
  void find_pairs();
  void forget();
  void deal_out();
  void build(Store& store);
  void fill(Store& store);
  void empty(Store& store);
  void pair_dynamic();
  void pair_static();
  template <class Tree>
  void pair_leaves(const Tree& tree);
  template <class Tree>
  void find_awake_nodes(const Tree& tree);
  void pair_bodies(std::span<const BodyId> bodies);
  void add_pair(std::uint32_t rank_a, std::uint32_t rank_b) {
    if (found_.size() == found_.capacity()) require_room(sorted_[rank_a].id);
    if (found_.size() == config_.most_pairs) refuse_pair(sorted_[rank_a].id);
    found_.push_back(rank_a < rank_b ? RankPair{rank_a, rank_b} : RankPair{rank_b, rank_a});
  }
  [[noreturn]] void refuse_pair(BodyId body) const;
  void require_room(BodyId body) const;
  void sort_pairs();
  std::uint64_t structure_allocations() const;
  std::size_t own_places() const;

  Config config_;
  Store static_, dynamic_;
  std::vector<Pair> pairs_;
  BroadPhaseCounters counters_;
  std::uint64_t own_allocations_ = 0;
  std::uint64_t past_allocations_ = 0;  // of structures that were made anew

  // Scratch of an update, kept for its memory.
  std::vector<Proxy<D>> sorted_;  // all, by id
  std::vector<Proxy<D>> fresh_static_, fresh_dynamic_;
  std::vector<Item<D>> items_;
  std::vector<BodyId> ids_;
  std::vector<std::uint8_t> awake_;               // of each node, by handle
  std::vector<std::uint32_t> parents_, handles_;  // of nodes, in the order of visiting
  std::vector<RankPair> found_;                   // in any order, perhaps repeated
  std::vector<std::uint32_t> first_, partners_;   // found_, sorted by the lower rank
};

extern template class BroadPhase<2>;
extern template class BroadPhase<3>;

}  // namespace lantern
