// Who carries a name on a frame, and on which side of it the name stands.
#pragma once

#include <array>
#include <map>
#include <string>

#include "draw/labels.hpp"
#include "draw/projection.hpp"
#include "draw/staging.hpp"

namespace lantern::draw {

// Is the body's name written beside it? As the frame's display has it; of a story: among few bodies
// all have theirs; among many those that the frame is about: lit ones, and those that the caption
// names.
bool shows_name(const Frame& frame, const FrameBody& body);

// Is the node's name written in its cell? In a small tree all leaves have theirs, in others those
// that the step is about or passes.
bool shows_id(const Staging& staging, const FrameNode& node);

// Sides of bodies' boxes, as places among those of anchors_around(), by the bodies' names. Each
// body keeps one over the group: the first that is free of bodies on most of its frames.
using NameSides = std::map<std::string, std::size_t, std::less<>>;
const NameSides& name_sides(const Staging& staging, const Box<2>& panel);

// The anchors with the body's own first.
std::array<Anchor, 8> on_its_side(std::array<Anchor, 8> anchors, const NameSides& sides,
                                  std::string_view name);

inline constexpr double kNameGap = 7;  // between a body's box and its name

// What is written at a leaf, the best first; nothing for an unlit one of a BSP more than one step
// down: its way is longer than anyone reads. Lit, it says on which side of its last plane it lies,
// "net: back".
std::vector<std::string> leaf_names(const Frame& frame, const FrameNode& leaf);

}  // namespace lantern::draw
