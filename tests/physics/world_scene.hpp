// Bodies for tests of the world.
#pragma once

#include <cmath>

#include "physics/world.hpp"

namespace lantern::physics {

constexpr double kStep = 1.0 / 60;

template <int D>
Vec<D> up(double y) {
  Vec<D> v{0.0};
  v.y = y;
  return v;
}

template <int D>
Vec<D> along(double x, double y = 0) {
  Vec<D> v = up<D>(y);
  v.x = x;
  return v;
}

template <int D>
WorldConfig<D> falling() {
  WorldConfig<D> config;
  config.gravity = up<D>(-10);
  return config;
}

template <int D>
Body<D> floor_at(double y = 0, double friction = 0.5) {
  Body<D> body;
  body.name = "floor";
  body.shape = HalfSpace<D>{up<D>(1)};
  body.kind = BodyKind::static_body;
  body.position = up<D>(y);
  body.material.friction = friction;
  return body;
}

template <int D>
Body<D> box_at(const Vec<D>& position, double half = 0.5) {
  Body<D> body;
  body.name = "box";
  body.shape = OrientedBox<D>{Vec<D>(half)};
  body.position = position;
  return body;
}

template <int D>
Body<D> ball_at(const Vec<D>& position, const Vec<D>& velocity = Vec<D>(0.0), double radius = 0.5) {
  Body<D> body;
  body.name = "ball";
  body.shape = Sphere{radius};
  body.position = position;
  body.velocity = velocity;
  return body;
}

template <int D>
void run(World<D>& world, double seconds, double h = kStep) {
  for (int i = 0, n = static_cast<int>(std::lround(seconds / h)); i < n; ++i) world.step(h);
}

template <int D>
double deepest(const World<D>& world) {
  double depth = 0;
  for (const Contact<D>& contact : world.contacts())
    for (const ManifoldPoint<D>& point : contact.manifold.points())
      depth = std::max(depth, -point.separation);
  return depth;
}

}  // namespace lantern::physics
