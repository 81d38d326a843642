#include "spatial/broad_phase.hpp"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "base/error.hpp"

namespace lantern::spatial {
namespace {

// More entries or nodes than this are out of proportion.
std::uint64_t most_entries(std::uint64_t room) { return 4096 + 64 * room; }

}  // namespace

template <int D>
BroadPhase<D>::BroadPhase(const Config& config)
    : config_(config),
      static_{made(config.max_depth, 0), &BroadPhaseCounters::static_builds, config.max_depth},
      dynamic_{made(config.max_depth, 0), &BroadPhaseCounters::dynamic_builds, config.max_depth} {}

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
void BroadPhase<D>::update(std::span<const Proxy<D>> proxies) {
  take(proxies);
  all_or_nothing([&] {
    renew();
    if (!found_all_) find_pairs();
  });
}

template <int D>
void BroadPhase<D>::build(std::span<const Proxy<D>> proxies) {
  take(proxies);
  all_or_nothing([&] {
    renew();
    if (!dynamic_.stands) build(dynamic_);
  });
}

// Checked, sorted and dealt out to the stores.
template <int D>
void BroadPhase<D>::take(std::span<const Proxy<D>> proxies) {
  const auto by_id = [](const Proxy<D>& a, const Proxy<D>& b) { return a.id < b.id; };
  for (const Proxy<D>& proxy : proxies) require_valid(Item<D>{proxy.id, proxy.box});
  sorted_.assign(proxies.begin(), proxies.end());
  if (!std::is_sorted(sorted_.begin(), sorted_.end(), by_id))
    std::sort(sorted_.begin(), sorted_.end(), by_id);
  for (std::size_t i = 1; i < sorted_.size(); ++i)
    if (sorted_[i - 1].id == sorted_[i].id)
      throw Refused(fmt::format("body {}: it is there twice", sorted_[i].id));
  for (Store* store : stores()) {
    store->fresh.clear();
    store->ranks.clear();
  }
  for (std::uint32_t rank = 0; rank < sorted_.size(); ++rank) {
    Store& store = store_for(sorted_[rank]);
    store.fresh.push_back(sorted_[rank]);
    store.ranks.push_back(rank);
  }
}

// From now on the stores hold the bodies that were taken; the structure of static ones stands.
template <int D>
void BroadPhase<D>::renew() {
  const auto same_box = [](const auto& x, const auto& y) { return x.id == y.id && x.box == y.box; };
  for (Store* store : stores()) {
    found_all_ = found_all_ && store->fresh == store->bodies;
    store->stands = store->stands && std::ranges::equal(store->fresh, store->bodies, same_box);
    store->bodies.swap(store->fresh);
  }
  if (!static_.stands) build(static_);
}

// A structure that was not finished must not be taken for that of its bodies.
template <int D>
void BroadPhase<D>::forget() {
  pairs_.clear();
  found_all_ = false;
  for (Store* store : stores()) {
    store->bodies.clear();
    store->ranks.clear();
    empty(*store);
    store->stands = true;
  }
}

// --- building ---

template <int D>
void BroadPhase<D>::build(Store& store) {
  store.names.clear();
  items_.clear();
  for (const Proxy<D>& body : store.bodies) {
    items_.push_back({static_cast<BodyId>(items_.size()), body.box});
    store.names.push_back(body.id);
  }
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
      with_names(store, [&] { build_structure<D>(store.structure, items_); });
      break;
    } catch (const Refused&) {
      if (!config_.in_proportion || store.depth == 0) throw;
    }
    store.depth /= 2;
    make_anew();
  }
  store.stands = true;
  ++(counters_.*store.builds);
}

template <int D>
void BroadPhase<D>::insert(const Proxy<D>& proxy, const Watch& watch) {
  require_valid(Item<D>{proxy.id, proxy.box});
  Store& store = store_for(proxy);
  for (const Store* other : stores())
    if (!other->bodies.empty() && other->bodies.back().id >= proxy.id)
      throw Refused(fmt::format("body {}: ids must come in ascending order", proxy.id));
  const auto number = static_cast<BodyId>(store.bodies.size());
  const auto told = [&](Event event) {
    event.body = store.names[event.body];
    if (watch) watch(event);
  };
  found_all_ = false;
  all_or_nothing([&] {
    if (!store.stands) build(store);
    store.bodies.push_back(proxy);
    store.names.push_back(proxy.id);
    std::visit(
        [&](auto& structure) {
          if constexpr (requires { structure.insert(Item<D>{}, told); }) {
            counters_.*store.builds += number == 0;
            with_names(store, [&] { structure.insert(Item<D>{number, proxy.box}, told); });
          } else {
            build(store);
          }
        },
        store.structure);
  });
}

// A fault is told of bodies by their ids, not by their places in the list.
template <int D>
template <class F>
void BroadPhase<D>::with_names(const Store& store, F&& f) {
  try {
    f();
  } catch (const StructureFault& broken) {
    OwnFault fault = broken.fault();
    for (BodyId& body : fault.bodies) body = store.names[body];
    throw StructureFault(std::move(fault));
  }
}

template <int D>
void BroadPhase<D>::empty(Store& store) {
  store.names.clear();
  store.stands = store.bodies.empty();
  std::visit([](auto& structure) { structure.clear(); }, store.structure);
}

// --- looking ---

template <int D>
auto BroadPhase<D>::store_of(BodyId id, std::size_t& place) const -> const Store* {
  for (const Store* store : stores()) {
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
std::vector<OwnFault> BroadPhase<D>::faults() const {
  std::vector<OwnFault> all;
  for (const Store* store : stores()) {
    const auto* own = std::get_if<OwnStructure<D>>(&store->structure);
    if (!own) continue;
    for (OwnFault fault : own->faults()) {
      for (BodyId& body : fault.bodies) body = store->names[body];
      all.push_back(std::move(fault));
    }
  }
  return all;
}

template <int D>
std::optional<int> BroadPhase<D>::sweep_axis() const {
  const auto* sweep = std::get_if<SortAndSweep<D>>(&dynamic_.structure);
  return sweep ? std::optional(sweep->axis()) : std::nullopt;
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
  const auto places = [](const auto&... lists) { return (lists.capacity() + ...); };
  std::size_t all = places(pairs_, sorted_, items_, ids_, found_, first_, partners_);
  for (const Store* store : stores())
    all += places(store->bodies, store->fresh, store->ranks, store->names);
  return all + awake_.places();
}

template class BroadPhase<2>;
template class BroadPhase<3>;

}  // namespace lantern::spatial
