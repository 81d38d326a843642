#include "scenario/needs.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "scenario/script_walk.hpp"

namespace lantern {
namespace {

constexpr const char* kNoTime = "no step lets time pass";

std::string counted(std::size_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

// "gravity, springs": what there is of a list of things.
std::string listing(const std::vector<std::pair<bool, std::string>>& things) {
  std::string text;
  for (const auto& [there, name] : things)
    if (there) text += (text.empty() ? "" : ", ") + name;
  return text;
}

bool has_dynamic_body(const Scenario& scenario) {
  return std::any_of(scenario.bodies.begin(), scenario.bodies.end(),
                     [](const auto& body) { return body.kind == BodyKind::dynamic_body; });
}

std::size_t count_links(const Scenario& scenario, bool springs) {
  return static_cast<std::size_t>(std::count_if(
      scenario.links.begin(), scenario.links.end(),
      [&](const LinkSpec& link) { return (link.kind == LinkSpec::Kind::spring) == springs; }));
}

std::string structure_reason(const ScriptWalk& walk) {
  if (walk.kinds.empty()) return "the scenario has none";
  std::string text;
  for (const StructureKind kind : walk.kinds)
    text += fmt::format("{}{}", text.empty() ? "" : ", then ", to_string(kind));
  return text;
}

std::string static_reason(const ScriptWalk& walk) {
  if (walk.kinds.empty()) return "the scenario has none";
  return walk.split_static ? "what never moves is stored apart" : "one structure holds all bodies";
}

std::string motion_reason(const Scenario& scenario, const ScriptWalk& walk) {
  if (scenario.bodies.empty()) return "there is no body";
  if (walk.seconds == 0) return kNoTime;
  if (walk.moving_seconds == 0) return "no body ever moves";
  return fmt::format("{} moves, and {:.6g} s pass", walk.mover, walk.moving_seconds);
}

// Forces on dynamic bodies, by name; empty if there are none.
std::string forces_of(const Scenario& scenario, const ScriptWalk& walk) {
  if (!has_dynamic_body(scenario)) return {};
  const bool drag = std::any_of(scenario.bodies.begin(), scenario.bodies.end(), [](const auto& b) {
    return b.kind == BodyKind::dynamic_body && (b.linear_drag > 0 || b.angular_drag > 0);
  });
  return listing({{scenario.world.gravity != Vec<3>(0.0), "gravity"},
                  {drag, "drag"},
                  {count_links(scenario, true) > 0, "springs"},
                  {walk.pushes, "pushes of the script"}});
}

std::string links_reason(const Scenario& scenario) {
  const std::size_t springs = count_links(scenario, true), joints = count_links(scenario, false);
  if (springs + joints == 0) return "nothing is tied to anything";
  return listing({{springs > 0, counted(springs, "spring", "springs")},
                  {joints > 0, counted(joints, "joint", "joints")}});
}

// The two at least that friction takes.
bool has_friction(const Scenario& scenario) {
  return std::count_if(scenario.bodies.begin(), scenario.bodies.end(),
                       [](const auto& body) { return body.material.friction > 0; }) >= 2;
}

bool is_put_to_sleep(const Scenario& scenario, const ScriptWalk& walk) {
  return walk.sleeps || std::any_of(scenario.bodies.begin(), scenario.bodies.end(),
                                    [](const auto& body) { return body.asleep; });
}

// A panel is drawn when it is derived, or wished for.
bool has_panel(const Scenario& scenario, Panel panel, bool derived) {
  if (scenario.panels.empty()) return derived;
  return std::find(scenario.panels.begin(), scenario.panels.end(), panel) != scenario.panels.end();
}

std::string panel_reason(bool used, bool possible, std::string_view has, std::string_view lacks) {
  if (!possible) return std::string(lacks);
  return used ? std::string(has) : "the scenario's panels leave it out";
}

std::string counters_reason(const ScriptWalk& walk) {
  if (walk.promises == 0) return "written beside every frame";
  return counted(walk.promises, "promise is", "promises are") + " verified on them";
}

std::string contact_name(ContactMethod choice) {
  switch (choice) {
    case ContactMethod::none:
      break;
    case ContactMethod::impulse:
      return "sequential impulses";
    case ContactMethod::soft:
      return "soft contacts in small steps";
    case ContactMethod::direct:
      return "all contacts at once";
    case ContactMethod::lecture:
      return "an impulse for each pair, as the lecture does it";
  }
  return "nothing";
}

std::string solver_reason(const Scenario& scenario, const ScriptWalk& walk) {
  const bool joints = count_links(scenario, false) > 0;
  if (scenario.world.contacts == ContactMethod::none && !joints)
    return "no contact is resolved, and there is no joint";
  if (walk.seconds == 0) return kNoTime;
  if (scenario.world.contacts == ContactMethod::none) return "for the joints";
  std::string text;
  for (const ContactMethod method : walk.methods)
    text += (text.empty() ? "" : ", then ") + contact_name(method);
  return text;
}

void list_motion(const Scenario& scenario, const ScriptWalk& walk, Needs& needs) {
  const std::string forces = forces_of(scenario, walk);
  needs.listed = {
      {"world", needs.world,
       needs.world ? counted(scenario.bodies.size(), "body", "bodies") : "there is no body"},
      {"motion", needs.motion, motion_reason(scenario, walk)},
      {"rotation", needs.rotation,
       needs.rotation ? fmt::format("{} turns, or may be turned", walk.turner) : "no body turns"},
      {"forces", needs.forces,
       forces.empty()     ? "nothing pushes or pulls"
       : walk.seconds > 0 ? forces
                          : kNoTime},
      {"springs and joints", needs.links, links_reason(scenario)},
  };
}

void list_contacts(const Scenario& scenario, const ScriptWalk& walk, Needs& needs) {
  const bool has_contacts = scenario.world.contacts != ContactMethod::none;
  const std::vector<Need> contacts = {
      {"structure", needs.structure, structure_reason(walk)},
      {"static structure", needs.static_structure, static_reason(walk)},
      {"candidate pairs", needs.pairs,
       needs.pairs ? "bodies that share a leaf of the structure" : "no structure to find them"},
      {"narrow phase", needs.narrow_phase,
       !needs.world         ? "there is no body"
       : needs.narrow_phase ? "which candidate pairs really touch?"
                            : "the world lets bodies pass through each other"},
      {"contact solver", needs.solver, solver_reason(scenario, walk)},
      {"friction", needs.friction,
       needs.friction           ? "between bodies that touch"
       : !has_contacts          ? "no contact is resolved"
       : has_friction(scenario) ? kNoTime
                                : "no two bodies have friction"},
      {"sleeping", needs.sleeping,
       needs.sleeping             ? "bodies at rest are left out of the work"
       : scenario.world.may_sleep ? kNoTime
                                  : "no body may sleep"},
      {"queries", needs.queries,
       needs.queries ? counted(walk.questions, "ray, cull or query", "rays, culls or queries")
                     : "no step asks"},
  };
  needs.listed.insert(needs.listed.end(), contacts.begin(), contacts.end());
}

std::size_t count_walls(const LevelSpec& level) {
  std::size_t walls = 0;
  for (const auto& loop : level.loops) walls += loop.size();
  return walls;
}

std::string level_reason(const Scenario& scenario, const Needs& needs) {
  if (!scenario.level) return "the scenario has none";
  return needs.level ? counted(count_walls(*scenario.level), "wall", "walls")
                     : "no step compiles it";
}

void list_pictures(const Scenario& scenario, const ScriptWalk& walk, Needs& needs) {
  const bool has_tree = needs.structure || needs.atlas || needs.level;
  const bool has_world = needs.world || scenario.level.has_value();
  const bool has_array = needs.structure;
  const std::vector<Need> rest = {
      {"level", needs.level, level_reason(scenario, needs)},
      {"atlas", needs.atlas,
       needs.atlas ? counted(scenario.textures.size(), "texture", "textures") : "nothing to pack"},
      {"counters", true, counters_reason(walk)},
      {"chart", needs.chart,
       !needs.chart                  ? "the scenario has none"
       : scenario.chart->over_time() ? "every frame adds to it"
                                     : counted(walk.plots, "step adds to it", "steps add to it")},
      {"world panel", needs.world_panel,
       panel_reason(needs.world_panel, has_world, "shows the bodies", "there is no body")},
      {"tree panel", needs.tree_panel,
       panel_reason(needs.tree_panel, has_tree, "shows the nodes", "there is no tree")},
      {"atlas panel", needs.atlas_panel,
       panel_reason(needs.atlas_panel, needs.atlas, "shows the textures", "nothing to pack")},
      {"chart panel", needs.chart_panel,
       panel_reason(needs.chart_panel, needs.chart, "shows the chart", "there is no chart")},
      {"memory panel", needs.memory_panel,
       has_array && !needs.memory_panel
           ? "the scenario does not ask for it"
           : panel_reason(needs.memory_panel, has_array, "shows the leaves' array",
                          "there is no structure")},
      {"3D camera", needs.camera, needs.camera ? "the world is solid" : "the world is flat"},
      {"OpenGL", true, "only for --format png"},
  };
  needs.listed.insert(needs.listed.end(), rest.begin(), rest.end());
}

void find_stages(const Scenario& scenario, const ScriptWalk& walk, Needs& needs) {
  const bool time_passes = walk.seconds > 0;
  needs.world = !scenario.bodies.empty();
  const bool has_contacts = needs.world && scenario.world.contacts != ContactMethod::none;
  needs.motion = walk.moving_seconds > 0;
  needs.rotation = !walk.turner.empty();
  needs.forces = time_passes && !forces_of(scenario, walk).empty();
  needs.links = !scenario.links.empty();
  needs.structure = !walk.kinds.empty();
  needs.static_structure = walk.split_static;
  needs.pairs = needs.structure;
  needs.narrow_phase = has_contacts;
  needs.solver = time_passes && (has_contacts || count_links(scenario, false) > 0);
  needs.friction = time_passes && has_contacts && has_friction(scenario);
  needs.sleeping = (scenario.world.may_sleep && time_passes) || is_put_to_sleep(scenario, walk);
  needs.queries = walk.questions > 0;
  needs.level = scenario.level && walk.compiles;
  needs.atlas = scenario.atlas.has_value();
  needs.chart = scenario.chart.has_value();
  needs.camera = scenario.world.dimension == 3;
}

}  // namespace

Needs needs_of(const Scenario& scenario) {
  const ScriptWalk walk(scenario);
  Needs needs;
  find_stages(scenario, walk, needs);
  // Brute force and sort and sweep have no tree: one node that holds all.
  const auto is_tree = [](StructureKind kind) {
    return kind != StructureKind::brute_force && kind != StructureKind::sort_and_sweep;
  };
  const bool has_tree =
      needs.atlas || needs.level || std::any_of(walk.kinds.begin(), walk.kinds.end(), is_tree);
  needs.world_panel = has_panel(scenario, Panel::world, needs.world || scenario.level.has_value());
  needs.tree_panel = has_panel(scenario, Panel::tree, has_tree);
  needs.atlas_panel = has_panel(scenario, Panel::atlas, needs.atlas);
  needs.chart_panel = has_panel(scenario, Panel::chart, needs.chart);
  needs.memory_panel = has_panel(scenario, Panel::memory, false);
  list_motion(scenario, walk, needs);
  list_contacts(scenario, walk, needs);
  list_pictures(scenario, walk, needs);
  return needs;
}

}  // namespace lantern
