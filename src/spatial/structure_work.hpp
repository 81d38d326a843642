// What a kind of structure does for the same bodies, counted: for whoever compares kinds. A unit is
// one comparison of a box, with a node, a plane, a bin of a cut or another box; a row of a grid's
// cells that is looked up, and a body that is put into its cell, count as one, too. No time is
// measured: what counts and clocks say may differ, but counts are the same on every machine.
#pragma once

#include <cstdint>
#include <span>

#include "spatial/broad_phase.hpp"

namespace lantern::spatial {

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

// The broad phase of these settings, with bodies as they are before a step and after it: the same
// ids. What never moves has a structure of its own, which is built once. The pairs of what nobody
// looks at come from vector instructions that compare more boxes than this in less time; counted is
// the plain way, which frames show. Throws Refused as BroadPhase does, and beyond `most` pairs.
template <int D>
StructureWork structure_work(BroadPhaseConfig<D> config, std::span<const Proxy<D>> before,
                             std::span<const Proxy<D>> after, std::uint64_t most);

// Whether all that the kind does is counted: not of `none` and `automatic`, of the lecture's own
// code, and of structures that a program was given.
bool counts_its_work(StructureKind kind);

}  // namespace lantern::spatial
