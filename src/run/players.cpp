#include "run/players.hpp"

#include <map>

#include "base/stop.hpp"

namespace lantern::run {
namespace {

// Entries and nodes of one tree; more are refused.
constexpr std::uint64_t kMostEntries = 2'000'000;

template <int D>
std::vector<BspPlane<D>> planes_of(const StructureSpec& spec) {
  std::vector<BspPlane<D>> planes;
  std::map<std::string, std::uint32_t> node_at;  // way from the root -> index
  for (const PlaneSpec& p : spec.planes) {
    BspPlane<D> plane{Plane<D>::through(in_dimension<D>(p.point), in_dimension<D>(p.normal)), kNone,
                      false};
    if (p.at != "root") {
      const std::size_t dot = p.at.rfind('.');
      const std::string parent = dot == std::string::npos ? "root" : p.at.substr(0, dot);
      plane.parent = node_at.at(parent);
      plane.front = p.at.substr(dot == std::string::npos ? 0 : dot + 1) == "front";
    }
    node_at[p.at] = static_cast<std::uint32_t>(planes.size());
    planes.push_back(plane);
  }
  return planes;
}

template <int D>
WorldConfig<D> config_of(const Scenario& scenario) {
  const WorldSpec& spec = scenario.world;
  return {.gravity = in_dimension<D>(spec.gravity),
          .gravitation = spec.gravitation,
          .integrator = spec.integrator,
          .rotation = spec.rotation,
          .contacts = spec.contacts,
          .broad_phase = broad_phase_of<D>(scenario.structure, in_dimension<D>(spec.bounds)),
          .sub_steps = spec.sub_steps,
          .wanted_error = spec.wanted_error,
          .iterations = spec.iterations,
          .may_sleep = spec.may_sleep,
          .impact_budget = spec.impact_budget};
}

template <int D>
Body<D> body_of(const BodySpec& spec) {
  return {.name = spec.name,
          .shape = in_dimension<D>(spec.shape),
          .kind = spec.kind,
          .position = in_dimension<D>(spec.position),
          .orientation = turned(Rotation<D>(), spin_about<D>(spec.axis, spec.angle)),
          .velocity = in_dimension<D>(spec.velocity),
          .density = spec.density,
          .mass = spec.mass,
          .material = spec.material,
          .linear_drag = spec.linear_drag,
          .angular_drag = spec.angular_drag,
          .may_turn = spec.may_turn,
          .collides = spec.has_volume,
          .integrator = spec.integrator,
          .rotation = spec.rotation};
}

}  // namespace

template <int D>
BroadPhaseConfig<D> broad_phase_of(const StructureSpec& spec, const Box<D>& bounds) {
  BroadPhaseConfig<D> config;
  const bool any = spec.kind != StructureKind::none;
  config.kind = any ? spec.kind : StructureKind::brute_force;
  config.bounds = bounds;
  if (spec.root != Vec<3>(0.0)) config.bounds.hi = bounds.lo + in_dimension<D>(spec.root);
  config.capacity = spec.capacity;
  config.max_depth = spec.max_depth;
  config.eager_children = spec.eager_children;
  config.no_progress_stop = spec.no_progress_stop;
  config.margin = spec.margin;
  config.following = spec.following;
  if (spec.axis != SweepAxis::widest) config.sweep_axis = static_cast<int>(spec.axis) - 1;
  config.planes = planes_of<D>(spec);
  config.cell = spec.cell;
  config.levels = spec.levels;
  config.open = spec.open;
  config.as_printed = spec.as_printed;
  config.split_static = spec.split_static;
  config.in_proportion = false;
  config.most_entries = kMostEntries;
  return config;
}

template <int D>
Players<D>::Players(const Scenario& scenario)
    : scenario_(scenario),
      world_(config_of<D>(scenario)),
      ids_(scenario.bodies.size()),
      links_(scenario.links.size()),
      links_of_(scenario.links.empty() ? 0 : scenario.bodies.size()) {
  for (std::size_t i = 0; i < scenario.links.size(); ++i) {
    const LinkSpec& link = scenario.links[i];
    links_of_[link.a].push_back(i);
    if (link.b && *link.b != link.a) links_of_[*link.b].push_back(i);
  }
}

template <int D>
void Players<D>::enter(std::size_t index) {
  const BodySpec& spec = scenario_.bodies[index];
  Body<D> body = body_of<D>(spec);
  body.address = spec.address > 0 ? spec.address : 64 * (index + 1);
  const BodyId id = world_.add(std::move(body), spin_about<D>(spec.axis_of_spin(), spec.spin));
  ids_[index] = id;
  index_of_.push_back(index);
  stop_if_asked();
  if (!links_of_.empty())
    for (const std::size_t i : links_of_[index]) {
      const LinkSpec& link = scenario_.links[i];
      if (ids_[link.a] && (!link.b || ids_[*link.b])) make_link(link, links_[i]);
    }
  if (spec.asleep) world_.sleep(id);
}

template <int D>
void Players<D>::leave(std::span<const std::size_t> indices) {
  std::vector<BodyId> gone;
  for (const std::size_t index : indices) {
    gone.push_back(*ids_[index]);
    ids_[index].reset();
    if (!links_of_.empty())
      for (const std::size_t i : links_of_[index]) links_[i].there = false;
  }
  world_.remove(gone);
}

template <int D>
std::pair<Vec<D>, Vec<D>> Players<D>::ends_of(const LinkSpec& link) const {
  const auto point = [&](std::size_t index, const Vec<3>& at) {
    const Body<D>& b = *body(index);
    return b.position + matrix(b.orientation) * in_dimension<D>(at);
  };
  return {point(link.a, link.at_a),
          link.b ? point(*link.b, link.at_b) : in_dimension<D>(link.at_b)};
}

template <int D>
void Players<D>::make_link(const LinkSpec& spec, Link& link) {
  const auto [from, to] = ends_of(spec);
  link = {true, spec.rest_length.value_or(glm::length(to - from))};
  const Vec<D> away = spec.b ? Vec<D>(0.0) : out_of_the_way();
  const BodyId a = *ids_[spec.a], b = spec.b ? *ids_[*spec.b] : add_anchor(away);
  const Vec<D> at_a = in_dimension<D>(spec.at_a);
  const Vec<D> at_b = spec.b ? in_dimension<D>(spec.at_b) : to - away;
  if (spec.kind == LinkSpec::Kind::spring) {
    world_.add_spring({a, b, at_a, at_b, link.rest_length, spec.stiffness, spec.damping});
    return;
  }
  Joint<D> joint{.kind = spec.kind == LinkSpec::Kind::pin ? JointKind::pin : JointKind::distance,
                 .a = a,
                 .b = b,
                 .at_a = at_a,
                 .at_b = at_b,
                 .length = link.rest_length};
  world_.add_joint(joint);
}

// Beyond the world's lowest corner by its own size: bodies that go on below it are not likely to
// meet a point there.
template <int D>
Vec<D> Players<D>::out_of_the_way() const {
  const Box<D> bounds = in_dimension<D>(scenario_.world.bounds);
  return bounds.lo - bounds.size();
}

// A point of the world is fixed to a static body without size, which nothing meets.
template <int D>
BodyId Players<D>::add_anchor(const Vec<D>& at) {
  Body<D> anchor;
  anchor.name = "anchor";
  anchor.shape = Sphere{0};
  anchor.kind = BodyKind::static_body;
  anchor.collides = false;
  anchor.position = at;
  index_of_.push_back(kAnchor);
  return world_.add(std::move(anchor));
}

template class Players<2>;
template class Players<3>;
template BroadPhaseConfig<2> broad_phase_of(const StructureSpec&, const Box<2>&);
template BroadPhaseConfig<3> broad_phase_of(const StructureSpec&, const Box<3>&);

}  // namespace lantern::run
