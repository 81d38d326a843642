// Sequential impulses: one row after another gets the impulse after which its own condition holds,
// over and over, as often as the config says (Catto, "Iterative Dynamics with Temporal Coherence",
// 2005; it is projected Gauss-Seidel). What the sweeps leave undone, the next step goes on with,
// since it begins with the impulses found. Penetration is pushed out by impulses of their own,
// which move bodies but leave no velocity (split impulses).
//
// A sweep carries a load on by one contact, so a stack of n boxes needs about n^2 of them, and a
// mass ratio of r about r.
#include "physics/contact/contact_solver.hpp"
#include "physics/contact/sub_step.hpp"

namespace lantern::physics {

template <int D>
void sequential_impulses(const IslandMove<D>& move) {
  const int most = move.config.iterations;
  in_sub_steps<D>(move, 1, [&](SubStep<D>& step) {
    Sweep sweep;
    for (int i = 0; i < most; ++i) {
      sweep = step.sweep_velocities(i);
      if (sweep.change <= kRowSettings.change * sweep.largest) break;
    }
    step.begin_position_correction();
    for (int i = 0; i < most; ++i)
      if (step.is_corrected(step.sweep_positions(), sweep.largest)) break;
  });
}

extern const ContactSolver kSequentialImpulses = {"impulse",
                                                  {sequential_impulses<2>, sequential_impulses<3>}};

}  // namespace lantern::physics
