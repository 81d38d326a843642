// Which branches of a tree are shown when it is too large for its panel. Folding goes before
// layout, so that the cost is linear in the nodes and the layout only ever sees what fits on a
// panel.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "base/hash.hpp"
#include "draw/body_shapes.hpp"
#include "frame/parts/asked.hpp"
#include "frame/parts/atlas.hpp"

namespace lantern::draw {

// One mark of the diagram.
struct Branch {
  enum class Kind {
    node,     // a node as it is
    empties,  // `count` empty leaves of one parent
    folded,   // a node, and `count` more that are not shown
    levels,   // `count` levels of the lit path that are not shown
  };
  Kind kind = Kind::node;
  std::uint32_t node = 0;        // index in the frame's nodes; the first of those it stands for
  std::uint32_t parent = kNone;  // index among the branches
  std::uint32_t row = 0;
  std::uint32_t count = 0;
  std::uint32_t copies = 1;  // equal subtrees of one parent that this one stands for; 0 when it
                             // stands for unlike ones
  Mark mark = Mark::quiet;   // the strongest of all that it stands for
  bool each = false;         // stands below equal subtrees, so that its count is for each of them
};

class TreeFold {
 public:
  // The frame must outlive this.
  explicit TreeFold(const Frame& frame)
      : TreeFold(frame.nodes, !frame.get<FrameTextures>().textures.empty(),
                 frame.get<FrameFinding>().hits) {}

  // `named`: leaves differ by their names only, as an atlas's free ones do. `hits` are what a query
  // has found. The nodes must outlive this.
  TreeFold(const std::vector<FrameNode>& nodes, bool named, const std::vector<BodyId>& hits)
      : nodes_(nodes),
        children_(nodes_.size()),
        size_(nodes_.size(), 1),
        mark_(nodes_.size()),
        shape_(nodes_.size()),
        shown_(nodes_.size()) {
    find_shown(hits);
    for (std::uint32_t i = 0; i < nodes_.size(); ++i)
      if (nodes_[i].parent != kNone) children_[nodes_[i].parent].push_back(i);
    for (std::size_t i = nodes_.size(); i-- > 0;) {
      const FrameNode& node = nodes_[i];
      auto& children = children_[i];
      std::ranges::stable_sort(children, {}, [&](std::uint32_t c) { return nodes_[c].slot; });
      Hash hash;
      hash.add(static_cast<std::uint64_t>(node.mark)).add(std::uint64_t{node.leaf});
      hash.add(std::uint64_t{node.awake}).add(std::uint64_t{node.skipped});
      hash.add(std::uint64_t{node.met});
      hash.add(node.plane_name).add(named ? node.label : std::string());
      for (const BodyId id : node.bodies) hash.add(std::uint64_t{id});
      mark_[i] = node.mark;
      for (const std::uint32_t child : children) {
        hash.add(std::uint64_t{nodes_[child].slot}).add(shape_[child]);
        size_[i] += size_[child];
        mark_[i] = std::max(mark_[i], mark_[child]);
      }
      shape_[i] = hash.value();
    }
  }

  // Every node, parents before children, children in order.
  std::vector<Branch> whole() const {
    std::vector<Branch> list;
    if (!nodes_.empty()) list.push_back({.mark = nodes_[0].mark});
    for (std::uint32_t at = 0; at < list.size(); ++at)
      for (const std::uint32_t child : children_[list[at].node])
        list.push_back(
            {.node = child, .parent = at, .row = list[at].row + 1, .mark = nodes_[child].mark});
    return list;
  }

  // At most `rows` (4 or more) rows. Empty leaves and equal subtrees of one parent become one
  // branch; the ways to all that is lit are open, or, if not even they fit, the one to the deepest
  // lit leaf; of the rest as much is opened, level by level, as `fits` allows.
  using Fits = std::function<bool(const std::vector<Branch>&)>;

  std::vector<Branch> condensed(std::uint32_t rows, const Fits& fits) const {
    std::vector<Branch> list;
    for (const bool all_lit : {true, false})
      for (const bool lone : {false, true}) {
        Opening opening = opening_for(rows, all_lit, lone);
        list = build(opening);
        if (!fits(list)) continue;
        if (!lone) open_rows(opening, list, fits);
        return list;
      }
    return list;
  }

  // The least that shows all that is lit: whatever else is folded.
  std::vector<Branch> least(std::uint32_t rows) const {
    return build(opening_for(rows, true, true));
  }

  // Is this node lit, or a leaf that holds a hit? It must be seen.
  bool must_be_seen(std::uint32_t node) const { return shown_[node]; }

 private:
  // What is open, and which part of the spine is left out.
  struct Opening {
    std::set<std::uint32_t> open;       // nodes whose children are shown
    std::vector<std::uint32_t> spine;   // nodes from the root to the leaf that stays open
    std::uint32_t hidden_from = kNone;  // positions in the spine that become one mark
    std::uint32_t hidden_to = kNone;
    std::uint32_t rows = 0;
    bool lone = false;  // what is not on a way that must be open shares one mark with its siblings
    std::set<std::uint32_t> ways;  // nodes on the ways that must be open

    bool on_spine(std::uint32_t node, std::uint32_t position) const {
      return position < spine.size() && spine[position] == node;
    }
  };

  void find_shown(const std::vector<BodyId>& hits) {
    if (is_nearly_all_lit(nodes_)) return;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const FrameNode& node = nodes_[i];
      const auto is_hit = [&](BodyId id) { return std::ranges::count(hits, id) > 0; };
      shown_[i] = node.mark == Mark::lit || (node.leaf && node.mark == Mark::passed &&
                                             std::ranges::any_of(node.bodies, is_hit));
    }
  }

  Opening opening_for(std::uint32_t rows, bool all_lit, bool lone) const {
    Opening opening;
    opening.rows = rows;
    opening.lone = lone;
    opening.spine = spine();
    const auto length = static_cast<std::uint32_t>(opening.spine.size());
    if (length > rows) {
      const std::uint32_t tail = rows >= 6 ? 3 : 2;
      opening.hidden_from = rows - tail - 1;
      opening.hidden_to = length - tail;
    }
    opening.ways.insert(opening.spine.begin(), opening.spine.end());
    for (std::uint32_t i = 0; all_lit && i < nodes_.size(); ++i)
      for (std::uint32_t at = shown_[i] ? i : kNone;
           at != kNone && (at == i || !opening.ways.contains(at)); at = nodes_[at].parent)
        if (nodes_[at].depth < rows) opening.ways.insert(at);
    for (const std::uint32_t node : opening.ways) {
      const bool on_spine = opening.on_spine(node, nodes_[node].depth);
      const bool has_room = nodes_[node].depth + 1 < rows && leads_on(node, opening);
      if (!nodes_[node].leaf && (on_spine || has_room)) opening.open.insert(node);
    }
    return opening;
  }

  // Does a way go on below the node?
  bool leads_on(std::uint32_t node, const Opening& opening) const {
    return std::ranges::any_of(children_[node],
                               [&](std::uint32_t child) { return opening.ways.contains(child); });
  }

  // To the deepest lit leaf; without one to the deepest leaf that holds too much; the first of
  // them.
  std::vector<std::uint32_t> spine() const {
    std::uint32_t end = kNone;
    const auto rank = [&](const FrameNode& node) {
      const int kind = node.mark == Mark::lit ? 2 : node.over_capacity ? 1 : 0;
      return std::pair{kind, node.depth};
    };
    for (std::uint32_t i = 0; i < nodes_.size(); ++i)
      if (rank(nodes_[i]).first > 0 && (end == kNone || rank(nodes_[end]) < rank(nodes_[i])))
        end = i;
    std::vector<std::uint32_t> path;
    for (; end != kNone; end = nodes_[end].parent) path.push_back(end);
    std::ranges::reverse(path);
    return path;
  }

  Branch branch_for(std::uint32_t node, std::uint32_t copies, const Opening& opening) const {
    Branch branch{.node = node, .copies = copies, .mark = nodes_[node].mark};
    if (nodes_[node].leaf && nodes_[node].bodies.empty() && copies > 1) {
      branch.kind = Branch::Kind::empties;
      branch.count = copies;
    } else if (!nodes_[node].leaf && !opening.open.contains(node)) {
      branch.kind = Branch::Kind::folded;
      branch.count = copies * size_[node] - 1;
      branch.copies = 1;
      branch.mark = mark_[node];
    }
    return branch;
  }

  std::vector<Branch> build(const Opening& opening) const {
    std::vector<Branch> list;
    if (nodes_.empty()) return list;
    list.push_back(branch_for(0, 1, opening));
    for (std::uint32_t at = 0; at < list.size(); ++at) add_children(at, opening, list);
    return list;
  }

  void add_children(std::uint32_t at, const Opening& opening, std::vector<Branch>& list) const {
    const Branch parent = list[at];
    const std::uint32_t depth = nodes_[parent.node].depth;
    const bool in_spine = opening.on_spine(parent.node, depth);
    const auto push = [&](Branch branch) {
      branch.parent = at;
      branch.row = parent.row + 1;
      branch.each = parent.each || parent.copies > 1;
      list.push_back(branch);
    };
    if (parent.kind == Branch::Kind::levels)
      return push(branch_for(opening.spine[opening.hidden_to], 1, opening));
    if (parent.kind != Branch::Kind::node || !opening.open.contains(parent.node)) return;

    Branch rest{.kind = Branch::Kind::folded, .copies = 0};  // siblings of a way's nodes in one
    std::vector<bool> taken(children_[parent.node].size());
    for (std::size_t i = 0; i < taken.size(); ++i) {
      if (taken[i]) continue;
      const std::uint32_t child = children_[parent.node][i];
      const bool spine_child = in_spine && opening.on_spine(child, depth + 1);
      if (spine_child && depth + 1 == opening.hidden_from) {
        push({.kind = Branch::Kind::levels,
              .node = child,
              .count = opening.hidden_to - opening.hidden_from,
              .mark = nodes_[child].mark});
        continue;
      }
      if (opening.lone && opening.ways.contains(parent.node) && !opening.ways.contains(child)) {
        if (rest.count == 0) rest.node = child;
        rest.count += size_[child];
        rest.mark = std::max(rest.mark, mark_[child]);
        continue;
      }
      std::uint32_t copies = 0;
      for (std::size_t j = i; j < taken.size(); ++j) {
        if (taken[j] || shape_[children_[parent.node][j]] != shape_[child]) continue;
        taken[j] = true;
        ++copies;
      }
      push(branch_for(child, copies, opening));
    }
    if (rest.count > 0) push(rest);
  }

  // Level by level: the whole level if it fits, otherwise branch by branch.
  void open_rows(Opening& opening, std::vector<Branch>& list, const Fits& fits) const {
    constexpr std::size_t kMostTries = 48;  // branches one by one, a bound on the layouts made
    std::size_t tries = 0;
    for (std::uint32_t row = 0; row + 1 < opening.rows; ++row) {
      std::vector<Branch> closed;
      for (const Branch& branch : list)
        if (branch.row == row && branch.kind == Branch::Kind::folded) closed.push_back(branch);
      const Opening before = opening;
      for (const Branch& branch : closed) opening.open.insert(branch.node);
      std::vector<Branch> opened = build(opening);
      if (fits(opened)) {
        list = std::move(opened);
        continue;
      }
      opening = before;
      // Not what was merely passed: that changes from frame to frame, and the diagram with it.
      std::ranges::stable_partition(closed, [](const Branch& b) { return b.mark == Mark::lit; });
      for (const Branch& branch : closed) {
        if (++tries > kMostTries) return;
        opening.open.insert(branch.node);
        opened = build(opening);
        if (fits(opened))
          list = std::move(opened);
        else
          opening.open.erase(branch.node);
      }
    }
  }

  const std::vector<FrameNode>& nodes_;

  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<std::uint32_t> size_;   // nodes of each subtree
  std::vector<Mark> mark_;            // the strongest of each subtree
  std::vector<std::uint64_t> shape_;  // equal for subtrees that look alike
  std::vector<bool> shown_;           // nodes that must be seen
};

}  // namespace lantern::draw
