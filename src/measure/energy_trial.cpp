#include "measure/energy_trial.hpp"

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "geometry/random_vec.hpp"
#include "physics/forces.hpp"

namespace lantern::measure {
namespace {

constexpr double kAtRest = 1e-3;  // units a second: slower than this counts as this

template <int D>
double moving_mass(const World<D>& world) {
  double mass = 0;
  for (const Body<D>& body : world.bodies())
    if (body.inverse_mass > 0) mass += 1 / body.inverse_mass;
  return mass;
}

// Joules that raise everything by `depth`.
template <int D>
double lifted_by(const World<D>& world, double depth) {
  double force = glm::length(world.forces().gravity) * moving_mass(world);
  for (const Push<D>& push : world.forces().pushes) force += glm::length(push.force);
  return force * depth;
}

// Of two bodies, at their deepest; 0 if they do not overlap.
template <int D>
double overlap_between(const Body<D>& a, const Body<D>& b) {
  const auto manifold = collide<D>(placed(a), placed(b), 0.0);
  return manifold ? manifold->depth() : 0;
}

constexpr double kRoom = 2.5;   // bodies start within so many units of the middle
constexpr double kTight = 0.8;  // and where they shall overlap, within these
constexpr int kTries = 20;      // to find a place without overlap
constexpr std::array kMethods = {Integrator::semi_implicit_euler, Integrator::velocity_verlet,
                                 Integrator::runge_kutta_4, Integrator::implicit_midpoint,
                                 Integrator::implicit_euler};

template <int D>
class SceneMaker {
 public:
  SceneMaker(std::uint64_t seed, ContactMethod method) : random_(seed), world_(config(method)) {
    has("spinning", spinning_ && !still_);
    Vec<D> up(0.0), right(0.0);
    up.y = 1;
    right.x = 1;
    const bool floor = has("floor", !one_in(4)), walls = has("walls", one_in(4));
    if (floor) put_side(up);
    if (walls) put_side(right);
    if (walls) put_side(-right);
    const std::int64_t count = random_.whole(2, one_in(3) ? 3 : 12);
    for (std::int64_t i = 0; i < count; ++i) put_body();
    if (pushed_ && !placed_.empty()) push();
  }

  EnergyTrial run(const WatchEnergy& watch) {
    const int steps = std::clamp(static_cast<int>(1.5 / step_), 30, 240);
    return follow_energy<D>(world_, step_, steps, watch);
  }

  std::string text(std::uint64_t seed) const {
    const WorldConfig<D>& config = world_.config();
    return fmt::format(
        "seed {}: {}D, {}, h {:.3g}, {} sub-steps, {} sweeps, {} bodies, {} joints{}", seed, D,
        to_string(config.integrator), step_, config.sub_steps, config.iterations, placed_.size(),
        world_.joints().size(), words_);
  }

 private:
  // Says so, too.
  bool has(const char* what, bool it) {
    if (it) words_ += fmt::format(", {}", what);
    return it;
  }
  bool one_in(int n) { return random_.whole(1, n) == 1; }
  bool coin() { return one_in(2); }
  double power(double lo, double hi) {  // as likely in any decade
    return lo * std::pow(hi / lo, random_.unit());
  }
  double part() { return one_in(3) ? 0 : one_in(3) ? 1 : random_.unit(); }  // 0, 1, or between

  WorldConfig<D> config(ContactMethod method) {
    WorldConfig<D> config;
    config.contacts = method;
    if (has("gravity", coin())) config.gravity.y = -10;
    config.integrator = kMethods[static_cast<std::size_t>(random_.whole(0, kMethods.size() - 1))];
    config.sub_steps = static_cast<int>(random_.whole(1, 16));
    config.iterations = static_cast<int>(random_.whole(1, 50));
    return config;
  }

  void put_side(const Vec<D>& normal) {
    Body<D> body{.name = "side", .shape = HalfSpace<D>{normal}, .kind = BodyKind::static_body};
    body.position = -normal * kRoom;
    body.material = {part(), random_.unit()};
    world_.add(body);
  }

  Shape<D> shape() {
    const double size = random_.between(0.2, 1);
    const double thin = slender_ ? size / power(1, 1000) : size * random_.between(0.3, 1);
    const std::int64_t kind = random_.whole(0, 3);
    if (kind == 0) return Sphere{size};
    if (kind == 1) return Capsule{thin, size};
    Vec<D> half(thin);
    half.x = size;
    if (kind == 2) half[D - 2] = size;  // a plate, of a solid world
    return OrientedBox<D>{half};
  }

  Spin<D> spin() {
    const double rate = spinning_ ? power(1, 1e4) : random_.unit();
    if constexpr (D == 2)
      return coin() ? rate : -rate;
    else
      return random_direction<3>(random_) * rate;
  }

  // A point of the body where a joint may hold it, in its own axes: on the way to its end.
  Vec<D> hold(const Shape<D>& shape) {
    const Core<D> core = visit_shape<D>(
        shape, [](const Core<D>& c) { return c; }, [](auto&) { return Core<D>{}; });
    return core.half * random_.between(-1, 1);
  }

  void put_body() {
    Body<D> body{.name = fmt::format("b{}", placed_.size()), .shape = shape()};
    body.orientation = random_rotation<D>(random_);
    if (!still_) body.velocity = random_direction<D>(random_) * random_.between(0, 10);
    body.mass = heavy_ ? power(1, 1e6) : 1;
    body.material = {part(), part()};
    std::optional<Joint<D>> joint = new_joint(body);
    bool free = false;
    for (int i = 0; i < kTries && !free; ++i) {
      const bool pinned = joint && joint->kind == JointKind::pin;
      if (pinned && i > 0) joint.reset();  // there is no room where it would hold the body
      body.position = pinned && i == 0
                          ? end_at_a(*joint) - matrix(body.orientation) * joint->at_b
                          : random_point<D>(random_, -1, 1) * (overlapping_ ? kTight : kRoom);
      free = overlapping_ || std::ranges::none_of(world_.bodies(), [&](const Body<D>& other) {
               return !(joint && joint->a == other.id) && overlap_between(other, body) > 0;
             });
    }
    if (!free) return;
    placed_.push_back(world_.add(body));
    if (!still_) world_.set_angular_velocity(placed_.back(), spin());
    if (!joint) return;
    joint->b = placed_.back();
    if (joint->kind == JointKind::distance)
      joint->length =
          glm::length(end_at_a(*joint) - body.position - matrix(body.orientation) * joint->at_b);
    world_.add_joint(*joint);
  }

  // To the body before; it waits for the place of the other one.
  std::optional<Joint<D>> new_joint(const Body<D>& body) {
    if (!jointed_ || placed_.empty() || one_in(3)) return std::nullopt;
    Joint<D> joint{.kind = coin() ? JointKind::pin : JointKind::distance, .a = placed_.back()};
    joint.at_a = hold(world_.find(joint.a)->shape);
    joint.at_b = hold(body.shape);
    return joint;
  }

  Vec<D> end_at_a(const Joint<D>& joint) const {
    const Body<D>& a = *world_.find(joint.a);
    return a.position + matrix(a.orientation) * joint.at_a;
  }

  void push() {
    const Body<D>& body = *world_.find(placed_.front());
    const double force = random_.between(1, 20) * body.mass;
    world_.push(body.id, random_direction<D>(random_) * force, body.position);
  }

  Random random_;
  std::string words_;  // ", slender, floor"
  bool slender_ = has("slender", coin()), spinning_ = coin(), heavy_ = has("mass ratios", coin());
  bool still_ = has("still", one_in(4)), overlapping_ = has("overlapping", one_in(4));
  bool jointed_ = one_in(3), pushed_ = has("pushed", one_in(6));
  World<D> world_;
  double step_ = power(1.0 / 240, 1.0 / 10);
  std::vector<BodyId> placed_;
};

}  // namespace

template <int D>
double overlap_of(const World<D>& world) {
  const auto& bodies = world.bodies();
  double depth = 0;
  for (std::size_t j = 0; j < bodies.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Body<D>&a = bodies[i], &b = bodies[j];
      const bool meet = a.collides && b.collides && (a.moves() || b.moves());
      if (meet && !pass_through(world, a.id, b.id)) depth += overlap_between(a, b);
    }
  return depth;
}

template <int D>
EnergyTrial follow_energy(World<D>& world, double step, int steps, const WatchEnergy& watch) {
  EnergyTrial trial{-std::numeric_limits<double>::infinity(), 0, {}};
  const auto look = [&](EnergyMoment& moment) {
    const Energy now = energy<D>(world.bodies(), world.forces());
    moment.time = world.time();
    moment.energy = now.total();
    for (const Push<D>& push : world.forces().pushes)
      moment.energy -= glm::dot(push.force, world.find(push.body)->position);
    moment.kinetic = std::max(moment.kinetic, now.kinetic());
  };
  EnergyMoment moment;
  moment.kinetic = moving_mass(world) * kAtRest * kAtRest / 2;
  look(moment);
  moment.permitted = moment.energy + lifted_by(world, overlap_of(world));
  try {
    for (int i = 0; i <= steps; ++i) {
      if (i > 0) {
        world.step(step);
        look(moment);
      }
      if (watch) watch(moment);
      if (moment.excess() > trial.excess) trial = {moment.excess(), moment.time, {}};
    }
  } catch (const Refused& refused) {
    trial = {std::numeric_limits<double>::infinity(), world.time(), refused.what()};
  }
  return trial;
}

template double overlap_of(const World<2>&);
template double overlap_of(const World<3>&);
template EnergyTrial follow_energy(World<2>&, double, int, const WatchEnergy&);
template EnergyTrial follow_energy(World<3>&, double, int, const WatchEnergy&);

EnergyTrial random_trial(std::uint64_t seed, ContactMethod method, const WatchEnergy& watch) {
  if (seed % 2 == 0) return SceneMaker<2>(seed, method).run(watch);
  return SceneMaker<3>(seed, method).run(watch);
}

std::string random_scene_text(std::uint64_t seed) {
  if (seed % 2 == 0) return SceneMaker<2>(seed, ContactMethod::soft).text(seed);
  return SceneMaker<3>(seed, ContactMethod::soft).text(seed);
}

}  // namespace lantern::measure
