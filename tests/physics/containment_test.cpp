// What cannot leave: bodies in closed rooms, however fast they fly and spin.
#include <string>

#include <gtest/gtest.h>

#include "closed_room.hpp"
#include "how_many.hpp"

namespace lantern::physics {
namespace {

// Nobody's centre is outside at the end of any step, and the energy never grows.
template <int D>
void expect_closed(ContactMethod method, int rooms, int steps, const RoomBounds& bounds) {
  for (int seed = 1; seed <= how_many("LANTERN_CLOSED_ROOMS", rooms); ++seed) {
    ClosedRoom<D> room(static_cast<std::uint64_t>(seed), method, bounds);
    SCOPED_TRACE(std::to_string(D) + "D, " + std::string(to_string(method)) + ", room " +
                 std::to_string(seed));
    const double start = room.energy_above_floor();
    double most = start;
    for (int i = 0; i < steps; ++i) {
      const std::uint64_t tests = room.world().work().narrow_tests;
      ASSERT_NO_THROW(room.world().step(room.step_seconds())) << "step " << i;
      ASSERT_GT(room.room_left(), 0) << "left in step " << i;
      ASSERT_LE(room.energy_above_floor(), most + room.kSwing * start) << "step " << i;
      ASSERT_LE(room.world().work().narrow_tests - tests, 3'000'000u) << "step " << i;
      most = std::max(most, room.energy_above_floor());
    }
  }
}

class Containment : public testing::TestWithParam<ContactMethod> {};

TEST_P(Containment, NothingLeavesAPlaneRoom) { expect_closed<2>(GetParam(), 40, 8, {}); }
TEST_P(Containment, NothingLeavesARoom) { expect_closed<3>(GetParam(), 12, 4, {}); }

// When no more impacts may be located, what cannot be moved on waits.
TEST_P(Containment, NothingLeavesWhenTheBudgetIsUsedUp) {
  for (const int budget : {0, 1, 30}) {
    expect_closed<2>(GetParam(), 12, 5, {.impact_budget = budget});
    expect_closed<3>(GetParam(), 5, 3, {.impact_budget = budget});
  }
}

// A capsule flies at a wall far thinner than its way in a step, and spins.
template <int D>
void expect_stopped(ContactMethod method, std::uint64_t seed) {
  Random random(seed);
  WorldConfig<D> config;
  config.contacts = method;
  config.integrator = Integrator::velocity_verlet;
  World<D> world(config);
  Body<D> wall = box_at<D>(Vec<D>(0.0));
  Vec<D> half(50);
  half.x = random.between(0.0003, 0.01);
  wall.shape = AxisBox<D>{half};
  wall.kind = BodyKind::static_body;
  wall.material.friction = 0;
  world.add(wall);
  Body<D> bullet = ball_at<D>(along<D>(-3, 0.1), along<D>(random.between(100, 10'000)));
  bullet.shape = Capsule{0.02, 0.1};
  bullet.material = {random.between(0, 1), 0};
  Spin<D> spin(0.0);
  for (int i = 0; i < (D == 2 ? 1 : 3); ++i) spin_component(spin, i) = random.between(-1, 1) * 1e4;
  world.add(bullet, spin);
  for (int i = 0; i < 4; ++i) {
    world.step(kStep);
    ASSERT_LT(world.bodies()[1].position.x, 0) << to_string(method) << ", seed " << seed;
  }
}

TEST_P(Containment, AFastSpinningCapsuleDoesNotPassAThinWall) {
  for (std::uint64_t seed = 1; seed <= 13; ++seed) {
    expect_stopped<2>(GetParam(), seed);
    expect_stopped<3>(GetParam(), seed);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Containment,
                         testing::Values(ContactMethod::impulse, ContactMethod::soft,
                                         ContactMethod::direct),
                         [](const auto& of) { return std::string(to_string(of.param)); });

}  // namespace
}  // namespace lantern::physics
