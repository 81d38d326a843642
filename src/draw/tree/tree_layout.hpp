// Sizes and places of a tree diagram's marks.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "draw/labels.hpp"
#include "draw/staging.hpp"
#include "draw/tree/tree_fold.hpp"

namespace lantern::draw {

// Measures at one scale; 1 is the size for a small tree. Boxes are as high as `rows` rows of them
// leave room for in `height`. A `small` tree shows every node as a square with hardly a word, so
// that one of a hundred nodes stands whole: a leaf's bodies are stripes of their colours, and where
// squares are close only what is lit has its name.
struct TreeScale {
  TreeScale(double s, std::uint32_t rows, double height, bool small = false);
  bool small = false;
  double box_width;  // of a node with little in it
  double box_height;
  double gap;   // between neighbours
  double icon;  // across a body in a leaf
  double radius;
  double text;
  double label;  // size of the type under a leaf
  double under;  // for that label, under the last row
  bool names_all() const { return !small || box_width + gap >= 43; }
};

// Which words there is room for.
struct TreeWords {
  bool nodes = false;  // "+12 nodes", not "+12"
  bool each = false;   // "×4 each", not "×4"
};

// What stands in a node's box.
struct BranchText {
  std::string text;       // may be empty
  std::size_t icons = 0;  // bodies or textures before it
};
// `node` is the one that the branch shows; `atlas`: its tree is an atlas's.
BranchText text_of(const Branch& branch, const FrameNode& node, bool atlas, const TreeScale& scale,
                   const TreeWords& words);

// A way of more than three steps: longer than anyone reads.
bool is_long_way(const std::string& label);

// Whether something is written under the branch's box.
bool has_label_below(const Branch& branch, const FrameNode& node, const TreeScale& scale);

struct TreeLayout {
  std::vector<Branch> branches;
  std::vector<std::string> ways;  // of the branches' nodes
  TreeScale scale{1, 1, 1e9};
  TreeWords words;
  std::vector<Box<2>> boxes;
  std::vector<double> room;     // how wide the label under each box may be
  bool labels_between = false;  // labels stand beside nodes that have children
  bool room_between = false;    // rows are far enough apart for labels between them
  std::uint32_t last_row = 0;   // of the group's tree

  // The corners of the line from a branch's parent to it. Where labels stand between the rows it
  // goes straight down past them first; in a small tree it goes down, across and down.
  std::vector<Vec<2>> edge(std::size_t branch) const;
};

// How the tree of a group stands in a panel: measures that all its frames share, and, if every node
// that any of them has fits the panel at once, the places of all.
struct TreeStage {
  Box<2> panel;
  double scale = 1;
  std::uint32_t rows = 1;
  bool whole = false;  // `all` holds the union's places
  bool small = false;  // which only small nodes fit into
  bool alone = false;  // the group is one frame
  TreeLayout all = {};
};

// `trees` are the nodes of this tree on each frame of the group, `atlas` as of text_of.
struct TreeOfFrame {
  std::vector<FrameNode> nodes;
  std::vector<BodyId> hits;
};
TreeStage stage_tree(const UnionTree& tree, const std::vector<TreeOfFrame>& trees, bool atlas,
                     const Box<2>& panel);

// One frame's tree: in its places of the union, or else condensed until it fits at the group's
// scale, with the root in the middle.
TreeLayout lay_out_tree(const Frame& frame, const UnionTree& tree, const TreeStage& stage);

// How large a group's tree gets in a panel, as the side of a square of that area.
double tree_size_in(const Staging& staging, const Box<2>& panel);

// Where the nodes of a tree stand beside each other, so that the drawing is tidy: a parent stands
// midway over its first and last child, children keep their order, nodes of one depth do not touch,
// edges do not cross, and equal subtrees are drawn alike.
//
// Reingold and Tilford, "Tidier Drawings of Trees" (1981), in the linear-time form of Buchheim,
// Juenger and Leipert, "Improving Walker's Algorithm to Run in Linear Time" (2002), here for nodes
// of different widths.

struct TidyNode {
  std::uint32_t parent = 0xffffffff;  // the first node is the root and has none
  double width = 0;
};

// The centres' x, the leftmost edge at 0. Parents stand before children in `nodes`, children from
// left to right. `gap` is what stays free between two neighbours.
std::vector<double> tidy_tree(std::span<const TidyNode> nodes, double gap);

}  // namespace lantern::draw
