// A way to move a scene: what `lantern measure` compares. A name of the form "velocity_verlet",
// "splitting_4", "soft:16", "soft:0.001" or "impulse:100"; the number is of sub-steps, the error
// that is wanted (below 1), or of sweeps.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "language/scenario.hpp"
#include "physics/methods.hpp"

namespace lantern::language {

struct Method {
  std::string name;
  std::optional<Integrator> integrator;
  std::optional<RotationMethod> rotation;
  std::optional<ContactMethod> contacts;
  std::optional<int> effort;           // sub-steps of soft contacts, sweeps of impulses
  std::optional<double> wanted_error;  // of soft contacts
};

// Nothing for a name that is none.
std::optional<Method> method_named(std::string_view name);

// All names but for their numbers, for help and suggestions.
std::vector<std::string_view> method_names();

// The scenario, moved by `method` in steps of `h` seconds; what the method leaves open stays. What
// it names holds for every body and throughout the script.
Scenario moved_by(Scenario scenario, const Method& method, double h);

}  // namespace lantern::language
