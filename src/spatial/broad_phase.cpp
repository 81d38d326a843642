#include "spatial/broad_phase.hpp"

#include <utility>

#include "base/check.hpp"
#include "spatial/broad_phase_pairs.hpp"

namespace lantern::spatial {
namespace {

// More entries or nodes than this are out of proportion.
std::uint64_t most_entries(std::uint64_t room) { return 4096 + 64 * room; }

}  // namespace

template <int D>
BroadPhase<D>::~BroadPhase() = default;
template <int D>
BroadPhase<D>::BroadPhase(BroadPhase&&) noexcept = default;
template <int D>
BroadPhase<D>& BroadPhase<D>::operator=(BroadPhase&&) noexcept = default;

template <int D>
BroadPhase<D>::BroadPhase(const Config& config)
    : config_(config),
      static_(made(&BroadPhaseCounters::static_builds)),
      dynamic_(made(&BroadPhaseCounters::dynamic_builds)),
      search_(std::make_unique<OrderedSearch<D>>()) {}

template <int D>
auto BroadPhase<D>::made(std::uint64_t BroadPhaseCounters::*builds) -> Store {
  Store store{{}, make_structure<D>(StructureKind::brute_force), builds, config_.kind, config_};
  if (config_.kind != StructureKind::automatic) make_anew(store);
  return store;
}

// An empty structure as the store's settings ask for, in place of what was there.
template <int D>
void BroadPhase<D>::make_anew(Store& store) {
  StructureConfig<D> settings = store.settings;
  if (config_.in_proportion) settings.most_entries = most_entries(store.room);
  past_allocations_ += store.structure->work().allocations;
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
  counters_.allocations = own_allocations_ + past_allocations_;
  for (const Store* store : stores()) counters_.allocations += store->structure->work().allocations;
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

// From now on the stores hold these bodies; structures whose bodies are where they were stand. A
// body that is as it was needs no second look: most of what a town holds.
template <int D>
void BroadPhase<D>::take(std::span<const Proxy<D>> proxies) {
  bool ascending = true;
  bool same_bodies = true;  // are they those that the stores hold, each in its own?
  bool changes = false;     // is the one before not as it was?
  std::uint32_t fixed = 0;  // so many before belong to the static store
  changed_.clear();
  for (std::uint32_t i = 0; i < proxies.size(); ++i) {
    const Proxy<D>& proxy = proxies[i];
    ascending = ascending && (i == 0 || proxies[i - 1].id < proxy.id);
    const Store& store = store_for(proxy);
    const std::uint32_t place = is_of_static(proxy) ? fixed : i - fixed;
    same_bodies = same_bodies && store.has(place, proxy.id);
    const bool as_it_was = same_bodies && is_in(store, place, proxy);
    if (!as_it_was) require_valid(Item<D>{proxy.id, proxy.box});
    if (changes == as_it_was) changed_.push_back({i, fixed});
    changes = !as_it_was;
    fixed += is_of_static(proxy);
  }
  if (same_bodies && ascending && proxies.size() == size()) {
    if (changes) changed_.push_back({static_cast<std::uint32_t>(proxies.size()), fixed});
    for (std::size_t run = 0; run < changed_.size(); run += 2)
      for (auto [i, before] = changed_[run]; i < changed_[run + 1][0]; ++i)
        is_of_static(proxies[i]) ? set(static_, before++, proxies[i])
                                 : set(dynamic_, i - before, proxies[i]);
    return;
  }
  if (ascending) return replace(proxies);
  sorted_.assign(proxies.begin(), proxies.end());
  std::ranges::sort(sorted_, {}, &Proxy<D>::id);
  for (std::size_t i = 1; i < sorted_.size(); ++i)
    if (sorted_[i - 1].id == sorted_[i].id)
      throw Refused("body {}: it is there twice", sorted_[i].id);
  replace(sorted_);
}

template <int D>
void BroadPhase<D>::set(Store& store, std::size_t place, const Proxy<D>& proxy) {
  if (is_in(store, place, proxy)) return;
  Box<D>& box = store.boxes[place];
  found_all_ = false;
  store.set_state(place, {proxy.is_static, proxy.awake});
  if (!(box == proxy.box)) {
    box = proxy.box;
    store.only_moved |= store.stands;
    store.stands = false;
    if (&store == &static_) near_.forget();
  }
  if (resting_ && &store == &dynamic_ && !store.state(place).stirs()) put_to_rest(place);
}

// Where it was before it is in the tree still: of too many of these it is built anew.
template <int D>
void BroadPhase<D>::put_to_rest(std::size_t place) {
  auto tree = std::move(resting_);
  if (++put_to_rest_ > 64 + dynamic_.size() / 2) return;
  tree->insert({static_cast<BodyId>(place), dynamic_.boxes[place]});
  resting_ = std::move(tree);
}

template <int D>
void BroadPhase<D>::follow(std::span<const Proxy<D>> changed) {
  bool all_valid = true;  // without a branch for each
  for (const Proxy<D>& proxy : changed) all_valid &= is_valid(proxy.box);
  if (!all_valid)
    for (const Proxy<D>& proxy : changed) require_valid(Item<D>{proxy.id, proxy.box});
  all_or_nothing([&] {
    stirring_.clear();
    std::array<std::size_t, 2> next{};
    for (const Proxy<D>& proxy : changed) {
      Store& store = store_for(proxy);
      std::size_t& place = next[is_of_static(proxy)];
      if (!store.has(place, proxy.id)) place = store.place_of(proxy.id);
      LANTERN_CHECK(place, <, store.size());
      set(store, place, proxy);
      if (store.state(place).stirs()) stirring_.push_back(place);
      ++place;
    }
    if (!static_.stands) build(static_);
    if (found_all_) return;
    if (each_asks_alone()) return find_pairs_of_few();
    mends_pairs() ? mend_pairs() : find_pairs();
  });
}

template <int D>
void BroadPhase<D>::replace(std::span<const Proxy<D>> proxies) {
  resting_.reset();
  near_.forget();
  ranked_ = false;
  for (Store* store : stores()) {
    bool same = true, same_states = true;
    std::size_t bodies = 0;
    for (const Proxy<D>& proxy : proxies) {
      if (&store_for(proxy) != store) continue;
      same = same && store->has(bodies, proxy.id) && store->boxes[bodies] == proxy.box;
      same_states = same_states && same && is_in(*store, bodies, proxy);
      ++bodies;
    }
    same = same && bodies == store->size();
    found_all_ = found_all_ && same && same_states;
    store->only_moved = false;
    store->stands = store->stands && same;
    if (same && same_states) continue;
    if (store->size() == 0) store->boxes.reserve(bodies);
    store->clear();
    for (const Proxy<D>& proxy : proxies)
      if (&store_for(proxy) == store)
        store->push_back({proxy.id, proxy.box}, {proxy.is_static, proxy.awake});
  }
}

// Ranks are numbers of all bodies in the order of their ids: the ids themselves if these are 0, 1,
// 2, ...; places in the dynamic store if there are no static bodies; else `ranks`.
template <int D>
void BroadPhase<D>::rank_all() {
  if (std::exchange(ranked_, true)) return;
  numbered_ = std::max(static_.end_id(), dynamic_.end_id()) == size();
  all_ids_.clear();
  for (Store* store : stores()) store->ranks.clear();
  if (numbered_ || static_.size() == 0) return;
  std::array<std::size_t, 2> next{};
  for (std::uint32_t rank = 0; rank < size(); ++rank) {
    const bool is_static = next[0] == dynamic_.size() ||
                           (next[1] < static_.size() && static_.id(next[1]) < dynamic_.id(next[0]));
    Store& store = is_static ? static_ : dynamic_;
    store.ranks.push_back(rank);
    all_ids_.push_back(store.id(next[is_static]++));
  }
}

// A structure that was not finished must not be taken for that of its bodies.
template <int D>
void BroadPhase<D>::forget() {
  pairs_.clear();
  resting_.reset();
  near_.forget();
  found_all_ = false;
  ranked_ = false;
  for (Store* store : stores()) {
    store->clear();
    empty(*store);
  }
}

// --- building ---

template <int D>
void BroadPhase<D>::build(Store& store, Use use, const Watch& watch) {
  build(store, store.boxes, use, watch);
}

template <int D>
void BroadPhase<D>::build(Store& store, std::span<const Box<D>> boxes, Use use,
                          const Watch& watch) {
  if (&store == &dynamic_) reaches_stand_ = false;
  if (config_.kind == StructureKind::automatic) choose(store, use);
  // A structure that can go on from where its bodies were is not built anew.
  if (store.only_moved) {
    store.stands = true;  // for who looks meanwhile: each body that is in it has its name
    store.stands = store.structure->update(boxes, naming(store, watch));
    if (store.stands) return;
  }
  if (config_.in_proportion && store.size() > store.room) {
    store.room = std::bit_ceil(store.size());
    store.settings.max_depth = config_.max_depth;
    make_anew(store);
  }
  for (;;) {
    try {
      with_names(store, [&] { store.structure->build(boxes, config_.build); });
      break;
    } catch (const Refused&) {
      if (!config_.in_proportion || store.settings.max_depth == 0) throw;
    }
    store.settings.max_depth /= 2;
    make_anew(store);
  }
  store.stands = true;
  ++(counters_.*store.builds);
  counters_.entries_made += store.structure->work().entries;
}

// What was chosen is chosen again when the bodies have become twice as many or half as many, or
// each of them is compared with twice as many others; and what is asked and moves is followed.
template <int D>
void BroadPhase<D>::choose(Store& store, Use use) {
  constexpr double kFew = 16;  // comparisons of a body that are of no concern
  const std::size_t bodies = store.size();
  if (use == Use::questions && store.only_moved && store.kind == StructureKind::wide_bvh) {
    store.only_moved = false;
    store.kind = StructureKind::aabb_tree;
    return make_anew(store);
  }
  if (store.kind != StructureKind::automatic && store.chosen_use == use &&
      bodies <= 2 * store.chosen_for && 2 * bodies >= store.chosen_for &&
      store.tests <= 2 * store.chosen_tests + kFew)
    return;
  StructureChoice<D> choice = choose_structure<D>(store.boxes, config_, use);
  store.chosen_use = use;
  store.chosen_for = bodies;
  store.tests = store.chosen_tests = 0;
  store.only_moved = false;
  store.kind = choice.kind;
  store.settings = std::move(choice.config);
  make_anew(store);
}

// Who watches is told of bodies by their ids, not by their places in the list.
template <int D>
auto BroadPhase<D>::naming(const Store& store, const Watch& watch) -> Watch {
  if (!watch) return {};
  return [&](Event event) {
    event.body = store.id(event.body);
    watch(event);
  };
}

template <int D>
void BroadPhase<D>::insert(std::span<const Proxy<D>> proxies, const Watch& watch) {
  std::uint64_t least = std::max(static_.end_id(), dynamic_.end_id());
  for (const Proxy<D>& proxy : proxies) {
    require_valid(Item<D>{proxy.id, proxy.box});
    if (proxy.id < least) throw Refused("body {}: ids must come in ascending order", proxy.id);
    least = std::uint64_t{proxy.id} + 1;
  }
  if (proxies.empty()) return;
  resting_.reset();
  near_.forget();
  found_all_ = ranked_ = false;
  all_or_nothing([&] {
    std::array<bool, 2> entered{};
    for (const Proxy<D>& proxy : proxies) {
      Store& store = store_for(proxy);
      if (!std::exchange(entered[is_of_static(proxy)], true) && !store.stands) build(store);
      put(store, proxy, watch);
    }
    for (const bool of_static : {false, true})
      if (Store& store = of_static ? static_ : dynamic_; entered[of_static]) {
        // What several insertions leave to be done once.
        if (!store.stands) build(store);
        with_names(store, [&] { store.structure->look(); });
      }
  });
}

// Into the structure, too, if that takes one after another; else that no longer stands.
template <int D>
void BroadPhase<D>::put(Store& store, const Proxy<D>& proxy, const Watch& watch) {
  const Item<D> item{static_cast<BodyId>(store.size()), proxy.box};
  store.push_back({proxy.id, proxy.box}, {proxy.is_static, proxy.awake});
  const std::uint64_t before = store.structure->work().entries;
  with_names(store, [&] {
    if (store.structure->insert(item, naming(store, watch))) {
      counters_.*store.builds += item.id == 0;
      counters_.entries_made += store.structure->work().entries - before;
    } else {
      store.stands = store.only_moved = false;
    }
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
    for (BodyId& body : fault.bodies) body = store.id(body);
    throw StructureFault(std::move(fault));
  }
}

template <int D>
void BroadPhase<D>::empty(Store& store) {
  if (&store == &dynamic_) reaches_stand_ = false;
  store.stands = store.size() == 0;
  store.only_moved = false;
  store.structure->clear();
}

// --- looking ---

template <int D>
auto BroadPhase<D>::store_of(BodyId id, std::size_t& place) const -> const Store* {
  for (const Store* store : stores()) {
    if (!store->stands) continue;
    place = store->place_of(id);
    if (store->has(place, id)) return store;
  }
  return nullptr;
}

template <int D>
std::optional<Box<D>> BroadPhase<D>::box_of(BodyId id) const {
  std::size_t place = 0;
  const Store* store = store_of(id, place);
  return store ? std::optional(store->boxes[place]) : std::nullopt;
}

template <int D>
std::vector<OwnFault> BroadPhase<D>::faults() const {
  std::vector<OwnFault> all;
  for (const Store* store : stores())
    for (OwnFault fault : store->structure->faults()) {
      for (BodyId& body : fault.bodies) body = store->id(body);
      all.push_back(std::move(fault));
    }
  return all;
}

template <int D>
void BroadPhase<D>::each_swept(FunctionRef<void(BodyId, BodyId)> f) const {
  if (!arrangement().axis || !dynamic_.stands) return;
  dynamic_.structure->sorted()->compare(
      [](BodyId) { return true; }, [&](BodyId a, BodyId b) { f(dynamic_.id(a), dynamic_.id(b)); });
}

template <int D>
bool BroadPhase<D>::is_stale(const Item<D>& item) const {
  std::size_t place = 0;
  const Store* store = store_of(item.id, place);
  return store != nullptr && !store->structure->fits({static_cast<BodyId>(place), item.box});
}

template <int D>
std::size_t BroadPhase<D>::own_places() const {
  const auto of_store = [](const Store& s) { return s.places() + s.ranks.capacity(); };
  return pairs_.capacity() + sorted_.capacity() + all_ids_.capacity() + ids_.capacity() +
         of_store(static_) + of_store(dynamic_) + few_bodies_.places() + stirring_.capacity() +
         near_.places() + spots_.capacity() + changed_.capacity() + search_->places() +
         search_->order.places();
}

template class BroadPhase<2>;
template class BroadPhase<3>;

}  // namespace lantern::spatial
