// An error that is wanted of contacts: what it costs, and what it gives.
#include "physics/contact/quick_sweeps.hpp"

#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "physics/forces.hpp"
#include "physics/world.hpp"
#include "world_scene.hpp"

namespace lantern::physics {
namespace {

template <int D>
WorldConfig<D> quick(double wanted_error) {
  WorldConfig<D> config = falling<D>();
  config.wanted_error = wanted_error;
  config.may_sleep = false;
  return config;
}

// Boxes that fall askew between walls six units apart.
template <int D>
World<D> heap(const WorldConfig<D>& config, int count) {
  World<D> world(config);
  world.add(floor_at<D>());
  for (int axis = 0; axis < D; ++axis)
    for (const double side : {-1.0, 1.0}) {
      if (axis == 1) continue;
      Body<D> wall = floor_at<D>();
      Vec<D> normal(0.0), place(0.0);
      normal[axis] = -side;
      place[axis] = side * 3;
      wall.shape = HalfSpace<D>{normal};
      wall.position = place;
      world.add(wall);
    }
  std::mt19937 random(7);
  for (int i = 0; i < count; ++i) {
    Body<D> box = box_at<D>(along<D>(-2.2 + 1.3 * (i % 4) + 0.6 * (i / 4 % 2), 1 + 1.5 * (i / 4)));
    box.orientation = turned(box.orientation,
                             1e-10 * static_cast<double>(random()) * unit_spin<D>(D == 2 ? 0 : 2));
    world.add(box);
  }
  return world;
}

template <int D>
double mean_depth(const World<D>& world) {
  double sum = 0;
  int points = 0;
  for (const Contact<D>& contact : world.contacts())
    for (const ManifoldPoint<D>& point : contact.manifold.points()) {
      sum += std::max(0.0, -point.separation);
      ++points;
    }
  return sum / points;
}

template <int D>
double fastest(const World<D>& world) {
  double speed = 0;
  for (const Body<D>& body : world.bodies()) speed = std::max(speed, glm::length(body.velocity));
  return speed;
}

// Over the whole run.
template <int D>
double worst_mean_depth(World<D>& world, double seconds) {
  double depth = 0;
  for (int i = 0; i < seconds / kStep; ++i) {
    world.step(kStep);
    if (!world.contacts().empty()) depth = std::max(depth, mean_depth(world));
  }
  return depth;
}

template <int D>
void from_quick_to_exact(int count, double seconds) {
  double depth = 1;
  std::uint64_t rows = 0;
  for (const double error : {1e-1, 1e-2, 1e-3}) {
    World<D> world = heap<D>(quick<D>(error), count);
    const double found = worst_mean_depth(world, seconds);
    EXPECT_LT(found, depth) << error;
    EXPECT_LT(found, error) << error;
    const WorldWork& work = world.work();
    EXPECT_GT(work.constraint_rows, rows) << error;
    // Each sweep looks at a point's normal, and then at D - 1 tangents, if anything presses.
    EXPECT_GT(work.friction_rows, 0u) << error;
    EXPECT_LE(work.friction_rows, (D - 1) * work.normal_rows) << error;
    depth = found;
    rows = world.work().constraint_rows;
  }
}

TEST(WantedError, GoesFromQuickToExactIn2D) { from_quick_to_exact<2>(40, 1.5); }
TEST(WantedError, GoesFromQuickToExactIn3D) { from_quick_to_exact<3>(24, 0.8); }

TEST(WantedError, WhatIsExactComesToRest) {
  World<2> world = heap<2>(quick<2>(1e-6), 12);
  run(world, 6);
  EXPECT_LT(fastest(world), 1e-6);
}

template <int D>
void no_energy_is_made(int boxes) {
  for (const double error : {0.3, 1e-2, 1e-3}) {
    World<D> world = heap<D>(quick<D>(error), boxes);
    const auto energy_of = [&] {
      const Energy sum = energy<D>(world.bodies(), world.forces());
      return sum.linear + sum.rotational + sum.gravity;
    };
    const double before = energy_of();
    for (int i = 0; i < 120; ++i) {
      world.step(kStep);
      EXPECT_LT(energy_of(), before * (1 + 1e-9));
    }
  }
}

TEST(WantedError, MakesNoEnergyIn2D) { no_energy_is_made<2>(28); }
TEST(WantedError, MakesNoEnergyIn3D) { no_energy_is_made<3>(24); }

// What is kept for its memory remembers nothing.
TEST(WantedError, KnowsNothingOfOtherWorlds) {
  World<2> alone = heap<2>(quick<2>(1e-2), 20);
  run(alone, 1);
  World<2> beside = heap<2>(quick<2>(1e-2), 20), larger = heap<2>(quick<2>(1e-3), 36);
  for (int i = 0; i < 1 / kStep; ++i) {
    beside.step(kStep);
    larger.step(kStep);
  }
  EXPECT_EQ(beside.hash(), alone.hash());
}

TEST(WantedError, IsTheSameWhateverTheBroadPhase) {
  std::optional<std::uint64_t> hash;
  for (const StructureKind kind :
       {StructureKind::brute_force, StructureKind::quadtree, StructureKind::sort_and_sweep}) {
    WorldConfig<2> config = quick<2>(1e-2);
    config.broad_phase.kind = kind;
    World<2> world = heap<2>(config, 20);
    run(world, 2);
    EXPECT_EQ(world.hash(), hash.value_or(world.hash()));
    hash = world.hash();
  }
}

TEST(WantedError, LeavesSmallIslandsToTheExactSolve) {
  const auto run_of = [](double error) {
    World<2> world(quick<2>(error));
    world.add(floor_at<2>());
    for (int i = 0; i < 4; ++i) world.add(box_at<2>(along<2>(0, 0.5 + i)));
    run(world, 1);
    return world.hash();
  };
  EXPECT_EQ(run_of(1e-2), run_of(0));
}

// Groups of contacts of four bodies each, with numbers by chance; the last lane is nobody's.
template <int D>
struct Swept {
  std::vector<QuickGroup<D>> groups{3};
  std::vector<QuickBody<D>> bodies{std::size_t{8 * 3 + 1}};
  QuickSweep sweep{true, 0.3, {}, {}, 0};
  QuickWork work{};

  explicit Swept(unsigned seed) {
    std::mt19937 random(seed);
    const auto chance = [&](double lo, double hi) {
      return std::uniform_real_distribution<double>(lo, hi)(random);
    };
    const auto fill = [&](auto&& fours, double lo, double hi) {
      for (Four& four : fours)
        for (std::size_t i = 0; i + 1 < kQuickLanes; ++i) four.lane[i] = chance(lo, hi);
    };
    const auto fill_one = [&](Four& four, double lo, double hi) {
      fill(std::span(&four, 1), lo, hi);
    };
    const auto fill_impulse = [&](QuickImpulse& impulse, double lo) {
      for (Four* four : {&impulse.now, &impulse.way}) fill_one(*four, lo, 1);
    };
    for (std::size_t g = 0; g < groups.size(); ++g) {
      QuickGroup<D>& group = groups[g];
      group.points = 1 + random() % QuickGroup<D>::kMostPoints;
      for (std::uint32_t i = 0; i < kQuickLanes; ++i) {
        group.a[i] = i < 3 ? static_cast<std::uint32_t>(8 * g) + i : 24;
        group.b[i] = i < 3 ? static_cast<std::uint32_t>(8 * g + 4) + i : 24;
      }
      group.friction = group.inverse_mass_a = group.inverse_mass_b = {};
      group.inertia_a = group.inertia_b = {};
      group.normal = {};
      group.across = {};
      group.rubs = g != 0;
      if (group.rubs) fill_one(group.friction, 0, 1);
      fill(group.inertia_a, 0.5, 2);
      fill(group.inertia_b, 0.5, 2);
      fill_one(group.inverse_mass_a, 0.5, 2);
      fill_one(group.inverse_mass_b, 0.5, 2);
      fill(group.normal, -1, 1);
      for (auto& across : group.across) fill(across, -1, 1);
      for (QuickPoint<D>& point : group.room) {
        point = {};
        fill(point.arm_a, -1, 1);
        fill(point.arm_b, -1, 1);
        fill_one(point.normal_mass, 0.2, 1);
        fill_one(point.tangent_mass, 0.2, 1);
        fill_one(point.bias, -1, 1);
        fill_one(point.wanted_push, 0, 1);
        fill_impulse(point.pn, 0);
        for (auto& impulse : point.pt) fill_impulse(impulse, -1);
      }
    }
    for (QuickBody<D>& body : bodies)
      for (double& number : body.motion) number = chance(-1, 1);
  }

  bool has_bits_of(const Swept& other) const {
    const auto alike = [](const auto& x, const auto& y) {
      return std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
    };
    const auto alike_four = [&](const Four& x, const Four& y) { return alike(x.lane, y.lane); };
    bool same = alike(bodies, other.bodies) && alike_four(sweep.largest, other.sweep.largest) &&
                alike_four(sweep.squared, other.sweep.squared) &&
                sweep.friction_rows == other.sweep.friction_rows &&
                alike_four(work.before, other.work.before) &&
                alike_four(work.after, other.work.after) &&
                alike_four(work.wanted, other.work.wanted);
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (std::size_t i = 0; i < groups[g].points; ++i) {
        const QuickPoint<D>&x = groups[g].room[i], &y = other.groups[g].room[i];
        same = same && alike_four(x.push, y.push) && alike_four(x.pn.now, y.pn.now) &&
               alike_four(x.pn.way, y.pn.way) && alike_four(x.pt[0].now, y.pt[0].now);
      }
    return same;
  }
};

template <int D>
void same_on_every_processor() {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::vector<Swept<D>> swept;
    for (const QuickVectors<D>& vectors : quick_vectors<D>()) {
      swept.emplace_back(seed);
      Swept<D>& now = swept.back();
      vectors.sweep(now.groups, now.bodies.data(), now.sweep);
      vectors.work(now.groups, now.bodies.data(), now.work);
      EXPECT_FALSE(now.has_bits_of(Swept<D>(seed)));
      EXPECT_TRUE(now.has_bits_of(swept.front())) << seed << ", " << swept.size();
    }
  }
}

TEST(QuickVectors, FindTheSameOnEveryProcessor) {
  same_on_every_processor<2>();
  same_on_every_processor<3>();
}

// One contact of a group, by what each number means.
template <int D>
struct PlainContact {
  const QuickGroup<D>& group;
  std::size_t lane;
  std::array<SolverBody<D>, 2> bodies = {}, pushed = {};

  Vec<D> vector(const std::array<Four, D>& fours) const {
    Vec<D> v;
    for (int i = 0; i < D; ++i) v[i] = fours[static_cast<std::size_t>(i)].lane[lane];
    return v;
  }
  static SolverBody<D> body(const QuickBody<D>& from, std::size_t at) {
    SolverBody<D> body;
    for (std::size_t i = 0; i < D; ++i) body.velocity[static_cast<int>(i)] = from.motion[at + i];
    for (std::size_t i = 0; i < QuickBody<D>::kSpin; ++i)
      spin_component(body.spin, static_cast<int>(i)) = from.motion[at + D + i];
    return body;
  }
  void resist(SolverBody<D>& body, const Four& mass,
              const std::array<Four, QuickBody<D>::kInertia>& inertia) const {
    body.inverse_mass = mass.lane[lane];
    const auto at = [&](std::size_t i) { return inertia[i].lane[lane]; };
    if constexpr (D == 2)
      body.inverse_inertia = at(0);
    else
      body.inverse_inertia = Mat<3>(Vec<3>(at(0), at(3), at(4)), Vec<3>(at(3), at(1), at(5)),
                                    Vec<3>(at(4), at(5), at(2)));
  }
  PlainContact(const QuickGroup<D>& g, std::size_t l, const std::vector<QuickBody<D>>& all)
      : group(g), lane(l) {
    for (auto* both : {&bodies, &pushed}) {
      const std::size_t from = both == &bodies ? 0 : QuickBody<D>::kPushed;
      *both = {body(all[group.a[lane]], from), body(all[group.b[lane]], from)};
      resist((*both)[0], group.inverse_mass_a, group.inertia_a);
      resist((*both)[1], group.inverse_mass_b, group.inertia_b);
    }
  }
  Vec<D> slip(const std::array<SolverBody<D>, 2>& of, const QuickPoint<D>& p) const {
    return relative_velocity(of[0], vector(p.arm_a), of[1], vector(p.arm_b));
  }
  void apply(std::array<SolverBody<D>, 2>& to, const QuickPoint<D>& p, const Vec<D>& impulse) {
    to[0].apply(-impulse, vector(p.arm_a));
    to[1].apply(impulse, vector(p.arm_b));
  }

  // As ContactRows solves them; returns the impulses.
  std::vector<double> sweep() {
    std::vector<double> impulses;
    const Vec<D> normal = vector(group.normal);
    std::vector<double> presses;
    for (std::size_t i = 0; i < group.points; ++i) {
      const QuickPoint<D>& p = group.room[i];
      const double mass = p.normal_mass.lane[lane], old = p.pn.now.lane[lane];
      const double speed = glm::dot(slip(bodies, p), normal);
      const double apart = glm::dot(slip(pushed, p), normal);
      const double pn = std::max(old + (p.bias.lane[lane] - speed) * mass, 0.0);
      const double before = p.push.lane[lane];
      const double push = std::max(before + (p.wanted_push.lane[lane] - apart) * mass, -pn);
      apply(bodies, p, normal * (pn - old));
      apply(pushed, p, normal * (push - before));
      presses.push_back(pn);
      impulses.insert(impulses.end(), {pn, push});
    }
    for (std::size_t i = 0; group.rubs && i < group.points; ++i) {
      const QuickPoint<D>& p = group.room[i];
      const double mass = p.tangent_mass.lane[lane];
      const double most = group.friction.lane[lane] * presses[i];
      const Vec<D> now = slip(bodies, p), now_pushed = slip(pushed, p);
      std::array<double, D - 1> wanted{};
      double square = 0;
      for (std::size_t k = 0; k < D - 1; ++k) {
        wanted[k] = p.pt[k].now.lane[lane] - glm::dot(now, vector(group.across[k])) * mass;
        square += wanted[k] * wanted[k];
      }
      const double share = std::min(1.0, most / std::sqrt(square));
      for (std::size_t k = 0; k < D - 1; ++k) {
        const Vec<D> along = vector(group.across[k]);
        apply(bodies, p, along * (wanted[k] * share - p.pt[k].now.lane[lane]));
        if (share == 1) apply(pushed, p, -along * (glm::dot(now_pushed, along) * mass));
        impulses.push_back(wanted[k] * share);
      }
    }
    return impulses;
  }
};

template <int D>
void solves_as_rows_do() {
  for (unsigned seed = 0; seed < 50; ++seed) {
    Swept<D> swept(seed);
    swept.sweep.goes_on = false;
    const Swept<D> before = swept;
    quick_vectors<D>().front().sweep(swept.groups, swept.bodies.data(), swept.sweep);
    for (std::size_t g = 0; g < before.groups.size(); ++g)
      for (std::size_t lane = 0; lane + 1 < kQuickLanes; ++lane) {
        const QuickGroup<D>& group = swept.groups[g];
        PlainContact<D> plain(before.groups[g], lane, before.bodies);
        const std::vector<double> impulses = plain.sweep();
        auto impulse = impulses.begin();
        for (std::size_t i = 0; i < group.points; ++i) {
          EXPECT_NEAR(group.room[i].pn.now.lane[lane], *impulse++, 1e-12);
          EXPECT_NEAR(group.room[i].push.lane[lane], *impulse++, 1e-12);
        }
        for (std::size_t i = 0; group.rubs && i < group.points; ++i)
          for (std::size_t k = 0; k < D - 1; ++k)
            EXPECT_NEAR(group.room[i].pt[k].now.lane[lane], *impulse++, 1e-12);
        const PlainContact<D> found(group, lane, swept.bodies);
        for (std::size_t i = 0; i < 2; ++i)
          for (const auto& [x, y] : {std::pair(plain.bodies[i], found.bodies[i]),
                                     std::pair(plain.pushed[i], found.pushed[i])}) {
            EXPECT_LT(glm::length(x.velocity - y.velocity), 1e-11);
            EXPECT_LT(std::sqrt(dot(x.spin - y.spin, x.spin - y.spin)), 1e-11);
          }
      }
  }
}

TEST(QuickVectors, SolveContactsAsRowsDo) {
  solves_as_rows_do<2>();
  solves_as_rows_do<3>();
}

TEST(QuickOrder, LeadsEachBodyFromAboveDown) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const auto bodies = static_cast<std::uint32_t>(2 + random() % 40);
    struct Told {
      std::uint32_t a, b;
      double height;
    };
    std::vector<Told> contacts(random() % 200);
    const auto moving = [](std::uint32_t body) {
      return body % 5 != 0 ? body : QuickOrder::kFixed;
    };
    QuickOrder order;
    order.clear(bodies);
    for (Told& contact : contacts) {
      const auto a = static_cast<std::uint32_t>(random() % bodies);
      const auto b = static_cast<std::uint32_t>((a + 1 + random() % (bodies - 1)) % bodies);
      contact = {moving(a), moving(b), static_cast<double>(random() % 8)};
      order.add(contact.a, contact.b, 1 + static_cast<int>(random() % 4), contact.height, 0);
    }
    Scratch<std::uint32_t> places;
    const std::size_t groups = order.arrange(places);
    ASSERT_EQ(places.size(), contacts.size());
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      EXPECT_LT(places[i], groups * kQuickLanes);
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_NE(places[i], places[j]);
        const bool below = contacts[i].height <= contacts[j].height;  // else it comes first
        for (const std::uint32_t body : {contacts[i].a, contacts[i].b}) {
          if (body == QuickOrder::kFixed || (contacts[j].a != body && contacts[j].b != body))
            continue;
          const std::uint32_t first = places[below ? j : i], then = places[below ? i : j];
          EXPECT_LT(first / kQuickLanes, then / kQuickLanes);
        }
      }
    }
  }
}

TEST(QuickOrder, KnowsTheHighestStack) {
  QuickOrder order;
  order.clear(6);
  Scratch<std::uint32_t> places;
  order.add(0, QuickOrder::kFixed, 2, 0.5, 1);  // 2 upon 1 upon 0
  order.add(0, 1, 2, 1, -1);
  order.add(2, 1, 2, 2, 0.9);
  order.add(3, QuickOrder::kFixed, 2, 0.5, 1);  // 4 upon 3, beside them
  order.add(4, 3, 2, 1, 1);
  order.add(1, 4, 2, 1.5, 0.1);
  order.arrange(places);
  EXPECT_EQ(order.highest_stack(), 3u);
}

// Boxes in columns of twenty, each a little above the next, numbered from below or from above.
template <int D>
World<D> columns(bool from_above, double shift) {
  constexpr int kHigh = 20, kWide = 3;
  World<D> world(quick<D>(1e-2));
  world.add(floor_at<D>());
  for (int i = 0; i < kHigh * kWide; ++i) {
    const int row = from_above ? kHigh - 1 - i / kWide : i / kWide;
    world.add(
        box_at<D>(along<D>(1.01 * (i % kWide) + shift * std::sin(7.0 * row), 0.52 + 1.02 * row)));
  }
  return world;
}

// Loads come down in one sweep, whatever the numbers of the bodies.
template <int D>
void columns_stand(std::initializer_list<double> shifts) {
  for (const double shift : shifts) {
    World<D> up = columns<D>(false, shift), down = columns<D>(true, shift);
    const double depth = worst_mean_depth(up, 1);
    EXPECT_LT(depth, 1.5e-3) << shift;
    EXPECT_NEAR(worst_mean_depth(down, 1), depth, 0.03 * depth) << shift;
  }
}

TEST(WantedError, HighColumnsStandWhateverTheirNumbersIn2D) { columns_stand<2>({0, 0.02, 0.05}); }
TEST(WantedError, HighColumnsStandWhateverTheirNumbersIn3D) { columns_stand<3>({0.03}); }

TEST(WantedError, IsRefusedIfItIsNone) {
  for (const double error :
       {-1e-3, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(World<2>(quick<2>(error)), Refused);
}

}  // namespace
}  // namespace lantern::physics
