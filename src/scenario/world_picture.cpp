#include "scenario/world_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/stop.hpp"
#include "physics/energy.hpp"

namespace lantern {
namespace {

template <int D>
FrameBody frame_body(const Body<D>& body, const BodySpec& spec) {
  FrameBody b;
  b.id = body.id;
  b.name = body.name;
  b.look = spec.look;
  b.color = spec.color;
  b.shape = in_dimension<3>(body.shape);
  b.position = solid(body.position);
  b.velocity = solid(body.velocity);
  b.box = solid(body.box());
  b.is_static = !body.moves();
  b.asleep = body.asleep;
  if constexpr (D == 2) {
    b.angle = body.orientation.angle;
    b.orientation = turned(Rotation<3>(), Vec<3>(0, 0, b.angle));
    b.angular_momentum = {0, 0, body.angular_momentum};
  } else {
    b.orientation = body.orientation;
    b.angular_momentum = body.angular_momentum;
  }
  return b;
}

template <int D>
FrameContact frame_contact(const Contact<D>& contact, const std::vector<ContactEvent>& events) {
  FrameContact c;
  c.pair = {contact.a, contact.b};
  c.normal = solid(contact.manifold.normal);
  // Events come in the order of their pairs, one a pair.
  const auto event = std::lower_bound(events.begin(), events.end(), c.pair,
                                      [](const ContactEvent& e, const Pair& pair) {
                                        return Pair{e.a, e.b} < pair;
                                      });
  c.begins = event != events.end() && Pair{event->a, event->b} == c.pair &&
             event->kind == ContactEvent::Kind::begin;
  for (std::size_t i = 0; i < contact.manifold.points().size(); ++i) {
    const auto& point = contact.manifold.room[i];
    c.points.push_back({solid(point.position), point.separation, contact.normal_impulses[i]});
  }
  return c;
}

}  // namespace

template <int D>
void picture_world(const Players<D>& players, Frame& frame) {
  const World<D>& world = players.world();
  for (const Body<D>& body : world.bodies())
    if (const BodySpec* spec = players.spec_of(body.id))
      frame.bodies.push_back(frame_body(body, *spec));
  for (const Contact<D>& contact : world.contacts()) {
    stop_if_asked();
    if (players.spec_of(contact.a) && players.spec_of(contact.b) && world.find(contact.a) &&
        world.find(contact.b))  // one may have left since the step
      frame.contacts.push_back(frame_contact(contact, world.events()));
  }
  players.for_each_link([&](const LinkSpec& spec, const Vec<D>& from, const Vec<D>& to,
                            double rest) {
    const bool has_length = spec.kind != LinkSpec::Kind::pin && rest > 0;
    constexpr double kMost = std::numeric_limits<double>::max();  // of next to no length
    const double strain = has_length ? std::min((glm::length(to - from) - rest) / rest, kMost) : 0;
    frame.links.push_back(
        {static_cast<FrameLink::Kind>(spec.kind), solid(from), solid(to), strain});
  });
}

template <int D>
void measure_world(const Players<D>& players, bool has_contacts, Frame& frame) {
  const std::span<const Body<D>> bodies(players.world().bodies());
  const Energy now = energy(bodies, players.world().forces());
  frame.measures = {{"energy", now.total()},
                    {"kinetic_energy", now.kinetic()},
                    {"potential_energy", now.potential()},
                    {"momentum", glm::length(momentum(bodies))},
                    {"angular_momentum", glm::length(angular_momentum<D>(bodies))}};
  if (!has_contacts) return;
  double deepest = 0;
  for (const FrameContact& c : frame.contacts)
    for (const FrameContact::Point& point : c.points)
      deepest = std::max(deepest, -point.separation);
  frame.measures.emplace_back("penetration", deepest);
}

template void picture_world(const Players<2>&, Frame&);
template void picture_world(const Players<3>&, Frame&);
template void measure_world(const Players<2>&, bool, Frame&);
template void measure_world(const Players<3>&, bool, Frame&);

}  // namespace lantern
