// Boxes of a user's own for `bench pairs`.
#pragma once

#include <cstdint>
#include <filesystem>

#include "measure/box_scenes.hpp"

namespace lantern::measure {

// A file that ends in .aabbs is one of Broadmark (Serpa and Rodrigues, Computer Graphics Forum
// 2020): little-endian; 128 bytes of the scene's name, 128 of the objects' type, four 32-bit
// numbers (objects, frames, 0, 0), the world's box, and for each frame each object's box; of a box
// four floats of its least and four of its greatest point, the fourth 0. Its frames are kept as far
// as `frames_for` allows.
//
// Any other file is CSV: a box a line. Columns are named by a first line, in any order:
// lo_x, lo_y, hi_x, hi_y or x, y, half_x, half_y, in space lo_z, hi_z or z, half_z, too; and
// static, 0 or 1. Without such a line there are 4 or 6 numbers: the lower corner, the upper one.
// Empty lines and those that begin with # are passed over. The boxes lie still in it: so they are
// moved, each by up to a tenth of its half sizes an axis and step, seeded.
//
// Throws ScenarioError with file, line and column, IoError for what cannot be read, Refused for
// fewer than two boxes.
BoxScene read_boxes(const std::filesystem::path& file, std::uint64_t seed);

}  // namespace lantern::measure
