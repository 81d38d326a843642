#include "physics/contact/contact_solver.hpp"

#include "physics/contact/sub_step.hpp"

namespace lantern::physics {

// Each of the others is in the file of its solver.
extern const ContactSolver kJointsAlone, kSoftSubSteps, kDirectSolve, kLectureImpulses;

namespace {

// Sequential impulses: one row after another gets the impulse after which its own condition holds,
// over and over, as often as the config says (Catto, "Iterative Dynamics with Temporal Coherence",
// 2005; it is projected Gauss-Seidel). What the sweeps leave undone, the next step goes on with,
// since it begins with the impulses found. Penetration is pushed out by impulses of their own,
// which move bodies but leave no velocity (split impulses).
//
// A sweep carries a load on by one contact, so a stack of n boxes needs about n^2 of them, and a
// mass ratio of r about r. Ten sweeps at 60 steps a second hold ten unit boxes that begin with no
// impulses (they sink by 2e-2 at first and sway by 6e-2 in 3D), at 120 steps twenty; at 60 steps a
// second fifteen fall in 3D within 3 s, and twenty in 2D within 10 s.
template <int D>
void sequential_impulses(const IslandMove<D>& move) {
  const int most = move.config.iterations;
  in_sub_steps<D>(move, 1, [&](SubStep<D>& step) {
    Sweep sweep{&step.work};
    for (int i = 0; i < most; ++i) {
      sweep = step.sweep_velocities(i, true);
      if (sweep.change <= kRowSettings.change * sweep.largest) break;
    }
    step.begin_position_correction();
    for (int i = 0; i < most; ++i)
      if (step.is_corrected(step.sweep_positions(true), sweep.largest)) break;
  });
}

constexpr ContactSolver kSequentialImpulses = {"impulse",
                                               {sequential_impulses<2>, sequential_impulses<3>}};

MethodList<ContactMethod, ContactSolver>& solvers() {
  static MethodList<ContactMethod, ContactSolver> list = {
      &kJointsAlone, &kSequentialImpulses, &kSoftSubSteps, &kDirectSolve, &kLectureImpulses};
  return list;
}

}  // namespace

const ContactSolver& contact_solver(ContactMethod method) { return solvers()[method]; }
ContactMethod add_contact_solver(const ContactSolver& solver) { return solvers().add(solver); }
std::string_view to_string(ContactMethod method) { return contact_solver(method).name; }
std::optional<ContactMethod> contact_method_named(std::string_view name) {
  return solvers().named(name);
}
std::vector<std::string_view> contact_method_names() { return solvers().names(); }

}  // namespace lantern::physics
