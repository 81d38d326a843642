// How bodies that touch are parted. Each solver is a function and a row that says what it is, in
// one file; comparing two files shows the difference.
#pragma once

#include "physics/contact/island.hpp"
#include "physics/method_list.hpp"

namespace lantern::physics {

// Moves the island under forces, joints and those of its pairs that are pressed: turns its bodies'
// state into that at the end, and notes in each pair whether it touched and how hard it pressed.
// What is asleep or not dynamic pushes but is not pushed. Counts what it did.
template <int D>
using SolveContacts = void (*)(const IslandMove<D>& move);

struct ContactSolver {
  std::string_view name;
  BothDimensions<SolveContacts> solve = {};
  // Is given the world as a single island: all bodies, all pairs that may touch, for the whole
  // step. Its impacts are not located in time. Others get island by island, from impact to impact.
  bool whole_world = false;
  // After so many steps without touch a pair is said to have parted; at least 1.
  int frames_remembered = 1;
};

const ContactSolver& contact_solver(ContactMethod method);
// One more solver, which outlives all worlds; before any is made. What scenarios call it is its
// name.
ContactMethod add_contact_solver(const ContactSolver& solver);

}  // namespace lantern::physics
