#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "physics/body.hpp"
#include "physics/collide_oracle.hpp"

namespace lantern::physics {
namespace {

double squared_arm(const Vec<2>& p, double) { return glm::dot(p, p); }
Vec<3> squared_arm(const Vec<3>& p, const Vec<3>&) {
  return {p.y * p.y + p.z * p.z, p.x * p.x + p.z * p.z, p.x * p.x + p.y * p.y};
}

// Sums over the middles of a grid of cells, all those that lie in the shape.
template <int D>
MassProperties<D> summed(const Shape<D>& shape, double density, int cells) {
  const Thing<D> thing{shape, Vec<D>(0.0), {}};
  const Box<D> box = bounding_box(shape, Vec<D>(0.0));
  const Vec<D> cell = box.size() / static_cast<double>(cells);
  double weight = density;
  for (int i = 0; i < D; ++i) weight *= cell[i];
  MassProperties<D> sum;
  for (int x = 0; x < cells; ++x)
    for (int y = 0; y < cells; ++y)
      for (int z = 0; z < (D == 3 ? cells : 1); ++z) {
        const int steps[] = {x, y, z};
        Vec<D> p;
        for (int i = 0; i < D; ++i) p[i] = box.lo[i] + cell[i] * (steps[i] + 0.5);
        if (distance_to(thing, p) > 0) continue;
        sum.mass += weight;
        sum.inertia += weight * squared_arm(p, Spin<D>{});
      }
  return sum;
}

template <int D>
void expect_mass_is_the_sum(const Shape<D>& shape) {
  const MassProperties<D> found = mass_of(shape, 2.5);
  const MassProperties<D> expected = summed(shape, 2.5, D == 2 ? 300 : 60);
  EXPECT_NEAR(found.mass / expected.mass, 1, 5e-3)
      << "shape " << shape.index() << " in " << D << "D";
  for (int i = 0; i < (D == 2 ? 1 : 3); ++i) {
    double one = 0, other = 0;
    if constexpr (D == 2)
      one = found.inertia, other = expected.inertia;
    else
      one = found.inertia[i], other = expected.inertia[i];
    EXPECT_NEAR(one / other, 1, 1e-2) << "inertia " << i << " of shape " << shape.index();
  }
}

TEST(Mass, IsTheSumOverTheShape) {
  for (const Shape<2>& shape :
       {Shape<2>(Sphere{1.5}), Shape<2>(AxisBox<2>{{1, 3}}), Shape<2>(OrientedBox<2>{{2, 0.5}}),
        Shape<2>(Capsule{0.5, 2}), Shape<2>(Capsule{2, 0.5}), Shape<2>(Capsule{1, 0})})
    expect_mass_is_the_sum<2>(shape);
  for (const Shape<3>& shape : {Shape<3>(Sphere{1.5}), Shape<3>(AxisBox<3>{{1, 3, 2}}),
                                Shape<3>(OrientedBox<3>{{2, 0.5, 1}}), Shape<3>(Capsule{0.5, 2}),
                                Shape<3>(Capsule{2, 0.5}), Shape<3>(Capsule{1, 0})})
    expect_mass_is_the_sum<3>(shape);
}

TEST(Mass, OfWellKnownShapes) {
  const double pi = std::numbers::pi;
  EXPECT_DOUBLE_EQ(mass_of<2>(Sphere{2}, 3).mass, 12 * pi);
  EXPECT_DOUBLE_EQ(mass_of<2>(Sphere{2}, 3).inertia, 24 * pi);
  EXPECT_DOUBLE_EQ(mass_of<3>(Sphere{1}, 3).mass, 4 * pi);
  EXPECT_DOUBLE_EQ(mass_of<3>(Sphere{1}, 3).inertia.y, 1.6 * pi);
  EXPECT_EQ(mass_of<2>(AxisBox<2>{{0.5, 0.5}}, 6), (MassProperties<2>{6, 1}));
  EXPECT_EQ(mass_of<3>(AxisBox<3>{{0.5, 0.5, 0.5}}, 6), (MassProperties<3>{6, {1, 1, 1}}));
  EXPECT_DOUBLE_EQ(mass_of<2>(Capsule{1, 2}, 1).mass, 8 + pi);
  EXPECT_DOUBLE_EQ(mass_of<3>(Capsule{1, 2}, 1).mass, (4 + 4.0 / 3) * pi);
}

// A capsule without length is a ball; one without end caps to speak of is a rod of m L^2 / 12.
TEST(Mass, OfCapsulesAtTheirLimits) {
  EXPECT_EQ(mass_of<2>(Capsule{2, 0}, 3), mass_of<2>(Sphere{2}, 3));
  EXPECT_EQ(mass_of<3>(Capsule{2, 0}, 3), mass_of<3>(Sphere{2}, 3));
  const auto rod = mass_of<3>(Capsule{1e-6, 3}, 1);
  EXPECT_NEAR(rod.inertia.x / (rod.mass * 36 / 12), 1, 1e-5);
}

TEST(Mass, AHalfSpaceCannotBeMoved) {
  EXPECT_EQ(mass_of<2>(HalfSpace<2>{{0, 1}}, 5), (MassProperties<2>{0, 0}));
  EXPECT_EQ(mass_of<3>(HalfSpace<3>{{0, 1, 0}}, 5), (MassProperties<3>{0, Vec<3>(0.0)}));
}

TEST(Mass, ScalesInertiaWithAnExplicitMass) {
  const auto box = mass_of<3>(OrientedBox<3>{{1, 2, 3}}, 7);
  const auto scaled = scaled_to(box, 24);
  EXPECT_EQ(scaled.mass, 24);
  EXPECT_NEAR(scaled.inertia.x, 24.0 / 3 * (4 + 9), 1e-12);
  EXPECT_EQ(scaled_to(mass_of<3>(Sphere{0}, 7), 24), (MassProperties<3>{24, Vec<3>(0.0)}))
      << "a point must not turn, nor have an inertia that is not a number";
  EXPECT_EQ(scaled_to(mass_of<2>(AxisBox<2>{{0, 1}}, 7), 24), (MassProperties<2>{24, 0}));
}

}  // namespace
}  // namespace lantern::physics
