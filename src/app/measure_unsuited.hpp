// Who was asked for and is not run, and why: nobody is left out in silence.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenario/scenario.hpp"

namespace lantern {

// A line for each reason: "kepler is not run by MuJoCo and MuJoCo:RK4: MuJoCo has no forces between
// two bodies but tendons". Of the methods, which must be known (can_be_measured_by), and, if
// `with_peers`, of the other engines.
std::vector<std::string> unsuited(const std::vector<Scenario>& scenarios,
                                  const std::vector<std::string>& methods, bool with_peers);

// If `name` is that of another engine, in whatever letters: that it is no method, and which of the
// scenarios it cannot do.
std::optional<std::string> about_peer(const std::string& name,
                                      const std::vector<Scenario>& scenarios);

}  // namespace lantern
