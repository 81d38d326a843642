// The islands of a world: what hangs together, and by what.
#pragma once

#include <cstdint>
#include <map>

#include "frame/frame.hpp"
#include "run/players.hpp"

namespace lantern::run {

// By the lowest id in an island; the next new one gets the next number. Numbers are never used
// again, so that an island that has parted has its own back.
using IslandNumbers = std::map<BodyId, std::uint32_t>;

// Adds islands and edges as the world's last step found them, with what has left or let go since.
template <int D>
void picture_islands(const Players<D>& players, IslandNumbers& numbers, Frame& frame);

// Adds the counts of its islands.
void count_islands(Frame& frame);

extern template void picture_islands(const Players<2>&, IslandNumbers&, Frame&);
extern template void picture_islands(const Players<3>&, IslandNumbers&, Frame&);

}  // namespace lantern::run
