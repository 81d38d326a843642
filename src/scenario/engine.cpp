#include "scenario/engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/check.hpp"
#include "physics/energy.hpp"
#include "physics/world.hpp"
#include "scenario/brains.hpp"
#include "scenario/structures.hpp"
#include "spatial/frustum_cull.hpp"
#include "spatial/overlap_query.hpp"
#include "spatial/pairs.hpp"
#include "spatial/raycast.hpp"

namespace lantern {
namespace {

template <int D>
WorldConfig<D> config_of(const Scenario& scenario, const StructureSpec& structure) {
  const WorldSpec& spec = scenario.world;
  WorldConfig<D> config;
  config.gravity = in_dimension<D>(spec.gravity);
  config.integrator = spec.integrator;
  config.contacts = spec.contacts == ContactChoice::soft      ? ContactMethod::soft
                    : spec.contacts == ContactChoice::impulse ? ContactMethod::impulse
                                                              : ContactMethod::none;
  config.sub_steps = spec.sub_steps;
  config.iterations = spec.iterations;
  config.may_sleep = spec.may_sleep;
  config.broad_phase = broad_phase_of<D>(structure, in_dimension<D>(spec.bounds));
  return config;
}

template <int D>
Spin<D> spin_of(double radians, const Vec<3>& axis) {
  if constexpr (D == 2)
    return radians;
  else
    return axis * radians;
}

template <int D>
Body<D> body_of(const BodySpec& spec) {
  Body<D> body;
  body.name = spec.name;
  body.shape = in_dimension<D>(spec.shape);
  body.kind = spec.kind;
  body.position = in_dimension<D>(spec.position);
  body.orientation = turned(Rotation<D>(), spin_of<D>(spec.angle, spec.axis));
  body.velocity = in_dimension<D>(spec.velocity);
  body.density = spec.density;
  body.mass = spec.mass;
  body.material = spec.material;
  body.linear_drag = spec.linear_drag;
  body.angular_drag = spec.angular_drag;
  body.may_turn = spec.may_turn;
  return body;
}

template <int D>
class EngineOf : public Engine {
 public:
  EngineOf(const Scenario& scenario, Work& work)
      : scenario_(scenario),
        work_(work),
        world_(config_of<D>(scenario, scenario.structure)),
        structures_(made(scenario.structure)),
        brains_(scenario),
        ids_(scenario.bodies.size()),
        linked_(scenario.links.size()) {
    ++work_.worlds_created;
  }

  void enter(std::size_t index) override {
    const BodySpec& spec = scenario_.bodies[index];
    ids_[index] = world_.add(body_of<D>(spec));
    index_of_.push_back(index);
    if (spec.spin != 0) world_.set_angular_velocity(*ids_[index], spin_of<D>(spec.spin, spec.axis));
    make_links();
    if (spec.asleep) world_.sleep(*ids_[index]);
  }

  void store(std::size_t index, const Watch& watch) override {
    const Body<D>* entered = body(index);
    LANTERN_CHECK(entered != nullptr, ==, true);
    structures_.insert(resident(*entered), watch);
  }

  void leave(std::size_t index) override {
    world_.remove(*ids_[index]);
    ids_[index].reset();
    for (std::size_t i = 0; i < linked_.size(); ++i)
      if (scenario_.links[i].a == index || scenario_.links[i].b == index) linked_[i] = false;
  }

  void move(const Move& move) override {
    const Body<D> before = *body(move.body);
    const Vec<D> to = move.to ? in_dimension<D>(*move.to) : before.position;
    const Vec<D> velocity = move.velocity ? in_dimension<D>(*move.velocity) : before.velocity;
    Rotation<D> orientation = before.orientation;
    const Vec<3>& axis = scenario_.bodies[move.body].axis;
    if (move.turned) orientation = turned(Rotation<D>(), spin_of<D>(*move.turned, axis));
    world_.place(before.id, to, velocity, orientation);
    if (move.spin) world_.set_angular_velocity(before.id, spin_of<D>(*move.spin, axis));
  }

  void apply(const ApplyForce& force) override {
    const Body<D>& pushed = *body(force.body);
    world_.clear_pushes(pushed.id);
    if (force.force != Vec<3>(0.0))
      world_.push(pushed.id, in_dimension<D>(force.force),
                  pushed.position + in_dimension<D>(force.at));
  }

  void apply(const ApplyImpulse& impulse) override {
    const Body<D>& struck = *body(impulse.body);
    world_.apply_impulse(struck.id, in_dimension<D>(impulse.impulse),
                         struck.position + in_dimension<D>(impulse.at));
  }

  void sleep(std::size_t index) override { world_.sleep(*ids_[index]); }
  void wake(std::size_t index) override { world_.wake(*ids_[index]); }

  void step() override {
    brains_.steer(world_, scenario_.world.time_step, [&](std::size_t i) { return ids_[i]; });
    world_.step(scenario_.world.time_step);
    ++work_.world_steps;
    time_ += scenario_.world.time_step;
    for (const ContactEvent& event : world_.events()) {
      begins_ += event.kind == ContactEvent::Kind::begin;
      ends_ += event.kind == ContactEvent::Kind::end;
    }
  }

  void rebuild() override {
    if (structures_.any()) structures_.rebuild(residents());
  }

  void rebuild_as(const StructureSpec& structure) override {
    structures_ = made(structure);
    world_.switch_broad_phase(
        broad_phase_of<D>(structure, in_dimension<D>(scenario_.world.bounds)));
    rebuild();
  }

  Finding cast(const CastRay& cast) const override {
    Ray<D> ray;
    ray.origin = in_dimension<D>(cast.from);
    const Vec<D> way = in_dimension<D>(cast.to) - ray.origin;
    ray.length = glm::length(way);
    ray.direction = way / ray.length;
    Finding found;
    found.ray = FrameRay{cast.from, cast.to, {}};
    const auto enters = [&](BodyId id) {
      const Body<D>& b = *world_.find(id);
      return entry(ray, b.shape, b.position, b.orientation);
    };
    std::vector<RayHit> hits;
    look(found, [&](const auto& tree, auto&& box_of, auto&& told) {
      if (cast.all) {
        const AllHits all = raycast_all<D>(tree, ray, box_of, enters, told);
        hits.insert(hits.end(), all.hits.begin(), all.hits.end());
        return all.counts;
      }
      const NearestHit nearest = raycast_nearest<D>(tree, ray, box_of, enters, told);
      if (nearest.hit) hits.push_back(*nearest.hit);
      return nearest.counts;
    });
    std::sort(hits.begin(), hits.end(), [](const RayHit& a, const RayHit& b) {
      return std::pair(a.distance, a.id) < std::pair(b.distance, b.id);
    });
    if (!cast.all && hits.size() > 1) hits.resize(1);
    for (const RayHit& hit : hits) {
      found.hits.push_back(hit.id);
      found.ray->hits.push_back({hit.id, solid(ray.at(hit.distance))});
    }
    if (!cast.all && !hits.empty()) found.ray->to = found.ray->hits[0].position;
    return found;
  }

  Finding cull(const Cull& view) const override {
    const Frustum<D> frustum = frustum_of(view);
    Finding found;
    found.view = FrameView{view.eye, corners_of(frustum)};
    look(found, [&](const auto& tree, auto&& box_of, auto&& told) {
      const Found seen = frustum_cull<D>(tree, frustum, box_of, AlwaysTrue(), told);
      found.hits.insert(found.hits.end(), seen.ids.begin(), seen.ids.end());
      return seen.counts;
    });
    std::sort(found.hits.begin(), found.hits.end());
    return found;
  }

  Finding query(const Query& region) const override {
    Finding found;
    found.region = FrameQuery{region.box, region.radius};
    const Box<D> box = in_dimension<D>(region.box);
    look(found, [&](const auto& tree, auto&& box_of, auto&& told) {
      const Found in = region.radius > 0
                           ? overlap_query<D>(tree, Ball<D>{box.center(), region.radius}, box_of,
                                              AlwaysTrue(), told)
                           : overlap_query<D>(tree, box, box_of, AlwaysTrue(), told);
      found.hits.insert(found.hits.end(), in.ids.begin(), in.ids.end());
      return in.counts;
    });
    std::sort(found.hits.begin(), found.hits.end());
    return found;
  }

  std::optional<BodyId> id_of(std::size_t index) const override { return ids_[index]; }

  bool is_moving(std::size_t index) const override {
    const Body<D>* b = body(index);
    return b && b->moves() && !b->asleep && b->velocity != Vec<D>(0.0);
  }

  bool has_happened(Wait::Event event, const std::vector<std::size_t>& bodies) const override {
    if (event == Wait::Event::asleep)
      return std::all_of(bodies.begin(), bodies.end(), [&](std::size_t i) {
        const Body<D>* b = body(i);
        return !b || b->asleep;
      });
    const BodyId first = *ids_[bodies[0]], second = *ids_[bodies[1]];
    const Pair wanted{std::min(first, second), std::max(first, second)};
    const auto kind =
        event == Wait::Event::touch ? ContactEvent::Kind::begin : ContactEvent::Kind::end;
    return std::any_of(world_.events().begin(), world_.events().end(), [&](const auto& e) {
      return e.kind == kind && e.a == wanted.a && e.b == wanted.b;
    });
  }

  std::string label_of(NodeHandle node) const override { return structures_.label_of(node); }
  const StructureSpec& structure() const override { return structures_.spec(); }
  void forget_events() override { begins_ = ends_ = 0; }

  void picture(const Touched& touched, Frame& frame) const override {
    frame.time = time_;
    frame.dimension = D;
    for (const Body<D>& body : world_.bodies())
      if (is_shown(body)) frame.bodies.push_back(frame_body(body));
    frame.counts.emplace_back("bodies", frame.bodies.size());
    if (scenario_.world.contacts != ContactChoice::none) picture_contacts(frame);
    picture_links(frame);
    structures_.picture(touched, residents(), frame);
    if (!structures_.any())
      frame.counts.emplace_back("all_pairs",
                                static_cast<std::int64_t>(all_pairs(frame.bodies.size())));
    count(frame);
    measure(frame);
  }

 private:
  Structures<D> made(const StructureSpec& spec) const {
    return Structures<D>(spec, in_dimension<D>(scenario_.world.bounds), only_awake(), work_);
  }

  // Where bodies collide or sleep, pairs of two that rest are of no interest.
  bool only_awake() const {
    return scenario_.world.contacts != ContactChoice::none || scenario_.world.may_sleep ||
           scenario_.structure.split_static;
  }

  const Body<D>* body(std::size_t index) const {
    return ids_[index] ? world_.find(*ids_[index]) : nullptr;
  }

  Resident<D> resident(const Body<D>& body) const {
    return {{body.id, body.box()}, !body.moves(), body.moves() && !body.asleep};
  }

  std::vector<Resident<D>> residents() const {
    std::vector<Resident<D>> all;
    for (const Body<D>& body : world_.bodies())
      if (is_shown(body)) all.push_back(resident(body));
    return all;
  }

  // Springs and joints come to be with the later of their bodies.
  void make_links() {
    for (std::size_t i = 0; i < linked_.size(); ++i) {
      const LinkSpec& link = scenario_.links[i];
      if (linked_[i] || !ids_[link.a] || (link.b && !ids_[*link.b])) continue;
      linked_[i] = true;
      add(link);
    }
  }

  // The ends of a link in the world. One that is tied to the world ends at a point of it.
  std::pair<Vec<D>, Vec<D>> ends_of(const LinkSpec& link) const {
    const auto point = [&](std::size_t index, const Vec<3>& at) {
      const Body<D>& b = *body(index);
      return b.position + matrix(b.orientation) * in_dimension<D>(at);
    };
    return {point(link.a, link.at_a),
            link.b ? point(*link.b, link.at_b) : in_dimension<D>(link.at_b)};
  }

  void add(const LinkSpec& link) {
    const auto [from, to] = ends_of(link);
    const double length = link.rest_length.value_or(glm::length(to - from));
    rest_length_.resize(linked_.size());
    rest_length_[static_cast<std::size_t>(&link - scenario_.links.data())] = length;
    const BodyId a = *ids_[link.a], b = link.b ? *ids_[*link.b] : add_anchor(to);
    const Vec<D> at_a = in_dimension<D>(link.at_a);
    const Vec<D> at_b = link.b ? in_dimension<D>(link.at_b) : Vec<D>(0.0);
    if (link.kind == LinkSpec::Kind::spring) {
      world_.add_spring({a, b, at_a, at_b, length, link.stiffness, link.damping});
      return;
    }
    Joint<D> joint;
    joint.kind = link.kind == LinkSpec::Kind::pin ? JointKind::pin : JointKind::distance;
    joint.a = a;
    joint.b = b;
    joint.at_a = at_a;
    joint.at_b = at_b;
    joint.length = length;
    world_.add_joint(joint);
  }

  // A point of the world is a static body without size, which is not pictured.
  BodyId add_anchor(const Vec<D>& at) {
    Body<D> anchor;
    anchor.name = "anchor";
    anchor.shape = Sphere{0};
    anchor.kind = BodyKind::static_body;
    anchor.position = at;
    index_of_.push_back(kAnchor);
    return world_.add(std::move(anchor));
  }

  bool is_shown(const Body<D>& body) const { return index_of_[body.id] != kAnchor; }

  // Walks every structure there is; without one, all bodies are asked.
  template <class F>
  void look(Finding& found, F&& f) const {
    const auto told = [&](const QueryEvent& event) { found.walk.push_back(event); };
    const auto box_of = [&](BodyId id) { return world_.find(id)->box(); };
    const auto add_counts = [&](const QueryCounts& counts) {
      found.counts.nodes_visited += counts.nodes_visited;
      found.counts.nodes_skipped += counts.nodes_skipped;
      found.counts.objects_tested += counts.objects_tested;
    };
    if (structures_.any()) {
      structures_.with_each([&](const auto& tree) { add_counts(f(tree, box_of, told)); });
      return;
    }
    BruteForce<D> all;
    for (const Resident<D>& r : residents()) all.insert(r.item);
    add_counts(f(all, box_of, told));
  }

  static Frustum<D> frustum_of(const Cull& view) {
    constexpr double kAspect = 16.0 / 9.0;
    if constexpr (D == 2)
      return view_wedge(flat(view.eye), flat(view.target - view.eye), view.angle, view.near,
                        view.far);
    else
      return view_frustum(view.eye, view.target, {0, 1, 0}, view.angle, kAspect, view.near,
                          view.far);
  }

  // Round the wedge, or round the near plane and then the far one.
  static std::vector<Vec<3>> corners_of(const Frustum<D>& frustum) {
    constexpr std::size_t kFlat[] = {0, 2, 3, 1}, kSolid[] = {0, 2, 6, 4, 1, 3, 7, 5};
    std::vector<Vec<3>> corners;
    for (const std::size_t i : std::span(D == 2 ? kFlat : kSolid, frustum.corners.size()))
      corners.push_back(solid(frustum.corners[i]));
    return corners;
  }

  FrameBody frame_body(const Body<D>& body) const {
    const BodySpec& spec = scenario_.bodies[index_of_[body.id]];
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

  void picture_contacts(Frame& frame) const {
    for (const Contact<D>& contact : world_.contacts()) {
      FrameContact c;
      c.pair = {contact.a, contact.b};
      c.normal = solid(contact.manifold.normal);
      c.begins = std::any_of(world_.events().begin(), world_.events().end(), [&](const auto& e) {
        return e.kind == ContactEvent::Kind::begin && e.a == contact.a && e.b == contact.b;
      });
      for (int i = 0; i < contact.manifold.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const auto& point = contact.manifold.room[k];
        c.points.push_back({solid(point.position), point.separation, contact.normal_impulses[k]});
      }
      frame.contacts.push_back(std::move(c));
    }
  }

  void picture_links(Frame& frame) const {
    for (std::size_t i = 0; i < linked_.size(); ++i) {
      if (!linked_[i]) continue;
      const LinkSpec& spec = scenario_.links[i];
      const auto [from, to] = ends_of(spec);
      const double rest = rest_length_[i];
      const double strain = spec.kind == LinkSpec::Kind::pin || rest == 0
                                ? 0
                                : (glm::length(to - from) - rest) / rest;
      frame.links.push_back(
          {static_cast<FrameLink::Kind>(spec.kind), solid(from), solid(to), strain});
    }
  }

  void count(Frame& frame) const {
    const auto add = [&](const char* name, std::uint64_t n) {
      frame.counts.emplace_back(name, static_cast<std::int64_t>(n));
    };
    const WorldWork& work = world_.work();
    if (scenario_.world.contacts != ContactChoice::none) {
      std::uint64_t points = 0;
      for (const FrameContact& c : frame.contacts) points += c.points.size();
      if (!structures_.any()) add("contacts", frame.contacts.size());
      add("contact_points", points);
      add("begins", begins_);
      add("ends", ends_);
      add("narrow_tests", work.narrow_tests);
      add("constraint_rows", work.constraint_rows);
      add("friction_rows", work.friction_rows);
    }
    if (scenario_.world.may_sleep || only_awake()) {
      std::uint64_t asleep = 0, awake = 0;
      for (const Body<D>& body : world_.bodies())
        if (body.moves()) ++(body.asleep ? asleep : awake);
      add("asleep", asleep);
      add("awake", awake);
    }
    if (!has_physics()) return;
    add("force_evaluations", work.force_evaluations);
    add("rotations", work.rotations_integrated);
  }

  void measure(Frame& frame) const {
    if (!has_physics()) return;
    const std::span<const Body<D>> bodies(world_.bodies());
    const Energy now = energy(bodies, world_.forces());
    frame.measures = {{"energy", now.total()},
                      {"kinetic_energy", now.kinetic()},
                      {"potential_energy", now.potential()},
                      {"momentum", glm::length(momentum(bodies))},
                      {"angular_momentum", glm::length(angular_momentum<D>(bodies))}};
    double deepest = 0;
    for (const FrameContact& c : frame.contacts)
      for (const auto& point : c.points) deepest = std::max(deepest, -point.separation);
    if (scenario_.world.contacts != ContactChoice::none)
      frame.measures.emplace_back("penetration", deepest);
  }

  // More than free flight.
  bool has_physics() const {
    return scenario_.world.contacts != ContactChoice::none ||
           scenario_.world.gravity != Vec<3>(0.0) || !scenario_.links.empty();
  }

  static constexpr std::size_t kAnchor = std::numeric_limits<std::size_t>::max();

  const Scenario& scenario_;
  Work& work_;
  World<D> world_;
  Structures<D> structures_;
  Brains<D> brains_;
  std::vector<std::optional<BodyId>> ids_;  // of the scenario's bodies
  std::vector<std::size_t> index_of_;       // of a body id, in the scenario; or kAnchor
  std::vector<bool> linked_;                // which of the scenario's links are there
  std::vector<double> rest_length_;         // of those
  std::uint64_t begins_ = 0;
  std::uint64_t ends_ = 0;
  double time_ = 0;
};

}  // namespace

std::unique_ptr<Engine> make_engine(const Scenario& scenario, Work& work) {
  if (scenario.world.dimension == 3) return std::make_unique<EngineOf<3>>(scenario, work);
  return std::make_unique<EngineOf<2>>(scenario, work);
}

}  // namespace lantern
