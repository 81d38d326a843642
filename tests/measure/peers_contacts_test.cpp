// What stands, and what is said of it: by every engine in every way that it is run.
#include <algorithm>
#include <cmath>

#include "measure/peer_scenes.hpp"

namespace lantern::measure {
namespace {

BodySpec box(const Vec<3>& position, double half, int dimension) {
  BodySpec body;
  body.name = "box";
  body.shape = OrientedBox<3>{{half, half, dimension == 3 ? half : 0}};
  body.position = position;
  body.material.friction = 0.5;
  return body;
}

Scenario resting(int dimension, std::vector<BodySpec> bodies) {
  bodies.insert(bodies.begin(), ground({0, 1, 0}));
  bodies[0].material.friction = 0.5;
  Scenario s = scene(dimension, std::move(bodies));
  s.world.gravity = {0, -10, 0};
  s.world.contacts = ContactMethod::soft;
  return s;
}

TEST_F(Peers, AStackOfThreeStands) {
  each([](const Solver& peer, int dimension) {
    const Scenario s =
        resting(dimension, {box({0, 0.5, 0}, 0.5, dimension), box({0, 1.5, 0}, 0.5, dimension),
                            box({0, 2.5, 0}, 0.5, dimension)});
    if (peer.cannot(s)) return;
    const auto end = after(peer, s, 1.0 / 120, 240);
    for (int i = 1; i <= 3; ++i) EXPECT_NEAR(end[i].position.y, i - 0.5, 0.03) << "box " << i;
  });
}

// What fell with a bullet's flag on every body.
TEST_F(Peers, Box2dsPyramidOfTwentyRowsStands) {
  std::vector<BodySpec> boxes;
  for (int row = 0; row < 20; ++row)
    for (int i = 0; i < 20 - row; ++i)
      boxes.push_back(box({1.1 * i + 0.55 * row - 11, 0.5 + row, 0}, 0.5, 2));
  const Scenario s = resting(2, boxes);
  for (const auto& peer : found_) {
    if (peer->name() != "Box2D:8,3") continue;
    const auto end = after(*peer, s, 1.0 / 60, 300);
    EXPECT_NEAR(end.back().position.y, 19.5, 0.2);
  }
}

// MuJoCo drops contacts that it has no room for, and bodies fall through what they stand on.
TEST_F(Peers, ManyBoxesHaveRoomForTheirContacts) {
  std::vector<BodySpec> boxes;
  for (int i = 0; i < 40; ++i) boxes.push_back(box({-9.0 + i % 10 * 2, 0.5 + i / 10, 0}, 0.5, 2));
  const Scenario s = resting(2, boxes);
  for (const auto& peer : found_) {
    if (peer->name() != "MuJoCo:Euler") continue;
    const auto end = after(*peer, s, 1.0 / 60, 12);
    for (std::size_t i = 1; i < end.size(); ++i)
      EXPECT_NEAR(end[i].position.y, s.bodies[i].position.y, 0.05);
  }
}

// Whoever is kept off tells by how much, so that no other penetration is claimed.
TEST_F(Peers, SkinsAreTold) {
  each([](const Solver& peer, int dimension) {
    for (const double half : {0.5, 0.02}) {
      const Scenario s = resting(dimension, {box({0, half + 0.01, 0}, half, dimension)});
      if (peer.cannot(s)) return;
      const auto simulation = peer.start(s, 1.0 / 120);
      const bool has_skin = peer.name().starts_with("Box2D") && half < 0.04;
      EXPECT_NEAR(simulation->skin(1), has_skin ? 0.01 : 0, 1e-6);
      simulation->advance(120);
      std::vector<BodyState> states;
      simulation->observe(states);
      const double gap = states[1].position.y - half - simulation->skin(1);
      EXPECT_NEAR(gap, 0, 0.012) << "half a box of " << half;
    }
  });
}

TEST_F(Peers, AForceThatIsAskedForPushesUntilItEnds) {
  each([](const Solver& peer, int dimension) {
    Scenario s = resting(dimension, {ball({0, 5, 0})});
    s.world.gravity = {0, 0, 0};
    if (peer.cannot(s)) return;
    const auto simulation = peer.start(s, 1.0 / 128);
    ApplyForce push;
    push.body = 1;
    push.force = {4, 0, 0};
    push.at = {0, 0.25, 0};
    simulation->act(push);
    simulation->advance(64);
    push.force = {0, 0, 0};
    simulation->act(push);
    simulation->advance(64);
    std::vector<BodyState> states;
    simulation->observe(states);
    const double inertia = (dimension == 2 ? 0.5 : 0.4) * 2 * 0.25;
    EXPECT_NEAR(states[1].velocity.x, 4 * 0.5 / 2, 1e-5);
    EXPECT_NEAR(states[1].angular_velocity.z, -4 * 0.25 * 0.5 / inertia, 1e-4);
    EXPECT_THROW(simulation->act(ApplyImpulse()), Refused) << "it would be silently left out";
  });
}

TEST_F(Peers, TellHowTheyAreRun) {
  for (const auto& peer : found_) {
    const PeerSettings told = peer->settings();
    for (const std::string& text : {told.precision, told.integrator, told.solver, told.iterations,
                                    told.joints, told.flags, told.source})
      EXPECT_FALSE(text.empty()) << peer->name();
    EXPECT_NE(peer->version().find(told.precision), std::string::npos) << peer->name();
  }
}

}  // namespace
}  // namespace lantern::measure
