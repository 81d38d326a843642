#include "physics/energy.hpp"

#include "physics/body_lookup.hpp"

namespace lantern {
namespace {

template <int D>
bool counts(const Body<D>& body) {
  return body.kind == BodyKind::dynamic_body && body.inverse_mass > 0;
}

template <int D>
EndMotion<D> at_rest(const Body<D>& body) {
  return {body.orientation, Vec<D>(0.0), Spin<D>(0.0)};
}

template <int D>
double product(const Spin<D>& a, const Spin<D>& b) {
  if constexpr (D == 2) {
    return a * b;
  } else {
    return glm::dot(a, b);
  }
}

template <int D>
double attraction(std::span<const Body<D>> bodies, double gravitation) {
  double sum = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      if (!counts(bodies[i]) && !counts(bodies[j])) continue;
      const double length = glm::length(bodies[j].position - bodies[i].position);
      if (length > 0)
        sum -= gravitation * attracting_mass(bodies[i]) * attracting_mass(bodies[j]) / length;
    }
  return sum;
}

}  // namespace

template <int D>
Energy energy(std::span<const Body<D>> bodies, const Forces<D>& forces) {
  Energy sum;
  for (const Body<D>& body : bodies) {
    if (!counts(body)) continue;
    const double mass = 1 / body.inverse_mass;
    sum.linear += mass * glm::dot(body.velocity, body.velocity) / 2;
    sum.rotational += product<D>(body.angular_momentum, angular_velocity(body)) / 2;
    sum.gravity -= mass * glm::dot(forces.gravity, body.position);
  }
  const BodyLookup<D> lookup(bodies);
  for (const Spring<D>& spring : forces.springs) {
    const Body<D>& a = bodies[lookup.index_of(spring.a, "spring")];
    const Body<D>& b = bodies[lookup.index_of(spring.b, "spring")];
    const double length =
        stretched<D>(spring, b.position - a.position, at_rest(a), at_rest(b)).length;
    const double stretch = length - spring.rest_length;
    sum.springs += spring.stiffness * stretch * stretch / 2;
  }
  if (forces.gravitation > 0) sum.attraction = attraction<D>(bodies, forces.gravitation);
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
template Vec<2> momentum(std::span<const Body<2>>);
template Vec<3> momentum(std::span<const Body<3>>);
template Spin<2> angular_momentum<2>(std::span<const Body<2>>);
template Spin<3> angular_momentum<3>(std::span<const Body<3>>);

}  // namespace lantern
