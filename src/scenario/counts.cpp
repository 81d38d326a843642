// What a frame counts, and what else a caption may quote.
#include <algorithm>
#include <iterator>

#include "scenario/language.hpp"

namespace lantern::scenario {
namespace {

using enum CountNeed;

constexpr CountDoc kCounts[] = {
    {"bodies", bodies, "Bodies in the world."},
    {"nodes", tree, "Nodes of the tree."},
    {"leaves", tree, "Nodes without children."},
    {"depth", tree, "Depth of the deepest node; the root has depth 0."},
    {"entries", structure, "Bodies stored in leaves, each once a leaf."},
    {"most_in_leaf", structure, "Bodies in the fullest leaf."},
    {"pairs", structure,
     "Unique candidate pairs: bodies that share a leaf; of structures that compare boxes without "
     "leaves (`sort_and_sweep`, `grid`, `aabb_tree`) those that are compared."},
    {"pair_tests", structure, "Pairs met, leaf by leaf or box by box, before duplicates fell out."},
    {"all_pairs", bodies, "All pairs there are: n(n−1)/2 of n bodies."},
    {"testable_pairs", bodies, "Those of them that brute force would test: not both never move."},
    {"overlaps", structure,
     "Candidate pairs whose boxes overlap: of these the narrow phase tests all that may collide."},
    {"pairs_tested", contacts, "Pairs whose shapes were tested in the last world step."},
    {"narrow_tests", contacts,
     "Tests made of them; a pair may be looked at several times in a step."},
    {"impact_looks", contacts,
     "Those of them that looked for the moment of an impact, in the midst of the step."},
    {"impacts_located", contacts,
     "Impacts whose moment the last world step found, so that they took place then."},
    {"contacts", contacts,
     "Pairs that really touch, as the last world step found; of sleepers, their last one."},
    {"contact_points", contacts, "Points at which they do."},
    {"impulses", contacts, "Those of them that passed on an impulse in that world step."},
    {"crushes", contacts,
     "Of these, those that crush: they press a body against another one, and the two lie in it "
     "deeper than a quarter of its smallest width."},
    {"begins", contacts, "Pairs that began to touch during the script's step."},
    {"ends", contacts, "Pairs that ceased to touch during the script's step."},
    {"collisions_alive", contacts,
     "Pairs of which it has been told that they began to touch, and not yet that they ceased to."},
    {"begins_in_all", contacts, "Pairs that began to touch since the scenario began."},
    {"touches_in_all", contacts,
     "Pairs that touched since the scenario began, once for each world step."},
    {"constraint_rows", contacts,
     "Rows of contacts and joints solved in the last world step, once for each sweep."},
    {"friction_rows", contacts, "Those of them that are friction."},
    {"force_evaluations", physics,
     "Passes over forces in the last world step: of all bodies, then of each island's."},
    {"rotations", physics, "Bodies that were turned, in the last world step."},
    {"asleep", sleep, "Bodies asleep."},
    {"awake", sleep, "Bodies that can move and are not asleep, whether they move now or not."},
    {"islands", islands,
     "Islands of the last world step: what contacts, springs and joints hold together; what never "
     "moves holds nothing together."},
    {"largest_island", islands, "Bodies of the largest of them."},
    {"islands_asleep", islands, "Those of them that sleep."},
    {"box_tests", inside,
     "Tests of a body against a node or plane since the tree was built; of `sort_and_sweep`, "
     "comparisons while sorting; of a `grid`, bodies put into their cells; of an `aabb_tree`, when "
     "it last followed its bodies."},
    {"splits", structure, "Leaves that split since the tree was built."},
    {"tests_so_far", inside,
     "Tests made to find pairs since the script began: `box_tests` and `pair_tests` of every build "
     "that a frame shows, and of a compiled level its `side_tests`."},
    {"static_builds", split, "How often the structure of what never moves was built."},
    {"dynamic_builds", split, "How often the structure of what moves was built."},
    {"nodes_asleep", asleep_nodes,
     "Nodes in and below which nothing moves now, the structure of what never moves apart."},
    {"leaves_asleep", asleep_nodes, "Those of them that are leaves."},
    {"branches_asleep", asleep_nodes,
     "The topmost of them: a search for pairs skips each with all below it."},
    {"stale", kd_tree, "Bodies that have left the cells which a `kd_tree` fitted to them."},
    {"swaps", sweep,
     "Neighbours that changed places when the sweep sorted its boxes last, by insertion."},
    {"reinserted", boxes,
     "Bodies that had left their boxes when an `aabb_tree` last followed its bodies, and were "
     "inserted again."},
    {"refitted", boxes, "The same of those whose boxes were made anew where they stand."},
    {"nodes_reused", inside, "Nodes that took an old node's place instead of new memory."},
    {"allocations", inside, "Calls for memory since the structure was made."},
    {"slots", array, "Places of the array that all leaves share."},
    {"node_bytes", array, "Memory that the nodes take."},
    {"node_bytes_with_bounds", array, "What they would take if each stored its box."},
    {"nodes_visited", query, "Nodes that the last ray, cull or query went into."},
    {"nodes_skipped", query, "Nodes that it left out, with all below them."},
    {"objects_tested", query, "Bodies that it tested."},
    {"hits", query, "Bodies that it found."},
    {"shapes_tested", shapes, "Pairs whose shapes the last `test_shapes` has tested."},
    {"narrow_work", shapes,
     "Lengths along a direction that these tests measured: of two discs 1, of a disc and a box 3, "
     "of two boxes 3 for each axis that was needed; more in a 3D world."},
    {"touching", shapes, "Pairs that it found to touch."},
    {"axes_tested", separated, "Axes along which the last `separate` has measured its bodies."},
    {"gjk_steps", searched, "Points of the difference that the last `gjk` has asked for."},
    {"compared_bodies", compared, "Bodies of the last `compare`."},
    {"compared_pairs", compared, "Pairs of them that brute force would test."},
    {"compared_overlaps", compared, "Those whose boxes overlap after its step, by every kind."},
    {"least_work", compared,
     "Comparisons of the kind that needed fewest in its step, to make ready and to find pairs."},
    {"walls", compiled, "Walls of the level."},
    {"wall_pieces", compiled, "Walls after lines have cut them."},
    {"sectors", compiled, "Leaves of the level's BSP."},
    {"sector_pairs", compiled, "All pairs of sectors there are."},
    {"cuts", compiled, "Walls that a line has cut in two."},
    {"lines_tried", compiled, "Lines of walls that its compiler tried, to divide regions."},
    {"side_tests", compiled, "Tests that took: on which side of a line a piece of wall lies."},
    {"plane_score", compiled, "Score of the line that divides the whole level."},
    {"first_wall_score", compiled, "What the first wall to divide it would have scored."},
    {"sector", located, "Where the last `locate` ended, from 1."},
    {"planes_tested", located, "Lines that it asked for the point's side."},
    {"bodies_here", located, "Bodies in that sector, if the level holds the bodies."},
    {"portals", sighted, "Openings between two sectors of the level."},
    {"portals_tested", sighted, "How often a portal was held against the view through others."},
    {"visible_pairs", sighted, "Pairs of sectors that see each other."},
    {"sectors_seen", eyed, "Sectors that the eye's sector sees, itself among them."},
    {"bodies_seen", eyed, "Bodies in these, if the level holds the bodies."},
    {"textures", atlas, "Textures packed."},
    {"refused", atlas, "Textures that fit nowhere."},
    {"used_area", atlas, "Pixels under textures."},
    {"free_area", atlas, "Pixels left free."},
    {"atlas_area", atlas, "Pixels of the atlas."},
    {"free_leaves", atlas, "Leaves without a texture."},
    {"leaf_tests", atlas, "Leaves looked at, by packing and by questions for room."},
    {"room", room, "1 if the last `ask_room` found room, 0 if not."},
    {"bindings", drawn, "Times that the last `draw` had to bind another image, so far."},
    {"draws", drawn, "Elements that it has drawn."},
};

constexpr CountDoc kTexts[] = {
    {"texture", atlas, "The texture that the frame is about."},
    {"refused_names", atlas, "Names of the textures that were refused, or \"none\"."},
    {"time", bodies, "Seconds of world time, with two decimals."},
};

constexpr CountDoc kMeasures[] = {
    {"tree_cost", boxes,
     "Sum of the perimeters, in a 3D world of the surfaces, of all inner nodes' boxes.", "units"},
    {"energy", physics, "Kinetic and potential energy.", "J"},
    {"kinetic_energy", physics, "Energy of motion and rotation.", "J"},
    {"potential_energy", physics, "Energy of height and of springs.", "J"},
    {"momentum", physics, "Length of the momentum of all bodies.", "N s"},
    {"angular_momentum", physics,
     "Angular momentum of all bodies about the origin; its length in a 3D world.", "J s"},
    {"penetration", contacts, "How deep the deepest contact of the last world step overlaps.",
     "units"},
    {"gap", separated,
     "How far the last `separate` found its bodies apart along the axis that parts them; 0 if none "
     "does.",
     "units"},
    {"overlap", separated, "Where none parts them, how far they overlap along the best one.",
     "units"},
    {"distance", searched, "Of the bodies of the last `gjk`; 0 if they overlap.", "units"},
    {"time_of_impact", contacts,
     "When the first of the last world step's impacts was, as a part of the step; 1 if it located "
     "none.",
     "of a step"},
    {"joint_gap", joints,
     "How far the joint that holds worst is from holding: a pin's points apart, a rod too long or "
     "short.",
     "units"},
};

constexpr CountDoc kBodyMeasures[] = {
    {"energy", bodies,
     "Kinetic and potential energy; of a spring between two dynamic bodies, half.", "J"},
    {"kinetic_energy", bodies, "Energy of its motion and rotation.", "J"},
    {"potential_energy", bodies, "Energy of its height and springs.", "J"},
    {"speed", bodies, "Of its centre, in units a second.", "units/s"},
    {"spin", bodies, "Its angular velocity in rad/s, counter-clockwise; its length in a 3D world.",
     "rad/s"},
    {"angular_momentum", bodies, "About its own centre; its length in a 3D world.", "J s"},
    {"own_spin_x", bodies, "Its angular velocity in rad/s about its own x axis, in a 3D world.",
     "rad/s"},
    {"own_spin_y", bodies, "About its own y axis.", "rad/s"},
    {"own_spin_z", bodies, "About its own z axis.", "rad/s"},
    {"x", bodies, "Where its centre is.", "units"},
    {"y", bodies, "The same along y.", "units"},
    {"z", bodies, "The same along z, in a 3D world.", "units"},
    {"penetration", contacts, "How deep its deepest contact of the last world step overlaps.",
     "units"},
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
  static constexpr std::string_view kWhen[] = {
      // in the order of CountNeed
      "always",
      "with a structure",
      "with a structure",
      "with a kD-tree",
      "with `sort_and_sweep`",
      "with an `aabb_tree`",
      "with a tree whose leaves share an array",
      "with a structure that is not the user's own",
      "with `split_static`",
      "with a structure and `may_sleep`, contacts or `split_static`",
      "with contacts",
      "with rods or pins",
      "with `may_sleep`, contacts or `split_static`",
      "with contacts, gravity, springs or joints",
      "with the panel `islands`",
      "after a ray, cull or query",
      "after a `test_shapes`",
      "after a `separate`",
      "after a `gjk`",
      "once the level is compiled",
      "after a `locate`, an `order` or a `see` with an eye",
      "after a `see`",
      "after a `see` with an eye",
      "with an atlas",
      "after an `ask_room`",
      "after a `compare`",
      "after a `draw`"};
  static_assert(std::size(kWhen) == static_cast<std::size_t>(drawn) + 1);
  return kWhen[static_cast<std::size_t>(need)];
}

}  // namespace lantern::scenario
