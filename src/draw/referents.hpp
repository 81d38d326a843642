// What a caption tells and a page shows.
#pragma once

#include <string>
#include <vector>

#include "draw/draw_list.hpp"
#include "frame/frame.hpp"

namespace lantern::draw {

// The counts and measures that the frame's caption quotes and nothing on its page depicts.
inline std::vector<std::string> unshown_numbers(const Frame& frame, const DrawList& list) {
  std::vector<std::string> unshown;
  for (const std::string& name : frame.told)
    if (!list.referents.contains(name)) unshown.push_back(name);
  return unshown;
}

}  // namespace lantern::draw
