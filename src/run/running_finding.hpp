// A question while it is being answered.
#pragma once

#include "run/engine.hpp"

namespace lantern::run {

// What the walk of a finding has brought to light so far, event by event: hits, counts, how far a
// ray reaches, and which nodes were gone through or left out. After the last event it is the
// finding itself.
class RunningFinding {
 public:
  // Of a walk that has not begun. `whole` must outlive this.
  explicit RunningFinding(const Finding& whole);

  // The next event of whole.walk has happened.
  void go_on();

  Finding so_far() const;
  // Nodes of the structure of what moves.
  const Touched& touched() const { return touched_; }
  // Is the next event of the other structure, of what never moves?
  bool is_of_static() const { return at_ >= whole_.first_static; }

 private:
  const Finding& whole_;
  Finding so_far_;            // but for its hits
  std::vector<BodyId> hits_;  // as they were found
  Touched touched_;
  std::size_t at_ = 0;  // in the walk
};

}  // namespace lantern::run
