// Verbs of a level and of an atlas, as they are read: `compile`, `locate`, `order` and `see`;
// `pack`, `ask_room` and `draw`.
#include <fmt/format.h>

#include "geometry/flat.hpp"
#include "language/keys/key.hpp"
#include "language/script/script_reading.hpp"

namespace lantern::language {
namespace {

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

std::vector<VerbDoc> verbs_of_levels() {
  return {
      verb<CompileLevel>(
          {.doc = "The level's walls become a BSP, whose leaves are the sectors. "
                  "Bodies of a scenario without a [structure] lie in it from then "
                  "on, each in every sector that its box reaches.",
           .keys = {pace_key(), events_key({"consider", "choose", "cut", "sector"})}}),
      verb<Locate>({.doc = "In which sector of the compiled level is a point?",
                    .keys = {point_key(&Locate::point, "point", "The point asked for.")}},
                   require_compiled<Locate>),
      verb<OrderFrom>({.doc = "The sectors of the compiled level, front to back.",
                       .keys = {point_key(&OrderFrom::eye, "eye", "Where they are seen from.")}},
                      require_compiled<OrderFrom>),
      verb<See>({.doc = "Which sectors of the compiled level see which through the openings "
                        "between them: found once, and then only looked up.",
                 .keys = {pace_key(), events_key({"portals", "row"}),
                          key(&See::eye, "eye", "Whose sector's view is shown.", range(-kFar, kFar),
                              written("[x, y]"), or_else("no sector's"))}},
                read_see)};
}

std::vector<VerbDoc> verbs_of_atlases() {
  return {
      verb<Pack>(
          {.doc = "Textures enter the atlas, one after another. One that fits nowhere is refused.",
           .keys = {key(KeyType::texts, "textures",
                        "Names of textures, or of their patterns for all of theirs.", must()),
                    key(&Pack::each, "each", "One frame a texture, or one for all."),
                    key(&Pack::free_name, "free_name",
                        "Labels the largest free leaf that the last one leaves.", range(1, 24),
                        or_else("none")),
                    pace_key(), events_key({"too_small", "used", "cut", "store", "refuse"})}},
          read_pack),
      verb<AskRoom>({.doc = "The kD-tree's own question: has any free leaf room for this size?",
                     .keys = {key(KeyType::size, "size", "The width and height asked for.", must(),
                                  range(1, kMostPixels), in("px"))}},
                    read_ask_room),
      verb<DrawScreen>(
          {.doc = "Draws all elements of the [atlas]'s `screen`, and counts how often another "
                  "image must be bound. Each `draw` begins with an empty screen and nothing bound.",
           .keys =
               {key(&DrawScreen::from, "from",
                    "Each element from its own texture, or all from the atlas that holds them."),
                key(&DrawScreen::order, "order",
                    "`as_listed`, or `by_texture`: sorted so that equal textures follow each "
                    "other, but what lies over another element still comes after it."),
                pace_key(), events_key({"bind", "draw"})}},
          read_draw)};
}

}  // namespace lantern::language
