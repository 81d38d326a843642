// Joint constraints, solved by the same sweeps as contacts; their impulses may push and pull.
#pragma once

#include "physics/contact_rows.hpp"
#include "physics/joint.hpp"
#include "physics/mover.hpp"

namespace lantern {

template <int D>
struct JointRows {
  Joint<D> joint;
  std::uint32_t place = 0;     // among the world's joints
  std::uint32_t a = 0, b = 0;  // places among the island's bodies
  Vec<D> arm_a{0.0}, arm_b{0.0};
  Vec<D> gap{0.0};        // from a's point to b's
  Vec<D> direction{0.0};  // of a rod, from a's point to b's
  Mat<D> solve{0.0};      // from an error of velocity to the impulse that mends it
  double compliance = 0;  // of a rod
  Vec<D> impulse{0.0};    // upon b, of this sub-step, N s
};

template <int D>
void refresh(JointRows<D>& rows, const Body<D>& a, const Body<D>& b, const Mover<D>& mover_a,
             const Mover<D>& mover_b);

template <int D>
void warm_start(JointRows<D>& rows, Mover<D>& a, Mover<D>& b);

template <int D>
void sweep_velocities(JointRows<D>& rows, Mover<D>& a, Mover<D>& b, Sweep& sweep);

// The mean relative velocity along `direction` that mends the joint in `h` seconds.
template <int D>
double wanted_carriage(const JointRows<D>& rows, const Vec<D>& direction, double h);

// After `h` seconds the points are where the joint wants them.
template <int D>
void sweep_carriage(JointRows<D>& rows, Mover<D>& a, Mover<D>& b, double h, Sweep& sweep);

}  // namespace lantern
