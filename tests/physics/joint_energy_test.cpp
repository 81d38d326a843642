// Joints take no energy from what swings on them.
#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "jointed_scene.hpp"

namespace lantern::physics {
namespace {

// A rod on a pin, a ball on a rod, or two rods, let go level: their energy swings by the square of
// the step and does not drift, whatever the contacts of the world are.
template <int D>
World<D> let_go(ContactMethod contacts, int kind, Random& random) {
  WorldConfig<D> config = jointed<D>(WorldConfig<D>{}.integrator);
  config.contacts = contacts;
  World<D> world(config);
  world.add(fixed_at<D>(Vec<D>(0.0)));
  const double half = random.between(0.3, 1.5);
  if (kind == 0) {
    world.add(ball_at<D>(along<D>(2 * half), Vec<D>(0.0), 0.1));
    rod<D>(world, 0, 1, 2 * half);
    return world;
  }
  for (int i = 0; i < kind; ++i) {
    Vec<D> size(0.05);
    size.x = half;
    world.add(plank_at<D>(along<D>((2 * i + 1) * half), size, std::exp(random.between(-2, 2))));
    pin<D>(world, static_cast<BodyId>(i), static_cast<BodyId>(i + 1), along<D>(i > 0 ? half : 0),
           along<D>(-half));
  }
  return world;
}

// The extremes of its energy over so many steps, of the most that it moves by.
template <int D>
std::pair<double, double> swing_of_energy(World<D>& world, int steps, double scale) {
  double low = 1e300, high = -1e300;
  for (int i = 0; i < steps; ++i) {
    world.step(1.0 / 120);
    const double now = energy<D>(world.bodies(), world.forces()).total() / scale;
    low = std::min(low, now);
    high = std::max(high, now);
  }
  return {low, high};
}

template <int D>
void expect_kept_by_pins(ContactMethod contacts, int kind, Random& random) {
  World<D> world = let_go<D>(contacts, kind, random);
  double scale = 0;
  for (const Body<D>& body : world.bodies())
    if (body.is_dynamic()) scale += body.mass * 9.81 * body.position.x;
  const auto early = swing_of_energy(world, 400, scale);
  for (int i = 0; i < 1200; ++i) world.step(1.0 / 120);
  const auto late = swing_of_energy(world, 400, scale);
  const double most = kind == 2 ? 2e-2 : 2e-3;  // two rods are chaos, and may whirl fast
  for (const double swing : {early.first, early.second, late.first, late.second})
    EXPECT_LT(std::abs(swing), most) << D << "D " << to_string(contacts) << " kind " << kind;
  if (kind == 2) return;
  EXPECT_NEAR(late.first, early.first, 2e-4) << D << "D " << to_string(contacts);
  EXPECT_NEAR(late.second, early.second, 2e-4) << D << "D " << to_string(contacts);
}

TEST(JointEnergy, TheDefaultIntegratorLosesNoEnergyToPins) {
  Random random(23);
  for (const ContactMethod contacts :
       {ContactMethod::none, ContactMethod::impulse, ContactMethod::soft, ContactMethod::direct})
    for (const int kind : {0, 1, 2}) {
      expect_kept_by_pins<2>(contacts, kind, random);
      expect_kept_by_pins<3>(contacts, kind, random);
    }
}

}  // namespace
}  // namespace lantern::physics
