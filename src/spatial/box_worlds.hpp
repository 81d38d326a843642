// Seeded worlds of boxes, of the sorts that tell structures apart, and the pairs that there are in
// them.
#pragma once

#include "spatial/broad_phase.hpp"

namespace lantern::spatial {

// The boxes' ids are their places in the list, from 0. All updates have equally many.
template <int D>
struct BoxUpdates {
  Box<D> bounds;                              // of trees' roots
  std::vector<std::vector<Proxy<D>>> frames;  // one after another; more than one if they move
};

// Of coincident ones half lie in heaps of a dozen, of which all are the same.
enum class BoxSort { uniform, clustered, one_huge, in_line, moving, coincident };

// The same boxes on every machine.
template <int D>
BoxUpdates<D> seeded_boxes(BoxSort sort, std::size_t bodies, std::uint64_t seed);

// Which pairs of one update overlap, in order: all with all, in which not both are static.
template <int D>
std::vector<Pair> pairs_by_force(std::span<const Proxy<D>> boxes);

// How many of `truth` are not in `found`. Both in order and without repeats.
std::uint64_t count_missing(std::span<const Pair> truth, std::span<const Pair> found);

// --- small ones, on which a structure is tried ---

struct TrialBody {
  Vec<2> center{0.0};
  Vec<2> half{0.0};
  bool operator==(const TrialBody&) const = default;
};

// Bodies are called b1, b2, … in their order.
struct TrialWorld {
  std::string_view sort;  // "clustered"
  Box<2> bounds;
  std::uint32_t capacity = 1;
  std::uint32_t max_depth = 1;
  std::vector<TrialBody> bodies;
  std::vector<TrialBody> moved;  // where they are next; empty: they stay
};

// The `number`-th world of this seed; all sorts in turn.
TrialWorld trial_world(std::uint64_t seed, std::uint64_t number);

}  // namespace lantern::spatial
