// Which stages a scenario uses, and which it leaves out, and why.
#pragma once

#include <string>
#include <vector>

#include "scenario/scenario.hpp"

namespace lantern {

struct Need {
  std::string
      stage;  // "world", "motion", "structure", "candidate pairs", "atlas", "tree panel", ...
  bool used = false;
  std::string reason;  // "3 bodies", "no body ever moves"
};

struct Needs {
  bool world = false;
  bool motion = false;    // some step lets time pass while something moves
  bool rotation = false;  // and something that turns, or may be made to
  bool forces = false;    // gravity, drag, springs or those of a step, on a dynamic body
  bool links = false;     // springs and joints
  bool structure = false;
  bool static_structure = false;  // one of its own for what never moves
  bool pairs = false;
  bool narrow_phase = false;  // which pairs really touch?
  bool solver = false;        // contacts or joints hold bodies, while time passes
  bool friction = false;      // between some of them
  bool sleeping = false;
  bool queries = false;
  bool level = false;  // it is compiled
  bool atlas = false;
  bool chart = false;
  bool camera = false;
  bool world_panel = false;
  bool tree_panel = false;
  bool atlas_panel = false;
  bool chart_panel = false;
  bool memory_panel = false;
  std::vector<Need> listed;  // all of the above and more, in the order of a run
};

Needs needs_of(const Scenario& scenario);

}  // namespace lantern
