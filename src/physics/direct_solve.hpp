// All rows of an island at once, by Cholesky factors. Sweeps need about n^2 rounds for a stack of n
// boxes and about r for a mass ratio of r; this needs one, if it knows which contacts press and
// which of them stick. A few sweeps make a guess at that; what turns out to pull or to slip is let
// go, and the rest is solved again (an active set, as in Dantzig's method: Baraff, "Fast Contact
// Force Computation for Nonpenetrating Rigid Bodies", 1994).
//
//   K dp = wanted - u     K = J M^-1 J^T: how relative velocities u answer to impulses dp
//
// K links only rows that share a body. Rows lie in order of their pairs' ids.
//
// Two bodies have no more than 6 freedoms against each other, 3 in 2D, but the corners of a face
// that hold have 12 conditions. Such a contact is solved as a weld: a force and a torque at its
// middle. What they do to each corner is then shared out with the least squares.
#pragma once

#include <array>
#include <vector>

#include "physics/envelope_system.hpp"
#include "physics/sub_step.hpp"

namespace lantern::physics {

// The numbers of the direct solve.
struct DirectSettings {
  // Sweeps of a sub-step, if they do not end earlier: more for small islands, which are cheap.
  int fewest_sweeps = 24, most_sweeps = 256;
  int most_solved = 2048;  // pairs times sweeps
  // What slips or presses must be known before all is solved at once. A guess whose last change was
  // less than this part of the largest impulse is good; and what presses less counts for nothing.
  double good_guess = 0.05;
  double presses = 0.01;
  int most_guesses = 6;    // each lets go of what the last one found to pull or to slip
  double most_work = 4e6;  // products, for one factor: a few milliseconds
  // Rows that say the same twice have no factor without a little compliance. What it leaves undone
  // is so small a part of the impulses.
  double compliance = 1e-10;
  double least_spread = 1e-6;  // a contact whose corners lie nearly in a line is no weld
};
inline constexpr DirectSettings kDirectSettings;

template <int D>
class DirectSolve {
 public:
  // Finds the impulses of a sub-step that has begun, and corrects its positions.
  void settle(SubStep<D>& step);

 private:
  static constexpr int kFreedoms = D == 2 ? 3 : 6;
  using Wrench = std::array<double, kFreedoms>;  // a force, and a torque over the contact's size

  // An unknown impulse: of `direction` and, upon a and b, of turning.
  struct Row {
    std::uint32_t a = 0, b = 0;
    Vec<D> direction{0.0};
    Spin<D> turn_a{0.0}, turn_b{0.0};
    Spin<D> gained_a{0.0}, gained_b{0.0};
  };
  // One direction of a contact point or of a joint. It has its share of `width` rows.
  struct Part {
    std::uint32_t a = 0, b = 0;
    ContactPoint<D>* point = nullptr;  // of a contact; null for a joint
    JointRows<D>* joint = nullptr;
    Vec<D> arm_a{0.0}, arm_b{0.0};
    Vec<D> direction{0.0};
    double most = 0;   // friction coefficient
    int tangent = -1;  // which of the tangents; -1: a normal or a joint's
    std::size_t row = 0;
    int width = 1;
    Wrench share{1};
    double gain = 0;  // of impulse, that is found
  };
  struct Guess {  // of what presses and sticks, before the solve
    double pn = 0;
    Vec<D> pt{0.0};
    bool sticks = false;
  };

  // Impulses for velocities that satisfy the rows that press, applied. False, with nothing changed,
  // if there are none, if it would take too much work, or if no set of rows is found that holds
  // together.
  bool solve_velocities(SubStep<D>& step);
  // The same rows for mean velocities, after they were solved for velocities. If they were not (not
  // `factored`), all rows that press. False, with nothing changed, if some would pull.
  bool correct_positions(SubStep<D>& step, bool factored);
  bool is_due(SubStep<D>& step, int sweeps, int most, const Sweep& last) const;
  void count(WorldWork& work) const;

  void list_rows(Island<D>& island);
  void list_joint(const Island<D>& island, JointRows<D>& joint);
  void list_contact(const Island<D>& island, ContactRows<D>& contact);
  void add_row(const Island<D>& island, Row row);
  void add_rows_of_their_own(const Island<D>& island, std::size_t first_part);
  bool add_weld(const Island<D>& island, std::size_t first_part);
  bool factor(const Island<D>& island);
  double link(const Island<D>& island, const Row& x, const Row& y) const;
  template <class Missing>
  void find_gains(Missing&& missing);
  bool let_go(Island<D>& island);
  void keep_guess(Island<D>& island);
  void take_guess_back(Island<D>& island);

  std::vector<Row> rows_;
  std::vector<Part> parts_;
  EnvelopeSystem system_;
  std::vector<double> values_;  // wanted, then impulses
  std::vector<SolverBody<D>> kept_bodies_;
  std::vector<Guess> kept_;
};

}  // namespace lantern::physics
