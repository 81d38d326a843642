// A student's quadtree, as one might write it for the course: nothing in it knows of Lantern.
#pragma once

#include <memory>
#include <vector>

struct Rect {
  double left, bottom, right, top;
  bool touches(const Rect& other) const {
    return left <= other.right && other.left <= right && bottom <= other.top && other.bottom <= top;
  }
};

struct Entry {
  unsigned id;
  Rect rect;
};

class QuadNode {
 public:
  QuadNode(const Rect& cell, unsigned level) : rect(cell), depth(level) {}

  void insert(const Entry& entry, unsigned capacity, unsigned max_depth) {
    if (!rect.touches(entry.rect)) return;
    if (children.empty()) {
      entries.push_back(entry);
      if (entries.size() > capacity && depth < max_depth) split(capacity, max_depth);
      return;
    }
    for (auto& child : children) child->insert(entry, capacity, max_depth);
  }

  Rect rect;
  unsigned depth;
  std::vector<Entry> entries;                       // of a leaf
  std::vector<std::unique_ptr<QuadNode>> children;  // none, or four

 private:
  void split(unsigned capacity, unsigned max_depth) {
    const double x = (rect.left + rect.right) / 2, y = (rect.bottom + rect.top) / 2;
    for (const Rect& quarter :
         {Rect{rect.left, y, x, rect.top}, Rect{x, y, rect.right, rect.top},
          Rect{rect.left, rect.bottom, x, y}, Rect{x, rect.bottom, rect.right, y}})
      children.push_back(std::make_unique<QuadNode>(quarter, depth + 1));
    for (const Entry& entry : entries)
      for (auto& child : children) child->insert(entry, capacity, max_depth);
    entries.clear();
  }
};

class QuadTree {
 public:
  QuadTree(const Rect& world, unsigned node_capacity, unsigned depth_limit)
      : root(world, 0), capacity(node_capacity), max_depth(depth_limit) {}

  void insert(unsigned id, const Rect& rect) { root.insert({id, rect}, capacity, max_depth); }

  QuadNode root;
  unsigned capacity, max_depth;
};
