// A world: bodies fall, touch, and come to rest.
#include <cmath>
#include <cstdio>

#include <lantern/physics/world.hpp>

using namespace lantern::physics;

int main() {
  //! [world]
  WorldConfig<2> config;
  config.gravity = {0.0, -10.0};
  config.broad_phase.kind = lantern::spatial::StructureKind::quadtree;
  World<2> world(config);

  Body<2> floor;
  floor.shape = HalfSpace<2>{{0.0, 1.0}};
  floor.kind = BodyKind::static_body;
  world.add(floor);

  Body<2> box;
  box.shape = OrientedBox<2>{{0.5, 0.5}};
  box.position = {0.0, 3.0};
  const BodyId id = world.add(box);

  for (int i = 0; i < 120; ++i) world.step(1.0 / 60);
  //! [world]

  //! [contacts]
  for (const Contact<2>& contact : world.contacts())
    std::printf("%u touches %u at %d points\n", contact.a, contact.b, contact.manifold.count);
  std::printf("the box lies at y = %.4f\n", world.find(id)->position.y);
  //! [contacts]

  return std::abs(world.find(id)->position.y - 0.5) < 1e-3 ? 0 : 1;
}
