#include "physics/motion_method.hpp"

#include <array>
#include <utility>

namespace lantern {
namespace {

constexpr std::array<std::pair<Integrator, std::string_view>, 6> kIntegrators{{
    {Integrator::explicit_euler, "explicit_euler"},
    {Integrator::semi_implicit_euler, "semi_implicit_euler"},
    {Integrator::velocity_verlet, "velocity_verlet"},
    {Integrator::runge_kutta_4, "runge_kutta_4"},
    {Integrator::implicit_midpoint, "implicit_midpoint"},
    {Integrator::implicit_euler, "implicit_euler"},
}};

constexpr std::array<std::pair<RotationMethod, std::string_view>, 3> kRotations{{
    {RotationMethod::splitting_2, "splitting_2"},
    {RotationMethod::splitting_4, "splitting_4"},
    {RotationMethod::explicit_gyroscopic, "explicit_gyroscopic"},
}};

template <class Names, class Method>
std::string_view name_in(const Names& names, Method method) {
  for (const auto& [value, name] : names)
    if (value == method) return name;
  return "?";
}

template <class Names>
auto named_in(const Names& names, std::string_view name)
    -> std::optional<decltype(names[0].first)> {
  for (const auto& [value, known] : names)
    if (known == name) return value;
  return std::nullopt;
}

}  // namespace

std::string_view to_string(Integrator integrator) { return name_in(kIntegrators, integrator); }
std::optional<Integrator> integrator_named(std::string_view name) {
  return named_in(kIntegrators, name);
}

std::string_view to_string(RotationMethod method) { return name_in(kRotations, method); }
std::optional<RotationMethod> rotation_method_named(std::string_view name) {
  return named_in(kRotations, name);
}

}  // namespace lantern
