// Verbs about the structure and what it finds, as they are read: `rebuild`, `sweep` and `compare`;
// `ray`, `cull` and `query`, which it is asked; `test_shapes`, `separate` and `gjk`, the narrow
// phase.

#include <fmt/format.h>

#include "geometry/flat.hpp"
#include "language/keys/key.hpp"
#include "language/script/script_reading.hpp"
#include "spatial/broad_phase.hpp"

namespace lantern::language {
namespace {

// --- rebuild, sweep, compare ---

std::vector<KeyDoc> structure_keys() {
  std::vector<KeyDoc> keys = language_table("structure").keys;
  for (KeyDoc& key : keys) {
    key.required = false;
    key.fallback = {};
    key.otherwise = "as it was";
  }
  return keys;
}

void read_rebuild(Rebuild& rebuild, const TableReader& table, ScriptReading& script) {
  StructureSpec& structure = rebuild.structure = script.state.past.structure();
  if (structure.of_level && !table.has("kind"))
    return table.bad_value("do", "the compiled level holds the bodies, and takes no other settings",
                           "add the kind of another structure, as kind = \"quadtree\"");
  structure.of_level = false;
  structure = read_structure(table, structure, script.draft);
}

void read_sweep(Sweep&, const TableReader& table, ScriptReading& script) {
  const ScriptPast& past = script.state.past;
  if (past.is_sure() && !traits_of(past.structure().kind).has(Setting::axis))
    table.bad_value("do", "there is no sort_and_sweep at this step",
                    "rebuild with kind = \"sort_and_sweep\" first");
  script.frames = 1 + script.draft.scenario.bodies.size();
}

constexpr std::size_t kMostRows = 6;  // that have room in one table

// Empty if it can be compared here; otherwise why not.
std::string why_not_compared(StructureKind kind, const ScriptReading& script) {
  if (!counts_its_work(kind))
    return fmt::format("what a '{}' does is not counted", to_string(kind));
  if (script.draft.dimension == 2 && !is_possible(kind, 2))
    return "an octree needs a 3D world, this one is 2D";
  return {};
}

void read_compare(Compare& compare, const TableReader& table, ScriptReading& script) {
  std::vector<bool> named(script.state.in_world.size());
  compare.bodies = script.bodies.take(table.names("bodies"), named, true, "is named twice");
  if (!script.draft.sides.empty())
    table.bad_value("do", "a scenario with sides has no 'compare'",
                    "it sets every kind beside the others by itself: leave out the sides");
  if (script.state.past.times<Compare>() == kMostRows)
    table.bad_value("do", fmt::format("more than {} worlds are compared", kMostRows));
  if (!table.has("kinds"))
    for (const StructureKind kind : kStructureKinds)
      if (why_not_compared(kind, script).empty()) compare.kinds.push_back(kind);
  for (const StructureKind kind : compare.kinds) {
    const std::string why = why_not_compared(kind, script);
    if (!why.empty()) table.bad_value("kinds", why);
  }
  if (table.is_good("kinds") && compare.kinds.size() < 2)
    table.bad_value("kinds", "one kind alone has nothing beside it", "name two or more");
  for (const auto& [name, micros] : table.list<std::pair<Named, int>>("times")) {
    const auto kind = structure_named(name.name);
    if (!kind)
      script.draft.problems.add_unknown(name.where, "structure", name.name,
                                        [] { return names(StructureKind()); });
    else if (!compare.kinds.empty() && std::ranges::count(compare.kinds, *kind) == 0)
      script.draft.problems.add(name.where, fmt::format("a '{}' is not compared here", name.name));
    else
      compare.times.emplace_back(*kind, micros);
  }
  if (table.has("times") != table.has("machine"))
    table.bad_key(table.has("times") ? "times" : "machine",
                  "'times' and the 'machine' that took them belong together");
}

// --- ray, cull, query ---

// A ray and a view need a direction.
void check_apart(const TableReader& table, const char* from, const char* to) {
  const auto a = table.get<Vec<3>>(from), b = table.get<Vec<3>>(to);
  if (a && b && *a == *b)
    table.bad_value(to, fmt::format("'{}' and '{}' are the same point", from, to),
                    "it goes nowhere");
}

void require_structure(const TableReader& table, std::string_view what, const char* hint,
                       const ScriptReading& script) {
  if (!script.state.past.has_structure())
    table.bad_value("do", fmt::format("there is no structure at this step: {}", what), hint);
}

void require_asked(const TableReader& table, std::string_view verb, const ScriptReading& script) {
  require_structure(table, fmt::format("nothing for '{}'", verb),
                    "kind = \"brute_force\" tests every body", script);
}

void read_ray(CastRay&, const TableReader& table, ScriptReading& script) {
  require_asked(table, "ray", script);
  check_apart(table, "from", "to");
}

void read_cull(Cull& cull, const TableReader& table, ScriptReading& script) {
  require_asked(table, "cull", script);
  check_apart(table, "eye", "target");
  const bool good =
      table.is_good("near") == table.has("near") && table.is_good("far") == table.has("far");
  if (good && cull.far <= cull.near)
    table.bad_value(table.has("far") ? "far" : "near",
                    fmt::format("it sees from {} to {}: that is nothing", cull.near, cull.far),
                    "'far' is greater than 'near'");
}

void read_query(Query& query, const TableReader& table, ScriptReading& script) {
  require_asked(table, "query", script);
  if (const auto center = table.get<Vec<3>>("center")) {
    query.radius = table.get<double>("radius").value_or(1);
    Vec<3> half(query.radius);
    if (script.draft.dimension != 3) half.z = 0;
    query.box = Box<3>::around(*center, half);
  }
  const auto min = table.get<Vec<3>>("min"), max = table.get<Vec<3>>("max");
  if (!min || !max) return;
  query.box = {*min, *max};
  if (!is_valid(query.box))
    table.bad_value("max", "the box has no inside", "'max' lies to the upper right of 'min'");
}

KeyDoc walk_events() { return events_key({"visit", "skip", "hit", "miss"}); }

// --- test_shapes, separate, gjk ---

void read_test_shapes(TestShapes&, const TableReader& table, ScriptReading& script) {
  require_structure(table, "no pairs to test", "kind = \"brute_force\" has all of them", script);
}

KeyDoc pair_key() {
  return key(KeyType::texts, "pair", "Two bodies that are there; no half-spaces.", must());
}

// Two of a flat world, of `separate` and `gjk`. The first two bodies, and problems, if they are
// not.
void read_pair(auto& verb, const TableReader& table, ScriptReading& script) {
  Draft& draft = script.draft;
  if (draft.dimension == 3)
    table.bad_value("do", "this is drawn of flat worlds only",
                    "give the world a size of two numbers");
  const std::vector<Named> written =
      without_ranges(table.names("pair"), draft.bodies, "body", draft.problems);
  if (!table.has("pair")) return;
  script.bodies.present(written);
  std::vector<std::size_t> found;
  for (const Named& name : written) {
    if (!draft.bodies.find(name.name)) return;  // which is told already
    const auto body = one_body(name, draft);
    if (!body) return;
    if (std::holds_alternative<HalfSpace<3>>(draft.scenario.bodies[*body].shape))
      draft.problems.add(name.where,
                         fmt::format("'{}' is a half-space: it has no end to measure", name.name));
    found.push_back(*body);
  }
  if (found.size() != 2)
    return table.bad_value("pair", "a pair is two bodies", "as pair = [\"red\", \"pink\"]");
  verb.a = found[0];
  verb.b = found[1];
}

// Verbs of a level and of an atlas, as they are read: `compile`, `locate`, `order` and `see`;
// `pack`, `ask_room` and `draw`.
template <class V>
void require_compiled(V&, const TableReader& table, ScriptReading& script) {
  if (!script.state.past.has<CompileLevel>())
    table.bad_value("do", fmt::format("'{}' needs the compiled level", V::kTraits.name),
                    "add a step with do = \"compile\" before");
}

void read_see(See& see, const TableReader& table, ScriptReading& script) {
  require_compiled(see, table, script);
  if (!see.eye || !table.is_good("eye") || !script.draft.has_world) return;
  if (!contains(flat(script.draft.scenario.world.bounds), *see.eye))
    table.bad_value("eye",
                    fmt::format("[{}, {}] lies outside of the world", see.eye->x, see.eye->y));
}

template <class V>
KeyDoc point_key(Vec<2> V::*member, std::string_view name, std::string_view meaning) {
  return key(member, name, meaning, range(-kFar, kFar), written("[x, y]"), must());
}

void read_pack(Pack& pack, const TableReader& table, ScriptReading& script) {
  pack.textures =
      script.textures.take(table.names("textures"), script.state.packed, true, "is packed already");
  if (pack.each && !pack.textures.empty()) script.frames = pack.textures.size();
}

void read_ask_room(AskRoom& ask, const TableReader& table, ScriptReading&) {
  const auto size = table.get<Vec<2>>("size").value_or(Vec<2>(1.0));
  ask.width = static_cast<int>(size.x);
  ask.height = static_cast<int>(size.y);
}

void read_draw(DrawScreen& draw, const TableReader& table, ScriptReading& script) {
  const ScenarioSpec& s = script.draft.scenario;
  if (s.elements.empty())
    return table.bad_value("do", "there is no [[element]] to draw",
                           "add [[element]] with texture = \"…\" and at = [0, 0]");
  if (script.state.past.times<DrawScreen>() >= kMostWays)
    table.bad_value("do", fmt::format("more than {} steps draw the screen", kMostWays));
  if (draw.from != DrawScreen::From::atlas) return;
  for (const ElementSpec& element : s.elements)
    if (!script.state.packed[element.texture])
      return table.bad_value(
          "from",
          fmt::format("the texture '{}' is not in the atlas yet", s.textures[element.texture].name),
          "pack it in a step before");
}

}  // namespace

std::vector<VerbDoc> verbs_of_structures() {
  return {
      verb<Rebuild>("The structure is made anew with the settings given; the others stay.",
                    structure_keys(), read_rebuild),
      verb<Sweep>("A `sort_and_sweep` finds its pairs: one frame for each body, in the "
                  "order in which they begin on the axis, then one of all.",
                  {}, read_sweep),
      verb<Compare>(
          "Bodies stand alone in a world of their own, whether they are in this one or not, and go "
          "through one world step; each kind of structure is built for them, then made ready for "
          "where they are after the step, and finds their pairs. Counted are comparisons. What "
          "never moves has a structure of its own, built once. The panel `comparison` shows it.",
          {
              bodies_key(),
              key(&Compare::row, "row", "What this world is called.", must(), range(1, 24)),
              key(&Compare::kinds, "kinds",
                  "Kinds of structures, with the settings of the [structure] that stands. A `bsp` "
                  "chooses planes of its own: once through faces of what never moves, or, where "
                  "all move, anew after the step. To choose them counts as building.",
                  or_else("all of Lantern's own that are possible here and whose work is counted")),
              key(&Compare::verdict, "verdict",
                  "What is said of it, under its picture. It may quote counts, as a caption does.",
                  range(0, 56)),
              key(KeyType::name_wholes, "times",
                  "What a step of some kinds took, in microseconds, as `{ grid = 95 }`: measured "
                  "once and written down, for a frame measures nothing.",
                  range(1, 1e9)),
              key(&Compare::machine, "machine", "The computer that took those `times`.",
                  range(1, 40)),
          },
          read_compare),
      verb<CastRay>(
          "Which bodies does a ray hit? The structure leaves out what it cannot hit.",
          {key(&CastRay::from, "from", "Where it begins.", must(), range(-kFar, kFar)),
           key(&CastRay::to, "to", "Where it ends, unless something stops it.", must(),
               range(-kFar, kFar)),
           key(&CastRay::all, "hits", "It stops at the `nearest` body, or goes through `all`.",
               one_of({"nearest", "all"})),
           pace_key(), walk_events()},
          read_ray),
      verb<Cull>(
          "Which bodies can a camera see? Whole nodes outside its view are left out.",
          {key(&Cull::eye, "eye", "Where the camera is.", must(), range(-kFar, kFar)),
           key(&Cull::target, "target", "Where it looks.", must(), range(-kFar, kFar)),
           key(&Cull::angle, "angle", "How wide its view opens; in a 3D world from bottom to top.",
               above(0, 170), in("°")),
           key(&Cull::near, "near", "It sees nothing nearer.", above(0, kFar)),
           key(&Cull::far, "far", "It sees nothing farther.", above(0, kFar)), pace_key(),
           walk_events()},
          read_cull),
      verb<Query>(
          "Which bodies overlap a box, or a disc or ball?",
          {key(KeyType::point, "min", "Lowest corner of the box.", range(-kFar, kFar)),
           key(KeyType::point, "max", "Highest corner of the box.", range(-kFar, kFar)),
           key(KeyType::point, "center", "Of the disc or ball, instead.", range(-kFar, kFar)),
           key(KeyType::number, "radius", "Of the disc or ball.", above(0, kFar)), pace_key(),
           walk_events()},
          read_query, {{{"min", "max"}, {"center", "radius"}}}),
      verb<TestShapes>("The shapes of all candidate pairs are tested, without comparing "
                       "boxes first, as the lecture's narrow phase does. Nothing moves.",
                       {}, read_test_shapes),
      verb<Separate>("Which axis parts two bodies? The narrow phase's own test, axis by "
                     "axis, until there is a gap; in a flat world.",
                     {pair_key(), pace_key(), events_key({"axis"})}, read_pair<Separate>),
      verb<SearchDistance>(
          "How far are two bodies apart? GJK finds it by asking for points of their "
          "Minkowski difference, each farther towards the origin; in a flat world.",
          {pair_key(), pace_key(), events_key({"support", "simplex"})}, read_pair<SearchDistance>)};
}

std::vector<VerbDoc> verbs_of_levels() {
  return {verb<CompileLevel>("The level's walls become a BSP, whose leaves are the sectors. "
                             "Bodies of a scenario without a [structure] lie in it from then "
                             "on, each in every sector that its box reaches.",
                             {pace_key(), events_key({"consider", "choose", "cut", "sector"})}),
          verb<Locate>("In which sector of the compiled level is a point?",
                       {point_key(&Locate::point, "point", "The point asked for.")},
                       require_compiled<Locate>),
          verb<OrderFrom>("The sectors of the compiled level, front to back.",
                          {point_key(&OrderFrom::eye, "eye", "Where they are seen from.")},
                          require_compiled<OrderFrom>),
          verb<See>("Which sectors of the compiled level see which through the openings "
                    "between them: found once, and then only looked up.",
                    {pace_key(), events_key({"portals", "row"}),
                     key(&See::eye, "eye", "Whose sector's view is shown.", range(-kFar, kFar),
                         written("[x, y]"), or_else("no sector's"))},
                    read_see)};
}

std::vector<VerbDoc> verbs_of_atlases() {
  return {
      verb<Pack>("Textures enter the atlas, one after another. One that fits nowhere is refused.",
                 {key(KeyType::texts, "textures",
                      "Names of textures, or of their patterns for all of theirs.", must()),
                  key(&Pack::each, "each", "One frame a texture, or one for all."),
                  key(&Pack::free_name, "free_name",
                      "Labels the largest free leaf that the last one leaves.", range(1, 24),
                      or_else("none")),
                  pace_key(), events_key({"too_small", "used", "cut", "store", "refuse"})},
                 read_pack),
      verb<AskRoom>("The kD-tree's own question: has any free leaf room for this size?",
                    {key(KeyType::size, "size", "The width and height asked for.", must(),
                         range(1, kMostPixels), in("px"))},
                    read_ask_room),
      verb<DrawScreen>(
          "Draws all elements of the [atlas]'s `screen`, and counts how often another "
          "image must be bound. Each `draw` begins with an empty screen and nothing bound.",
          {key(&DrawScreen::from, "from",
               "Each element from its own texture, or all from the atlas that holds them."),
           key(&DrawScreen::order, "order",
               "`as_listed`, or `by_texture`: sorted so that equal textures follow each "
               "other, but what lies over another element still comes after it."),
           pace_key(), events_key({"bind", "draw"})},
          read_draw)};
}

}  // namespace lantern::language
