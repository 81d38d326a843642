// All rows at once: the linear equations themselves, and what they must bring to a complete rest.
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "physics/contact/solver_body.hpp"
#include "world_scene.hpp"

namespace lantern::physics {
namespace {

using Dense = std::vector<std::vector<double>>;

// Symmetric, with ragged lines, and its diagonal so large that it is positive definite.
Dense ragged(Random& random, std::size_t lines, Scratch<std::size_t>& first) {
  Dense m(lines, std::vector<double>(lines));
  for (std::size_t i = 0; i < lines; ++i) {
    first.push_back(static_cast<std::size_t>(random.between(0, static_cast<double>(i) + 0.99)));
    for (std::size_t j = first[i]; j < i; ++j) m[i][j] = m[j][i] = random.between(-1, 1);
    m[i][i] = static_cast<double>(lines);
  }
  return m;
}

auto entries_of(const Dense& m) {
  return [&m](std::size_t line, std::size_t column) { return m[line][column]; };
}

TEST(EnvelopeSystem, SolvesRaggedMatrices) {
  Random random(5);
  for (std::size_t lines = 1; lines < 30; ++lines) {
    Scratch<std::size_t> first;
    const Dense m = ragged(random, lines, first);
    EnvelopeSystem system;
    for (const std::size_t f : first) system.add_line(f);
    Scratch<double> x, values;
    for (std::size_t i = 0; i < lines; ++i) x.push_back(random.between(-1, 1));
    for (std::size_t i = 0; i < lines; ++i) {
      values.push_back(0);
      for (std::size_t j = 0; j < lines; ++j) values[i] += m[i][j] * x[j];
    }
    ASSERT_TRUE(system.factor(entries_of(m))) << lines;
    system.solve(values);
    for (std::size_t i = 0; i < lines; ++i) EXPECT_NEAR(values[i], x[i], 1e-13) << lines;
  }
}

TEST(EnvelopeSystem, RefusesWhatIsNotPositiveDefinite) {
  EnvelopeSystem system;
  system.add_line(0);
  system.add_line(0);
  const Dense m = {{1, 2}, {2, 1}};
  EXPECT_FALSE(system.factor(entries_of(m)));
}

// Of each point the normal and the friction, for velocities and for carriage.
template <int D>
constexpr std::uint64_t kRowsOfFace = 2 * Manifold<D>::kMostPoints* D;

template <int D>
void expect_one_sweep_holds_a_stack(int count) {
  WorldConfig<D> config = falling<D>();
  config.may_sleep = false;
  World<D> world(config);
  world.add(floor_at<D>());
  for (int i = 0; i < count; ++i) world.add(box_at<D>(up<D>(0.5 + i)));
  run(world, 0.5);
  const std::uint64_t rows = world.work().constraint_rows;
  world.step(kStep);
  const auto sub_steps = static_cast<std::uint64_t>(config.sub_steps);
  EXPECT_EQ(world.work().constraint_rows - rows,
            kRowsOfFace<D> * sub_steps * static_cast<std::uint64_t>(count))
      << D << "D: impulses of a stack at rest still change";
  EXPECT_LE(deepest(world), 1e-12) << D << "D";
}

TEST(DirectSolve, AStackAtRestNeedsOneSweepASubStep) {
  expect_one_sweep_holds_a_stack<2>(20);
  expect_one_sweep_holds_a_stack<3>(20);
}

// Each box on two others, or three: some corners press by rounding only and always slip a little.
TEST(DirectSolve, AHeapComesToRest) {
  WorldConfig<3> config = falling<3>();
  config.may_sleep = false;
  World<3> world(config);
  Random random(3);
  world.add(floor_at<3>());
  for (int i = 0; i < 12; ++i)
    world.add(box_at<3>({random.between(-0.9, 0.9), 1 + i * 1.6, random.between(-0.9, 0.9)}));
  run(world, 8);
  const std::uint64_t before = world.work().constraint_rows;
  for (int i = 0; i < 60; ++i) {
    world.step(kStep);
    for (const Body<3>& body : world.bodies())
      ASSERT_LE(glm::length(body.velocity), 1e-12) << body.id << " still moves in step " << i;
  }
  EXPECT_LE(deepest(world), 1e-10);
  EXPECT_LE(world.work().constraint_rows - before, 60u * 8u * 12u * kRowsOfFace<3> * 2u)
      << "more than one sweep or two a sub-step";
}

TEST(EnvelopeSystem, TellsItsWorkBeforeItIsDone) {
  EnvelopeSystem system;
  for (int line = 0; line < 3; ++line) system.add_line(0);
  EXPECT_EQ(system.work(), (1 + 4 + 9) / 2.0);
  system.add_line(3);
  EXPECT_EQ(system.work(), 7.5) << "a line of its diagonal alone";
}

}  // namespace
}  // namespace lantern::physics
