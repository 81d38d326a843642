// Lantern with a quadtree of one's own: `my_tree render mine.toml` draws it, `my_tree structure
// check mine` holds it against brute force on random worlds, `my_tree structure bench` times it.
// All other commands are Lantern's: every scenario may say kind = "mine", and panels = ["speeds"]
// (speeds.hpp).
//
// As a project of its own, with Lantern installed:
//   cmake -B build && cmake --build build && build/my_tree structure check mine
#include <lantern/app/program.hpp>

#include "quad_tree.hpp"
#include "speeds.hpp"
#include "wrong_tree.hpp"

namespace spatial = lantern::spatial;

// Between a tree and Lantern: `insert`, and `visit`, which tells each node before its children.
template <class Tree>
class Adaptor {
 public:
  Adaptor(const spatial::Box<2>& world, unsigned capacity, unsigned max_depth)
      : tree_(rect(world), capacity, max_depth) {}

  void insert(unsigned id, const spatial::Box<2>& box) { tree_.insert(id, rect(box)); }

  void visit(const spatial::NodeSink& tell) const { visit(tree_.root, tell); }

 private:
  static Rect rect(const spatial::Box<2>& b) { return {b.lo.x, b.lo.y, b.hi.x, b.hi.y}; }

  template <class Node>
  static void visit(const Node& node, const spatial::NodeSink& tell) {
    const Rect& r = node.rect;
    std::vector<unsigned> ids;
    for (const Entry& entry : node.entries) ids.push_back(entry.id);
    tell({{{r.left, r.bottom}, {r.right, r.top}}, node.depth, node.children.empty(), ids});
    for (const auto& child : node.children) visit(*child, tell);
  }

  Tree tree_;
};

int main(int argc, char** argv) {
  return lantern::app::run_program(
      argc, argv,
      {spatial::own<Adaptor<QuadTree>>("mine", "my quadtree"),
       spatial::own<Adaptor<WrongTree>>("wrong", "my quadtree, with a mistake")},
      {speeds_panel()});
}
