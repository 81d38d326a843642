// Dormand and Prince's method as a solver: the reference for smooth problems, at its price.
#pragma once

#include "measure/simulation.hpp"

namespace lantern::measure {

// For scenes of points: bodies that neither collide nor are turned, without rods. It chooses its
// steps itself; what it is given as a step says how exact it is to be: 1e-3 of the scene's size and
// speed at the problem's largest step, and 32 times better for each halving, down to 1e-14.
class DormandPrinceSolver : public Solver {
 public:
  std::string name() const override { return "dormand_prince"; }
  std::string version() const override { return {}; }
  std::optional<std::string> cannot(const Scenario& scenario) const override;
  std::unique_ptr<Simulation> start(const Scenario& scenario, double h) const override;
};

}  // namespace lantern::measure
