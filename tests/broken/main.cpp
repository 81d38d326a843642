// Trees as a first attempt leaves them: each is right until two bodies coincide, and then hangs,
// follows a null pointer, or splits for ever; and one whose own searches are right, or lose what
// comes last; one that crashes after a while. For the tests of `structure check` and `bench`.
#include <iostream>
#include <memory>
#include <stdexcept>
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
    last->child->boxes.reserve(1'000'000);
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

// Right for as long as a trial lasts, and not for as long as turns do.
class Tiring : public Broken<hang> {
 public:
  using Broken::Broken;
  void insert(unsigned id, const spatial::Box<2>& box) {
    static int inserted = 0;
    if (++inserted > 100) follow_null(*std::make_unique<Node>());
    Broken::insert(id, box);
  }
};

// It never comes to the end of its destructor.
class Lingering : public Broken<hang> {
 public:
  using Broken::Broken;
  ~Lingering() {
    while (for_ever) continue;
  }
};

template <unsigned lost_pairs, unsigned lost_hits>
class Searching {
 public:
  Searching(const spatial::Box<2>& world, unsigned, unsigned) : world_(world) {}
  void insert(unsigned, const spatial::Box<2>& box) { boxes_.push_back(box); }
  void visit(const spatial::NodeSink& tell) const {
    std::vector<unsigned> ids(boxes_.size());
    for (unsigned i = 0; i < ids.size(); ++i) ids[i] = i;
    tell({world_, 0, true, ids});
  }
  void pairs(const spatial::PairSink& tell) const {
    if (lost_pairs == 2 && !boxes_.empty()) tell(0, 0);
    for (unsigned a = 0; a + lost_pairs < boxes_.size(); ++a)
      for (unsigned b = 0; b < a; ++b)
        if (overlap(boxes_[a], boxes_[b])) tell(a, b);
  }
  void ray(spatial::Vec<2>, spatial::Vec<2>, const spatial::BodySink& tell) const {
    for (unsigned i = 0; i + lost_hits < boxes_.size(); ++i) tell(i);
  }

 private:
  spatial::Box<2> world_;
  std::vector<spatial::Box<2>> boxes_;
};

class Unmade : public Searching<0, 0> {
 public:
  Unmade(const spatial::Box<2>& world, unsigned capacity, unsigned most)
      : Searching(world, capacity, most) {
    throw std::runtime_error("not yet written");
  }
};

int main(int argc, char** argv) {
  return lantern::app::run_program(
      argc, argv,
      {spatial::own<Broken<hang>>("hangs", "a tree that hangs"),
       spatial::own<Broken<follow_null>>("crashes", "a tree with a null child"),
       spatial::own<Broken<split_for_ever>>("splits", "a tree that splits for ever"),
       spatial::own<Broken<split_in_a_loop>>("fills", "a tree that fills the memory"),
       spatial::own<Tiring>("tires", "a tree that crashes after a while"),
       spatial::own<Lingering>("lingers", "a tree that does not go"),
       spatial::own<Unmade>("unmade", "a tree that cannot be made"),
       spatial::own<Searching<0, 0>>("searches", "a tree with searches of its own"),
       spatial::own<Searching<1, 0>>("loses_pairs", "a tree that loses pairs"),
       spatial::own<Searching<2, 0>>("pairs_itself", "a tree that pairs a body with itself"),
       spatial::own<Searching<0, 1>>("loses_hits", "a tree that loses hits")});
}
