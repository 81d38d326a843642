#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/stop.hpp"
#include "physics/step.hpp"

namespace lantern {

// The lecture's physics update, a line each.
template <int D>
void World<D>::step(double h) {
  if (!std::isfinite(h) || h < 0) throw Refused(fmt::format("time step {} is not allowed", h));
  stop_if_asked();
  if (h == 0) return;  // else -0.0 + 0.0 would change the sign of a zero
  // An impact may send a body farther than it was looked for. Then the step is made anew, looking
  // farther.
  constexpr int kMostTries = 4;
  const WorldWork before = work_;
  std::vector<double> reach;
  try {
    for (int tries = 1;; ++tries) {
      Step step{*this, h, std::move(reach)};
      step.find_forces();      // how all would fly on
      step.find_near_pairs();  // broad and narrow phase: what may touch on the way
      step.make_islands();     // what must be moved together
      step.solve_and_integrate();
      step.require_no_overflow();
      if (tries == kMostTries || step.stayed_within_reach()) {
        step.fall_asleep();
        step.tell();
        step.commit();
        return;
      }
      reach = std::move(step.reach);
      ++work_.retries;
      work_.impacts_located = before.impacts_located;  // they did not take place
    }
  } catch (...) {
    work_ = before;
    throw;
  }
}

template void World<2>::step(double);
template void World<3>::step(double);

}  // namespace lantern
