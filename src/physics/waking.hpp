// Waking, in one place: what hangs together by contacts, springs and joints wakes together.
#pragma once

#include <span>
#include <vector>

#include "physics/body.hpp"

namespace lantern {

enum class Disturbed {
  all,       // those awake, too, must now rest anew before they may sleep
  sleepers,  // those awake are left as they are, and pass nothing on
};

// Wakes the bodies at `places` and, from one to the next, all dynamic ones linked to them. `rested`
// seconds of what wakes begin anew. Static and kinematic bodies pass nothing on unless they are
// named. Bodies are in order of ids; links name two of them each.
template <int D>
void wake_together(std::vector<Body<D>>& bodies, std::vector<double>& rested,
                   std::vector<std::uint32_t> places, std::span<const Pair> links,
                   Disturbed disturbed);

}  // namespace lantern
