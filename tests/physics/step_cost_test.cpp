// A step costs what moves in its world; a stage that is off, or that nothing needs, costs nothing.
// Work and memory are counted to the last one. Instructions are where somebody counts them.
#include <array>

#include <gtest/gtest.h>

#include "counted_memory.hpp"
#include "instructions.hpp"
#include "physics/integrate/integrator.hpp"
#include "physics/world_scene.hpp"

namespace lantern::physics {
namespace {

struct StepCost {
  std::uint64_t instructions = 0;  // of ten steps
  WorldWork work;                  // of the same
  std::uint64_t calls = 0;         // for memory, in them
};

// Of ten steps of a world that is warm.
template <int D>
StepCost cost_of(World<D>& world, Instructions& instructions) {
  StepCost cost;
  const WorldWork before = world.work();
  const auto ten_steps = [&] {
    const std::uint64_t calls = counted_memory::calls;
    for (int i = 0; i < 10; ++i) world.step(kStep);
    cost.calls = counted_memory::calls - calls;
  };
  if (instructions.are_counted())
    cost.instructions = instructions.of(ten_steps);
  else
    ten_steps();
  cost.work = work_between(before, world.work());
  return cost;
}

// But for `unlike`, a counter.
void expect_same_work(const StepCost& one, const StepCost& other, std::string_view unlike = "") {
  for (const WorldCounter& counter : kWorldCounters) {
    if (counter.name == unlike) continue;
    EXPECT_EQ(one.work.*counter.count, other.work.*counter.count) << counter.name;
  }
}

void expect_same_instructions(const StepCost& one, const StepCost& other) {
  EXPECT_LE(static_cast<double>(other.instructions), 1.05 * static_cast<double>(one.instructions));
  EXPECT_LE(static_cast<double>(one.instructions), 1.05 * static_cast<double>(other.instructions));
}

// --- what sleeps ---

enum class Mover { flies, slides, swings };

// Boxes that sleep on a floor, far from one that moves. Those that are asked for are static
// instead.
template <int D>
World<D> sleepers(int count, ContactMethod contacts, Mover mover, bool are_static = false) {
  WorldConfig<D> config = falling<D>();
  config.contacts = contacts;
  World<D> world(config);
  const BodyId floor = world.add(floor_at<D>(0, 0));
  for (int i = 0; i < count; ++i) {
    Body<D> box = box_at<D>(along<D>(i % 100 * 1.5, 0.5));
    if constexpr (D == 3) box.position.z = i / 100 * 1.5;
    if constexpr (D == 2) box.position.x += i / 100 * 150.0;
    box.asleep = !are_static;
    if (are_static) box.kind = BodyKind::static_body;
    world.add(box);
  }
  const bool slides = mover == Mover::slides;
  const BodyId id = world.add(ball_at<D>(along<D>(-200, slides ? 0.5 : 40), along<D>(1)));
  if (mover == Mover::swings)
    world.add_joint({.kind = JointKind::distance,
                     .a = floor,
                     .b = id,
                     .at_a = along<D>(-200, 60),
                     .length = 20});
  for (int i = 0; i < 30; ++i) world.step(kStep);
  return world;
}

template <int D>
void expect_sleepers_cost_nothing(ContactMethod contacts, Mover mover, bool are_static) {
  SCOPED_TRACE(std::string(to_string(contacts)) + (D == 2 ? " in 2D, " : " in 3D, ") +
               std::to_string(static_cast<int>(mover)) + (are_static ? ", static" : ""));
  Instructions instructions;
  std::optional<StepCost> of_few;
  std::optional<Vec<D>> where;
  for (const int count : {100, 1000, 10'000}) {
    World<D> world = sleepers<D>(count, contacts, mover, are_static);
    const StepCost cost = cost_of(world, instructions);
    EXPECT_EQ(world.work().asleep, are_static ? 0u : static_cast<unsigned>(count));
    EXPECT_EQ(cost.calls, 0u) << count;
    EXPECT_LE(cost.work.pair_tests, 200u) << count;
    if (!of_few) of_few = cost;
    if (!where) where = world.bodies().back().position;
    expect_same_work(*of_few, cost, "pair_tests");
    EXPECT_EQ(world.bodies().back().position, *where) << count;
    // The trees of the broad phase are higher by a few nodes.
    EXPECT_LE(static_cast<double>(cost.instructions),
              1.05 * static_cast<double>(of_few->instructions) + 10 * 400 * (count > 100))
        << count;
  }
}

template <int D>
void expect_sleepers_cost_nothing() {
  for (const Mover mover : {Mover::flies, Mover::slides, Mover::swings})
    for (const ContactMethod contacts : {ContactMethod::none, ContactMethod::soft,
                                         ContactMethod::impulse, ContactMethod::direct}) {
      if (contacts == ContactMethod::none && mover == Mover::slides) continue;
      expect_sleepers_cost_nothing<D>(contacts, mover, false);
    }
  expect_sleepers_cost_nothing<D>(ContactMethod::soft, Mover::slides, true);
}

TEST(StepCost, IsThatOfWhatIsAwake2D) { expect_sleepers_cost_nothing<2>(); }
TEST(StepCost, IsThatOfWhatIsAwake3D) { expect_sleepers_cost_nothing<3>(); }

TEST(StepCost, IsCountedInInstructions) {
  Instructions instructions;
  if (!instructions.are_counted()) GTEST_SKIP() << "no counter may be read, and no callgrind runs";
  World<2> one = sleepers<2>(1, ContactMethod::soft, Mover::slides);
  World<2> two(one, one.config());
  two.add(ball_at<2>({-300, 0.5}, {1, 0}));
  for (int i = 0; i < 30; ++i) two.step(kStep);
  const double alone = static_cast<double>(cost_of(one, instructions).instructions);
  EXPECT_GT(alone, 10'000);
  EXPECT_GT(static_cast<double>(cost_of(two, instructions).instructions), 1.3 * alone);
}

// --- stages that are off ---

// Twenty balls that fly; or lie on a floor, and in pairs on each other.
template <int D>
World<D> balls(const WorldConfig<D>& config, bool lie) {
  World<D> world(config);
  world.add(floor_at<D>());
  for (int i = 0; i < 20; ++i) {
    const double y = lie ? 0.5 + i % 2 : 30;
    world.add(
        ball_at<D>(along<D>(i / 2 * 3.0 + (lie ? 0 : i % 2 * 1.5), y), along<D>(lie ? 0 : 1)));
  }
  return world;
}

// That two worlds cost the same, which differ by what neither of them needs.
template <int D>
class SameCost {
 public:
  SameCost(const char* stage, WorldConfig<D> config, bool lie) : config_(config), lie_(lie) {
    what_ = std::string(stage) + (D == 2 ? " in 2D" : " in 3D");
  }
  // f(config) and g(world) turn the stage on; of use is nothing of it.
  template <class F, class G>
  void expect(F&& f, G&& g) {
    SCOPED_TRACE(what_);
    WorldConfig<D> with = config_;
    f(with);
    World<D> plain = balls(config_, lie_), other = balls(with, lie_);
    g(other);
    for (World<D>* world : {&plain, &other})
      for (int i = 0; i < 20; ++i) world->step(kStep);
    Instructions instructions;
    const StepCost one = cost_of(plain, instructions), two = cost_of(other, instructions);
    expect_same_work(one, two, "rest_checks");
    EXPECT_EQ(one.calls, 0u);
    EXPECT_EQ(two.calls, 0u);
    EXPECT_EQ(plain.hash(), other.hash());
    expect_same_instructions(one, two);
  }
  template <class F>
  void expect_by_config(F&& f) {
    expect(std::forward<F>(f), [](World<D>&) {});
  }
  template <class G>
  void expect_by_world(G&& g) {
    expect([](WorldConfig<D>&) {}, std::forward<G>(g));
  }

 private:
  std::string what_;
  WorldConfig<D> config_;
  bool lie_;
};

template <int D>
void expect_stages_cost_nothing() {
  using Config = WorldConfig<D>;
  using At = Vec<D>;
  Config still, falls = falling<D>();
  still.may_sleep = falls.may_sleep = false;
  // Nothing may sleep, where nothing would: all fly.
  SameCost<D>("sleep", still, false).expect_by_config([](Config& c) { c.may_sleep = true; });
  // Impacts are looked for, where nothing bounces or is fast.
  SameCost<D>("impacts", falls, true).expect_by_config([](Config& c) { c.continuous = false; });
  SameCost<D>("impacts", still, false).expect_by_config([](Config& c) { c.continuous = false; });
  // An error is wanted, where nothing touches.
  SameCost<D>("wanted error", still, false).expect_by_config([](Config& c) {
    c.wanted_error = 0.01;
  });
  // The contact methods, where nothing touches.
  for (const std::string_view name : contact_method_names()) {
    if (name == "none" || name == "lecture") continue;
    SameCost<D>("contacts", still, false).expect_by_config([&](Config& c) {
      c.contacts = *contact_method_named(name);
    });
  }
  // The integrators, where there is no force.
  for (const std::string_view name : integrator_names()) {
    const Integrator by = *integrator_named(name);
    if (integration(by).of_places) continue;  // no contacts
    SameCost<D>("forces", still, false).expect_by_config([&](Config& c) { c.integrator = by; });
  }
  // What was there once, and has gone.
  for (const bool lie : {true, false}) {
    const Config& config = lie ? falls : still;
    SameCost<D>("springs", config, lie).expect_by_world([](World<D>& world) {
      world.remove_spring(world.add_spring({.a = 1, .b = 2, .stiffness = 1}));
    });
    SameCost<D>("joints", config, lie).expect_by_world([](World<D>& world) {
      world.remove_joint(
          world.add_joint({.kind = JointKind::distance, .a = 1, .b = 4, .length = 3}));
    });
    SameCost<D>("pushes", config, lie).expect_by_world([](World<D>& world) {
      world.push(1, At(1.0), At(0.0));
      world.clear_pushes();
    });
    SameCost<D>("gravity", config, lie).expect_by_world([](World<D>& world) {
      const At gravity = world.config().gravity;
      world.set_gravity(At(7.0));
      world.set_gravity(gravity);
    });
    // Who asks pays, and nobody later.
    SameCost<D>("islands, events, looks", config, lie).expect_by_world([](World<D>& world) {
      world.keep_impact_looks(true);
      world.step(0);
      EXPECT_EQ(world.islands().size(), 21u);
      EXPECT_TRUE(world.events().empty());
      world.keep_impact_looks(false);
    });
  }
}

TEST(StepCost, OfStagesThatAreOffIsNothing2D) { expect_stages_cost_nothing<2>(); }
TEST(StepCost, OfStagesThatAreOffIsNothing3D) { expect_stages_cost_nothing<3>(); }

// Without contacts, forces and ties a step is the flight of its bodies, and what it takes to keep
// the world as it was until that is done.
template <int D>
void expect_flight_is_all() {
  WorldConfig<D> config;
  config.contacts = ContactMethod::none;
  config.may_sleep = false;
  World<D> world = balls(config, false);
  world.step(kStep);
  Instructions instructions;
  const StepCost cost = cost_of(world, instructions);
  for (const WorldCounter& counter : kWorldCounters)
    EXPECT_EQ(cost.work.*counter.count, counter.name == "steps" ? 10u : 0u) << counter.name;
  EXPECT_EQ(cost.calls, 0u);
  EXPECT_EQ(world.broad_phase(), nullptr);
  EXPECT_TRUE(world.contacts().empty());
}

TEST(StepCost, OfFreeFlightIsFlight) {
  expect_flight_is_all<2>();
  expect_flight_is_all<3>();
}

}  // namespace
}  // namespace lantern::physics
