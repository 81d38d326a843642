#include "physics/forces.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/error.hpp"
#include "geometry/not_finite.hpp"

namespace lantern {
namespace {

template <int D>
void check_present(BodyId id, const std::vector<BodyId>& ids, const std::string& field) {
  if (!std::binary_search(ids.begin(), ids.end(), id))
    throw Refused(fmt::format("{}: there is no body {}", field, id));
}

template <int D>
void check_spring(const Spring<D>& spring, const std::vector<BodyId>& ids,
                  const std::string& name) {
  check_present<D>(spring.a, ids, name + ": a");
  check_present<D>(spring.b, ids, name + ": b");
  if (spring.a == spring.b)
    throw Refused(fmt::format("{}: both ends are on body {}", name, spring.a));
  require_finite(spring.at_a, name, "at_a");
  require_finite(spring.at_b, name, "at_b");
  require_not_negative(spring.rest_length, name, "rest_length");
  require_not_negative(spring.stiffness, name, "stiffness");
  require_not_negative(spring.damping, name, "damping");
}

}  // namespace

template <int D>
Stretch<D> stretched(const Spring<D>& spring, const Vec<D>& between, const EndMotion<D>& a,
                     const EndMotion<D>& b) {
  Stretch<D> s;
  // An end at the centre needs no turning, which is the common case and costs a sine.
  if (spring.at_a != Vec<D>(0.0)) s.arm_a = matrix(a.orientation) * spring.at_a;
  if (spring.at_b != Vec<D>(0.0)) s.arm_b = matrix(b.orientation) * spring.at_b;
  const Vec<D> line = between + (s.arm_b - s.arm_a);
  s.length = glm::length(line);
  s.damping = spring.damping;
  // Without a direction, a spring of no rest length pulls back whichever way its ends go.
  s.stiffness = s.length > 0 || spring.rest_length == 0 ? spring.stiffness : 0;
  if (!(s.length > 0)) return s;
  s.direction = line / s.length;
  const Vec<D> motion = (b.velocity + cross(b.angular_velocity, s.arm_b)) -
                        (a.velocity + cross(a.angular_velocity, s.arm_a));
  s.rate = glm::dot(motion, s.direction);
  s.tension = spring.stiffness * (s.length - spring.rest_length) + spring.damping * s.rate;
  return s;
}

template <int D>
double attracting_mass(const Body<D>& body) {
  return body.inverse_mass > 0 ? 1 / body.inverse_mass : body.mass;
}

template <int D>
Stretch<D> attracted(double strength, const Vec<D>& between) {
  Stretch<D> s;
  s.length = glm::length(between);
  if (!(s.length > 0)) return s;
  s.direction = between / s.length;
  s.tension = strength / s.length / s.length;
  s.stiffness = -2 * s.tension / s.length;
  return s;
}

template <int D>
void check_forces(const Forces<D>& forces, std::span<const Body<D>> bodies) {
  std::vector<BodyId> ids;
  for (const Body<D>& body : bodies) {
    ids.push_back(body.id);
    const std::string who = fmt::format("body '{}'", body.name);
    require_not_negative(body.linear_drag, who, "linear_drag");
    require_not_negative(body.angular_drag, who, "angular_drag");
  }
  std::sort(ids.begin(), ids.end());
  require_finite(forces.gravity, "forces", "gravity");
  require_not_negative(forces.gravitation, "forces", "gravitation");
  for (std::size_t i = 0; i < forces.springs.size(); ++i)
    check_spring<D>(forces.springs[i], ids, fmt::format("spring {}", i));
  for (std::size_t i = 0; i < forces.pushes.size(); ++i) {
    const Push<D>& push = forces.pushes[i];
    check_present<D>(push.body, ids, fmt::format("push {}", i));
    const std::string who = fmt::format("push {} on body {}", i, push.body);
    require_finite(push.at, who, "at");
    require_finite(push.force, who, "force");
  }
}

template Stretch<2> stretched(const Spring<2>&, const Vec<2>&, const EndMotion<2>&,
                              const EndMotion<2>&);
template Stretch<3> stretched(const Spring<3>&, const Vec<3>&, const EndMotion<3>&,
                              const EndMotion<3>&);
template double attracting_mass(const Body<2>&);
template double attracting_mass(const Body<3>&);
template Stretch<2> attracted(double, const Vec<2>&);
template Stretch<3> attracted(double, const Vec<3>&);
template void check_forces(const Forces<2>&, std::span<const Body<2>>);
template void check_forces(const Forces<3>&, std::span<const Body<3>>);

}  // namespace lantern
