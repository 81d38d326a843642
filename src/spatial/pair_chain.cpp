// The chain of pairs: what an update would find in the structures as they stand.
#include <algorithm>

#include "base/stop.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/pairs.hpp"

namespace lantern::spatial {
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

template PairChain BroadPhase<2>::pair_chain(const std::function<bool(BodyId)>&,
                                             std::uint64_t) const;
template PairChain BroadPhase<3>::pair_chain(const std::function<bool(BodyId)>&,
                                             std::uint64_t) const;

}  // namespace lantern::spatial
