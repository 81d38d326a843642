// Rays against shapes: closed forms, and points walked along the ray.
#include "geometry/ray.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "geometry/not_finite.hpp"
#include "geometry/random_vec.hpp"

namespace lantern::geometry {
namespace {

using std::numbers::pi;

TEST(Ray, SlabsAreClosedAndMindStandingStill) {
  const Box<2> box{{1, 1}, {3, 2}};
  const auto from = [&](Vec<2> o, Vec<2> d, double length = kInfinity) {
    const auto span = span_in(Ray<2>{o, d, length}, box);
    return span ? span->from : -1;
  };
  EXPECT_EQ(from({0, 1.5}, {1, 0}), 1);
  EXPECT_EQ(from({0, 1.5}, {2, 0}), 0.5) << "t counts lengths of the direction";
  EXPECT_EQ(from({0, 1}, {1, 0}), 1) << "along the lower edge, touching it";
  EXPECT_EQ(from({0, 1}, {1, -0.0}), 1) << "a negative zero stands still, too";
  EXPECT_EQ(from({0, 0.999}, {1, 0}), -1);
  EXPECT_EQ(from({0, 3}, {1, -1}), 1) << "through the inside";
  EXPECT_EQ(from({0, 5}, {1, -1}), 3) << "touches a corner only";
  EXPECT_EQ(from({2, 1.5}, {1, 0}), 0) << "begins inside";
  EXPECT_EQ(from({3, 2}, {1, 1}), 0) << "begins on a corner and leaves";
  EXPECT_EQ(from({4, 1.5}, {1, 0}), -1) << "behind the origin";
  EXPECT_EQ(from({0, 1.5}, {1, 0}, 1), 1) << "ends at the face";
  EXPECT_EQ(from({0, 1.5}, {1, 0}, 0.99), -1);
  EXPECT_EQ(from({0, 1.5}, {1e-320, 0}), -1) << "so slow that no number is as large as t";
}

TEST(Ray, ZonesWithoutEndAreEnteredAtOnce) {
  const Box<2> all{Vec<2>(-kInfinity), Vec<2>(kInfinity)};
  const auto span = span_in(Ray<2>{{5, 5}, {0, -1}}, all);
  ASSERT_TRUE(span);
  EXPECT_EQ(span->from, 0);
  EXPECT_EQ(span->to, kInfinity);
}

TEST(Ray, ClosedFormsOfShapes) {
  const Ray<2> right{{0, 0}, {1, 0}};
  EXPECT_EQ(entry<2>(right, Sphere{2}, {5, 0}), 3);
  EXPECT_EQ(entry<2>(right, Sphere{2}, {5, 2}), 5) << "touching is meeting";
  EXPECT_EQ(entry<2>(right, Sphere{2}, {5, 2.001}), std::nullopt);
  EXPECT_EQ(entry<2>(right, Sphere{2}, {1, 0}), 0) << "begins inside";
  EXPECT_EQ(entry<2>(right, Sphere{2}, {-5, 0}), std::nullopt) << "behind";
  EXPECT_EQ(entry<2>({{0, 0}, {1, 0}, 2.9}, Sphere{2}, {5, 0}), std::nullopt) << "too short";
  EXPECT_EQ(entry<2>(right, AxisBox<2>{{1, 2}}, {5, 1}), 4);
  EXPECT_NEAR(*entry<2>(right, OrientedBox<2>{{1, 1}}, {5, 0}, {pi / 4}), 5 - std::sqrt(2.0),
              1e-14);
  EXPECT_EQ(entry<2>(right, Capsule{1, 3}, {5, 0}), 4) << "its side";
  EXPECT_NEAR(*entry<2>(right, Capsule{1, 3}, {5, 0}, {pi / 2}), 1, 1e-14) << "its end";
  EXPECT_NEAR(*entry<2>(right, Capsule{1, 3}, {5, -3.6}), 4.2, 1e-14) << "its cap, off the middle";
  EXPECT_EQ(entry<2>(right, HalfSpace<2>{{-1, 0}}, {7, 99}), 7);
  EXPECT_EQ(entry<2>(right, HalfSpace<2>{{1, 0}}, {7, 99}), 0) << "begins inside";
  EXPECT_EQ(entry<2>(right, HalfSpace<2>{{0, 1}}, {7, -1}), std::nullopt) << "runs along it";
  EXPECT_EQ(entry<2>({{-3, 4}, {2, -1}}, Capsule{1, 3}, {0, 0}), 1) << "by t, on its side";
  EXPECT_EQ(entry<2>({{-9, 6}, {4, -0.5}}, Capsule{1, 3}, {0, 0}), std::nullopt)
      << "past its side before it comes down to it";
  const Ray<3> up{{0, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(entry<3>(up, Capsule{1, 3}, {0, 10, 0}), 6);
  EXPECT_EQ(entry<3>(up, Capsule{1, 3}, {1, 10, 0}), 7) << "along the rim of its cylinder";
  EXPECT_EQ(entry<3>(up, Capsule{1, 3}, {0, 1, 0}), 0) << "begins inside, between its ends";
  EXPECT_EQ(entry<3>(up, Capsule{1, 3}, {2, 1, 0}), std::nullopt) << "beside it";
  EXPECT_EQ(entry<3>(up, Sphere{1}, {0, 5, 0}), 4);
  EXPECT_EQ(entry<3>(up, HalfSpace<3>{{0, -1, 0}}, {0, 5, 0}), 5);
}

// Is the point inside, by a definition of its own? Positive outside, about the distance.
template <int D>
double outside(const Shape<D>& shape, const Vec<D>& position, const Rotation<D>& r, Vec<D> p) {
  p -= position;
  const Vec<D> local = glm::transpose(matrix(r)) * p;
  const auto from_box = [](const Vec<D>& q, const Vec<D>& half) {
    double most = -kInfinity;
    for (int i = 0; i < D; ++i) most = std::max(most, std::abs(q[i]) - half[i]);
    return most;
  };
  if (const auto* s = std::get_if<Sphere>(&shape)) return glm::length(p) - s->radius;
  if (const auto* s = std::get_if<AxisBox<D>>(&shape)) return from_box(p, s->half_size);
  if (const auto* s = std::get_if<OrientedBox<D>>(&shape)) return from_box(local, s->half_size);
  if (const auto* s = std::get_if<Capsule>(&shape)) {
    Vec<D> q = local;
    q.y -= std::clamp(q.y, -s->half_length, s->half_length);
    return glm::length(q) - s->radius;
  }
  return glm::dot(std::get<HalfSpace<D>>(shape).normal, p);
}

Rotation<2> rotation(Random& random, Rotation<2>) { return {random.between(-7, 7)}; }
Rotation<3> rotation(Random& random, Rotation<3> r) {
  return turned(r, random_point<3>(random, -4, 4));
}

template <int D>
void entries_lie_on_surfaces(std::uint64_t seed) {
  Random random(seed);
  const Vec<D> half = glm::abs(random_point<D>(random, -3, 3)) + 0.1;
  const std::array<Shape<D>, 5> shapes = {
      Sphere{half.x}, AxisBox<D>{half}, OrientedBox<D>{half}, Capsule{half.x, half.y},
      HalfSpace<D>{glm::normalize(random_point<D>(random, -1, 1) + 1e-3)}};
  for (const Shape<D>& shape : shapes) {
    const Vec<D> position = random_point<D>(random, -5, 5);
    const Rotation<D> r = rotation(random, Rotation<D>{});
    const Ray<D> ray{random_point<D>(random, -10, 10), random_point<D>(random, -2, 2) + 1e-3,
                     random.between(0, 20)};
    const auto t = entry(ray, shape, position, r);
    const double end = std::min(t.value_or(ray.length), 1e3);
    for (int i = 0; i < 200; ++i) {
      const Vec<D> p = ray.at(end * i / 200.0);
      ASSERT_GT(outside(shape, position, r, p), t && *t == 0 ? -kInfinity : -1e-9)
          << "the ray is inside before it enters: shape " << shape.index() << ", seed " << seed;
    }
    if (t) {
      ASSERT_LT(outside(shape, position, r, ray.at(*t)), 1e-9)
          << "it does not enter there: shape " << shape.index() << ", seed " << seed;
    }
    if (t && *t > 0) {
      ASSERT_GT(outside(shape, position, r, ray.at(*t)), -1e-9) << shape.index();
    }
    if (t) {
      ASSERT_TRUE(span_in(ray, bounding_box(shape, position, r)) || *t == 0)
          << "the shape is met, its box is not: shape " << shape.index() << ", seed " << seed;
    }
  }
}

TEST(Ray, EntriesLieOnSurfaces) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    entries_lie_on_surfaces<2>(seed);
    entries_lie_on_surfaces<3>(seed);
  }
}

TEST(Ray, ABallFarAwayKeepsItsDigits) {
  const auto t = entry<3>({{0, 0, 0}, {1, 0, 0}}, Sphere{1}, {1e8, 0, 0});
  ASSERT_TRUE(t);
  EXPECT_NEAR(*t, 1e8 - 1, 1e-7) << "b*b - a*c loses all digits of the radius here";
  EXPECT_FALSE(entry<3>({{0, 0, 0}, {1, 0, 0}}, Sphere{1}, {1e8, 1.01, 0}));
}

TEST(Ray, RefusesNamingTheField) {
  EXPECT_NO_THROW(require_valid(Ray<2>{{0, 0}, {1, 0}}));
  EXPECT_NO_THROW(require_valid(Ray<2>{{0, 0}, {1, 0}, 0})) << "of its origin alone";
  EXPECT_THROW(require_valid(Ray<2>{{0, 0}, {1, 0}, -1e-300}), Refused);
  EXPECT_THROW(require_valid(Ray<2>{{0, kInfinity}, {1, 0}}), Refused);
  EXPECT_THROW(require_valid(Ray<2>{{0, 0}, {NAN, 0}}), Refused);
  EXPECT_THROW(require_valid(Ray<2>{{0, 0}, {0, 0}}), Refused);
  EXPECT_THROW(require_valid(Ray<2>{{0, 0}, {1, 0}, NAN}), Refused);
}

}  // namespace
}  // namespace lantern::geometry
