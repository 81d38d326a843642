// Sizes and places of a tree diagram's marks.
#pragma once

#include <string>
#include <vector>

#include "draw/labels.hpp"
#include "draw/tree_fold.hpp"

namespace lantern::draw {

// Measures at one scale; 1 is the size for a small tree. Boxes are as high as `rows` rows of them
// leave room for in `height`.
struct TreeScale {
  TreeScale(double s, std::uint32_t rows, double height);
  double box_width;  // of a node with little in it
  double box_height;
  double gap;   // between neighbours
  double icon;  // across a body in a leaf
  double radius;
  double text;
  double label;  // size of the type under a leaf
  double under;  // for that label, under the last row
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
BranchText text_of(const Branch& branch, const Frame& frame, const TreeScale& scale,
                   const TreeWords& words);

// The last step of the way down, "…3", for a label whose whole way has no room; empty if the way
// has one step only.
std::string short_label(const std::string& label);

// A way of more than three steps: longer than anyone reads.
bool is_long_way(const std::string& label);

// Whether something is written under the branch's box.
bool has_label_below(const Branch& branch, const Frame& frame);

struct TreeLayout {
  std::vector<Branch> branches;
  TreeScale scale{1, 1, 1e9};
  TreeWords words;
  std::vector<Box<2>> boxes;
  bool labels_between = false;  // labels stand beside nodes that have children

  // The corners of the line from a branch's parent to it. Where labels stand between the rows it
  // leads straight down past them first.
  std::vector<Vec<2>> edge(std::size_t branch) const;

  // How wide a text centred under the branch may be: it keeps clear of the places of its
  // neighbours' labels and of the edges that lead down from them.
  double label_room(std::size_t branch, const Frame& frame, const Box<2>& panel) const;
};

// The largest and least condensed layout that the panel has room for, centred between its sides.
TreeLayout lay_out_tree(const Frame& frame, const Box<2>& panel);

}  // namespace lantern::draw
