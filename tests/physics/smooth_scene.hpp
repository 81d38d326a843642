// Bodies and forces by hand, and a run over them as the world does it, without contacts.
#pragma once

#include <cstdint>
#include <vector>

#include "physics/body.hpp"
#include "physics/forces.hpp"
#include "physics/integrate/integrator.hpp"

namespace lantern::physics {

constexpr Integrator kAllIntegrators[] = {
    Integrator::explicit_euler, Integrator::semi_implicit_euler, Integrator::velocity_verlet,
    Integrator::runge_kutta_4,  Integrator::implicit_midpoint,   Integrator::implicit_euler};

template <int D>
struct SmoothScene {
  std::vector<Body<D>> bodies;
  Forces<D> forces;
  std::uint64_t evaluations = 0;

  // A sphere of mass and inertia as given; mass 0 is a static body.
  BodyId add(const Vec<D>& position, const Vec<D>& velocity, double mass, double inertia = 0) {
    Body<D> body;
    body.id = static_cast<BodyId>(bodies.size());
    body.shape = Sphere{0.5};
    body.position = position;
    body.velocity = velocity;
    body.kind = mass > 0 ? BodyKind::dynamic_body : BodyKind::static_body;
    body.inverse_mass = mass > 0 ? 1 / mass : 0;
    body.inverse_inertia = Spin<D>(inertia > 0 ? 1 / inertia : 0.0);
    bodies.push_back(body);
    return body.id;
  }

  void step(Integrator method, double h) {
    Scratch<Increment<D>> all;
    find_increments<D>(method, bodies, forces, h, all, evaluations);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      Body<D>& body = bodies[i];
      if (!body.moves()) continue;
      body.velocity += all[i].kick;
      body.angular_momentum += all[i].twist;
      body.position += h * body.velocity + all[i].drift;
      body.orientation = freely_turned(body, body.angular_momentum + all[i].lag, h);
      if (all[i].turn != Spin<D>(0.0)) body.orientation = turned(body.orientation, all[i].turn);
    }
  }

  void run(Integrator method, double h, int steps) {
    for (int i = 0; i < steps; ++i) step(method, h);
  }

  Energy energy() const { return physics::energy<D>(bodies, forces); }
};

}  // namespace lantern::physics
