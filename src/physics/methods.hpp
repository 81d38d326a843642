// How bodies are moved, turned and parted: the names of the methods. What they do is in
// integrate/integrator.hpp, free_rotation.hpp and contact/contact_solver.hpp. An integrator or a
// contact solver that a program adds has a number beyond those that have a name here.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace lantern::physics {

enum class Integrator {
  explicit_euler,
  semi_implicit_euler,
  velocity_verlet,
  runge_kutta_4,
  implicit_midpoint,
  implicit_euler,
};

enum class RotationMethod {
  splitting_2,          // exact turns about fixed axes, one after the other; second order
  splitting_4,          // five such steps composed so that their errors cancel; fourth order
  explicit_gyroscopic,  // a warning: the textbook update of angular velocity; L and energy drift
};

enum class ContactMethod {
  none,     // bodies pass through each other; joints hold as with `soft`
  impulse,  // sequential impulses, swept over a few times a step
  soft,     // sub-steps, in each of which all rows are solved at once; penetration is eased out
  direct,   // the same without sub-steps
  lecture,  // one pass over the pairs, an impulse each, as the lecture does it; no friction, joints
};

// The name of a method, which is that of its enumerator if it has one; the method of a name,
// nothing for a name that is none of them; and all names, in the order of the enumerators.
std::string_view to_string(Integrator integrator);
std::string_view to_string(RotationMethod method);
std::string_view to_string(ContactMethod method);
std::optional<Integrator> integrator_named(std::string_view name);
std::optional<RotationMethod> rotation_method_named(std::string_view name);
std::optional<ContactMethod> contact_method_named(std::string_view name);
std::vector<std::string_view> integrator_names();
std::vector<std::string_view> contact_method_names();

}  // namespace lantern::physics
