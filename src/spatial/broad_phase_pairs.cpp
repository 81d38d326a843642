// Which pairs of boxes a broad phase meets in its structures.
#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/stop.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/pairs.hpp"

namespace lantern::spatial {
namespace {

// One that must be sorted before it is asked, and into which was inserted since.
template <class Structure>
void sort(Structure& structure) {
  const auto sort = [](auto& s) {
    if constexpr (requires { s.sort(); }) s.sort();
  };
  std::visit(sort, structure);
}

}  // namespace

template <int D>
void BroadPhase<D>::find_pairs() {
  counters_.pair_tests = counters_.nodes_visited = 0;
  counters_.nodes_skipped_asleep = counters_.nodes_reused = 0;
  pairs_.clear();
  stirring_ = static_cast<std::size_t>(
      std::count_if(dynamic_.states.begin(), dynamic_.states.end(), std::mem_fn(&State::stirs)));
  if (stirring_ > 0) {
    if (!dynamic_.stands) build(dynamic_);
    for (Store* store : stores()) sort(store->structure);
    found_.clear();
    found_.set_threads(config_.threads);
    found_names_ = dynamic_.names;
    found_.ask_before_growing(
        [this](BodyId body, std::size_t pairs) { require_room(body, pairs); });
    pair_dynamic();
    dynamic_.tests = static_cast<double>(counters_.pair_tests) / static_cast<double>(stirring_);
    if (dynamic_.chosen_tests == 0) dynamic_.chosen_tests = dynamic_.tests;
    pair_static();
    if (found_.size() > config_.most_pairs) refuse_more(found_.first()[config_.most_pairs]);
    order_.order(found_, found_names_, pairs_);
  } else if (!dynamic_.stands) {
    empty(dynamic_);
  }
  found_all_ = true;
}

template <int D>
void BroadPhase<D>::pair_dynamic() {
  std::visit(
      [&](auto& structure) {
        if constexpr (requires { structure.pair(std::span<const Item<D>>(), found_); })
          pair_itself(structure);
        else
          pair_leaves(structure);
        counters_.nodes_reused = work_of(structure).nodes_reused;
      },
      dynamic_.structure);
}

// A structure in which bodies need not share a leaf to meet. Where most of them sleep, each of the
// others asks alone.
template <int D>
template <class Tree>
void BroadPhase<D>::pair_itself(Tree& tree) {
  counters_.nodes_visited = work_of(tree).nodes;
  constexpr std::size_t kFew = 8;
  if (stirring_ == dynamic_.items.size() || kFew * stirring_ > dynamic_.items.size()) {
    counters_.pair_tests += tree.pair(std::span<const Item<D>>(dynamic_.items), found_);
    drop_still_pairs();
  } else {
    for (std::uint32_t i = 0; i < dynamic_.items.size(); ++i)
      if (dynamic_.states[i].stirs()) ask(tree, i);
  }
}

template <int D>
template <class Tree>
void BroadPhase<D>::ask(const Tree& tree, std::uint32_t place) {
  stop_if_asked();
  const Box<D>& box = dynamic_.items[place].box;
  ids_.clear();
  tree.near(box, ids_);
  for (const BodyId other : ids_) {
    if (other == place || (other < place && dynamic_.states[other].stirs())) continue;
    ++counters_.pair_tests;
    if (overlap(box, dynamic_.items[other].box)) found_.add(place, other);
  }
}

template <int D>
template <class Tree>
void BroadPhase<D>::pair_leaves(const Tree& tree) {
  awake_.find(
      tree, [&](BodyId i) { return dynamic_.states[i].stirs(); }, ids_);
  tree.visit(
      [&](const NodeView<D>& node) {
        if (!awake_[node.handle]) {
          ++counters_.nodes_skipped_asleep;
          return false;
        }
        ++counters_.nodes_visited;
        pair_bodies(node.bodies);
        return true;
      },
      ids_);
}

// Each that stirs with all behind it; those that do not stand last.
template <int D>
void BroadPhase<D>::pair_bodies(std::span<const BodyId> bodies) {
  std::size_t stirring = bodies.size();
  if (stirring_ < dynamic_.items.size()) {
    const auto stirs = [&](BodyId i) { return dynamic_.states[i].stirs(); };
    bodies_.assign(bodies.begin(), bodies.end());
    stirring -= std::ranges::partition(bodies_, stirs).size();
    bodies = bodies_;
  }
  counters_.pair_tests += all_pairs(bodies.size()) - all_pairs(bodies.size() - stirring);
  constexpr std::size_t kFew = 8;  // up to here it costs more to arrange them than to compare them
  if (bodies.size() <= kFew) {
    for (std::size_t i = 0; i < stirring; ++i)
      for (std::size_t j = i + 1; j < bodies.size(); ++j)
        if (overlap(dynamic_.items[bodies[i]].box, dynamic_.items[bodies[j]].box))
          found_.add(bodies[i], bodies[j]);
    return;
  }
  leaf_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    leaf_.set(i, bodies[i], dynamic_.items[bodies[i]].box);
  RunScanner<D> runs(leaf_, leaf_, dynamic_.items, found_);
  const auto end = static_cast<std::uint32_t>(bodies.size());
  for (std::uint32_t i = 0; i < stirring; ++i) runs.add(i, i + 1, end);
  runs.finish();
}

template <int D>
void BroadPhase<D>::drop_still_pairs() {
  if (stirring_ == dynamic_.items.size()) return;
  const std::span<BodyId> first = found_.first(), second = found_.second();
  std::size_t size = 0;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (!dynamic_.states[first[i]].stirs() && !dynamic_.states[second[i]].stirs()) continue;
    first[size] = first[i];
    second[size++] = second[i];
  }
  found_.resize(size);
}

// Each awake body asks the static structure.
template <int D>
void BroadPhase<D>::pair_static() {
  if (static_.items.empty()) return;
  name_by_rank();
  std::visit(
      [&](const auto& structure) {
        for (std::size_t i = 0; i < dynamic_.items.size(); ++i) {
          stop_if_asked();
          if (!dynamic_.states[i].stirs()) continue;
          const Box<D>& box = dynamic_.items[i].box;
          ids_.clear();
          structure.near(box, ids_);
          counters_.pair_tests += ids_.size();
          for (const BodyId j : ids_)
            if (overlap(box, static_.items[j].box)) found_.add(dynamic_.ranks[i], static_.ranks[j]);
        }
      },
      static_.structure);
}

// What was found among dynamic bodies is named by their ranks among all from now on.
template <int D>
void BroadPhase<D>::name_by_rank() {
  for (BodyId& place : found_.first()) place = dynamic_.ranks[place];
  for (BodyId& place : found_.second()) place = dynamic_.ranks[place];
  found_names_ = all_names_;
}

// Before the lists of pairs grow, or pass their limit: places in them, and what it takes to put
// them in order.
template <int D>
void BroadPhase<D>::require_room(BodyId number, std::size_t pairs) const {
  const BodyId body = found_names_[number];
  require_memory(
      pairs * (3 * sizeof(BodyId) + sizeof(Pair)),
      fmt::format("body {}: with it {} or more pairs of boxes that overlap", body, found_.size()),
      "take fewer bodies, or part them");
  if (found_.size() > config_.most_pairs) refuse_more(number);
}

template <int D>
void BroadPhase<D>::refuse_more(BodyId number) const {
  throw Refused(
      fmt::format("body {}: with it more than {} pairs overlap; take fewer bodies, or part them",
                  found_names_[number], config_.most_pairs));
}

#define LANTERN_PAIRING(D)                                              \
  template void BroadPhase<D>::find_pairs();                            \
  template void BroadPhase<D>::pair_dynamic();                          \
  template void BroadPhase<D>::pair_static();                           \
  template void BroadPhase<D>::pair_bodies(std::span<const BodyId>);    \
  template void BroadPhase<D>::drop_still_pairs();                      \
  template void BroadPhase<D>::name_by_rank();                          \
  template void BroadPhase<D>::require_room(BodyId, std::size_t) const; \
  template void BroadPhase<D>::refuse_more(BodyId) const;
LANTERN_PAIRING(2)
LANTERN_PAIRING(3)
#undef LANTERN_PAIRING

}  // namespace lantern::spatial
