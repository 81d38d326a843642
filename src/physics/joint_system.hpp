// The joints of an island as equations between the places of its bodies, g(q) = 0, and what follows
// from them: the velocities J v = 0 and, of multipliers, the system
//
//   J M^-1 J^T
//
// which is solved at once, by Cholesky factors; rows lie in the order of the joints, so that a
// chain costs time in proportion to its length. Rows that say the same twice (a closed loop that is
// over-determined) have no factor: they are given a little compliance, and solved again until
// nothing is missing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "physics/joint_row.hpp"
#include "physics/joint_rows.hpp"
#include "physics/smooth_system.hpp"
#include "physics/world_config.hpp"

namespace lantern::physics {

template <int D>
class JointSystem {
 public:
  using State = SmoothState<D>;
  using Row = JointRow<D>;
  // A joint at the state that was last looked at.
  struct Hold {
    const JointRows<D>* joint = nullptr;
    std::size_t first = 0;  // of its rows
    int width = 0;
    double size = 0;       // against which a gap is wide
    double tolerance = 0;  // of its gap, by rounding
    Vec<D> arm_a{0.0}, arm_b{0.0};
    Vec<D> gap{0.0};  // from a's point to b's
    double length = 0;
  };

  // The system is told what the joints turn. Both inputs must outlive the object.
  JointSystem(SmoothSystem<D>& system, std::span<const JointRows<D>> joints, WorldWork& work);

  // False if a joint turns a body that can turn about some axes only.
  bool can_be_solved() const { return can_be_solved_; }
  const std::vector<Row>& rows() const { return rows_; }
  const std::vector<Hold>& holds() const { return holds_; }
  // Impulses of all rows so far, and what was last added to them.
  std::vector<double>& impulses() { return impulses_; }
  const std::vector<double>& impulses() const { return impulses_; }
  Vec<D> impulse(const Hold& hold) const;  // upon b

  // The rows are those of this state from now on.
  void look(const State& state);
  // Of the rows. False if there is none.
  bool factor();
  // J v of the rows' own state.
  const std::vector<double>& speeds(const State& state);
  // Errors of the joints' places; the largest, in units of its tolerance. The rows stay.
  double find_errors(const State& state);
  const std::vector<double>& errors() const { return values_; }
  // Whether the errors last found are too large to be closed at once, in a step of `h` seconds.
  bool wide_open(double h) const;

  // Each solves until nothing is missing but rounding, by the rows and the factor that there are;
  // the state may be near the one that they are from. False if that does not converge.
  bool close_gaps(State& state);                 // moves the places
  bool stop_parting(State& state, bool counts);  // kicks; `counts` among the impulses
  bool hold_at_end(State& state, double h);      // kicks so that places hold after h
  void hold_accelerations(const State& state, Pull<D>& pull, double time);

  // That of all joints (see JointRows), if impulses were those of `time` seconds.
  double swing_squared(std::span<const double> impulses, double time) const;
  std::span<const double> last() const { return values_; }
  void count_solve() const;  // of all rows at once

 private:
  // A body as rows need it.
  struct Frame {
    bool off_centre = false;  // some joint holds it off its centre
    bool turns = false;
    Mat<D> axes{1.0};
    Inertia<D> inverse_inertia{0.0};
    Vec<D> velocity{0.0}, acceleration{0.0};
    Spin<D> spin{0.0}, turning{0.0};  // angular velocity and acceleration
  };

  void add(const JointRows<D>& joint);
  void place(const State& state);
  void find_velocities(const State& state);
  void solve();
  void kick(State& state, std::span<const double> impulses) const;
  double missing_speed(const State& state);
  template <class Missing, class Mend>
  bool settle(Missing&& missing, Mend&& mend);

  SmoothSystem<D>& system_;
  WorldWork& work_;
  bool can_be_solved_ = true;
  bool compliant_ = false;
  std::vector<Frame> frames_;  // one a body
  std::vector<Hold> holds_;
  std::vector<Row> rows_;
  EnvelopeSystem factor_;
  std::vector<double> values_;  // what is missing, then impulses
  std::vector<double> speeds_, impulses_;
};

}  // namespace lantern::physics
