// A world like another one, which goes on as that one does and leaves it alone.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "world_scene.hpp"

namespace lantern::physics {
namespace {

constexpr std::array kCopiedIntegrators = {
    Integrator::explicit_euler, Integrator::semi_implicit_euler, Integrator::velocity_verlet,
    Integrator::runge_kutta_4,  Integrator::implicit_midpoint,   Integrator::implicit_euler};
constexpr std::array kCopiedMethods = {ContactMethod::none, ContactMethod::impulse,
                                       ContactMethod::soft, ContactMethod::direct,
                                       ContactMethod::lecture};

// A random heap of boxes and balls that spin, one of them asleep; a spring, a pin, two pushes; some
// have left, so that ids have gaps.
template <int D>
World<D> mixed(const WorldConfig<D>& config, Random& random) {
  World<D> world(config);
  world.add(floor_at<D>());
  std::vector<BodyId> ids;
  for (int i = 0; i < 9; ++i) {
    const Vec<D> at = along<D>(random.between(-2, 2) + 1.2 * (i % 3), 0.6 + 1.1 * (i / 3));
    Body<D> body = i % 4 == 0 ? ball_at<D>(at) : box_at<D>(at, random.between(0.3, 0.5));
    body.velocity = along<D>(random.between(-1, 1), random.between(-1, 1));
    body.linear_drag = random.between(0, 0.05);
    body.material.restitution = i % 5 == 0 ? 0.5 : 0;
    Spin<D> spin(0.0);
    for (int k = 0; k < (D == 2 ? 1 : 3); ++k) spin_component(spin, k) = random.between(-3, 3);
    ids.push_back(world.add(body, spin));
  }
  world.add_spring({ids[1], ids[6], up<D>(0.2), Vec<D>(0.0), 1, 20, 0.3});
  if (config.contacts != ContactMethod::lecture)
    world.add_joint({JointKind::pin, ids[2], ids[3], along<D>(0.5), along<D>(-0.5)});
  world.push(ids[4], along<D>(2), world.find(ids[4])->position);
  world.push(ids[5], up<D>(3), world.find(ids[5])->position, 0.08);
  world.remove(std::array{ids[0], ids[7]});
  run(world, 0.05);
  world.sleep(world.add(box_at<D>(along<D>(9, 0.5))));
  return world;
}

template <int D>
void goes_on_alike() {
  Random random(20);
  for (const Integrator integrator : kCopiedIntegrators)
    for (const ContactMethod method : kCopiedMethods) {
      WorldConfig<D> config = falling<D>();
      config.integrator = integrator;
      config.contacts = method;
      if (random.between(0, 1) > 0.7) config.wanted_error = 0.01;
      World<D> world = mixed(config, random);
      const std::uint64_t hash = world.hash();
      const WorldWork work = world.work();
      World<D> copy(world, config);
      EXPECT_EQ(copy.hash(), hash);
      EXPECT_EQ(copy.work().steps, 0u);
      run(copy, 0.05);
      EXPECT_EQ(world.hash(), hash);
      for (const WorldCounter& counter : kWorldCounters)
        EXPECT_EQ(world.work().*counter.count, work.*counter.count) << counter.name;
      run(world, 0.05);
      EXPECT_EQ(copy.hash(), world.hash())
          << D << "D " << to_string(integrator) << " " << to_string(method);
      EXPECT_EQ(copy.events(), world.events());
      EXPECT_EQ(copy.islands(), world.islands());
      EXPECT_EQ(copy.add(ball_at<D>(up<D>(30))), world.add(ball_at<D>(up<D>(30))));
    }
}

TEST(CopiedWorld, GoesOnAsTheOther2D) { goes_on_alike<2>(); }
TEST(CopiedWorld, GoesOnAsTheOther3D) { goes_on_alike<3>(); }

TEST(CopiedWorld, HasSettingsOfItsOwn) {
  Random random(3);
  World<2> world = mixed(falling<2>(), random);
  WorldConfig<2> config = world.config();
  config.gravity = up<2>(7);
  config.wanted_error = 0.01;
  World<2> copy(world, config);
  EXPECT_EQ(copy.forces().gravity, up<2>(7));
  EXPECT_EQ(copy.config().wanted_error, 0.01);
  config.sub_steps = 0;
  EXPECT_THROW(World<2>(world, config), Refused);
}

}  // namespace
}  // namespace lantern::physics
