#include "scenario/needs.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace lantern {
namespace {

std::string counted(std::size_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

// What the script makes of the scene, gathered in one walk over its steps.
class Walk {
 public:
  explicit Walk(const Scenario& scenario) : scenario_(scenario) {
    add_kind(scenario.structure.kind);
    for (const Step& step : scenario.steps) {
      std::visit([&](const auto& verb) { see(verb); }, step.verb);
      promises += step.expect.size() + step.always.size();
    }
  }

  std::vector<StructureKind> kinds;  // other than none, in order of use
  double seconds = 0;                // of world time
  double moving_seconds = 0;         // of these, with something moving
  std::string mover;                 // one that moves
  std::size_t promises = 0;

 private:
  void add_kind(StructureKind kind) {
    if (kind != StructureKind::none && std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
      kinds.push_back(kind);
  }

  void see(const Show&) {}
  void see(const Pack&) {}
  void see(const AskRoom&) {}
  void see(const Rebuild& rebuild) { add_kind(rebuild.structure.kind); }
  // A body enters as the scenario says, whatever it was told when it was there before.
  void see(const Insert& insert) {
    for (const std::size_t body : insert.bodies)
      set_velocity(body, scenario_.bodies[body].velocity);
  }
  void see(const Remove& remove) {
    for (const std::size_t body : remove.bodies) movers_.erase(body);
  }
  void see(const Move& move) {
    if (move.velocity) set_velocity(move.body, *move.velocity);
  }
  void see(const Run& run) {
    seconds += run.seconds;
    if (movers_.empty()) return;
    moving_seconds += run.seconds;
    if (mover.empty()) mover = scenario_.bodies[*movers_.begin()].name;
  }

  void set_velocity(std::size_t body, const Vec<2>& velocity) {
    if (!scenario_.bodies[body].is_static && velocity != Vec<2>(0.0))
      movers_.insert(body);
    else
      movers_.erase(body);
  }

  const Scenario& scenario_;
  std::set<std::size_t> movers_;  // that are in the world
};

std::string structure_reason(const Walk& walk) {
  if (walk.kinds.empty()) return "the scenario has none";
  std::string text;
  for (const StructureKind kind : walk.kinds)
    text += fmt::format("{}{}", text.empty() ? "" : ", then ", to_string(kind));
  return text;
}

std::string motion_reason(const Scenario& scenario, const Walk& walk) {
  if (scenario.bodies.empty()) return "there is no body";
  if (walk.seconds == 0) return "no step lets time pass";
  if (walk.moving_seconds == 0) return "no body ever moves";
  return fmt::format("{} moves, and {:.6g} s pass", walk.mover, walk.moving_seconds);
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

std::string counters_reason(const Walk& walk) {
  if (walk.promises == 0) return "written beside every frame";
  return counted(walk.promises, "promise is", "promises are") + " verified on them";
}

void list_world(const Scenario& scenario, const Walk& walk, Needs& needs) {
  needs.listed = {
      {"world", needs.world,
       needs.world ? counted(scenario.bodies.size(), "body", "bodies") : "there is no body"},
      {"motion", needs.motion, motion_reason(scenario, walk)},
      {"rotation", false, "no body turns"},
      {"forces", false, "nothing pushes or pulls"},
      {"structure", needs.structure, structure_reason(walk)},
      {"candidate pairs", needs.pairs,
       needs.pairs ? "bodies that share a leaf of the structure" : "no structure to find them"},
      {"narrow phase", false, "no step asks which pairs really touch"},
      {"contact solver", false, "no contact is resolved"},
  };
}

void list_pictures(const Scenario& scenario, const Walk& walk, Needs& needs) {
  const bool has_tree = needs.structure || needs.atlas;
  const std::vector<Need> rest = {
      {"atlas", needs.atlas,
       needs.atlas ? counted(scenario.textures.size(), "texture", "textures") : "nothing to pack"},
      {"counters", true, counters_reason(walk)},
      {"world panel", needs.world_panel,
       panel_reason(needs.world_panel, needs.world, "shows the bodies", "there is no body")},
      {"tree panel", needs.tree_panel,
       panel_reason(needs.tree_panel, has_tree, "shows the nodes", "there is no tree")},
      {"atlas panel", needs.atlas_panel,
       panel_reason(needs.atlas_panel, needs.atlas, "shows the textures", "nothing to pack")},
      {"3D camera", false, "the world is flat"},
      {"OpenGL", true, "only for --format png"},
  };
  needs.listed.insert(needs.listed.end(), rest.begin(), rest.end());
}

}  // namespace

Needs needs_of(const Scenario& scenario) {
  const Walk walk(scenario);
  Needs needs;
  needs.world = !scenario.bodies.empty();
  needs.motion = walk.moving_seconds > 0;
  needs.structure = !walk.kinds.empty();
  needs.pairs = needs.structure;
  needs.atlas = scenario.atlas.has_value();
  // Brute force has no tree: one node that holds all.
  const bool has_tree =
      needs.atlas || std::any_of(walk.kinds.begin(), walk.kinds.end(),
                                 [](auto k) { return k != StructureKind::brute_force; });
  needs.world_panel = has_panel(scenario, Panel::world, needs.world);
  needs.tree_panel = has_panel(scenario, Panel::tree, has_tree);
  needs.atlas_panel = has_panel(scenario, Panel::atlas, needs.atlas);
  list_world(scenario, walk, needs);
  list_pictures(scenario, walk, needs);
  return needs;
}

}  // namespace lantern
