// A rigid body and its state, its mass, and how it turns by itself.
#pragma once

#include <algorithm>
#include <optional>
#include <type_traits>

#include "base/name.hpp"
#include "geometry/shape.hpp"
#include "physics/manifold.hpp"
#include "physics/methods.hpp"
#include "spatial/structure.hpp"

namespace lantern::physics {

enum class BodyKind {
  dynamic_body,    // moved by forces and contacts
  kinematic_body,  // keeps the velocity that it was given, whatever it meets
  static_body,     // never moves
};

struct Material {
  double restitution = 0;  // of a pair, the larger one counts
  double friction = 0.5;   // of a pair, the geometric mean counts
};

// Angular momentum is kept, not angular velocity: a free body's does not change, however it turns.
template <int D>
struct Body {
  BodyId id = 0;  // given by the world
  Name name = {};
  Shape<D> shape{};
  BodyKind kind = BodyKind::dynamic_body;
  Vec<D> position{0.0};
  Rotation<D> orientation{};
  Vec<D> velocity{0.0};           // of the centre, units a second
  Spin<D> angular_momentum{0.0};  // about the centre, in the world's axes
  Spin<D> kinematic_spin{0.0};    // radians a second, of a kinematic body
  double density = 1;             // mass a unit of area (2D) or volume (3D)
  double mass = 0;                // 0: from shape and density
  Material material{};
  double linear_drag = 0;   // force = -linear_drag * velocity
  double angular_drag = 0;  // torque = -angular_drag * angular velocity
  bool may_turn = true;     // false: contacts and forces never turn it
  bool asleep = false;
  bool collides = true;                      // false: nothing meets it, no structure holds it
  std::uint64_t address = 0;                 // for a lecture_quadtree as printed
  std::optional<Integrator> integrator{};    // of this body; none: the world's
  std::optional<RotationMethod> rotation{};  // the same

  // Derived by the world when the body is added. Zero for what cannot be moved or turned. Inertia
  // is about the body's own axes, which are principal for every shape.
  double inverse_mass = 0;
  Spin<D> inverse_inertia{0.0};

  bool is_dynamic() const { return kind == BodyKind::dynamic_body; }
  bool moves() const { return kind != BodyKind::static_body; }
  // Moved by what pushes it.
  bool is_pushed() const { return is_dynamic() && !asleep; }
  // Moves now, so that it may meet or wake others: is not at rest.
  bool stirs() const {
    if (is_dynamic()) return !asleep;
    return moves() && (velocity != Vec<D>(0.0) || kinematic_spin != Spin<D>(0.0));
  }
  bool turns_about_every_axis() const {
    for (int i = 0; i < (D == 2 ? 1 : 3); ++i)
      if (!(spin_component(inverse_inertia, i) > 0)) return false;
    return true;
  }
  Box<D> box() const { return bounding_box(shape, position, orientation); }
};

// Throws Refused, naming body and field, unless the world can take it; see World::add.
template <int D>
void check_body(const Body<D>& body);
// Mass, inverse mass and inertia from shape, density and mass, checked. Throws Refused for a
// dynamic body that has none. (Both: body_check.cpp)
template <int D>
void derive_mass(Body<D>& body);

// As the narrow phase sees it.
template <int D>
Placed<D> placed(const Body<D>& body) {
  return {body.shape, body.position, body.orientation};
}

// Its axes in the world, as columns; of what does not turn those of the world.
template <int D>
Mat<D> axes_of(const Body<D>& body) {
  return turns<D>(body.shape) ? matrix(body.orientation) : Mat<D>(1.0);
}

// Inverse inertia in the world's axes: a number in 2D, a matrix in 3D. The body's own are `axes`.
template <int D>
using Inertia = std::conditional_t<D == 2, double, Mat<3>>;
template <int D>
Inertia<D> world_inverse_inertia(const Body<D>& body, [[maybe_unused]] const Mat<D>& axes) {
  if constexpr (D == 2) {
    return body.inverse_inertia;
  } else {
    Mat<3> scaled = axes;
    for (int i = 0; i < 3; ++i) scaled[i] *= body.inverse_inertia[i];
    return scaled * glm::transpose(axes);
  }
}
inline double world_inverse_inertia(const Body<2>& body) { return body.inverse_inertia; }
inline Mat<3> world_inverse_inertia(const Body<3>& body) {
  return world_inverse_inertia(body, matrix(body.orientation));
}

// Whether the inertia is the same about all axes: then energy does not depend on how a body lies.
template <int D>
bool turns_alike(const Body<D>& body) {
  for (int i = 1; i < (D == 2 ? 1 : 3); ++i)
    if (spin_component(body.inverse_inertia, i) != spin_component(body.inverse_inertia, 0))
      return false;
  return true;
}

// Turns the body out of others, or back to its joints. Its angular momentum turns with it: else it
// would come to lie along other axes of the body, about which it may be far more energy.
template <int D>
void turn_with_momentum(Body<D>& body, const Spin<D>& turn) {
  body.orientation = turned(body.orientation, turn);
  if constexpr (D == 3)
    if (!turns_alike(body))
      body.angular_momentum = turned(Rotation<3>{}, turn).q * body.angular_momentum;
}

// Radians a second, in the world's axes.
template <int D>
Spin<D> angular_velocity(const Body<D>& body) {
  if (body.kind == BodyKind::kinematic_body) return body.kinematic_spin;
  return world_inverse_inertia(body) * body.angular_momentum;
}

// Of the point of the body that is at `arm` from its centre.
template <int D>
Vec<D> velocity_at(const Body<D>& body, const Vec<D>& arm) {
  return body.velocity + cross(angular_velocity(body), arm);
}

// Of a shape of even density.
template <int D>
struct MassProperties {
  double mass = 0;
  Spin<D> inertia{0.0};  // about the centre; in 3D about each of the body's own axes

  bool operator==(const MassProperties&) const = default;
};

// `density` is mass a unit of area (2D) or volume (3D), finite and not negative. A half-space has
// no end and so no finite mass; it gives mass 0 and inertia 0, which here means: nothing moves it.
template <int D>
MassProperties<D> mass_of(const Shape<D>& shape, double density);

// The same shape at a given mass, finite and not negative. `properties` are of the shape at any
// density above 0. A shape without area (2D) or volume (3D) has inertia 0 at every mass: contacts
// never turn it.
template <int D>
MassProperties<D> scaled_to(MassProperties<D> properties, double mass);

// How a body turns when nothing holds it.
//
// A free body keeps its angular momentum L, yet its angular velocity wanders, because inertia is
// fixed to the body: a box thrown about its middle axis tumbles. In the body's axes, where L has
// the components L1, L2, L3, the energy is L1^2/2I1 + L2^2/2I2 + L3^2/2I3.
//
// This is the orientation `h` seconds after `from` (h may be negative: back in time), of a body
// whose angular momentum in the world is L; to rounding, at any spin and step, unless `method` is
// one of the splittings, whose error is of their order: these turn exactly only where two inertias
// are equal, or where they would change the energy by more than a thousandth. A static or sleeping
// body does not turn, a kinematic one turns by its spin. `method` must not be
// `explicit_gyroscopic`.
template <int D>
Rotation<D> freely_turned(const Body<D>& body, const Rotation<D>& from,
                          const Spin<D>& angular_momentum, double h,
                          RotationMethod method = RotationMethod::exact);

// The same from the body's own orientation, and with its own angular momentum.
template <int D>
Rotation<D> freely_turned(const Body<D>& body, const Spin<D>& angular_momentum, double h,
                          RotationMethod method = RotationMethod::exact) {
  return freely_turned(body, body.orientation, angular_momentum, h, method);
}
template <int D>
Rotation<D> freely_turned(const Body<D>& body, double h) {
  return freely_turned(body, body.angular_momentum, h);
}

// Turns the body by any of the methods, as if its angular momentum were more by `lag` meanwhile
// (see integrator.hpp). Only `explicit_gyroscopic` changes it, which is wrong, and what it is there
// to show.
template <int D>
void turn_freely(Body<D>& body, double h, RotationMethod method, const Spin<D>& lag = Spin<D>(0.0));

// The thickness of the thinner of two bodies.
template <int D>
double thinner(const Body<D>& a, const Body<D>& b) {
  return std::min(thickness<D>(a.shape), thickness<D>(b.shape));
}

}  // namespace lantern::physics
