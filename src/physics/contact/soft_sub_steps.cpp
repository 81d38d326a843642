// A step cut into sub-steps. Each one is a whole small step, with few sweeps over the constraints,
// whose impulses begin where the sub-step before has left them; penetration is eased out a part at
// a time. For the same work this mends far more than many sweeps in one large step (Macklin et al.,
// "Small Steps in Physics Simulation", 2019; Catto, "Solver2D", 2024: soft step).
//
// Small steps alone do not hold a heavy body on a light one: what the sweeps cannot, the direct
// solve of all rows at once does in each sub-step (direct_solve.cpp). Large islands of which an
// error is wanted are swept for as long as that takes, and in fewer parts (QuickSweeps); so are
// heaps of bodies inside each other.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/elementary.hpp"
#include "physics/contact/contact_solver.hpp"
#include "physics/contact/quick_sweeps.hpp"
#include "physics/contact/sub_step.hpp"

namespace lantern::physics {
namespace {

struct QuickSettings {
  // Of the wanted error: so far may the last sweep of a sub-step move a body. What it leaves undone
  // is more, and sub-steps add up.
  double last_move = 0.001;
  int fewest_pairs = 8;  // smaller islands are solved exactly: it costs less
  // Pairs for each body: no more touch unless bodies lie in heaps inside each other. Those are
  // swept so, too: how fast they part is limited, and by what impulses exactly is of no account.
  std::size_t crowd = 16;
  double usual_error = 0.01;  // at which a step is one part
  // How a step of a pile is best spent at an error: measured on piles of 300 to 5,000 boxes. What
  // surrounds the sweeps of a part costs as much as ten of them.
  int parts(double error) const {
    return std::max(1, static_cast<int>(std::lround(geometry::pow(usual_error / error, 0.3))));
  }
  double effort(double error) const { return geometry::pow(usual_error / error, 0.4); }
};
constexpr QuickSettings kQuickSettings;

}  // namespace

template <int D>
void soft_sub_steps(const IslandMove<D>& move) {
  const Island<D>& island = move.island;
  const WorldConfig<D>& config = move.config;
  const bool crowded = island.pairs.size() > kQuickSettings.crowd * island.bodies.size();
  const double wanted = config.wanted_error.value_or(0);
  const double error = crowded ? std::max(wanted, kQuickSettings.usual_error) : wanted;
  const auto pairs = static_cast<int>(island.pairs.size());
  if (error > 0 && island.joints.empty() && pairs >= kQuickSettings.fewest_pairs) {
    QuickSweeps<D> quick;
    const int parts = std::min(kQuickSettings.parts(error), config.sub_steps);
    const double enough = kQuickSettings.last_move * error;
    const double effort = kQuickSettings.effort(error);
    made_in_sub_steps<D>(move, parts, [&](SubStep<D>& step) { quick.make(step, enough, effort); });
  } else {
    solve_directly<D>(move, config.sub_steps);
  }
}

extern const ContactSolver kSoftSubSteps = {"soft", {soft_sub_steps<2>, soft_sub_steps<3>}};
extern const ContactSolver kJointsAlone = {"none", {soft_sub_steps<2>, soft_sub_steps<3>}};

}  // namespace lantern::physics
