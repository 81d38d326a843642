// Body ids in order: what a structure shows of its leaves, and what it answers to a query.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "spatial/structure.hpp"

namespace lantern {

// The ids in ascending order: as they are if they lie so already, else a sorted copy in `room`.
inline std::span<const BodyId> ascending(std::span<const BodyId> ids, std::vector<BodyId>& room) {
  if (std::is_sorted(ids.begin(), ids.end())) return ids;
  room.assign(ids.begin(), ids.end());
  std::sort(room.begin(), room.end());
  return room;
}

// Calls f(id) for each different id, ascending. A body that lies in many leaves is met in each of
// them; sorting brings its copies together, so no mark has to be left in the tree and many queries
// may run at once.
template <class F>
void each_once(std::vector<BodyId> ids, F&& f) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  for (const BodyId id : ids) f(id);
}

}  // namespace lantern
