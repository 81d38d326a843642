// The tree panel: the nodes of the structure or atlas as a node-link diagram.
#pragma once

#include "draw/labels.hpp"
#include "scenario/frame.hpp"

namespace lantern {

// The diagram in the panel, and under it what the tree was told and what it counts. A tree too
// large for the panel is condensed (tree_fold.hpp); a node is never narrower than kLeastNode. Two
// trees, of what never moves and of what does, stand side by side or one above the other.
void draw_tree(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);

// The diagram alone, of a frame whose nodes are one tree.
void draw_one_tree(const Frame& frame, const Box<2>& diagram, DrawList& list, Labels& labels);

inline constexpr double kLeastNode = 34;

}  // namespace lantern
