// Holds what a tree tells of itself against what it was told: a tree can be read, and still be
// wrong. Each fault is noted in the view.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "spatial/own_view.hpp"

namespace lantern::spatial {

class OwnInspection {
 public:
  // `boxes` are those of the bodies that were inserted, cut to the bounds.
  OwnInspection(OwnView& view, const OwnRules& rules, std::span<const Box<2>> boxes)
      : view_(view), rules_(rules), boxes_(boxes), leaves_(boxes.size()) {}

  void inspect();

 private:
  void inspect_cells();
  void inspect_siblings(std::uint32_t parent);
  void inspect_lists();
  bool is_listed_where_it_reaches(BodyId body);
  void require_covered(BodyId body);
  void inspect_pairs();
  bool share_a_leaf(BodyId a, BodyId b) const;
  std::string leaves_of(BodyId body) const;

  OwnView& view_;
  const OwnRules& rules_;
  std::span<const Box<2>> boxes_;
  std::vector<std::vector<std::uint32_t>> leaves_;  // that list each body; ascending
};

}  // namespace lantern::spatial
