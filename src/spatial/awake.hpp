// Which nodes are awake (the lecture, "Sleeping Objects"): those below which an awake body lies.
#pragma once

#include <algorithm>
#include <vector>

#include "spatial/structure.hpp"

namespace lantern::spatial {

class AwakeNodes {
 public:
  // Looks at all nodes of the structure; `awake(id) -> bool`. Memory, `room` too, is used again.
  // Children are visited after their parents, so one way back through the list wakes all that lie
  // above.
  template <class Structure, class Awake>
  void find(const Structure& structure, Awake&& awake, std::vector<BodyId>& room) {
    parents_.clear();
    handles_.clear();
    awake_.assign(structure.counters().nodes, 0);
    structure.visit(
        [&](const auto& node) {
          parents_.push_back(node.parent);
          handles_.push_back(node.handle);
          // There are gaps while bodies are on their way from one place to another.
          if (node.handle >= awake_.size()) awake_.resize(node.handle + std::size_t{1});
          awake_[node.handle] = std::any_of(node.bodies.begin(), node.bodies.end(), awake);
          return true;
        },
        room);
    for (std::size_t i = handles_.size(); i-- > 1;)
      if (awake_[handles_[i]] != 0) awake_[handles_[parents_[i]]] = 1;
  }

  bool operator[](NodeHandle node) const { return awake_[node] != 0; }
  std::size_t places() const {
    return awake_.capacity() + parents_.capacity() + handles_.capacity();
  }

 private:
  std::vector<std::uint8_t> awake_;               // by handle
  std::vector<std::uint32_t> parents_, handles_;  // in the order of visiting
};

}  // namespace lantern::spatial
