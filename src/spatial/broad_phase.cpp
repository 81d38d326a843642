#include "spatial/broad_phase.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/stop.hpp"
#include "spatial/pairs.hpp"

namespace lantern {
namespace {

// One that must be sorted before it is asked, and into which was inserted since.
template <class Structure>
void sort(Structure& structure) {
  std::visit(
      [](auto& s) {
        if constexpr (requires { s.sort(); }) s.sort();
      },
      structure);
}

// More entries or nodes than this are out of proportion.
std::uint64_t most_entries(std::uint64_t room) { return 4096 + 64 * room; }

}  // namespace

template <int D>
BroadPhase<D>::BroadPhase(const Config& config)
    : config_(config),
      static_{made(config.max_depth, 0), {}, {}, {}, config.max_depth, 0},
      dynamic_{made(config.max_depth, 0), {}, {}, {}, config.max_depth, 0} {}

template <int D>
auto BroadPhase<D>::made(std::uint32_t depth, std::uint64_t room) const -> Structure {
  StructureConfig<D> structure = config_;
  structure.max_depth = depth;
  if (config_.in_proportion) structure.most_entries = most_entries(room);
  return make_structure<D>(config_.kind, structure);
}

// --- an update ---

template <int D>
template <class F>
void BroadPhase<D>::all_or_nothing(F&& change) {
  const std::size_t places = own_places();
  try {
    change();
  } catch (...) {
    forget();
    throw;
  }
  own_allocations_ += own_places() != places;
  counters_.allocations = own_allocations_ + past_allocations_ + structure_allocations();
}

template <int D>
void BroadPhase<D>::take(std::span<const Proxy<D>> proxies) {
  sort_and_check(proxies);
  deal_out();
}

template <int D>
void BroadPhase<D>::update(std::span<const Proxy<D>> proxies) {
  take(proxies);
  all_or_nothing([&] { find_pairs(); });
}

template <int D>
void BroadPhase<D>::build(std::span<const Proxy<D>> proxies) {
  take(proxies);
  all_or_nothing([&] {
    const bool changed_static = take_static(), changed_dynamic = take_dynamic();
    found_all_ = found_all_ && !changed_static && !changed_dynamic;
    if (!dynamic_.stands) build(dynamic_, counters_.dynamic_builds);
  });
}

template <int D>
void BroadPhase<D>::find_pairs() {
  const bool changed_static = take_static(), changed_dynamic = take_dynamic();
  if (found_all_ && !changed_static && !changed_dynamic) return;
  counters_.pair_tests = counters_.nodes_visited = 0;
  counters_.nodes_skipped_asleep = counters_.nodes_reused = 0;
  pairs_.clear();
  if (std::any_of(dynamic_.bodies.begin(), dynamic_.bodies.end(), stirs)) {
    if (!dynamic_.stands) build(dynamic_, counters_.dynamic_builds);
    for (Store* store : {&static_, &dynamic_}) sort(store->structure);
    found_.clear();
    pair_dynamic();
    pair_static();
    sort_pairs();
  } else if (!dynamic_.stands) {
    empty(dynamic_);
  }
  found_all_ = true;
}

// Whether anything about the static bodies has changed; their structure stands afterwards.
template <int D>
bool BroadPhase<D>::take_static() {
  const bool changed = fresh_static_ != static_.bodies;
  if (!same_boxes(fresh_static_, static_.bodies)) static_.stands = false;
  static_.bodies.swap(fresh_static_);
  if (!static_.stands) build(static_, counters_.static_builds);
  return changed;
}

template <int D>
bool BroadPhase<D>::take_dynamic() {
  const bool changed = fresh_dynamic_ != dynamic_.bodies;
  if (!same_boxes(fresh_dynamic_, dynamic_.bodies)) dynamic_.stands = false;
  dynamic_.bodies.swap(fresh_dynamic_);
  return changed;
}

// A structure that was not finished must not be taken for that of its bodies.
template <int D>
void BroadPhase<D>::forget() {
  pairs_.clear();
  found_all_ = false;
  for (Store* store : {&static_, &dynamic_}) {
    store->bodies.clear();
    store->ranks.clear();
    empty(*store);
    store->stands = true;
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
    const bool apart = is_for_static(sorted_[rank]);
    (apart ? fresh_static_ : fresh_dynamic_).push_back(sorted_[rank]);
    (apart ? static_ : dynamic_).ranks.push_back(rank);
  }
}

// --- building ---

template <int D>
void BroadPhase<D>::build(Store& store, std::uint64_t& builds) {
  store.names.clear();
  for (const Proxy<D>& body : store.bodies) store.names.push_back(body.id);
  const auto make_anew = [&] {
    const auto count = [](const auto& structure) { return structure.counters().allocations; };
    past_allocations_ += std::visit(count, store.structure);
    store.structure = made(store.depth, store.room);
  };
  if (config_.in_proportion && store.bodies.size() > store.room) {
    store.room = std::bit_ceil(store.bodies.size());
    store.depth = config_.max_depth;
    make_anew();
  }
  for (;;) {
    try {
      fill(store);
      break;
    } catch (const Refused&) {
      if (!config_.in_proportion || store.depth == 0) throw;
    }
    store.depth /= 2;
    make_anew();
  }
  store.stands = true;
  ++builds;
}

template <int D>
void BroadPhase<D>::fill(Store& store) {
  items_.clear();
  for (std::uint32_t i = 0; i < store.bodies.size(); ++i)
    items_.push_back({i, store.bodies[i].box});
  build_structure<D>(store.structure, items_);
}

template <int D>
void BroadPhase<D>::insert(const Proxy<D>& proxy, const Watch& watch) {
  require_valid(Item<D>{proxy.id, proxy.box});
  Store& store = is_for_static(proxy) ? static_ : dynamic_;
  std::uint64_t& builds = is_for_static(proxy) ? counters_.static_builds : counters_.dynamic_builds;
  for (const Store* other : {&static_, &dynamic_})
    if (!other->bodies.empty() && other->bodies.back().id >= proxy.id)
      throw Refused(fmt::format("body {}: ids must come in ascending order", proxy.id));
  const auto number = static_cast<BodyId>(store.bodies.size());
  const auto told = [&](Event event) {
    event.body = store.names[event.body];
    if (watch) watch(event);
  };
  found_all_ = false;
  all_or_nothing([&] {
    if (!store.stands) build(store, builds);
    store.bodies.push_back(proxy);
    store.names.push_back(proxy.id);
    std::visit(
        [&](auto& structure) {
          if constexpr (requires { structure.insert(Item<D>{}, told); }) {
            builds += number == 0;
            structure.insert(Item<D>{number, proxy.box}, told);
          } else {
            build(store, builds);
          }
        },
        store.structure);
  });
}

template <int D>
void BroadPhase<D>::empty(Store& store) {
  store.names.clear();
  store.stands = store.bodies.empty();
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

// --- the chain of pairs ---

namespace {

// f(place, place) for each pair met in the leaves of which at least one stirs.
template <int D, class Tree, class F>
void each_met(const Tree& tree, const std::vector<bool>& stirring, F&& f) {
  tree.visit([&](const NodeView<D>& node) {
    for (std::size_t i = 0; i < node.bodies.size(); ++i) {
      stop_if_asked();
      for (std::size_t j = i + 1; j < node.bodies.size(); ++j)
        if (stirring[node.bodies[i]] || stirring[node.bodies[j]]) f(node.bodies[i], node.bodies[j]);
    }
    return true;
  });
}
template <int D, class F>
void each_met(SortAndSweep<D> sweep, const std::vector<bool>& stirring, F&& f) {
  sweep.compare([&](BodyId i) { return stirring[i]; },
                [&](const Item<D>& a, const Item<D>& b) { f(a.id, b.id); });
}

}  // namespace

template <int D>
PairChain BroadPhase<D>::pair_chain(const std::function<bool(BodyId)>& awake,
                                    std::uint64_t most) const {
  std::vector<bool> stirring;
  for (const Proxy<D>& body : dynamic_.bodies)
    stirring.push_back(!body.is_static && awake(body.id));
  std::vector<std::pair<const Proxy<D>*, const Proxy<D>*>> met;
  PairChain chain;
  const auto meet = [&](const Proxy<D>& a, const Proxy<D>& b) {
    require_within(++chain.met, most);
    met.push_back(a.id < b.id ? std::pair(&a, &b) : std::pair(&b, &a));
  };
  std::visit(
      [&](const auto& tree) {
        each_met<D>(tree, stirring,
                    [&](BodyId i, BodyId j) { meet(dynamic_.bodies[i], dynamic_.bodies[j]); });
      },
      dynamic_.structure);
  const auto ask = [&](const auto& of_static) {
    for (std::size_t i = 0; i < stirring.size() && !static_.bodies.empty(); ++i) {
      std::vector<BodyId> near;
      if (stirring[i]) of_static.near(dynamic_.bodies[i].box, near);
      for (const BodyId j : near) meet(dynamic_.bodies[i], static_.bodies[j]);
    }
  };
  std::visit(
      [&](const auto& structure) {
        if constexpr (requires(std::remove_cvref_t<decltype(structure)> s) { s.sort(); }) {
          auto sorted = structure;
          sorted.sort();
          ask(sorted);
        } else {
          ask(structure);
        }
      },
      static_.structure);
  std::sort(met.begin(), met.end(), [](const auto& x, const auto& y) {
    stop_if_asked();
    return Pair{x.first->id, x.second->id} < Pair{y.first->id, y.second->id};
  });
  met.erase(std::unique(met.begin(), met.end()), met.end());
  for (const auto& [a, b] : met) {
    chain.pairs.push_back({a->id, b->id});
    if (overlap(a->box, b->box)) chain.overlapping.push_back({a->id, b->id});
  }
  return chain;
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
auto BroadPhase<D>::store_of(BodyId id, std::size_t& place) const -> const Store* {
  for (const Store* store : {&static_, &dynamic_}) {
    const auto found = std::lower_bound(store->names.begin(), store->names.end(), id);
    if (found == store->names.end() || *found != id) continue;
    place = static_cast<std::size_t>(found - store->names.begin());
    return store;
  }
  return nullptr;
}

template <int D>
std::optional<Box<D>> BroadPhase<D>::box_of(BodyId id) const {
  std::size_t place = 0;
  const Store* store = store_of(id, place);
  return store ? std::optional(store->bodies[place].box) : std::nullopt;
}

template <int D>
int BroadPhase<D>::sweep_axis() const {
  return std::visit(
      [](const auto& structure) {
        if constexpr (requires { structure.axis(); })
          return structure.axis();
        else
          return -1;
      },
      dynamic_.structure);
}

template <int D>
bool BroadPhase<D>::is_stale(const Item<D>& item) const {
  std::size_t place = 0;
  const Store* store = store_of(item.id, place);
  if (store == nullptr) return false;
  return std::visit(
      [&](const auto& structure) {
        if constexpr (requires { structure.fits(item); })
          return !structure.fits({static_cast<BodyId>(place), item.box});
        else
          return false;
      },
      store->structure);
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
