// All rows at once: the linear equations themselves, and what they must bring to a complete rest.
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "jointed_scene.hpp"
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
  EXPECT_LE(world.work().constraint_rows - before, 60u * 8u * 12u * kRowsOfFace<3> * 3u)
      << "more than three sweeps a sub-step";
}

// Boxes with gaps between them, each on two others: exact at rest.
template <int D>
World<D> pyramid(int rows, double gap, double half, double friction) {
  WorldConfig<D> config = falling<D>();
  config.contacts = ContactMethod::direct;
  config.may_sleep = false;
  World<D> world(config);
  world.add(floor_at<D>(0, friction));
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < rows - row; ++i) {
      const double x = (i - (rows - row - 1) / 2.0) * (2 * half + gap);
      Body<D> box = box_at<D>(along<D>(x, half * (1 + 2 * row)), half);
      box.material.friction = friction;
      world.add(box);
    }
  return world;
}

template <int D>
double farthest_from(const World<D>& world, const std::vector<Body<D>>& before) {
  double moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    moved = std::max(moved, glm::length(world.bodies()[i].position - before[i].position));
  return moved;
}

template <int D>
void expect_no_gain(World<D>& world, int steps, const std::string& what) {
  const double start = total_energy(world);
  double highest = start;
  for (int i = 0; i < steps; ++i) {
    world.step(kStep);
    ASSERT_LE(total_energy(world), highest + 1e-9 * start) << what << ", step " << i;
    highest = std::max(highest, total_energy(world));
  }
}

template <int D>
void expect_pyramids_stand(const std::vector<int>& sizes) {
  Random random(11);
  for (const int rows : sizes) {
    const double half = random.between(0.3, 0.7), gap = random.between(0.05, 0.3) * half,
                 friction = random.between(0.1, 0.5);
    const std::string what =
        fmt::format("{}D, {} rows, half {}, gap {}, friction {}", D, rows, half, gap, friction);
    World<D> world = pyramid<D>(rows, gap, half, friction);
    const std::vector<Body<D>> before = world.bodies();
    expect_no_gain(world, 12, what);
    EXPECT_LT(farthest_from(world, before), 1e-5) << what;
  }
}

TEST(DirectSolve, HoldsPyramidsInThePlane) {
  expect_pyramids_stand<2>({5, 9, 13, 14, 16, 17, 18, 20});
}
TEST(DirectSolve, HoldsPyramidsInSpace) { expect_pyramids_stand<3>({5, 9, 12}); }

// A rope of light balls round a part of a drum, `wrap` in radians. Weights at its ends are pulled
// away along its last pieces, by forces of 1 and of some `part` of the way from there to where it
// slips: Euler's capstan equation, for n straight pieces T2 / T1 = ((1 + mu t) / (1 - mu t))^n,
// t = tan(wrap / 2n).
template <int D>
struct Capstan {
  World<D> world;
  double slips_at = 1, force = 1;
  BodyId pulled = 0;
};

template <int D>
Capstan<D> capstan(ContactMethod method, double friction, double wrap, double part) {
  constexpr BodyId kBalls = 16;
  WorldConfig<D> config;
  config.contacts = method;
  config.integrator = Integrator::velocity_verlet;
  config.may_sleep = false;
  Capstan<D> c{World<D>(config)};
  const auto add = [&](const Vec<D>& place, double mass, double radius) {
    Body<D> body = ball_at<D>(place, Vec<D>(0.0), radius);
    body.mass = mass;
    body.may_turn = false;
    body.material.friction = friction;
    if (mass == 0) body.kind = BodyKind::static_body;
    return c.world.add(body);
  };
  add(Vec<D>(0.0), 0, 1);
  const double radius = 1.03, half = wrap / kBalls / 2, turn = std::tan(half);
  for (int i = 0; i < static_cast<int>(kBalls); ++i) {
    const double angle = (2 * i + 1) * half - wrap / 2;
    add(along<D>(radius * std::sin(angle), radius * std::cos(angle)), 1e-4, 0.03);
  }
  for (BodyId i = 1; i < kBalls; ++i) rod<D>(c.world, i, i + 1, 2 * radius * std::sin(half));
  const auto pull = [&](double side, BodyId ball, double force) {
    const Vec<D> way = along<D>(side * std::cos(wrap / 2), -std::sin(wrap / 2));
    const BodyId weight = add(c.world.find(ball)->position + way, 1, 0.05);
    rod<D>(c.world, ball, weight, 1);
    c.world.push(weight, way * force, c.world.find(weight)->position);
    return weight;
  };
  c.slips_at = std::pow((1 + friction * turn) / (1 - friction * turn), kBalls);
  c.force = 1 + part * (c.slips_at - 1);
  pull(-1, 1, 1);
  c.pulled = pull(1, kBalls, c.force);
  return c;
}

template <int D>
void expect_capstans_as_euler_says(ContactMethod method) {
  Random random(5);
  for (int i = 0; i < 4; ++i) {
    const double friction = random.between(0.15, 0.5), wrap = random.between(1, 3),
                 part = i % 2 == 0 ? random.between(0.5, 0.9) : random.between(1.1, 1.5);
    const std::string what = fmt::format("{}D {}, friction {}, wrap {}, part {}", D,
                                         to_string(method), friction, wrap, part);
    Capstan<D> c = capstan<D>(method, friction, wrap, part);
    const std::vector<Body<D>> before = c.world.bodies();
    constexpr int kSteps = 6;
    run(c.world, kSteps * kStep);
    const double moved = glm::length(c.world.find(c.pulled)->position - before[c.pulled].position);
    const double seconds = kSteps * kStep,
                 sped_up = std::max(c.force - c.slips_at, 0.0) / (1 + c.slips_at);
    EXPECT_NEAR(moved, sped_up * seconds * seconds / 2, part < 1 ? 1e-8 : 0.03 * moved) << what;
    if (part < 1) {
      EXPECT_LT(farthest_from(c.world, before), 1e-8) << what;
    }
    EXPECT_LE(total_energy(c.world), (c.force - 1) * moved + 1e-9) << what << ": more than work";
  }
}

TEST(DirectSolve, CapstansHoldAndSlipAsEulerSays2) {
  expect_capstans_as_euler_says<2>(ContactMethod::direct);
  expect_capstans_as_euler_says<2>(ContactMethod::soft);
}
TEST(DirectSolve, CapstansHoldAndSlipAsEulerSays3) {
  expect_capstans_as_euler_says<3>(ContactMethod::direct);
}

// A few boxes and balls that spin, fall onto each other and slide; some of them on rods.
template <int D>
World<D> few_bodies(std::uint64_t seed, bool jointed) {
  Random random(seed);
  WorldConfig<D> config = falling<D>();
  config.contacts = ContactMethod::direct;
  World<D> world(config);
  world.add(floor_at<D>(0, random.between(0, 0.8)));
  const auto count = static_cast<BodyId>(3 + seed % 4);
  for (BodyId i = 1; i <= count; ++i) {
    const Vec<D> place = along<D>(random.between(-0.3, 0.3), 1.1 * i);
    Body<D> body = i % 3 == 2 ? ball_at<D>(place) : box_at<D>(place, random.between(0.2, 0.5));
    body.material.friction = random.between(0, 0.8);
    body.velocity.x = random.between(-3, 3);
    const Spin<D> axis = unit_spin<D>(D == 2 ? 0 : 2);
    body.orientation = turned(body.orientation, random.between(0, 3) * axis);
    world.add(body, random.between(-10, 10) * axis);
    if (!jointed || i == 1) continue;
    Joint<D> rod{.kind = JointKind::distance, .a = i - 1, .b = i, .collide = true};
    rod.length = glm::length(world.find(i - 1)->position - place);
    world.add_joint(rod);
  }
  return world;
}

template <int D>
void expect_no_energy_out_of_nothing() {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    World<D> world = few_bodies<D>(seed, seed % 2 == 1);
    expect_no_gain(world, 45, fmt::format("{}D, seed {}", D, seed));
  }
}
TEST(DirectSolve, MakesNoEnergy2) { expect_no_energy_out_of_nothing<2>(); }
TEST(DirectSolve, MakesNoEnergy3) { expect_no_energy_out_of_nothing<3>(); }

TEST(EnvelopeSystem, TellsItsWorkBeforeItIsDone) {
  EnvelopeSystem system;
  for (int line = 0; line < 3; ++line) system.add_line(0);
  EXPECT_EQ(system.work(), (1 + 4 + 9) / 2.0);
  system.add_line(3);
  EXPECT_EQ(system.work(), 7.5) << "a line of its diagonal alone";
}

}  // namespace
}  // namespace lantern::physics
