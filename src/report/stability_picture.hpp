// The stability map as a picture.
#pragma once

#include "draw/draw_list.hpp"
#include "measure/stability_map.hpp"

namespace lantern {

// A page of 1600 x 900 units: a panel a method, the step from left to right, the damping from below
// (none at all has a row of its own), the measured growth as colour, the limit by theory as a line.
// What grows is hatched, too, so that it can be told without colour. A map that ended early has its
// last panels left empty.
DrawList draw_stability_map(const StabilityMap& map);

}  // namespace lantern
