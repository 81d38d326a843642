// A warning of energy that grows although nothing drives it.
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "base/check.hpp"
#include "physics/body.hpp"
#include "physics/forces.hpp"
#include "physics/joint.hpp"
#include "run/watcher.hpp"

namespace lantern::run {
namespace {

// Growth above the least since the last drive, as a part of what the motion has had at most. Good
// integrators let the energy swing with the step by less than this at any step that is of use.
constexpr double kMostGrowth = 0.2;
// To lift all bodies by this part of their thickness is the least that counts: what rests is never
// quite at rest.
constexpr double kStir = 0.01;

double mass_of(const BodySpec& body, int dimension) {
  if (body.mass > 0) return body.mass;
  return dimension == 2 ? physics::mass_of<2>(in_dimension<2>(body.shape), body.density).mass
                        : physics::mass_of<3>(body.shape, body.density).mass;
}

class EnergyWatch : public Watcher {
 public:
  EnergyWatch(const Scenario& scenario, bool free) : scenario_(scenario), free_(free) {
    const WorldSpec& world = scenario.world;
    for (const BodySpec& body : scenario.bodies)
      if (body.kind == BodyKind::dynamic_body)
        motion_.floor += kStir * mass_of(body, world.dimension) * glm::length(world.gravity) *
                         thickness(body.shape, world.dimension);
  }

  void begin(const Step& step) override {
    if (const auto* force = std::get_if<ApplyForce>(&step.verb)) {
      if (force->force == Vec<3>(0.0))
        pushed_.erase(force->body);
      else
        pushed_.insert(force->body);
    }
    if (const auto* bodies = entering(step.verb))
      for (const std::size_t i : *bodies)
        if (drives(scenario_.bodies[i])) drivers_.insert(i);
    if (const auto* remove = std::get_if<Remove>(&step.verb))
      for (const std::size_t i : remove->bodies) {
        drivers_.erase(i);
        pushed_.erase(i);
      }
    if (const auto* move = std::get_if<Move>(&step.verb))
      if (scenario_.bodies[move->body].kind == BodyKind::kinematic_body &&
          (move->velocity.value_or(Vec<3>(0.0)) != Vec<3>(0.0) || move->spin.value_or(0) != 0))
        drivers_.insert(move->body);
    const bool changes =
        entering(step.verb) || std::holds_alternative<Remove>(step.verb) ||
        std::holds_alternative<Move>(step.verb) || std::holds_alternative<ApplyForce>(step.verb) ||
        std::holds_alternative<ApplyImpulse>(step.verb) || std::holds_alternative<Sleep>(step.verb);
    if (changes) motion_.forget();
  }

  // Free bodies have no energy on their frames, so it is taken from the world.
  void see_world(const Players<2>& players) override { add(players); }
  void see_world(const Players<3>& players) override { add(players); }

  void see_frame(const Frame& frame) override {
    frame_ = frame.index;
    if (free_) return;
    count(frame.bodies.size());
    const auto kinetic = frame.measure("kinetic_energy");
    const auto potential = frame.measure("potential_energy");
    if (kinetic && potential) add(*kinetic, *potential, frame.time);
  }

  std::vector<Diagnostic> warnings() const override {
    if (!grown_) return {};
    const WorldSpec& world = scenario_.world;
    return {warning(
        scenario_, world.place_of({"integrator", "rotation", "time_step"}),
        fmt::format("energy grows from {:.4g} J at {:.4g} s to {:.4g} J at {:.4g} s (frame {}), "
                    "and nothing drives it",
                    grown_->least, grown_->since, grown_->energy, grown_->time, grown_->frame),
        fmt::format("give [world] {}a time_step below {:.3g} s", gaining(), world.time_step) +
            if_meant(scenario_, Warning::energy))};
  }

 private:
  struct Growth {
    double least = 0, since = 0, energy = 0, time = 0;
    std::uint32_t frame = 0;
  };

  // What has been seen of the motion.
  struct Motion {
    static constexpr double kNone = std::numeric_limits<double>::infinity();
    double floor = 0;
    double most_kinetic = 0;  // of the whole run
    double widest = 0;        // of the potential energy, while nothing drives
    double least = kNone;     // energy since the last drive, and its time
    double since = 0;
    double low = kNone, high = -kNone;  // potential energy since then
    void forget() { least = low = kNone, high = -kNone; }
    double scale() const { return most_kinetic + widest + floor; }
  };

  static bool drives(const BodySpec& body) {
    return body.brain != Brain::none || (body.kind == BodyKind::kinematic_body &&
                                         (body.velocity != Vec<3>(0.0) || body.spin != 0));
  }

  // Methods that are known to gain, if a body moves or turns by one.
  std::string gaining() const {
    const WorldSpec& world = scenario_.world;
    std::string advice;
    for (const BodySpec& body : scenario_.bodies) {
      if (body.kind != BodyKind::dynamic_body) continue;
      if (body.integrator.value_or(world.integrator) == Integrator::explicit_euler)
        return "an integrator other than \"explicit_euler\", or ";
      if (body.rotation.value_or(world.rotation) == RotationMethod::explicit_gyroscopic)
        advice = "a rotation other than \"explicit_gyroscopic\", or ";
    }
    return advice;
  }

  // In the midst of an insertion, or while bodies enter one after another.
  void count(std::size_t bodies) {
    if (bodies != bodies_) motion_.forget();
    bodies_ = bodies;
  }

  template <int D>
  void add(const Players<D>& players) {
    if (!free_) return;
    count(players.world().bodies().size());
    const Energy now =
        energy(std::span<const Body<D>>(players.world().bodies()), players.world().forces());
    add(now.kinetic(), now.potential(), players.world().time());
  }

  void add(double kinetic, double potential, double time) {
    if (grown_) return;
    if (!pushed_.empty() || !drivers_.empty()) return motion_.forget();
    Motion& m = motion_;
    const double energy = kinetic + potential;
    m.most_kinetic = std::max(m.most_kinetic, kinetic);
    m.low = std::min(m.low, potential);
    m.high = std::max(m.high, potential);
    m.widest = std::max(m.widest, m.high - m.low);
    if (energy < m.least) {
      m.least = energy;
      m.since = time;
    } else if (energy - m.least > kMostGrowth * m.scale()) {
      grown_ = Growth{m.least, m.since, energy, time, frame_};
    }
  }

  const Scenario& scenario_;
  bool free_;                      // no force, no contact
  std::set<std::size_t> pushed_;   // bodies upon which a force of the script acts
  std::set<std::size_t> drivers_;  // bodies that move as they like
  Motion motion_;
  std::uint32_t frame_ = 0;
  std::size_t bodies_ = 0;
  std::optional<Growth> grown_;
};

constexpr double kMostGap = 0.01;  // of the smaller body's length

// From end to end, in the direction in which it is longest.
double length_of(const Shape<3>& shape) {
  const auto of_core = [](const Core<3>& core) {
    return 2 * (core.radius + std::max({core.half.x, core.half.y, core.half.z}));
  };
  return visit_shape<3>(shape, of_core, [](const HalfSpace<3>&) { return 0.0; });
}

class JointWatch : public Watcher {
 public:
  explicit JointWatch(const Scenario& scenario)
      : scenario_(scenario), worst_(scenario.links.size()) {
    for (const LinkSpec& link : scenario.links) {
      const double a = length_of(scenario.bodies[link.a].shape);
      const double b = link.b ? length_of(scenario.bodies[*link.b].shape) : 0;
      lengths_.push_back(a > 0 && b > 0 ? std::min(a, b) : std::max(a, b));
    }
  }

  void see_world(const Players<2>& players) override { look(players); }
  void see_world(const Players<3>& players) override { look(players); }

  // Those that part the most come first.
  std::vector<Diagnostic> warnings() const override {
    std::vector<std::size_t> parted;
    for (std::size_t i = 0; i < worst_.size(); ++i)
      if (worst_[i].share > kMostGap) parted.push_back(i);
    std::ranges::stable_sort(parted, std::greater(),
                             [&](std::size_t i) { return worst_[i].share; });
    Diagnostics found;
    for (const std::size_t i : parted) found.add([&] { return parting(i); });
    return found.list("joints part");
  }

  bool has_fact() const override { return true; }
  std::string fact() const override {
    const auto widest = std::ranges::max_element(worst_, {}, &Gap::size);
    std::string told = fmt::format("joints parted by at most {:.2g}", widest->size);
    if (widest->size > 0)
      told += fmt::format(", {} at {:.4g} s",
                          named(scenario_.links[static_cast<std::size_t>(widest - worst_.begin())]),
                          widest->time);
    return told;
  }

 private:
  struct Gap {
    double size = 0;
    double share = 0;  // of the bodies' length
    double time = 0;
  };

  template <int D>
  void look(const Players<D>& players) {
    players.for_each_link(
        [&](const LinkSpec& link, const Vec<D>& from, const Vec<D>& to, double rest) {
          if (link.kind == LinkSpec::Kind::spring) return;
          const bool pin = link.kind == LinkSpec::Kind::pin;
          const double gap = physics::joint_gap<D>(
              pin ? physics::JointKind::pin : physics::JointKind::distance, rest, from, to);
          const auto i = static_cast<std::size_t>(&link - scenario_.links.data());
          LANTERN_CHECK(i, <, worst_.size());
          if (!(gap > worst_[i].size)) return;
          const double length = lengths_[i] > 0 ? lengths_[i] : rest;
          worst_[i] = {gap, length > 0 ? gap / length : 0, players.world().time()};
        });
  }

  // "the pin from 'a' to 'b'"
  std::string named(const LinkSpec& link) const {
    const std::string& a = scenario_.bodies[link.a].name;
    const char* kind = link.kind == LinkSpec::Kind::pin ? "pin" : "rod";
    return link.b ? fmt::format("the {} from '{}' to '{}'", kind, a, scenario_.bodies[*link.b].name)
                  : fmt::format("the {} of '{}'", kind, a);
  }

  Diagnostic parting(std::size_t i) const {
    const LinkSpec& link = scenario_.links[i];
    return warning(
        scenario_, link.where,
        fmt::format("{} {} by {:.3g} at {:.4g} s, {:.3g} % of its bodies' size", named(link),
                    link.kind == LinkSpec::Kind::pin ? "parts" : "stretches", worst_[i].size,
                    worst_[i].time, 100 * worst_[i].share),
        firmer(scenario_.world));
  }

  const Scenario& scenario_;
  std::vector<double> lengths_;  // of the smaller body of each link
  std::vector<Gap> worst_;       // of each link
};

}  // namespace

Watching watch_energy(const Scenario& scenario) {
  const bool forces = scenario.has_physics();
  // A free body's energy can grow only by the way it turns.
  const bool turns =
      scenario.world.dimension == 3 &&
      std::ranges::any_of(scenario.bodies, [](const BodySpec& body) { return body.spin != 0; });
  if (!scenario.has_body_of(BodyKind::dynamic_body) || (!forces && !turns)) return nullptr;
  return std::make_unique<EnergyWatch>(scenario, !forces);
}

// A warning of joints whose ends part.

Watching watch_joints(const Scenario& scenario) {
  return scenario.has_joints() ? std::make_unique<JointWatch>(scenario) : nullptr;
}

}  // namespace lantern::run
