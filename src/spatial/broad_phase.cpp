#include "spatial/broad_phase.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <utility>

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
      static_(made(&BroadPhaseCounters::static_builds)),
      dynamic_(made(&BroadPhaseCounters::dynamic_builds)),
      fresh_(made(nullptr)) {}

template <int D>
auto BroadPhase<D>::made(std::uint64_t BroadPhaseCounters::*builds) -> Store {
  Store store{BruteForce<D>(), builds, config_.kind, config_};
  if (builds != nullptr && config_.kind != StructureKind::automatic) make_anew(store);
  return store;
}

// An empty structure as the store's settings ask for, in place of what was there.
template <int D>
void BroadPhase<D>::make_anew(Store& store) {
  StructureConfig<D> settings = store.settings;
  if (config_.in_proportion) settings.most_entries = most_entries(store.room);
  const auto count = [](const auto& structure) { return work_of(structure).allocations; };
  past_allocations_ += std::visit(count, store.structure);
  store.structure = make_structure<D>(store.kind, settings);
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
    if (!static_.stands) build(static_);
    if (!found_all_) find_pairs();
  });
}

template <int D>
void BroadPhase<D>::build(std::span<const Proxy<D>> proxies, const Watch& watch) {
  take(proxies);
  all_or_nothing([&] {
    for (Store* store : stores())
      if (!store->stands) build(*store, Use::questions, watch);
  });
}

// From now on the stores hold these bodies; structures whose bodies are where they were stand.
template <int D>
void BroadPhase<D>::take(std::span<const Proxy<D>> proxies) {
  bool same_bodies = true;
  const std::span<const Proxy<D>> by_id = checked(proxies, same_bodies);
  same_bodies ? move(by_id) : replace(by_id);
}

// In order of ids; are they those that the stores hold, each in its own?
template <int D>
auto BroadPhase<D>::checked(std::span<const Proxy<D>> proxies, bool& same_bodies)
    -> std::span<const Proxy<D>> {
  bool ascending = true;
  std::array<std::size_t, 2> places{};
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    const Proxy<D>& proxy = proxies[i];
    require_valid(Item<D>{proxy.id, proxy.box});
    ascending = ascending && (i == 0 || proxies[i - 1].id < proxy.id);
    const bool of_static = is_of_static(proxy);
    const std::vector<BodyId>& names = (of_static ? static_ : dynamic_).names;
    const std::size_t place = places[of_static]++;
    same_bodies = same_bodies && place < names.size() && names[place] == proxy.id;
  }
  same_bodies = same_bodies && ascending && places[0] == dynamic_.names.size() &&
                places[1] == static_.names.size();
  if (ascending) return proxies;
  const auto by_id = [](const Proxy<D>& a, const Proxy<D>& b) { return a.id < b.id; };
  sorted_.assign(proxies.begin(), proxies.end());
  std::sort(sorted_.begin(), sorted_.end(), by_id);
  for (std::size_t i = 1; i < sorted_.size(); ++i)
    if (sorted_[i - 1].id == sorted_[i].id)
      throw Refused(fmt::format("body {}: it is there twice", sorted_[i].id));
  return sorted_;
}

template <int D>
void BroadPhase<D>::move(std::span<const Proxy<D>> proxies) {
  std::array<std::size_t, 2> places{};
  std::array<bool, 2> moved{};
  for (const Proxy<D>& proxy : proxies) {
    const bool of_static = is_of_static(proxy);
    Store& store = of_static ? static_ : dynamic_;
    const std::size_t place = places[of_static]++;
    Box<D>& box = store.items[place].box;
    const State state{proxy.is_static, proxy.awake};
    if (!(box == proxy.box)) {
      box = proxy.box;
      moved[of_static] = true;
    }
    found_all_ = found_all_ && store.states[place] == state;
    store.states[place] = state;
  }
  for (const bool of_static : {false, true}) {
    Store& store = of_static ? static_ : dynamic_;
    if (!moved[of_static]) continue;
    store.only_moved = store.stands;
    store.stands = found_all_ = false;
  }
}

template <int D>
void BroadPhase<D>::replace(std::span<const Proxy<D>> proxies) {
  all_names_.clear();
  for (const Proxy<D>& proxy : proxies) all_names_.push_back(proxy.id);
  for (Store* store : stores()) {
    fresh_.items.clear();
    fresh_.names.clear();
    fresh_.states.clear();
    store->ranks.clear();
    for (std::uint32_t rank = 0; rank < proxies.size(); ++rank) {
      const Proxy<D>& proxy = proxies[rank];
      if (&store_for(proxy) != store) continue;
      fresh_.items.push_back({static_cast<BodyId>(fresh_.items.size()), proxy.box});
      fresh_.names.push_back(proxy.id);
      fresh_.states.push_back({proxy.is_static, proxy.awake});
      store->ranks.push_back(rank);
    }
    const bool same = fresh_.items == store->items && fresh_.names == store->names;
    found_all_ = found_all_ && same && fresh_.states == store->states;
    store->only_moved = false;
    store->stands = store->stands && same;
    store->items.swap(fresh_.items);
    store->names.swap(fresh_.names);
    store->states.swap(fresh_.states);
  }
}

// A structure that was not finished must not be taken for that of its bodies.
template <int D>
void BroadPhase<D>::forget() {
  pairs_.clear();
  found_all_ = false;
  for (Store* store : stores()) {
    store->items.clear();
    store->names.clear();
    store->states.clear();
    store->ranks.clear();
    empty(*store);
  }
}

// --- building ---

template <int D>
void BroadPhase<D>::build(Store& store, Use use, const Watch& watch) {
  if (config_.kind == StructureKind::automatic && !suits(store, use)) choose(store, use);
  if (mended(store, watch)) return;
  if (config_.in_proportion && store.items.size() > store.room) {
    store.room = std::bit_ceil(store.items.size());
    store.settings.max_depth = config_.max_depth;
    make_anew(store);
  }
  for (;;) {
    try {
      with_names(store, [&] { build_structure<D>(store.structure, store.items, config_.build); });
      break;
    } catch (const Refused&) {
      if (!config_.in_proportion || store.settings.max_depth == 0) throw;
    }
    store.settings.max_depth /= 2;
    make_anew(store);
  }
  store.stands = true;
  ++(counters_.*store.builds);
}

// What was chosen is chosen again when the bodies have become twice as many or half as many, or
// each of them is compared with twice as many others.
template <int D>
bool BroadPhase<D>::suits(const Store& store, Use use) const {
  constexpr double kFew = 16;  // comparisons of a body that are of no concern
  const std::size_t bodies = store.items.size();
  return store.kind != StructureKind::automatic && store.chosen_use == use &&
         bodies <= 2 * store.chosen_for && 2 * bodies >= store.chosen_for &&
         store.tests <= 2 * store.chosen_tests + kFew;
}

template <int D>
void BroadPhase<D>::choose(Store& store, Use use) {
  StructureChoice<D> choice = choose_structure<D>(store.items, config_, use);
  store.chosen_use = use;
  store.chosen_for = store.items.size();
  store.tests = store.chosen_tests = 0;
  store.why = std::move(choice.why);
  store.only_moved = false;
  store.kind = choice.kind;
  store.settings = std::move(choice.config);
  make_anew(store);
}

// A structure that can go on from where its bodies were is not built anew.
template <int D>
bool BroadPhase<D>::mended(Store& store, const Watch& watch) {
  if (!store.only_moved) return false;
  EventWatch told;
  if (watch)
    told = [&](Event event) {
      event.body = store.names[event.body];
      watch(event);
    };
  return std::visit(
      [&](auto& structure) {
        if constexpr (requires { structure.update(std::span<const Item<D>>()); }) {
          store.stands = true;  // for who looks meanwhile: each body that is in it has its name
          structure.update(std::span<const Item<D>>(store.items), told);
          return true;
        } else {
          return false;
        }
      },
      store.structure);
}

template <int D>
void BroadPhase<D>::insert(std::span<const Proxy<D>> proxies, const Watch& watch) {
  std::optional<BodyId> last;
  for (const Store* store : stores())
    if (!store->names.empty()) last = std::max(last, std::optional(store->names.back()));
  for (const Proxy<D>& proxy : proxies) {
    require_valid(Item<D>{proxy.id, proxy.box});
    if (last >= proxy.id)
      throw Refused(fmt::format("body {}: ids must come in ascending order", proxy.id));
    last = proxy.id;
  }
  if (proxies.empty()) return;
  found_all_ = false;
  all_or_nothing([&] {
    std::array<bool, 2> entered{};
    for (const Proxy<D>& proxy : proxies) {
      Store& store = store_for(proxy);
      if (!std::exchange(entered[is_of_static(proxy)], true) && !store.stands) build(store);
      put(store, proxy, watch);
    }
    if (entered[false]) finish(dynamic_);
    if (entered[true]) finish(static_);
  });
}

// Into the structure, too, if that takes one after another.
template <int D>
void BroadPhase<D>::put(Store& store, const Proxy<D>& proxy, const Watch& watch) {
  const auto number = static_cast<BodyId>(store.items.size());
  const Item<D> item{number, proxy.box};
  store.items.push_back(item);
  store.names.push_back(proxy.id);
  store.states.push_back({proxy.is_static, proxy.awake});
  store.ranks.push_back(static_cast<std::uint32_t>(all_names_.size()));
  all_names_.push_back(proxy.id);
  const auto told = [&](Event event) {
    event.body = store.names[event.body];
    watch(event);
  };
  std::visit(
      [&](auto& structure) {
        if constexpr (requires { structure.insert(item); }) {
          counters_.*store.builds += number == 0;
          with_names(store, [&] { watch ? structure.insert(item, told) : structure.insert(item); });
        }
      },
      store.structure);
}

// What several insertions leave to be done once.
template <int D>
void BroadPhase<D>::finish(Store& store) {
  std::visit(
      [&](auto& structure) {
        if constexpr (!requires { structure.insert(Item<D>{}); }) {
          store.only_moved = false;
          build(store);
        } else if constexpr (requires { structure.look(); }) {
          with_names(store, [&] { structure.look(); });
        }
      },
      store.structure);
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
  store.stands = store.items.empty();
  store.only_moved = false;
  std::visit([](auto& structure) { structure.clear(); }, store.structure);
}

// --- looking ---

template <int D>
auto BroadPhase<D>::store_of(BodyId id, std::size_t& place) const -> const Store* {
  for (const Store* store : stores()) {
    if (!store->stands) continue;
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
  return store ? std::optional(store->items[place].box) : std::nullopt;
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
std::vector<GridExtent> BroadPhase<D>::grid_extents() const {
  const auto* grid = std::get_if<Grid<D>>(&dynamic_.structure);
  return grid ? grid->extents() : std::vector<GridExtent>();
}

template <int D>
void BroadPhase<D>::each_swept(const std::function<void(BodyId, BodyId)>& f) const {
  const auto* sweep = std::get_if<SortAndSweep<D>>(&dynamic_.structure);
  if (!sweep || !dynamic_.stands) return;
  SortAndSweep<D>(*sweep).compare(
      [](BodyId) { return true; },
      [&](const Item<D>& a, const Item<D>& b) { f(dynamic_.names[a.id], dynamic_.names[b.id]); });
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
  const auto count = [](const auto& structure) { return work_of(structure).allocations; };
  return std::visit(count, static_.structure) + std::visit(count, dynamic_.structure);
}

template <int D>
std::size_t BroadPhase<D>::own_places() const {
  const auto places = [](const auto&... lists) { return (lists.capacity() + ...); };
  const auto of_store = [&](const Store& s) { return places(s.items, s.names, s.states, s.ranks); };
  return places(pairs_, sorted_, all_names_, ids_, bodies_) + of_store(static_) +
         of_store(dynamic_) + of_store(fresh_) + awake_.places() + leaf_.places() +
         found_.places() + order_.places();
}

template class BroadPhase<2>;
template class BroadPhase<3>;

}  // namespace lantern::spatial
