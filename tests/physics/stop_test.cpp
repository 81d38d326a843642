// A step that is stopped half way leaves the world as it was, wherever it was.
#include "base/stop.hpp"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "physics/contact/solver_body.hpp"
#include "physics/integrate/implicit_stage.hpp"
#include "physics/smooth_scene.hpp"
#include "physics/world_scene.hpp"

namespace lantern::physics {
namespace {

class StoppedStep : public ::testing::Test {
 protected:
  ~StoppedStep() override { forget_stop(); }
};

WorldConfig<2> crowded(ContactMethod method) {
  WorldConfig<2> config = falling<2>();
  config.contacts = method;
  config.broad_phase.bounds = {Vec<2>(0.0), Vec<2>(200.0)};
  return config;
}

World<2> crowd(int bodies, ContactMethod method) {
  World<2> world(crowded(method));
  world.add(floor_at<2>());
  Random random(2);
  for (int i = 0; i < bodies; ++i) {
    Body<2> ball = ball_at<2>({random.between(0, 200), random.between(0.5, 200)},
                              {random.between(-5, 5), random.between(-5, 5)}, 0.7);
    ball.material.restitution = i % 2 == 0 ? 0.5 : 0;
    world.add(ball);
  }
  return world;
}

TEST_F(StoppedStep, ThrowsAtOnceAndLeavesTheWorldAsItWas) {
  World<2> world = crowd(20'000, ContactMethod::soft);
  const std::uint64_t before = world.hash(), tests = world.work().pair_tests;
  ask_to_stop();
  EXPECT_THROW(world.step(kStep), Stopped);
  EXPECT_EQ(world.hash(), before);
  EXPECT_EQ(world.work().steps, 0u);
  EXPECT_EQ(world.work().pair_tests, tests) << "work was done after the wish";
}

// Another thread wishes at some moment of some step. Then the world goes on, and comes to where one
// comes that was never stopped.
TEST_F(StoppedStep, AnywhereAndGoesOnAsIfNothingHadBeen) {
  for (const ContactMethod method : {ContactMethod::soft, ContactMethod::impulse}) {
    World<2> whole = crowd(4000, method), cut = crowd(4000, method);
    constexpr std::uint64_t kSteps = 4;
    int stopped = 0;
    // Until one was cut: who wishes may come too late again and again where others are busy.
    for (int wish = 0; cut.work().steps < kSteps || stopped == 0; ++wish) {
      const std::uint64_t before = cut.hash();
      const int microseconds = 400 * (wish % 11);
      {
        const std::jthread other([&] {
          std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
          ask_to_stop();
        });
        try {
          cut.step(kStep);
        } catch (const Stopped&) {
          ++stopped;
          EXPECT_EQ(cut.hash(), before) << microseconds;
        }
      }
      forget_stop();
      // On a slow machine no step is done in time, on a quick one this was the last.
      if (wish % 11 == 10 && cut.work().steps < kSteps) cut.step(kStep);
    }
    while (whole.work().steps < cut.work().steps) whole.step(kStep);
    EXPECT_EQ(cut.hash(), whole.hash());
  }
}

TEST_F(StoppedStep, ADenseAndAnIteratedSolution) {
  SmoothScene<2> scene;
  Random random(4);
  for (int i = 0; i < 40; ++i)
    scene.add({random.between(0, 9), random.between(0, 9)}, Vec<2>(0.0), 1);
  scene.forces.gravitation = 1;
  SmoothSystem<2> system(scene.bodies, scene.forces, scene.evaluations);
  ask_to_stop();
  const std::uint64_t before = scene.evaluations;
  for (const LinearSolver solver : {LinearSolver::direct, LinearSolver::iterative})
    EXPECT_THROW(implicit_stage(system, 0.1, "implicit_euler", 0.1, solver), Stopped);
  EXPECT_LE(scene.evaluations, before + 2) << "it went on after the wish";
  BlockIteration<2> iteration(3);
  for (std::size_t i = 0; i < 3; ++i)
    for (int r = 0; r < 2; ++r) iteration.add(i, r, r, 2 + static_cast<double>(i));
  ASSERT_TRUE(iteration.factor());
  int products = 0;
  Scratch<BlockIteration<2>::Row> rows(3, {1, 2});
  EXPECT_THROW(iteration.solve(rows, 1e-12, [&](const auto&, auto&) { ++products; }), Stopped);
  EXPECT_EQ(products, 0);
  EnvelopeSystem lines;
  for (std::size_t i = 0; i < 3; ++i) lines.add_line(0);
  EXPECT_THROW(lines.factor([](std::size_t i, std::size_t j) { return i == j ? 1.0 : 0.0; }),
               Stopped);
  EXPECT_THROW(energy<2>(scene.bodies, scene.forces), Stopped);
}

}  // namespace
}  // namespace lantern::physics
