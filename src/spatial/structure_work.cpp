#include "spatial/structure_work.hpp"

#include <algorithm>
#include <unordered_map>

namespace lantern::spatial {
namespace {

template <int D>
std::uint64_t dynamic_tests(const BroadPhase<D>& broad) {
  return broad.dynamic().counters().box_tests;
}

// Are those that move where they were?
template <int D>
bool same_movers(std::span<const Proxy<D>> before, std::span<const Proxy<D>> after) {
  return std::ranges::equal(before, after, [](const Proxy<D>& a, const Proxy<D>& b) {
    return a.is_static || (a.box.lo == b.box.lo && a.box.hi == b.box.hi);
  });
}

}  // namespace

bool counts_its_work(StructureKind kind) {
  return std::ranges::count(kStructureKinds, kind) > 0 && !traits_of(kind).is_plain;
}

template <int D>
StructureWork structure_work(BroadPhaseConfig<D> config, std::span<const Proxy<D>> before,
                             std::span<const Proxy<D>> after, std::uint64_t most) {
  config.split_static = true;
  BroadPhase<D> broad(config);
  StructureWork work;
  broad.build(before);
  const std::uint64_t at_first = dynamic_tests(broad);
  const std::uint64_t builds = broad.counters().dynamic_builds;
  work.build = at_first + broad.fixed().counters().box_tests;
  broad.build(after);
  // What is built anew begins to count anew, as does a tree that follows its bodies; what stands
  // goes on.
  const bool follows = traits_of(config.kind).follows && !same_movers(before, after);
  const bool anew = follows || broad.counters().dynamic_builds > builds;
  work.renew = dynamic_tests(broad) - (anew ? 0 : at_first);

  std::unordered_map<BodyId, bool> stirs;
  for (const Proxy<D>& proxy : after) stirs[proxy.id] = proxy.awake && !proxy.is_static;
  const PairChain chain = broad.pair_chain([&](BodyId id) { return stirs.at(id); }, most);
  work.pair = chain.met + chain.besides;
  work.pairs = chain.pairs.size();
  work.overlaps = chain.overlapping.size();
  return work;
}

template StructureWork structure_work(BroadPhaseConfig<2>, std::span<const Proxy<2>>,
                                      std::span<const Proxy<2>>, std::uint64_t);
template StructureWork structure_work(BroadPhaseConfig<3>, std::span<const Proxy<3>>,
                                      std::span<const Proxy<3>>, std::uint64_t);

}  // namespace lantern::spatial
