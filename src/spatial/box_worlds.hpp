// Seeded worlds of boxes, of the sorts that tell structures apart, and the pairs that there are in
// them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "spatial/broad_phase.hpp"

namespace lantern::spatial {

// The boxes' ids are their places in the list, from 0. All updates have equally many.
template <int D>
struct BoxUpdates {
  Box<D> bounds;                              // of trees' roots
  std::vector<std::vector<Proxy<D>>> frames;  // one after another; more than one if they move
};

enum class BoxSort { uniform, clustered, one_huge, in_line, moving };

// The same boxes on every machine.
template <int D>
BoxUpdates<D> seeded_boxes(BoxSort sort, std::size_t bodies, std::uint64_t seed);

// Which pairs of one update overlap, in order: all with all, in which not both are static.
template <int D>
std::vector<Pair> pairs_by_force(std::span<const Proxy<D>> boxes);

// How many of `truth` are not in `found`. Both in order and without repeats.
std::uint64_t count_missing(std::span<const Pair> truth, std::span<const Pair> found);

}  // namespace lantern::spatial
