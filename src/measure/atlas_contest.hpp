// Who packs textures in `bench atlas`, and what makes a layout right.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "measure/atlas_bench.hpp"

namespace lantern::measure {

// Ours: the taught rule with the tallest texture first; leaves that choose; the same with textures
// turned. `partly`: what has no place is left out; otherwise packing ends as soon as it is known
// that not all have one.
std::vector<AtlasPeer> own_atlas_packers(bool partly);

// Those that `config` asks for, ours first; a line in `missing` for each module that is not there.
// Throws Refused for names that are none.
std::vector<AtlasPeer> atlas_contestants(const AtlasBenchConfig& config,
                                         std::vector<std::string>& missing);

// Counts overlaps, textures that lie outside, and sizes that are not theirs, and fills in what else
// is known of a layout.
void check_layout(std::span<const TextureSize> sizes,
                  std::span<const std::optional<TexturePlace>> places, AtlasRow& row);

}  // namespace lantern::measure
