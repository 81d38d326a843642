#include <algorithm>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/font.hpp"
#include "draw/panel.hpp"
#include "draw/texture_picture.hpp"
#include "draw/tree/tree_layout.hpp"
#include "draw/world/world2d_parts.hpp"

namespace lantern::draw {
namespace {

class TreeView : PanelPicture {
 public:
  TreeView(const PanelPicture& on, const UnionTree& tree, const TreeStage& stage)
      : PanelPicture(on), layout_(lay_out_tree(frame_, tree, stage)) {
    for (const Branch& branch : branches())  // rows come in order
      if (branch.row == says_holds_.size()) says_holds_.push_back(has_room_for_holds(branch.row));
    for (const Branch& branch : branches()) leads_to_lit_.push_back(branch.mark == Mark::lit);
    for (std::size_t i = branches().size(); i-- > 1;)
      if (leads_to_lit_[i]) leads_to_lit_[branches()[i].parent] = true;
  }

  void draw() {
    for (const bool lit : {false, true})
      for (std::size_t i = 1; i < branches().size(); ++i)
        if (is_lit_edge(i) == lit) draw_edge(i, lit);
    for (std::size_t i = 0; i < branches().size(); ++i) draw_branch(i);
    for (std::size_t i = 0; i < branches().size(); ++i)
      if (branches()[i].kind != Branch::Kind::levels) labels_.block(layout_.boxes[i]);
    for (std::size_t i = 0; i < branches().size(); ++i) label_branch(i);
    for (std::size_t i = 1; i < branches().size(); ++i) label_edge(i);
    depict();
  }

 private:
  const std::vector<Branch>& branches() const { return layout_.branches; }
  const FrameNode& node_of(const Branch& branch) const { return frame_.nodes[branch.node]; }
  bool is_atlas() const { return !frame_.get<FrameTextures>().textures.empty(); }
  // On a tree that is shown whole, its nodes can be counted.
  void depict() const {
    if (branches().size() != frame_.nodes.size() || frame_.nodes.empty()) return;
    list_.referents.insert({"depth", "most_in_leaf", "nodes_asleep", "leaves_asleep",
                            "branches_asleep", "nodes_visited", "nodes_skipped", "free_leaves"});
  }
  bool is_empty_leaf(const Branch& branch) const {
    return node_of(branch).leaf && node_of(branch).bodies.empty();
  }

  // What is drawn next belongs to a branch, and comes out of its parent's box.
  DrawList::Scope shown(std::string_view kind, std::size_t i) {
    const FrameNode& node = node_of(branches()[i]);
    return {list_, node_key(kind, frame_.nodes, node), parent_key("tree/node", frame_.nodes, node)};
  }
  // Its words, which appear where they stand.
  DrawList::Scope named(std::string_view kind, std::size_t i) {
    return {list_, node_key(kind, frame_.nodes, branches()[i].node)};
  }
  // A body or texture in a leaf, which comes there from the leaf's parent.
  DrawList::Scope carried(const std::string& what, const Branch& leaf) {
    const FrameNode& node = node_of(leaf);
    return {list_, node_key(what, frame_.nodes, node), parent_key(what, frame_.nodes, node)};
  }

  // The whole way down to what is lit, not its last step alone.
  bool is_lit_edge(std::size_t i) const {
    return leads_to_lit_[i] && branches()[i].mark != Mark::quiet;
  }
  bool is_small() const { return layout_.scale.small; }

  void draw_edge(std::size_t i, bool lit) {
    const Role role = lit ? Role::lit : cell_line_role(node_of(branches()[i]).depth - 1);
    const std::vector<Vec<2>> corners = layout_.edge(i);
    const DrawList::Scope scope = shown("tree/edge", i);
    for (std::size_t k = 1; k < corners.size(); ++k) {
      const Vec<2>&a = corners[k - 1], &b = corners[k];
      const bool upright_or_level = a.x == b.x || a.y == b.y;
      if (is_small()) labels_.block({glm::min(a, b) - 1.5, glm::max(a, b) + 1.5});
      list_.shapes.emplace_back(LineShape{a, b, {role, lit ? 2.8 : 2.0}, upright_or_level});
    }
  }

  bool takes_no_part(const Branch& branch) const {
    return branch.mark == Mark::quiet &&
           (frame_.sleeps(node_of(branch)) || node_of(branch).skipped);
  }

  Stroke outline_of(const Branch& branch) const {
    const FrameNode& node = node_of(branch);
    const bool dashed = is_empty_leaf(branch);
    if (branch.mark == Mark::lit) return {Role::lit, 3.4, dashed ? 6.0 : 0.0};
    if (node.over_capacity) return {Role::warning, 2.6};
    if (takes_no_part(branch)) return {Role::quiet_ink, 2.0, 2.6};
    return {cell_line_role(std::min(node.depth, 2u)), 2.2, dashed ? 5.5 : 0.0};
  }

  void draw_branch(std::size_t i) {
    const Branch& branch = branches()[i];
    const Box<2>& box = layout_.boxes[i];
    const DrawList::Scope scope = shown("tree/node", i);
    if (branch.kind == Branch::Kind::levels) return draw_levels(branch, box);
    const Stroke outline = outline_of(branch);
    const FrameNode& node = node_of(branch);
    const Role ground = takes_no_part(branch) ? Role::free_space : ground_of(branch.mark);
    // What never moves has sharp corners.
    const double radius = node.of_static ? 1.5 : layout_.scale.radius;
    const bool pile = branch.kind == Branch::Kind::folded ||
                      (branch.kind == Branch::Kind::node && branch.copies > 1);
    if (pile) {
      Box<2> behind{box.lo + Vec<2>(5, -5), box.hi + Vec<2>(5, -5)};  // a pile of equal cards
      list_.rect(behind, ground, outline, radius);
    }
    list_.rect(box, ground, outline, radius);
    mark_passed(branch.mark, box, list_, radius);
    if (branch.kind == Branch::Kind::node)
      if (const auto level = level_in(frame_, node, shrunk(box, 3)))
        list_.rect(*level, Role::rule, {}, std::min(radius, 4.0));
    if (labels_.has_notes()) {
      if (branch.copies == 1) labels_.tell_place(target_of_node(node.label), box);
      labels_.tell_body(box);
    }
    if (is_small()) return draw_small(i);
    if (is_atlas() && branch.kind == Branch::Kind::node && !node_of(branch).leaf)
      draw_cut(node_of(branch), box, outline.role);
    else
      draw_content(branch, box);
    if (node.over_capacity && branch.kind == Branch::Kind::node) draw_badge(box);
    if (branch.kind == Branch::Kind::node) {  // its place on a ray's way
      if (is_topmost_skipped(node, frame_)) draw_skipped({box.hi.x - 2, box.lo.y - 1}, list_);
      const std::uint32_t place = node.met != kNone ? node.met : node.order;
      if (place != kNone) draw_met(place, box.lo + Vec<2>(2, -11), panel_, list_, labels_);
    }
    if (frame_.sleeps(node)) draw_zz(box.lo + Vec<2>(-9, -9), 24, 1.8, list_);
  }

  // In a small node: its bodies as stripes of their colours, and what fits of its marks.
  void draw_small(std::size_t i) {
    constexpr double kForMarks = 26;
    constexpr std::size_t kMostStripes = 4;
    const FrameNode& node = node_of(branches()[i]);
    const Box<2>& box = layout_.boxes[i];
    const std::size_t stripes = std::min(node.leaf ? node.bodies.size() : 0, kMostStripes);
    if (stripes == 1 && layout_.scale.icon >= 12)
      draw_icon(node.bodies[0], branches()[i],
                Box<2>::around(box.center(), Vec<2>(0.5 * layout_.scale.icon)));
    else if (stripes > 0) {
      const auto places = split(shrunk(box, 2.6), 0, std::vector<double>(stripes, 1.0), 1);
      for (std::size_t k = 0; k < stripes; ++k)
        list_.rect(places[k], color_of(node.bodies[k]), {}, 1);
    }
    if (!node.leaf && says_name_inside(i)) {
      const TextStyle style{kLeastLabel, Weight::semibold, Role::ink};
      write(name_inside(node), centred(box.center(), style), style);
    }
    const bool has_room = box.size().x >= kForMarks;
    if (node.over_capacity && has_room) draw_badge(box);
    if (is_topmost_skipped(node, frame_)) {
      if (has_room)
        draw_skipped({box.hi.x - 2, box.lo.y - 1}, list_);
      else
        list_.line(box.lo, box.hi, {Role::quiet_ink, 1.6});
    }
    if (frame_.sleeps(node) && has_room) draw_zz(box.lo + Vec<2>(-9, -9), 24, 1.8, list_);
  }

  // A level's inner node is called by the wall whose line it is.
  std::string name_inside(const FrameNode& node) const {
    return is_level(frame_) && node.plane ? node.plane_name : node_words(node.label);
  }

  bool says_name_inside(std::size_t i) const {
    const std::string label = name_inside(node_of(branches()[i]));
    const Vec<2> room = layout_.boxes[i].size() - Vec<2>(is_level(frame_) ? -3 : 8, 4);
    return !label.empty() && room.y >= kLeastLabel * 0.8 &&
           text_width(label, kLeastLabel, Weight::semibold) <= room.x;
  }

  Role color_of(BodyId id) const {
    if (is_atlas())
      return body_role(
          std::ranges::find(frame_.get<FrameTextures>().textures, id, &FrameTexture::id)->color);
    const FrameBody* body = body_of(bodies_, id);
    return body ? fill_of(*body) : Role::quiet_ink;
  }

  // A dashed line where levels are left out.
  void draw_levels(const Branch& branch, const Box<2>& box) {
    const Role role = branch.mark == Mark::quiet ? Role::cell_line_2 : Role::lit;
    const Vec<2> c = box.center();
    list_.line({c.x, box.lo.y}, {c.x, box.hi.y}, {role, 2.8, 5});
  }

  // Icons from the left and the text after them, centred in the box.
  void draw_content(const Branch& branch, const Box<2>& box) {
    const BranchText content =
        text_of(branch, node_of(branch), is_atlas(), layout_.scale, layout_.words);
    const TextStyle style = text_style(branch);
    const double icon = layout_.scale.icon;
    const double text = text_width(content.text, style);
    const auto icons = static_cast<double>(content.icons);
    double width = icons > 0 ? icons * (icon + 5) - 5 : 0;
    if (!content.text.empty()) width += text + (icons > 0 ? 6 : 0);
    const Vec<2> c = box.center();
    double x = c.x - width / 2;
    for (std::size_t k = 0; k < content.icons; ++k, x += icon + 5)
      draw_icon(node_of(branch).bodies[k], branch,
                {{x, c.y - icon / 2}, {x + icon, c.y + icon / 2}});
    if (content.icons > 0) x += 1;
    const Anchor at = centred({x, c.y}, style, 0);
    // Of a tree that has no room at all, words go before the nodes.
    if (holds(panel_, Labels::extent(content.text, at, style))) write(content.text, at, style);
  }

  TextStyle text_style(const Branch& branch) const {
    const bool no_node = branch.kind != Branch::Kind::node || is_empty_leaf(branch);
    if (no_node && branch.mark != Mark::lit)
      return {layout_.scale.text, Weight::regular, Role::quiet_ink};
    return {layout_.scale.text, Weight::semibold, Role::ink};
  }

  void draw_icon(BodyId id, const Branch& branch, const Box<2>& place) {
    if (is_atlas()) {
      const FrameTexture& texture =
          *std::ranges::find(frame_.get<FrameTextures>().textures, id, &FrameTexture::id);
      const DrawList::Scope scope = carried(texture_key("tree/texture", texture), branch);
      draw_pattern(texture.id, texture.color, place, 0.8, kMostPatternParts, list_, texture.turned);
      return list_.rect(place, Role::none, {Role::body_line, 1.2});
    }
    const FrameBody* body = body_of(bodies_, id);
    if (!body) return;
    const DrawList::Scope scope = carried(body_key("tree/body", *body), branch);
    draw::draw_icon(body, place, list_);
  }

  // How an atlas's node is cut: two halves, and the strong line between.
  void draw_cut(const FrameNode& node, const Box<2>& box, Role role) {
    const double half = 0.32 * box.size().y;
    const Box<2> icon = Box<2>::around(box.center(), Vec<2>(1.15 * half, half));
    list_.rect(icon, Role::none, {role, 1.6}, 2);
    const Vec<2> c = icon.center();
    const bool upright = node.cut_vertically;
    list_.line(upright ? Vec<2>(c.x, icon.lo.y) : Vec<2>(icon.lo.x, c.y),
               upright ? Vec<2>(c.x, icon.hi.y) : Vec<2>(icon.hi.x, c.y), {role, 3.2});
  }

  // A warning triangle on the box's side, clear of the edges above.
  void draw_badge(const Box<2>& box) {
    const Vec<2> c{box.hi.x - 1, box.lo.y + 9};
    list_.polygon({c + Vec<2>(0, -10), c + Vec<2>(10, 7), c + Vec<2>(-10, 7)}, Role::warning,
                  {Role::paper, 2});
    list_.line(c + Vec<2>(0, -3.5), c + Vec<2>(0, 1), {Role::paper, 2.2});
    list_.disc(c + Vec<2>(0, 4.6), 1.3, Role::paper);
  }

  void label_levels(const Branch& branch, const Vec<2>& c) {
    const TextStyle style{layout_.scale.text, Weight::regular, Role::quiet_ink, Role::paper};
    try_write(text_of(branch, node_of(branch), is_atlas(), layout_.scale, layout_.words).text,
              {{{c.x + 12, c.y + 0.36 * style.size}, 0}, {{c.x - 12, c.y + 0.36 * style.size}, 1}},
              style);
  }

  void label_branch(std::size_t i) {
    const Branch& branch = branches()[i];
    const FrameNode& node = node_of(branch);
    const DrawList::Scope scope = named("tree/name", i);
    if (branch.kind == Branch::Kind::levels) return label_levels(branch, layout_.boxes[i].center());
    if (is_small()) return label_small(i);
    if (!has_label_below(branch, node, layout_.scale)) return;
    TextStyle style{layout_.scale.label, Weight::semibold, Role::quiet_ink, Role::paper};
    if (branch.mark == Mark::lit) style.role = Role::lit_ink;
    if (node.over_capacity && node.leaf) style.role = Role::warning;
    const Box<2>& box = layout_.boxes[i];
    if (branch.row < layout_.last_row && !layout_.room_between) return label_beside(i, style);
    const Anchor under{{box.center().x, box.hi.y + 4 + 0.78 * style.size}, 0.5};
    const double room = layout_.room[i];
    for (const std::string& text : label_choices(branch))
      if (text_width(text, style) <= room && try_write(text, {under}, style)) return;
    if (branch.copies == 1 && short_label(node.label).empty() &&
        !try_write(node_words(node.label), {under}, style))
      try_write(shortened(node_words(node.label), room, style), {under}, style);
  }

  // Of a small tree: names, and a node's place on a ray's way, where there is room.
  void label_small(std::size_t i) {
    const Branch& branch = branches()[i];
    const FrameNode& node = node_of(branch);
    const Box<2>& box = layout_.boxes[i];
    const Vec<2> c = box.center();
    if (const std::uint32_t place = node.met != kNone ? node.met : node.order; place != kNone)
      for (const Vec<2>& at : {Vec<2>(c.x, box.hi.y + 17), Vec<2>(c.x, box.lo.y - 17),
                               Vec<2>(box.lo.x - 17, c.y), Vec<2>(box.hi.x + 17, c.y)})
        if (draw_met(place, at, panel_, list_, labels_)) return;
    const bool warns = node.over_capacity && node.leaf, lit = branch.mark == Mark::lit;
    if (!warns && !lit && !(node.leaf && layout_.scale.names_all())) return;
    const TextStyle style{layout_.scale.label, Weight::semibold,
                          warns ? Role::warning
                          : lit ? Role::lit_ink
                                : Role::quiet_ink,
                          Role::paper};
    if (!node.leaf && says_name_inside(i)) return;
    const Anchor under{{c.x, box.hi.y + 4 + 0.78 * style.size}, 0.5};
    const Anchor right = centred({box.hi.x + 6, c.y}, style, 0);
    const Anchor left = centred({box.lo.x - 6, c.y}, style, 1);
    for (const std::string& text : label_choices(branch))
      if (!text.empty() && try_write(text, {under, right, left}, style)) return;
  }

  // Where rows stand too close for words between them: in the gap to a neighbour, if that is wide
  // enough to tell whose name it is.
  void label_beside(std::size_t i, const TextStyle& style) {
    constexpr double kNear = 5, kFar = 14;
    const Box<2>& box = layout_.boxes[i];
    for (const std::string& text : label_choices(branches()[i]))
      for (const double align : {0.0, 1.0}) {
        const Anchor anchor = centred(
            {align > 0 ? box.lo.x - kNear : box.hi.x + kNear, box.center().y}, style, align);
        Box<2> extent = Labels::extent(text, anchor, style);
        (align > 0 ? extent.lo.x : extent.hi.x) += align > 0 ? -kFar : kFar;
        if (!text.empty() && labels_.is_free(extent, panel_) && try_write(text, {anchor}, style))
          return;
      }
  }

  // What may stand under a branch, the best first. A way of many steps is spelt out only where the
  // step is about it or where it warns.
  std::vector<std::string> label_choices(const Branch& branch) const {
    const FrameNode& node = node_of(branch);
    if (branch.kind == Branch::Kind::folded && branch.copies == 0)
      return {layout_.words.nodes ? "" : noun("node/nodes", kMany)};
    const bool overfull = node.over_capacity && node.leaf;
    const bool holds = overfull && says_holds_[branch.row];
    if (branch.copies > 1) return copies_choices(branch, holds);
    std::vector<std::string> names;
    if (traits_of(frame_.structure).names == NodeNames::sides)
      names = leaf_names(frame_, node);
    else if (overfull || branch.mark == Mark::lit || !is_long_way(node.label))
      names.push_back(node_words(node.label));
    if (const std::string brief = short_label(node.label);
        !brief.empty() && traits_of(frame_.structure).names != NodeNames::sides)
      names.push_back(brief);
    std::vector<std::string> choices;
    if (holds)
      for (const std::string& name : names)
        choices.push_back(say("{} holds {}", name, node.bodies.size()));
    choices.insert(choices.end(), names.begin(), names.end());
    return choices;
  }

  std::vector<std::string> copies_choices(const Branch& branch, bool holds) const {
    const std::string count = fmt::format("×{}", branch.copies);
    if (holds) {
      const std::size_t bodies = node_of(branch).bodies.size();
      return {branch.each ? say("{} each, hold {}", count, bodies)
                          : say("{}, each holds {}", count, bodies)};
    }
    if (branch.each) return {say("{} each", count), count};
    return {count};
  }

  // "holds 3" says in words what the badge warns of. In a row all that hold too much say it, or
  // none.
  bool has_room_for_holds(std::uint32_t row) const {
    for (std::size_t i = 0; i < branches().size(); ++i) {
      const Branch& branch = branches()[i];
      const FrameNode& node = node_of(branch);
      if (branch.row != row || branch.kind != Branch::Kind::node || !node.leaf ||
          !node.over_capacity)
        continue;
      const std::string brief = short_label(node.label);
      const std::string least =
          branch.copies > 1 ? copies_choices(branch, true).front()
                            : say("{} holds {}", brief.empty() ? node_words(node.label) : brief,
                                  node.bodies.size());
      if (text_width(least, layout_.scale.label, Weight::semibold) > layout_.room[i]) return false;
    }
    return true;
  }

  // Which side of the plane a child is; a leaf says so by its name.
  std::string side_of(const Branch& branch) const {
    const FrameNode& node = node_of(branch);
    if (is_level(frame_) || node.parent == kNone) return "";  // lines without names
    const FrameNode& parent = frame_.nodes[node.parent];
    const StructureTraits& traits = traits_of(frame_.structure);
    if (traits.names == NodeNames::sides)
      return !node.leaf || leaf_names(frame_, node).empty() ? side_word(parent, node.slot) : "";
    return traits.is_fitted && parent.plane ? side_word(parent, node.slot) : "";
  }

  void label_edge(std::size_t i) {
    const Branch& branch = branches()[i];
    if (is_atlas() || branch.copies != 1 || branch.kind != Branch::Kind::node) return;
    const std::string side = side_of(branch);
    if (side.empty()) return;
    const DrawList::Scope scope = named("tree/side", i);
    const std::vector<Vec<2>> corners = layout_.edge(i);
    if (corners.size() > 3) return;  // no room for words between the rows
    const Vec<2> a = corners[corners.size() - 2], b = corners.back();
    const Vec<2> middle = a + (b - a) * 0.5;
    const TextStyle style{layout_.scale.label, Weight::regular, Role::quiet_ink, Role::paper};
    const double align = b.x < a.x ? 1 : 0;
    const double beside = b.x < a.x ? -14 : 14;
    try_write(side, {{middle + Vec<2>(beside, 2), align}, {middle + Vec<2>(0, 6), 0.5}}, style);
  }

  TreeLayout layout_;
  std::vector<bool> says_holds_;    // by row
  std::vector<bool> leads_to_lit_;  // by branch
  BodiesById bodies_ = by_id(frame_.bodies);
};

}  // namespace

void draw_one_tree(const PanelPicture& on, const UnionTree& tree, const TreeStage& stage) {
  TreeView(on, tree, stage).draw();
}

}  // namespace lantern::draw
