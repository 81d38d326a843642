// Impacts and friction against closed forms that no scenario's `expect` can say.
#include <numbers>
#include <set>

#include "base/random.hpp"
#include "measure/stress_scene.hpp"

namespace lantern::measure {
namespace {

using namespace stress;

template <int D>
WorldConfig<D> flight_rules(double gravity) {
  return {.gravity = at<D>(0, -gravity), .integrator = Integrator::velocity_verlet};
}

// A ball that loses nothing, 20 s at several steps: the largest relative change of its energy.
template <int D>
double bounce_drift(double h) {
  Body<D> ball = make_ball<D>(at<D>(0, 2));
  ball.material.restitution = 1;
  World<D> world = world_of<D>(flight_rules<D>(kGravity), {make_floor<D>(), ball});
  const auto energy = [&] {
    const Body<D>& b = world.bodies()[1];
    return kGravity * (b.position.y - 0.5) + glm::dot(b.velocity, b.velocity) / 2;
  };
  const double before = energy();
  return worst_after_steps(world, static_cast<int>(std::lround(20 / h)), h,
                           [&] { return std::abs(energy() / before - 1); });
}

template <int D>
double elastic_bounce() {
  return worst_over({1e-3, 0.01, 1.0 / 60, 0.1, 0.3, 1.0, 3.0}, bounce_drift<D>);
}

// Galperin, "Playing pool with pi" (2003): two blocks of mass ratio 100^k and a wall meet
// floor(pi 10^k) times.
double pi_by_blocks() {
  double worst = 0, ratio = 1, expected = std::numbers::pi;
  for (int k = 0; k <= 3; ++k, ratio *= 100, expected *= 10) {
    World<2> world(flight_rules<2>(0));
    Body<2> wall = make_floor<2>();
    wall.shape = HalfSpace<2>{{1, 0}};
    world.add(wall);
    const Shape<2> block = AxisBox<2>{{0.5, 0.5}};
    world.add({.name = "light", .shape = block, .position = {2, 0}, .mass = 1, .material = {1, 0}});
    world.add({.name = "heavy",
               .shape = block,
               .position = {4, 0},
               .velocity = {-1, 0},
               .mass = ratio,
               .material = {1, 0}});
    run(world, 12);
    worst = largest(
        worst, std::abs(static_cast<double>(world.work().impacts_located) - std::floor(expected)));
  }
  return worst;
}

// --- friction ---

// How far from v^2/(2 mu g) a box stops that is thrown along the floor in direction `heading`.
template <int D>
double sliding_error(double mu, double speed, double heading) {
  Body<D> box = make_box<D>(at<D>(0, 0.5));
  box.material.friction = mu;
  box.may_turn = false;
  Vec<D> way = at<D>(1);
  if constexpr (D == 3) way = {std::cos(heading), 0, std::sin(heading)};
  box.velocity = way * speed;
  World<D> world = world_of<D>(with_gravity<D>(), {make_floor<D>(0, mu), box});
  run(world, speed / (mu * kGravity) + 0.5);
  const Vec<D> end = world.bodies()[1].position - at<D>(0, 0.5);
  return glm::length(end - way * (speed * speed / (2 * mu * kGravity)));
}

template <int D>
double sliding() {
  return worst_over({0.1, 0.5, 1.0, 10.0}, [](double mu) { return sliding_error<D>(mu, 5, 0); });
}

// The friction is a cone, not a pyramid: no heading is better than another.
double headings() {
  double worst = 0;
  for (int i = 0; i < 24; ++i)
    worst = largest(worst, sliding_error<3>(0.5, 3, 2 * std::numbers::pi * i / 24));
  return worst;
}

// --- free motion at 1 ms, 10 s ---

constexpr double kFine = 1e-3;

// 500 m down: how far from the parabola, worst over the fall.
template <int D>
double misses_parabola() {
  World<D> world =
      world_of<D>({.gravity = at<D>(0, -kGravity), .integrator = Integrator::velocity_verlet},
                  {make_box<D>(Vec<D>(0.0))});
  int steps = 0;
  return worst_after_steps(world, 10000, kFine, [&] {
    const double t = ++steps * kFine;
    return std::abs(world.bodies()[0].position.y + kGravity * t * t / 2);
  });
}

World<3> thrown_box(const Vec<3>& half_size, const Vec<3>& spin) {
  World<3> world((WorldConfig<3>()));
  world.set_angular_velocity(world.add(make_body<3>(OrientedBox<3>{half_size}, Vec<3>(0.0), "box")),
                             spin);
  return world;
}

const Vec<3> kBrick{0.5, 2, 4.5};  // 1 x 4 x 9, thrown almost about its middle axis
const Vec<3> kThrow{0.1, 5, 0.1};

double torque_free_momentum() {
  World<3> world = thrown_box(kBrick, kThrow);
  const Vec<3> before = world.bodies()[0].angular_momentum;
  return worst_after_steps(world, 10000, kFine, [&] {
    return glm::length(world.bodies()[0].angular_momentum - before) / glm::length(before);
  });
}

double energy_drift(const Vec<3>& half_size, const Vec<3>& spin) {
  World<3> world = thrown_box(half_size, spin);
  return energy_change(world, 10000, kFine);
}
double torque_free_energy() { return energy_drift(kBrick, kThrow); }
double needle_energy() { return energy_drift({1e-2, 1e-2, 1}, {0.3, 1, 20}); }

// --- stacks ---

struct Pile {
  double depth = 0;  // the deepest penetration over the run, m
  double moved = 0;  // the farthest that a box is from its place at the end, m
};

template <int D>
Pile pile_of(int count, double top_density = 1) {
  World<D> world({.gravity = at<D>(0, -kGravity), .sub_steps = 16, .may_sleep = false});
  world.add(make_floor<D>());
  for (int i = 0; i < count; ++i) {
    Body<D> box = make_box<D>(at<D>(0, 0.5 + i));
    if (i + 1 == count) box.density = top_density;
    world.add(box);
  }
  Pile pile;
  pile.depth = worst_after_steps(world, 600, kStep, [&] { return deepest(world); });
  for (int i = 0; i < count; ++i)
    pile.moved = largest(
        pile.moved,
        glm::length(world.bodies()[static_cast<std::size_t>(i + 1)].position - at<D>(0, 0.5 + i)));
  return pile;
}

std::string told(const Pile& pile) {
  return fmt::format("deepest {:.1e} m, moved {:.1e} m", pile.depth, pile.moved);
}

template <int D, int Count>
StressResult stack_of() {
  const Pile pile = pile_of<D>(Count);
  return at_most(5e-8, largest(pile.depth, pile.moved), "m", told(pile) + "; 16 sub-steps");
}
StressResult stack_of_100() {
  const Pile pile = pile_of<2>(100);
  return at_most(1e-8, pile.moved, "m", told(pile) + "; 16 sub-steps");
}

template <int D, int Decades>
StressResult heavy_on_light() {
  const Pile pile = pile_of<D>(2, std::pow(10.0, Decades));
  return at_most(1e-8, largest(pile.depth, pile.moved), "m",
                 fmt::format("{}; 1e{} : 1", told(pile), Decades));
}

// --- chains ---

// The widest that a joint of ten links with a heavy end opens, from the level fall on; 10 s.
template <int D>
double chain_stretch(JointKind kind, double ratio, int sub_steps = 16) {
  World<D> world({.gravity = at<D>(0, -kGravity), .sub_steps = sub_steps, .may_sleep = false});
  world.add(make_anchor<D>());
  for (int i = 0; i < 10; ++i) {
    Body<D> link = make_ball<D>(at<D>(i + 1), 0.2);
    link.mass = i == 9 ? ratio : 1;
    world.add(link);
    world.add_joint({.kind = kind,
                     .a = static_cast<BodyId>(i),
                     .b = static_cast<BodyId>(i + 1),
                     .at_b = at<D>(kind == JointKind::pin ? -1 : 0),
                     .length = 1});
  }
  return worst_after_steps(world, 600, kStep, [&] { return widest_gap(world); });
}

template <JointKind Kind>
StressResult heavy_chain() {
  const double flat = chain_stretch<2>(Kind, 1000), solid = chain_stretch<3>(Kind, 1000);
  return at_most(1e-12, largest(flat, solid), "m",
                 fmt::format("2D {:.1e} m, 3D {:.1e} m; ten links, 1000 : 1", flat, solid));
}

// A light link between taut rods swings across them with omega = 2 sqrt(tension / (m l)); rods
// push where they began the sub-step, so that omega h must stay below 2. For 1e6 : 1 and three
// times the weight at the bottom of the swing, omega is 11000: 64 sub-steps are too few.
double heaviest_chain() { return chain_stretch<2>(JointKind::distance, 1e6, 256); }

// --- determinism ---

template <int D>
std::uint64_t crowd_hash(StructureKind kind) {
  WorldConfig<D> config = with_gravity<D>();
  config.broad_phase.kind = kind;
  World<D> world(config);
  Random random(7);
  world.add(make_floor<D>());
  for (int i = 0; i < 24; ++i) {
    const Vec<D> place = at<D>(i % 4 * 1.1 + random.between(0, 0.2), 1 + i / 4 * 1.2);
    Body<D> body = i % 3 == 0 ? make_ball<D>(place) : make_box<D>(place);
    body.material.restitution = i % 5 == 0 ? 0.4 : 0;
    body.velocity.x = random.between(-2, 2);
    world.add(body);
  }
  run(world, 1);
  return world.hash();
}

template <int D>
StressResult one_hash() {
  std::set<std::uint64_t> hashes;
  const auto kinds = broad_phases_of<D>();
  for (const StructureKind kind : kinds) hashes.insert(crowd_hash<D>(kind));
  return at_most(1, static_cast<double>(hashes.size()), "hashes",
                 fmt::format("over {} broad phases, 24 bodies thrown, 1 s", kinds.size()));
}

}  // namespace

std::vector<StressCase> contact_cases() {
  constexpr const char* kGroup = "extreme input";
  return {
      {"elastic_bounce", "bars", "A ball that loses nothing keeps its energy at any step.",
       none_above(1e-12, "relative", "20 s, 2D and 3D, steps from 1 ms to 3 s", elastic_bounce<2>,
                  elastic_bounce<3>)},
      {"pi_by_blocks", kGroup, "Two blocks of mass ratio 1e6 and a wall count the digits of pi.",
       none_above(0, "impacts", "off floor(pi 10^k), k = 0 ... 3: 3, 31, 314, 3141", pi_by_blocks)},
      {"sliding", "bars", "A box thrown along the floor stops after v^2/(2 mu g).",
       none_above(2e-11, "m", "5 m/s, friction 0.1, 0.5, 1, 10; 2D and 3D", sliding<2>, sliding<3>)},
      {"headings", "bars", "A box slides equally far in every direction.",
       none_above(5e-13, "m", "24 headings, 3 m/s, friction 0.5", headings)}};
}

// The bars: 1 m boxes, g = 10, h = 1/60 s, 10 s unless said.

std::vector<StressCase> bar_cases() {
  constexpr const char* kGroup = "bars";
  constexpr const char* kOne = "A world's hash is the same over every broad phase.";
  constexpr const char* kHeavy = "A box of ten thousand times the mass rests on a light one.";
  constexpr const char* kBox = "the box of 1 x 4 x 9, 10 s at 1 ms";
  return {
      {"free_fall", kGroup, "A box in free fall stays on the parabola.",
       none_above(1e-10, "m", "2D and 3D, 10 s at 1 ms", misses_parabola<2>, misses_parabola<3>)},
      {"torque_free_momentum", kGroup, "A tumbling box keeps its angular momentum.",
       none_above(1e-12, "relative", kBox, torque_free_momentum)},
      {"torque_free_energy", kGroup, "A tumbling box keeps its energy.",
       none_above(5e-13, "relative", kBox, torque_free_energy)},
      {"needle_energy", kGroup, "A spinning needle keeps its energy.",
       none_above(1e-11, "relative", "1 : 100, nearly no inertia about its axis, 10 s at 1 ms",
                  needle_energy)},
      {"stack_of_60", kGroup, "A stack of 60 boxes stands, in 2D.", stack_of<2, 60>},
      {"stack_of_10_solid", kGroup, "A stack of 10 boxes stands, in 3D.", stack_of<3, 10>},
      {"stack_of_60_solid", kGroup, "A stack of 60 boxes stands, in 3D.", stack_of<3, 60>, true},
      {"stack_of_100", kGroup, "A stack of 100 boxes stands.", stack_of_100},
      {"heavy_on_light", kGroup, kHeavy, heavy_on_light<2, 4>},
      {"heavy_on_light_solid", kGroup, kHeavy, heavy_on_light<3, 4>},
      {"heaviest_on_light", kGroup, "A box of a million times the mass rests on a light one.",
       heavy_on_light<2, 6>},
      {"chain_of_rods", kGroup, "A chain of rods holds an end of a thousand times its mass.",
       heavy_chain<JointKind::distance>},
      {"chain_of_pins", kGroup, "A chain of hinges holds an end of a thousand times its mass.",
       heavy_chain<JointKind::pin>},
      {"heaviest_chain", kGroup, "A chain of rods holds an end of a million times its mass.",
       none_above(1e-12, "m", "widest gap of a rod; ten links, 1e6 : 1, 256 sub-steps",
                  heaviest_chain)},
      {"one_hash_2d", kGroup, kOne, one_hash<2>},
      {"one_hash_3d", kGroup, kOne, one_hash<3>}};
}

}  // namespace lantern::measure
