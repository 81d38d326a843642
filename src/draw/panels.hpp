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

// The packed image, and beside it the textures that wait or were refused; of an atlas with a screen
// those are shown one by one until the first is packed. It wants this width at a height.
void draw_atlas(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
double atlas_width(const Frame& frame, double height);

// A screen as far as it is drawn, and below it a row for each way in which it was drawn: the draws
// in order, with a mark before each that another image had to be bound for. It wants this width at
// a height.
void draw_screen(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
double screen_width(const Frame& frame, double height);

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

// The pair ledger: a triangle with a cell for each pair of bodies, marked by how far the pair came
// from all pairs to contacts (scenario/pair_state.hpp), and under it or in its free corner how many
// are in each state; together they are all. Bodies stand on the triangle's edge, in the scenario's
// order. Of many bodies a density takes the place of the cells.
void draw_ledger(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);

// The Minkowski difference of two bodies round its origin, in the world's scale if it has room, and
// what a search for their distance has found of it.
void draw_difference(const Frame& frame, const Staging& staging, const Box<2>& panel,
                     DrawList& list, Labels& labels);

// The axes of frame.find<FrameSeparation>() below each other, on one scale: how far both bodies
// reach along each of them. As many rows as the sequence ever needs.
void draw_axes(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
               Labels& labels);

// Islands as a graph beside the world: a node where each body is that can be moved, an edge for
// what holds two of them together, and one ground, with its number, under all that hang together.
// What never moves is drawn as it is: a dotted line to where it is touched joins nothing.
void draw_islands(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
                  Labels& labels);

// Who sees whom of a level's sectors: a square for each two of them, their numbers on the edges. A
// full square is seen, an empty one is not, a dot is not known yet. The row that is asked for is
// lit.
void draw_matrix(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);

// Strips, which lie under the other panels, as wide as they are together.
// The pool of a tree's nodes: each slot names the node that owns it, a band marks one that was
// another's before; slots that are free again are dashed. It wants this height at a width.
void draw_pool(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
double pool_height(const Frame& frame, double width);

// The same two of a tree that asks for each piece of memory by itself: a block for each entry of a
// leaf's list and one for each four children.
void draw_list_pieces(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
void draw_node_pieces(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
inline bool is_in_pieces(const Frame& frame) {
  return frame.structure != StructureKind::none && traits_of(frame.structure).is_plain;
}

// The bytes of a node whose box is derived and of one that stores it, on one scale.
void draw_bytes(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
double bytes_height();

// One count over the time so far. The ends of its axes are those of the whole part where they are
// known, else powers of two.
void draw_sparkline(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
double sparkline_height();

// What each kind of structure does for each world that was compared (frame.get<FrameComparison>()),
// a row a world with a small picture of it, a column a kind; rows to come are named only. Nothing
// on a panel that is too narrow for it.
void draw_comparison(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);

// A function of the lecture's source, its lines numbered as in their file; those that the frame is
// about are lit. Of a function too long for the panel its head is shown and what is around the lit
// lines. A long line loses the end of its list of arguments, or is broken.
void draw_code(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);

// A strip with a row for each pair whose collision is remembered: at each world step as many pips
// as it has frames left, where it touches, and where its begin and end were told. It wants this
// height.
void draw_collisions(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);
double collisions_height(const Frame& frame);

// The caption, and the counters at its right; gives the y of the hairline above them.
double draw_footer(const Frame& frame, double margin, DrawList& list, Labels& labels);

}  // namespace lantern::draw
