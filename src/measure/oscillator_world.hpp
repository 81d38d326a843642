// One body on a damped spring: x'' + 2 zeta omega x' + omega^2 x = 0.
#pragma once

#include "physics/world.hpp"

namespace lantern {

// Mass 1, body 1 of the world, on the x axis. The spring has no rest length, so the force is linear
// however far the body swings; but it pulls nothing while x is exactly 0.
inline World<2> oscillator_world(Integrator integrator, double omega, double zeta, double x,
                                 double v) {
  WorldConfig<2> config;
  config.integrator = integrator;
  config.contacts = ContactMethod::none;
  config.may_sleep = false;
  World<2> world(config);
  Body<2> body;
  body.name = "anchor";
  body.shape = Sphere{0.5};
  body.kind = BodyKind::static_body;
  world.add(body);
  body.name = "mass";
  body.kind = BodyKind::dynamic_body;
  body.mass = 1;
  body.position = {x, 0};
  body.velocity = {v, 0};
  world.add(body);
  Spring<2> spring;
  spring.a = 0;
  spring.b = 1;
  spring.stiffness = omega * omega;
  spring.damping = 2 * zeta * omega;
  world.add_spring(spring);
  return world;
}

}  // namespace lantern
