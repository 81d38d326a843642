// A scenario as other engines are told it.
#pragma once

#include <optional>
#include <string>

#include "measure/peer.hpp"

namespace lantern {

// What no peer can do, whatever it is: bodies that are steered, levels, scripts that change the
// scene on its way. Nothing if there is none of it.
std::optional<std::string> only_lantern_can(const Scenario& scenario);

// All bodies as the first frame has them.
PeerScene peer_scene(const Scenario& scenario);

}  // namespace lantern
