// How a broad phase finds its pairs: all, those of the few that stir, or where little moves from
// those that were near each other before. Members of BroadPhase, for its one source.
#pragma once

#include "base/memory.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/pair_search.hpp"

namespace lantern::spatial {

template <int D>
void BroadPhase<D>::begin_search(std::span<const Box<D>> boxes, std::span<const ProxyState> states,
                                 std::span<const BodyId> names) {
  counters_.pair_tests = counters_.nodes_visited = 0;
  counters_.nodes_skipped_asleep = counters_.nodes_reused = 0;
  pairs_.clear();
  search_->begin(boxes, states);
  search_->found.set_threads(config_.threads);
  found_names_ = names;
  search_->found.ask_before_growing(
      [this](BodyId body, std::size_t pairs) { require_room(body, pairs); });
}

template <int D>
void BroadPhase<D>::find_pairs() {
  begin_search(dynamic_.boxes, dynamic_.states, dynamic_.ids);
  if (search_->stirring() > 0) {
    if (!dynamic_.stands) build(dynamic_);
    search();
    order_pairs(pairs_);
  } else if (!dynamic_.stands) {
    empty(dynamic_);
  }
  found_all_ = true;
}

// Of these, of which at least one stirs: the structure holds them.
template <int D>
void BroadPhase<D>::search() {
  for (Store* store : stores()) store->structure->sort();
  dynamic_.structure->pair(*search_);
  counters_.pair_tests = search_->tests;
  counters_.nodes_visited = search_->nodes_visited;
  counters_.nodes_skipped_asleep = search_->nodes_skipped;
  counters_.nodes_reused = dynamic_.structure->work().nodes_reused;
  dynamic_.tests =
      static_cast<double>(counters_.pair_tests) / static_cast<double>(search_->stirring());
  if (dynamic_.chosen_tests == 0) dynamic_.chosen_tests = dynamic_.tests;
  pair_static();
}

template <int D>
void BroadPhase<D>::order_pairs(std::vector<Pair>& pairs) {
  FoundPairs& found = search_->found;
  if (found.size() > config_.most_pairs) refuse_more(found.first()[config_.most_pairs]);
  constexpr std::size_t kFew = 8;  // of many bodies: it costs less to compare them with each other
  if (kFew * found.size() >= size())
    return search_->order.order(found, size(), found_names_, pairs);
  pairs.clear();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto [a, b] = std::minmax(found.first()[i], found.second()[i]);
    pairs.push_back({id_at(found_names_, a), id_at(found_names_, b)});
  }
  std::ranges::sort(pairs);
  pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
}

// What was found among dynamic bodies is named by their ranks among all from now on.
template <int D>
template <class PlaceOf>
void BroadPhase<D>::name_by_ranks(PlaceOf&& place_of) {
  rank_all();
  FoundPairs& found = search_->found;
  for (const std::span<BodyId> list : {found.first(), found.second()})
    for (BodyId& i : list) i = rank(dynamic_, place_of(i));
  found_names_ = names_by_rank();
}

// Each awake body asks the static structure.
template <int D>
void BroadPhase<D>::pair_static() {
  if (static_.size() == 0) return;
  name_by_ranks([](BodyId place) { return place; });
  for (std::size_t i = 0; i < dynamic_.size(); ++i)
    if (search_->stirs(i)) ask(*static_.structure, static_, search_->box(i), i);
}

// Of the others those that stir are not met so.
template <int D>
void BroadPhase<D>::ask(const Structure<D>& structure, const Store& others, const Box<D>& box,
                        std::size_t place) {
  stop_if_asked();
  ids_.clear();
  structure.near(box, ids_);
  for (const BodyId j : ids_) {
    if (others.state(j).stirs()) continue;
    ++counters_.pair_tests;
    if (overlap(box, others.boxes[j])) search_->found.add(rank(dynamic_, place), rank(others, j));
  }
}

template <int D>
bool BroadPhase<D>::each_asks_alone() const {
  constexpr std::size_t kMany = 64, kFew = 8;
  const StructureTraits& traits = traits_of(config_.kind);
  const std::size_t all = dynamic_.size();
  return all >= kMany && kFew * stirring_.size() <= all && !traits.follows && !traits.is_own &&
         !traits.has(Setting::axis);
}

template <int D>
Structure<D>& BroadPhase<D>::few() {
  if (!few_) few_ = make_structure<D>(StructureKind::aabb_tree);
  return *few_;
}

// Those that stir among themselves, then each with what rests.
template <int D>
void BroadPhase<D>::find_pairs_of_few() {
  if (!resting_) {
    KeptItems<D> still;
    for (std::uint32_t i = 0; i < dynamic_.size(); ++i)
      if (!dynamic_.state(i).stirs()) still.push_back({i, dynamic_.boxes[i]});
    auto tree = make_structure<D>(StructureKind::aabb_tree);
    tree->build(still, Build::at_once);
    resting_ = std::move(tree);
    put_to_rest_ = 0;
  }
  few_bodies_.clear();
  for (const std::size_t place : stirring_)
    few_bodies_.push_back({dynamic_.id(place), dynamic_.boxes[place]}, {});
  begin_search(few_bodies_.boxes, {}, few_bodies_.ids);
  few().build(few_bodies_.boxes, Build::at_once);
  few_->pair(*search_);
  counters_.pair_tests = search_->tests;
  name_by_ranks([&](BodyId i) { return stirring_[i]; });
  for (const std::size_t place : stirring_) {
    const Box<D>& box = dynamic_.boxes[place];
    ask(*static_.structure, static_, box, place);
    ask(*resting_, dynamic_, box, place);
  }
  order_pairs(pairs_);
  found_all_ = true;
}

// --- mending ---

template <int D>
bool BroadPhase<D>::mends_pairs() const {
  constexpr std::size_t kMany = 64;
  return config_.mends && config_.kind == StructureKind::automatic && dynamic_.size() >= kMany;
}

template <int D>
void BroadPhase<D>::mend_pairs() {
  Mending next = near_.follow(dynamic_.boxes, reaches_stand_);
  if (next == Mending::anew && !find_near()) next = Mending::none;
  if (next == Mending::none) {
    find_pairs();
  } else {
    begin_search(dynamic_.boxes, dynamic_.states, dynamic_.ids);
    if (next == Mending::some) mend_near();
    pair_near();
    found_all_ = true;
  }
  near_.pay(next, pairs_.size());
}

// Of all bodies: false if too many are near each other.
template <int D>
bool BroadPhase<D>::find_near() {
  try {
    begin_search(near_.reaches(), {}, dynamic_.ids);
    build(dynamic_, near_.reaches());
    dynamic_.stands = dynamic_.only_moved = false;  // it holds reaches, not the boxes themselves
    search();
    found_names_ = {};
    order_pairs(near_.near());
  } catch (const Refused&) {
    near_.give_up();
    return false;
  }
  reaches_stand_ = true;
  rank_all();
  spots_.resize(static_.size() == 0 ? 0 : size());
  if (!spots_.empty())
    for (const Store* store : stores())
      for (std::uint32_t place = 0; place < store->size(); ++place)
        spots_[rank(*store, place)] = {store == &static_, place};
  return true;
}

// Of those that have left their reaches: near bodies that never did, and are where the structure
// has them; those that once did; and static ones.
template <int D>
void BroadPhase<D>::mend_near() {
  if (near_.left().empty()) return;
  const std::span<const Box<D>> reaches = near_.reaches();
  const std::span<const std::uint32_t> all_left = near_.all_left();
  few_bodies_.clear();
  for (const std::uint32_t place : all_left) few_bodies_.boxes.push_back(reaches[place]);
  few().build(few_bodies_.boxes, Build::at_once);
  const auto each_near = [&](const Structure<D>& structure, const Box<D>& reach, auto&& f) {
    ids_.clear();
    structure.near(reach, ids_);
    for (const BodyId id : ids_) f(id);
  };
  for (const std::uint32_t place : near_.left()) {
    stop_if_asked();
    const Box<D>& reach = reaches[place];
    const auto add = [&](const Box<D>& box, std::uint32_t number) {
      ++counters_.pair_tests;
      if (overlap(reach, box)) near_.add(rank(dynamic_, place), number);
    };
    each_near(*dynamic_.structure, reach, [&](BodyId other) {
      if (!near_.has_left(other)) add(reaches[other], rank(dynamic_, other));
    });
    each_near(*few_, reach, [&](BodyId at) {
      if (const std::uint32_t other = all_left[at]; other != place)
        add(reaches[other], rank(dynamic_, other));
    });
    each_near(*static_.structure, reach,
              [&](BodyId other) { add(static_.boxes[other], rank(static_, other)); });
  }
  near_.put_in_order();
}

// Those near each other whose boxes overlap; without a guess which they are.
template <int D>
void BroadPhase<D>::pair_near() {
  const std::vector<Pair>& near = near_.near();
  const std::span<const BodyId> names = names_by_rank();
  const bool all_stir = dynamic_.states.empty(), all_move = spots_.empty();
  const auto spot_of = [&](BodyId rank) { return all_move ? Spot{false, rank} : spots_[rank]; };
  const auto store_of = [&](Spot spot) -> const Store& {
    return spot.is_static ? static_ : dynamic_;
  };
  const auto stirs = [&](Spot spot) { return store_of(spot).state(spot.place).stirs(); };
  pairs_.resize(near.size());
  Pair* next = pairs_.data();
  for (const auto [a, b] : near) {
    const Spot one = spot_of(a), two = spot_of(b);
    *next = {id_at(names, a), id_at(names, b)};
    next += overlap(store_of(one).boxes[one.place], store_of(two).boxes[two.place]) &
            (all_stir || stirs(one) || stirs(two));
  }
  pairs_.resize(static_cast<std::size_t>(next - pairs_.data()));
  counters_.pair_tests += near.size();
}

// Before the lists of pairs grow, or pass their limit: places in them, and what it takes to put
// them in order.
template <int D>
void BroadPhase<D>::require_room(BodyId number, std::size_t pairs) const {
  const BodyId body = id_at(found_names_, number);
  require_memory(pairs * (3 * sizeof(BodyId) + sizeof(Pair)),
                 fmt::format("body {}: with it {} or more pairs of boxes that overlap", body,
                             search_->found.size()),
                 "take fewer bodies, or part them");
  if (search_->found.size() > config_.most_pairs) refuse_more(number);
}

template <int D>
void BroadPhase<D>::refuse_more(BodyId number) const {
  throw Refused("body {}: with it more than {} pairs overlap; take fewer bodies, or part them",
                id_at(found_names_, number), config_.most_pairs);
}

}  // namespace lantern::spatial
