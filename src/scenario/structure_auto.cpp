#include "scenario/structure_auto.hpp"

#include <algorithm>
#include <vector>

#include "geometry/shape.hpp"
#include "scenario/specs.hpp"
#include "spatial/structure_choice.hpp"

namespace lantern::scenario {
namespace {

template <int D>
Box<D> in_world(const Box<3>& box) {
  Box<D> flat;
  for (int i = 0; i < D; ++i) {
    flat.lo[i] = box.lo[i];
    flat.hi[i] = box.hi[i];
  }
  return flat;
}

template <int D>
void choose(const ScenarioSpec& scenario, StructureSpec& structure) {
  std::vector<Item<D>> items;
  for (const BodySpec& body : scenario.bodies) {
    const Box<D> box = in_world<D>(bounding_box(body.shape, body.position, orientation_of(body)));
    if (is_valid(box)) items.push_back({static_cast<BodyId>(items.size()), box});
  }
  const StructureChoice<D> choice = choose_structure<D>(items, StructureConfig<D>());
  structure.kind = choice.kind;
  structure.cell = choice.config.cell;
  structure.levels = choice.config.levels;
  structure.open = choice.config.open;
  structure.why = choice.why;
}

}  // namespace

void choose_structures(Draft& draft) {
  ScenarioSpec& scenario = draft.scenario;
  const auto choose_if_asked = [&](StructureSpec& structure) {
    if (structure.kind != StructureKind::automatic) return;
    draft.dimension == 3 ? choose<3>(scenario, structure) : choose<2>(scenario, structure);
  };
  choose_if_asked(scenario.structure);
  for (Step& step : scenario.steps)
    if (auto* rebuild = std::get_if<Rebuild>(&step.verb)) choose_if_asked(rebuild->structure);
}

}  // namespace lantern::scenario
