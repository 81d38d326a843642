// What the narrow phase tells of two bodies of a flat world, as a frame shows it.
#pragma once

#include "frame/parts/asked.hpp"
#include "physics/world.hpp"

namespace lantern::run {

// The test that contacts are made by, its axes written down. Neither may be a half-space.
template <int D>
FrameSeparation axes_between(const Body<D>& a, const Body<D>& b);

// Of all pairs of the world's structure, which stands.
template <int D>
ShapeTests tests_of_shapes(const World<D>& world);

// Their distance by GJK, step by step. The same holds.
template <int D>
FrameSearch distance_search(const Body<D>& a, const Body<D>& b);

// Nothing for half-spaces and solid worlds.
template <int D>
std::optional<FrameDifference> difference_of(const Body<D>& a, const Body<D>& b);

}  // namespace lantern::run
