// What `bench pairs` measures: worlds of moving boxes of which all pairs are wanted, and worlds
// that are asked what a ray, a box or a ball meets. Seeded: the same boxes on every machine.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "measure/box_scenes.hpp"

namespace lantern::measure {

// What is wanted of it.
enum class BoxTask {
  pairs,       // all pairs, each step
  rays,        // all bodies that a segment meets
  first_hits,  // the first of them
  boxes,       // all bodies that reach into a box
  balls,       // or into a ball
};

struct BoxWorkload {
  std::string_view name;  // "uniform_2d"
  BoxTask task = BoxTask::pairs;
  int dimension = 2;
  std::string_view words;             // how its boxes are laid out and moved
  std::vector<std::uint64_t> bodies;  // that it is measured with if nobody says how many
  std::vector<std::uint64_t> full;    // and if all is to be measured
};
std::span<const BoxWorkload> box_workloads();

// By its name, or without its dimension: "uniform" names two. Empty for none.
std::vector<const BoxWorkload*> box_workloads_named(std::string_view name);

// Its boxes, `frames` updates one after another. Asked for again and again they go to and fro, so
// that each step is as small as the others.
BoxScene boxes_of(const BoxWorkload& workload, std::size_t bodies, std::size_t frames,
                  std::uint64_t seed);

// How many frames are kept of so many bodies: enough for them to move on, in little memory.
std::size_t frames_for(std::size_t bodies);

}  // namespace lantern::measure
