// Who was asked for and is not run, and why: nobody is left out in silence.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measure/run.hpp"

namespace lantern::lab {

// A line for each reason: "kepler is not run by MuJoCo:Euler and MuJoCo:RK4: MuJoCo has no forces
// between two bodies but tendons". Of other engines only if `with_peers`.
std::vector<std::string> unsuited_words(std::span<const Unsuited> unsuited, bool with_peers);

// If `name` is that of another engine, in whatever letters: that it is no method, and which of the
// scenarios it does not run.
std::optional<std::string> about_peer(const std::string& name,
                                      const std::vector<Scenario>& scenarios);

}  // namespace lantern::lab
