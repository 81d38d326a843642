// The pool of a tree's nodes: slots that change their owner from tree to tree, and are not given
// back in between. Each names the node that owns it, a band marks one that was another's before;
// those that are free again are dashed.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/body_shapes.hpp"
#include "draw/marks.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

constexpr double kPoolHeading = 42;
constexpr double kPoolSlot = 46;  // height
constexpr double kPoolRow = 54;   // from row to row
constexpr int kMostPoolRows = 3;
constexpr double kPoolSlots[] = {96, 84, 72, 60, 50, 42, 34, 28, 22, 16, 12, 8};  // widths
constexpr std::uint32_t kMostPoolSlots = 2000;                                    // that are drawn

struct PoolGrid {
  double slot = kPoolSlots[0];
  std::uint32_t columns = 1, rows = 1;
};

// The widest slots at which all have room in a few rows, one row if it can be.
PoolGrid pool_grid(std::uint32_t slots, double width, int most_rows) {
  PoolGrid grid;
  const std::uint32_t all = std::clamp(slots, 1u, kMostPoolSlots);
  for (int rows = 1; rows <= most_rows; ++rows)
    for (const double slot : kPoolSlots) {
      grid.slot = slot;
      grid.columns = static_cast<std::uint32_t>(std::max(1.0, width / slot));
      grid.rows = (all + grid.columns - 1) / grid.columns;
      const bool last = rows == most_rows && slot == kPoolSlots[std::size(kPoolSlots) - 1];
      const bool legible = slot >= 60 || rows == most_rows;
      if (last || (legible && grid.rows <= static_cast<std::uint32_t>(rows))) {
        grid.columns = std::min(grid.columns, all);
        return grid;
      }
    }
  return grid;
}

// The memory of a tree that asks for each piece by itself: for every entry of every leaf's list,
// and for the four children of every node that splits. Nothing is kept for the next tree.
//
//   memory:  [@]-[@]  [@]  [@]  [#] [#]      lists of leaves, then blocks of four children
//            1.1      1.2  4
//   pool:    [root]  [1][2][3][4]  [1.1][1.2][1.3][1.4]
constexpr double kPieceSides[] = {56, 50, 44, 38, 32};               // of an entry's block
constexpr double kPieceName = 40;                                    // under a row of them
constexpr double kPieceWidths[] = {84, 72, 60, 50, 42, 34, 28, 22};  // of a node
constexpr double kPieceNode = 46;                                    // its height
constexpr double kPieceNodeRow = 56;
constexpr double kPiecesGap = 16;  // between pieces

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

// And how often memory was asked for.
std::string with_calls(std::string text, const Frame& frame) {
  if (const auto calls = frame.count("allocations"))
    text += ", " + number_of(static_cast<double>(*calls), "allocation/allocations");
  return text;
}

class ListPieces : PanelPicture {
 public:
  explicit ListPieces(const PanelPicture& on) : PanelPicture(on), bodies_(by_id(frame_.bodies)) {}

  void draw() {
    std::size_t pieces = 0;
    for (const FrameNode& node : frame_.nodes) pieces += node.leaf ? node.bodies.size() : 1;
    for (const double side : kPieceSides) {
      side_ = side;
      if (lay_out(false) <= panel_.hi.y) break;
    }
    lay_out(true);
    heading(with_calls(say("{} in use", say_count(pieces, "block/blocks")), frame_));
  }

 private:
  double link() const { return 0.3 * side_; }

  // Gives where the lowest row ends.
  double lay_out(bool drawn) {
    Flow flow{{panel_.lo + Vec<2>(0, kPoolHeading), panel_.hi}, side_ + kPieceName};
    for (const FrameNode& node : frame_.nodes) {
      if (!node.leaf || node.bodies.empty()) continue;
      const auto n = static_cast<double>(node.bodies.size());
      const double width = n * side_ + (n - 1) * link();
      const Vec<2> at = flow.place(std::max(width, text_width(node_words(node.label), kPlain) + 4));
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
    const DrawList::Scope scope(list_, node_key("memory/leaf", frame_.nodes, leaf),
                                parent_key("memory/leaf", frame_.nodes, leaf));
    TextStyle style{kLeastLabel, Weight::semibold, Role::quiet_ink};
    if (leaf.mark == Mark::lit) style.role = Role::lit_ink;
    write(node_words(leaf.label), {{at.x, at.y + side_ + 26}, 0}, style);
    for (std::size_t i = 0; i < leaf.bodies.size(); ++i, at.x += side_ + link()) {
      const Box<2> box{at, at + Vec<2>(side_)};
      list_.rect(box, ground_of(leaf.mark), outline_of(leaf), 5);
      mark_passed(leaf.mark, box, list_, 5);
      draw_icon(body_of(bodies_, leaf.bodies[i]), shrunk(box, 0.13 * side_), list_);
      if (i + 1 < leaf.bodies.size())
        list_.line({box.hi.x, box.center().y}, {box.hi.x + link(), box.center().y},
                   {Role::cell_line_0, 2.4});
    }
  }

  void draw_children(const FrameNode& node, const Vec<2>& at) {
    const DrawList::Scope scope(list_, node_key("memory/children", frame_.nodes, node));
    const Box<2> box{at, at + Vec<2>(side_)};
    const Vec<2> middle = box.center();
    list_.rect(box, Role::free_space, {Role::cell_line_1, 1.8}, 5);
    list_.line({middle.x, box.lo.y}, {middle.x, box.hi.y}, {Role::cell_line_1, 1.4});
    list_.line({box.lo.x, middle.y}, {box.hi.x, middle.y}, {Role::cell_line_1, 1.4});
  }

  BodiesById bodies_;
  double side_ = kPieceSides[0];
};

class NodePieces : PanelPicture {
 public:
  explicit NodePieces(const PanelPicture& on) : PanelPicture(on) {}

  void draw() {
    for (const double width : kPieceWidths) {
      width_ = width;
      if (lay_out(false) <= panel_.hi.y + 8) break;
    }
    lay_out(true);
    const std::size_t n = frame_.nodes.size();
    heading(with_calls(say("{}, none reused", say_count(n, "new node/new nodes")), frame_));
  }

 private:
  // The root by itself, then the children of each node that has some.
  double lay_out(bool drawn) {
    Flow flow{{panel_.lo + Vec<2>(0, kPoolHeading), panel_.hi}, kPieceNodeRow};
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
    const DrawList::Scope scope(list_, node_key("pool/node", frame_.nodes, node),
                                parent_key("pool/node", frame_.nodes, node));
    const Box<2> box{at, at + Vec<2>(width_, kPieceNode)};
    list_.crisp_rect(box, ground_of(node.mark), outline_of(node));
    mark_passed(node.mark, box, list_);
    for (const std::string& text : {node_words(node.label), short_label(node.label)})
      if (!text.empty() && text_width(text, kPlain) <= width_ - 6)
        return write(text, centred(box.center(), kPlain));
  }

  double width_ = kPieceWidths[0];
};

class PoolView : PanelPicture {
 public:
  explicit PoolView(const PanelPicture& on) : PanelPicture(on) {
    const double room = panel_.size().y - kPoolHeading;
    const int rows = std::clamp(static_cast<int>((room + 8) / kPoolRow), 1, kMostPoolRows);
    grid_ = pool_grid(frame_.get<FrameStructure>().pool_size, panel_.size().x, rows);
    shown_ = std::min({frame_.get<FrameStructure>().pool_size, kMostPoolSlots,
                       grid_.columns * static_cast<std::uint32_t>(rows)});
  }

  void draw() {
    list_.referents.insert({"nodes_reused", "allocations"});
    if (is_in_pieces(frame_)) return NodePieces(*this).draw();
    std::vector<const FrameNode*> owners(shown_);
    for (const FrameNode& node : frame_.nodes)
      if (node.pool_slot < shown_) owners[node.pool_slot] = &node;
    for (std::uint32_t slot = 0; slot < shown_; ++slot) draw_slot(slot, owners[slot]);
    draw_heading();
  }

 private:
  Box<2> place(std::uint32_t slot) const {
    const Vec<2> lo = panel_.lo + Vec<2>((slot % grid_.columns) * grid_.slot,
                                         kPoolHeading + (slot / grid_.columns) * kPoolRow);
    return {lo, lo + Vec<2>(grid_.slot, kPoolSlot)};
  }

  void draw_slot(std::uint32_t slot, const FrameNode* owner) {
    const DrawList::Scope scope(list_, fmt::format("pool/{}", slot));
    const Box<2> box = place(slot);
    if (!owner) return list_.crisp_rect(box, Role::free_space, {Role::cell_line_3, 1.4, 4});
    list_.crisp_rect(box, ground_of(owner->mark), outline_of(*owner));
    mark_passed(owner->mark, box, list_);
    if (owner->reused) draw_reused(box);
    for (const std::string& text : {node_words(owner->label), short_label(owner->label)})
      if (!text.empty() && text_width(text, kPlain) <= box.size().x - 8)
        return write(text, centred({box.center().x, box.center().y + 3}, kPlain));
  }

  // A band along the upper edge: this place was another node's before.
  void draw_reused(const Box<2>& box) {
    const double inset = std::min(3.0, 0.1 * box.size().x);
    list_.rect({box.lo + inset, {box.hi.x - inset, box.lo.y + 9}}, Role::frustum);
  }

  void draw_heading() {
    std::uint64_t used = 0, reused = 0;
    for (const FrameNode& node : frame_.nodes) {
      used += node.pool_slot != kNone;
      reused += node.pool_slot != kNone && node.reused;
    }
    const double y = panel_.lo.y + 0.8 * kLabel;
    double x = panel_.lo.x;
    const auto put = [&](const std::string& words, const TextStyle& style) {
      const std::string text = shortened(words, panel_.hi.x - x, style);
      if (!text.empty()) write(text, {{x, y}, 0}, style);
      x += text_width(text, style) + 30;
    };
    const auto number = [](std::uint64_t n) { return number_text(static_cast<double>(n)); };
    put(say("{} of {} node slots in use", number(used),
            number(frame_.get<FrameStructure>().pool_size)),
        kStrong);
    if (x + 60 < panel_.hi.x) {
      draw_reused({{x, y - 17}, {x + 26, y + 1}});
      x += 34;
      put(say("{} reused", number(reused)), kPlain);
    }
    if (const auto calls = frame_.count("allocations"); calls && x + 60 < panel_.hi.x)
      put(number_of(static_cast<double>(*calls), "allocation/allocations"), kPlain);
    if (shown_ < frame_.get<FrameStructure>().pool_size && x + 60 < panel_.hi.x)
      put(say("the first {} are drawn", number(shown_)), kPlain);
  }

  PoolGrid grid_;
  std::uint32_t shown_ = 0;  // slots
};

// As much as it needs at this width, but for a part of the area.
double pool_strip(const Frame& frame, const Vec<2>& area) {
  std::uint32_t rows = kMostPoolRows;
  if (!is_in_pieces(frame))
    rows = std::min(
        rows, pool_grid(frame.get<FrameStructure>().pool_size, area.x - 6, kMostPoolRows).rows);
  return std::min(kPoolHeading + rows * kPoolRow + 2, 0.46 * area.y);
}

}  // namespace

void draw_list_pieces(const PanelPicture& on) { ListPieces(on).draw(); }

PanelEntry pool_panel() {
  return {{.name = "pool",
           .words = "as a strip, the `pool` of nodes, or of a `lecture_quadtree` what it allocates",
           .needs = "it needs a quadtree, an octree or a kd_tree, whose nodes lie in a pool",
           .possible = language::has_pool},
          {.shows = {{"a pool of nodes",
                      [](const Frame& f) { return f.get<FrameStructure>().pool_size > 0; }}}},
          {.draw = draw_as<PoolView>,
           .strip = pool_strip,
           .weight = 0.4,
           .inset = 3,
           .smallest = {60, kPoolHeading + kPoolSlot}}};
}

}  // namespace lantern::draw
