// Where a step's rulers begin and end.
#pragma once

#include <optional>
#include <utility>

#include "run/engine.hpp"

namespace lantern::run {

// In the world; nothing while a body that it is laid to is not there. `engine` may be null if there
// are no bodies.
std::optional<std::pair<Vec<3>, Vec<3>>> ends_of(const RulerSpec& ruler, const Engine* engine);

}  // namespace lantern::run
