// The joints of an island solved all at once, between sweeps over its contacts: what light links
// carry need not wait until single impulses have run from end to end. And how gaps are closed.
#pragma once

#include <vector>

#include "physics/joint_row.hpp"
#include "physics/joint_rows.hpp"
#include "physics/world_config.hpp"

namespace lantern::physics {

template <int D>
class JointBlock {
 public:
  // Of joints that were refreshed, for bodies as they are. False if that is too much work: then
  // they are swept over one by one, and nothing closes their gaps.
  bool refresh(const std::vector<JointRows<D>>& joints, const std::vector<SolverBody<D>>& bodies);

  // Impulses after which no joint parts.
  void solve_velocities(std::vector<JointRows<D>>& joints, std::vector<SolverBody<D>>& bodies,
                        Sweep& sweep, WorldWork& work);
  // The same of mean velocities.
  void correct_positions(const std::vector<JointRows<D>>& joints,
                         std::vector<SolverBody<D>>& bodies, Sweep& sweep, WorldWork& work);
  // Moves bodies, after `h` seconds, so that gaps are closed: so often anew, until nothing is
  // missing, no faster than penetration is pushed out, and never so that the widest gap grows.
  // Where a straight way overshoots (links in a line that are pulled across it), it is damped
  // (Levenberg, Quart. Appl. Math. 2, 1944).
  void close_gaps(std::vector<JointRows<D>>& joints, std::vector<Body<D>>& bodies, double h,
                  WorldWork& work);

 private:
  struct Place {
    Vec<D> position;
    Rotation<D> orientation;
    Spin<D> angular_momentum;
  };

  void list(const std::vector<JointRows<D>>& joints, const std::vector<SolverBody<D>>& bodies);
  void solve(const EnvelopeSystem& factor, WorldWork& work);
  bool damp();
  void keep(const std::vector<Body<D>>& bodies);
  void restore(std::vector<Body<D>>& bodies) const;
  double way_of(const std::vector<Body<D>>& bodies) const;
  double find_errors(std::vector<JointRows<D>>& joints, const std::vector<Body<D>>& bodies);
  void move(std::vector<Body<D>>& bodies, double share) const;

  std::vector<JointRow<D>> rows_;
  std::vector<std::uint32_t> joint_of_;  // of each row
  EnvelopeSystem factor_, damped_;
  bool solved_ = false;
  std::vector<Place> kept_;
  std::vector<double> values_;  // what is missing, then impulses
};

}  // namespace lantern::physics
