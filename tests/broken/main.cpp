// Trees as a first attempt leaves them: each is right until two bodies coincide, and then hangs,
// follows a null pointer, or splits for ever. For the tests of `structure check` and `bench`.
#include <iostream>
#include <memory>
#include <vector>

#include <lantern/app/program.hpp>

namespace spatial = lantern::spatial;

struct Node {
  std::vector<spatial::Box<2>> boxes;
  std::unique_ptr<Node> child;
};

volatile bool for_ever = true;

void hang(Node&) {
  while (for_ever) continue;
}
void follow_null(Node& node) { node.child->boxes.clear(); }
void split_for_ever(Node& node) {
  node.child = std::make_unique<Node>();
  node.child->boxes = node.boxes;
  split_for_ever(*node.child);
  node.boxes.clear();
}
void split_in_a_loop(Node& node) {
  for (Node* last = &node; for_ever; last = last->child.get()) {
    last->child = std::make_unique<Node>();
    last->child->boxes.resize(1000);
  }
}

// All bodies in the root, which is right, and what happens when two coincide.
template <void (*end)(Node&)>
class Broken {
 public:
  Broken(const spatial::Box<2>& world, unsigned, unsigned) : world_(world) {}
  void insert(unsigned id, const spatial::Box<2>& box) {
    for (const auto& other : root_.boxes)
      if (other == box) {
        std::cout << "two coincide" << std::endl;
        end(root_);
      }
    root_.boxes.push_back(box);
    ids_.push_back(id);
  }
  void visit(const spatial::NodeSink& tell) const { tell({world_, 0, true, ids_}); }

 private:
  spatial::Box<2> world_;
  Node root_;
  std::vector<unsigned> ids_;
};

int main(int argc, char** argv) {
  return lantern::app::run_program(
      argc, argv,
      {spatial::own<Broken<hang>>("hangs", "a tree that hangs"),
       spatial::own<Broken<follow_null>>("crashes", "a tree with a null child"),
       spatial::own<Broken<split_for_ever>>("splits", "a tree that splits for ever"),
       spatial::own<Broken<split_in_a_loop>>("fills", "a tree that fills the memory")});
}
