// Scenes of boxes for the broad phase to find the pairs of: seeded ones of the sorts that tell
// structures apart, and those of a scenario.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "scenario/scenario.hpp"
#include "spatial/broad_phase.hpp"

namespace lantern::measure {

// The boxes' ids are their places in the list, from 0. All updates have equally many.
template <int D>
struct BoxUpdates {
  Box<D> bounds;                              // of trees' roots
  std::vector<std::vector<Proxy<D>>> frames;  // one after another; more than one if they move
};

struct BoxScene {
  std::string name;   // "clustered_2d": names files
  std::string words;  // "2 000 clustered boxes": begins a sentence about it
  std::variant<BoxUpdates<2>, BoxUpdates<3>> boxes;

  int dimension() const { return boxes.index() == 0 ? 2 : 3; }
};

// In two dimensions and in three: evenly spread, in clusters, one huge box among small ones, all in
// a line, and evenly spread ones that move. Seeded: the same boxes on every machine.
std::vector<BoxScene> seeded_box_scenes(std::size_t bodies, std::uint64_t seed);

// What of a scenario's bodies has entered before its first run, wait or step; where its script
// begins with those, the bodies after the first frame that shows any. Throws Refused, naming the
// scenario, if fewer than two bodies enter; ScenarioError as its script does.
BoxScene box_scene_of(const Scenario& scenario);

}  // namespace lantern::measure
