// What a step tells of bodies that touch.
#pragma once

#include <array>
#include <vector>

#include "physics/manifold.hpp"
#include "spatial/structure.hpp"

namespace lantern {

// Two bodies that touched during a step, and how hard they pressed. Impulses in N s, summed over
// the whole step, upon b; a gets the opposite.
template <int D>
struct Contact {
  BodyId a = 0;  // the lower id
  BodyId b = 0;
  Manifold<D> manifold;                                            // when last looked at
  std::array<double, Manifold<D>::kMostPoints> normal_impulses{};  // of each point, not negative
  std::array<Vec<D>, Manifold<D>::kMostPoints> friction_impulses{};
};

struct ContactEvent {
  enum class Kind {
    begin,  // touch in this step, did not in the last one
    stay,   // touch in both
    end,    // touched in the last step
  };
  Kind kind = Kind::begin;
  BodyId a = 0;
  BodyId b = 0;
  bool operator==(const ContactEvent&) const = default;
};

}  // namespace lantern
