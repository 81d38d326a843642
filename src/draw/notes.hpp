// A few words beside what they are about, each with a thin line to it.
#pragma once

#include "draw/labels.hpp"
#include "frame/frame.hpp"

namespace lantern::draw {

// Under which name a panel tells where it has drawn what a note may be about.
std::string target_of(const FrameBody& body);
std::string target_of_node(const std::string& label);
std::string target_of_cell(const std::string& label);  // where no tree shows the node
std::string target_of_count(const std::string& name);
std::string target_of_note(std::size_t index);  // of a note on a point

// All notes of the frame, whose panels must be drawn, into the free room of `area`: as near as may
// be, over no label and, as far as there is room, over no body. One whose target no panel has drawn
// has no line, and stands at the upper edge.
void draw_notes(const Frame& frame, const Box<2>& area, DrawList& list, Labels& labels);

}  // namespace lantern::draw
