// Where the nodes of a tree stand beside each other, so that the drawing is tidy: a parent stands
// midway over its first and last child, children keep their order, nodes of one depth do not touch,
// edges do not cross, and equal subtrees are drawn alike.
//
// Reingold and Tilford, "Tidier Drawings of Trees" (1981), in the linear-time form of Buchheim,
// Juenger and Leipert, "Improving Walker's Algorithm to Run in Linear Time" (2002), here for nodes
// of different widths.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lantern::draw {

struct TidyNode {
  std::uint32_t parent = 0xffffffff;  // the first node is the root and has none
  double width = 0;
};

// The centres' x, the leftmost edge at 0. Parents stand before children in `nodes`, children from
// left to right. `gap` is what stays free between two neighbours.
std::vector<double> tidy_tree(std::span<const TidyNode> nodes, double gap);

}  // namespace lantern::draw
