// The error metrics of all problems, and what they read from a scenario: masses, links, materials,
// places and speeds. Each throws Refused, naming what is wrong, if the scenario is not that
// problem.
#pragma once

#include "measure/forms/closed_forms.hpp"
#include "measure/invariants.hpp"

namespace lantern::measure {

using MetricsOf = MetricMaker(const Scenario&);

// Of a metric that reads all it needs when it is made.
template <class Metric>
MetricMaker made_of(const Scenario& scenario) {
  return [&scenario] { return std::make_unique<Metric>(scenario); };
}

// Of bodies that are known at every time (TrajectoryMetric).
inline MetricMaker trajectories(long double length, long double speed,
                                TrajectoryMetric::ExactStates exact, std::string parameters = "") {
  return [length, speed, exact = std::move(exact), parameters = std::move(parameters)] {
    return std::make_unique<TrajectoryMetric>(length, speed, exact, parameters);
  };
}

// A problem is its metric, and, where that is costly to make, what is asked of it without the
// answer: some take runs of their own, or the cube of their bodies.
struct Problem {
  Solution solution;
  MetricsOf* metrics;
  void (*require)(const Scenario&) = nullptr;
};

// Those of each file of this folder.
using Problems = std::span<const Problem>();
Problems smooth_problems, joints_problems, impacts_problems, ground_problems, heaps_problems,
    tumble_problems;

// --- what they read from a scenario ---

// Throws Refused: "'slide' is no problem of kind slide: <why>".
[[noreturn]] void refuse_problem(const Scenario& scenario, std::string_view why);

// Indices of the bodies that forces move.
std::vector<std::size_t> dynamic_bodies(const Scenario& scenario);

// The only one. Refuses none and several.
std::size_t the_body(const Scenario& scenario);

// Refuses any other number of springs and joints.
void require_links(const Scenario& scenario, std::size_t count);

// For answers that know nothing of them: refuses contacts and attraction where there are two bodies
// or more, bodies that are steered or begin asleep, and forces of the script.
void require_nothing_else(const Scenario& scenario, bool may_attract = false);

// As the engine has it.
double mass_of_body(const Scenario& scenario, std::size_t body);

// Whether both point along one line, but for rounding; zero does with any.
bool are_parallel(const Vec<3>& a, const Vec<3>& b);

// --- bodies in contact ---

inline constexpr const char* kEnergyMeaning = "largest change of the energy over the run, relative";
inline constexpr const char* kAttitudeMeaning =
    "largest angle over the run by which the orientation is off";
// The angle of the turn from one to the other, whatever the quaternion's sign and length.
inline double angle_between(const LongQuat& exact, const BodyState& state) {
  const glm::dquat& q = state.orientation.q;
  const LongQuat off = glm::conjugate(exact) * LongQuat(q.w, q.x, q.y, q.z);
  return static_cast<double>(
      2 * std::atan2(std::sqrt(off.x * off.x + off.y * off.y + off.z * off.z), std::abs(off.w)));
}
inline constexpr const char* kMomentumMeaning =
    "largest change of the momentum over the run, over the sum of m |v| at the start";

// What does not move, and all others stand on or run into: a half-space, or the face of a box that
// keeps to the axes which looks against gravity, or, without gravity, at the first moving body.
struct Footing {
  std::size_t body = 0;
  Vec<3> normal{0.0};  // out of it, unit
  double height = 0;   // of its face along `normal`
};

// All that moves, in order of the scenario. Refuses kinematic bodies, drag and brains: no contact
// problem has them.
std::vector<std::size_t> moving_bodies(const Scenario& scenario);
// Refuses none or several static bodies, and shapes other than those above.
Footing ground_of(const Scenario& scenario);
// Refuses a body that does not touch the ground within a billionth of its size.
void require_on_ground(const Scenario& scenario, const Footing& ground, std::size_t body);
// Refuses a body that moves or turns at first.
void require_at_rest(const Scenario& scenario, std::size_t body);
// Gravity, seen from a ground that leans. Units a second².
struct Slope {
  double pull = 0;       // onto the ground
  double push = 0;       // along it
  Vec<3> downhill{0.0};  // unit
};
// Refuses gravity that is not slantwise into the ground.
Slope slope_of(const Scenario& scenario, const Footing& ground);
// Units a second². Refuses gravity that is not straight into the ground.
double pull_onto(const Scenario& scenario, const Footing& ground);

// Of two bodies that touch.
double friction_between(const Scenario& scenario, std::size_t a, std::size_t b);
double restitution_between(const Scenario& scenario, std::size_t a, std::size_t b);

// From the centre to the farthest point along the unit vector `along`, as the body lies at first.
double reach_along(const BodySpec& body, const Vec<3>& along);
bool is_ball(const BodySpec& body);
bool turns(const BodySpec& body);  // contacts may turn it
// Inertia over m r²: 2/5 of a ball, 1/2 of a disc.
double roundness(const Scenario& scenario);

// --- what is read from the states of a run alone ---

// As the bodies are at first.
std::vector<BodyState> first_states(const Scenario& scenario);

// Where a point of a body is that is given in its own axes.
Vec<3> point_of(const BodyState& state, const Vec<3>& at);
// Where a link ends that begins at its body a.
Vec<3> far_end(const LinkSpec& link, const std::vector<BodyState>& states);

// What `at` gives for the time of each of a problem's samples, in order.
auto at_samples(const ProblemSpec& problem, auto&& at) {
  auto all = std::make_shared<std::vector<decltype(at(0.0L))>>();
  for (std::uint32_t n = 0; n <= problem.samples; ++n)
    all->push_back(at(static_cast<long double>(problem.seconds) * n / problem.samples));
  return all;
}

// --- how the energy of a run changes, by the states of its bodies alone ---

class EnergyMeter {
 public:
  // The scenario must outlive it.
  explicit EnergyMeter(const Scenario& scenario) : invariants_(scenario) {}

  // Gives what it found.
  Kept look(const Observation& at) {
    const Kept now = invariants_.of(at.states);
    if (!begun_) start_ = now.energy;
    begun_ = true;
    kinetic_ = std::max(kinetic_, now.kinetic_energy);
    gained_ = std::max(gained_, now.energy - start_);
    return now;
  }

  // The largest gain so far, over the largest kinetic energy.
  double gain() const { return kinetic_ > 0 ? gained_ / kinetic_ : 0; }
  static constexpr const char* kGainMeaning =
      "largest gain of energy over the run, over the largest kinetic energy";
  // The same over what there was at first, which must be above 0.
  double growth() const { return gained_ / start_; }

 private:
  Invariants invariants_;
  bool begun_ = false;
  double start_ = 0, kinetic_ = 0, gained_ = 0;
};

}  // namespace lantern::measure
