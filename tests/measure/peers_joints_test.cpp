// Every engine, in every way that it is run, joins bodies as Lantern means it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/contact_runs.hpp"
#include "measure/peer_scenes.hpp"
#include "measure/run.hpp"

namespace lantern::measure {
namespace {

BodySpec plank(const Vec<3>& position, double half_length, int dimension) {
  BodySpec body;
  body.name = "plank";
  body.shape = OrientedBox<3>{{half_length, 0.1, dimension == 3 ? 0.1 : 0}};
  body.mass = 2;
  body.position = position;
  return body;
}

LinkSpec joint(LinkSpec::Kind kind, std::size_t a, const Vec<3>& at_a, std::optional<std::size_t> b,
               const Vec<3>& at_b) {
  LinkSpec link;
  link.kind = kind;
  link.a = a;
  link.at_a = at_a;
  link.b = b;
  link.at_b = at_b;
  return link;
}

Vec<3> end_of(const BodyState& state, const Vec<3>& at) {
  return state.position + matrix(state.orientation) * at;
}

// The widest gap of a pin, or change of a rod's length.
double parted(const Scenario& s, const std::vector<BodyState>& states) {
  std::vector<BodyState> first;
  for (const BodySpec& body : s.bodies) {
    first.emplace_back().position = body.position;
    first.back().orientation = turned(Rotation<3>(), Vec<3>(0, 0, body.angle));
  }
  const auto length = [](const LinkSpec& link, const std::vector<BodyState>& all) {
    const Vec<3> to = link.b ? end_of(all[*link.b], link.at_b) : link.at_b;
    return glm::length(end_of(all[link.a], link.at_a) - to);
  };
  double worst = 0;
  for (const LinkSpec& link : s.links)
    worst = std::max(worst, std::abs(length(link, states) - length(link, first)));
  return worst;
}

// A plank that is let go level, pinned at its end: I th'' = m g l cos th, I = m l^2 + its own.
TEST_F(Peers, APinnedPlankSwingsAsByTheBook) {
  each([](const Solver& peer, int dimension) {
    Scenario s = scene(dimension, {plank({1, 0, 0}, 1, dimension)});
    s.world.gravity = {0, -10, 0};
    s.links = {joint(LinkSpec::Kind::pin, 0, {-1, 0, 0}, std::nullopt, {0, 0, 0})};
    if (peer.cannot(s)) return;
    const double h = 1.0 / 512;
    const double per_mass = 1 + (4 + 0.04) / 12;  // of its inertia about the pin
    double angle = 0, spin = 0;
    for (int i = 0; i < 512 * 64; ++i) {
      spin -= 10 / per_mass * std::cos(angle) * h / 64;
      angle += spin * h / 64;
    }
    const BodyState end = after(peer, s, h, 512)[0];
    EXPECT_NEAR(end.position.x, std::cos(angle), 0.01);
    EXPECT_NEAR(end.position.y, std::sin(angle), 0.01);
    EXPECT_NEAR(end.angular_velocity.z, spin, 0.03);
  });
}

// Two planks, one pinned to the other: energy stays, and the pins hold.
TEST_F(Peers, ADoublePendulumKeepsItsEnergy) {
  each([](const Solver& peer, int dimension) {
    Scenario s = scene(dimension, {plank({0.5, 0, 0}, 0.5, dimension), plank({1, 0.5, 0}, 0.5, 2)});
    s.bodies[1].angle = std::numbers::pi / 2;
    if (dimension == 3) s.bodies[1].shape = OrientedBox<3>{{0.5, 0.1, 0.1}};
    s.bodies[1].velocity = {-0.5, 0, 0};  // turns about the pin that it shares with the first
    s.bodies[1].spin = 1;
    s.world.gravity = {0, -10, 0};
    s.links = {joint(LinkSpec::Kind::pin, 0, {-0.5, 0, 0}, std::nullopt, {0, 0, 0}),
               joint(LinkSpec::Kind::pin, 1, {-0.5, 0, 0}, 0, {0.5, 0, 0})};
    if (peer.cannot(s)) return;
    const auto energy = [&](const std::vector<BodyState>& all) {
      double sum = 0;
      for (const BodyState& b : all)
        sum += b.velocity.x * b.velocity.x + b.velocity.y * b.velocity.y + 20 * b.position.y +
               0.5 * b.angular_velocity.z * b.angular_momentum.z;
      return sum;
    };
    const auto begin = after(peer, s, 1.0 / 1024, 1), end = after(peer, s, 1.0 / 1024, 1024);
    EXPECT_NEAR(begin[1].velocity.x, -0.5, 0.02);
    EXPECT_NEAR(begin[1].angular_velocity.z, 1, 0.05);
    const double lost = peer.name().starts_with("Box2D") ? 2 : 0.35;  // single precision
    EXPECT_NEAR(energy(end), energy(begin), lost) << "of some 20 J that go to and fro";
    EXPECT_LT(parted(s, end), 0.006);
  });
}

TEST_F(Peers, ABridgeThatIsHeldAtBothEndsHolds) {
  each([](const Solver& peer, int dimension) {
    ScenarioSpec spec = scene(dimension, {ball({0, 0, 0})});
    spec.bodies.clear();
    for (int i = 0; i < 4; ++i) spec.bodies.push_back(plank({0.5 + i, 0, 0}, 0.49, dimension));
    spec.world.gravity = {0, -10, 0};
    spec.links = {joint(LinkSpec::Kind::pin, 0, {-0.5, 0, 0}, std::nullopt, {0, 0, 0}),
                  joint(LinkSpec::Kind::pin, 3, {0.5, 0, 0}, std::nullopt, {4, 0, 0})};
    for (std::size_t i = 0; i < 3; ++i)
      spec.links.push_back(joint(LinkSpec::Kind::pin, i, {0.5, 0, 0}, i + 1, {-0.5, 0, 0}));
    const Scenario bridge{spec};
    if (peer.cannot(bridge)) return;
    const auto end = after(peer, bridge, 1.0 / 256, 128);
    EXPECT_LT(parted(bridge, end), 0.05);
    for (const BodyState& state : end) EXPECT_NEAR(state.position.y, 0, 0.15) << "taut, it stays";
  });
}

// Two balls on rods, the second on the first.
TEST_F(Peers, RodsBetweenMovingBodiesHold) {
  each([](const Solver& peer, int dimension) {
    Scenario s = scene(dimension, {ball({1, 0, 0}, {0, -1, 0}), ball({2.5, 0, 0}, {0, -3, 0})});
    s.bodies[1].spin = 2;
    s.world.gravity = {0, -10, 0};
    s.links = {joint(LinkSpec::Kind::distance, 0, {0, 0, 0}, std::nullopt, {0, 0, 0}),
               joint(LinkSpec::Kind::distance, 1, {0, 0, 0}, 0, {0, 0, 0})};
    if (peer.cannot(s)) return;
    const auto begin = after(peer, s, 1.0 / 512, 0), end = after(peer, s, 1.0 / 512, 400);
    EXPECT_NEAR(begin[0].velocity.y, -1, 1e-6);
    EXPECT_NEAR(begin[1].velocity.y, -3, 1e-6);
    EXPECT_NEAR(begin[1].angular_velocity.z, 2, 1e-6);
    EXPECT_LT(parted(s, end), 0.02);
    EXPECT_LT(end[0].position.y, -0.5) << "it hangs still";
    EXPECT_NEAR(end[0].angular_velocity.z, 0, 0.01) << "a rod at the centre turns nothing";
    EXPECT_NEAR(end[1].angular_velocity.z, 2, 0.01);
  });
}

// A top on a ball joint at its foot: energy and the turning about the upright stay.
TEST_F(Peers, AHeavyTopGoesRound) {
  each([](const Solver& peer, int dimension) {
    if (dimension == 2) return;
    ScenarioSpec spec = scene(3, {ball({0, 0, 0})});
    BodySpec top = plank({0, 0, 0}, 0.1, 3);
    top.shape = OrientedBox<3>{{0.4, 0.4, 0.1}};
    const double tilt = 0.5;  // of its own z from the upright y
    top.axis = {1, 0, 0};
    top.angle = tilt - std::numbers::pi / 2;
    const Rotation<3> lie = turned(Rotation<3>(), top.axis * top.angle);
    const Vec<3> own = matrix(lie) * Vec<3>(0, 0, 1);
    top.position = own * 0.5;
    spec.bodies = {top};
    spec.world.gravity = {0, -10, 0};
    spec.links = {joint(LinkSpec::Kind::pin, 0, {0, 0, -0.5}, std::nullopt, {0, 0, 0})};
    Scenario standing{spec};
    if (peer.cannot(standing)) return;
    const auto end = after(peer, standing, 1.0 / 512, 256)[0];
    EXPECT_NEAR(glm::length(end.position), 0.5, 0.01);
    EXPECT_NEAR(end.position.x, 0, 1e-3) << "without spin it falls as it leans";
    EXPECT_GT(end.position.z / own.z, 0.55) << "it stands still";
  });
}

// Of order 4, two engines that nobody wrote together, in coordinates of their own: what both make
// of a scene is what it says.
TEST_F(Peers, EnginesOfOrderFourAgree) {
  for (const int dimension : {2, 3}) {
    std::vector<BodySpec> planks = {plank({0.5, 0, 0}, 0.5, dimension), plank({}, 0.5, dimension)};
    if (dimension == 3) planks[0].axis = planks[1].axis = {0.6, 0, 0.8};
    planks[0].spin = 10;
    planks[1].angle = 0.7;
    planks[1].spin = 3;
    Scenario s = scene(dimension, planks);
    s.world.gravity = {1, -10, 0};
    const Vec<3> at_b = {-0.5, 0, 0}, axis = planks[0].axis;
    const Vec<3> arm = -(matrix(turned(Rotation<3>(), axis * 0.7)) * at_b);
    s.bodies[0].velocity = cross(10.0 * axis, Vec<3>(0.5, 0, 0));
    s.bodies[1].position = Vec<3>(1, 0, 0) + arm;
    s.bodies[1].velocity = cross(10.0 * axis, Vec<3>(1, 0, 0)) + cross(3.0 * axis, arm);
    s.links = {joint(LinkSpec::Kind::pin, 0, {-0.5, 0, 0}, std::nullopt, {0, 0, 0}),
               joint(LinkSpec::Kind::pin, 0, {0.5, 0, 0}, 1, at_b)};
    std::vector<std::vector<BodyState>> ends;
    for (const auto& peer : found_) {
      if (!peer->name().ends_with("RK4")) continue;
      SCOPED_TRACE(peer->name() + (dimension == 2 ? " in 2D" : " in 3D"));
      const auto begin = after(*peer, s, 1.0 / 1024, 0);
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LT(glm::length(begin[i].position - s.bodies[i].position), 1e-12);
        EXPECT_LT(glm::length(begin[i].velocity - s.bodies[i].velocity), 1e-12);
        EXPECT_LT(glm::length(begin[i].angular_velocity - s.bodies[i].spin * axis), 1e-12);
      }
      ends.push_back(after(*peer, s, 1.0 / 1024, 300));
    }
    for (std::size_t k = 1; k < ends.size(); ++k)
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LT(glm::length(ends[k][i].position - ends[0][i].position), 1e-6) << dimension;
        EXPECT_LT(glm::length(ends[k][i].velocity - ends[0][i].velocity), 1e-5) << dimension;
        EXPECT_LT(glm::length(ends[k][i].angular_velocity - ends[0][i].angular_velocity), 1e-4);
      }
  }
}

// The one problem that all four can do, and what their own joints are worth.
TEST_F(Peers, APendulumOnHingesIsAsExactAsItsIntegrator) {
  const Scenario s = measure::problem("pendulum");
  for (const auto& peer : found_) {
    if (peer->cannot(s)) continue;
    SCOPED_TRACE(peer->name());
    const Schedule schedule = Schedule::of(s);
    const Invariants invariants(s);
    const Reference reference = reference_for(s, schedule, 1);
    const Row row =
        evaluated({s, schedule, invariants, reference}, *peer, schedule.fitted_step(0.0125));
    ASSERT_TRUE(row.error()) << row.reason;
    const bool fourth = peer->name().ends_with("RK4");
    EXPECT_LT(*row.error(), fourth ? 1e-5 : 1.0);
  }
}

}  // namespace
}  // namespace lantern::measure
