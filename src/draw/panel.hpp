// How panels are drawn, and what room they want. Each panel is a file that gives one entry of the
// list in panel.cpp: all that is known of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "draw/labels.hpp"
#include "draw/staging.hpp"
#include "frame/panel.hpp"

namespace lantern::draw {

struct PanelView {
  // Fills the box and nothing outside of it.
  void (*draw)(const Frame& frame, const Staging& staging, const Box<2>& box, DrawList& list,
               Labels& labels) = nullptr;
  // Beside others: the width that it would take at this height if it could choose. Null: what is
  // left.
  double (*width)(const Frame& frame, double height) = nullptr;
  // Of a strip, which lies under the others as wide as they are together: the height that it wants
  // in an area. Null: no strip.
  double (*strip)(const Frame& frame, const Vec<2>& area) = nullptr;
  // How large its picture gets in a box: the side of a square as large. Two panels that say it
  // share an area so that both are large. Null: it takes what it gets.
  double (*size)(const Frame& frame, const Staging& staging, const Box<2>& box) = nullptr;
  double weight = 1;   // of its height, where panels stand one above the other
  double least = 260;  // that height, where another one wants more of it
  double enough = 0;   // such a one: as much, if the others keep `least`; flatter it shows little
  double inset = 0;    // from its box to what it is drawn in
  Vec<2> smallest{-1e300};  // in less nothing is drawn
};

// A panel: when there can be one, what frames hold for it, and how it is drawn.
struct PanelEntry {
  PanelKind kind;
  PanelRun run;
  PanelView view;
};

const PanelView& view_of(Panel panel);
// One more, of a program's own. Throws Refused as language::add_panel does.
void add_panel(PanelEntry panel);
// Lantern's own are known from the start of a program that draws. One that only reads and runs
// scenarios knows them once it has asked this.
bool panels_are_known();
void draw_panel(Panel panel, const Frame& frame, const Staging& staging, const Box<2>& box,
                DrawList& list, Labels& labels);

// What the classes that draw panels are: a frame, and where it is drawn.
class PanelPicture {
 public:
  PanelPicture(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
               Labels& labels)
      : frame_(frame), staging_(staging), panel_(panel), list_(list), labels_(labels) {}

 protected:
  // What the panel shows, at its upper edge.
  void heading(const std::string& text, double down = 0.8 * kLabel) {
    write(shortened(text, panel_.size().x, kStrong), {{panel_.lo.x, panel_.lo.y + down}, 0},
          kStrong);
  }

  void write(std::string_view text, const Anchor& at, const TextStyle& style = kPlain) {
    labels_.add(text, at, style, panel_);
  }
  bool try_write(std::string_view text, std::initializer_list<Anchor> anchors,
                 const TextStyle& style = kPlain) {
    return labels_.try_add(text, anchors, style, panel_);
  }

  const Frame& frame_;
  const Staging& staging_;
  Box<2> panel_;
  DrawList& list_;
  Labels& labels_;
};
// The `draw` of a panel that such a class draws.
template <class Picture>
void draw_as(const Frame& frame, const Staging& staging, const Box<2>& box, DrawList& list,
             Labels& labels) {
  Picture({frame, staging, box, list, labels}).draw();
}

// What panels share, and the page's foot. Each fills its box and nothing outside of it.

// Node cells, bodies as characters, candidate pairs and marks. A 2D world as large as
// frame.bounds fit into the panel, y upwards; a 3D one as frame.camera sees it, with its floor.
void draw_world(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
                Labels& labels);

// The structure or atlas as a node-link diagram, and under it what it was told and what it counts.
// All nodes that the group's frames have stand in one layout; where that is too large for the panel
// all nodes are small squares, or else a frame's tree is condensed (tree_fold.hpp); nodes are never
// narrower than kLeastNode, small ones than kLeastSmallNode. Two trees,
// of what never moves and of what does, stand side by side or one above the other; sort and sweep
// has no tree and shows its intervals.
void draw_tree(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
               Labels& labels);
inline constexpr double kLeastNode = 34, kLeastSmallNode = 8;
// The intervals of sort and sweep along the axis that it sorted by, one row a body in the order of
// the sweep. A pair that it compares is linked where the later interval begins; where one body is
// lit, the sweep stands at its beginning, and the intervals that are open there are marked.
void draw_sweep(const PanelPicture& on);
// The array of a grid's cells, of each level one, or the buckets that a spatial hash puts its cells
// into: in rows as the grid is wide, each with the bodies that reach it. Where several cells share
// a bucket, they are parted by lines.
void draw_grid(const PanelPicture& on);
// The diagram alone, of a frame whose nodes are one tree.
struct TreeStage;
void draw_one_tree(const PanelPicture& on, const UnionTree& tree, const TreeStage& stage);

// Width over height of a world's picture, and the width that it takes at a height.
double world_aspect(const Frame& frame);
double world_width(const Frame& frame, double height);

// The array of leaves' entries of a tree that asks for each piece of memory by itself: a block for
// each entry of a leaf's list and one for each four children.
void draw_list_pieces(const PanelPicture& on);
inline bool is_in_pieces(const Frame& frame) {
  return frame.structure != StructureKind::none && traits_of(frame.structure).is_plain;
}

// The last step of the way down to a node, "…3", for a label whose whole way has no room; empty if
// the way has one step only.
std::string short_label(const std::string& label);

// The caption, and the counters at its right; gives the y of the hairline above them. On a narrow
// page the caption has as many lines as the longest of the group needs.
double draw_footer(const Frame& frame, const Staging& staging, double margin, DrawList& list,
                   Labels& labels);
inline constexpr double kNarrowPage = 1000;

// --- notes: a few words beside what they are about, each with a thin line to it ---

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

// One box for each of the frame's panels, in their order, inside `area`; the same for all frames of
// the group. A world and a tree stand side by side or one above the other, and in the parts, in
// which both are drawn largest; a world alone fills the area. On a `tall` page all stand one above
// the other.
std::vector<Box<2>> arranged(const Frame& frame, const Staging& staging, const Box<2>& area,
                             bool tall);

}  // namespace lantern::draw
