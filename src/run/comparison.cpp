#include "run/comparison.hpp"

#include <algorithm>

#include "run/players.hpp"
#include "run/structure_picture.hpp"
#include "spatial/pairs.hpp"

namespace lantern::run {
namespace {

template <int D>
std::vector<Proxy<D>> proxies_of(const World<D>& world) {
  std::vector<Proxy<D>> proxies;
  for (const Body<D>& body : world.bodies())
    if (body.collides) proxies.push_back({body.id, body.box(), !body.moves(), body.stirs()});
  return proxies;
}

}  // namespace

template <int D>
FrameComparison::Row compare_kinds(const Scenario& scenario, const StructureSpec& settings,
                                   const std::vector<std::size_t>& bodies,
                                   const std::vector<StructureKind>& kinds) {
  Players<D> players(scenario);
  for (const std::size_t body : bodies) players.enter(body);
  const std::vector<Proxy<D>> before = proxies_of(players.world());
  FrameComparison::Row row;
  row.bodies = before.size();
  std::uint64_t never_move = 0;
  for (const Proxy<D>& proxy : before) {
    const auto index = players.index_of(proxy.id);
    row.marks.push_back(
        {solid(proxy.box), index ? scenario.bodies[*index].color : 1, proxy.is_static});
    never_move += proxy.is_static;
  }
  row.testable = testable_pairs(row.bodies, never_move);
  players.world().step(scenario.world.time_step);
  const std::vector<Proxy<D>> after = proxies_of(players.world());
  for (const StructureKind kind : kinds) {
    StructureSpec spec = settings;
    spec.kind = kind;
    const BroadPhaseConfig<D> config =
        broad_phase_of<D>(spec, in_dimension<D>(scenario.world.bounds));
    row.cells.push_back({kind, structure_work<D>(config, before, after, kMostPairs)});
  }
  return row;
}

FrameComparison empty_comparison(const Scenario& scenario) {
  FrameComparison comparison;
  const auto some_has = [&](StructureKind kind) {
    return std::ranges::any_of(scenario.steps, [&](const Step& step) {
      const auto* compare = std::get_if<Compare>(&step.verb);
      return compare && std::ranges::count(compare->kinds, kind) > 0;
    });
  };
  for (const StructureKind kind : kStructureKinds)
    if (some_has(kind)) comparison.kinds.push_back(kind);
  for (const Step& step : scenario.steps)
    if (const auto* compare = std::get_if<Compare>(&step.verb))
      comparison.all_names.push_back(compare->row);
  return comparison;
}

template FrameComparison::Row compare_kinds<2>(const Scenario&, const StructureSpec&,
                                               const std::vector<std::size_t>&,
                                               const std::vector<StructureKind>&);
template FrameComparison::Row compare_kinds<3>(const Scenario&, const StructureSpec&,
                                               const std::vector<std::size_t>&,
                                               const std::vector<StructureKind>&);

}  // namespace lantern::run
