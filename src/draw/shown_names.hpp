// Whose names stand beside bodies.
#pragma once

#include "scenario/frame.hpp"

namespace lantern::draw {

// As the frame's display has it. Of a story with more than 8 named bodies only those are named that
// are lit, or whose name occurs as a word in the caption.
bool shows_name(const Frame& frame, const FrameBody& body);

}  // namespace lantern::draw
