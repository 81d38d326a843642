#include "scenario/body_measure.hpp"

#include <algorithm>

#include "physics/energy.hpp"

namespace lantern {
namespace {

double size_of(double value) { return value; }
double size_of(const Vec<3>& value) { return glm::length(value); }

double about_own_axis(const Body<2>&, int) { return 0; }
double about_own_axis(const Body<3>& body, int axis) {
  return (glm::conjugate(body.orientation.q) * angular_velocity(body))[axis];
}

double deepest_of(BodyId id, const Frame& frame) {
  double deepest = 0;
  for (const FrameContact& contact : frame.contacts)
    if (contact.pair.a == id || contact.pair.b == id)
      for (const FrameContact::Point& point : contact.points)
        deepest = std::max(deepest, -point.separation);
  return deepest;
}

template <int D>
double measured(BodyMeasure what, const Body<D>& body, const World<D>& world, const Frame& frame) {
  const auto energy = [&] { return energy_of<D>(body, world.bodies(), world.forces()); };
  const Vec<3> position = solid(body.position);
  switch (what) {
    case BodyMeasure::energy:
      return energy().total();
    case BodyMeasure::kinetic_energy:
      return energy().kinetic();
    case BodyMeasure::potential_energy:
      return energy().potential();
    case BodyMeasure::speed:
      return glm::length(body.velocity);
    case BodyMeasure::spin:
      return size_of(angular_velocity(body));
    case BodyMeasure::angular_momentum:
      return size_of(body.angular_momentum);
    case BodyMeasure::own_spin_x:
      return about_own_axis(body, 0);
    case BodyMeasure::own_spin_y:
      return about_own_axis(body, 1);
    case BodyMeasure::own_spin_z:
      return about_own_axis(body, 2);
    case BodyMeasure::x:
      return position.x;
    case BodyMeasure::y:
      return position.y;
    case BodyMeasure::z:
      return position.z;
    case BodyMeasure::penetration:
      return deepest_of(body.id, frame);
  }
  return 0;
}

}  // namespace

template <int D>
void measure_bodies(const Players<D>& players, const Scenario& scenario, Frame& frame) {
  for (const BodyMeasureSpec& asked : scenario.body_measures)
    if (const Body<D>* body = players.body(asked.body))
      frame.measures.emplace_back(asked.name,
                                  measured(asked.measure, *body, players.world(), frame));
}

template void measure_bodies(const Players<2>&, const Scenario&, Frame&);
template void measure_bodies(const Players<3>&, const Scenario&, Frame&);

}  // namespace lantern
