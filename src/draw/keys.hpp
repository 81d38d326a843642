// The names under which shapes say what they show (DrawList::Scope). The same thing has the same
// key on every frame, whatever its place in a list is.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frame/parts/atlas.hpp"

namespace lantern::draw {

// The steps from the root down to a node, parted by dots: "root.0.3"; of the tree of what never
// moves "static.1". Cut at its last dot it is the parent's.
std::string way_of(const std::vector<FrameNode>& nodes, std::uint32_t node);

// "world/cell/root.0.3" of the kind "world/cell".
std::string node_key(std::string_view kind, const std::vector<FrameNode>& nodes,
                     std::uint32_t node);
std::string node_key(std::string_view kind, const std::vector<FrameNode>& nodes,
                     const FrameNode& node);

// The same of the node's parent; empty for a root.
std::string parent_key(std::string_view kind, const std::vector<FrameNode>& nodes,
                       const FrameNode& node);

// "world/body/blue" of the kind "world/body"; what has no name goes by its number.
std::string body_key(std::string_view kind, const FrameBody& body);
std::string texture_key(std::string_view kind, const FrameTexture& texture);
// "world/pair/blue/red"
std::string pair_key(std::string_view kind, const FrameBody& a, const FrameBody& b);

}  // namespace lantern::draw
