// What a step of the world finds and does, beside how bodies lie: the record from which frames of
// its phases are made.
#pragma once

#include "frame/frame.hpp"
#include "run/players.hpp"

namespace lantern::run {

// Nothing found: a step that has not begun.
struct StepFindings {
  using Counts = std::vector<std::pair<std::string_view, std::uint64_t>>;

  std::vector<FrameContact> contacts;
  std::vector<Pair> tested;  // whose shapes were, in order of ids
  WorldWork work;
  std::uint64_t begins = 0, ends = 0;  // of contacts
  double time_of_impact = 1;           // of the first; a share of the step

  // Its counts, in the order in which frames have them.
  Counts contact_counts() const;
  Counts solver_counts() const;
  Counts motion_counts() const;
  double penetration() const;  // of the deepest contact

  // In place of what a frame tells of a step, of the numbers that it has.
  void put_on(Frame& frame) const;
};

// Of the last step: contacts, tested pairs and the first impact; time steps have `h` seconds. Pairs
// of which a body has left since are not among them.
template <int D>
StepFindings findings_of(const Players<D>& players, double h);

}  // namespace lantern::run
