// What a step tells of bodies that touch.
#pragma once

#include <array>
#include <vector>

#include "physics/manifold.hpp"
#include "spatial/structure.hpp"

namespace lantern::physics {

// Two bodies that touched during a step, and how hard they pressed. Impulses in N s, summed over
// the whole step, upon b; a gets the opposite.
template <int D>
struct Contact {
  BodyId a = 0;  // the lower id
  BodyId b = 0;
  Manifold<D> manifold;                                            // when last looked at
  std::array<double, Manifold<D>::kMostPoints> normal_impulses{};  // of each point, not negative
  std::array<Vec<D>, Manifold<D>::kMostPoints> friction_impulses{};

  Pair pair() const { return {a, b}; }
};

// The record of a pair, which holds impulses already, gets a new manifold: impulses stay with their
// features, and those of points that are gone go to the first one.
template <int D>
void renew_record(Contact<D>& record, const Manifold<D>& manifold) {
  Contact<D> renewed;
  renewed.a = record.a;
  renewed.b = record.b;
  renewed.manifold = manifold;
  for (std::size_t i = 0; i < static_cast<std::size_t>(record.manifold.count); ++i) {
    std::size_t to = 0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(manifold.count); ++j)
      if (manifold.room[j].feature == record.manifold.room[i].feature) to = j;
    renewed.normal_impulses[to] += record.normal_impulses[i];
    renewed.friction_impulses[to] += record.friction_impulses[i];
  }
  record = renewed;
}

struct ContactEvent {
  enum class Kind {
    begin,  // touch in this step, did not in the last one
    stay,   // touch in both
    end,    // touched in the last step, or some steps ago (ContactSolver::frames_remembered)
  };
  Kind kind = Kind::begin;
  BodyId a = 0;
  BodyId b = 0;
  bool crushes = false;  // one of them, against a third (crushing.hpp)
  bool operator==(const ContactEvent&) const = default;
};

}  // namespace lantern::physics
