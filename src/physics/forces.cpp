#include "physics/forces.hpp"

namespace lantern::physics {
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

template Stretch<2> stretched(const Spring<2>&, const Vec<2>&, const EndMotion<2>&,
                              const EndMotion<2>&);
template Stretch<3> stretched(const Spring<3>&, const Vec<3>&, const EndMotion<3>&,
                              const EndMotion<3>&);
template double attracting_mass(const Body<2>&);
template double attracting_mass(const Body<3>&);
template Stretch<2> attracted(double, const Vec<2>&);
template Stretch<3> attracted(double, const Vec<3>&);

}  // namespace lantern::physics
