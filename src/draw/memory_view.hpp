// The memory panel: the one array that all leaves share.
#pragma once

#include "draw/labels.hpp"
#include "scenario/frame.hpp"

namespace lantern {

// A strip of slots that wraps into rows. A leaf's slots are bracketed and named; those in use show
// their bodies, those kept free are empty; slots of no leaf are quiet. Of an array too long for the
// panel as many slots are drawn as have room, and the heading says so.
void draw_memory(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);

// Height that the panel would take at this width if it could choose.
double memory_height(const Frame& frame, double width);

}  // namespace lantern
