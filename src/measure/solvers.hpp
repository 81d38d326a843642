// Lantern's own engine, the one that makes the frames, by one of its methods.
#pragma once

#include "language/method.hpp"
#include "measure/simulation.hpp"

namespace lantern::measure {

class LanternSolver : public Solver {
 public:
  explicit LanternSolver(Method method) : method_(std::move(method)) {}
  std::string name() const override { return method_.name; }
  // What the method would not change it leaves to others: no contacts, no method of contacts.
  std::optional<std::string> cannot(const Scenario& scenario) const override;
  // A scenario without a [problem] starts empty: its script inserts the bodies.
  std::unique_ptr<Simulation> start(const Scenario& scenario, double h) const override;

 private:
  Method method_;
};

// The methods that the problem asks for; without a wish, all that make a difference to the scene:
// contact methods where bodies collide, integrators where forces act, rotations where a body of a
// solid world turns, else the file's own method under the name "as written".
std::vector<Method> methods_for(const Scenario& scenario);

// Dormand and Prince's method as a solver: the reference for smooth problems, at its price.

// For scenes of points: bodies that neither collide nor are turned, without rods. It chooses its
// steps itself; what it is given as a step says how exact it is to be: 1e-3 of the scene's size and
// speed at the problem's largest step, and 32 times better for each halving, down to 1e-14.
class DormandPrinceSolver : public Solver {
 public:
  std::string name() const override { return "dormand_prince"; }
  std::optional<std::string> cannot(const Scenario& scenario) const override;
  std::unique_ptr<Simulation> start(const Scenario& scenario, double h) const override;
};

}  // namespace lantern::measure
