#include "language/counts.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/suggest.hpp"
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

constexpr CountDoc kTexts[] = {
    {"texture", when::with_atlas, "", "The texture that the frame is about."},
    {"refused_names", when::with_atlas, "",
     "Names of the textures that were refused, or \"none\"."},
    {"time", when::time, "", "Seconds of world time, with two decimals."},
};

constexpr CountDoc kBodyMeasures[] = {
    {"energy", when::bodies, "",
     "Kinetic and potential energy; of a spring between two dynamic bodies, half.", Most::unbounded,
     "J"},
    {"kinetic_energy", when::bodies, "", "Energy of its motion and rotation.", Most::size, "J"},
    {"potential_energy", when::bodies, "", "Energy of its height and springs.", Most::unbounded,
     "J"},
    {"speed", when::bodies, "", "Of its centre, in units a second.", Most::size, "units/s"},
    {"spin", when::bodies, "",
     "Its angular velocity in rad/s, counter-clockwise; its length in a 3D world.", Most::unbounded,
     "rad/s"},
    {"angular_momentum", when::bodies, "", "About its own centre; its length in a 3D world.",
     Most::unbounded, "J s"},
    {"own_spin_x", when::solid, "",
     "Its angular velocity in rad/s about its own x axis, in a 3D world.", Most::unbounded,
     "rad/s"},
    {"own_spin_y", when::solid, "", "About its own y axis.", Most::unbounded, "rad/s"},
    {"own_spin_z", when::solid, "", "About its own z axis.", Most::unbounded, "rad/s"},
    {"x", when::bodies, "", "Where its centre is.", Most::unbounded, "units"},
    {"y", when::bodies, "", "The same along y.", Most::unbounded, "units"},
    {"z", when::solid, "", "The same along z, in a 3D world.", Most::unbounded, "units"},
    {"penetration", when::contacts, "",
     "How deep its deepest contact of the last world step overlaps.", Most::size, "units"},
    {"half_width", when::bodies, "",
     "Half the width of its box, as the lecture's UpdateBroadphaseAABB finds it.", Most::size,
     "units"},
    {"half_height", when::bodies, "", "The same along y.", Most::size, "units"},
    {"leaves", when::structure, "leaf/leaves", "Leaves that store it: a count, as the next five.",
     Most::parts},
    {"pairs", when::structure, "", "Candidate pairs that it is one of.", Most::bodies},
    {"depth", when::structure, "level deep/levels deep",
     "Depth of the deepest leaf that stores it.", Most::depth},
    {"id", when::structure, "", "By which pairs are ordered; of all bodies another one.",
     Most::unbounded},
    {"address", when::structure, "", "Where it lies in memory, as the scenario says.",
     Most::unbounded},
    {"key", when::structure, "", "The lecture's key a + (b << 8) of the first pair it is in.",
     Most::unbounded},
};

std::vector<CountDoc>& counts() {
  static std::vector<CountDoc> all;
  return all;
}
std::vector<CountDoc>& measures() {
  static std::vector<CountDoc> all;
  return all;
}

void add(std::span<const CountDoc> rows, std::vector<CountDoc>& to) {
  for (const CountDoc& row : rows) {
    require_own_name("count", row.name, find_count(row.name) != nullptr);
    to.push_back(row);
  }
}

std::string told(const CountRule& rule, const ScriptPast& past) {
  return fmt::format(fmt::runtime(rule.why_not), to_string(past.structure().kind));
}

// The first of the rule and of those before it that does not hold; null if all do.
const CountRule* broken(const CountRule& rule, const ScriptPast& past) {
  const CountRule* before = rule.first ? broken(*rule.first, past) : nullptr;
  return before || !past.is_sure() || rule.holds(past) ? before : &rule;
}

}  // namespace

namespace when {

const CountRule with_atlas = {"with an atlas", "the scenario has no [atlas]",
                              [](const Past& past) { return past.scenario().atlas.has_value(); }};
const CountRule room = {"after an `ask_room`", "no step has asked for room yet", after<AskRoom>,
                        &with_atlas};
const CountRule drawn = {"after a `draw`", "no step has drawn the screen yet", after<DrawScreen>,
                         &with_atlas};

const CountRule no_atlas = {"", "an atlas has none", [](const Past& past) {
                              return !past.scenario().atlas || !past.scenario().bodies.empty();
                            }};
const CountRule time = {"always", "the scenario has no bodies",
                        [](const Past& past) { return past.scenario().has_world(); }, &no_atlas};
const CountRule bodies = {"always", "the scenario has no bodies",
                          [](const Past& past) { return !past.scenario().bodies.empty(); },
                          &no_atlas};
const CountRule solid = {"in a 3D world", "this world is 2D",
                         [](const Past& past) { return past.dimension() != 2; }, &bodies};

const CountRule structure = {
    "with a structure", "there is no structure at this step",
    [](const Past& past) { return past.structure().kind != StructureKind::none; }, &bodies};
const CountRule any_tree = {"", "the scenario has no bodies", [](const Past& past) {
                              return with_atlas.holds(past) || is_compiled(past) ||
                                     bodies.holds(past);
                            }};
const CountRule tree = {"with a structure", "there is no structure at this step",
                        [](const Past& past) {
                          return with_atlas.holds(past) || is_compiled(past) ||
                                 structure.holds(past);
                        },
                        &any_tree};
const CountRule kd_tree = {
    "with a kD-tree", "there is no kd_tree at this step",
    [](const Past& past) { return traits_of(past.structure().kind).is_fitted; }, &structure};
const CountRule printed = {"with `as_printed`", "no lecture_quadtree is as printed at this step",
                           [](const Past& past) { return past.structure().as_printed; },
                           &structure};
const CountRule sweep = {"with `sort_and_sweep`", "there is no sort_and_sweep at this step",
                         stands_with<Setting::axis>, &structure};
const CountRule boxes = {"with an `aabb_tree`", "there is no aabb_tree at this step",
                         stands_with<Setting::margin>, &structure};
const CountRule array = {"with a tree whose leaves share an array, or `lecture_quadtree`",
                         "the leaves of '{}' share no array",
                         [](const Past& past) {
                           const StructureTraits traits = traits_of(past.structure().kind);
                           return traits.shares_array || traits.is_plain;
                         },
                         &structure};
const CountRule inside = {"with a structure that is not the user's own",
                          "'{}' is seen from outside, nobody counts its tests and its memory",
                          [](const Past& past) { return !traits_of(past.structure().kind).is_own; },
                          &structure};
const CountRule split = {"with `split_static`", "the structure has no split_static",
                         [](const Past& past) { return past.structure().split_static; },
                         &structure};
const CountRule asleep_nodes = {
    "with a structure and `may_sleep`, contacts or `split_static`", "in this world nothing sleeps",
    [](const Past& past) { return past.scenario().tells_sleepers(); }, &structure};

const CountRule contacts = {"with contacts", "this world has no contacts",
                            [](const Past& past) { return past.scenario().has_contacts(); },
                            &bodies};
const CountRule joints = {"with rods or pins", "this world has no joints",
                          [](const Past& past) { return past.scenario().has_joints(); }, &bodies};
const CountRule sleep = {
    "with `may_sleep`, contacts or `split_static`", "in this world nothing sleeps",
    [](const Past& past) { return past.scenario().tells_sleepers(); }, &bodies};
const CountRule physics = {"with contacts, gravity, springs or joints",
                           "this world has no contacts, gravity, springs or joints",
                           [](const Past& past) { return past.scenario().has_physics(); }, &bodies};
const CountRule islands = {
    "with the panel `islands`", "there is no panel 'islands'",
    [](const Past& past) { return shows(past.scenario().panels, "islands"); }, &bodies};

const CountRule query = {"after a ray, cull or query",
                         "no step has sent a ray, culled or queried yet",
                         [](const Past& past) { return past.has_asked(); }, &bodies};
const CountRule shapes = {"after a `test_shapes`", "no step has tested shapes yet",
                          after<TestShapes>, &bodies};
const CountRule separated = {"after a `separate`", "no step has separated two bodies yet",
                             after<Separate>, &bodies};
const CountRule searched = {"after a `gjk`", "no step has asked for a distance by gjk yet",
                            after<SearchDistance>, &bodies};
const CountRule compared = {"after a `compare`", "no step has compared structures yet",
                            after<Compare>, &bodies};

const CountRule level = {"", "the scenario has no [level]",
                         [](const Past& past) { return past.scenario().level.has_value(); }};
const CountRule compiled = {"once the level is compiled", "no step has compiled the level yet",
                            after<CompileLevel>, &level};
const CountRule located = {"after a `locate`, an `order` or a `see` with an eye",
                           "no step has located a point yet",
                           [](const Past& past) { return past.has_located(); }, &compiled};
const CountRule sighted = {"after a `see`", "no step has asked who sees whom yet", after<See>,
                           &compiled};
const CountRule eyed = {"after a `see` with an eye", "no eye has looked yet",
                        [](const Past& past) { return past.has_eye_looked(); }, &compiled};

}  // namespace when

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

bool CountDoc::for_atlas() const { return !for_world() || &rule == &when::tree; }
bool CountDoc::for_world() const {
  return &rule != &when::with_atlas && rule.first != &when::with_atlas;
}

Fronted fronted(std::string_view written) {
  const std::size_t colon = std::min(written.find(':'), written.size());
  std::string_view words = written.substr(std::min(colon + 1, written.size()));
  words.remove_prefix(std::min(words.find_first_not_of(' '), words.size()));
  return {std::string(written.substr(0, colon)), std::string(words)};
}

std::string CountDoc::forms() const {
  if (!noun.empty()) return std::string(noun);
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words.ends_with('s') && !words.ends_with("ss")
             ? words.substr(0, words.size() - 1) + "/" + words
             : words;
}

std::span<const CountDoc> known_body_measures() { return kBodyMeasures; }
bool is_counted(const CountDoc& of_body) {
  return is_counted(static_cast<BodyMeasure>(&of_body - kBodyMeasures));
}
std::span<const CountDoc> known_counts() { return counts(); }
std::span<const CountDoc> known_texts() { return kTexts; }
std::span<const CountDoc> known_measures() { return measures(); }

void add_counts(std::span<const CountDoc> rows) { add(rows, counts()); }
void add_measures(std::span<const CountDoc> rows) { add(rows, measures()); }

const CountDoc* find_in(std::span<const CountDoc> docs, std::string_view name) {
  const auto found = std::ranges::find(docs, name, &CountDoc::name);
  return found == docs.end() ? nullptr : &*found;
}

const CountDoc* find_count(std::string_view name) {
  const CountDoc* count = find_in(counts(), name);
  return count ? count : find_in(measures(), name);
}

std::vector<std::string_view> names_of_counts() {
  std::vector<std::string_view> names = mapped(counts(), &CountDoc::name);
  for (const CountDoc& doc : measures()) names.push_back(doc.name);
  return names;
}

std::string why_not_counted(const CountDoc& count, const ScriptPast& past) {
  const CountRule* rule = broken(count.rule, past);
  return rule ? told(*rule, past) : std::string();
}

std::string why_not_measured(const CountDoc& measure, const ScriptPast& past) {
  return &measure.rule == &when::bodies || measure.rule.holds(past) ? "" : told(measure.rule, past);
}

}  // namespace lantern::language
