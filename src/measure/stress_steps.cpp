// Steps of every length, and numbers that overflow.

#include "base/random.hpp"
#include "measure/stress_scene.hpp"

namespace lantern::measure {
namespace {

using namespace stress;

// Two boxes at rest on the floor.
template <int D>
World<D> resting(Integrator method = Integrator::semi_implicit_euler) {
  World<D> world =
      world_of<D>({.gravity = at<D>(0, -kGravity), .integrator = method},
                  {make_floor<D>(), make_box<D>(at<D>(0, 0.5)), make_box<D>(at<D>(0, 1.5))});
  run(world, 0.1);
  return world;
}

template <int D>
int changed_by_no_time() {
  int changed = 0;
  for (const Integrator method : kIntegrators) {
    World<D> world = resting<D>(method);
    const std::uint64_t before = world.hash();
    world.step(0);
    changed += world.hash() != before;
  }
  return changed;
}

StressResult step_zero() {
  return at_most(0, changed_by_no_time<2>() + changed_by_no_time<3>(), "worlds",
                 "changed, of 12: every method, 2D and 3D");
}

template <int D>
int bad_steps_taken(int& tried) {
  int taken = 0;
  World<D> world = resting<D>();
  const std::uint64_t before = world.hash();
  for (const double h : {-1e-300, -1e-12, -1.0 / 60, -1e3, kNan, kInfinity, -kInfinity}) {
    const auto why = refusal([&] { world.step(h); });
    ++tried;
    taken += !why || why->find("time step") == std::string::npos || world.hash() != before;
  }
  return taken;
}

// How far what rests is from its place after steps of `h`; endless if anything is not finite. A
// step that is refused must name body and step.
template <int D>
double rest_error(Integrator method, double h, int steps) {
  World<D> world = resting<D>(method);
  const auto why = refusal([&] {
    for (int i = 0; i < steps; ++i) world.step(h);
  });
  const bool told =
      !why || (why->find("'") != std::string::npos && why->find("step") != std::string::npos);
  if (!told || !is_finite(world)) return kInfinity;
  return largest(glm::length(world.bodies()[1].position - at<D>(0, 0.5)),
                 glm::length(world.bodies()[2].position - at<D>(0, 1.5)));
}

double worst_rest_error(double h, int steps) {
  double worst = 0;
  for (const Integrator method : kIntegrators)
    worst = largest({worst, rest_error<2>(method, h, steps), rest_error<3>(method, h, steps)});
  return worst;
}

double step_tiny() { return largest(worst_rest_error(1e-12, 100), worst_rest_error(1e-9, 100)); }

// Against the way that a free fall would go in one such step.
double step_huge() {
  return worst_over({1.0, 1e3},
                    [](double h) { return worst_rest_error(h, 10) / (kGravity * h * h / 2); });
}

// The world must say who overflows and in which step, and stay as it was.
template <int D>
bool tells(World<D>& world, const char* who, double h) {
  const std::uint64_t before = world.hash();
  const std::string step = fmt::format("in step {}", world.work().steps + 1);
  const auto why = refusal([&] { world.step(h); });
  return why && why->find(who) != std::string::npos && why->find(step) != std::string::npos &&
         world.hash() == before && is_finite(world);
}

constexpr Integrator kExplicit[] = {Integrator::explicit_euler, Integrator::semi_implicit_euler,
                                    Integrator::velocity_verlet, Integrator::runge_kutta_4};
constexpr Integrator kImplicit[] = {Integrator::implicit_midpoint, Integrator::implicit_euler};

// By speed, and by force.
template <int D>
int silent_overflows(std::span<const Integrator> methods) {
  int silent = 0;
  for (const Integrator method : methods) {
    World<D> by_speed = resting<D>(method);
    Body<D> fast = make_body<D>(Sphere{0.5}, at<D>(9, 9), "fast");
    fast.velocity = at<D>(1e300);
    by_speed.add(fast);
    silent += !tells(by_speed, "'fast'", 1e10);

    World<D> by_force = resting<D>(method);
    Body<D> light = make_body<D>(Sphere{0.5}, at<D>(9, 9), "light");
    light.mass = 1e-300;
    by_force.push(by_force.add(light), at<D>(1e9), at<D>(9, 9));
    silent += !tells(by_force, "'light'", kStep);
  }
  return silent;
}

StressResult overflow_of(std::span<const Integrator> methods) {
  const int silent = silent_overflows<2>(methods) + silent_overflows<3>(methods);
  return at_most(
      0, silent, "runs",
      fmt::format("of {} that do not name body and step, or change the world", 4 * methods.size()));
}

// An explicit method far beyond its limit blows up: it ends with a refusal, never with a NaN.
double blow_up() {
  int silent = 0;
  for (const Integrator method : kExplicit) {
    World<2> world = world_of<2>(
        {.integrator = method, .contacts = ContactMethod::none},  // or it may rest on its anchor
        {make_anchor<2>(), make_body<2>(Sphere{0.5}, {2, 0}, "bob")});
    world.add_spring({.b = 1, .stiffness = 1e8});
    const auto why = refusal([&] {
      for (int i = 0; i < 2000; ++i) world.step(kStep);
    });
    silent += !why || why->find("'bob'") == std::string::npos ||
              why->find("in step") == std::string::npos || !is_finite(world);
  }
  return silent;
}

// Nothing collides.
WorldConfig<2> config_of(Integrator method, double gravity = 0) {
  return {.gravity = {0, -gravity},
          .integrator = method,
          .contacts = ContactMethod::none,
          .may_sleep = false};
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
  return at_most(4e-11, worst, "relative", where.empty() ? "no step gains any" : where);
}

// A chain of masses along the x axis, soft and hard springs by turns.
World<2> unequal_chain_of(int links, const WorldConfig<2>& config) {
  World<2> world(config);
  world.add(make_anchor<2>());
  for (int i = 1; i <= links; ++i) {
    world.add({.shape = Sphere{0.05}, .position = {0.1 * i, 0}, .mass = 1});
    world.add_spring({.a = static_cast<BodyId>(i - 1),
                      .b = static_cast<BodyId>(i),
                      .rest_length = 0.1,
                      .stiffness = i % 2 == 0 ? 1e10 : 1e2});
  }
  return world;
}

// Its masses are thrown along it, so slowly that none passes another one: linear, with frequencies
// from 1 to 1e5. The largest gain of energy in 10 s.
template <Integrator Method>
double unequal_chain() {
  World<2> world = unequal_chain_of(100, config_of(Method));
  Random random(3);
  for (BodyId i = 1; i <= 100; ++i) world.set_velocity(i, {random.between(-0.01, 0.01), 0});
  return energy_gain(world, 600);
}

// It falls from the level and swings: far from linear.
StressResult unequal_rope(int links) {
  World<2> world = unequal_chain_of(links, config_of(Integrator::implicit_euler, kGravity));
  const double scale = kGravity * 0.1 * links * (links + 1) / 2;  // J, of the whole fall
  double before = total_energy(world);
  const double worst = worst_after_steps(world, 60, kStep, [&] {
    const double after = total_energy(world);
    return (after - std::exchange(before, after)) / scale;
  });
  return at_most(1e-9, worst, "of m g l", fmt::format("most in a step of 1 s; {} masses", links));
}

// Points chosen by chance and stiff springs between them, stretched and compressed by up to 1 %:
// the implicit method finds its step every time, and gains no energy.
double stiff_nets() {
  Random random(7);
  double worst = 0;
  for (int round = 0; round < 20; ++round) {
    World<2> world(config_of(Integrator::implicit_euler));
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
        const double apart = glm::length(world.bodies()[j].position - world.bodies()[i].position);
        world.add_spring({.a = i,
                          .b = j,
                          .rest_length = random.between(0.99, 1.01) * apart,
                          .stiffness = stiffness,
                          .damping = round % 3 * 10.0});
      }
    worst = largest(worst, energy_gain(world, 20));
  }
  return worst;
}

// A bob on a spring of k/m = 1e8 in place of a rod, from 90 degrees: its length may not wander, nor
// its energy grow. An explicit method would need steps below 2e-4 s.
double stiff_pendulum() {
  World<2> world(config_of(Integrator::implicit_euler, kGravity));
  world.add(make_anchor<2>());
  world.add({.shape = Sphere{0.1}, .position = {1, 0}, .mass = 1, .may_turn = false});
  world.add_spring({.b = 1, .rest_length = 1, .stiffness = 1e8});
  return worst_after_steps(world, 600, kStep,
                           [&] { return std::abs(glm::length(world.bodies()[1].position) - 1); });
}

}  // namespace

std::vector<StressCase> step_cases() {
  constexpr const char* kGroup = "extreme input";
  return {
      {"step_zero", kGroup, "A step of no time changes not a bit of the world.", step_zero},
      {"step_negative", kGroup, "A negative step is refused, and the world stays as it was.",
       none_wrong("steps", "taken, of {} that are negative or no number", bad_steps_taken<2>,
                  bad_steps_taken<3>)},
      {"step_tiny", kGroup, "What rests does so at steps of 1e-12 s.",
       none_above(1e-14, "m", "what rests has moved; h = 1e-12 and 1e-9, every method, 2D and 3D",
                  step_tiny)},
      {"step_huge", kGroup,
       "What rests does so at steps of 1000 s, or the world says who does not.",
       none_above(1e-5, "of a fall",
                  "that what rests has moved; h = 1 and 1e3, every method, 2D and 3D", step_huge)},
      {"overflow", kGroup, "A number that overflows ends the run, naming body and step.",
       [] { return overflow_of(kExplicit); }},
      {"overflow_implicit", kGroup,
       "An implicit method ends a run that overflows, naming body and step.",
       [] { return overflow_of(kImplicit); }},
      {"blow_up", kGroup, "A spring beyond its method's limit ends the run, naming body and step.",
       none_above(0, "runs", "of 4 explicit methods that do not end naming body and step",
                  blow_up)}};
}

// Stiff springs and chains, at steps far beyond what an explicit method bears.

std::vector<StressCase> stiff_cases() {
  using enum Integrator;
  constexpr const char* kGroup = "stiff";
  constexpr const char* kSpring =
      "A spring of k/m = 1e6 ... 1e10 gains no energy at h = 1/60 s, at any damping.";
  constexpr const char* kChain = "A chain of springs of ratio 1e8 gains no energy at h = 1/60 s.";
  constexpr const char* kRope =
      "A rope of springs of ratio 1e8 swings at h = 1/60 s and gains no energy.";
  // Places around 10 m are rounded by 1e-15, which k h turns into 1e-7 m/s a step.
  const auto chain = [](auto gain) {
    return none_above(1e-6, "relative", "energy gained in 10 s; 100 masses, k = 1e2 and 1e10",
                      gain);
  };
  return {
      {"stiff_spring_implicit_midpoint", kGroup, kSpring, stiff_spring<implicit_midpoint>},
      {"stiff_spring_implicit_euler", kGroup, kSpring, stiff_spring<implicit_euler>},
      {"unequal_chain_implicit_midpoint", kGroup, kChain, chain(unequal_chain<implicit_midpoint>)},
      {"unequal_chain_implicit_euler", kGroup, kChain, chain(unequal_chain<implicit_euler>)},
      {"unequal_rope", kGroup, kRope, [] { return unequal_rope(100); }},
      {"unequal_rope_of_1000", kGroup, kRope, [] { return unequal_rope(1000); }, true},
      {"stiff_nets", kGroup, "Nets of stiff springs find their implicit step and gain no energy.",
       none_above(1e-9, "relative", "most above the start; 20 nets of 12 masses, k to 6.7e9",
                  stiff_nets)},
      {"stiff_pendulum", kGroup, "A spring of k/m = 1e8 holds a pendulum's length like a rod.",
       none_above(1e-5, "m", "the rod's length, 10 s at 1/60 s", stiff_pendulum)}};
}

}  // namespace lantern::measure
