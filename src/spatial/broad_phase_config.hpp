// What a broad phase is told when it is made, and what it counts.
#pragma once

#include "spatial/structure.hpp"

namespace lantern::spatial {

template <int D>
struct BroadPhaseConfig : StructureConfig<D> {
  StructureKind kind = D == 3 ? StructureKind::octree : StructureKind::quadtree;
  bool split_static = true;  // static bodies in a structure of their own
  Build build = Build::one_by_one;
  // That may look for pairs at the same time, where there are enough of them; the pairs and their
  // order are the same for any number. To start threads takes memory anew each time.
  unsigned threads = 1;
  bool mends = true;  // the pairs of the step before, if `automatic`: see BroadPhase::follow
  // Whether a tree that would grow out of proportion (more than 64 entries a body: many bodies
  // larger than most cells) is built with half of its depth instead, again and again until it does
  // not. Else the depth is as configured, and a tree of more than `most_entries` is refused.
  bool in_proportion = true;
  // Of overlaps met, each once for each leaf that both bodies share.
  std::uint64_t most_pairs = std::uint64_t{1} << 26;
};

struct BroadPhaseCounters {
  // Since the broad phase was made.
  std::uint64_t static_builds = 0;
  std::uint64_t dynamic_builds = 0;
  std::uint64_t entries_made = 0;  // by builds and insertions, of both
  std::uint64_t allocations = 0;   // calls for memory
  // Of the last update.
  std::uint64_t pair_tests = 0;            // pairs met in leaves: boxes compared with boxes
  std::uint64_t nodes_visited = 0;         // of the dynamic structure, while pairing
  std::uint64_t nodes_skipped_asleep = 0;  // whole branches in which all sleep, each counted once
  std::uint64_t nodes_reused = 0;          // of the dynamic structure
};

// What a kind of structure does for the same bodies, counted: for whoever compares kinds. A unit is
// one comparison of a box, with a node, a plane, a bin of a cut or another box; a row of a grid's
// cells that is looked up, and a body that is put into its cell, count as one, too. No time is
// measured: what counts and clocks say may differ, but counts are the same on every machine.
struct StructureWork {
  std::uint64_t build = 0;     // to build the structures of all bodies for the first time
  std::uint64_t renew = 0;     // in the step that follows, to mend them or build anew what moves
  std::uint64_t pair = 0;      // in the same step, to find the pairs
  std::uint64_t pairs = 0;     // bodies that were compared with each other, each pair once
  std::uint64_t overlaps = 0;  // of these, whose boxes overlap: every kind finds the same

  std::uint64_t step() const { return renew + pair; }

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("build", r.build)("renew", r.renew)("pair", r.pair)("pairs", r.pairs)("overlaps",
                                                                                   r.overlaps);
  }
};

}  // namespace lantern::spatial
