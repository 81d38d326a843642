// Bodies, one by one and by patterns.
#include <fmt/format.h>

#include "scenario/draft.hpp"

namespace lantern {
namespace {

bool has_no_size(const BodySpec& body) {
  return bounding_box(body.shape, Vec<3>(0.0)).size() == Vec<3>(0.0);
}

// The shape's key.
const char* size_key(const TableReader& table) {
  for (const char* key : {"half_size", "capsule", "ground"})
    if (table.has(key)) return key;
  return "radius";
}

// `key` is what makes it move.
void check_motion(const BodySpec& body, bool moves, const TableReader& table, const char* key,
                  Draft& draft) {
  if (!moves) return;
  if (body.kind == BodyKind::static_body)
    draft.problems.add(table.place(key), fmt::format("a static body has no {}", key),
                       table.has("ground") ? fmt::format("leave out {}", key)
                                           : fmt::format("leave out either static or {}", key));
  else if (has_no_size(body))
    draft.problems.add(table.place(size_key(table)),
                       fmt::format("'{}' is zero: a body that moves needs a size", size_key(table)),
                       fmt::format("or leave out {}", key));
}

// Says so once, where they become too many.
bool has_room_for_bodies(std::size_t count, Place where, Draft& draft) {
  return draft.has_room_for(draft.scenario.bodies.size() + count, kMostBodies, "bodies", where);
}

// Whom it follows may be declared later.
void note_follower(const TableReader& table, std::size_t count, Draft& draft) {
  if (const auto name = table.text("follow"))
    draft.followers.push_back(
        {draft.scenario.bodies.size(), count, {*name, table.place("follow")}});
}

void read_body(const TomlValue& value, Draft& draft) {
  const TableReader table = open(value, language_table("body"), draft);
  BodySpec body = read_body_keys(table, draft);
  body.position = table.point("position").value_or(Vec<3>(0.0));
  body.velocity = table.point("velocity").value_or(Vec<3>(0.0));
  check_motion(body, body.velocity != Vec<3>(0.0), table, "velocity", draft);
  check_motion(body, body.spin != 0, table, "spin", draft);
  if (table.is_good("speed") && body.brain == Brain::none)
    draft.problems.add(table.key_place("speed"), "'speed' is of a body that follows or wanders",
                       "say where it goes: velocity");
  if (!has_room_for_bodies(1, value.where, draft)) return;
  if (!body.name.empty())
    draft.bodies.add(body.name, {draft.scenario.bodies.size(), 1, table.place("name")}, true,
                     draft.problems);
  note_follower(table, 1, draft);
  draft.scenario.bodies.push_back(std::move(body));
}

void read_pattern(const TomlValue& value, Draft& draft) {
  const TableReader table = open(value, language_table("pattern"), draft);
  const BodySpec like = read_body_keys(table, draft);
  check_motion(like, table.number("speed").value_or(0) > 0, table, "speed", draft);
  check_motion(like, like.spin != 0, table, "spin", draft);
  const auto count = static_cast<std::size_t>(table.whole("count").value_or(1));
  if (!has_room_for_bodies(count, table.place("count"), draft) || like.name.empty()) return;
  const NamedRange range{draft.scenario.bodies.size(), count, table.place("name")};
  if (!draft.bodies.add(like.name, range, true, draft.problems)) return;
  note_follower(table, count, draft);
  unroll_pattern(like, count, table, draft);
}

void find_the_followed(Draft& draft) {
  auto& bodies = draft.scenario.bodies;
  for (const Follower& f : draft.followers) {
    const auto followed = one_body(f.followed, draft);
    if (!followed) continue;
    if (f.first <= *followed && *followed < f.first + f.count)
      draft.problems.add(f.followed.where, "a body cannot follow itself",
                         "name another one in 'follow'");
    for (std::size_t i = f.first; i < f.first + f.count; ++i) bodies[i].follows = *followed;
  }
}

}  // namespace

void read_bodies(const TableReader& file, Draft& draft) {
  const auto bodies = file.tables("body");
  const auto patterns = file.tables("pattern");
  if (!file.has("world") && (!bodies.empty() || !patterns.empty()))
    draft.problems.add((bodies.empty() ? patterns : bodies)[0]->where, "bodies need a [world]",
                       "add [world] with size = [64, 64]");
  for (const TomlValue* value : bodies) read_body(*value, draft);
  for (const TomlValue* value : patterns) read_pattern(*value, draft);
  find_the_followed(draft);
}

}  // namespace lantern
