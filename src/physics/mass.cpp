#include "physics/mass.hpp"

#include <numbers>

namespace lantern::physics {
namespace {

MassProperties<2> of_sphere(const Sphere& disc, Vec<2>, double density) {
  const double square = disc.radius * disc.radius;
  const double mass = density * std::numbers::pi * square;
  return {mass, mass * square / 2};
}

MassProperties<3> of_sphere(const Sphere& ball, Vec<3>, double density) {
  const double square = ball.radius * ball.radius;
  const double mass = density * (4.0 / 3) * std::numbers::pi * square * ball.radius;
  return {mass, Vec<3>(mass * square * 2 / 5)};
}

MassProperties<2> of_box(const Vec<2>& half, double density) {
  const double mass = density * 4 * half.x * half.y;
  return {mass, mass * glm::dot(half, half) / 3};
}

MassProperties<3> of_box(const Vec<3>& half, double density) {
  const double mass = density * 8 * half.x * half.y * half.z;
  const Vec<3> square = half * half;
  return {mass, Vec<3>(square.y + square.z, square.x + square.z, square.x + square.y) * (mass / 3)};
}

// A rectangle and, moved to its ends, the halves of a disc. The centre of half a disc is c from the
// straight side. Moved away by the half length l, its inertia grows by m ((l + c)^2 - c^2), which
// is m l (l + 2 c).
MassProperties<2> of_capsule(const Capsule& capsule, Vec<2>, double density) {
  const double r = capsule.radius, l = capsule.half_length;
  const MassProperties<2> middle = of_box({r, l}, density),
                          caps = of_sphere({r}, Vec<2>(), density);
  const double c = 4 * r / (3 * std::numbers::pi);
  return {middle.mass + caps.mass, middle.inertia + caps.inertia + caps.mass * l * (l + 2 * c)};
}

// A cylinder and two half balls, in the same way; the centre of half a ball is at 3/8 of its
// radius.
MassProperties<3> of_capsule(const Capsule& capsule, Vec<3>, double density) {
  const double r = capsule.radius, l = capsule.half_length;
  const MassProperties<3> caps = of_sphere({r}, Vec<3>(), density);
  const double middle = density * std::numbers::pi * r * r * 2 * l;
  const double along = middle * r * r / 2 + caps.inertia.y;
  const double across =
      middle * (r * r / 4 + l * l / 3) + caps.inertia.x + caps.mass * l * (l + 2 * (3 * r / 8));
  return {middle + caps.mass, {across, along, across}};
}

}  // namespace

template <int D>
MassProperties<D> mass_of(const Shape<D>& shape, double density) {
  return std::visit(EachShape{
                        [&](const Sphere& s) { return of_sphere(s, Vec<D>(0.0), density); },
                        [&](const AxisBox<D>& s) { return of_box(s.half_size, density); },
                        [&](const OrientedBox<D>& s) { return of_box(s.half_size, density); },
                        [&](const Capsule& s) { return of_capsule(s, Vec<D>(0.0), density); },
                        [](const HalfSpace<D>&) { return MassProperties<D>{}; },
                    },
                    shape);
}

template <int D>
MassProperties<D> scaled_to(MassProperties<D> properties, double mass) {
  if (properties.mass > 0)
    properties.inertia *= mass / properties.mass;
  else
    properties.inertia = Spin<D>(0.0);
  properties.mass = mass;
  return properties;
}

template MassProperties<2> mass_of(const Shape<2>&, double);
template MassProperties<3> mass_of(const Shape<3>&, double);
template MassProperties<2> scaled_to(MassProperties<2>, double);
template MassProperties<3> scaled_to(MassProperties<3>, double);

}  // namespace lantern::physics
