// The world's structure, as a frame shows it: its nodes, the bodies in its leaves, the pairs that
// meet there, and its counts. There is no other structure: what is drawn is what physics uses.
#pragma once

#include <string>

#include "frame/frame.hpp"
#include "physics/world.hpp"

namespace lantern::run {

// Pairs met on one frame; more are refused.
inline constexpr std::uint64_t kMostPairs = 2'000'000;
// Entries and nodes of one tree; more are refused.
inline constexpr std::uint64_t kMostEntries = 2'000'000;

// What a scenario says of its structure, as the world is told it. Without one the world compares
// every body with every other.
template <int D>
BroadPhaseConfig<D> broad_phase_of(const StructureSpec& spec, const Box<D>& bounds);

// "root", "1.3", "front.back"; empty if there is no such node.
template <int D>
std::string label_of(const StructureSpec& spec, const BroadPhase<D>& structure, NodeHandle node);

// Nodes, pairs and counts of the world's structure as it stands. `tells_sleepers`: whether anything
// in this world may rest, so that nodes are told asleep from awake.
template <int D>
void picture_structure(const StructureSpec& spec, const World<D>& world, bool tells_sleepers,
                       const Touched& touched, Frame& frame);

extern template BroadPhaseConfig<2> broad_phase_of(const StructureSpec&, const Box<2>&);
extern template BroadPhaseConfig<3> broad_phase_of(const StructureSpec&, const Box<3>&);
extern template std::string label_of(const StructureSpec&, const BroadPhase<2>&, NodeHandle);
extern template std::string label_of(const StructureSpec&, const BroadPhase<3>&, NodeHandle);
extern template void picture_structure(const StructureSpec&, const World<2>&, bool, const Touched&,
                                       Frame&);
extern template void picture_structure(const StructureSpec&, const World<3>&, bool, const Touched&,
                                       Frame&);

}  // namespace lantern::run
