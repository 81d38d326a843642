// The lecture's QuadTreeNode and QuadTree. It lies flat in x and z, as in the text.
//
//   +-------+-------+
//   |   0   |   1   |   z      A node's `size` is half of its width and depth, as in the text: a
//   +-------+-------+   ^      tree of size (1024, 1024) reaches from -1024 to 1024.
//   |   2   |   3   |   |
//   +-------+-------+   +-> x
//
// It allocates once for each object in each leaf and once for each split: the naive way, against
// which the others are measured.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <list>
#include <utility>
#include <vector>

#include "lecture/collision_detection.hpp"

namespace lantern::lecture {

template <class T>
class QuadTree;

template <class T>
struct QuadTreeEntry {
  Vector3 pos;
  Vector3 size;
  T object;

  QuadTreeEntry(T obj, const Vector3& objPos, const Vector3& objSize)
      : pos(objPos), size(objSize), object(obj) {}
};

// Added: a watcher is told of these five things while the tree grows; pictures and counts need
// them. This one ignores them all, and the calls compile to nothing.
struct NobodyWatches {
  template <class Node, class T>
  void Tested(const Node&, const T&, bool /*reached*/) {}
  template <class Node, class T>
  void Stored(const Node&, const T&, int /*depthLeft*/) {}
  template <class Node, class T>
  void HandedDown(const Node&, const T&) {}
  template <class Node, class T>
  void Split(const Node&, const T& /*last*/, int /*depthLeft*/) {}
  template <class Node>
  void Made(Node&) {}
};

template <class T>
class QuadTreeNode {
 public:
  using QuadTreeFunc = std::function<void(std::list<QuadTreeEntry<T>>&)>;
  using QuadTreeReader = std::function<void(const std::list<QuadTreeEntry<T>>&)>;

  QuadTreeNode() = default;
  QuadTreeNode(const Vector2& nodePos, const Vector2& nodeSize)
      : position(nodePos), size(nodeSize) {}

  template <class Watch>
  void Insert(const T& object, const Vector3& objectPos, const Vector3& objectSize, int depthLeft,
              int maxSize, Watch& watch) {
    const bool reached = Reached(objectPos, objectSize);
    watch.Tested(*this, object, reached);
    if (!reached) return;
    if (!children.empty()) {  // not a leaf node, just descend the tree
      for (int i = 0; i < 4; ++i)
        children[i].Insert(object, objectPos, objectSize, depthLeft - 1, maxSize, watch);
    } else {  // currently a leaf node, can just expand
      contents.push_back(QuadTreeEntry<T>(object, objectPos, objectSize));
      watch.Stored(*this, object, depthLeft);
      if (static_cast<int>(contents.size()) > maxSize && depthLeft > 0) {
        watch.Split(*this, object, depthLeft);
        Split(watch);
        // we need to reinsert the contents so far!
        for (const auto& entry : contents) {
          watch.HandedDown(*this, entry.object);
          for (int j = 0; j < 4; ++j)
            children[j].Insert(entry.object, entry.pos, entry.size, depthLeft - 1, maxSize, watch);
        }
        contents.clear();  // contents now distributed!
      }
    }
  }

  template <class Watch>
  void Split(Watch& watch) {
    const Vector2 halfSize = size / 2.0;
    children.resize(4);
    children[0] = QuadTreeNode<T>(position + Vector2(-halfSize.x, halfSize.y), halfSize);
    watch.Made(children[0]);
    children[1] = QuadTreeNode<T>(position + Vector2(halfSize.x, halfSize.y), halfSize);
    watch.Made(children[1]);
    children[2] = QuadTreeNode<T>(position + Vector2(-halfSize.x, -halfSize.y), halfSize);
    watch.Made(children[2]);
    children[3] = QuadTreeNode<T>(position + Vector2(halfSize.x, -halfSize.y), halfSize);
    watch.Made(children[3]);
  }

  void OperateOnContents(const QuadTreeFunc& func) {
    if (!children.empty()) {
      for (int i = 0; i < 4; ++i) children[i].OperateOnContents(func);
    } else {
      if (!contents.empty()) func(contents);
    }
  }

  // Added, from the text's "Further Work 4": visits only the leaves into which such an object
  // would be inserted, without inserting it.
  void OperateOnContents(const QuadTreeReader& func, const Vector3& objectPos,
                         const Vector3& objectSize) const {
    if (!Reached(objectPos, objectSize)) return;
    if (children.empty()) return func(contents);
    for (int i = 0; i < 4; ++i) children[i].OperateOnContents(func, objectPos, objectSize);
  }

  // Added: for drawing and counting what is inside.
  const std::vector<QuadTreeNode<T>>& GetChildren() const { return children; }
  std::vector<QuadTreeNode<T>>& GetChildren() { return children; }
  const std::list<QuadTreeEntry<T>>& GetContents() const { return contents; }
  // Added: for the watcher to set, below 0 until then; the tree does not use it.
  int number = -1;

 protected:
  friend class QuadTree<T>;

  // Mended: the text gives every node a half height of 1000 and drops whatever is above or below.
  // Here nodes are unbounded along y.
  bool Reached(const Vector3& objectPos, const Vector3& objectSize) const {
    return CollisionDetection::AABBTest(
        objectPos, Vector3(position.x, 0, position.y), objectSize,
        Vector3(size.x, std::numeric_limits<double>::infinity(), size.y));
  }

  std::list<QuadTreeEntry<T>> contents;

  Vector2 position{0.0};
  Vector2 size{0.0};

  // Four, or none in a leaf. Mended: the text has a QuadTreeNode<T>* from `new` that is never
  // deleted, so every frame leaks a tree, and its default constructor leaves the pointer unset. A
  // std::vector allocates just the same, once for all four, and frees them.
  std::vector<QuadTreeNode<T>> children;
};

template <class T>
class QuadTree {
 public:
  // Added: `position`, the centre of the tree; in the text that is the origin. Depths above 32 are
  // not supported. Added: `printed`, for the text's own way with what lies outside.
  explicit QuadTree(const Vector2& size, int depth = 6, int sizeOfNode = 5,
                    const Vector2& position = Vector2(0.0), bool printed = false) {
    root = QuadTreeNode<T>(position, size);
    maxDepth = depth;
    maxSize = sizeOfNode;
    asPrinted = printed;
  }

  template <class Watch = NobodyWatches>
  void Insert(const T& object, const Vector3& pos, const Vector3& size, Watch&& watch = {}) {
    const auto [clampedPos, clampedSize] = Clamped(pos, size);
    root.Insert(object, clampedPos, clampedSize, maxDepth, maxSize, watch);
  }

  void OperateOnContents(const typename QuadTreeNode<T>::QuadTreeFunc& func) {
    root.OperateOnContents(func);
  }
  void OperateOnContents(const typename QuadTreeNode<T>::QuadTreeReader& func, const Vector3& pos,
                         const Vector3& size) const {
    const auto [clampedPos, clampedSize] = Clamped(pos, size);
    root.OperateOnContents(func, clampedPos, clampedSize);
  }

  const QuadTreeNode<T>& GetRoot() const { return root; }

 protected:
  // Mended: the text drops an object outside the root's square, and it never collides. Here its box
  // is clamped to the square, so that it ends up in leaves at the rim. Clamping keeps the order of
  // ends, so two boxes that overlap outside still share a leaf.
  //
  // Mended: node centres and box ends are rounded sums, and rounding may open a gap between two
  // neighbours into which a small object falls. A tiny margin closes it: a centre is off by at most
  // half a unit in the last place of the root's largest coordinate per level.
  std::pair<Vector3, Vector3> Clamped(Vector3 pos, Vector3 size) const {
    if (asPrinted) return {pos, size};
    for (const auto& [axis, rootAxis] : {std::pair(0, 0), std::pair(2, 1)}) {
      const double at = root.position[rootAxis], half = root.size[rootAxis];
      const double reach = size[axis] + kMargin * (std::abs(pos[axis]) + size[axis]);
      const double lo = std::clamp(pos[axis] - reach, at - half, at + half);
      const double hi = std::clamp(pos[axis] + reach, at - half, at + half);
      pos[axis] = lo * 0.5 + hi * 0.5;
      size[axis] = (hi - lo) * 0.5 + kMargin * (std::abs(at) + half) + kLeastMargin;
    }
    return {pos, size};
  }
  static constexpr double kMargin = 64 * std::numeric_limits<double>::epsilon();
  static constexpr double kLeastMargin =
      std::numeric_limits<double>::min();  // where kMargin underflows

  QuadTreeNode<T> root;  // Mended: the text declares a pointer and uses it as a value

  int maxDepth = 6;
  int maxSize = 5;
  bool asPrinted = false;
};

}  // namespace lantern::lecture
