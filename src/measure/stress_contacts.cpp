// Impacts against closed forms that no scenario's `expect` can say, and what no broad phase
// changes.
#include <numbers>
#include <set>

#include "measure/stress_scenes.hpp"

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

// --- determinism ---

// Two heaps, far from each other.
template <int D>
StressResult one_hash() {
  Scene<D> heaps = beside_itself(
      SceneOf<D>(SceneKind::heap, ContactMethod::soft, Integrator::semi_implicit_euler).scene());
  std::set<std::uint64_t> hashes;
  const auto kinds = broad_phases_of<D>();
  for (const StructureKind kind : kinds) {
    heaps.config.broad_phase.kind = kind;
    hashes.insert(after(heaps).hash());
  }
  return at_most(1, static_cast<double>(hashes.size()), "hashes",
                 fmt::format("over {} broad phases, two heaps, 0.5 s", kinds.size()));
}

}  // namespace

std::vector<StressCase> contact_cases() {
  constexpr const char* kOne = "A world's hash is the same over every broad phase.";
  return {
      {"elastic_bounce", "bars", "A ball that loses nothing keeps its energy at any step.",
       none_above(1e-11, "relative", "20 s, 2D and 3D, steps from 1 ms to 3 s", elastic_bounce<2>,
                  elastic_bounce<3>)},
      {"pi_by_blocks", "extreme input",
       "Two blocks of mass ratio 1e6 and a wall count the digits of pi.",
       none_above(0, "impacts", "off floor(pi 10^k), k = 0 ... 3: 3, 31, 314, 3141", pi_by_blocks)},
      {"one_hash_2d", "bars", kOne, one_hash<2>},
      {"one_hash_3d", "bars", kOne, one_hash<3>}};
}

}  // namespace lantern::measure
