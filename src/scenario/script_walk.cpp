#include "scenario/script_walk.hpp"

#include <algorithm>

namespace lantern {
namespace {

void set_in(std::set<std::size_t>& set, std::size_t body, bool in) {
  if (in)
    set.insert(body);
  else
    set.erase(body);
}

}  // namespace

bool can_turn(const BodySpec& body) {
  return body.kind != BodyKind::static_body && !std::holds_alternative<AxisBox<3>>(body.shape) &&
         !std::holds_alternative<HalfSpace<3>>(body.shape);
}

ScriptWalk::ScriptWalk(const Scenario& scenario)
    : scenario_(scenario), linked_(scenario.bodies.size()) {
  for (const LinkSpec& link : scenario.links) {
    linked_[link.a] = true;
    if (link.b) linked_[*link.b] = true;
  }
  add_structure(scenario.structure);
  add_method(scenario.world.contacts);
  for (const Step& step : scenario.steps) {
    std::visit([&](const auto& verb) { see(verb); }, step.verb);
    promises += step.expect.size() + step.always.size();
    plots += step.plot ? 1u : 0u;
  }
}

void ScriptWalk::add_structure(const StructureSpec& structure) {
  if (structure.kind == StructureKind::none) return;
  if (std::find(kinds.begin(), kinds.end(), structure.kind) == kinds.end())
    kinds.push_back(structure.kind);
  split_static = split_static || structure.split_static;
}

void ScriptWalk::add_method(ContactMethod method) {
  if (method == ContactMethod::none) return;
  if (std::find(methods.begin(), methods.end(), method) == methods.end()) methods.push_back(method);
}

// A body enters as the scenario says, whatever it was told when it was there before.
void ScriptWalk::see(const Insert& insert) {
  const WorldSpec& world = scenario_.world;
  for (const std::size_t i : insert.bodies) {
    const BodySpec& body = scenario_.bodies[i];
    if (body.kind == BodyKind::static_body) continue;
    const bool pulled =
        body.kind == BodyKind::dynamic_body && (world.gravity != Vec<3>(0.0) || linked_[i]);
    const bool touched =
        body.kind == BodyKind::dynamic_body && world.contacts != ContactMethod::none;
    set_in(movers_, i,
           body.velocity != Vec<3>(0.0) || body.spin != 0 || body.brain != Brain::none || pulled);
    set_in(turners_, i,
           can_turn(body) && (body.spin != 0 || (body.may_turn && (touched || linked_[i]))));
  }
}

void ScriptWalk::see(const Remove& remove) {
  for (const std::size_t body : remove.bodies) {
    movers_.erase(body);
    turners_.erase(body);
  }
}

void ScriptWalk::see(const Move& move) {
  const BodySpec& body = scenario_.bodies[move.body];
  if (body.kind == BodyKind::static_body) return;
  const bool steered =
      body.brain != Brain::none || linked_[move.body] ||
      (body.kind == BodyKind::dynamic_body && scenario_.world.gravity != Vec<3>(0.0));
  if (move.velocity) set_in(movers_, move.body, *move.velocity != Vec<3>(0.0) || steered);
  if (move.spin.value_or(0) != 0) {
    movers_.insert(move.body);
    if (can_turn(body)) turners_.insert(move.body);
  }
}

void ScriptWalk::see(const Phases&) { pass(scenario_.world.time_step); }

void ScriptWalk::see(const ApplyForce& force) {
  if (force.force == Vec<3>(0.0)) return;
  pushes = true;
  push(force.body, force.at);
}

void ScriptWalk::see(const ApplyImpulse& impulse) {
  if (impulse.impulse != Vec<3>(0.0)) push(impulse.body, impulse.at);
}

void ScriptWalk::push(std::size_t i, const Vec<3>& at) {
  const BodySpec& body = scenario_.bodies[i];
  if (body.kind != BodyKind::dynamic_body) return;
  movers_.insert(i);
  if (at != Vec<3>(0.0) && body.may_turn && can_turn(body)) turners_.insert(i);
}

void ScriptWalk::pass(double time) {
  seconds += time;
  if (!turners_.empty() && turner.empty()) turner = scenario_.bodies[*turners_.begin()].name;
  if (movers_.empty()) return;
  moving_seconds += time;
  if (mover.empty()) mover = scenario_.bodies[*movers_.begin()].name;
}

}  // namespace lantern
