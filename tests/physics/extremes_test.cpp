// Extreme worlds: sizes, places, steps and speeds at which a step may fail, but never silently.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "geometry/not_finite.hpp"
#include "physics/forces.hpp"
#include "world_scene.hpp"

namespace lantern::physics {
namespace {

template <int D>
bool all_finite(const World<D>& world) {
  for (const Body<D>& body : world.bodies())
    for (int i = 0; i < D; ++i)
      if (!std::isfinite(body.position[i]) || !std::isfinite(body.velocity[i])) return false;
  return true;
}

template <int D, class Action>
void expect_refused(World<D>& world, const std::string& part, Action&& action) {
  const std::uint64_t before = world.hash();
  try {
    action();
    ADD_FAILURE() << "not refused: " << part;
  } catch (const Refused& refused) {
    EXPECT_NE(std::string(refused.what()).find(part), std::string::npos) << refused.what();
  }
  EXPECT_EQ(world.hash(), before) << "a refusal left the world changed: " << part;
}

template <int D>
World<D> two_boxes() {
  World<D> world(falling<D>());
  world.add(floor_at<D>());
  world.add(box_at<D>(up<D>(0.5)));
  world.add(box_at<D>(up<D>(1.5)));
  run(world, 0.1);
  return world;
}

TEST(Extremes, EveryFieldOfASpringIsLookedAt) {
  World<3> world = two_boxes<3>();
  for (const double bad : {-1.0, kNan, kInfinity}) {
    const auto add = [&](const char* field, auto&& spoil) {
      Spring<3> spring;
      spring.a = 1;
      spring.b = 2;
      spoil(spring);
      expect_refused(world, field, [&] { world.add_spring(spring); });
    };
    add("stiffness", [&](Spring<3>& s) { s.stiffness = bad; });
    add("damping", [&](Spring<3>& s) { s.damping = bad; });
    add("rest_length", [&](Spring<3>& s) { s.rest_length = bad; });
    if (bad == -1) continue;
    add("at_a", [&](Spring<3>& s) { s.at_a.y = bad; });
    add("at_b", [&](Spring<3>& s) { s.at_b.z = bad; });
  }
}

TEST(Extremes, EveryFieldOfAJointIsLookedAt) {
  World<3> world = two_boxes<3>();
  for (const double bad : {-1.0, 0.0, kNan, kInfinity}) {
    Joint<3> joint;
    joint.kind = JointKind::distance;
    joint.a = 1;
    joint.b = 2;
    joint.length = bad;
    expect_refused(world, "length", [&] { world.add_joint(joint); });
    if (std::isfinite(bad)) continue;
    joint.length = 1;
    joint.at_b.x = bad;
    expect_refused(world, "at_b", [&] { world.add_joint(joint); });
  }
}

TEST(Extremes, EveryVectorOfAScriptIsLookedAt) {
  World<3> world = two_boxes<3>();
  const Vec<3> none(0.0);
  for (const double bad : {kNan, kInfinity, -kInfinity})
    for (int i = 0; i < 3; ++i) {
      Vec<3> v(0.0);
      v[i] = bad;
      expect_refused(world, "velocity", [&] { world.set_velocity(1, v); });
      expect_refused(world, "angular velocity", [&] { world.set_angular_velocity(1, v); });
      expect_refused(world, "impulse", [&] { world.apply_impulse(1, v, none); });
      expect_refused(world, "impulse", [&] { world.apply_impulse(1, none, v); });
      expect_refused(world, "force", [&] { world.push(1, v, none); });
      expect_refused(world, "force", [&] { world.push(1, none, v); });
      expect_refused(world, "position", [&] { world.place(1, v, none); });
      expect_refused(world, "velocity", [&] { world.place(1, none, v); });
      expect_refused(world, "gravity", [&] { world.set_gravity(v); });
    }
  expect_refused(world, "seconds", [&] { world.push(1, none, none, -1.0); });
  expect_refused(world, "seconds", [&] { world.push(1, none, none, 0.0); });
  Rotation<3> no_rotation;
  no_rotation.q *= 2.0;
  expect_refused(world, "orientation", [&] { world.place(1, none, none, no_rotation); });
}

TEST(Extremes, EveryFieldOfAConfigIsLookedAt) {
  const auto expect_bad = [](auto&& spoil) {
    WorldConfig<2> config;
    spoil(config);
    EXPECT_THROW(World<2>{config}, Refused);
  };
  for (const int bad : {0, -1, 1 << 30}) {
    expect_bad([&](auto& c) { c.sub_steps = bad; });
    expect_bad([&](auto& c) { c.iterations = bad; });
  }
  expect_bad([](auto& c) { c.impact_budget = -1; });
  for (const double bad : {-1.0, kNan, kInfinity}) {
    expect_bad([&](auto& c) { c.sleep_after = bad; });
    expect_bad([&](auto& c) { c.sleep_speed = bad; });
    expect_bad([&](auto& c) { c.sleep_spin = bad; });
    expect_bad([&](auto& c) { c.broad_phase.bounds.hi.x = bad * 1e9; });
  }
}

TEST(Extremes, AnOverflowByForcesNamesBodyAndStep) {
  World<3> world = two_boxes<3>();
  Body<3> light = ball_at<3>({9, 9, 9});
  light.name = "light";
  light.mass = 1e-300;
  const BodyId id = world.add(light);
  world.push(id, {1e9, 0, 0}, {9, 9, 9});
  expect_refused(world, fmt::format("in step {}", world.work().steps + 1),
                 [&] { world.step(kStep); });
  expect_refused(world, "'light'", [&] { world.step(kStep); });
  world.clear_pushes();
  EXPECT_NO_THROW(world.step(kStep)) << "without the push it goes on";
}

// Bodies of all sizes: every broad phase sees the same pairs as brute force, and nothing overflows.
template <int D>
void expect_pairs_of_brute_force(bool thin) {
  std::optional<std::uint64_t> hash;
  std::vector<Pair> expected;
  for (const StructureKind kind : kStructureKinds) {
    if (!is_possible(kind, D)) continue;
    WorldConfig<D> config = falling<D>();
    config.broad_phase.kind = kind;
    World<D> world(config);
    Random random(5);
    for (int i = 0; i < 39; ++i) {
      Vec<D> place(0.0), half(1.0);
      for (int axis = 0; axis < D; ++axis) place[axis] = random.between(-50, 50);
      const double size = thin ? 1 : std::pow(10.0, static_cast<double>(i % 13 - 6));
      half *= size;
      if (thin) half[i % D] = 1e-4;
      Body<D> body = box_at<D>(place * (thin ? 0.1 : 1.0));
      body.shape = OrientedBox<D>{half};
      body.mass = 1;
      world.add(body);
    }
    for (int i = 0; i < 2; ++i) world.step(kStep);
    ASSERT_TRUE(all_finite(world)) << to_string(kind);
    if (!hash) {
      expected = world.pairs();
      hash = world.hash();
    }
    EXPECT_EQ(world.pairs(), expected) << D << "D: " << to_string(kind);
    EXPECT_EQ(world.hash(), *hash) << D << "D: " << to_string(kind);
  }
  EXPECT_GT(expected.size(), 5u) << "nothing overlaps: no test";
}

TEST(Extremes, SizesFromAMillionthToAMillion) {
  expect_pairs_of_brute_force<2>(false);
  expect_pairs_of_brute_force<3>(false);
}

TEST(Extremes, AspectsOfOneToTenThousand) {
  expect_pairs_of_brute_force<2>(true);
  expect_pairs_of_brute_force<3>(true);
}

// The same motion wherever the origin is, but for the digits that the place takes away.
template <int D>
std::vector<Vec<D>> relative_motion(double offset, int steps) {
  World<D> world(falling<D>());
  Vec<D> origin(0.0);
  for (int i = 0; i < D; ++i) origin[i] = i == 1 ? 0 : offset;
  world.add(floor_at<D>());
  world.add(box_at<D>(origin + up<D>(0.5)));
  world.add(box_at<D>(origin + along<D>(0.25, 1.5)));
  world.add(ball_at<D>(origin + along<D>(4, 0.5), along<D>(-3)));
  for (int i = 0; i < steps; ++i) world.step(kStep);
  std::vector<Vec<D>> places;
  for (const Body<D>& body : world.bodies()) places.push_back(body.position - origin);
  places.erase(places.begin());
  return places;
}

template <int D>
void expect_same_motion_far_away() {
  const int steps = 60;
  const auto near = relative_motion<D>(0, steps);
  for (const double offset : {1e6, 1e9}) {
    const auto far = relative_motion<D>(offset, steps);
    const double ulp = std::nextafter(offset, 2 * offset) - offset;
    for (std::size_t i = 0; i < near.size(); ++i)
      EXPECT_LE(glm::length(far[i] - near[i]), 8 * ulp * steps)
          << D << "D, body " << i << " at " << offset;
  }
}

TEST(Extremes, TheOriginDoesNotMatter2) { expect_same_motion_far_away<2>(); }
TEST(Extremes, TheOriginDoesNotMatter3) { expect_same_motion_far_away<3>(); }

template <int D>
void expect_settles_far_away() {
  World<D> world(falling<D>());
  world.add(floor_at<D>());
  world.add(box_at<D>(along<D>(1e7, 0.6)));
  run(world, 3);
  EXPECT_LE(glm::length(world.bodies()[1].position - along<D>(1e7, 0.5)), 1e-6) << D << "D";
}

TEST(Extremes, ABoxSettlesFarFromTheOrigin) {
  expect_settles_far_away<2>();
  expect_settles_far_away<3>();
}

// Bodies in each other come apart slowly, and the same way every time.
template <int D>
void expect_comes_apart(const Body<D>& body, double apart) {
  World<D> world((WorldConfig<D>()));
  Body<D> other = body;
  other.position.x += apart;
  world.add(body);
  world.add(other);
  double fastest = 0;
  for (int i = 0; i < 240; ++i) {
    world.step(kStep);
    for (const Body<D>& b : world.bodies()) fastest = std::max(fastest, glm::length(b.velocity));
  }
  EXPECT_LE(deepest(world), 1e-3) << D << "D, " << apart;
  EXPECT_LE(fastest, 1e-6) << D << "D, " << apart << ": pushing apart must not become motion";
}

TEST(Extremes, CoincidentAndDeepBodiesComeApartSlowly) {
  for (const double apart : {0.0, 1e-300, 1e-9, 0.1}) {
    expect_comes_apart<2>(ball_at<2>({3, 4}), apart);
    expect_comes_apart<3>(ball_at<3>({3, 4, 5}), apart);
    expect_comes_apart<2>(box_at<2>({3, 4}), apart);
    expect_comes_apart<3>(box_at<3>({3, 4, 5}), apart);
  }
}

TEST(Extremes, StepsOfEveryLength) {
  World<3> world = two_boxes<3>();
  const std::uint64_t before = world.hash();
  world.step(0);
  EXPECT_EQ(world.hash(), before) << "a step of 0 does nothing";
  expect_refused(world, "time step", [&] { world.step(-1e-12); });
  for (const double h : {1e-12, 1e-6, 1.0, 1e3}) {
    try {
      for (int i = 0; i < 5; ++i) world.step(h);
    } catch (const Refused& refused) {
      EXPECT_NE(std::string(refused.what()).find("'"), std::string::npos) << refused.what();
    }
    ASSERT_TRUE(all_finite(world)) << h;
  }
  EXPECT_NEAR(world.bodies()[1].position.y, 0.5, 1e-3) << "what rests does so at any step";
}

// A shape without size may stand still, and fall if it has a mass.
TEST(Extremes, ShapesWithoutSizeMeetOthers) {
  World<3> world(falling<3>());
  Body<3> point = ball_at<3>({0, 0, 0}, Vec<3>(0.0), 0);
  point.kind = BodyKind::static_body;
  world.add(point);
  world.add(floor_at<3>(-2));
  Body<3> falls = ball_at<3>({3, 0, 0}, Vec<3>(0.0), 0);
  falls.mass = 1;
  world.add(falls);
  world.add(box_at<3>({0, 1, 0}));
  run(world, 2);
  EXPECT_TRUE(all_finite(world));
  EXPECT_NEAR(world.bodies()[2].position.y, -2, 1e-3) << "a point with a mass falls to the floor";
}

// w/h = 1 / tan: a tower of width 1 and height 4 topples where the slope is steeper than 1/4.
TEST(Extremes, TopplesOnlyBeyondItsEdge) {
  for (const double off : {-0.01, 0.01}) {
    const double alpha = std::atan(0.25 * (1 + off));
    WorldConfig<2> config;
    config.gravity = {10 * std::sin(alpha), -10 * std::cos(alpha)};
    World<2> world(config);
    world.add(floor_at<2>(0, 2));
    Body<2> tower = box_at<2>({0, 2});
    tower.shape = OrientedBox<2>{{0.5, 2}};
    tower.material.friction = 2;
    world.add(tower);
    run(world, 10);
    const double turned = std::abs(world.bodies()[1].orientation.angle);
    if (off < 0) {
      EXPECT_LE(turned, 1e-6);
    } else {
      EXPECT_GT(turned, 1);
    }
  }
}

// sticks if and only if tan(alpha) <= mu, to a ten-thousandth
TEST(Extremes, SlidesJustBeyondTheFrictionAngle) {
  for (const double off : {-1e-4, 1e-4}) {
    const double mu = 0.5, alpha = std::atan(mu + off);
    WorldConfig<3> config;
    config.gravity = {10 * std::sin(alpha), -10 * std::cos(alpha), 0};
    config.may_sleep = false;  // it starts as slowly as what comes to rest
    World<3> world(config);
    world.add(floor_at<3>(0, mu));
    Body<3> box = box_at<3>(up<3>(0.5));
    box.material.friction = mu;
    world.add(box);
    run(world, 2);
    const double a = 10 * (std::sin(alpha) - mu * std::cos(alpha));
    EXPECT_NEAR(world.bodies()[1].velocity.x, off > 0 ? a * 2 : 0, 5e-5);
  }
}

// A ball that does not slip: a = g sin(alpha) / (1 + 2/5) = 5/7 g sin(alpha).
TEST(Extremes, ABallRollsAtFiveSevenths) {
  const double alpha = 0.3;
  WorldConfig<3> config;
  config.gravity = {10 * std::sin(alpha), -10 * std::cos(alpha), 0};
  World<3> world(config);
  world.add(floor_at<3>());
  world.add(ball_at<3>(up<3>(0.5)));
  run(world, 2);
  EXPECT_NEAR(world.bodies()[1].velocity.x, 5.0 / 7 * 10 * std::sin(alpha) * 2, 1e-6);
}

// Mixed shapes thrown at each other and the floor: with impulses, friction and restitution, no step
// may give energy beyond what large steps of turning and gravity give.
double largest_gain(ContactMethod method, std::uint64_t seed) {
  Random random(seed);
  WorldConfig<3> config;
  config.contacts = method;
  World<3> world(config);
  world.add(floor_at<3>());
  const double restitution = random.unit();
  const double speed = random.unit() < 0.3 ? 1000 : random.between(1, 50);
  const auto size = [&] { return random.between(0.1, 1) * (random.unit() < 0.2 ? 0.1 : 1); };
  for (int i = 0, n = static_cast<int>(random.whole(2, 12)); i < n; ++i) {
    Body<3> body;
    const double x = size(), y = size(), z = size();
    const Shape<3> shapes[] = {Sphere{x}, Capsule{x, y}, AxisBox<3>{{x, y, z}}};
    body.shape = shapes[random.whole(0, 2)];
    body.density = random.unit() < 0.3 ? 100 : 1;
    body.material = {restitution, random.unit()};
    for (int axis = 0; axis < 3; ++axis) {
      body.position[axis] = random.between(-1.5, 1.5) + (axis == 1 ? 2 : 0);
      body.velocity[axis] = speed * random.between(-1, 1);
    }
    world.add(body);
  }
  const auto now = [&] { return energy<3>(world.bodies(), {}).total(); };
  const double start = now();
  double most = 0;
  for (int i = 0; i < 60; ++i) {
    const double before = now();
    world.step(kStep);
    most = std::max(most, (now() - before) / start);
  }
  return most;
}

// Not proven: in 3 of 3000 such worlds (soft, seeds 824, 1060 and 1160) a step still gives 0.1 to
// 6 times the energy, where sweeps end before they have converged.
TEST(Extremes, ThrownPilesGainNoEnergy) {
  const auto expect_none = [](ContactMethod method, std::uint64_t seed) {
    EXPECT_LE(largest_gain(method, seed), 0.05) << to_string(method) << ", seed " << seed;
  };
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    expect_none(ContactMethod::impulse, seed);
    expect_none(ContactMethod::soft, seed);
  }
  // A blow just before the end of a step, once taken for a force.
  for (const std::uint64_t seed : {144, 149, 567, 919}) expect_none(ContactMethod::impulse, seed);
  for (const std::uint64_t seed : {448, 526, 532, 582}) expect_none(ContactMethod::soft, seed);
}

TEST(Extremes, AHundredBoxesStand) {
  WorldConfig<2> config = falling<2>();
  config.sub_steps = 16;
  config.may_sleep = false;
  World<2> world(config);
  world.add(floor_at<2>());
  for (int i = 0; i < 100; ++i) world.add(box_at<2>(up<2>(0.5 + i)));
  run(world, 4);
  for (int i = 0; i < 100; ++i)
    ASSERT_LE(
        glm::length(world.bodies()[static_cast<std::size_t>(i + 1)].position - up<2>(0.5 + i)),
        1e-3)
        << "box " << i;
}

}  // namespace
}  // namespace lantern::physics
