// Which nodes are awake (the lecture, "Sleeping Objects"): those below which an awake body lies.
#pragma once

#include <vector>

#include "spatial/structure.hpp"

namespace lantern {

// A flag for each node of a structure, in the order of visiting. `awake(id) -> bool`. Children are
// visited after their parents, so one way back through the list wakes all that lie above.
template <class Structure, class Awake>
std::vector<bool> awake_nodes(const Structure& structure, Awake&& awake) {
  std::vector<bool> flags;
  std::vector<std::uint32_t> parents;
  structure.visit([&](const auto& node) {
    bool any = false;
    for (const BodyId id : node.bodies) any = any || awake(id);
    flags.push_back(any);
    parents.push_back(node.parent);
    return true;
  });
  for (std::size_t i = flags.size(); i-- > 1;)
    if (flags[i]) flags[parents[i]] = true;
  return flags;
}

}  // namespace lantern
