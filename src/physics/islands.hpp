// Islands: bodies that hang together by contacts, joints and springs, and so must be moved
// together, can only fall asleep together, and wake together.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "base/scratch.hpp"
#include "base/stop.hpp"
#include "physics/body.hpp"

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
  Scratch<std::uint32_t> parent_;
};

// What wakes with the bodies at `places`: these and, from one to the next, all dynamic ones linked
// to them. Those of which `wakes(place)` is false do not, and pass nothing on. Static and kinematic
// bodies pass nothing on unless they are named. Bodies are in order of ids; links name two of them
// each.
template <int D, class F>
Scratch<std::uint32_t> woken_with(std::span<const Body<D>> bodies, Scratch<std::uint32_t> places,
                                  std::span<const Pair> links, F&& wakes) {
  Scratch<std::uint32_t> woken;
  if (places.empty()) return woken;
  const auto place_of = [&](BodyId id) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(bodies, id, {}, &Body<D>::id) -
                                      bodies.begin());
  };
  Scratch<Scratch<std::uint32_t>> linked(bodies.size());
  for (const Pair& link : links) {
    stop_if_asked();
    const std::uint32_t a = place_of(link.a), b = place_of(link.b);
    if (bodies[b].is_dynamic()) linked[a].push_back(b);
    if (bodies[a].is_dynamic()) linked[b].push_back(a);
  }
  Scratch<std::uint8_t> seen(bodies.size());
  while (!places.empty()) {
    stop_if_asked();
    const std::uint32_t place = places.back();
    places.pop_back();
    if (seen[place] || !wakes(place)) continue;
    seen[place] = true;
    woken.push_back(place);
    places.insert(places.end(), linked[place].begin(), linked[place].end());
  }
  return woken;
}

}  // namespace lantern::physics
