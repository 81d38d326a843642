// Implicit steps whose matrix is never made: the iteration against the factor.
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "physics/integrate/implicit_stage.hpp"
#include "physics/smooth_scene.hpp"

namespace lantern::physics {
namespace {

template <int D>
Vec<D> anywhere(Random& random, double size) {
  Vec<D> v{0.0};
  for (int i = 0; i < D; ++i) v[i] = random.between(-size, size);
  return v;
}

// Near the points of a grid: where two are very near, an implicit step has no solution to be found.
template <int D>
SmoothScene<D> attracting(int count, double gravitation) {
  SmoothScene<D> scene;
  Random random(3);
  const int side = static_cast<int>(std::ceil(std::pow(count, 1.0 / D)));
  for (int i = 0; i < count; ++i) {
    Vec<D> at = anywhere<D>(random, 0.3);
    for (int axis = 0, rest = i; axis < D; ++axis, rest /= side) at[axis] += 2 * (rest % side);
    scene.add(at, anywhere<D>(random, 1), random.between(0.5, 2));
  }
  scene.forces.gravitation = gravitation;
  return scene;
}

// A net of damped springs, some of whose ends are off their bodies' centres, fixed at one corner.
template <int D>
SmoothScene<D> net(int side, double stiffness, bool turning) {
  SmoothScene<D> scene;
  Random random(5);
  const auto number = [&](int i, int j) { return static_cast<BodyId>(i * side + j); };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      Vec<D> at = anywhere<D>(random, 0.1);
      at.x += i;
      at.y += j;
      scene.add(at, anywhere<D>(random, 0.5), i + j == 0 ? 0 : random.between(0.5, 2), 0.2);
    }
  const auto tie = [&](BodyId a, BodyId b) {
    Spring<D> spring{a, b, Vec<D>(0.0), Vec<D>(0.0), 0.9, stiffness, 0.3};
    if (turning) spring.at_a = anywhere<D>(random, 0.3);
    scene.forces.springs.push_back(spring);
  };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      if (i + 1 < side) tie(number(i, j), number(i + 1, j));
      if (j + 1 < side) tie(number(i, j), number(i, j + 1));
    }
  scene.forces.gravity.y = -10;
  return scene;
}

double length_of(double spin) { return std::abs(spin); }
double length_of(const Vec<2>& v) { return glm::length(v); }
double length_of(const Vec<3>& v) { return glm::length(v); }

// The largest difference of two lists against the largest entry.
template <class T>
double difference(const Scratch<T>& a, const Scratch<T>& b) {
  double most = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, length_of(T(a[i] - b[i])));
    size = std::max(size, length_of(a[i]));
  }
  return size > 0 ? most / size : most;
}

template <int D>
void expect_the_same_stage(SmoothScene<D> scene, double h, const char* name) {
  SmoothSystem<D> system(scene.bodies, scene.forces, scene.evaluations);
  const auto stage = [&](LinearSolver solver) {
    return implicit_stage(system, h, "implicit_euler", h, solver);
  };
  const SmoothState<D> direct = stage(LinearSolver::direct);
  const SmoothState<D> iterated = stage(LinearSolver::iterative);
  EXPECT_GT(length_of(direct.kick.back()), 0) << name << ": nothing moves, no test";
  EXPECT_LT(difference(direct.kick, iterated.kick), 1e-13) << name << " in " << D << "D";
  EXPECT_LT(difference(direct.twist, iterated.twist), 1e-12) << name << " in " << D << "D";
}

template <int D>
void expect_the_same_stages() {
  expect_the_same_stage(attracting<D>(100, 0.5), 0.05, "attraction");
  expect_the_same_stage(attracting<D>(40, 5), 0.1, "strong attraction");
  expect_the_same_stage(net<D>(8, 100, false), 0.05, "net");
  expect_the_same_stage(net<D>(6, 1e5, true), 0.02, "stiff net that turns its bodies");
}

TEST(Iteration, FindsTheSameStageAsTheFactor) {
  expect_the_same_stages<2>();
  expect_the_same_stages<3>();
}

TEST(Iteration, FindsTheSameDampedKickAsTheFactor) {
  SmoothScene<3> scene = net<3>(6, 100, true);
  SmoothSystem<3> system(scene.bodies, scene.forces, scene.evaluations);
  const auto kicked = [&](LinearSolver solver) {
    SmoothState<3> state = system.start();
    damped_kick(system, state, 0.05, solver);
    return state;
  };
  const SmoothState<3> direct = kicked(LinearSolver::direct);
  const SmoothState<3> iterated = kicked(LinearSolver::iterative);
  EXPECT_LT(difference(direct.kick, iterated.kick), 1e-14);
  EXPECT_LT(difference(direct.twist, iterated.twist), 1e-13);
}

// The midpoint method by iterated stages, as implicit_midpoint.cpp makes it of any.
Scratch<Vec<3>> places_after(double seconds, int steps) {
  SmoothScene<3> scene = attracting<3>(12, 0.2);
  for (Body<3>& body : scene.bodies) body.velocity *= 0.1;  // none comes near another
  const double h = seconds / steps;
  for (int i = 0; i < steps; ++i) {
    SmoothSystem<3> system(scene.bodies, scene.forces, scene.evaluations);
    const auto middle =
        implicit_stage(system, h / 2, "implicit_midpoint", h, LinearSolver::iterative);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      scene.bodies[b].position += h * (scene.bodies[b].velocity + middle.kick[b]);
      scene.bodies[b].velocity += 2.0 * middle.kick[b];
    }
  }
  Scratch<Vec<3>> places;
  for (const Body<3>& body : scene.bodies) places.push_back(body.position);
  return places;
}

TEST(Iteration, KeepsTheOrderOfTheMidpoint) {
  const auto coarse = places_after(2, 40), fine = places_after(2, 80),
             finest = places_after(2, 160);
  const double ratio = difference(coarse, finest) / difference(fine, finest);
  EXPECT_NEAR(ratio, 5, 0.2) << "(16 - 1) / (4 - 1) of a method of second order";
}

// Up to a size the solver is the factor, to the bit, beyond it the iteration.
TEST(Iteration, IsChosenWhereVeryManyAttractEachOther) {
  for (const int count : {100, static_cast<int>(kMostAttracting) + 1}) {
    SmoothScene<2> scene = attracting<2>(count, 0.1);
    SmoothSystem<2> system(scene.bodies, scene.forces, scene.evaluations);
    const LinearSolver expected = count == 100 ? LinearSolver::direct : LinearSolver::iterative;
    const auto chosen = implicit_stage(system, 0.05, "implicit_euler", 0.05);
    const auto same = implicit_stage(system, 0.05, "implicit_euler", 0.05, expected);
    EXPECT_EQ(chosen.kick, same.kick) << count;
  }
}

// All links, named in any order: the short way of the plan for groups that are all linked gives the
// order and the entries of the long one.
TEST(BlockSystem, SolvesWhatIsLinkedThroughout) {
  constexpr std::size_t kCount = 9;
  Scratch<BlockSystem<2>::Link> links;
  for (std::size_t i = 0; i < kCount; ++i)
    for (std::size_t j = i + 1; j < kCount; ++j) links.emplace_back(j, i);
  auto system = BlockSystem<2>::planned(kCount, links, 1 << 20);
  ASSERT_TRUE(system.has_value());
  EXPECT_FALSE(BlockSystem<2>::planned(kCount, links, 1000).has_value()) << "it takes more";
  Random random(1);
  double matrix[2 * kCount][2 * kCount] = {};
  for (std::size_t r = 0; r < 2 * kCount; ++r)
    for (std::size_t c = 0; c <= r; ++c)
      matrix[r][c] = matrix[c][r] = r == c ? 30 + random.between(0, 1) : random.between(-1, 1);
  for (std::size_t r = 0; r < 2 * kCount; ++r)
    for (std::size_t c = 0; c < 2 * kCount; ++c) {
      const int row = static_cast<int>(r % 2), column = static_cast<int>(c % 2);
      if (r / 2 == c / 2) system->add(r / 2, row, column, matrix[r][c]);
      if (r / 2 > c / 2) system->add(r / 2, c / 2, row, column, matrix[r][c]);
    }
  ASSERT_TRUE(system->factor());
  Scratch<BlockSystem<2>::Row> x(kCount);
  std::vector<double> wanted(2 * kCount);
  for (std::size_t i = 0; i < 2 * kCount; ++i) x[i / 2][i % 2] = wanted[i] = random.between(-1, 1);
  system->solve(x);
  for (std::size_t r = 0; r < 2 * kCount; ++r) {
    double sum = 0;
    for (std::size_t c = 0; c < 2 * kCount; ++c) sum += matrix[r][c] * x[c / 2][c % 2];
    EXPECT_NEAR(sum, wanted[r], 1e-13);
  }
}

}  // namespace
}  // namespace lantern::physics
