#include <algorithm>
#include <cmath>

#include "measure/error_metrics.hpp"
#include "measure/exact_free_top.hpp"
#include "measure/problem_scene.hpp"
#include "physics/mass.hpp"

namespace lantern {
namespace {

class FreeTopMetric : public ErrorMetric {
 public:
  FreeTopMetric(std::size_t body, const FreeTop& top) : body_(body), top_(top) {}

  void look(const Observation& now) override {
    const glm::dquat q = now.states[body_].orientation.q;
    const LongQuat off = glm::conjugate(top_.orientation(now.time)) * LongQuat(q.w, q.x, q.y, q.z);
    // The angle of a turn, whatever the quaternion's sign and length.
    const long double angle =
        2 * std::atan2(std::sqrt(off.x * off.x + off.y * off.y + off.z * off.z), std::abs(off.w));
    const auto error = static_cast<double>(angle);
    if (!std::isnan(worst_) && !(error <= worst_)) worst_ = error;
  }
  std::vector<Norm> norms() const override {
    return {{"att", worst_, "rad", "largest angle over the run by which the orientation is off"}};
  }

 private:
  std::size_t body_;
  FreeTop top_;
  double worst_ = 0;
};

}  // namespace

std::unique_ptr<ErrorMetric> free_top_metric(const Scenario& scenario) {
  const std::size_t i = the_body(scenario);
  require_links(scenario, 0);
  const BodySpec& body = scenario.bodies[i];
  if (scenario.world.dimension != 3) refuse_problem(scenario, "the world must be solid");
  if (body.angular_drag != 0) refuse_problem(scenario, "nothing may brake it");
  if (!body.may_turn || std::holds_alternative<AxisBox<3>>(body.shape))
    refuse_problem(scenario, "its body cannot turn; give a box `oriented = true`");
  MassProperties<3> mass = mass_of<3>(body.shape, body.density);
  if (body.mass > 0) mass = scaled_to<3>(mass, body.mass);
  for (int axis = 0; axis < 3; ++axis)
    if (!(mass.inertia[axis] > 0)) refuse_problem(scenario, "its body has no extent");
  const Rotation<3> start = turned(Rotation<3>(), body.axis * body.angle);
  const LongQuat orientation = glm::normalize(LongQuat(start.q.w, start.q.x, start.q.y, start.q.z));
  const LongVec spin = glm::conjugate(orientation) * (LongVec(body.axis) * LongVec(body.spin));
  LongVec inverse, momentum;
  for (int axis = 0; axis < 3; ++axis) {
    inverse[axis] = 1 / mass.inertia[axis];  // in double, as the engine has it
    momentum[axis] = spin[axis] / inverse[axis];
  }
  return std::make_unique<FreeTopMetric>(i, FreeTop(inverse, orientation, momentum));
}

}  // namespace lantern
