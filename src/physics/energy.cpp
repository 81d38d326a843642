#include "physics/energy.hpp"

#include "base/stop.hpp"
#include "physics/body_lookup.hpp"

namespace lantern::physics {
namespace {

template <int D>
bool counts(const Body<D>& body) {
  return body.kind == BodyKind::dynamic_body && body.inverse_mass > 0;
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

template Energy energy(std::span<const Body<2>>, const Forces<2>&);
template Energy energy(std::span<const Body<3>>, const Forces<3>&);
template Energy energy_of(const Body<2>&, std::span<const Body<2>>, const Forces<2>&);
template Energy energy_of(const Body<3>&, std::span<const Body<3>>, const Forces<3>&);
template Vec<2> momentum(std::span<const Body<2>>);
template Vec<3> momentum(std::span<const Body<3>>);
template Spin<2> angular_momentum<2>(std::span<const Body<2>>);
template Spin<3> angular_momentum<3>(std::span<const Body<3>>);

}  // namespace lantern::physics
