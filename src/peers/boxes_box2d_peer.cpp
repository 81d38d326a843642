// Box2D's dynamic tree: single precision, boxes enlarged as Box2D does.
#include <algorithm>

#include <box2d/b2_dynamic_tree.h>

#include "measure/box_peer.hpp"
#include "peers/single_box.hpp"

namespace lantern::peers {
namespace {

using measure::Boxes;

b2AABB to_box2d(const Box<2>& box) {
  b2AABB aabb;
  aabb.lowerBound = {float_below(box.lo.x), float_below(box.lo.y)};
  aabb.upperBound = {float_above(box.hi.x), float_above(box.hi.y)};
  return aabb;
}

b2Vec2 way(const Box<2>& from, const Box<2>& to) {
  const Vec<2> way = to.center() - from.center();
  return {static_cast<float>(way.x), static_cast<float>(way.y)};
}

// A tree with one leaf a body.
class Tree {
 public:
  void fill(Boxes<2> boxes) {
    for (const Proxy<2>& body : boxes)
      leaves_.push_back(tree_.CreateProxy(
          to_box2d(body.box), reinterpret_cast<void*>(static_cast<std::uintptr_t>(body.id))));
  }
  bool is_empty() const { return leaves_.empty(); }

  // Whether its leaf was put elsewhere.
  bool move(const Proxy<2>& body, const Box<2>& from) {
    return tree_.MoveProxy(leaves_[body.id], to_box2d(body.box), way(from, body.box));
  }
  b2AABB enlarged(BodyId body) const { return tree_.GetFatAABB(leaves_[body]); }
  BodyId body_of(int32 leaf) const {
    return static_cast<BodyId>(reinterpret_cast<std::uintptr_t>(tree_.GetUserData(leaf)));
  }

  template <class F>
  void query(const b2AABB& box, F&& f) const {
    struct Callback {
      const Tree& tree;
      F& f;
      bool QueryCallback(int32 leaf) {
        f(tree.body_of(leaf));
        return true;
      }
    } callback{*this, f};
    tree_.Query(&callback, box);
  }

 private:
  b2DynamicTree tree_;
  std::vector<int32> leaves_;  // of each body
};

// Leaves are moved, and then each body asks the tree.
class Asking : public measure::PairFinder<2> {
 public:
  void find(Boxes<2> boxes, std::vector<Pair>& pairs) override {
    if (tree_.is_empty())
      tree_.fill(boxes);
    else
      for (const Proxy<2>& body : boxes)
        if (!body.is_static) tree_.move(body, last_[body.id].box);
    last_.assign(boxes.begin(), boxes.end());
    for (const Proxy<2>& body : boxes) {
      if (body.is_static) continue;
      tree_.query(to_box2d(body.box), [&](BodyId other) {
        if (other <= body.id && (other == body.id || !boxes[other].is_static)) return;
        if (overlap(body.box, boxes[other].box))
          pairs.push_back({std::min(body.id, other), std::max(body.id, other)});
      });
    }
  }

 private:
  Tree tree_;
  std::vector<Proxy<2>> last_;
};

// As b2BroadPhase does it: only those ask whose leaves were put elsewhere, with their enlarged
// boxes; pairs of which neither was stay.
class Keeping : public measure::PairFinder<2> {
 public:
  void find(Boxes<2> boxes, std::vector<Pair>& pairs) override {
    renew(boxes);
    std::erase_if(kept_, [&](const Pair& pair) { return moved_[pair.a] || moved_[pair.b]; });
    for (const Proxy<2>& body : boxes) {
      if (!moved_[body.id]) continue;
      tree_.query(tree_.enlarged(body.id), [&](BodyId other) {
        if (other == body.id || (moved_[other] && other > body.id)) return;
        if (body.is_static && boxes[other].is_static) return;
        kept_.push_back({std::min(body.id, other), std::max(body.id, other)});
      });
    }
    for (const Pair& pair : kept_)
      if (overlap(boxes[pair.a].box, boxes[pair.b].box)) pairs.push_back(pair);
  }

 private:
  void renew(Boxes<2> boxes) {
    if (tree_.is_empty()) {
      tree_.fill(boxes);
      moved_.assign(boxes.size(), true);
    } else {
      for (const Proxy<2>& body : boxes)
        moved_[body.id] = !body.is_static && tree_.move(body, last_[body.id].box);
    }
    last_.assign(boxes.begin(), boxes.end());
  }

  Tree tree_;
  std::vector<Proxy<2>> last_;
  std::vector<char> moved_;
  std::vector<Pair> kept_;  // whose enlarged boxes overlap
};

}  // namespace
extern "C" void lantern_box_peers(std::vector<BoxPeer>& peers) {
  peers.push_back({.name = "Box2D",
                   .version = LANTERN_PEER_VERSION,
                   .how = "b2DynamicTree with Box2D's own margins; each body asks the tree, or as "
                          "in b2BroadPhase only those that left their enlarged boxes do",
                   .settings = {"all ask", "those that left their boxes ask"},
                   .pairs_2d = [](std::size_t setting) -> std::unique_ptr<PairFinder<2>> {
                     if (setting == 0) return std::make_unique<Asking>();
                     return std::make_unique<Keeping>();
                   }});
}

}  // namespace lantern::peers
