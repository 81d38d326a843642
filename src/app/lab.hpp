// The lab: `measure`, `bench` and `stress`. It is a module of its own (src/lab), loaded when it is
// asked for; a build without it is a whole Lantern, too.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/commands/command.hpp"
#include "language/scenario.hpp"

namespace lantern::app {

// What the module gives: its function `lantern_lab` returns one.
struct Lab {
  std::string_view sources;  // kSourceHash of the program that it was built for
  // Of one of its commands, "bench pairs": as Command::begin.
  Run (*begin)(std::string_view command, Options& rows);
  // The other engines, and the libraries of boxes, that it can measure beside: "Box2D 2.4.1
  // (single)". For each that is not there a line is added to `missing`.
  std::vector<std::string> (*engines)(std::vector<std::string>& missing);
  std::vector<std::string> (*box_libraries)(std::vector<std::string>& missing);
  // Throws Refused if the scenario's bodies do not pose the problem that it names.
  void (*require_problem)(const Scenario& scenario);
};

// From beside the program, or from where it is installed. Null if it is not there, or was built for
// another program; `why` then says so, and which command builds it. Once loaded it stays.
const Lab* find_lab(std::string* why = nullptr);

}  // namespace lantern::app
