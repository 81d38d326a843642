// What makes a body one that the world can take.

#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "geometry/not_finite.hpp"
#include "physics/body.hpp"
#include "physics/mass.hpp"

namespace lantern::physics {
namespace {

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
  if (body.kind == BodyKind::dynamic_body && std::holds_alternative<HalfSpace<D>>(body.shape))
    throw Refused(fmt::format("{}: shape is a half-space, which cannot be dynamic", who));
  if (!is_valid(body.box())) throw Refused(fmt::format("{}: its box is not finite", who));
}

template <int D>
void derive_mass(Body<D>& body) {
  body.inverse_mass = 0;
  body.inverse_inertia = Spin<D>(0.0);
  if (body.kind != BodyKind::dynamic_body) return;
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

template void check_body(const Body<2>&);
template void check_body(const Body<3>&);
template void derive_mass(Body<2>&);
template void derive_mass(Body<3>&);

}  // namespace lantern::physics
