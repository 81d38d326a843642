// The memory of a tree that asks for each piece by itself: for every entry of every leaf's list,
// and for the four children of every node that splits. Nothing is kept for the next tree.
//
//   memory:  [@]-[@]  [@]  [@]  [#] [#]      lists of leaves, then blocks of four children
//            1.1      1.2  4
//   pool:    [root]  [1][2][3][4]  [1.1][1.2][1.3][1.4]
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "draw/body_shapes.hpp"
#include "draw/keys.hpp"
#include "draw/number_text.hpp"
#include "draw/panels.hpp"

namespace lantern::draw {
namespace {

constexpr double kPiecesHeading = 42;
constexpr double kPieceSides[] = {56, 50, 44, 38, 32};               // of an entry's block
constexpr double kPieceName = 40;                                    // under a row of them
constexpr double kPieceWidths[] = {84, 72, 60, 50, 42, 34, 28, 22};  // of a node
constexpr double kPieceNode = 46;                                    // its height
constexpr double kPieceNodeRow = 56;
constexpr double kPiecesGap = 16;  // between pieces

const TextStyle kPieceText{kLeastLabel, Weight::regular, Role::ink};

// Goes from left to right in rows.
struct Flow {
  Box<2> area;
  double row = 0;  // from row to row
  Vec<2> at = area.lo;

  Vec<2> place(double width) {
    if (at.x > area.lo.x && at.x + width > area.hi.x + 0.1) at = {area.lo.x, at.y + row};
    const Vec<2> from = at;
    at.x += width + kPiecesGap;
    return from;
  }
  double bottom() const { return at.y + row; }
};

Stroke outline_of(const FrameNode& node) {
  return node.mark == Mark::lit ? Stroke{Role::lit, 2.8} : Stroke{Role::cell_line_1, 1.8};
}

void draw_pieces_heading(std::string text, const Frame& frame, const Box<2>& panel,
                         Labels& labels) {
  if (const auto calls = frame.count("allocations"))
    text += fmt::format(", {} allocation{}", number_text(double(*calls)), *calls == 1 ? "" : "s");
  const TextStyle style{kLabel, Weight::semibold, Role::ink};
  labels.add(shortened(text, panel.size().x, style),
             {{panel.lo.x, panel.lo.y + 0.8 * style.size}, 0}, style, panel);
}

class ListPieces {
 public:
  ListPieces(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels)
      : frame_(frame), panel_(panel), list_(list), labels_(labels), bodies_(by_id(frame.bodies)) {}

  void draw() {
    std::size_t pieces = 0;
    for (const FrameNode& node : frame_.nodes) pieces += node.leaf ? node.bodies.size() : 1;
    for (const double side : kPieceSides) {
      side_ = side;
      if (lay_out(false) <= panel_.hi.y) break;
    }
    lay_out(true);
    draw_pieces_heading(fmt::format("{} block{} in use", pieces, pieces == 1 ? "" : "s"), frame_,
                        panel_, labels_);
  }

 private:
  double link() const { return 0.3 * side_; }

  // Gives where the lowest row ends.
  double lay_out(bool drawn) {
    Flow flow{{panel_.lo + Vec<2>(0, kPiecesHeading), panel_.hi}, side_ + kPieceName};
    for (const FrameNode& node : frame_.nodes) {
      if (!node.leaf || node.bodies.empty()) continue;
      const auto n = static_cast<double>(node.bodies.size());
      const double width = n * side_ + (n - 1) * link();
      const Vec<2> at = flow.place(std::max(width, text_width(node.label, kPieceText) + 4));
      if (drawn && at.y + side_ + kPieceName <= panel_.hi.y + 1) draw_list(node, at);
    }
    for (const FrameNode& node : frame_.nodes) {
      if (node.leaf) continue;
      const Vec<2> at = flow.place(side_);
      if (drawn && at.y + side_ + kPieceName <= panel_.hi.y + 1) draw_children(node, at);
    }
    return flow.bottom();
  }

  void draw_list(const FrameNode& leaf, Vec<2> at) {
    const DrawList::Scope scope(list_, node_key("memory/leaf", frame_.nodes, leaf.id),
                                parent_key("memory/leaf", frame_.nodes, leaf.id));
    TextStyle style{kLeastLabel, Weight::semibold, Role::quiet_ink};
    if (leaf.mark == Mark::lit) style.role = Role::lit_ink;
    labels_.add(leaf.label, {{at.x, at.y + side_ + 26}, 0}, style, panel_);
    for (std::size_t i = 0; i < leaf.bodies.size(); ++i, at.x += side_ + link()) {
      const Box<2> box{at, at + Vec<2>(side_)};
      list_.rect(box, ground_of(leaf.mark), outline_of(leaf), 5);
      if (const auto body = bodies_.find(leaf.bodies[i]); body != bodies_.end())
        draw_character(*body->second, icon_box(*body->second, shrunk(box, 0.13 * side_)), false,
                       list_);
      if (i + 1 < leaf.bodies.size())
        list_.line({box.hi.x, box.center().y}, {box.hi.x + link(), box.center().y},
                   {Role::cell_line_0, 2.4});
    }
  }

  void draw_children(const FrameNode& node, const Vec<2>& at) {
    const DrawList::Scope scope(list_, node_key("memory/children", frame_.nodes, node.id));
    const Box<2> box{at, at + Vec<2>(side_)};
    const Vec<2> middle = box.center();
    list_.rect(box, Role::free_space, {Role::cell_line_1, 1.8}, 5);
    list_.line({middle.x, box.lo.y}, {middle.x, box.hi.y}, {Role::cell_line_1, 1.4});
    list_.line({box.lo.x, middle.y}, {box.hi.x, middle.y}, {Role::cell_line_1, 1.4});
  }

  const Frame& frame_;
  Box<2> panel_;
  DrawList& list_;
  Labels& labels_;
  BodiesById bodies_;
  double side_ = kPieceSides[0];
};

class NodePieces {
 public:
  NodePieces(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels)
      : frame_(frame), panel_(panel), list_(list), labels_(labels) {}

  void draw() {
    for (const double width : kPieceWidths) {
      width_ = width;
      if (lay_out(false) <= panel_.hi.y + 8) break;
    }
    lay_out(true);
    const std::size_t n = frame_.nodes.size();
    draw_pieces_heading(fmt::format("{} new node{}, none reused", n, n == 1 ? "" : "s"), frame_,
                        panel_, labels_);
  }

 private:
  // The root by itself, then the children of each node that has some.
  double lay_out(bool drawn) {
    Flow flow{{panel_.lo + Vec<2>(0, kPiecesHeading), panel_.hi}, kPieceNodeRow};
    const auto place = [&](std::uint32_t parent, double children) {
      Vec<2> at = flow.place(children * width_);
      for (const FrameNode& node : frame_.nodes) {
        if (node.parent != parent) continue;
        if (drawn && at.y + kPieceNode <= panel_.hi.y + 1) draw_node(node, at);
        at.x += width_;
      }
    };
    place(kNone, 1);
    for (const FrameNode& node : frame_.nodes)
      if (!node.leaf) place(node.id, 4);
    return flow.bottom();
  }

  void draw_node(const FrameNode& node, const Vec<2>& at) {
    const DrawList::Scope scope(list_, node_key("pool/node", frame_.nodes, node.id),
                                parent_key("pool/node", frame_.nodes, node.id));
    const Box<2> box{at, at + Vec<2>(width_, kPieceNode)};
    list_.crisp_rect(box, ground_of(node.mark), outline_of(node));
    const std::size_t dot = node.label.rfind('.');
    const std::string brief = dot == std::string::npos ? "" : "…" + node.label.substr(dot + 1);
    for (const std::string& text : {node.label, brief})
      if (!text.empty() && text_width(text, kPieceText) <= width_ - 6)
        return labels_.add(text, centred(box.center(), kPieceText), kPieceText, panel_);
  }

  const Frame& frame_;
  Box<2> panel_;
  DrawList& list_;
  Labels& labels_;
  double width_ = kPieceWidths[0];
};

}  // namespace

void draw_list_pieces(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels) {
  ListPieces(frame, panel, list, labels).draw();
}

void draw_node_pieces(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels) {
  NodePieces(frame, panel, list, labels).draw();
}

}  // namespace lantern::draw
