// Worlds of bodies that joints hold.
#pragma once

#include <algorithm>

#include "physics/forces.hpp"
#include "physics/joint.hpp"
#include "world_scene.hpp"

namespace lantern::physics {

template <int D>
WorldConfig<D> jointed(Integrator integrator) {
  WorldConfig<D> config;
  config.gravity = up<D>(-9.81);
  config.integrator = integrator;
  config.contacts = ContactMethod::none;
  config.may_sleep = false;
  return config;
}

template <int D>
Body<D> fixed_at(const Vec<D>& position) {
  Body<D> body = ball_at<D>(position, Vec<D>(0.0), 0.1);
  body.name = "anchor";
  body.kind = BodyKind::static_body;
  body.collides = false;
  return body;
}

template <int D>
Body<D> plank_at(const Vec<D>& position, const Vec<D>& half, double mass = 1) {
  Body<D> body = box_at<D>(position);
  body.shape = OrientedBox<D>{half};
  body.mass = mass;
  return body;
}

template <int D>
JointId pin(World<D>& world, BodyId a, BodyId b, const Vec<D>& at_a, const Vec<D>& at_b) {
  return world.add_joint(
      {.kind = JointKind::pin, .a = a, .b = b, .at_a = at_a, .at_b = at_b, .length = 0});
}

template <int D>
JointId rod(World<D>& world, BodyId a, BodyId b, double length) {
  Joint<D> joint;
  joint.kind = JointKind::distance;
  joint.a = a;
  joint.b = b;
  joint.length = length;
  return world.add_joint(joint);
}

inline World<2> rod_pendulum(Integrator integrator) {
  World<2> world(jointed<2>(integrator));
  world.add(fixed_at<2>({0, 0}));
  world.add(ball_at<2>({1, 0}, {0, 0}, 0.1));
  rod<2>(world, 0, 1, 1);
  return world;
}

// Planks of length 2 in a line, pinned end to end, the first to an anchor.
inline World<2> planks(const WorldConfig<2>& config, int count, double last_mass = 1) {
  World<2> world(config);
  world.add(fixed_at<2>({0, 0}));
  for (int i = 0; i < count; ++i) {
    world.add(plank_at<2>({1.0 + 2 * i, 0}, {1, 0.1}, i + 1 == count ? last_mass : 1));
    const auto id = static_cast<BodyId>(i);
    pin<2>(world, id, id + 1, {i > 0 ? 1 : 0, 0}, {-1, 0});
  }
  return world;
}
inline World<2> planks(Integrator integrator, int count, double last_mass = 1) {
  return planks(jointed<2>(integrator), count, last_mass);
}

// A loop that is closed by two anchors, and swings.
inline World<2> four_bars(Integrator integrator) {
  World<2> world(jointed<2>(integrator));
  world.add(fixed_at<2>({0, 0}));
  world.add(fixed_at<2>({3, 0}));
  world.add(plank_at<2>({0, -0.5}, {0.1, 0.5}));
  world.add(plank_at<2>({1.5, -1}, {1.5, 0.1}));
  world.add(plank_at<2>({3, -0.5}, {0.1, 0.5}, 2));
  pin<2>(world, 0, 2, {0, 0}, {0, 0.5});
  pin<2>(world, 2, 3, {0, -0.5}, {-1.5, 0});
  pin<2>(world, 3, 4, {1.5, 0}, {0, -0.5});
  pin<2>(world, 4, 1, {0, 0.5}, {0, 0});
  for (const BodyId bar : {2, 4}) {
    world.set_angular_velocity(bar, 3);
    world.set_velocity(bar, {1.5, 0});
  }
  world.set_velocity(3, {3, 0});
  return world;
}

inline World<3> spherical_pendulum(Integrator integrator) {
  World<3> world(jointed<3>(integrator));
  world.add(fixed_at<3>({0, 0, 0}));
  const Vec<3> arm(1, -0.1, -0.05), spin(0.5, 2, -1);
  world.add(plank_at<3>(arm, {0.4, 0.2, 0.1}));
  pin<3>(world, 0, 1, Vec<3>(0.0), -arm);
  world.set_angular_velocity(1, spin);
  world.set_velocity(1, glm::cross(spin, arm));
  return world;
}

template <int D>
double total_energy(const World<D>& world) {
  return energy<D>(world.bodies(), world.forces()).total();
}

}  // namespace lantern::physics
