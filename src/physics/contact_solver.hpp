// How bodies that touch are parted. Each solver is one file with one function of this signature;
// comparing two files shows the difference. A new one costs its file, its enumerator
// (contact_method.hpp), and its declaration and line in the list of contact_solver.cpp.
#pragma once

#include <string_view>

#include "physics/contact_method.hpp"
#include "physics/island.hpp"

namespace lantern::physics {

// Moves the island by `h` of the step's `whole` seconds, under forces, joints and those of its
// pairs that are pressed: turns its bodies' state into that at the end, and notes in each pair
// whether it touched and how hard it pressed. What is asleep or not dynamic pushes but is not
// pushed. Counts what it did.
template <int D>
using SolveContacts = void (*)(Island<D>& island, const WorldConfig<D>& config, double h,
                               double whole, WorldWork& work);

template <int D>
struct ContactSolver {
  ContactMethod method;
  std::string_view name;
  SolveContacts<D> solve;
  // Is given the world as a single island: all bodies, all pairs that may touch, for the whole
  // step. Its impacts are not located in time. Others get island by island, from impact to impact.
  bool whole_world = false;
  // After so many steps without touch a pair is said to have parted; at least 1.
  int frames_remembered = 1;
};

template <int D>
const ContactSolver<D>& contact_solver(ContactMethod method);

}  // namespace lantern::physics
