// The panels of a frame, and the page's foot. Each fills its box and nothing outside of it.
#pragma once

#include <string>

#include "draw/labels.hpp"
#include "draw/staging.hpp"
#include "scenario/frame.hpp"

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
// The diagram alone, of a frame whose nodes are one tree.
struct TreeStage;
void draw_one_tree(const Frame& frame, const UnionTree& tree, const TreeStage& stage,
                   DrawList& list, Labels& labels);

// The packed image, and beside it the textures that wait or were refused. It wants this width at a
// height.
void draw_atlas(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
double atlas_width(const Frame& frame, double height);

// One count against another as lines, or counts as bars. Lines carry marks of different shapes and
// their names at their ends; the newest point of each is larger and says its number. Bars lie
// level in groups, their names before and their numbers behind them. Points that
// are not finite are left out; what there is no room for is said.
void draw_chart(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);

// A count's or measure's name as words: "pair tests" of "pair_tests", "energy: bob" of
// "energy.bob".
std::string chart_words(std::string name);

// The one array that all leaves share: a strip of slots that wraps into rows. A leaf's slots are
// bracketed and named; those in use show their bodies, those kept free are empty; slots of no leaf
// are quiet. Of an array too long for the panel as many slots are drawn as have room, and the
// heading says so. It wants this height at a width.
void draw_memory(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
double memory_height(const Frame& frame, double width);

// The caption, and the counters at its right; gives the y of the hairline above them.
double draw_footer(const Frame& frame, double margin, DrawList& list, Labels& labels);

}  // namespace lantern::draw
