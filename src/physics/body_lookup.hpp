// Where a body lies in a span of bodies, by its id.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "physics/body.hpp"

namespace lantern::physics {

template <int D>
class BodyLookup {
 public:
  explicit BodyLookup(std::span<const Body<D>> bodies) {
    places_.reserve(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) places_.emplace_back(bodies[i].id, i);
    std::sort(places_.begin(), places_.end());
  }

  // Throws Refused, naming `who` looks, if there is no such body.
  std::size_t index_of(BodyId id, std::string_view who) const {
    const auto place =
        std::lower_bound(places_.begin(), places_.end(), std::pair{id, std::size_t{0}});
    if (place == places_.end() || place->first != id)
      throw Refused(fmt::format("{}: there is no body {}", who, id));
    return place->second;
  }

 private:
  std::vector<std::pair<BodyId, std::size_t>> places_;  // by id
};

}  // namespace lantern::physics
