#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/stop.hpp"
#include "physics/step.hpp"

namespace lantern::physics {

// The lecture's update has four of these phases: it refreshes the boxes, finds pairs in the broad
// phase, tests them in the narrow phase, and resolves each pair that touches as it is found. An
// engine must do more. It looks not where bodies are, but as far as they may come in the step, so
// that none passes through another; what the pairs tie together it solves together, as islands; it
// lets islands sleep that rest, and wakes them; and it tells who began to touch and who ceased to.
// (The lecture's own solver is given the world as one, and does no more than the lecture.)
template <int D>
void World<D>::step(double h) {
  if (!std::isfinite(h) || h < 0) throw Refused(fmt::format("time step {} is not allowed", h));
  stop_if_asked();
  if (h == 0) return;  // else -0.0 + 0.0 would change the sign of a zero
  const WorldWork before = work_;
  std::vector<double> reach;
  try {
    for (int tries = 1;; ++tries) {
      Step step{*this, h, std::move(reach)};
      step.find_forces();  // how all would fly on, and so how far each may come
      do {
        step.refresh_boxes();
        step.broad_phase();
        step.narrow_phase();
      } while (step.wake_what_is_touched());
      step.make_islands();
      step.solve_and_integrate();  // from impact to impact, islands by the contact solver
      step.require_no_overflow();
      // An impact may send a body farther than it was looked for. Then the step is made anew,
      // looking farther.
      if (tries == kStepSettings.most_tries || step.stayed_within_reach()) {
        step.fall_asleep();
        step.update_contact_events();
        step.commit();
        return;
      }
      reach = std::move(step.reach);
      ++work_.retries;
      work_.impacts_located = before.impacts_located;  // they did not take place
    }
  } catch (...) {
    ahead_.reset();
    work_ = before;
    throw;
  }
}

template void World<2>::step(double);
template void World<3>::step(double);

}  // namespace lantern::physics
