// A step cut into sub-steps. Each one is a whole small step, with few sweeps over the constraints,
// whose impulses begin where the sub-step before has left them; penetration is eased out a part at
// a time. For the same work this mends far more than many sweeps in one large step (Macklin et al.,
// "Small Steps in Physics Simulation", 2019; Catto, "Solver2D", 2024: soft step).
//
// Small steps alone do not hold a heavy body on a light one: what the sweeps cannot, the direct
// solve of all rows at once does in each sub-step (direct_solve.hpp). Large islands of which an
// error is wanted are swept for as long as that takes, and in fewer parts (quick_sweeps.hpp); so
// are heaps of bodies inside each other.
#include <algorithm>

#include "physics/direct_solve.hpp"
#include "physics/quick_sweeps.hpp"

namespace lantern::physics {

template <int D>
void soft_sub_steps(Island<D>& island, const WorldConfig<D>& config, double h, double whole,
                    WorldWork& work) {
  const bool crowded = island.pairs.size() > kQuickSettings.crowd * island.bodies.size();
  const double error =
      crowded ? std::max(config.wanted_error, kQuickSettings.usual_error) : config.wanted_error;
  const auto pairs = static_cast<int>(island.pairs.size());
  if (error > 0 && island.joints.empty() && pairs >= kQuickSettings.fewest_pairs) {
    QuickSweeps<D> quick;
    const int parts = std::min(kQuickSettings.parts(error), config.sub_steps);
    in_sub_steps<D>(island, config, h, whole, parts, work,
                    [&](SubStep<D>& step) { quick.settle(step, error); });
    return;
  }
  DirectSolve<D> direct;
  in_sub_steps<D>(island, config, h, whole, config.sub_steps, work,
                  [&](SubStep<D>& step) { direct.settle(step); });
}

template void soft_sub_steps(Island<2>&, const WorldConfig<2>&, double, double, WorldWork&);
template void soft_sub_steps(Island<3>&, const WorldConfig<3>&, double, double, WorldWork&);

}  // namespace lantern::physics
