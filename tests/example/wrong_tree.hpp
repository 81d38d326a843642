// The same quadtree with a mistake that is easily made: a child is chosen by where the middle of a
// body lies, so that a body across a border goes to one side only, and whom it meets on the other
// is never tested. `my_tree structure check wrong` finds it.
#pragma once

#include <memory>
#include <vector>

#include "quad_tree.hpp"

class WrongNode {
 public:
  WrongNode(const Rect& cell, unsigned level) : rect(cell), depth(level) {}

  void insert(const Entry& entry, unsigned capacity, unsigned max_depth) {
    if (!children.empty()) return child_of(entry.rect).insert(entry, capacity, max_depth);
    entries.push_back(entry);
    if (entries.size() > capacity && depth < max_depth) split(capacity, max_depth);
  }

  Rect rect;
  unsigned depth;
  std::vector<Entry> entries;
  std::vector<std::unique_ptr<WrongNode>> children;

 private:
  WrongNode& child_of(const Rect& r) {
    const bool right = (r.left + r.right) / 2 > (rect.left + rect.right) / 2;
    const bool lower = (r.bottom + r.top) / 2 <= (rect.bottom + rect.top) / 2;
    return *children[(lower ? 2 : 0) + (right ? 1 : 0)];
  }

  void split(unsigned capacity, unsigned max_depth) {
    const double x = (rect.left + rect.right) / 2, y = (rect.bottom + rect.top) / 2;
    for (const Rect& quarter :
         {Rect{rect.left, y, x, rect.top}, Rect{x, y, rect.right, rect.top},
          Rect{rect.left, rect.bottom, x, y}, Rect{x, rect.bottom, rect.right, y}})
      children.push_back(std::make_unique<WrongNode>(quarter, depth + 1));
    const std::vector<Entry> waiting = std::move(entries);
    entries.clear();
    for (const Entry& entry : waiting) child_of(entry.rect).insert(entry, capacity, max_depth);
  }
};

class WrongTree {
 public:
  WrongTree(const Rect& world, unsigned node_capacity, unsigned depth_limit)
      : root(world, 0), capacity(node_capacity), max_depth(depth_limit) {}

  void insert(unsigned id, const Rect& rect) { root.insert({id, rect}, capacity, max_depth); }

  WrongNode root;
  unsigned capacity, max_depth;
};
