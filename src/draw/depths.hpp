// How deep bodies overlap, written beside their contacts, in flat and in solid worlds.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "draw/labels.hpp"
#include "scenario/frame.hpp"

namespace lantern {

// "12 mm", "0.34 mm", "1.5 m": two figures, and a unit that keeps them readable. "0" below a
// nanometre. A unit of the world is taken for a metre.
std::string depth_text(double depth);

// The deepest point of each contact, beside all of the contact's points: free of labels and, as far
// as there is room, of `bodies`, their boxes on the page. The deepest contacts come first; what has
// no room is left out. `to_page` gives nothing for a point that cannot be seen.
using ToPage = std::function<std::optional<Vec<2>>(const Vec<3>&)>;
void write_depths(const Frame& frame, const ToPage& to_page, const std::vector<Box<2>>& bodies,
                  const Box<2>& panel, Labels& labels);

}  // namespace lantern
