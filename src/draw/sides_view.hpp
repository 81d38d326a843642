// A frame with sides: what they share once, and each in a place of its own.
#pragma once

#include <functional>

#include "draw/labels.hpp"
#include "draw/staging.hpp"
#include "frame/frame.hpp"

namespace lantern::draw {

// Fills a place with all panels of one side.
using DrawSide = std::function<void(const Frame& side, const Box<2>& place)>;

// The sides beside each other, four of them in two rows, on a tall area one above the other: all as
// large as each other, so that one scale holds for all. Each has its title over it and its
// headline's counts under it, the same ones at the same places; a chart spans all of them. In
// `foot`, where otherwise the caption is, stands what a side does that the others do not. Keys of
// what a side shows begin with its name.
void draw_sides(const Frame& frame, const Staging& staging, const Box<2>& area, const Box<2>& foot,
                DrawList& list, Labels& labels, const DrawSide& draw);

}  // namespace lantern::draw
