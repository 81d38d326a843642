// A plot whose values are no scale but a few outcomes: right, wrong by one, wrong by more.
//
//   off by 1    |  . . . . . . . . . . . .
//   Bullet      |            o---o             open: not in the lowest band
//   exact       |  . . . . . . . . . . . .
//   impulses    |     x---x---x                a lane for each series
//   Bullet      |       *-------------*
//               +-------------------------  seconds
#pragma once

#include "draw/plot.hpp"

namespace lantern {

// Fills the panel with a plot that has bands. Every series has a lane of its own in each band that
// it has points in, so that none hides another; bands without points are left out, but never the
// lowest. The last corner of the plot's front, that of least error, is marked. Lanes are named at
// the left if there is room, unless the plot's names are elsewhere.
void draw_banded_plot(const Plot& plot, const Box<2>& panel, DrawList& list, Labels& labels);

// Whether each lane of such a plot has its name beside it.
bool names_its_lanes(const Plot& plot, const Box<2>& panel);

}  // namespace lantern
