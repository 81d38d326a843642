// All rows of an island at once, by Cholesky factors. Sweeps need about n^2 rounds for a stack of n
// boxes and about r for a mass ratio of r; this needs one, if it knows which contacts press and
// which of them stick. A few sweeps make a guess at that; what turns out to pull or to slip is let
// go, and the rest is solved again.
//
//   K dp = wanted - u     K = J M^-1 J^T: how relative velocities u answer to impulses dp
//
// K links only rows that share a body. Rows lie in order of their pairs' ids, and each line of the
// factor begins where K's does (an envelope: Jennings, "A Compact Storage Scheme", 1966).
#pragma once

#include <vector>

#include "physics/island.hpp"

namespace lantern {

template <int D>
class DirectSolve {
 public:
  // Finds impulses for velocities that satisfy the rows that press, and applies them. False, with
  // nothing changed, if there are none, if it would take too much work, or if no set of rows is
  // found that holds together.
  bool settle_velocities(Island<D>& island, double h, Sweep& sweep);

  // The same rows for mean velocities, after they were settled for velocities. If they were not
  // (not `factored`), all rows that press. False, with nothing changed, if some would pull.
  bool settle_carriage(Island<D>& island, double h, bool factored, Sweep& sweep);

 private:
  struct Row {
    std::uint32_t a = 0, b = 0;
    Vec<D> direction{0.0};
    Vec<D> arm_a{0.0}, arm_b{0.0};
    Spin<D> turn_a{0.0}, turn_b{0.0};
    Spin<D> gained_a{0.0}, gained_b{0.0};
    ContactPoint<D>* point = nullptr;  // of a contact; null for a joint
    JointRows<D>* joint = nullptr;
    double most = 0;   // friction coefficient
    int tangent = -1;  // which of the tangents; -1: a normal or joint row
    int axis = 0;      // of a pin
  };

  void list_rows(Island<D>& island);
  void add_row(const Island<D>& island, Row row);
  bool lay_out(const Island<D>& island);
  bool factor(const Island<D>& island);
  double link(const Island<D>& island, const Row& x, const Row& y) const;
  void solve();
  bool let_go(Island<D>& island);
  double& entry(std::size_t row, std::size_t column) {
    return entries_[start_[row] + (column - first_[row])];
  }

  std::vector<Row> rows_;
  std::vector<std::size_t> first_, start_;  // of each line: its first column, and where it is kept
  std::vector<double> entries_, values_;    // the factor; wanted, then impulses
};

}  // namespace lantern
