// One point of a contact while its rows are solved, and the numbers of all methods that solve rows.
#pragma once

#include <algorithm>
#include <cstdint>

#include "physics/contact/solver_body.hpp"

namespace lantern::physics {

// The numbers of all methods that solve rows.
struct RowSettings {
  // What approaches slower than gravity makes in so many sub-steps does not bounce.
  double bounce_steps = 2;
  // Of the way that forces make in a sub-step: what is so near has no gap. (A gap must be closed by
  // a velocity, which the next sub-step must stop again: of gaps that are mere rounding that would
  // make noise in all the impulses of a stack.)
  double touching_way = 1e-4;
  // The part of penetration that one sub-step pushes out, and at most how fast, in units a second.
  // So stiffness grows with the rate of sub-steps (Catto, "Soft Constraints", 2011; Macklin et al.,
  // "Small Steps in Physics Simulation", 2019).
  double pushed_out = 0.25;
  double fastest_push = 4;
  // The same where sweeps alone push. What they have learned of how a stack leans is in the
  // impulses that they begin with; bodies that are pushed upright while these still hold them up
  // are thrown over to the other side, farther each time. So what lies within the part `shallow` of
  // a body's thickness is eased out, slower than a stack sways; only what is deeper is pushed.
  double eased_out = 0.02;
  double shallow = 0.01;
  double flat = 1e-12;   // how far the cosine to a face's normal may be from 1
  double corner = 1e-3;  // of a body's size: so near to a corner of it is at the corner
  // Of full friction: what stops a body within so little of it does not slip in the end.
  double slip_by_rounding = 1e-6;
  // Full friction of a point that slips answers to its normal impulse: by so much of what that
  // itself does, and more, each would overshoot what the other has found.
  double coupled = 0.8;
  // Of the firmest point's impulse: one that presses less presses by rounding only.
  double presses_by_rounding = 1e-9;
  // When sweeps have done enough. Of the largest impulse: so small a change of any ends the sweeps.
  // In a stack of n boxes the last change stands for an error of (2n / pi)^2 times as much; the
  // motion that it leaves is a blow to the next direct solve, which would push as much the other
  // way, and so on.
  double change = 1e-12;
  // Of what impulses change: so little work is done by rounding.
  double work_by_rounding = 1e-9;
  double push = 1e-3;       // of the largest push out of penetration, and
  double no_matter = 1e-7;  // of the largest impulse: what is less than either is enough
};
inline constexpr RowSettings kRowSettings;

template <int D>
struct ContactPoint {  // made by `set_points` and `refresh`; there is room for more than there are
  std::uint32_t feature;
  // From a body's centre to its surface: what turns with it (in its own axes) and what does not (a
  // ball that rolls keeps its lowest point).
  Vec<D> core_a, core_b, round_a, round_b;
  Vec<D> arm_a, arm_b;  // to the point where impulses act, in the world's axes
  double share;         // where impulses act, from a's surface (0) to b's (1)
  double offset;        // of the separation, against what the arms say
  double separation;
  double gap;                   // the same while they do not touch, else 0
  double inverse_normal_mass;   // effective
  double inverse_tangent_mass;  // in the direction in which it is largest
  Vec<D> coupling;              // slip by a normal impulse of 1, where that is much
  double pn;                    // normal impulse of this sub-step, N s
  Vec<D> pt;                    // friction impulse of this sub-step
  double bounce;                // wanted speed of parting
  Vec<D> slip;                  // across the normal, before this sub-step's forces
  Vec<D> kicked_slip;           // and after them
  Vec<D> wanted_slip;           // mean over this sub-step, if it sticks
  Vec<D> carried;               // a part of that, see ContactRows::carry
  double correction;            // impulse that pushes out penetration, along the normal
  bool sticks;

  // The mean speed of parting, over `h` seconds, that a point which presses should have.
  double wanted_mean_speed(double h) const {
    if (gap > 0) return -gap / h;
    return std::min(-separation * kRowSettings.pushed_out / h, kRowSettings.fastest_push);
  }
};

// What one sweep did.
struct Sweep {
  WorldWork* work;     // counts the rows that were solved
  double change = 0;   // largest change of an impulse
  double largest = 0;  // largest impulse
};

}  // namespace lantern::physics
