// Random rooms that nothing may leave: walls, and bodies that fly and spin in them as fast as can
// be.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/random.hpp"
#include "physics/forces.hpp"
#include "world_scene.hpp"

namespace lantern::physics {

struct RoomBounds {
  double fastest = 1e3;    // units a second
  double most_spin = 1e4;  // radians a second
  double thinnest = 1e-3;  // of a body's length
  int impact_budget = 10'000;
};

template <int D>
class ClosedRoom {
 public:
  static constexpr double kHalf = 3;  // of the room's width

  ClosedRoom(std::uint64_t seed, ContactMethod method, const RoomBounds& bounds = {})
      : random_(seed), bounds_(bounds), world_(config(method)) {
    add_walls();
    const auto bodies = random_.whole(1, 6);
    for (std::int64_t i = 0; i < bodies; ++i) add_body(i);
  }

  World<D>& world() { return world_; }
  double step_seconds() const { return h_; }
  // The least centre-to-wall room of all bodies; below 0 one is outside.
  double room_left() const {
    double left = HUGE_VAL;
    for (const Body<D>& body : world_.bodies())
      for (int i = 0; body.is_dynamic() && i < D; ++i)
        left = std::min(left, kHalf - std::abs(body.position[i]));
    return left;
  }
  // Of the energy, so much may be gained by rounding.
  static constexpr double kSwing = 1e-9;
  // Kinetic, and potential above the floor: never negative.
  double energy_above_floor() const {
    double sum = energy<D>(world_.bodies(), world_.forces()).total();
    for (const Body<D>& body : world_.bodies())
      if (body.is_dynamic()) sum += glm::length(world_.config().gravity) * kHalf * body.mass;
    return sum;
  }

 private:
  bool chance(int of) { return random_.whole(1, of) == 1; }
  double magnitude(double lo, double hi) {
    return std::exp(random_.between(std::log(lo), std::log(hi)));
  }
  double part() { return chance(3) ? 0 : chance(2) ? 1 : random_.unit(); }

  WorldConfig<D> config(ContactMethod method) {
    WorldConfig<D> config;
    config.contacts = method;
    if (chance(2)) config.gravity = up<D>(-10);
    config.impact_budget = bounds_.impact_budget;
    constexpr std::array kIntegrators = {Integrator::semi_implicit_euler,
                                         Integrator::velocity_verlet, Integrator::runge_kutta_4,
                                         Integrator::implicit_midpoint};
    config.integrator = kIntegrators[static_cast<std::size_t>(random_.whole(0, 3))];
    h_ = 1 / random_.between(30, 240);
    if (chance(2)) h_ = 1.0 / 30;
    restitution_ = part();
    friction_ = part();
    return config;
  }

  void add_walls() {
    const bool solid = chance(3);
    const double half = magnitude(0.0005, 0.1);
    for (int i = 0; i < D; ++i)
      for (const double side : {1.0, -1.0}) {
        Body<D> wall;
        wall.kind = BodyKind::static_body;
        wall.material = {restitution_, friction_};
        Vec<D> size(kHalf + 2 * half), normal(0.0);
        size[i] = half;
        normal[i] = side;
        wall.position = normal * -(kHalf + (solid ? 0 : half));
        if (solid)
          wall.shape = HalfSpace<D>{normal};
        else if (chance(2))
          wall.shape = OrientedBox<D>{size};
        else
          wall.shape = AxisBox<D>{size};
        world_.add(wall);
      }
  }

  Vec<D> any_direction() {
    Vec<D> v(0.0);
    do
      for (int i = 0; i < D; ++i) v[i] = random_.between(-1, 1);
    while (!(glm::length(v) > 0.1 && glm::length(v) <= 1));
    return glm::normalize(v);
  }

  void add_body(std::int64_t cell) {
    const double room = kHalf / 3 * 0.9;  // of each of 3^D cells
    Body<D> body;
    for (int i = 0; i < D; ++i, cell /= 3)
      body.position[i] = (static_cast<double>(cell % 3) - 1) * 2 * kHalf / 3;
    const double length = room * random_.between(0.3, 1), thin = magnitude(bounds_.thinnest, 0.7);
    switch (random_.whole(0, 4)) {
      case 0:
        body.shape = Sphere{length * thin};
        break;
      case 1:
        body.shape = Capsule{length * thin / 2, length * (1 - thin / 2)};
        break;
      default: {
        Vec<D> half(length * thin * 0.57);
        const auto wide = random_.whole(1, D);  // so many long sides
        for (int i = 0; i < wide; ++i) half[i] = length * 0.57 * random_.between(0.7, 1);
        body.shape = OrientedBox<D>{half};
      }
    }
    if constexpr (D == 2)
      body.orientation.angle = random_.between(-3, 3);
    else
      body.orientation = turned(body.orientation, random_.between(0, 3) * any_direction());
    body.velocity = any_direction() * magnitude(0.1, bounds_.fastest);
    body.density = magnitude(0.1, 20);
    body.material = {restitution_, friction_};
    Spin<D> spin(0.0);
    const double speed = magnitude(1, bounds_.most_spin);
    if constexpr (D == 2)
      spin = chance(2) ? speed : -speed;
    else
      spin = any_direction() * speed;
    world_.add(body, spin);
  }

  Random random_;
  RoomBounds bounds_;
  double h_ = 0, restitution_ = 0, friction_ = 0;
  World<D> world_;
};

}  // namespace lantern::physics
