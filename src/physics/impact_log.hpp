// What a step tells of its impacts: when they were, and, for who asks, how that was found out.
#pragma once

#include <vector>

#include "physics/body.hpp"

namespace lantern::physics {

// Where a body is at some moment within a step.
template <int D>
struct Pose {
  BodyId body = 0;
  Vec<D> position{0.0};
  Rotation<D> orientation{};
};

// An impact that was located: the two are there when they meet. Times are seconds since the step
// began.
template <int D>
struct ImpactMoment {
  double time = 0;
  Pose<D> a, b;
};

// A look at two bodies, on the way to the moment at which they meet.
template <int D>
struct ImpactLook {
  double time = 0;
  Pose<D> a, b;
  Vec<D> on_a{0.0}, on_b{0.0};  // where their surfaces are nearest to each other, and
  double gap = 0;               // how near; below 0 they overlap: too late
  double free_until = 0;  // they are sure not to touch before; `time` if this look says nothing
  bool meets = false;     // this is the moment, if nothing else comes between
};

template <int D>
struct ImpactLog {
  std::vector<ImpactMoment<D>> moments;  // one island after another, in each as time passes
  std::vector<ImpactLook<D>> looks;      // in the order in which they were made, if
  bool keeps_looks = false;
};

}  // namespace lantern::physics
