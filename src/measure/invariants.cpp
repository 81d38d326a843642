#include "measure/invariants.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "physics/forces.hpp"
#include "physics/manifold.hpp"
#include "run/players.hpp"

namespace lantern::measure {
namespace {

template <int D>
class Model {
 public:
  explicit Model(const Scenario& scenario)
      : collides_(scenario.world.contacts != ContactMethod::none), players_(scenario) {
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) players_.enter(i);
  }

  Kept operator()(const std::vector<BodyState>& states, const Skins& skins) const {
    auto bodies = players_.world().bodies();
    for (Body<D>& body : bodies)
      if (const auto index = players_.index_of(body.id)) put(body, states[*index]);
    const std::span<const Body<D>> all(bodies);
    const Energy energy = physics::energy(all, players_.world().forces());
    Kept kept{.energy = energy.total(),
              .kinetic_energy = energy.kinetic(),
              .spring_energy = energy.springs,
              .momentum = solid(momentum(all))};
    if constexpr (D == 2)
      kept.angular_momentum.z = angular_momentum<D>(all);
    else
      kept.angular_momentum = angular_momentum<D>(all);
    for (const Body<D>& body : bodies) add_flow(body, kept);
    if (collides_) add_overlaps(bodies, skins, kept);
    return kept;
  }

 private:
  static void put(Body<D>& body, const BodyState& state) {
    if (!state.there) return make_absent(body);
    body.position = in_dimension<D>(state.position);
    body.velocity = in_dimension<D>(state.velocity);
    if constexpr (D == 2) {
      body.orientation.angle = state.angle;
      body.angular_momentum = state.angular_momentum.z;
    } else {
      body.orientation = state.orientation;
      body.angular_momentum = state.angular_momentum;
    }
  }

  // Counts as nothing and meets nothing.
  static void make_absent(Body<D>& body) {
    body.kind = BodyKind::static_body;
    body.inverse_mass = 0;
    body.inverse_inertia = Spin<D>(0.0);
    body.shape = Sphere{0};
    body.velocity = Vec<D>(0.0);
  }

  static void add_flow(const Body<D>& body, Kept& kept) {
    if (body.kind != BodyKind::dynamic_body || body.inverse_mass == 0) return;
    const Vec<D> mv = body.velocity / body.inverse_mass;
    kept.flow += glm::length(mv);
    if constexpr (D == 2)
      kept.swirl += std::abs(cross(body.position, mv)) + std::abs(body.angular_momentum);
    else
      kept.swirl += glm::length(cross(body.position, mv)) + glm::length(body.angular_momentum);
  }

  // Of all pairs that meet, found by a sweep along the axis x.
  void add_overlaps(const std::vector<Body<D>>& bodies, const Skins& skins, Kept& kept) const {
    struct Boxed {
      std::size_t body;
      double skin;
      Box<D> box;  // with its skin
    };
    std::vector<Boxed> order;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const auto index = players_.index_of(bodies[i].id);
      if (!index) continue;
      const double skin = skins.of.empty() ? 0 : skins.of[*index], reach = skin + skins.nearly;
      const Box<D> box = bodies[i].box();
      order.push_back({i, skin, {box.lo - reach, box.hi + reach}});
    }
    std::ranges::stable_sort(order, {}, [](const Boxed& b) { return b.box.lo.x; });
    for (std::size_t m = 0; m < order.size(); ++m)
      for (std::size_t n = m + 1; n < order.size(); ++n) {
        if (order[n].box.lo.x > order[m].box.hi.x) break;
        if (!overlap(order[m].box, order[n].box)) continue;
        const auto [i, j] = std::minmax(order[m].body, order[n].body);
        add_pair(bodies[i], bodies[j], order[m].skin + order[n].skin, skins.nearly, kept);
      }
  }

  void add_pair(const Body<D>& a, const Body<D>& b, double skin, double nearly, Kept& kept) const {
    if (!a.moves() && !b.moves()) return;  // they may overlap
    if (pass_through(players_.world(), a.id, b.id)) return;
    const auto manifold = collide<D>(placed(a), placed(b), skin + nearly);
    if (!manifold) return;
    const double depth = std::max(0.0, skin - manifold->least_separation());
    ++kept.touching;
    kept.overlapping += depth > 0;
    kept.penetrations += depth;
    kept.penetration = std::max(kept.penetration, depth);
  }

  bool collides_;
  Players<D> players_;
};

}  // namespace

Invariants::Invariants(const Scenario& scenario) {
  const WorldSpec& world = scenario.world;
  const auto model = [&]<int D>(std::integral_constant<int, D>) {
    of_ = [m = std::make_shared<Model<D>>(scenario)](const auto& states, const Skins& skins) {
      return (*m)(states, skins);
    };
  };
  world.dimension == 3 ? model(std::integral_constant<int, 3>())
                       : model(std::integral_constant<int, 2>());
  const bool collides = world.contacts != ContactMethod::none;
  bool drags = false, damps = false, tied = false, rough = false, walls = false, steered = false;
  for (const BodySpec& body : scenario.bodies) {
    drags = drags || body.linear_drag > 0 || body.angular_drag > 0;
    rough = rough || body.material.friction > 0 ||
            (body.kind == BodyKind::dynamic_body && body.material.restitution < 1);
    walls = walls || body.kind != BodyKind::dynamic_body;
    steered = steered || body.brain != Brain::none;
  }
  for (const LinkSpec& link : scenario.links) {
    damps = damps || link.damping > 0;
    const auto held = [&](std::size_t i) {
      return scenario.bodies[i].kind != BodyKind::dynamic_body;
    };
    tied = tied || !link.b || held(link.a) || held(*link.b);
  }
  bool pushed = steered;  // a script may do what it likes
  int inserts = 0;        // what enters late brings its own
  for (const Step& step : scenario.steps) {
    pushed = pushed || std::holds_alternative<ApplyForce>(step.verb) ||
             std::holds_alternative<ApplyImpulse>(step.verb) ||
             std::holds_alternative<Move>(step.verb) || std::holds_alternative<Remove>(step.verb) ||
             std::holds_alternative<Emit>(step.verb);
    inserts += std::holds_alternative<Insert>(step.verb);
  }
  pushed = pushed || (!scenario.problem && inserts > 1);
  keeps_energy_ = !pushed && !drags && !damps && (!collides || !rough);
  // What attracts without moving itself holds the others; at the origin it does not turn them.
  bool held = false, held_aside = false;
  for (const BodySpec& body : scenario.bodies) {
    const bool holds =
        world.gravitation > 0 && body.kind != BodyKind::dynamic_body && body.mass > 0;
    held = held || holds;
    held_aside = held_aside || (holds && body.position != Vec<3>(0.0));
  }
  const bool alone = !pushed && !drags && !tied && world.gravity == Vec<3>(0.0);
  const bool meets = collides && walls;
  keeps_momentum_ = alone && !meets && !held;
  keeps_angular_momentum_ = alone && !meets && !held_aside;
}

void DriftMeter::look(const std::vector<BodyState>& states) {
  const Kept now = invariants_.of(states);
  penetration_ = std::max(penetration_, now.penetration);
  if (!begun_) {
    start_ = now;
    begun_ = true;
    return;
  }
  const auto stored = [](const Kept& kept) { return kept.energy - kept.kinetic_energy; };
  most_fallen_ = std::max(most_fallen_, stored(start_) - stored(now));
  energy_ = std::max(energy_, std::abs(now.energy - start_.energy));
  momentum_ = std::max(momentum_, glm::length(now.momentum - start_.momentum));
  angular_momentum_ =
      std::max(angular_momentum_, glm::length(now.angular_momentum - start_.angular_momentum));
}

double DriftMeter::energy_scale() const {
  const double energy = start_.kinetic_energy + start_.spring_energy;
  return energy > 0 ? energy : most_fallen_;
}

Drift DriftMeter::drift() const {
  const auto relative = [](double change, double scale) { return scale > 0 ? change / scale : 0; };
  Drift drift;
  if (invariants_.keeps_energy()) drift.energy = relative(energy_, energy_scale());
  if (invariants_.keeps_momentum()) drift.momentum = relative(momentum_, start_.flow);
  if (invariants_.keeps_angular_momentum())
    drift.angular_momentum = relative(angular_momentum_, start_.swirl);
  return drift;
}

}  // namespace lantern::measure
