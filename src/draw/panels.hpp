// What panels share, and the page's foot. Each fills its box and nothing outside of it.
#pragma once

#include <string>

#include "draw/labels.hpp"
#include "draw/staging.hpp"
#include "frame/frame.hpp"

namespace lantern::draw {

// Node cells, bodies as characters, candidate pairs and marks. A 2D world as large as
// frame.bounds fit into the panel, y upwards; a 3D one as frame.camera sees it, with its floor.
void draw_world(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
                Labels& labels);

// The structure or atlas as a node-link diagram, and under it what it was told and what it counts.
// All nodes that the group's frames have stand in one layout; where that is too large for the panel
// a frame's tree is condensed (tree_fold.hpp); a node is never narrower than kLeastNode. Two trees,
// of what never moves and of what does, stand side by side or one above the other; sort and sweep
// has no tree and shows its intervals.
void draw_tree(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
               Labels& labels);
inline constexpr double kLeastNode = 34;
// The intervals of sort and sweep along the axis that it sorted by, one row a body in the order of
// the sweep. A pair that it compares is linked where the later interval begins; where one body is
// lit, the sweep stands at its beginning, and the intervals that are open there are marked.
void draw_sweep(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
// The array of a grid's cells, of each level one, or the buckets that a spatial hash puts its cells
// into: in rows as the grid is wide, each with the bodies that reach it. Where several cells share
// a bucket, they are parted by lines.
void draw_grid(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
// The diagram alone, of a frame whose nodes are one tree.
struct TreeStage;
void draw_one_tree(const Frame& frame, const UnionTree& tree, const TreeStage& stage,
                   DrawList& list, Labels& labels);

// Width over height of a world's picture, and the width that it takes at a height.
double world_aspect(const Frame& frame);
double world_width(const Frame& frame, double height);

// A count's or measure's name as words: "pair tests" of "pair_tests", "energy: bob" of
// "energy.bob".
std::string chart_words(std::string name);

// The same two of a tree that asks for each piece of memory by itself: a block for each entry of a
// leaf's list and one for each four children.
void draw_list_pieces(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
void draw_node_pieces(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
inline bool is_in_pieces(const Frame& frame) {
  return frame.structure != StructureKind::none && traits_of(frame.structure).is_plain;
}

// The caption, and the counters at its right; gives the y of the hairline above them.
double draw_footer(const Frame& frame, double margin, DrawList& list, Labels& labels);

}  // namespace lantern::draw
