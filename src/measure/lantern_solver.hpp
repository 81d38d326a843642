// Lantern's own engine, the one that makes the frames, by one of its methods.
#pragma once

#include "language/method.hpp"
#include "measure/simulation.hpp"

namespace lantern::measure {

class LanternSolver : public Solver {
 public:
  explicit LanternSolver(Method method) : method_(std::move(method)) {}
  std::string name() const override { return method_.name; }
  std::string version() const override { return {}; }
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

}  // namespace lantern::measure
