// Islands: bodies that hang together by contacts, joints and springs, and so must be moved together
// and can only fall asleep together.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace lantern::physics {

// Union-find (Galler and Fischer, "An improved equivalence algorithm", 1964), with path halving.
// The root of a set is always its lowest member, so that nothing depends on the order of uniting.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    for (std::size_t i = 0; i < count; ++i) parent_[i] = static_cast<std::uint32_t>(i);
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a > b) std::swap(a, b);
    parent_[b] = a;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace lantern::physics
