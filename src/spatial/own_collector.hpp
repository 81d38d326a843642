// Takes down what the tree tells, node by node, and stops it where it cannot be read as a tree.
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "spatial/own_view.hpp"

namespace lantern::spatial {

class OwnCollector {
 public:
  OwnCollector(OwnView& view, const OwnRules& rules, std::size_t bodies)
      : view_(view), rules_(rules), all_bodies_(bodies) {}

  // Throws StructureFault for what cannot be read as a tree, and for what the tree throws itself.
  void collect(const OwnTree& tree);

 private:
  void take(const OwnNode& told);
  std::uint32_t parent_of(const OwnNode& told) const;
  void take_bodies(const OwnNode& told, OwnView::Node& node);
  void close_to(std::size_t depth);
  void put_in_order();
  void name_children(std::uint32_t parent, std::vector<std::uint32_t>& children);
  [[noreturn]] void refuse(const std::string& text) const;
  std::string told_way(std::uint32_t parent) const;

  OwnView& view_;
  const OwnRules& rules_;
  std::size_t all_bodies_;
  std::vector<std::uint32_t> way_;       // from the root to the last node
  std::vector<std::uint32_t> children_;  // of each node so far
  std::exception_ptr thrown_;            // by us, through the tree's own code
};

}  // namespace lantern::spatial
