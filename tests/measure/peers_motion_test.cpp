// Each engine beside Lantern must be told the same scene and understood rightly, or its errors are
// ours.
#include <cmath>
#include <numbers>

#include "measure/peer_scenes.hpp"

namespace lantern::measure {
namespace {

// Semi-implicit Euler falls g T h / 2 too far, explicit Euler too little, higher orders nothing.
TEST_F(Peers, AProjectileMissesByItsFirstOrderError) {
  each([](const Solver& peer, int dimension) {
    Scenario s = scene(dimension, {ball({-1, 2, 0}, {3, 4, 0})});
    s.world.gravity = {0, -10, 0};
    if (peer.cannot(s)) return;
    const double h = 1.0 / 128;
    const BodyState end = after(peer, s, h, 128)[0];
    EXPECT_NEAR(end.position.x, 2, 1e-5);
    EXPECT_NEAR(end.position.y, 2 + 4 - 5, 10 * h / 2 * 1.001);
    EXPECT_NEAR(end.velocity.y, 4 - 10, 1e-4);
    EXPECT_EQ(end.position.z, 0);
  });
}

TEST_F(Peers, DragSlowsByTheSameLaw) {
  each([](const Solver& peer, int dimension) {
    BodySpec slowed = ball({0, 0, 0}, {8, 0, 0});
    slowed.linear_drag = 2;  // of a mass of 2: v = 8 exp(-t)
    const Scenario s = scene(dimension, {slowed});
    if (peer.cannot(s)) return;
    const double h = 1.0 / 256;
    const BodyState end = after(peer, s, h, 256)[0];
    EXPECT_NEAR(end.velocity.x, 8 * std::exp(-1), 8 * h);
    EXPECT_NEAR(end.position.x, 8 * (1 - std::exp(-1)), 8 * h);
  });
}

TEST_F(Peers, TwoEqualBallsSwapTheirVelocities) {
  each([](const Solver& peer, int dimension) {
    Scenario s = scene(dimension, {ball({-2, 0, 0}, {3, 0, 0}), ball({0, 0, 0})});
    s.world.contacts = ContactMethod::soft;
    s.bodies[0].material.restitution = 1;  // of the pair, the larger
    if (peer.cannot(s)) return;
    const auto end = after(peer, s, 1.0 / 64, 64);
    EXPECT_NEAR(end[0].velocity.x + end[1].velocity.x, 3, 1e-4) << "momentum is lost";
    // Bullet bounces the harder, the deeper the step before the impact has led in.
    EXPECT_NEAR(end[1].velocity.x, 3, 0.25) << "restitution is not 1";
  });
}

TEST_F(Peers, WithoutContactsBodiesPass) {
  each([](const Solver& peer, int dimension) {
    const Scenario s = scene(dimension, {ball({-2, 0, 0}, {3, 0, 0}), ball({0, 0, 0})});
    if (peer.cannot(s)) return;
    const auto end = after(peer, s, 1.0 / 64, 64);
    EXPECT_NEAR(end[0].velocity.x, 3, 1e-6);
    EXPECT_EQ(end[1].velocity, Vec<3>(0.0));
  });
}

TEST_F(Peers, ABoxComesToRestOnTheGround) {
  each([](const Solver& peer, int dimension) {
    for (const Vec<3>& up : {Vec<3>(0, 1, 0), Vec<3>(0.6, 0.8, 0)}) {
      BodySpec box = ball(up * 0.55);
      box.shape = OrientedBox<3>{{0.5, 0.5, dimension == 3 ? 0.5 : 0}};
      box.angle = std::atan2(-up.x, up.y);
      Scenario s = scene(dimension, {ground(up), box});
      s.world.gravity = -9.8 * up;
      s.world.contacts = ContactMethod::soft;
      if (peer.cannot(s)) continue;
      const BodyState end = after(peer, s, 1.0 / 64, 192)[1];
      EXPECT_NEAR(glm::dot(end.position, up), 0.5, 0.03) << "it sinks in or hovers";
      EXPECT_LT(glm::length(end.velocity), 0.06);
    }
  });
}

TEST_F(Peers, FrictionIsTheGeometricMean) {
  each([](const Solver& peer, int dimension) {
    BodySpec box = ball({-5, 0.5, 0}, {4, 0, 0});
    box.shape = OrientedBox<3>{{0.5, 0.5, dimension == 3 ? 0.5 : 0}};
    box.material.friction = 0.9;
    Scenario s = scene(dimension, {ground({0, 1, 0}), box});
    s.bodies[0].material.friction = 0.4;  // together 0.6
    s.world.gravity = {0, -10, 0};
    s.world.contacts = ContactMethod::soft;
    if (peer.cannot(s)) return;
    const BodyState end = after(peer, s, 1.0 / 128, 256)[1];
    EXPECT_NEAR(end.position.x + 5, 4.0 * 4 / (2 * 0.6 * 10), 0.12);
  });
}

TEST_F(Peers, TurnTheRightWayAndCountWholeTurns) {
  each([](const Solver& peer, int dimension) {
    BodySpec top = ball({0, 0, 0});
    top.angle = 0.25;
    top.spin = 5;
    const Scenario s = scene(dimension, {top});
    if (peer.cannot(s)) return;
    const BodyState end = after(peer, s, 1.0 / 64, 128)[0];
    const double angle = 0.25 + 10;
    EXPECT_NEAR(std::abs(glm::dot(end.orientation.q, turned(Rotation<3>(), {0, 0, angle}).q)), 1,
                1e-5);
    EXPECT_NEAR(end.angular_velocity.z, 5, 1e-4);
    const double inertia = (dimension == 2 ? 0.5 : 0.4) * 2 * 0.25;
    EXPECT_NEAR(end.angular_momentum.z, inertia * 5, 1e-4);
    if (dimension == 2) {
      EXPECT_NEAR(end.angle, angle, 0.01) << "whole turns are lost";
    }
  });
}

// A disc that is held by a spring off its centre: wrong levers would turn it the other way.
TEST_F(Peers, SpringsPullAtTheirPoints) {
  each([](const Solver& peer, int dimension) {
    Scenario s = scene(dimension, {ball({0, 0, 0})});
    LinkSpec spring;
    spring.at_a = {0.5, 0, 0};
    spring.at_b = {0.5, 3, 0};
    spring.rest_length = 1;
    spring.stiffness = 10;
    s.links = {spring};
    if (peer.cannot(s)) return;
    const double h = 1.0 / 1024;
    const BodyState end = after(peer, s, h, 10)[0];
    const double impulse = 20 * 10 * h, inertia = (dimension == 2 ? 0.5 : 0.4) * 2 * 0.25;
    EXPECT_NEAR(end.velocity.y, impulse / 2, 0.01 * impulse);
    EXPECT_NEAR(end.angular_momentum.z, impulse * 0.5, 0.01 * impulse);
    EXPECT_NEAR(end.angular_velocity.z, impulse * 0.5 / inertia, 0.02 * impulse / inertia);
  });
}

// A circle of radius 2 about a static body at (0, 0): v^2 / r = gravitation M / r^2.
TEST_F(Peers, BodiesAttractEachOther) {
  each([](const Solver& peer, int dimension) {
    BodySpec sun = ball({0, 0, 0});
    sun.kind = BodyKind::static_body;
    sun.mass = 8;
    Scenario s = scene(dimension, {sun, ball({2, 0, 0}, {0, 2, 0})});
    s.world.gravitation = 1;
    const bool lacks_it = peer.name().starts_with("MuJoCo");
    ASSERT_TRUE(peer.cannot(s) || !lacks_it);
    if (peer.cannot(s)) return;
    const BodyState quarter =
        after(peer, s, std::numbers::pi / 2 / 1024, 1024)[1];  // the angle is t v / r
    EXPECT_NEAR(quarter.position.x, 0, 0.02);
    EXPECT_NEAR(quarter.position.y, 2, 0.02);
  });
}

// Soft by a force, stiff by the engine's own joint where it has one: the swing stays bounded.
TEST_F(Peers, AnOscillatorKeepsItsPeriod) {
  each([](const Solver& peer, int dimension) {
    Scenario s = scene(dimension, {ball({1, 0, 0})});
    LinkSpec spring;
    spring.rest_length = 0;
    spring.stiffness = 2 * 4 * std::numbers::pi * std::numbers::pi;  // a period of 1 s
    s.links = {spring};
    if (peer.cannot(s)) return;
    const BodyState end = after(peer, s, 1.0 / 512, 512)[0];
    EXPECT_NEAR(end.position.x, 1, 0.05);
    EXPECT_NEAR(end.velocity.x, 0, 2 * std::numbers::pi * 0.05);
  });
}

TEST_F(Peers, PinsAndRodsHold) {
  each([](const Solver& peer, int dimension) {
    for (const auto kind : {LinkSpec::Kind::pin, LinkSpec::Kind::distance}) {
      Scenario s = scene(dimension, {ball({2, 0, 0})});
      s.world.gravity = {0, -10, 0};
      LinkSpec link;
      link.kind = kind;
      if (kind == LinkSpec::Kind::pin) link.at_a = {-2, 0, 0};
      s.links = {link};
      if (peer.cannot(s)) continue;
      SCOPED_TRACE(kind == LinkSpec::Kind::pin ? "pin" : "rod");
      const BodyState end = after(peer, s, 1.0 / 256, 300)[0];
      EXPECT_NEAR(glm::length(end.position), 2, 0.02);
      EXPECT_LT(end.position.y, -0.5) << "it hangs still";
    }
  });
}

TEST_F(Peers, VelocitiesAreTurnedRoundWhenAsked) {
  each([](const Solver& peer, int dimension) {
    const Scenario s = scene(dimension, {ball({0, 0, 0}, {3, 0, 0})});
    if (peer.cannot(s)) return;
    const auto simulation = peer.start(s, 1.0 / 64);
    simulation->advance(64);
    Move turn;
    turn.velocity = Vec<3>(-3, 0, 0);
    simulation->act(turn);
    simulation->advance(128);
    std::vector<BodyState> states;
    simulation->observe(states);
    EXPECT_NEAR(states[0].position.x, -3, 1e-4);
    turn.to = Vec<3>(0.0);
    EXPECT_THROW(simulation->act(turn), Refused) << "it would be silently left out";
  });
}

}  // namespace
}  // namespace lantern::measure
