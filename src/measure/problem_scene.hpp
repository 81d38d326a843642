// What the smooth problems read from a scenario, and how they refuse one that is not theirs.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "geometry/flat.hpp"
#include "measure/error_metric.hpp"

namespace lantern {

using LongVec3 = glm::vec<3, long double>;

// Indices of the bodies that forces move.
std::vector<std::size_t> dynamic_bodies(const Scenario& scenario);

// The only one. Throws Refused, naming the problem, if there is none or there are more.
std::size_t the_body(const Scenario& scenario, std::string_view problem);

// Throws Refused, naming the problem, unless there are `count` springs and joints.
void require_links(const Scenario& scenario, std::size_t count, std::string_view problem);

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

// Throws Refused, naming the problem, if an end is off a body's centre or on a kinematic body.
Tie read_tie(const Scenario& scenario, const LinkSpec& link, std::string_view problem);

// Whether both point along one line, exactly but for rounding; zero does with any.
bool parallel(const LongVec3& a, const LongVec3& b);

}  // namespace lantern
