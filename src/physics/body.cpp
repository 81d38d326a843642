// What makes a body one that the world can take, and its mass.
#include "physics/body.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/error.hpp"
#include "geometry/not_finite.hpp"

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

std::string named(const std::string& name) { return fmt::format("body '{}'", name); }

template <int D>
void check_shape(const Shape<D>& shape, const std::string& who) {
  const auto sizes = [&](const Vec<D>& half) {
    for (int i = 0; i < D; ++i) require_not_negative(half[i], who, "half_size");
  };
  std::visit(
      EachShape{
          [&](const Sphere& s) { require_not_negative(s.radius, who, "radius"); },
          [&](const AxisBox<D>& s) { sizes(s.half_size); },
          [&](const OrientedBox<D>& s) { sizes(s.half_size); },
          [&](const Capsule& s) {
            require_not_negative(s.radius, who, "radius");
            require_not_negative(s.half_length, who, "half_length");
          },
          [&](const HalfSpace<D>& s) {
            const double length = glm::length(s.normal);
            if (!(std::abs(length - 1) <= 1e-9))
              throw Refused(fmt::format("{}: normal has length {}, must have 1", who, length));
          },
      },
      shape);
}

void check_rotation(const Rotation<2>& r, const std::string& who) {
  require_finite(r.angle, who, "orientation");
}
void check_rotation(const Rotation<3>& r, const std::string& who) {
  const double length = glm::length(r.q);
  if (!(std::abs(length - 1) <= 1e-6))
    throw Refused(fmt::format("{}: orientation has length {}, must have 1", who, length));
}

double inverse(double value) { return value > 0 ? 1 / value : 0; }
Vec<3> inverse(const Vec<3>& value) {
  return {inverse(value.x), inverse(value.y), inverse(value.z)};
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

template <int D>
void check_body(const Body<D>& body) {
  const std::string who = named(body.name);
  require_finite<D>(body.position, who, "position");
  check_rotation(body.orientation, who);
  require_finite<D>(body.velocity, who, "velocity");
  require_finite(body.angular_momentum, who, "angular_momentum");
  require_finite(body.kinematic_spin, who, "kinematic_spin");
  check_shape<D>(body.shape, who);
  require_not_negative(body.density, who, "density");
  require_not_negative(body.mass, who, "mass");
  require_not_negative(body.material.restitution, who, "restitution");
  require_not_negative(body.material.friction, who, "friction");
  require_not_negative(body.linear_drag, who, "linear_drag");
  require_not_negative(body.angular_drag, who, "angular_drag");
  if (body.is_dynamic() && std::holds_alternative<HalfSpace<D>>(body.shape))
    throw Refused(fmt::format("{}: shape is a half-space, which cannot be dynamic", who));
  if (!is_valid(body.box())) throw Refused(fmt::format("{}: its box is not finite", who));
}

template <int D>
void derive_mass(Body<D>& body) {
  body.inverse_mass = 0;
  body.inverse_inertia = Spin<D>(0.0);
  if (!body.is_dynamic()) return;
  MassProperties<D> properties =
      mass_of<D>(body.shape, body.mass > 0 && body.density == 0 ? 1 : body.density);
  if (body.mass > 0) properties = scaled_to<D>(properties, body.mass);
  const std::string who = named(body.name);
  if (!(properties.mass > 0))
    throw Refused(fmt::format("{}: mass is 0 by its size and density; give it a mass", who));
  if (!std::isfinite(properties.mass) || !is_finite(properties.inertia) ||
      !std::isfinite(1 / properties.mass))
    throw Refused(fmt::format("{}: mass or inertia is out of range", who));
  body.mass = properties.mass;
  body.inverse_mass = 1 / properties.mass;
  if (body.may_turn && turns<D>(body.shape)) body.inverse_inertia = inverse(properties.inertia);
  if (!is_finite(body.inverse_inertia))
    throw Refused(fmt::format("{}: inertia is out of range", who));
}

#define LANTERN_INSTANTIATE(D)                                     \
  template MassProperties<D> mass_of(const Shape<D>&, double);     \
  template MassProperties<D> scaled_to(MassProperties<D>, double); \
  template void check_body(const Body<D>&);                        \
  template void derive_mass(Body<D>&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
