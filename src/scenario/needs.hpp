// Which stages a scenario uses, and which it leaves out, and why.
#pragma once

#include <string>
#include <vector>

#include "scenario/scenario.hpp"

namespace lantern {

struct Need {
  std::string stage;   // "world", "motion", "structure", "candidate pairs", "atlas", "tree panel", ...
  bool used = false;
  std::string reason;  // "3 bodies", "no body ever moves"
};

struct Needs {
  bool world = false;
  bool motion = false;      // some step lets time pass while something moves
  bool structure = false;
  bool pairs = false;
  bool atlas = false;
  bool world_panel = false;
  bool tree_panel = false;
  bool atlas_panel = false;
  std::vector<Need> listed;  // all of the above and more, in the order of a run
};

Needs needs_of(const Scenario& scenario);

}  // namespace lantern
