// Impacts of bodies that joints hold, against closed forms and a full system of linear equations.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "jointed_scene.hpp"
#include "physics/contact/solver_body.hpp"

namespace lantern::physics {
namespace {

constexpr std::array kMethodsOfJointedImpacts{ContactMethod::impulse, ContactMethod::soft,
                                              ContactMethod::direct};

template <int D>
constexpr std::size_t kSpinsOf = D == 2 ? 1 : 3;
template <int D>
constexpr std::size_t kFreedomsOf = D + kSpinsOf<D>;

template <int D>
WorldConfig<D> weightless(ContactMethod method) {
  WorldConfig<D> config = jointed<D>(Integrator::velocity_verlet);
  config.gravity = Vec<D>(0.0);
  config.contacts = method;
  return config;
}

template <int D>
Vec<D> any_way(Random& random) {
  for (;;) {
    Vec<D> v(0.0);
    for (int i = 0; i < D; ++i) v[i] = random.between(-1, 1);
    if (const double length = glm::length(v); length > 0.1 && length < 1) return v / length;
  }
}
// Gauss, with the largest pivot of each column.
std::vector<double> solved_by_gauss(std::vector<std::vector<double>> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r < n; ++r)
      if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
    std::swap(a[c], a[pivot]);
    std::swap(b[c], b[pivot]);
    for (std::size_t r = c + 1; r < n; ++r) {
      const double part = a[r][c] / a[c][c];
      for (std::size_t k = c; k < n; ++k) a[r][k] -= part * a[c][k];
      b[r] -= part * b[c];
    }
  }
  for (std::size_t c = n; c-- > 0;) {
    for (std::size_t k = c + 1; k < n; ++k) b[c] -= a[c][k] * b[k];
    b[c] /= a[c][c];
  }
  return b;
}

// A world's bodies and joints as matrices, where they are.
template <int D>
struct FullSystem {
  using Row = std::vector<double>;
  const World<D>& world;
  std::vector<Row> mass = {};    // of all freedoms
  std::vector<Row> joints = {};  // J

  explicit FullSystem(const World<D>& of) : world(of) {
    const std::size_t n = of.bodies().size() * kFreedomsOf<D>;
    mass.assign(n, Row(n));
    for (const Body<D>& body : of.bodies()) add_mass(body);
    for (const auto& [id, joint] : of.joints()) {
      const Body<D>&a = *of.find(joint.a), &b = *of.find(joint.b);
      const Vec<D> arm_a = matrix(a.orientation) * joint.at_a;
      const Vec<D> arm_b = matrix(b.orientation) * joint.at_b;
      const Vec<D> gap = b.position + arm_b - a.position - arm_a;
      if (joint.kind == JointKind::distance)
        joints.push_back(
            row(joint.a, a.position + arm_a, joint.b, b.position + arm_b, glm::normalize(gap)));
      else
        for (int i = 0; i < D; ++i)
          joints.push_back(
              row(joint.a, a.position + arm_a, joint.b, b.position + arm_b, unit_vec<D>(i)));
    }
  }

  void add_mass(const Body<D>& body) {
    const std::size_t at = body.id * kFreedomsOf<D>;
    const bool moves = body.is_dynamic();
    for (std::size_t i = 0; i < kFreedomsOf<D>; ++i) mass[at + i][at + i] = 1e15;
    if (!moves) return;
    for (std::size_t i = 0; i < D; ++i) mass[at + i][at + i] = body.mass;
    if constexpr (D == 2) {
      mass[at + 2][at + 2] = 1 / body.inverse_inertia;
    } else {
      const Mat<3> inertia = glm::inverse(world_inverse_inertia(body));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          mass[at + 3 + static_cast<std::size_t>(i)][at + 3 + static_cast<std::size_t>(j)] =
              inertia[j][i];
    }
  }

  // The velocity of b's point against a's along a direction.
  Row row(BodyId a, const Vec<D>& at_a, BodyId b, const Vec<D>& at_b, const Vec<D>& along) const {
    Row made(mass.size());
    const auto add = [&](BodyId id, const Vec<D>& point, double sign) {
      const std::size_t at = id * kFreedomsOf<D>;
      const Spin<D> turn = cross(point - world.find(id)->position, along);
      for (std::size_t i = 0; i < D; ++i) made[at + i] += sign * along[static_cast<int>(i)];
      for (std::size_t i = 0; i < kSpinsOf<D>; ++i)
        made[at + D + i] += sign * spin_component(turn, static_cast<int>(i));
    };
    add(a, at_a, -1);
    add(b, at_b, 1);
    return made;
  }

  Row velocities() const {
    Row all;
    for (const Body<D>& body : world.bodies()) {
      for (int i = 0; i < D; ++i) all.push_back(body.is_dynamic() ? body.velocity[i] : 0);
      const Spin<D> spin = body.is_dynamic() ? angular_velocity(body) : Spin<D>(0.0);
      for (std::size_t i = 0; i < kSpinsOf<D>; ++i)
        all.push_back(spin_component(spin, static_cast<int>(i)));
    }
    return all;
  }

  static double product(const Row& x, const Row& y) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
    return sum;
  }

  // v such that joints do not part and seen.v = wanted, by impulses along joints and `pushes`.
  Row after(const Row& v, const std::vector<Row>& seen, const std::vector<Row>& pushes,
            const std::vector<double>& wanted) const {
    const std::size_t n = mass.size(), m = joints.size(), all = n + m + seen.size();
    std::vector<Row> a(all, Row(all));
    Row b(all);
    for (std::size_t i = 0; i < n; ++i) {
      std::ranges::copy(mass[i], a[i].begin());
      for (std::size_t k = n; k < all; ++k)
        a[i][k] = -(k < n + m ? joints[k - n] : pushes[k - n - m])[i];
    }
    for (std::size_t k = n; k < all; ++k) {
      const Row& of = k < n + m ? joints[k - n] : seen[k - n - m];
      std::ranges::copy(of, a[k].begin());
      b[k] = (k < n + m ? 0 : wanted[k - n - m]) - product(of, v);
    }
    Row now = solved_by_gauss(a, b);
    now.resize(n);
    for (std::size_t i = 0; i < n; ++i) now[i] += v[i];
    return now;
  }
};

template <int D>
void give_velocities(World<D>& world, const std::vector<double>& v) {
  for (const Body<D>& body : world.bodies()) {
    if (!body.is_dynamic()) continue;
    const std::size_t at = body.id * kFreedomsOf<D>;
    Vec<D> velocity(0.0);
    for (std::size_t i = 0; i < D; ++i) velocity[static_cast<int>(i)] = v[at + i];
    Spin<D> spin(0.0);
    for (std::size_t i = 0; i < kSpinsOf<D>; ++i)
      spin += unit_spin<D>(static_cast<int>(i)) * v[at + D + i];
    world.set_velocity(body.id, velocity);
    world.set_angular_velocity(body.id, spin);
  }
}

template <int D>
void set_any_velocities(World<D>& world, Random& random) {
  std::vector<double> v;
  for (const Body<D>& body : world.bodies())
    for (std::size_t i = 0; i < kFreedomsOf<D>; ++i)
      v.push_back(body.is_dynamic() ? random.between(-2, 2) : 0);
  give_velocities(world, FullSystem<D>(world).after(v, {}, {}, {}));
}

constexpr double kBlowStep = 1e-9;  // a step in which nothing but the blow matters

// Bodies in a tree of pins and rods, perhaps hung up, and the first of them, a ball or a box whose
// corner points that way, next to a half-space.
template <int D>
World<D> a_tree_at_a_wall(Random& random, ContactMethod method, double restitution,
                          double friction) {
  World<D> world(weightless<D>(method));
  const Vec<D> normal = any_way<D>(random);
  Body<D> wall = floor_at<D>(0, friction);
  wall.shape = HalfSpace<D>{normal};
  world.add(wall);
  const auto count = static_cast<BodyId>(random.whole(2, 5));
  std::vector<Vec<D>> places{normal * 0.3};
  for (BodyId i = 1; i <= count; ++i) {
    Body<D> body = plank_at<D>(places.back(), Vec<D>(random.between(0.2, 0.5)),
                               std::pow(10, random.between(-1, 1)));
    if constexpr (D == 3) body.shape = OrientedBox<D>{{0.2, 0.3, random.between(0.1, 0.5)}};
    if (i == 1) body.shape = Sphere{0.3};
    body.collides = i == 1;
    body.material = {restitution, friction};
    world.add(body);
    places.push_back(body.position + any_way<D>(random) * random.between(0.8, 1.5));
  }
  const bool hung = random.unit() < 0.5;
  if (hung) world.add(fixed_at<D>(places.back()));
  for (BodyId i = 2; i <= count + hung; ++i) {
    const BodyId to = i > count ? i - 1 : static_cast<BodyId>(random.whole(1, i - 1));
    const Vec<D> from = world.find(to)->position, way = world.find(i)->position - from;
    if (random.unit() < 0.5)
      pin<D>(world, to, i, way * 0.4, way * -0.6);
    else
      rod<D>(world, to, i, glm::length(way));
  }
  double along = 0;
  for (int i = 0; i < 20 && std::abs(along) < 0.3; ++i) {
    set_any_velocities(world, random);
    along = glm::dot(world.bodies()[1].velocity, normal);
  }
  std::vector<double> v = FullSystem<D>(world).velocities();
  for (double& value : v) value *= along < 0 ? 1 : -1;
  give_velocities(world, v);
  return world;
}

template <int D>
void expect_velocities(const World<D>& world, const std::vector<double>& wanted, const char* what) {
  const std::vector<double> got = FullSystem<D>(world).velocities();
  double size = 1, worst = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    size = std::max(size, std::abs(wanted[i]));
    worst = std::max(worst, std::abs(got[i] - wanted[i]));
  }
  EXPECT_LE(worst / size, 1e-7) << what << ", " << to_string(world.config().contacts);
}

template <int D>
void trees_follow_the_full_system() {
  Random random(20 + D);
  for (int i = 0; i < 60; ++i) {
    const double e = i % 3 == 0 ? 1 : random.between(0.05, 1);
    const ContactMethod method = kMethodsOfJointedImpacts[static_cast<std::size_t>(i / 3 % 3)];
    World<D> world = a_tree_at_a_wall<D>(random, method, e, 0);
    const FullSystem<D> system(world);
    const Vec<D> normal = std::get<HalfSpace<D>>(world.bodies()[0].shape).normal;
    const auto row = system.row(0, {}, 1, world.bodies()[1].position - normal * 0.3, normal);
    const std::vector<double> v = system.velocities();
    const auto wanted = system.after(v, {row}, {row}, {-e * FullSystem<D>::product(row, v)});
    const double before = total_energy(world);
    world.step(kBlowStep);
    expect_velocities(world, wanted, "without friction");
    if (e == 1) {
      EXPECT_NEAR(total_energy(world) / before, 1, 1e-12) << i;
    }
  }
}

TEST(JointedImpacts, TreesFollowTheFullSystem) {
  trees_follow_the_full_system<2>();
  trees_follow_the_full_system<3>();
}

// Of bodies that nothing else holds the blow is all that changes their momentum: what slips gets mu
// times its normal part against the slip, what sticks no more than that.
template <int D>
void friction_acts_through_joints() {
  Random random(30 + D);
  int slipped = 0, stuck = 0;
  for (int i = 0; i < 120; ++i) {
    const double e = random.between(0.05, 0.4), mu = random.between(0.05, 1.5);
    const ContactMethod method = kMethodsOfJointedImpacts[static_cast<std::size_t>(i % 3)];
    World<D> world = a_tree_at_a_wall<D>(random, method, e, mu);
    if (!world.bodies().back().is_dynamic()) continue;  // what hangs may be wedged in
    const FullSystem<D> system(world);
    const Vec<D> normal = std::get<HalfSpace<D>>(world.bodies()[0].shape).normal;
    const Vec<D> at = world.bodies()[1].position - normal * 0.3;
    std::vector<std::vector<double>> rows{system.row(0, {}, 1, at, normal)};
    for (const Vec<D>& along : tangents(normal)) rows.push_back(system.row(0, {}, 1, at, along));
    const auto momentum = [&] {
      Vec<D> sum(0.0);
      for (const Body<D>& body : world.bodies())
        if (body.is_dynamic()) sum += body.mass * body.velocity;
      return sum;
    };
    const Vec<D> before = momentum();
    const auto v = system.velocities();
    world.step(kBlowStep);
    const Vec<D> blow = momentum() - before;
    const auto got = FullSystem<D>(world).velocities();
    std::vector<double> speeds;
    for (const auto& row : rows) speeds.push_back(FullSystem<D>::product(row, got));
    EXPECT_NEAR(speeds[0], -e * FullSystem<D>::product(rows[0], v), 1e-7);
    expect_velocities(world, system.after(v, rows, rows, speeds), "by one blow");
    Vec<D> slip(0.0);
    for (std::size_t r = 1; r < rows.size(); ++r) slip += tangents(normal)[r - 1] * speeds[r];
    const double pressed = glm::dot(blow, normal);
    const Vec<D> rubbed = blow - normal * pressed;
    if (glm::length(slip) < 1e-6) {
      ++stuck;
      EXPECT_LE(glm::length(rubbed), mu * pressed * (1 + 1e-6));
    } else {
      ++slipped;
      EXPECT_LE(glm::length(rubbed + glm::normalize(slip) * (mu * pressed)), 1e-6 * pressed);
    }
  }
  EXPECT_GE(stuck, 10);
  EXPECT_GE(slipped, 10);
}

TEST(JointedImpacts, FrictionActsThroughJoints) {
  friction_acts_through_joints<2>();
  friction_acts_through_joints<3>();
}

// Balls and boxes next to a floor, pinned or by rods each to one before it.
template <int D>
World<D> a_net_on_the_floor(Random& random, ContactMethod method, double e, double mu) {
  World<D> world(weightless<D>(method));
  world.add(floor_at<D>(0, mu));
  const auto count = static_cast<BodyId>(random.whole(2, 6));
  for (BodyId i = 1; i <= count; ++i) {
    Vec<D> place = Vec<D>(random.between(-1, 1));
    place.x = i;
    place.y = 0.3;
    Body<D> body = plank_at<D>(place, Vec<D>(0.3), std::pow(10, random.between(-1, 1)));
    if (random.unit() < 0.5) body.shape = Sphere{0.3};
    body.material = {e, mu};
    world.add(body);
    if (i == 1) continue;
    const auto to = static_cast<BodyId>(i - random.whole(1, std::min<BodyId>(i - 1, 2)));
    const Vec<D> way = place - world.find(to)->position;
    if (random.unit() < 0.5)
      pin<D>(world, to, i, way * 0.4, way * -0.6);
    else
      rod<D>(world, to, i, glm::length(way));
  }
  set_any_velocities(world, random);
  return world;
}

template <int D>
void blows_at_many_points_give_no_energy() {
  Random random(40 + D);
  for (int i = 0; i < 60; ++i) {
    const ContactMethod method = kMethodsOfJointedImpacts[static_cast<std::size_t>(i % 3)];
    const double e = i % 2 == 0 ? 1 : random.unit(), mu = i % 4 < 2 ? 0 : random.unit();
    World<D> world = a_net_on_the_floor<D>(random, method, e, mu);
    const double before = total_energy(world);
    world.step(kBlowStep);
    const double ratio = total_energy(world) / before;
    EXPECT_LE(ratio, 1 + 1e-12) << i;
    if (e == 1 && mu == 0) {
      EXPECT_GE(ratio, 1 - 1e-12) << i;
    }
  }
}

TEST(JointedImpacts, BlowsAtManyPointsGiveNoEnergy) {
  blows_at_many_points_give_no_energy<2>();
  blows_at_many_points_give_no_energy<3>();
}

// Two balls on a rod, at any angle, thrown flat at the floor: an impulse
// J = (1 + e) v / (1/m1 - sin^2 / (m1 (1 + m1/m2))) at the lower one.
template <int D>
void a_dumbbell_bounces(double e) {
  Random random(50 + D);
  for (const ContactMethod method : kMethodsOfJointedImpacts)
    for (int i = 0; i < 4; ++i) {
      const double m1 = random.between(0.3, 3), m2 = random.between(0.3, 3);
      const double angle = i == 0 ? std::numbers::pi / 2 : random.between(0.6, 1.4);
      const double sine = std::sin(angle), speed = random.between(1, 5);
      World<D> world(weightless<D>(method));
      world.add(floor_at<D>(0, 0));
      Body<D> ball = ball_at<D>(up<D>(0.5), up<D>(-speed), 0.2);
      ball.material = {e, 0};
      ball.mass = m1;
      world.add(ball);
      ball.position += along<D>(1.5 * std::cos(angle), 1.5 * sine);
      ball.mass = m2;
      world.add(ball);
      rod<D>(world, 1, 2, 1.5);
      const double impulse = (1 + e) * speed / (1 / m1 - sine * sine / (m1 * (1 + m1 / m2)));
      while (world.work().impacts_located == 0) world.step(kStep);
      const auto bodies = world.bodies();
      EXPECT_NEAR(bodies[1].velocity.y * m1 + bodies[2].velocity.y * m2,
                  impulse - speed * (m1 + m2), 1e-9 * impulse)
          << to_string(method) << " at " << angle;
    }
}

TEST(JointedImpacts, ADumbbellBounces) {
  for (const double e : {0.2, 0.7, 1.0}) {
    a_dumbbell_bounces<2>(e);
    a_dumbbell_bounces<3>(e);
  }
}

// Two halves of a box, pinned together at more points than they need, strike a floor with a corner,
// an edge or a face: as the whole box does.
template <int D>
void halves_bounce_as_the_whole() {
  Random random(70 + D);
  for (int i = 0; i < 60; ++i) {
    Vec<D> half(0.3);
    half.x = 1;
    Spin<D> tilt(0.0), spin(0.0);
    for (int k = 0; i % 4 != 0 && k < static_cast<int>(kSpinsOf<D>); ++k) {
      tilt += unit_spin<D>(k) * random.between(-1, 1);
      spin += unit_spin<D>(k) * random.between(-2, 2);
    }
    const Rotation<D> turn = turned(Rotation<D>(), tilt);
    double height = 0;
    for (int k = 0; k < D; ++k) height += std::abs(matrix(turn)[k].y) * half[k];
    const double e = i % 2 == 0 ? 1 : random.between(0.1, 1);
    const auto at = [&](double x, const Vec<D>& size, double mass) {
      const Vec<D> arm = matrix(turn) * along<D>(x);
      Body<D> box = plank_at<D>(up<D>(height) + arm, size, mass);
      box.orientation = turn;
      box.material = {e, 0};
      box.velocity = up<D>(-3) + cross(spin, arm);
      return box;
    };
    World<D> whole(weightless<D>(ContactMethod::direct));
    World<D> halves(weightless<D>(kMethodsOfJointedImpacts[static_cast<std::size_t>(i % 3)]));
    whole.add(floor_at<D>(0, 0));
    halves.add(floor_at<D>(0, 0));
    whole.add(at(0, half, 2));
    half.x = 0.5;
    for (const double x : {-0.5, 0.5}) halves.add(at(x, half, 1));
    for (const Vec<D>& y : {up<D>(-0.3), up<D>(0.3), unit_vec<D>(D - 1) * 0.1})
      pin<D>(halves, 1, 2, along<D>(0.5) + y, along<D>(-0.5) + y);
    whole.set_angular_velocity(1, spin);
    for (const BodyId id : {1, 2}) halves.set_angular_velocity(id, spin);
    const double before = total_energy(halves);
    whole.step(kBlowStep);
    halves.step(kBlowStep);
    if (e == 1) {
      EXPECT_NEAR(total_energy(halves) / before, 1, 1e-12) << i;
    }
    const std::span<const Body<D>> got = halves.bodies();
    const Vec<D> mean = (got[1].velocity + got[2].velocity) / 2.0;
    EXPECT_LE(glm::length(mean - whole.bodies()[1].velocity), 1e-7) << i;
    for (std::size_t k : {1u, 2u}) {
      const Spin<D> missing = angular_velocity(got[k]) - angular_velocity(whole.bodies()[1]);
      EXPECT_LE(std::sqrt(dot(missing, missing)), 1e-7) << i;
    }
  }
}

TEST(JointedImpacts, HalvesBounceAsTheWhole) {
  halves_bounce_as_the_whole<2>();
  halves_bounce_as_the_whole<3>();
}

// Two bodies, pinned where they meet, whose ends strike at the same time, come back alike.
template <int D>
void what_strikes_at_both_ends_comes_back_alike(double e) {
  for (const ContactMethod method : kMethodsOfJointedImpacts) {
    World<D> world(weightless<D>(method));
    world.add(floor_at<D>(0, 0));
    for (const double side : {-1, 1}) {
      Vec<D> half(0.3);
      half.x = 1;
      Body<D> plank = plank_at<D>(along<D>(side, 0.7), half);
      plank.shape = Sphere{0.7};
      plank.velocity = up<D>(-3);
      plank.material = {e, 0};
      world.add(plank);
    }
    pin<D>(world, 1, 2, along<D>(1, 1), along<D>(-1, 1));
    const FullSystem<D> system(world);
    std::vector<std::vector<double>> rows;
    for (const BodyId id : {1, 2})
      rows.push_back(system.row(0, {}, id, world.find(id)->position - up<D>(0.7), up<D>(1)));
    const auto wanted = system.after(system.velocities(), rows, rows, {3 * e, 3 * e});
    world.step(kBlowStep);
    expect_velocities(world, wanted, "both ends");
  }
}

TEST(JointedImpacts, WhatStrikesAtBothEndsComesBackAlike) {
  for (const double e : {0.0, 0.5, 1.0}) {
    what_strikes_at_both_ends_comes_back_alike<2>(e);
    what_strikes_at_both_ends_comes_back_alike<3>(e);
  }
}

// A ball on a rod swings against a wall at any angle, and a pinned plank against a peg: both turn
// back with e times their spin.
template <int D>
void what_hangs_turns_back(ContactMethod method) {
  Random random(60 + D);
  for (int i = 0; i < 6; ++i) {
    const double e = i == 0 ? 1 : random.between(0.1, 1), spin = random.between(1, 4);
    World<D> world(weightless<D>(method));
    world.add(fixed_at<D>(Vec<D>(0.0)));
    Body<D> hung = ball_at<D>(up<D>(-2), along<D>(2 * spin), 0.3);
    hung.material = {e, 0};
    Body<D> other = floor_at<D>(0, 0);
    if (i % 2 == 0) {
      world.add(hung);
      rod<D>(world, 0, 1, 2);
      const double lean = random.between(0.3, 1.2), ahead = random.between(0.1, 0.3);
      const Vec<D> normal = along<D>(-std::cos(lean), std::sin(lean));
      other.shape = HalfSpace<D>{normal};
      other.position = along<D>(2 * std::sin(ahead), -2 * std::cos(ahead)) - normal * 0.3;
    } else {
      Vec<D> half(0.2);
      half.y = 1;
      Body<D> plank = plank_at<D>(up<D>(-1), half, random.between(0.5, 3));
      plank.material = hung.material;
      world.add(plank);
      pin<D>(world, 0, 1, Vec<D>(0.0), up<D>(1));
      world.set_velocity(1, along<D>(spin));
      if constexpr (D == 2)
        world.set_angular_velocity(1, spin);
      else
        world.set_angular_velocity(1, {0, 0, spin});
      other.shape = Sphere{0.3};
      other.position = along<D>(random.between(0.6, 0.8), random.between(-1.9, -0.5));
    }
    world.add(other);
    for (int k = 0; k < 60 && world.work().impacts_located == 0; ++k) world.step(kStep);
    const Body<D>& now = world.bodies()[1];
    EXPECT_EQ(world.work().impacts_located, 1u);
    const double turns =
        spin_component(cross(now.position, now.velocity), 2) / glm::dot(now.position, now.position);
    EXPECT_NEAR(turns, -e * spin, 1e-9) << to_string(method) << ' ' << i;
  }
}

TEST(JointedImpacts, WhatHangsTurnsBack) {
  for (const ContactMethod method : kMethodsOfJointedImpacts) {
    what_hangs_turns_back<2>(method);
    what_hangs_turns_back<3>(method);
  }
}

}  // namespace
}  // namespace lantern::physics
