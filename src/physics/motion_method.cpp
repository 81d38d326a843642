#include "physics/motion_method.hpp"

#include <algorithm>
#include <iterator>

namespace lantern::physics {
namespace {

// In the order of the enumerators.
constexpr std::string_view kIntegrators[] = {"explicit_euler",    "semi_implicit_euler",
                                             "velocity_verlet",   "runge_kutta_4",
                                             "implicit_midpoint", "implicit_euler"};
constexpr std::string_view kRotations[] = {"splitting_2", "splitting_4", "explicit_gyroscopic"};

template <class Method, std::size_t N>
std::optional<Method> named_in(const std::string_view (&names)[N], std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == std::end(names)) return std::nullopt;
  return static_cast<Method>(found - names);
}

}  // namespace

std::string_view to_string(Integrator integrator) {
  return kIntegrators[static_cast<std::size_t>(integrator)];
}
std::optional<Integrator> integrator_named(std::string_view name) {
  return named_in<Integrator>(kIntegrators, name);
}

std::string_view to_string(RotationMethod method) {
  return kRotations[static_cast<std::size_t>(method)];
}
std::optional<RotationMethod> rotation_method_named(std::string_view name) {
  return named_in<RotationMethod>(kRotations, name);
}

}  // namespace lantern::physics
