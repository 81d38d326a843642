// How smooth forces (gravity, drag, springs, those of the user) change the state in one step. Each
// method is one file with one function of this signature; comparing two files shows the difference.
//
// A method gives each body's increment instead of its new state, so that contacts may change the
// velocity in between: v += kick; (contacts change v); x += h v + drift. The orientation follows
// the angular momentum by free rotation (free_rotation.hpp): L += twist; (contacts change L); turn
// freely for h with L + lag. Without the lag the turning is of first order in a changing torque,
// whatever the method; with it, of the order of the method, but at most 2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "physics/body.hpp"
#include "physics/forces.hpp"
#include "physics/motion_method.hpp"

namespace lantern::physics {

template <int D>
struct Increment {
  Vec<D> kick{0.0};    // of the velocity
  Vec<D> drift{0.0};   // of the position, beyond h times the new velocity
  Spin<D> twist{0.0};  // of the angular momentum
  Spin<D> lag{0.0};    // of the angular momentum while the body turns, beyond the new one
};

// Increments over `h` > 0 seconds, one a body; zero for those that no force moves (static,
// kinematic, asleep). Deterministic: the same input gives the same bits. `evaluations` grows by the
// number of times that all forces were evaluated. Throws Refused, naming the method and the step,
// if an implicit method does not converge, for a step that is not above 0, and for a spring or push
// on a body that is not there. A step beyond an explicit method's limit gives increments that grow,
// in the end beyond all numbers: it is for the caller to look.
template <int D>
void find_increments(Integrator integrator, std::span<const Body<D>> bodies,
                     const Forces<D>& forces, double h, std::vector<Increment<D>>& out,
                     std::uint64_t& evaluations);

}  // namespace lantern::physics
