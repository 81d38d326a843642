// What the error metrics read from a scenario, and how they refuse one that is not their problem.
#pragma once

#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "geometry/flat.hpp"
#include "measure/error_metric.hpp"

namespace lantern {

using LongVec3 = glm::vec<3, long double>;

// Throws Refused: "'slide' is no problem of kind slide: <why>".
[[noreturn]] void refuse_problem(const Scenario& scenario, std::string_view why);

// Indices of the bodies that forces move.
std::vector<std::size_t> dynamic_bodies(const Scenario& scenario);

// The only one. Refuses none and several.
std::size_t the_body(const Scenario& scenario);

// Refuses any other number of springs and joints.
void require_links(const Scenario& scenario, std::size_t count);

// As the engine has it.
double mass_of_body(const Scenario& scenario, std::size_t body);

// A spring or rod as the engine makes it: between the centres of bodies, or a centre and a fixed
// point.
struct Tie {
  std::size_t a = 0;
  std::optional<std::size_t> b;  // a dynamic body; none: it ends at `anchor`
  LongVec3 anchor{0.0L};
  long double rest_length = 0;
};

// Refuses an end that is off a body's centre or on a kinematic body.
Tie read_tie(const Scenario& scenario, const LinkSpec& link);

// Whether both point along one line, exactly but for rounding; zero does with any.
bool parallel(const LongVec3& a, const LongVec3& b);
bool are_parallel(const Vec<3>& a, const Vec<3>& b);

// --- bodies in contact ---

inline constexpr const char* kEnergyMeaning = "largest change of the energy over the run, relative";
inline constexpr const char* kMomentumMeaning =
    "largest change of the momentum over the run, over the sum of m |v| at the start";

// The largest error met. Once it is no number it stays so.
class Worst {
 public:
  void meet(double error) {
    if (std::isnan(value_)) return;
    if (!(std::abs(error) <= value_)) value_ = std::abs(error);
  }
  double value() const { return value_; }

 private:
  double value_ = 0;
};

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

// Bodies that should hang or stand still, each carrying all later ones. Newton's second law gives
// the mean force that held the bodies i, i+1, ... up between two looks:
//
//   F_i = sum over j >= i of m_j (g + dv_j / dt)        exact: sum of m_j g
//
// so that forces are measured whoever moves the bodies.
class Burdens {
 public:
  Burdens(const Scenario& scenario, std::vector<std::size_t> bodies);
  void look(const Observation& now);
  double worst() const { return worst_.value(); }  // share of the exact force

 private:
  std::vector<std::size_t> bodies_;
  std::vector<double> masses_;
  Vec<3> up_{0.0};
  double gravity_ = 0;
  double time_ = 0;
  std::vector<double> speeds_;  // upwards, at the look before
  Worst worst_;
};

}  // namespace lantern
