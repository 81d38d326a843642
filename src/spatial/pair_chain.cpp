// The chain of pairs: what an update would find in the structures as they stand.
#include <algorithm>

#include "base/stop.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/pairs.hpp"

namespace lantern::spatial {
namespace {

// f(place, place) for each pair that is met and of which at least one stirs. A structure that
// compares its bodies itself does so in a copy, in the order of its own that it makes for it.
// Returns how many tests it took besides.
template <int D, class Structure, class F>
std::uint64_t each_met(const Structure& structure, const std::vector<bool>& stirring, F&& f) {
  std::uint64_t besides = 0;
  const auto awake = [&](BodyId i) -> bool { return stirring[i]; };
  const auto told = [&](const Item<D>& a, const Item<D>& b) { f(a.id, b.id); };
  if constexpr (requires(Structure s) { s.compare(awake, told, &besides); }) {
    Structure(structure).compare(awake, told, &besides);
  } else {
    structure.visit([&](const NodeView<D>& node) {
      for (std::size_t i = 0; i < node.bodies.size(); ++i) {
        stop_if_asked();
        for (std::size_t j = i + 1; j < node.bodies.size(); ++j)
          if (awake(node.bodies[i]) || awake(node.bodies[j])) f(node.bodies[i], node.bodies[j]);
      }
      return true;
    });
  }
  return besides;
}

}  // namespace

template <int D>
PairChain BroadPhase<D>::pair_chain(const std::function<bool(BodyId)>& awake,
                                    std::uint64_t most) const {
  std::vector<bool> stirring;
  for (std::size_t i = 0; i < dynamic_.items.size(); ++i)
    stirring.push_back(!dynamic_.states[i].is_static && awake(dynamic_.names[i]));
  struct Met {
    Pair pair;
    bool overlaps;
  };
  std::vector<Met> met;
  PairChain chain;
  const auto meet = [&](BodyId i, const Store& store, BodyId j) {
    require_within(++chain.met, most);
    const BodyId a = dynamic_.names[i], b = store.names[j];
    met.push_back(
        {{std::min(a, b), std::max(a, b)}, overlap(dynamic_.items[i].box, store.items[j].box)});
  };
  std::visit(
      [&](const auto& tree) {
        chain.besides +=
            each_met<D>(tree, stirring, [&](BodyId i, BodyId j) { meet(i, dynamic_, j); });
      },
      dynamic_.structure);
  const auto ask = [&](const auto& of_static) {
    for (std::uint32_t i = 0; i < stirring.size() && !static_.items.empty(); ++i) {
      std::vector<BodyId> near;
      if (stirring[i]) chain.besides += of_static.near(dynamic_.items[i].box, near);
      for (const BodyId j : near) meet(i, static_, j);
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
  std::sort(met.begin(), met.end(), [](const Met& x, const Met& y) {
    stop_if_asked();
    return x.pair < y.pair;
  });
  for (const Met& both : met) {
    if (!chain.pairs.empty() && chain.pairs.back() == both.pair) continue;
    chain.pairs.push_back(both.pair);
    if (both.overlaps) chain.overlapping.push_back(both.pair);
  }
  return chain;
}

template PairChain BroadPhase<2>::pair_chain(const std::function<bool(BodyId)>&,
                                             std::uint64_t) const;
template PairChain BroadPhase<3>::pair_chain(const std::function<bool(BodyId)>&,
                                             std::uint64_t) const;

}  // namespace lantern::spatial
