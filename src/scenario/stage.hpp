// The pieces that a scenario needs, and none that it does not.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "scenario/atlas_stage.hpp"
#include "scenario/engine.hpp"
#include "scenario/level_stage.hpp"

namespace lantern {

struct Stage {
  Stage(const Scenario& scenario, Work& work) {
    if (!scenario.bodies.empty()) engine = make_engine(scenario, work);
    if (scenario.atlas) atlas.emplace(scenario, work);
    if (scenario.level) level.emplace(scenario);
  }

  std::unique_ptr<Engine> engine;  // if there are bodies
  std::optional<AtlasStage> atlas;
  std::optional<LevelStage> level;
  double time = 0;  // seconds of world time
};

}  // namespace lantern
