// Which pairs of boxes a broad phase meets in its structures.
#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/stop.hpp"
#include "spatial/broad_phase.hpp"

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
  if (std::any_of(dynamic_.bodies.begin(), dynamic_.bodies.end(), stirs)) {
    if (!dynamic_.stands) build(dynamic_);
    for (Store* store : stores()) sort(store->structure);
    found_.clear();
    pair_dynamic();
    pair_static();
    sort_pairs();
  } else if (!dynamic_.stands) {
    empty(dynamic_);
  }
  found_all_ = true;
}

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
  awake_.find(
      tree, [&](BodyId i) { return stirs(dynamic_.bodies[i]); }, ids_);
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

// Before the list of pairs grows, or passes its limit: twice as many places, each copied once, and
// what `sort_pairs` will need.
template <int D>
void BroadPhase<D>::require_room(BodyId body) const {
  const std::uint64_t pairs = 2 * std::max<std::uint64_t>(found_.size(), 512);
  require_memory(
      pairs * (3 * sizeof(RankPair) / 2 + sizeof(std::uint32_t) + sizeof(Pair)),
      fmt::format("body {}: with it {} or more pairs of boxes that overlap", body, found_.size()),
      "take fewer bodies, or part them");
  if (found_.size() == config_.most_pairs)
    throw Refused(
        fmt::format("body {}: with it more than {} pairs overlap; take fewer bodies, or part them",
                    body, config_.most_pairs));
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

template void BroadPhase<2>::find_pairs();
template void BroadPhase<3>::find_pairs();

}  // namespace lantern::spatial
