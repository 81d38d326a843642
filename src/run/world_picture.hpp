// Bodies, springs and joints of a world, its islands, and what is measured of it, as a frame shows
// them.
#pragma once

#include <map>

#include "frame/frame.hpp"
#include "frame/parts/motion.hpp"
#include "language/counts.hpp"
#include "lecture/game_object.hpp"
#include "physics/forces.hpp"
#include "physics/joint.hpp"
#include "run/players.hpp"

namespace lantern::run {

// --- what is counted here ---

inline constexpr CountDoc kWorldCounts[] = {
    {"islands", when::islands, "",
     "Islands of the last world step: what contacts, springs and joints hold together; what never "
     "moves holds nothing together."},
    {"largest_island", when::islands, "", "Bodies of the largest of them."},
    {"islands_asleep", when::islands, "island asleep/islands asleep", "Those of them that sleep."}};
inline constexpr CountDoc kWorldMeasures[] = {
    {"energy", when::physics, "", "Kinetic and potential energy.", Most::unbounded, "J"},
    {"kinetic_energy", when::physics, "", "Energy of motion and rotation.", Most::size, "J"},
    {"potential_energy", when::physics, "", "Energy of height and of springs.", Most::unbounded,
     "J"},
    {"momentum", when::physics, "", "Length of the momentum of all bodies.", Most::size, "N s"},
    {"angular_momentum", when::physics, "",
     "Angular momentum of all bodies about the origin; its length in a 3D world.", Most::unbounded,
     "J s"},
    {"joint_gap", when::joints, "",
     "How far the joint that holds worst is from holding: a pin's points apart, a rod too long or "
     "short.",
     Most::size, "units"}};

// How a body lies and moves now.
template <int D>
BodyState state_of(const Body<D>& body) {
  BodyState state{
      .there = true, .position = solid(body.position), .velocity = solid(body.velocity)};
  if constexpr (D == 2) {
    state.angle = body.orientation.angle;
    state.orientation = turned(Rotation<3>(), Vec<3>(0, 0, state.angle));
    state.angular_velocity.z = angular_velocity(body);
    state.angular_momentum.z = body.angular_momentum;
  } else {
    state.orientation = body.orientation;
    state.angular_velocity = angular_velocity(body);
    state.angular_momentum = body.angular_momentum;
  }
  return state;
}

template <int D>
FrameBody frame_body(const Body<D>& body, const BodySpec& spec, std::size_t place) {
  FrameBody b;
  static_cast<BodyState&>(b) = state_of(body);
  b.id = body.id;
  b.place = static_cast<std::uint32_t>(place);
  b.name = body.name;
  b.label = spec.label;
  b.look = spec.look;
  b.color = spec.color;
  b.outline = spec.outline;
  b.shape = in_dimension<3>(body.shape);
  b.box = solid(body.box());
  b.is_static = !body.moves();
  b.asleep = body.asleep;
  b.has_volume = body.collides;
  b.address = body.address;
  return b;
}

inline double size_of(double value) { return value; }
inline double size_of(const Vec<3>& value) { return glm::length(value); }

inline double about_own_axis(const Body<2>&, int) { return 0; }
inline double about_own_axis(const Body<3>& body, int axis) {
  return (glm::conjugate(body.orientation.q) * angular_velocity(body))[axis];
}

inline double deepest_of(BodyId id, const Frame& frame) {
  double deepest = 0;
  for (const FrameContact& contact : frame.contacts)
    if (contact.pair.a == id || contact.pair.b == id)
      for (const FrameContact::Point& point : contact.points)
        deepest = std::max(deepest, -point.separation);
  return deepest;
}

// Of its box, by the lecture's own code; of a body without a volume 0.
template <int D>
Vec<3> lecture_half_sizes(const Body<D>& body) {
  lecture::GameObject object(
      0, body.collides ? std::optional(in_dimension<3>(body.shape)) : std::nullopt);
  object.GetTransform().SetWorldPosition(solid(body.position));
  object.GetTransform().SetWorldOrientation(state_of(body).orientation.q);
  object.UpdateBroadphaseAABB();
  Vec<3> half_sizes(0.0);
  object.GetBroadphaseAABB(half_sizes);
  return half_sizes;
}

template <int D>
double measured(BodyMeasure what, const Body<D>& body, const World<D>& world, const Frame& frame) {
  const auto energy = [&] { return energy_of<D>(body, world.bodies(), world.forces()); };
  const Vec<3> position = solid(body.position);
  using M = BodyMeasure;
  if (what == M::energy) return energy().total();
  if (what == M::kinetic_energy) return energy().kinetic();
  if (what == M::potential_energy) return energy().potential();
  if (what == M::speed) return glm::length(body.velocity);
  if (what == M::spin) return size_of(angular_velocity(body));
  if (what == M::angular_momentum) return size_of(body.angular_momentum);
  if (what == M::own_spin_x) return about_own_axis(body, 0);
  if (what == M::own_spin_y) return about_own_axis(body, 1);
  if (what == M::own_spin_z) return about_own_axis(body, 2);
  if (what == M::x) return position.x;
  if (what == M::y) return position.y;
  if (what == M::z) return position.z;
  if (what == M::half_width) return lecture_half_sizes(body).x;
  if (what == M::half_height) return lecture_half_sizes(body).y;
  return deepest_of(body.id, frame);
}

// Bodies that the world shows, and links; no counts.
template <int D>
void picture_world(const Players<D>& players, Frame& frame) {
  const World<D>& world = players.world();
  for (const Body<D>& body : world.bodies())
    if (const BodySpec* spec = players.spec_of(body.id))
      frame.bodies.push_back(frame_body(body, *spec, *players.index_of(body.id)));
  players.for_each_link([&](const LinkSpec& spec, const Vec<D>& from, const Vec<D>& to,
                            double rest) {
    const bool has_length = spec.kind != LinkSpec::Kind::pin && rest > 0;
    constexpr double kMost = std::numeric_limits<double>::max();  // of next to no length
    const double strain = has_length ? std::min((glm::length(to - from) - rest) / rest, kMost) : 0;
    frame.add<FrameLinks>().links.push_back(
        {static_cast<FrameLink::Kind>(spec.kind), solid(from), solid(to), strain});
  });
}

// What pushes and pulls the bodies now: a script's forces, and springs.
template <int D>
void picture_forces(const Players<D>& players, Frame& frame) {
  const World<D>& world = players.world();
  const auto add = [&](const Body<D>& body, const Vec<D>& arm, const Vec<D>& force, bool spring) {
    frame.add<FrameForces>().forces.push_back(
        {body.id, solid(body.position + arm), solid(force), spring});
  };
  const auto shown = [&](BodyId id) {
    const Body<D>* body = world.find(id);
    return body && body->inverse_mass > 0 && players.spec_of(id) ? body : nullptr;
  };
  const auto motion_of = [](const Body<D>& body) {
    return EndMotion<D>{body.orientation, body.velocity, angular_velocity(body)};
  };
  for (const Push<D>& push : world.forces().pushes)
    if (const Body<D>* body = shown(push.body)) add(*body, push.at, push.force, false);
  for (const Spring<D>& spring : world.forces().springs) {
    const Body<D>*a = world.find(spring.a), *b = world.find(spring.b);
    if (!a || !b) continue;
    const Stretch<D> s =
        stretched(spring, Vec<D>(b->position - a->position), motion_of(*a), motion_of(*b));
    const Vec<D> pull = s.direction * s.tension;
    if (shown(a->id)) add(*a, s.arm_a, pull, true);
    if (shown(b->id)) add(*b, s.arm_b, -pull, true);
  }
}

// Energies, momenta, of joints the widest gap.
template <int D>
void measure_world(const Players<D>& players, const Scenario& scenario, Frame& frame) {
  const std::span<const Body<D>> bodies(players.world().bodies());
  const Energy now = energy(bodies, players.world().forces());
  frame.measures.insert(frame.measures.end(),
                        {{"energy", now.total()},
                         {"kinetic_energy", now.kinetic()},
                         {"potential_energy", now.potential()},
                         {"momentum", glm::length(momentum(bodies))},
                         {"angular_momentum", glm::length(angular_momentum<D>(bodies))}});
  if (scenario.has_joints()) frame.measures.emplace_back("joint_gap", widest_gap(players.world()));
}

// As the lecture's text has it, of the first pair that shares a leaf, kept or lost.
inline std::uint64_t key_of_first_pair(BodyId id, const Frame& frame) {
  for (const FrameNode& node : frame.nodes)
    for (const BodyId other : node.bodies) {
      if (other == id || std::ranges::count(node.bodies, id) == 0) continue;
      const auto [low, high] =
          std::minmax(frame.body_of(id)->address, frame.body_of(other)->address);
      return lecture::CollisionDetection::CollisionInfoAsPrinted{low, high}.GetHash();
    }
  return 0;
}

inline std::uint64_t count_of(BodyMeasure what, BodyId id, const Frame& frame) {
  if (what == BodyMeasure::pairs)
    return static_cast<std::uint64_t>(std::ranges::count_if(
        frame.pairs, [&](const FramePair& p) { return p.pair.a == id || p.pair.b == id; }));
  if (what == BodyMeasure::id) return id;
  if (what == BodyMeasure::address) return frame.body_of(id)->address;
  if (what == BodyMeasure::key) return key_of_first_pair(id, frame);
  const auto stored = stored_bodies(frame)[id];
  return what == BodyMeasure::leaves ? stored.leaves : stored.depth;
}

// What the scenario asks for of single bodies, as "energy.bob", of those that are there. Contacts,
// nodes and pairs must be in the frame.
template <int D>
void measure_bodies(const Players<D>& players, const Scenario& scenario, Frame& frame) {
  for (const BodyMeasureSpec& asked : scenario.body_measures) {
    const Body<D>* body = players.body(asked.body);
    if (!body) continue;
    if (!is_counted(asked.measure))
      frame.measures.emplace_back(asked.name,
                                  measured(asked.measure, *body, players.world(), frame));
    else if (frame.structure != StructureKind::none)
      frame.add_count(asked.name, count_of(asked.measure, body->id, frame));
  }
}

// By the lowest id in an island; the next new one gets the next number. Numbers are never used
// again, so that an island that has parted has its own back.
using IslandNumbers = std::map<BodyId, std::uint32_t>;

// Adds islands and edges as the world's last step found them, with what has left or let go since.
template <int D>
void picture_islands(const Players<D>& players, IslandNumbers& numbers, Frame& frame) {
  const World<D>& world = players.world();
  std::map<BodyId, FrameIsland> found;  // by the lowest id
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    const Body<D>& body = world.bodies()[i];
    const BodyId first = world.islands()[i];
    if (first == kNoIsland) continue;
    const auto number = static_cast<std::uint32_t>(numbers.size() + 1);
    FrameIsland& island = found[first];
    island.number = numbers.emplace(first, number).first->second;
    island.bodies.push_back(body.id);
    island.asleep = body.asleep;
  }
  auto& [islands, edges] = frame.add<FrameIslands>();
  for (auto& entry : found) islands.push_back(std::move(entry.second));
  std::ranges::sort(islands, {}, &FrameIsland::number);

  const auto is_seen = [&](BodyId id) { return world.find(id) && players.spec_of(id); };
  const auto add_edge = [&list = edges](const Pair& pair, bool tied) {
    list.push_back({{std::min(pair.a, pair.b), std::max(pair.a, pair.b)}, tied, false});
  };
  const auto tie = [&](const auto& link) {
    if (is_seen(link.a) && is_seen(link.b)) add_edge({link.a, link.b}, true);
  };
  for (const auto& entry : world.joints()) tie(entry.second);
  for (const Spring<D>& spring : world.forces().springs) tie(spring);
  for (const FrameContact& contact : frame.contacts) add_edge(contact.pair, false);
  // In order of ids, each pair once: what is tied may also touch.
  std::ranges::stable_sort(edges, {}, &FrameEdge::pair);
  const auto twice = std::ranges::unique(edges, {}, &FrameEdge::pair);
  edges.erase(twice.begin(), twice.end());
}

// Adds the counts of its islands.
inline void count_islands(Frame& frame) {
  const std::vector<FrameIsland>& islands = frame.get<FrameIslands>().islands;
  std::size_t largest = 0;
  for (const FrameIsland& island : islands) largest = std::max(largest, island.bodies.size());
  frame.add_count("islands", islands.size());
  frame.add_count("largest_island", largest);
  frame.add_count("islands_asleep",
                  static_cast<std::uint64_t>(std::ranges::count_if(islands, &FrameIsland::asleep)));
}

}  // namespace lantern::run
