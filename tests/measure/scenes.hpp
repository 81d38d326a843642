// Scenarios by text for the tests of measuring.
#pragma once

#include <string>

#include <fmt/format.h>

#include "language/scenario.hpp"

namespace lantern::measure {

// A ball thrown in a flat world without walls.
inline std::string thrown_text(const std::string& world = "gravity = [0, -10]",
                               const std::string& steps = R"(
[[step]]
do = "run"
seconds = 1
)") {
  return fmt::format(R"(
title = "A throw"
[world]
min = [-100, -100]
max = [100, 100]
time_step = 0.01
{}
[[body]]
name = "ball"
radius = 0.5
mass = 2
position = [1, 2]
velocity = [3, 4]
[[step]]
do = "insert"
bodies = ["ball"]
{})",
                     world, steps);
}

inline Scenario thrown(const std::string& world = "gravity = [0, -10]",
                       const std::string& steps = "[[step]]\ndo = \"run\"\nseconds = 1\n") {
  return parse_scenario(thrown_text(world, steps), "throw.toml");
}

}  // namespace lantern::measure
