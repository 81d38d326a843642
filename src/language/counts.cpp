#include "language/counts.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spatial/structure_kind.hpp"

namespace lantern::language {
namespace {

using Past = ScriptPast;

bool is_compiled(const Past& past) { return past.scenario().level && past.has<CompileLevel>(); }

template <Setting kSetting>
bool stands_with(const Past& past) {
  return traits_of(past.structure().kind).has(kSetting);
}

template <class V>
bool after(const Past& past) {
  return past.has<V>();
}

// --- when there is one ---

constexpr CountRule kAtlas = {"with an atlas", "the scenario has no [atlas]",
                              [](const Past& past) { return past.scenario().atlas.has_value(); }};
constexpr CountRule kRoom = {"after an `ask_room`", "no step has asked for room yet",
                             after<AskRoom>, &kAtlas};
constexpr CountRule kDrawn = {"after a `draw`", "no step has drawn the screen yet",
                              after<DrawScreen>, &kAtlas};

constexpr CountRule kNoAtlas = {"", "an atlas has none", [](const Past& past) {
                                  return !past.scenario().atlas || !past.scenario().bodies.empty();
                                }};
constexpr CountRule kTime = {"always", "the scenario has no bodies",
                             [](const Past& past) { return past.scenario().has_world(); },
                             &kNoAtlas};
constexpr CountRule kBodies = {"always", "the scenario has no bodies",
                               [](const Past& past) { return !past.scenario().bodies.empty(); },
                               &kNoAtlas};
constexpr CountRule kSolid = {"in a 3D world", "this world is 2D",
                              [](const Past& past) { return past.dimension() != 2; }, &kBodies};

constexpr CountRule kStructure = {
    "with a structure", "there is no structure at this step",
    [](const Past& past) { return past.structure().kind != StructureKind::none; }, &kBodies};
constexpr CountRule kAnyTree = {"", "the scenario has no bodies", [](const Past& past) {
                                  return kAtlas.holds(past) || is_compiled(past) ||
                                         kBodies.holds(past);
                                }};
constexpr CountRule kTree = {"with a structure", "there is no structure at this step",
                             [](const Past& past) {
                               return kAtlas.holds(past) || is_compiled(past) ||
                                      kStructure.holds(past);
                             },
                             &kAnyTree};
constexpr CountRule kKdTree = {
    "with a kD-tree", "there is no kd_tree at this step",
    [](const Past& past) { return traits_of(past.structure().kind).is_fitted; }, &kStructure};
constexpr CountRule kSweep = {"with `sort_and_sweep`", "there is no sort_and_sweep at this step",
                              stands_with<Setting::axis>, &kStructure};
constexpr CountRule kBoxes = {"with an `aabb_tree`", "there is no aabb_tree at this step",
                              stands_with<Setting::margin>, &kStructure};
constexpr CountRule kArray = {"with a tree whose leaves share an array, or `lecture_quadtree`",
                              "the leaves of '{}' share no array",
                              [](const Past& past) {
                                const StructureTraits traits = traits_of(past.structure().kind);
                                return traits.shares_array || traits.is_plain;
                              },
                              &kStructure};
constexpr CountRule kInside = {
    "with a structure that is not the user's own",
    "'{}' is seen from outside, nobody counts its tests and its memory",
    [](const Past& past) { return !traits_of(past.structure().kind).is_own; }, &kStructure};
constexpr CountRule kSplit = {"with `split_static`", "the structure has no split_static",
                              [](const Past& past) { return past.structure().split_static; },
                              &kStructure};
constexpr CountRule kAsleepNodes = {
    "with a structure and `may_sleep`, contacts or `split_static`", "in this world nothing sleeps",
    [](const Past& past) { return past.scenario().tells_sleepers(); }, &kStructure};

constexpr CountRule kContacts = {"with contacts", "this world has no contacts",
                                 [](const Past& past) { return past.scenario().has_contacts(); },
                                 &kBodies};
constexpr CountRule kJoints = {"with rods or pins", "this world has no joints",
                               [](const Past& past) { return past.scenario().has_joints(); },
                               &kBodies};
constexpr CountRule kSleep = {
    "with `may_sleep`, contacts or `split_static`", "in this world nothing sleeps",
    [](const Past& past) { return past.scenario().tells_sleepers(); }, &kBodies};
constexpr CountRule kPhysics = {"with contacts, gravity, springs or joints",
                                "this world has no contacts, gravity, springs or joints",
                                [](const Past& past) { return past.scenario().has_physics(); },
                                &kBodies};
constexpr CountRule kIslands = {
    "with the panel `islands`", "there is no panel 'islands'",
    [](const Past& past) { return shows(past.scenario().panels, "islands"); }, &kBodies};

constexpr CountRule kQuery = {"after a ray, cull or query",
                              "no step has sent a ray, culled or queried yet",
                              [](const Past& past) { return past.has_asked(); }, &kBodies};
constexpr CountRule kShapes = {"after a `test_shapes`", "no step has tested shapes yet",
                               after<TestShapes>, &kBodies};
constexpr CountRule kSeparated = {"after a `separate`", "no step has separated two bodies yet",
                                  after<Separate>, &kBodies};
constexpr CountRule kSearched = {"after a `gjk`", "no step has asked for a distance by gjk yet",
                                 after<SearchDistance>, &kBodies};
constexpr CountRule kCompared = {"after a `compare`", "no step has compared structures yet",
                                 after<Compare>, &kBodies};

constexpr CountRule kLevel = {"", "the scenario has no [level]",
                              [](const Past& past) { return past.scenario().level.has_value(); }};
constexpr CountRule kCompiled = {"once the level is compiled", "no step has compiled the level yet",
                                 after<CompileLevel>, &kLevel};
constexpr CountRule kLocated = {"after a `locate`, an `order` or a `see` with an eye",
                                "no step has located a point yet",
                                [](const Past& past) { return past.has_located(); }, &kCompiled};
constexpr CountRule kSighted = {"after a `see`", "no step has asked who sees whom yet", after<See>,
                                &kCompiled};
constexpr CountRule kEyed = {"after a `see` with an eye", "no eye has looked yet",
                             [](const Past& past) { return past.has_eye_looked(); }, &kCompiled};

// --- what there is ---

constexpr CountDoc kCounts[] = {
    {"bodies", kBodies, "body/bodies", "Bodies in the world.", Most::bodies},
    {"nodes", kTree, "", "Nodes of the tree.", Most::parts},
    {"leaves", kTree, "leaf/leaves", "Nodes without children.", Most::parts},
    {"depth", kTree, "level deep/levels deep", "Depth of the deepest node; the root has depth 0.",
     Most::depth},
    {"entries", kStructure, "entry/entries", "Bodies stored in leaves, each once a leaf.",
     Most::parts},
    {"most_in_leaf", kStructure, "in the fullest leaf", "Bodies in the fullest leaf.",
     Most::bodies},
    {"pairs", kStructure, "",
     "Unique candidate pairs: bodies that share a leaf; of structures that compare boxes without "
     "leaves (`sort_and_sweep`, `grid`, `aabb_tree`) those that are compared.",
     Most::pairs},
    {"pair_tests", kStructure, "pair met/pairs met",
     "Pairs met, leaf by leaf or box by box, before duplicates fell out."},
    {"all_pairs", kBodies, "pair in all/pairs in all", "All pairs there are: n(n−1)/2 of n bodies.",
     Most::pairs},
    {"testable_pairs", kBodies, "by brute force",
     "Those of them that brute force would test: not both never move.", Most::pairs},
    {"overlaps", kStructure, "overlap of boxes/overlaps of boxes",
     "Candidate pairs whose boxes overlap: of these the narrow phase tests all that may collide.",
     Most::pairs},
    {"pairs_tested", kContacts, "pair tested/pairs tested",
     "Pairs whose shapes were tested in the last world step."},
    {"narrow_tests", kContacts, "",
     "Tests made of them; a pair may be looked at several times in a step."},
    {"impact_looks", kContacts, "look for the impact/looks for the impact",
     "Those of them that looked for the moment of an impact, in the midst of the step."},
    {"impacts_located", kContacts, "impact located/impacts located",
     "Impacts whose moment the last world step found, so that they took place then."},
    {"contacts", kContacts, "",
     "Pairs that really touch, as the last world step found; of sleepers, their last one.",
     Most::pairs},
    {"contact_points", kContacts, "contact point/contact points", "Points at which they do."},
    {"impulses", kContacts, "", "Those of them that passed on an impulse in that world step."},
    {"crushes", kContacts, "crush/crushes",
     "Of these, those that crush: they press a body against another one, and the two lie in it "
     "deeper than a quarter of its smallest width."},
    {"begins", kContacts, "contact begun/contacts begun",
     "Pairs that began to touch during the script's step."},
    {"ends", kContacts, "contact ended/contacts ended",
     "Pairs that ceased to touch during the script's step."},
    {"collisions_alive", kContacts, "collision alive/collisions alive",
     "Pairs of which it has been told that they began to touch, and not yet that they ceased to."},
    {"begins_in_all", kContacts, "begin/begins",
     "Pairs that began to touch since the scenario began."},
    {"touches_in_all", kContacts, "touch/touches",
     "Pairs that touched since the scenario began, once for each world step."},
    {"constraint_rows", kContacts, "",
     "Rows of contacts and joints solved in the last world step, once for each sweep."},
    {"friction_rows", kContacts, "", "Those of them that are friction."},
    {"force_evaluations", kPhysics, "",
     "Passes over forces in the last world step: of all bodies, then of each island's."},
    {"rotations", kPhysics, "", "Bodies that were turned, in the last world step."},
    {"asleep", kSleep, "asleep", "Bodies asleep.", Most::bodies},
    {"awake", kSleep, "awake",
     "Bodies that can move and are not asleep, whether they move now or not.", Most::bodies},
    {"islands", kIslands, "",
     "Islands of the last world step: what contacts, springs and joints hold together; what never "
     "moves holds nothing together."},
    {"largest_island", kIslands, "", "Bodies of the largest of them."},
    {"islands_asleep", kIslands, "island asleep/islands asleep", "Those of them that sleep."},
    {"box_tests", kInside, "",
     "Tests of a body against a node or plane since the tree was built; of `sort_and_sweep`, "
     "comparisons while sorting; of a `grid`, bodies put into their cells; of an `aabb_tree`, when "
     "it last followed its bodies."},
    {"splits", kStructure, "", "Leaves that split since the tree was built."},
    {"tests_so_far", kInside, "test so far/tests so far",
     "Tests made to find pairs since the script began: `box_tests` and `pair_tests` of every build "
     "that a frame shows, and of a compiled level its `side_tests`."},
    {"static_builds", kSplit, "static build/static builds",
     "How often the structure of what never moves was built."},
    {"dynamic_builds", kSplit, "dynamic build/dynamic builds",
     "How often the structure of what moves was built."},
    {"nodes_asleep", kAsleepNodes, "node asleep/nodes asleep",
     "Nodes in and below which nothing moves now, the structure of what never moves apart."},
    {"leaves_asleep", kAsleepNodes, "leaf asleep/leaves asleep", "Those of them that are leaves."},
    {"branches_asleep", kAsleepNodes, "branch asleep/branches asleep",
     "The topmost of them: a search for pairs skips each with all below it."},
    {"stale", kKdTree, "out of its cell/out of their cells",
     "Bodies that have left the cells which a `kd_tree` fitted to them."},
    {"swaps", kSweep, "",
     "Neighbours that changed places when the sweep sorted its boxes last, by insertion."},
    {"reinserted", kBoxes, "body inserted again/bodies inserted again",
     "Bodies that had left their boxes when an `aabb_tree` last followed its bodies, and were "
     "inserted again."},
    {"refitted", kBoxes, "box made anew/boxes made anew",
     "The same of those whose boxes were made anew where they stand."},
    {"nodes_reused", kInside, "node reused/nodes reused",
     "Nodes that took an old node's place instead of new memory."},
    {"allocations", kInside, "", "Calls for memory since the structure was made."},
    {"slots", kArray, "", "Places of the array that all leaves share."},
    {"node_bytes", kArray, "byte of nodes/bytes of nodes", "Memory that the nodes take."},
    {"node_bytes_with_bounds", kArray, "byte with bounds/bytes with bounds",
     "What they would take if each stored its box."},
    {"nodes_visited", kQuery, "node visited/nodes visited",
     "Nodes that the last ray, cull or query went into."},
    {"nodes_skipped", kQuery, "node left out/nodes left out",
     "Nodes that it left out, with all below them."},
    {"objects_tested", kQuery, "body tested/bodies tested", "Bodies that it tested.", Most::bodies},
    {"hits", kQuery, "", "Bodies that it found.", Most::bodies},
    {"shapes_tested", kShapes, "pair tested/pairs tested",
     "Pairs whose shapes the last `test_shapes` has tested."},
    {"narrow_work", kShapes, "length measured/lengths measured",
     "Lengths along a direction that these tests measured: of two discs 1, of a disc and a box 3, "
     "of two boxes 3 for each axis that was needed; more in a 3D world."},
    {"touching", kShapes, "pair touches/pairs touch", "Pairs that it found to touch."},
    {"axes_tested", kSeparated, "axis tested/axes tested",
     "Axes along which the last `separate` has measured its bodies."},
    {"gjk_steps", kSearched, "search/searches",
     "Points of the difference that the last `gjk` has asked for."},
    {"compared_bodies", kCompared, "body compared/bodies compared",
     "Bodies of the last `compare`."},
    {"compared_pairs", kCompared, "by brute force", "Pairs of them that brute force would test."},
    {"compared_overlaps", kCompared, "overlap of boxes/overlaps of boxes",
     "Those whose boxes overlap after its step, by every kind."},
    {"least_work", kCompared, "comparison a step/comparisons a step",
     "Comparisons of the kind that needed fewest in its step, to make ready and to find pairs."},
    {"walls", kCompiled, "", "Walls of the level."},
    {"wall_pieces", kCompiled, "", "Walls after lines have cut them."},
    {"sectors", kCompiled, "", "Leaves of the level's BSP."},
    {"sector_pairs", kCompiled, "pair of sectors/pairs of sectors",
     "All pairs of sectors there are."},
    {"cuts", kCompiled, "", "Walls that a line has cut in two."},
    {"lines_tried", kCompiled, "line tried/lines tried",
     "Lines of walls that its compiler tried, to divide regions."},
    {"side_tests", kCompiled, "", "Tests that took: on which side of a line a piece of wall lies."},
    {"plane_score", kCompiled, "score", "Score of the line that divides the whole level."},
    {"first_wall_score", kCompiled, "the first wall's score",
     "What the first wall to divide it would have scored."},
    {"sector", kLocated, "sector", "Where the last `locate` ended, from 1."},
    {"planes_tested", kLocated, "line asked/lines asked",
     "Lines that it asked for the point's side."},
    {"bodies_here", kLocated, "in this sector",
     "Bodies in that sector, if the level holds the bodies."},
    {"portals", kSighted, "", "Openings between two sectors of the level."},
    {"portals_tested", kSighted, "portal tested/portals tested",
     "How often a portal was held against the view through others."},
    {"visible_pairs", kSighted, "pair sees each other/pairs see each other",
     "Pairs of sectors that see each other."},
    {"sectors_seen", kEyed, "sector seen/sectors seen",
     "Sectors that the eye's sector sees, itself among them."},
    {"bodies_seen", kEyed, "body seen/bodies seen",
     "Bodies in these, if the level holds the bodies."},
    {"textures", kAtlas, "", "Textures packed."},
    {"refused", kAtlas, "refused", "Textures that fit nowhere."},
    {"used_area", kAtlas, "pixel used/pixels used", "Pixels under textures."},
    {"free_area", kAtlas, "pixel free/pixels free", "Pixels left free."},
    {"atlas_area", kAtlas, "pixel in all/pixels in all", "Pixels of the atlas."},
    {"free_leaves", kAtlas, "free leaf/free leaves", "Leaves without a texture."},
    {"leaf_tests", kAtlas, "leaf looked at/leaves looked at",
     "Leaves looked at, by packing and by questions for room."},
    {"room", kRoom, "has room", "1 if the last `ask_room` found room, 0 if not."},
    {"bindings", kDrawn, "", "Times that the last `draw` had to bind another image, so far."},
    {"draws", kDrawn, "", "Elements that it has drawn."},
};

constexpr CountDoc kTexts[] = {
    {"texture", kAtlas, "", "The texture that the frame is about."},
    {"refused_names", kAtlas, "", "Names of the textures that were refused, or \"none\"."},
    {"time", kTime, "", "Seconds of world time, with two decimals."},
};

constexpr CountDoc kMeasures[] = {
    {"tree_cost", kBoxes, "",
     "Sum of the perimeters, in a 3D world of the surfaces, of all inner nodes' boxes.", Most::size,
     "units"},
    {"energy", kPhysics, "", "Kinetic and potential energy.", Most::unbounded, "J"},
    {"kinetic_energy", kPhysics, "", "Energy of motion and rotation.", Most::size, "J"},
    {"potential_energy", kPhysics, "", "Energy of height and of springs.", Most::unbounded, "J"},
    {"momentum", kPhysics, "", "Length of the momentum of all bodies.", Most::size, "N s"},
    {"angular_momentum", kPhysics, "",
     "Angular momentum of all bodies about the origin; its length in a 3D world.", Most::unbounded,
     "J s"},
    {"penetration", kContacts, "", "How deep the deepest contact of the last world step overlaps.",
     Most::size, "units"},
    {"gap", kSeparated, "",
     "How far the last `separate` found its bodies apart along the axis that parts them; 0 if none "
     "does.",
     Most::size, "units"},
    {"overlap", kSeparated, "", "Where none parts them, how far they overlap along the best one.",
     Most::size, "units"},
    {"distance", kSearched, "", "Of the bodies of the last `gjk`; 0 if they overlap.", Most::size,
     "units"},
    {"time_of_impact", kContacts, "",
     "When the first of the last world step's impacts was, as a part of the step; 1 if it located "
     "none.",
     Most::part_of_step, "of a step"},
    {"joint_gap", kJoints, "",
     "How far the joint that holds worst is from holding: a pin's points apart, a rod too long or "
     "short.",
     Most::size, "units"},
};

constexpr CountDoc kBodyMeasures[] = {
    {"energy", kBodies, "",
     "Kinetic and potential energy; of a spring between two dynamic bodies, half.", Most::unbounded,
     "J"},
    {"kinetic_energy", kBodies, "", "Energy of its motion and rotation.", Most::size, "J"},
    {"potential_energy", kBodies, "", "Energy of its height and springs.", Most::unbounded, "J"},
    {"speed", kBodies, "", "Of its centre, in units a second.", Most::size, "units/s"},
    {"spin", kBodies, "",
     "Its angular velocity in rad/s, counter-clockwise; its length in a 3D world.", Most::unbounded,
     "rad/s"},
    {"angular_momentum", kBodies, "", "About its own centre; its length in a 3D world.",
     Most::unbounded, "J s"},
    {"own_spin_x", kSolid, "", "Its angular velocity in rad/s about its own x axis, in a 3D world.",
     Most::unbounded, "rad/s"},
    {"own_spin_y", kSolid, "", "About its own y axis.", Most::unbounded, "rad/s"},
    {"own_spin_z", kSolid, "", "About its own z axis.", Most::unbounded, "rad/s"},
    {"x", kBodies, "", "Where its centre is.", Most::unbounded, "units"},
    {"y", kBodies, "", "The same along y.", Most::unbounded, "units"},
    {"z", kSolid, "", "The same along z, in a 3D world.", Most::unbounded, "units"},
    {"penetration", kContacts, "", "How deep its deepest contact of the last world step overlaps.",
     Most::size, "units"},
};

std::string told(const CountRule& rule, const ScriptPast& past) {
  return fmt::format(fmt::runtime(rule.why_not), to_string(past.structure().kind));
}

// The first of the rule and of those before it that does not hold; null if all do.
const CountRule* broken(const CountRule& rule, const ScriptPast& past) {
  const CountRule* before = rule.first ? broken(*rule.first, past) : nullptr;
  return before || !past.is_sure() || rule.holds(past) ? before : &rule;
}

}  // namespace

ScriptPast::ScriptPast(const ScenarioSpec& scenario, int dimension)
    : scenario_(scenario), dimension_(dimension), structure_(scenario.structure) {}

void ScriptPast::note(const Verb& verb) {
  if (std::holds_alternative<CompileLevel>(verb)) {
    times_[Verb(See()).index()] = 0;
    located_ = eyed_ = false;
    if (!scenario_.bodies.empty() && structure_.kind == StructureKind::none) {
      structure_.kind = StructureKind::bsp;
      structure_.of_level = true;
    }
  }
  if (const auto* rebuild = std::get_if<Rebuild>(&verb)) structure_ = rebuild->structure;
  const auto* see = std::get_if<See>(&verb);
  eyed_ |= see && see->eye;
  located_ |= (see && see->eye) || std::holds_alternative<Locate>(verb) ||
              std::holds_alternative<OrderFrom>(verb);
  ++times_[verb.index()];
}

bool ScriptPast::has_asked() const { return has<CastRay>() || has<Cull>() || has<Query>(); }

bool CountDoc::for_atlas() const { return !for_world() || &rule == &kTree; }
bool CountDoc::for_world() const { return &rule != &kAtlas && rule.first != &kAtlas; }

std::string CountDoc::words(bool one) const {
  const std::size_t slash = noun.find('/');
  if (!noun.empty())
    return std::string(one || slash == noun.npos ? noun.substr(0, slash) : noun.substr(slash + 1));
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  if (one && words.ends_with('s')) words.pop_back();
  return words;
}

std::span<const CountDoc> known_body_measures() { return kBodyMeasures; }
std::span<const CountDoc> known_counts() { return kCounts; }
std::span<const CountDoc> known_texts() { return kTexts; }
std::span<const CountDoc> known_measures() { return kMeasures; }

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

std::string why_not_counted(const CountDoc& count, const ScriptPast& past) {
  const CountRule* rule = broken(count.rule, past);
  return rule ? told(*rule, past) : std::string();
}

std::string why_not_measured(const CountDoc& measure, const ScriptPast& past) {
  return &measure.rule == &kBodies || measure.rule.holds(past) ? "" : told(measure.rule, past);
}

}  // namespace lantern::language
