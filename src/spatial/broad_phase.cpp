#include "spatial/broad_phase.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/stop.hpp"

namespace lantern {
namespace {

constexpr std::array<std::string_view, kBroadPhaseKinds.size()> kNames = {
    "brute_force", "sort_and_sweep", "quadtree", "octree", "bsp", "kd_tree"};

// More entries or nodes than this are out of proportion.
std::uint64_t most_entries(std::uint64_t room) { return 4096 + 64 * room; }

}  // namespace

std::string_view name_of(BroadPhaseKind kind) { return kNames[static_cast<std::size_t>(kind)]; }

std::optional<BroadPhaseKind> broad_phase_named(std::string_view name) {
  for (const BroadPhaseKind kind : kBroadPhaseKinds)
    if (name_of(kind) == name) return kind;
  return std::nullopt;
}

template <int D>
BroadPhase<D>::BroadPhase(const Config& config)
    : config_(config),
      static_{made(config.max_depth, 0), {}, {}, {}, config.max_depth, 0},
      dynamic_{made(config.max_depth, 0), {}, {}, {}, config.max_depth, 0} {}

template <int D>
auto BroadPhase<D>::made(std::uint32_t depth, std::uint64_t room) const -> Structure {
  typename Orthtree<D>::Config tree;
  tree.bounds = config_.bounds;
  tree.capacity = config_.capacity;
  tree.max_depth = depth;
  tree.eager_children = config_.eager_children;
  tree.no_progress_stop = config_.no_progress_stop;
  tree.most_entries = std::min(most_entries(room), Orthtree<D>::kMost);
  switch (config_.kind) {
    case BroadPhaseKind::brute_force:
      return BruteForce<D>();
    case BroadPhaseKind::sort_and_sweep:
      return SortAndSweep<D>();
    case BroadPhaseKind::quadtree:
      if constexpr (D == 2) return Quadtree(tree);
      if constexpr (D == 3)
        return FlatQuadtree({config_.bounds,
                             {{},
                              tree.capacity,
                              depth,
                              tree.eager_children,
                              tree.no_progress_stop,
                              tree.most_entries}});
      break;
    case BroadPhaseKind::octree:
      if constexpr (D == 3) return Octree(tree);
      break;
    case BroadPhaseKind::bsp:
      return Bsp<D>(config_.planes, config_.bounds, Orthtree<D>::kMost);
    case BroadPhaseKind::kd_tree:
      return KdTree<D>({config_.capacity, depth, most_entries(room)});
  }
  throw Refused(fmt::format("broad phase: {} needs three dimensions", name_of(config_.kind)));
}

// --- an update ---

template <int D>
void BroadPhase<D>::update(std::span<const Proxy<D>> proxies) {
  const std::size_t places = own_places();
  sort_and_check(proxies);
  deal_out();
  counters_.pair_tests = counters_.nodes_visited = 0;
  counters_.nodes_skipped_asleep = counters_.nodes_reused = 0;
  try {
    find_pairs();
  } catch (...) {
    forget();
    throw;
  }
  own_allocations_ += own_places() != places;
  counters_.allocations = own_allocations_ + past_allocations_ + structure_allocations();
}

template <int D>
void BroadPhase<D>::find_pairs() {
  if (!same_boxes(fresh_static_, static_.bodies)) {
    static_.bodies.swap(fresh_static_);
    build(static_);
    ++counters_.static_builds;
  }
  const bool moved = !same_boxes(fresh_dynamic_, dynamic_.bodies);
  dynamic_.bodies.swap(fresh_dynamic_);
  pairs_.clear();
  if (std::any_of(dynamic_.bodies.begin(), dynamic_.bodies.end(), stirs)) {
    build(dynamic_);
    ++counters_.dynamic_builds;
    found_.clear();
    pair_dynamic();
    pair_static();
    sort_pairs();
  } else if (moved) {
    empty(dynamic_);
  }
}

// A structure that was not finished must not be taken for that of its bodies.
template <int D>
void BroadPhase<D>::forget() {
  pairs_.clear();
  for (Store* store : {&static_, &dynamic_}) {
    store->bodies.clear();
    store->ranks.clear();
    empty(*store);
  }
}

template <int D>
bool BroadPhase<D>::same_boxes(const std::vector<Proxy<D>>& a, const std::vector<Proxy<D>>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.id == y.id && x.box == y.box; });
}

template <int D>
void BroadPhase<D>::sort_and_check(std::span<const Proxy<D>> proxies) {
  const auto by_id = [](const Proxy<D>& a, const Proxy<D>& b) { return a.id < b.id; };
  for (const Proxy<D>& proxy : proxies) require_valid(Item<D>{proxy.id, proxy.box});
  sorted_.assign(proxies.begin(), proxies.end());
  if (!std::is_sorted(sorted_.begin(), sorted_.end(), by_id))
    std::sort(sorted_.begin(), sorted_.end(), by_id);
  for (std::size_t i = 1; i < sorted_.size(); ++i)
    if (sorted_[i - 1].id == sorted_[i].id)
      throw Refused(fmt::format("body {}: it is there twice", sorted_[i].id));
}

template <int D>
void BroadPhase<D>::deal_out() {
  fresh_static_.clear();
  fresh_dynamic_.clear();
  static_.ranks.clear();
  dynamic_.ranks.clear();
  for (std::uint32_t rank = 0; rank < sorted_.size(); ++rank) {
    const bool apart = config_.split_static && sorted_[rank].is_static;
    (apart ? fresh_static_ : fresh_dynamic_).push_back(sorted_[rank]);
    (apart ? static_ : dynamic_).ranks.push_back(rank);
  }
}

// --- building ---

template <int D>
void BroadPhase<D>::build(Store& store) {
  store.names.clear();
  for (const Proxy<D>& body : store.bodies) store.names.push_back(body.id);
  const auto make_anew = [&] {
    const auto count = [](const auto& structure) { return structure.counters().allocations; };
    past_allocations_ += std::visit(count, store.structure);
    store.structure = made(store.depth, store.room);
  };
  if (store.bodies.size() > store.room) {
    store.room = std::bit_ceil(store.bodies.size());
    store.depth = config_.max_depth;
    make_anew();
  }
  for (;;) {
    try {
      return fill(store);
    } catch (const Refused&) {
      if (store.depth == 0) throw;
    }
    store.depth /= 2;
    make_anew();
  }
}

template <int D>
void BroadPhase<D>::fill(Store& store) {
  items_.clear();
  for (std::uint32_t i = 0; i < store.bodies.size(); ++i)
    items_.push_back({i, store.bodies[i].box});
  std::visit(
      [&](auto& structure) {
        using S = std::remove_cvref_t<decltype(structure)>;
        if constexpr (std::is_same_v<S, KdTree<D>>) {
          structure.build(items_);
        } else {
          structure.clear();
          for (const Item<D>& item : items_) structure.insert(item);
        }
        if constexpr (std::is_same_v<S, SortAndSweep<D>>) structure.sort();
      },
      store.structure);
}

template <int D>
void BroadPhase<D>::empty(Store& store) {
  store.names.clear();
  std::visit([](auto& structure) { structure.clear(); }, store.structure);
}

// --- pairing ---

template <int D>
void BroadPhase<D>::pair_dynamic() {
  std::visit(
      [&](auto& structure) {
        using S = std::remove_cvref_t<decltype(structure)>;
        if constexpr (std::is_same_v<S, SortAndSweep<D>>) {
          counters_.nodes_visited = 1;
          counters_.pair_tests += structure.sweep(
              [&](BodyId i) { return stirs(dynamic_.bodies[i]); },
              [&](BodyId i, BodyId j) { add_pair(dynamic_.ranks[i], dynamic_.ranks[j]); });
        } else {
          pair_leaves(structure);
        }
        counters_.nodes_reused = structure.counters().nodes_reused;
      },
      dynamic_.structure);
}

template <int D>
template <class Tree>
void BroadPhase<D>::pair_leaves(const Tree& tree) {
  find_awake_nodes(tree);
  tree.visit(
      [&](const NodeView<D>& node) {
        if (awake_[node.handle] == 0) {
          ++counters_.nodes_skipped_asleep;
          return false;
        }
        ++counters_.nodes_visited;
        pair_bodies(node.bodies);
        return true;
      },
      ids_);
}

// An awake body wakes its leaf; children come after their parents, so one way back through the list
// wakes all nodes above.
template <int D>
template <class Tree>
void BroadPhase<D>::find_awake_nodes(const Tree& tree) {
  parents_.clear();
  handles_.clear();
  awake_.assign(tree.counters().nodes, 0);
  tree.visit(
      [&](const NodeView<D>& node) {
        parents_.push_back(node.parent);
        handles_.push_back(node.handle);
        awake_[node.handle] = std::any_of(node.bodies.begin(), node.bodies.end(),
                                          [&](BodyId i) { return stirs(dynamic_.bodies[i]); });
        return true;
      },
      ids_);
  for (std::size_t i = handles_.size(); i-- > 1;)
    if (awake_[handles_[i]] != 0) awake_[handles_[parents_[i]]] = 1;
}

// Each awake body of the leaf with those that sleep, and with the awake ones behind it in the list.
template <int D>
void BroadPhase<D>::pair_bodies(std::span<const BodyId> bodies) {
  for (const BodyId i : bodies) {
    stop_if_asked();
    const Proxy<D>& a = dynamic_.bodies[i];
    if (!stirs(a)) continue;
    for (const BodyId j : bodies) {
      const Proxy<D>& b = dynamic_.bodies[j];
      if (j <= i && (j == i || stirs(b))) continue;
      ++counters_.pair_tests;
      if (overlap(a.box, b.box)) add_pair(dynamic_.ranks[i], dynamic_.ranks[j]);
    }
  }
}

// Each awake body asks the static structure.
template <int D>
void BroadPhase<D>::pair_static() {
  if (static_.bodies.empty()) return;
  std::visit(
      [&](const auto& structure) {
        for (std::size_t i = 0; i < dynamic_.bodies.size(); ++i) {
          stop_if_asked();
          const Proxy<D>& body = dynamic_.bodies[i];
          if (!stirs(body)) continue;
          ids_.clear();
          structure.near(body.box, ids_);
          counters_.pair_tests += ids_.size();
          for (const BodyId j : ids_)
            if (overlap(body.box, static_.bodies[j].box))
              add_pair(dynamic_.ranks[i], static_.ranks[j]);
        }
      },
      static_.structure);
}

template <int D>
void BroadPhase<D>::refuse_pair(BodyId body) const {
  throw Refused(
      fmt::format("body {}: with it more than {} pairs overlap; take fewer bodies, or part them",
                  body, config_.most_pairs));
}

// Before the list of pairs grows: twice as many places, each copied once, and what `sort_pairs`
// will need.
template <int D>
void BroadPhase<D>::require_room(BodyId body) const {
  const std::uint64_t pairs = 2 * std::max<std::uint64_t>(found_.size(), 512);
  require_memory(
      pairs * (3 * sizeof(RankPair) / 2 + sizeof(std::uint32_t) + sizeof(Pair)),
      fmt::format("body {}: with it {} or more pairs of boxes that overlap", body, found_.size()),
      "take fewer bodies, or part them");
}

// Counted into one row for each lower rank; rows are short, and in them copies stand side by side.
template <int D>
void BroadPhase<D>::sort_pairs() {
  first_.assign(sorted_.size() + 1, 0);
  for (const RankPair& pair : found_) ++first_[pair.a];
  std::exclusive_scan(first_.begin(), first_.end(), first_.begin(), 0u);
  partners_.resize(found_.size());
  for (const RankPair& pair : found_) partners_[first_[pair.a]++] = pair.b;
  std::uint32_t begin = 0;  // first_[a] is the end of its row now
  for (std::uint32_t a = 0; a < sorted_.size(); begin = first_[a++]) {
    stop_if_asked();
    const auto from = partners_.begin() + begin, to = partners_.begin() + first_[a];
    std::sort(from, to);
    std::for_each(from, std::unique(from, to), [&](std::uint32_t b) {
      pairs_.push_back({sorted_[a].id, sorted_[b].id});
    });
  }
}

// --- looking ---

template <int D>
std::vector<bool> BroadPhase<D>::awake_dynamic_nodes() const {
  return std::visit(
      [&](const auto& structure) {
        return awake_nodes(structure, [&](BodyId i) { return stirs(dynamic_.bodies[i]); });
      },
      dynamic_.structure);
}

template <int D>
std::uint64_t BroadPhase<D>::structure_allocations() const {
  const auto count = [](const auto& structure) { return structure.counters().allocations; };
  return std::visit(count, static_.structure) + std::visit(count, dynamic_.structure);
}

template <int D>
std::size_t BroadPhase<D>::own_places() const {
  std::size_t places = pairs_.capacity() + sorted_.capacity() + items_.capacity() +
                       ids_.capacity() + awake_.capacity() + parents_.capacity() +
                       handles_.capacity() + found_.capacity() + first_.capacity() +
                       partners_.capacity() + fresh_static_.capacity() + fresh_dynamic_.capacity();
  for (const Store* store : {&static_, &dynamic_})
    places += store->bodies.capacity() + store->ranks.capacity() + store->names.capacity();
  return places;
}

template class BroadPhase<2>;
template class BroadPhase<3>;

}  // namespace lantern
