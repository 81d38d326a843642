// Smooth forces, and the energy that bodies have under them.
#include "physics/forces.hpp"

#include "base/stop.hpp"

namespace lantern::physics {
namespace {

template <int D>
bool counts(const Body<D>& body) {
  return body.is_dynamic() && body.inverse_mass > 0;
}

template <int D>
EndMotion<D> at_rest(const Body<D>& body) {
  return {body.orientation, Vec<D>(0.0), Spin<D>(0.0)};
}

// Of two bodies by Newton's law; zero if they lie at one point, or if neither can be moved.
template <int D>
double energy_of_attraction(const Body<D>& a, const Body<D>& b, double gravitation) {
  if (!counts(a) && !counts(b)) return 0;
  const double length = glm::length(b.position - a.position);
  if (length == 0) return 0;
  return -gravitation * attracting_mass(a) * attracting_mass(b) / length;
}

// Of its motion and height.
template <int D>
void add_own(const Body<D>& body, const Forces<D>& forces, Energy& sum) {
  if (!counts(body)) return;
  const double mass = 1 / body.inverse_mass;
  sum.linear += mass * glm::dot(body.velocity, body.velocity) / 2;
  sum.rotational += dot(body.angular_momentum, angular_velocity(body)) / 2;
  sum.gravity -= mass * glm::dot(forces.gravity, body.position);
}

template <int D>
double energy_of_spring(const Spring<D>& spring, const Body<D>& a, const Body<D>& b) {
  const double length =
      stretched<D>(spring, b.position - a.position, at_rest(a), at_rest(b)).length;
  const double stretch = length - spring.rest_length;
  return spring.stiffness * stretch * stretch / 2;
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
Energy energy(std::span<const Body<D>> bodies, const Forces<D>& forces) {
  Energy sum;
  for (const Body<D>& body : bodies) add_own(body, forces, sum);
  const BodyLookup<D> lookup(bodies);
  for (const Spring<D>& spring : forces.springs)
    sum.springs += energy_of_spring(spring, bodies[lookup.index_of(spring.a, "spring")],
                                    bodies[lookup.index_of(spring.b, "spring")]);
  if (forces.gravitation > 0)
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      stop_if_asked();
      for (std::size_t j = i + 1; j < bodies.size(); ++j)
        sum.attraction += energy_of_attraction(bodies[i], bodies[j], forces.gravitation);
    }
  return sum;
}

template <int D>
Energy energy_of(const Body<D>& body, std::span<const Body<D>> bodies, const Forces<D>& forces) {
  stop_if_asked();
  Energy sum;
  if (!counts(body)) return sum;
  add_own(body, forces, sum);
  const BodyLookup<D> lookup(bodies);
  for (const Spring<D>& spring : forces.springs) {
    if (spring.a != body.id && spring.b != body.id) continue;
    const Body<D>& a = bodies[lookup.index_of(spring.a, "spring")];
    const Body<D>& b = bodies[lookup.index_of(spring.b, "spring")];
    sum.springs += energy_of_spring(spring, a, b) * (counts(a) && counts(b) ? 0.5 : 1.0);
  }
  if (forces.gravitation > 0)
    for (const Body<D>& other : bodies)
      if (other.id != body.id)
        sum.attraction +=
            energy_of_attraction(body, other, forces.gravitation) * (counts(other) ? 0.5 : 1.0);
  return sum;
}

template <int D>
Vec<D> momentum(std::span<const Body<D>> bodies) {
  Vec<D> sum{0.0};
  for (const Body<D>& body : bodies)
    if (counts(body)) sum += body.velocity / body.inverse_mass;
  return sum;
}

template <int D>
Spin<D> angular_momentum(std::span<const Body<D>> bodies) {
  Spin<D> sum{0.0};
  for (const Body<D>& body : bodies)
    if (counts(body))
      sum += cross(body.position, body.velocity / body.inverse_mass) + body.angular_momentum;
  return sum;
}

#define LANTERN_INSTANTIATE(D)                                                           \
  template Stretch<D> stretched(const Spring<D>&, const Vec<D>&, const EndMotion<D>&,    \
                                const EndMotion<D>&);                                    \
  template Energy energy(std::span<const Body<D>>, const Forces<D>&);                    \
  template Energy energy_of(const Body<D>&, std::span<const Body<D>>, const Forces<D>&); \
  template Vec<D> momentum(std::span<const Body<D>>);                                    \
  template Spin<D> angular_momentum<D>(std::span<const Body<D>>);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
