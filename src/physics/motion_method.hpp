// How a body is moved by smooth forces, and how it turns: the names of the methods. What they do is
// in integrator.hpp and free_rotation.hpp.
#pragma once

#include <optional>
#include <string_view>

namespace lantern::physics {

enum class Integrator {
  explicit_euler,
  semi_implicit_euler,
  velocity_verlet,
  runge_kutta_4,
  implicit_midpoint,
  implicit_euler,
};

// "semi_implicit_euler"; nothing for a name that is none of them.
std::string_view to_string(Integrator integrator);
std::optional<Integrator> integrator_named(std::string_view name);

enum class RotationMethod {
  splitting_2,          // exact turns about fixed axes, one after the other; second order
  splitting_4,          // five such steps composed so that their errors cancel; fourth order
  explicit_gyroscopic,  // a warning: the textbook update of the angular velocity; L and energy
                        // drift
};

// "splitting_2"; nothing for a name that is none of them.
std::string_view to_string(RotationMethod method);
std::optional<RotationMethod> rotation_method_named(std::string_view name);

}  // namespace lantern::physics
