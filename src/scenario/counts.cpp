// What a frame counts, and what else a caption may quote.
#include <algorithm>

#include "scenario/language.hpp"

namespace lantern {
namespace {

using enum CountNeed;

constexpr CountDoc kCounts[] = {
    {"bodies", "Bodies in the world.", true, false, bodies},
    {"nodes", "Nodes of the tree.", true, true, structure},
    {"leaves", "Nodes without children.", true, true, structure},
    {"depth", "Depth of the deepest node; the root has depth 0.", true, true, structure},
    {"entries", "Bodies stored in leaves, each once a leaf.", true, false, structure},
    {"most_in_leaf", "Bodies in the fullest leaf.", true, false, structure},
    {"pairs", "Unique candidate pairs: bodies that share a leaf.", true, false, structure},
    {"pair_tests", "Pairs met, leaf by leaf, before duplicates fell out.", true, false, structure},
    {"all_pairs", "All pairs there are: n(n−1)/2 of n bodies.", true, false, bodies},
    {"testable_pairs", "Those of them that brute force would test: not both never move.", true,
     false, bodies},
    {"overlaps", "Candidate pairs whose boxes overlap: the narrow phase will test them.", true,
     false, structure},
    {"pairs_tested", "Pairs whose shapes were tested in the last world step.", true, false,
     contacts},
    {"narrow_tests", "Tests made of them; a pair may be looked at several times in a step.", true,
     false, contacts},
    {"contacts", "Pairs that really touch.", true, false, contacts},
    {"contact_points", "Points at which they do.", true, false, contacts},
    {"impulses", "Those of them that passed on an impulse in the last world step.", true, false,
     contacts},
    {"begins", "Pairs that began to touch during the step.", true, false, contacts},
    {"ends", "Pairs that ceased to touch during the step.", true, false, contacts},
    {"constraint_rows",
     "Rows of contacts and joints that were solved in the last world step, once a sweep.", true,
     false, contacts},
    {"friction_rows", "Those of them that are friction.", true, false, contacts},
    {"force_evaluations", "How often all forces were worked out, in the last world step.", true,
     false, physics},
    {"rotations", "Bodies that were turned, in the last world step.", true, false, physics},
    {"asleep", "Bodies asleep.", true, false, sleep},
    {"awake", "Bodies that can move and are not asleep.", true, false, sleep},
    {"box_tests", "Tests of a body against a node or plane since the tree was built.", true, false,
     structure},
    {"splits", "Leaves that split since the tree was built.", true, false, structure},
    {"static_builds", "How often the structure of what never moves was built.", true, false, split},
    {"dynamic_builds", "How often the structure of what moves was built.", true, false, split},
    {"nodes_asleep", "Nodes below which nothing is awake.", true, false, asleep_nodes},
    {"leaves_asleep", "Those of them that are leaves.", true, false, asleep_nodes},
    {"branches_asleep", "The topmost of them: a search for pairs skips each with all below it.",
     true, false, asleep_nodes},
    {"stale", "Bodies that have left the cells which a `kd_tree` fitted to them.", true, false,
     kd_tree},
    {"nodes_reused", "Nodes that took an old node's place instead of new memory.", true, false,
     structure},
    {"allocations", "Calls for memory since the structure was made.", true, false, structure},
    {"slots", "Places of the array that all leaves share.", true, false, array},
    {"node_bytes", "Memory that the nodes take.", true, false, array},
    {"node_bytes_with_bounds", "What they would take if each stored its box.", true, false, array},
    {"nodes_visited", "Nodes that the last ray, cull or query went into.", true, false, query},
    {"nodes_skipped", "Nodes that it left out, with all below them.", true, false, query},
    {"objects_tested", "Bodies that it tested.", true, false, query},
    {"hits", "Bodies that it found.", true, false, query},
    {"walls", "Walls of the level.", true, false, compiled},
    {"wall_pieces", "Walls after lines have cut them.", true, false, compiled},
    {"sectors", "Leaves of the level's BSP.", true, false, compiled},
    {"cuts", "Walls that a line has cut in two.", true, false, compiled},
    {"plane_score", "Score of the line that divides the whole level.", true, false, compiled},
    {"first_wall_score", "What the first wall to divide it would have scored.", true, false,
     compiled},
    {"sector", "Where the last `locate` ended, from 1.", true, false, located},
    {"planes_tested", "Lines that it asked for the point's side.", true, false, located},
    {"textures", "Textures packed.", false, true},
    {"refused", "Textures that fit nowhere.", false, true},
    {"used_area", "Pixels under textures.", false, true},
    {"free_area", "Pixels left free.", false, true},
    {"atlas_area", "Pixels of the atlas.", false, true},
    {"free_leaves", "Leaves without a texture.", false, true},
    {"leaf_tests", "Leaves looked at, by packing and by questions for room.", false, true},
    {"room", "1 if the last `ask_room` found room, 0 if not.", false, true, room},
};

constexpr CountDoc kTexts[] = {
    {"texture", "The texture that the frame is about.", false, true},
    {"refused_names", "Names of the textures that were refused, or \"none\".", false, true},
    {"time", "Seconds of world time, with two decimals.", true, false},
};

constexpr CountDoc kMeasures[] = {
    {"energy", "Kinetic and potential energy.", true, false, physics},
    {"kinetic_energy", "Energy of motion and rotation.", true, false, physics},
    {"potential_energy", "Energy of height and of springs.", true, false, physics},
    {"momentum", "Length of the momentum of all bodies.", true, false, physics},
    {"angular_momentum",
     "Angular momentum of all bodies about the origin; its length in a 3D world.", true, false,
     physics},
    {"penetration", "How deep the two bodies that overlap most do.", true, false, contacts},
};

constexpr CountDoc kBodyMeasures[] = {
    {"energy", "Kinetic and potential energy; of a spring between two dynamic bodies, half.", true,
     false, bodies},
    {"kinetic_energy", "Energy of its motion and rotation.", true, false, bodies},
    {"potential_energy", "Energy of its height and springs.", true, false, bodies},
    {"speed", "Of its centre, in units a second.", true, false, bodies},
    {"spin", "Its angular velocity in rad/s, counter-clockwise; its length in a 3D world.", true,
     false, bodies},
    {"angular_momentum", "About its own centre; its length in a 3D world.", true, false, bodies},
    {"own_spin_x", "Its angular velocity in rad/s about its own x axis, in a 3D world.", true,
     false, bodies},
    {"own_spin_y", "About its own y axis.", true, false, bodies},
    {"own_spin_z", "About its own z axis.", true, false, bodies},
    {"x", "Where its centre is.", true, false, bodies},
    {"y", "The same along y.", true, false, bodies},
    {"z", "The same along z, in a 3D world.", true, false, bodies},
    {"penetration", "How deep it overlaps what it touches, at the deepest.", true, false, contacts},
};

}  // namespace

const CountDoc* find_in(std::span<const CountDoc> docs, std::string_view name) {
  const auto found = std::ranges::find(docs, name, &CountDoc::name);
  return found == docs.end() ? nullptr : &*found;
}

const CountDoc* find_count(std::string_view name) {
  const CountDoc* count = find_in(kCounts, name);
  return count ? count : find_in(kMeasures, name);
}

std::vector<std::string_view> names_of_counts() {
  std::vector<std::string_view> names;
  for (const CountDoc& doc : kCounts) names.push_back(doc.name);
  for (const CountDoc& doc : kMeasures) names.push_back(doc.name);
  return names;
}

std::span<const CountDoc> known_body_measures() { return kBodyMeasures; }
std::span<const CountDoc> known_counts() { return kCounts; }
std::span<const CountDoc> known_texts() { return kTexts; }
std::span<const CountDoc> known_measures() { return kMeasures; }

std::string_view when_counted(CountNeed need) {
  switch (need) {
    case bodies:
      return "always";
    case structure:
      return "with a structure";
    case kd_tree:
      return "with a kD-tree";
    case contacts:
      return "with contacts";
    case array:
      return "with a tree whose leaves share an array";
    case split:
      return "with `split_static`";
    case asleep_nodes:
      return "with a structure and `may_sleep`, contacts or `split_static`";
    case sleep:
      return "with `may_sleep`, contacts or `split_static`";
    case physics:
      return "with contacts, gravity, springs or joints";
    case query:
      return "after a ray, cull or query";
    case compiled:
      return "once the level is compiled";
    case located:
      return "after a `locate`";
    case room:
      return "after an `ask_room`";
  }
  return "";
}

}  // namespace lantern
