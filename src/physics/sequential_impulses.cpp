// Sequential impulses: one row after another gets the impulse after which its own condition holds,
// over and over, as often as the config says (Catto, "Iterative Dynamics with Temporal Coherence",
// 2005; it is projected Gauss-Seidel). What the sweeps leave undone, the next step goes on with,
// since it begins with the impulses found. Penetration is pushed out by impulses of their own,
// which move bodies but leave no velocity (split impulses).
//
// A sweep carries a load on by one contact, so a stack of n boxes needs about n^2 of them, and a
// mass ratio of r about r.
#include "physics/sub_step.hpp"

namespace lantern::physics {

template <int D>
void sequential_impulses(Island<D>& island, const WorldConfig<D>& config, double h, double whole,
                         WorldWork& work) {
  in_sub_steps<D>(island, config, h, whole, 1, work, [&](SubStep<D>& step) {
    Sweep sweep;
    for (int i = 0; i < config.iterations; ++i) {
      sweep = step.sweep_velocities(i);
      if (sweep.change <= kRowSettings.change * sweep.largest) break;
    }
    step.begin_position_correction();
    for (int i = 0; i < config.iterations; ++i)
      if (step.is_corrected(step.sweep_positions(), sweep.largest)) break;
  });
}

template void sequential_impulses(Island<2>&, const WorldConfig<2>&, double, double, WorldWork&);
template void sequential_impulses(Island<3>&, const WorldConfig<3>&, double, double, WorldWork&);

}  // namespace lantern::physics
