// Contacts and joints never make energy: needles, plates, spins, mass ratios, overlaps, many steps
// and sub-steps, and random worlds. What is known to make some is shown to.

#include "measure/energy_trial.hpp"
#include "measure/stress_scene.hpp"

namespace lantern::measure {
namespace {

using namespace stress;

constexpr const char* kUnit = "of the kinetic energy";

// The largest excess of all that were tried, and where it was.
class Most {
 public:
  void meet(const EnergyTrial& trial, const std::string& what) {
    ++tried_;
    if (!(trial.excess > excess_) && tried_ > 1) return;
    excess_ = trial.excess;
    where_ = trial.reason.empty() ? what : fmt::format("{}: {}", what, trial.reason);
  }
  StressResult result() const {
    return at_most(1e-9, excess_, kUnit, fmt::format("{} runs; most: {}", tried_, where_));
  }

 private:
  int tried_ = 0;
  double excess_ = 0;
  std::string where_;
};

constexpr ContactMethod kParting[] = {ContactMethod::soft, ContactMethod::impulse,
                                      ContactMethod::direct};

WorldConfig<3> config_by(ContactMethod method) {
  WorldConfig<3> config = with_gravity<3>();
  config.contacts = method;
  return config;
}

// A box of mass 1 that turns about a skew axis falls on the floor from 1.5 units.
EnergyTrial falling_box(const WorldConfig<3>& config, const Vec<3>& half, double spin, double h) {
  World<3> world = world_of<3>(config, {make_floor<3>()});
  Body<3> box = make_body<3>(OrientedBox<3>{half}, {0, 1.5, 0});
  box.mass = 1;
  world.set_angular_velocity(world.add(box), glm::normalize(Vec<3>(0.1, 0.01, 1)) * spin);
  return follow_energy<3>(world, h, static_cast<int>(std::lround(3 / h)));
}

// Of every method, at 1/60 s.
StressResult falling_boxes(std::initializer_list<Vec<3>> halves,
                           std::initializer_list<double> spins) {
  Most most;
  for (const ContactMethod method : kParting)
    for (const Vec<3>& half : halves)
      for (const double spin : spins)
        most.meet(falling_box(config_by(method), half, spin, kStep),
                  fmt::format("{}, half sizes {:g} {:g} {:g}, {:g} rad/s", to_string(method),
                              half.x, half.y, half.z, spin));
  return most.result();
}

StressResult needles() {
  return falling_boxes({{1, 0.1, 0.1}, {1, 0.01, 0.01}, {1, 0.001, 0.001}, {1, 1e-4, 1e-4}},
                       {0, 1, 10, 100});
}
StressResult plates() {
  return falling_boxes({{1, 0.1, 1}, {1, 0.01, 1}, {1, 0.001, 1}, {0.001, 1, 0.5}},
                       {0, 1, 10, 100});
}
StressResult fast_spins() {
  return falling_boxes({{0.5, 0.5, 0.5}, {0.5, 0.3, 0.2}, {1, 0.05, 0.05}}, {500, 2e3, 1e4});
}

StressResult steps_and_sub_steps() {
  Most most;
  for (const double h : {1.0 / 960, 1.0 / 240, 1.0 / 30, 1.0 / 10, 0.5})
    for (const int sub_steps : {1, 2, 16, 64}) {
      WorldConfig<3> config = config_by(ContactMethod::soft);
      config.sub_steps = sub_steps;
      for (const Vec<3>& half : {Vec<3>(1, 0.01, 0.01), Vec<3>(0.5, 0.4, 0.3)})
        most.meet(falling_box(config, half, 30, h),
                  fmt::format("{} sub-steps of {:.3g} s, half sizes {:g} {:g} {:g}", sub_steps, h,
                              half.x, half.y, half.z));
    }
  return most.result();
}

// Boxes of falling masses on each other: 1, 1/ratio, 1, 1/ratio.
StressResult mass_ratios() {
  Most most;
  for (const ContactMethod method : kParting)
    for (const double ratio : {1e2, 1e4, 1e6}) {
      World<3> world = world_of<3>(config_by(method), {make_floor<3>()});
      for (int i = 0; i < 6; ++i) {
        Body<3> box = make_box<3>({0.1 * i, 0.6 + 1.1 * i, 0});
        box.mass = i % 2 == 0 ? 1 : ratio;
        world.add(box);
      }
      most.meet(follow_energy<3>(world, kStep, 90),
                fmt::format("{}, 1 : {:g}", to_string(method), ratio));
    }
  return most.result();
}

// Boxes all but at one place: they part, and no faster than their weight explains.
StressResult deep_overlaps() {
  Most most;
  for (const ContactMethod method : kParting)
    for (const bool falls : {false, true})
      for (const double apart : {0.0, 0.01, 0.5}) {
        WorldConfig<3> config = config_by(method);
        if (!falls) config.gravity = Vec<3>(0.0);
        World<3> world = world_of<3>(config, {make_floor<3>(-1)});
        for (int i = 0; i < 5; ++i) world.add(make_box<3>({apart * i, apart * (i % 2), 0}));
        most.meet(follow_energy<3>(world, kStep, 40),
                  fmt::format("{}, 5 boxes {:g} apart{}", to_string(method), apart,
                              falls ? ", under gravity" : ""));
      }
  return most.result();
}

// Of seeds first ... first + count - 1, each by every method.
StressResult random_worlds(std::uint64_t first, std::uint64_t count) {
  Most most;
  for (std::uint64_t seed = first; seed < first + count; ++seed)
    for (const ContactMethod method : kParting)
      most.meet(random_trial(seed, method),
                fmt::format("{}, {}", to_string(method), random_scene_text(seed)));
  return most.result();
}

// --- what makes energy, and is there to show it ---

// It notices a ball that lies in the floor, lifts it out, and turns its speed round: what it fell
// too deep it gains.
StressResult lecture_gains() {
  WorldConfig<2> config = with_gravity<2>();
  config.contacts = ContactMethod::lecture;
  Body<2> ball = make_ball<2>({0, 1.5});
  ball.material.restitution = 1;
  World<2> world = world_of<2>(config, {make_floor<2>(), ball});
  const EnergyTrial trial = follow_energy<2>(world, kStep, 1200);
  return at_least(kEnergyAllowance, trial.excess, kUnit, "a ball that loses nothing, 20 s");
}

}  // namespace

std::vector<StressCase> energy_cases() {
  constexpr const char* kGroup = "energy";
  const auto random_few = [] { return random_worlds(20, 20); };
  const auto random_many = [] { return random_worlds(0, 1000); };
  return {
      {"energy_needles", kGroup, "A needle that falls on the ground makes no energy.", needles,
       true},
      {"energy_plates", kGroup, "A plate that falls on the ground makes no energy.", plates, true},
      {"energy_fast_spins", kGroup, "A box that spins fast makes no energy on the ground.",
       fast_spins},
      {"energy_steps", kGroup, "Contacts make no energy, whatever the step and the sub-steps.",
       steps_and_sub_steps, true},
      {"energy_mass_ratios", kGroup, "Contacts make no energy, whatever the masses.", mass_ratios},
      {"energy_deep_overlaps", kGroup,
       "Bodies that start inside each other get no more energy than the overlap explains.",
       deep_overlaps},
      {"energy_random", kGroup, "Random worlds make no energy.", random_few},
      {"energy_random_thousand", kGroup, "A thousand random worlds make no energy.", random_many,
       true},
      {"energy_lecture", kGroup, "The lecture's contact solver makes energy.", lecture_gains}};
}

}  // namespace lantern::measure
