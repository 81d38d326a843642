// Bring your own structure: a tree of your own, in C++, as one more kind that every scenario may
// ask for, drawn, checked and timed as ours are. tests/example/ is a whole project that does it.
//
//   struct MyTree {                            // the adaptor: some 30 lines
//     QuadTree tree;                           // your class
//     MyTree(const Box<2>& bounds, unsigned capacity, unsigned max_depth);
//     void insert(BodyId id, const Box<2>& box);
//     void visit(const NodeSink& f) const;     // f(OwnNode{...}) for each node
//     void clear();                            // if you like; else a new one is made instead
//     void pairs(const PairSink& f) const;     // if you like: your own search, f(a, b) for each
//                                              // pair to test; else all that share a leaf
//     void ray(Vec<2> from, Vec<2> to, const BodySink& f) const;  // if you like: f(id) for each
//                                                                 // body to test; else who lies
//                                                                 // in leaves that the ray meets
//   };
//   int main(int argc, char** argv) {        // app/program.hpp
//     return lantern::app::run_program(argc, argv, {own<MyTree>("mine", "my quadtree")});
//   }
//
// What your tree must do is what the lecture's does. Its root is the world, or larger; children lie
// within their parent and do not overlap. Bodies lie in leaves only, and each in every leaf that it
// reaches; touching is reaching, but which of two leaves has a body that only touches the border
// between them is up to you, as long as two bodies that touch share a leaf. No node lies deeper
// than `max_depth`. Boxes come cut to the bounds: what lies outside the world lies on its border.
//
// `visit` tells each node before its children, and each child with all that lies below it before
// the next. Everything else is worked out from that: parents, events, counts, queries, the order
// along a ray. Nothing it says is believed: see own_view.hpp for what is looked at, and how it is
// told. `structure check` and `structure bench` try it in a process of its own, so that what
// crashes or never returns is told as well; in a scenario nobody can catch that.
#pragma once

#include <concepts>
#include <utility>

#include "spatial/structure.hpp"

namespace lantern::spatial {

// A node, as your tree tells it.
struct OwnNode {
  Box<2> box;                           // its bounds
  std::uint32_t depth = 0;              // the root has 0, its children 1
  bool leaf = true;                     // it has no children
  std::span<const BodyId> bodies = {};  // of a leaf, in any order; read before the call returns
};
using NodeSink = std::function<void(const OwnNode&)>;
using PairSink = std::function<void(BodyId, BodyId)>;
using BodySink = std::function<void(BodyId)>;

// An adaptor, whatever its type is.
class OwnTree {
 public:
  virtual ~OwnTree() = default;
  virtual void insert(BodyId id, const Box<2>& box) = 0;
  virtual void visit(const NodeSink& f) const = 0;
  // Forgets all bodies; false if it cannot.
  virtual bool clear() = 0;
  // A search of its own: each pair, or body, once or more often. False if it has none.
  virtual bool pairs(const PairSink&) const { return false; }
  virtual bool ray(const Vec<2>&, const Vec<2>&, const BodySink&) const { return false; }
};

template <class A>
concept OwnAdaptor = std::constructible_from<A, Box<2>, std::uint32_t, std::uint32_t> &&
    requires(A tree, const A seen, Box<2> box, NodeSink f) {
  tree.insert(BodyId{}, box);
  seen.visit(f);
};

// The box as a tree is told it: what of it lies in these bounds; what lies outside lies on their
// border.
inline Box<2> clamped(const Box<2>& box, const Box<2>& to) {
  return {glm::clamp(box.lo, to.lo, to.hi), glm::clamp(box.hi, to.lo, to.hi)};
}

// A kind of structure that this program was given.
struct OwnKind {
  std::string name;   // "mine", for scenarios: of a–z, 0–9 and _
  std::string words;  // "my quadtree", for people
  std::function<std::unique_ptr<OwnTree>(const Box<2>& bounds, std::uint32_t capacity,
                                         std::uint32_t max_depth)>
      make;
  bool is_optimized = true;  // as it was compiled
};

// In a world of three dimensions it looks at x and z only, as the lecture's quadtree does, and is
// asked for no pairs and rays.
template <OwnAdaptor A>
OwnKind own(std::string name, std::string words) {
  class Tree : public OwnTree {
   public:
    Tree(const Box<2>& bounds, std::uint32_t capacity, std::uint32_t max_depth)
        : adaptor_(bounds, capacity, max_depth) {}
    void insert(BodyId id, const Box<2>& box) override { adaptor_.insert(id, box); }
    void visit(const NodeSink& f) const override { adaptor_.visit(f); }
    bool clear() override {
      if constexpr (requires(A a) { a.clear(); }) {
        adaptor_.clear();
        return true;
      } else {
        return false;
      }
    }
    bool pairs(const PairSink& f) const override {
      if constexpr (requires(const A a) { a.pairs(f); }) return adaptor_.pairs(f), true;
      return false;
    }
    bool ray(const Vec<2>& from, const Vec<2>& to, const BodySink& f) const override {
      if constexpr (requires(const A a) { a.ray(from, to, f); })
        return adaptor_.ray(from, to, f), true;
      return false;
    }

   private:
    A adaptor_;
  };
#if defined(__OPTIMIZE__)
  constexpr bool optimized = true;
#else
  constexpr bool optimized = false;
#endif
  return {std::move(name), std::move(words),
          [](const Box<2>& bounds, std::uint32_t capacity, std::uint32_t max_depth) {
            return std::make_unique<Tree>(bounds, capacity, max_depth);
          },
          optimized};
}

// From now on this program knows these kinds, too. To be called once, before anything else: what
// was read or made earlier does not know them. Throws Refused for a name that is not of a–z, 0–9
// and _ or that is taken.
void know_own_structures(std::vector<OwnKind> kinds);

// A structure of a user's own among ours: one type for all of them, since only the program that was
// given one knows what it is.

// Null for one of ours.
const OwnKind* own_structure(StructureKind kind);

// An empty one. In three dimensions it looks at x and z only. Whatever goes wrong in the tree is
// thrown, as a StructureFault, by the next insert or look; the structure must be cleared then. Who
// watches is told what must have happened, when it has.
template <int D>
std::unique_ptr<Structure<D>> own_tree(const OwnKind& kind, const StructureConfig<D>& config);

}  // namespace lantern::spatial
