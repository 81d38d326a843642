// A part of a step in which the rows of an island are solved once: what solvers share that solve
// rows.
//
//   v += kick            forces
//   v += J p / m         impulses: begin with the old ones, then sweep until they hold
//   u  = v + drift / h   mean velocity, in which penetration is pushed out
//   x += h u             v knows nothing of that: no energy comes from it
//
// The integrator's drift says how far the mean velocity of a sub-step is from the new one: for
// velocity Verlet -h kick / 2. Impulses of constraints act through the sub-step just as forces do,
// so they lag by the same share; a block at rest then has no drift at all, and friction stops a
// block where the closed form says.
#pragma once

#include <functional>

#include "base/stop.hpp"
#include "physics/island.hpp"

namespace lantern::physics {

template <int D>
class SubStep {
 public:
  SubStep(Island<D>& moved, const WorldConfig<D>& settings, double seconds, WorldWork& counted)
      : island(moved), config(settings), h(seconds), work(counted) {}

  Island<D>& island;
  const WorldConfig<D>& config;
  const double h;
  WorldWork& work;

  // Forces act, rows are made where bodies are, and begin with the impulses that they have.
  void begin();
  // Once over all rows, joints last. Every other `turn` goes backwards, so that neither end of a
  // stack, nor side of a box, is preferred.
  Sweep sweep_velocities(int turn);
  // Takes back so much of all impulses, in proportion, that together they do no work but what
  // bounces and closing gaps ask for. Sweeps that end early may leave them too large, and energy
  // would come of it. After the last sweep over velocities.
  void do_no_work();
  void find_mean_velocities();
  // From the velocities found follow mean velocities, and what is wanted of them.
  void begin_position_correction();
  Sweep sweep_positions();
  // Whether a sweep over positions was the last that is needed; `largest` impulse of velocities.
  bool is_corrected(const Sweep& sweep, double largest);
  // Moves the bodies, and notes what touched and how hard.
  void end();

  template <class F>
  void each_pair(F&& f);  // f(rows, a, b) of those that may press

 private:
  template <class F>
  void each_joint(F&& f);

  double largest_push_ = 0;
  bool joints_at_once_ = false;  // after which, if nothing touches, nothing is left to be done
  bool touches_ = false;
};

template <int D>
template <class F>
void SubStep<D>::each_pair(F&& f) {
  for (IslandPair<D>& pair : island.pairs) {
    stop_if_asked();
    if (pair.rows.count > 0)
      f(pair.rows, island.solver_bodies[pair.rows.a], island.solver_bodies[pair.rows.b]);
  }
}

// Moves the island by `h` of the step's `whole` seconds, in parts of which `sub_steps` make a whole
// step. Contacts are looked at once; `solve` finds the impulses of a part and corrects positions,
// between its begin and its end. If nothing touches, there are no parts: all fly, or move as their
// joints let them (constrained_motion.hpp).
template <int D>
void in_sub_steps(Island<D>& island, const WorldConfig<D>& config, double h, double whole,
                  int sub_steps, WorldWork& work, const std::function<void(SubStep<D>&)>& solve);

}  // namespace lantern::physics
