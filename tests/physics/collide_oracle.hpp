// What the tests of the narrow phase hold it against: support functions and distances written down
// from the shapes' definitions, and random pairs of shapes. Slow, and without any separating axes.
#pragma once

#include <cmath>
#include <limits>

#include "base/random.hpp"
#include "physics/manifold.hpp"

namespace lantern::physics {

template <int D>
struct Thing {
  Shape<D> shape;
  Vec<D> position{0.0};
  Rotation<D> orientation;

  Placed<D> placed() const { return {shape, position, orientation}; }
};

template <int D>
std::optional<Manifold<D>> contact(const Thing<D>& a, const Thing<D>& b, double margin) {
  return collide(a.placed(), b.placed(), margin);
}

template <int D>
double least_separation(const Manifold<D>& manifold) {
  double least = manifold.room[0].separation;
  for (const auto& point : manifold.points()) least = std::min(least, point.separation);
  return least;
}

// The core of a shape as half sizes and axes, and the radius around it.
template <int D>
struct ThingCore {
  Vec<D> half{0.0};
  Mat<D> axes{1.0};
  double radius = 0;
};

template <int D>
ThingCore<D> core_of(const Thing<D>& thing) {
  ThingCore<D> core;
  if (const auto* sphere = std::get_if<Sphere>(&thing.shape)) core.radius = sphere->radius;
  if (const auto* box = std::get_if<AxisBox<D>>(&thing.shape)) core.half = box->half_size;
  if (const auto* box = std::get_if<OrientedBox<D>>(&thing.shape)) {
    core.half = box->half_size;
    core.axes = matrix(thing.orientation);
  }
  if (const auto* capsule = std::get_if<Capsule>(&thing.shape)) {
    core.half.y = capsule->half_length;
    core.radius = capsule->radius;
    core.axes = matrix(thing.orientation);
  }
  return core;
}

template <int D>
const HalfSpace<D>* half_space(const Thing<D>& thing) {
  return std::get_if<HalfSpace<D>>(&thing.shape);
}

// The largest n . (x - position) over all points x of the shape.
template <int D>
double support(const Thing<D>& thing, const Vec<D>& n) {
  if (const auto* wall = half_space(thing))
    return glm::length(n - wall->normal) < 1e-12 ? 0 : std::numeric_limits<double>::infinity();
  const ThingCore<D> core = core_of(thing);
  double sum = core.radius * glm::length(n);
  for (int i = 0; i < D; ++i) sum += core.half[i] * std::abs(glm::dot(n, core.axes[i]));
  return sum;
}

// How far apart the two are along n: for every direction n at most the true separation, and equal
// to it for the best one. Minus infinity for a half-space seen from anywhere but its normal.
template <int D>
double gap_along(const Thing<D>& a, const Thing<D>& b, const Vec<D>& n) {
  return glm::dot(n, b.position - a.position) - support(a, n) - support(b, -n);
}

// 0 inside.
template <int D>
double distance_to(const Thing<D>& thing, const Vec<D>& point) {
  const Vec<D> from = point - thing.position;
  if (const auto* wall = half_space(thing)) return std::max(0.0, glm::dot(from, wall->normal));
  const ThingCore<D> core = core_of(thing);
  const Vec<D> local = glm::transpose(core.axes) * from;
  const Vec<D> outside = local - glm::clamp(local, -core.half, core.half);
  return std::max(0.0, glm::length(outside) - core.radius);
}

// A length that the errors of a pair are measured by.
template <int D>
double size_of(const Thing<D>& thing) {
  if (half_space(thing)) return 0;
  const ThingCore<D> core = core_of(thing);
  return glm::length(core.half) + core.radius;
}

template <int D>
double size_of(const Thing<D>& a, const Thing<D>& b) {
  return size_of(a) + size_of(b) + glm::length(b.position - a.position);
}

template <int D>
double radii(const Thing<D>& a, const Thing<D>& b) {
  return core_of(a).radius + core_of(b).radius;
}

// By how much a contact's depth may be larger than the least one: 1e-3 of the smallest half size.
template <int D>
double allowed_bias(const Thing<D>& a, const Thing<D>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Thing<D>* thing : {&a, &b}) {
    const ThingCore<D> core = core_of(*thing);
    for (int i = 0; i < D; ++i)
      if (core.half[i] > 0) least = std::min(least, core.half[i]);
  }
  return std::isfinite(least) ? 1.001e-3 * least : 0;
}

template <int D>
Vec<D> random_direction(Random& random) {
  for (;;) {
    Vec<D> v;
    for (int i = 0; i < D; ++i) v[i] = random.between(-1, 1);
    const double length = glm::length(v);
    if (length > 0.1 && length < 1) return v / length;
  }
}

// In a random direction, of a random length. (In one expression the compiler would choose which of
// the two is drawn first.)
template <int D>
Vec<D> random_arrow(Random& random, double shortest, double longest) {
  const Vec<D> direction = random_direction<D>(random);
  return direction * random.between(shortest, longest);
}

inline Rotation<2> random_rotation(Random& random, Rotation<2>) {
  // Every other one is a multiple of 45 degrees: there faces and edges are parallel.
  if (random.whole(0, 1) == 0) return {static_cast<double>(random.whole(0, 8)) * std::atan(1.0)};
  return {random.between(-4, 4)};
}
inline Rotation<3> random_rotation(Random& random, Rotation<3>) {
  Vec<3> by;
  for (int i = 0; i < 3; ++i) by[i] = static_cast<double>(random.whole(0, 4)) * std::atan(1.0);
  if (random.whole(0, 1) == 0) by = random_arrow<3>(random, 0, 3);
  return turned(Rotation<3>{}, by);
}

// From 0.1 to 10; one in eight is 0.
inline double random_size(Random& random) {
  const double u = random.between(-1, 1);
  return random.whole(0, 7) == 0 ? 0 : u < 0 ? 1 / (1 - 9 * u) : 1 + 9 * u * u;
}

inline constexpr int kShapes = 5;

template <int D>
Thing<D> random_thing(Random& random, int kind) {
  Vec<D> half;
  for (int i = 0; i < D; ++i) half[i] = random_size(random);
  const Shape<D> shapes[kShapes] = {Sphere{half.x}, AxisBox<D>{half}, OrientedBox<D>{half},
                                    Capsule{half.x, half.y},
                                    HalfSpace<D>{random_direction<D>(random)}};
  return {shapes[kind], Vec<D>(0.0), random_rotation(random, Rotation<D>{})};
}

// A pair between deep overlap and some way apart; one in sixteen has a common centre.
template <int D>
std::pair<Thing<D>, Thing<D>> random_pair(Random& random, int kind_a, int kind_b) {
  Thing<D> a = random_thing<D>(random, kind_a), b = random_thing<D>(random, kind_b);
  const double reach = (size_of(a) + size_of(b)) * (random.whole(0, 15) == 0 ? 0 : 1.3);
  for (int i = 0; i < D; ++i) a.position[i] = random.between(-3, 3);
  b.position = a.position + random_arrow<D>(random, 0, reach);
  return {a, b};
}

// Two half-spaces have no contact.
template <class F>
void for_each_pair_of_kinds(const F& f) {
  for (int a = 0; a < kShapes; ++a)
    for (int b = 0; b < kShapes; ++b)
      if (a + b < 2 * (kShapes - 1)) f(a, b);
}

inline const char* name_of(int kind) {
  const char* names[] = {"sphere", "axis box", "oriented box", "capsule", "half-space"};
  return names[kind];
}

}  // namespace lantern::physics
