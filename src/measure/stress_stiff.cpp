// Stiff springs, drag and chains, at steps far beyond what an explicit method bears.
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/random.hpp"
#include "measure/oscillator_world.hpp"
#include "measure/stress.hpp"
#include "measure/stress_scene.hpp"

namespace lantern {
namespace {

using namespace stress;

template <int D>
WorldConfig<D> config_of(Integrator method) {
  WorldConfig<D> config;
  config.integrator = method;
  config.contacts = ContactMethod::none;
  config.may_sleep = false;
  return config;
}

// k/m from 1e6 to 1e10 at 1/60 s: omega h from 17 to 1700. The largest relative gain of energy in
// any step of 10 s.
template <Integrator Method>
StressResult stiff_spring() {
  double worst = 0;
  std::string where;
  for (const double stiffness : {1e6, 1e7, 1e8, 1e9, 1e10})
    for (const double zeta : {0.0, 1e-6, 1.0, 1e3}) {
      World<2> world = oscillator_world(Method, std::sqrt(stiffness), zeta, 1, 0);
      const double gain = energy_gain(world, 600);
      if (gain > worst) where = fmt::format("worst at k/m {:g}, damping ratio {}", stiffness, zeta);
      worst = largest(worst, gain);
    }
  return at_most(1e-11, worst, "relative", where.empty() ? "no step gains any" : where);
}

// Drag c/m = 1e4 at 1/60 s, a hundred times beyond what explicit methods bear: a body thrown at
// 1 m/s never gets faster, and turns no more than its own speed about.
template <Integrator Method>
StressResult stiff_drag() {
  double fastest = 0;
  for (const double drag : {1e2, 1e3, 1e4}) {
    Body<3> body = make_ball<3>(Vec<3>(0.0));
    body.mass = 1;
    body.linear_drag = drag;
    body.velocity = {0.6, 0, 0.8};
    World<3> world = world_of<3>(config_of<3>(Method), {body});
    fastest = largest(fastest, worst_after_steps(world, 600, kStep, [&] {
                        return glm::length(world.bodies()[0].velocity);
                      }));
  }
  return at_most(1 + 1e-12, fastest, "x the start", "c/m 1e2, 1e3, 1e4");
}

// With gravity and drag c a body of mass 1 ends at the speed g/c, whatever the step.
StressResult terminal_speed() {
  double worst = 0;
  for (const auto method :
       {Integrator::implicit_euler, Integrator::implicit_midpoint, Integrator::velocity_verlet})
    for (const double drag : {10.0, 1e2, 1e4}) {
      WorldConfig<2> config = config_of<2>(method);
      config.gravity = {0, -kGravity};
      Body<2> body = make_ball<2>({0, 0});
      body.mass = 1;
      body.linear_drag = drag;
      World<2> world = world_of<2>(config, {body});
      run(world, 20);
      worst = largest(worst, std::abs(-world.bodies()[0].velocity.y * drag / kGravity - 1));
    }
  return at_most(1e-9, worst, "relative", "20 s after the start from rest, c/m 10, 1e2, 1e4");
}

// A chain of masses along the x axis, soft and hard springs by turns.
World<2> unequal_chain_of(int links, const WorldConfig<2>& config) {
  World<2> world(config);
  world.add(make_anchor<2>());
  for (int i = 1; i <= links; ++i) {
    Body<2> mass = make_ball<2>({0.1 * i, 0}, 0.05);
    mass.mass = 1;
    world.add(mass);
    Spring<2> spring;
    spring.a = static_cast<BodyId>(i - 1);
    spring.b = static_cast<BodyId>(i);
    spring.rest_length = 0.1;
    spring.stiffness = i % 2 == 0 ? 1e10 : 1e2;
    world.add_spring(spring);
  }
  return world;
}

// Its masses are thrown along it, so slowly that none passes another one: linear, with frequencies
// from 1 to 1e5. The largest gain of energy in 10 s.
template <Integrator Method>
StressResult unequal_chain() {
  World<2> world = unequal_chain_of(100, config_of<2>(Method));
  Random random(3);
  for (BodyId i = 1; i <= 100; ++i) world.set_velocity(i, {random.between(-0.01, 0.01), 0});
  // Places around 10 m are rounded by 1e-15, which k h turns into 1e-7 m/s a step.
  return at_most(1e-7, energy_gain(world, 600), "relative",
                 "energy gained in 10 s; 100 masses, k = 1e2 and 1e10");
}

// It falls from the level and swings: far from linear.
StressResult unequal_rope_of(int links) {
  WorldConfig<2> config = config_of<2>(Integrator::implicit_euler);
  config.gravity = {0, -kGravity};
  World<2> world = unequal_chain_of(links, config);
  const double scale = kGravity * 0.1 * links * (links + 1) / 2;  // J, of the whole fall
  double before = total_energy(world);
  const double worst = worst_after_steps(world, 60, kStep, [&] {
    const double after = total_energy(world);
    return (after - std::exchange(before, after)) / scale;
  });
  return at_most(1e-9, worst, "of m g l", fmt::format("most in a step of 1 s; {} masses", links));
}
StressResult unequal_rope() { return unequal_rope_of(100); }
StressResult long_unequal_rope() { return unequal_rope_of(1000); }

// Points chosen by chance and stiff springs between them, stretched and compressed by up to 1 %:
// the implicit method finds its step every time, and gains no energy.
StressResult stiff_nets() {
  Random random(7);
  double worst = 0;
  for (int round = 0; round < 20; ++round) {
    World<2> world(config_of<2>(Integrator::implicit_euler));
    const double stiffness = 100 * std::ldexp(1.0, static_cast<int>(random.whole(0, 26)));
    for (int i = 0; i < 12; ++i) {
      Body<2> mass = make_ball<2>({random.between(-1, 1), random.between(-1, 1)});
      mass.velocity = {random.between(-5, 5), 0};
      mass.mass = random.between(0.1, 2);
      if (i == 0) {
        mass.kind = BodyKind::static_body;
        mass.velocity = {0, 0};
      }
      world.add(mass);
    }
    for (BodyId i = 0; i < 12; ++i)
      for (BodyId j = i + 1; j < 12; ++j) {
        if (random.unit() >= 0.4) continue;
        Spring<2> spring;
        spring.a = i;
        spring.b = j;
        spring.rest_length = random.between(0.99, 1.01) *
                             glm::length(world.bodies()[j].position - world.bodies()[i].position);
        spring.stiffness = stiffness;
        spring.damping = round % 3 * 10.0;
        world.add_spring(spring);
      }
    worst = largest(worst, energy_gain(world, 20));
  }
  return at_most(1e-9, worst, "relative", "most above the start; 20 nets of 12 masses, k to 6.7e9");
}

// A bob on a spring of k/m = 1e8 in place of a rod, from 90 degrees: its length may not wander, nor
// its energy grow. An explicit method would need steps below 2e-4 s.
StressResult stiff_pendulum() {
  WorldConfig<2> config = with_gravity<2>();
  config.integrator = Integrator::implicit_euler;
  config.contacts = ContactMethod::none;
  World<2> world(config);
  world.add(make_anchor<2>());
  Body<2> bob = make_ball<2>({1, 0}, 0.1);
  bob.mass = 1;
  bob.may_turn = false;
  world.add(bob);
  Spring<2> rod;
  rod.b = 1;
  rod.rest_length = 1;
  rod.stiffness = 1e8;
  world.add_spring(rod);
  const double worst = worst_after_steps(
      world, 600, kStep, [&] { return std::abs(glm::length(world.bodies()[1].position) - 1); });
  return at_most(0.01, worst, "m", "the rod's length, 10 s at 1/60 s");
}

}  // namespace

void add_stiff_cases(std::vector<StressCase>& cases) {
  using enum Integrator;
  constexpr const char* kGroup = "stiff";
  constexpr const char* kSpring =
      "A spring of k/m = 1e6 ... 1e10 gains no energy at h = 1/60 s, at any damping.";
  constexpr const char* kDrag = "Drag of c/m = 1e4 at h = 1/60 s makes no body faster.";
  constexpr const char* kChain = "A chain of springs of ratio 1e8 gains no energy at h = 1/60 s.";
  constexpr const char* kRope =
      "A rope of springs of ratio 1e8 swings at h = 1/60 s and gains no energy.";
  cases.insert(
      cases.end(),
      {{"stiff_spring_implicit_midpoint", kGroup, kSpring, stiff_spring<implicit_midpoint>},
       {"stiff_spring_implicit_euler", kGroup, kSpring, stiff_spring<implicit_euler>},
       {"stiff_drag_velocity_verlet", kGroup, kDrag, stiff_drag<velocity_verlet>},
       {"stiff_drag_implicit_midpoint", kGroup, kDrag, stiff_drag<implicit_midpoint>},
       {"stiff_drag_implicit_euler", kGroup, kDrag, stiff_drag<implicit_euler>},
       {"terminal_speed", kGroup, "Gravity and drag end at the speed m g/c, at any drag.",
        terminal_speed},
       {"unequal_chain_implicit_midpoint", kGroup, kChain, unequal_chain<implicit_midpoint>},
       {"unequal_chain_implicit_euler", kGroup, kChain, unequal_chain<implicit_euler>},
       {"unequal_rope", kGroup, kRope, unequal_rope},
       {"unequal_rope_of_1000", kGroup, kRope, long_unequal_rope, true},
       {"stiff_nets", kGroup, "Nets of stiff springs find their implicit step and gain no energy.",
        stiff_nets},
       {"stiff_pendulum", kGroup, "A spring of k/m = 1e8 holds a pendulum's length like a rod.",
        stiff_pendulum}});
}

}  // namespace lantern
