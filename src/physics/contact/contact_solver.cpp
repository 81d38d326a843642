#include "physics/contact/contact_solver.hpp"

namespace lantern::physics {

// Each is in the file of its solver.
extern const ContactSolver kJointsAlone, kSequentialImpulses, kSoftSubSteps, kDirectSolve,
    kLectureImpulses;

namespace {

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
