// Verbs of bodies, as they are read: `insert`, `emit`, `remove`, `move`, `sleep`, `wake`, `force`
// and `impulse`.
#include <fmt/format.h>

#include "language/keys/key.hpp"
#include "language/script/script_reading.hpp"

namespace lantern::language {
namespace {

void read_insert(Insert& insert, const TableReader& table, ScriptReading& script) {
  insert.bodies = script.bodies.take(table.names("bodies"), script.state.in_world, true,
                                     "is in the world already");
}

void read_emit(Emit& emit, const TableReader& table, ScriptReading& script) {
  emit.bodies = script.bodies.take(table.names("bodies"), script.state.in_world, true,
                                   "is in the world already");
  emit.every = script.read_ticks(table, "every");
  for (std::size_t i = 0; i < emit.bodies.size(); ++i)
    script.state.due[emit.bodies[i]] = script.state.least_ticks + i * emit.every;
}

void read_remove(Remove& remove, const TableReader& table, ScriptReading& script) {
  remove.bodies = script.bodies.take(table.names("bodies"), script.state.in_world, false,
                                     "is not in the world at this step");
}

// Adds a problem if the body cannot go, or turn, as the key says.
void check_can(const TableReader& table, const char* key, const BodySpec& body) {
  const bool no_size = bounding_box(body.shape, Vec<3>(0.0)).size() == Vec<3>(0.0);
  const bool is_static = body.kind == BodyKind::static_body;
  if (is_static || no_size)
    table.bad_value(key, fmt::format("'{}' {}, it can have no {}", body.name,
                                     is_static ? "is static" : "has no size", key));
}

void read_move(Move& move, const TableReader& table, ScriptReading& script) {
  const auto found = script.present_body(table, "body");
  if (!found) return;
  move.body = *found;
  const BodySpec& moved = script.draft.scenario.bodies[move.body];
  if (move.velocity.value_or(Vec<3>(0.0)) != Vec<3>(0.0)) check_can(table, "velocity", moved);
  if (move.spin.value_or(0) != 0) check_can(table, "spin", moved);
  for (const char* key : {"turned", "spin"})
    if (table.has(key) && !turns<3>(moved.shape))
      table.bad_key(key, fmt::format("'{}' never turns", moved.name),
                    "a box turns if it has oriented = true");
}

template <bool kAsleep>
void read_rest(Rest<kAsleep>& rest, const TableReader& table, ScriptReading& script) {
  const std::vector<Named> written = table.names("bodies");
  for (const Named& named : written) {
    const NamedRange* range = script.draft.bodies.find(named.name);
    if (range && script.draft.scenario.bodies[range->first].kind != BodyKind::dynamic_body)
      script.draft.problems.add(
          named.where,
          fmt::format("'{}' is not dynamic: it cannot {}", named.name, rest.kTraits.name),
          "only dynamic bodies sleep and wake");
  }
  script.require_sleep(table.place("do"));
  rest.bodies = script.bodies.present(written);
}

// A dynamic body, of `force` and `impulse`.
template <class V>
void read_push(V& push, const TableReader& table, ScriptReading& script) {
  const auto body = script.present_body(table, "body");
  if (!body) return;
  push.body = *body;
  const BodySpec& spec = script.draft.scenario.bodies[*body];
  if (spec.kind != BodyKind::dynamic_body)
    table.bad_value(
        "body",
        fmt::format("'{}' is {}: no {} moves it", spec.name,
                    names(spec.kind)[static_cast<std::size_t>(spec.kind)], V::kTraits.name),
        "name a dynamic body");
}

template <class V>
KeyDoc at_key() {
  return key(&V::at, "at", "Where, from the body's centre, in the world's axes.",
             range(-kFar, kFar), or_else("the centre"));
}

}  // namespace

std::vector<VerbDoc> verbs_of_bodies() {
  return {
      verb<Insert>({.doc = "Bodies enter the world and the structure, one after another.",
                    .keys = {bodies_key(), pace_key(),
                             events_key({"test", "miss", "make_child", "store", "split",
                                         "hand_down", "depth_limit", "no_progress", "rotate"})}},
                   read_insert),
      verb<Emit>({.doc = "Bodies enter the world one after another while time passes: the first at "
                         "once, the others when later steps let time pass.",
                  .keys = {bodies_key(), key(KeyType::number, "every",
                                             "From one to the next, a whole number of time steps.",
                                             must(), above(0, kHundredYears), in("s"))}},
                 read_emit),
      verb<Remove>({.doc = "Bodies leave the world and the structure.", .keys = {bodies_key()}},
                   read_remove),
      verb<Move>(
          {.doc = "A body is put elsewhere, turned, or goes another way from now on.",
           .keys =
               {
                   body_key(),
                   key(&Move::to, "to", "Its new position.", range(-kFar, kFar),
                       or_else("where it is")),
                   key(&Move::velocity, "velocity", "Its new velocity.", range(-kFar, kFar),
                       in("units/s"), or_else("as it is")),
                   key(&Move::turned, "turned", "How far it is turned from now on.",
                       range(-kMostTurn, kMostTurn), in("°"), or_else("as it is")),
                   key(&Move::spin, "spin", "How fast it turns from now on.",
                       range(-kMostTurn, kMostTurn), in("°/s"), or_else("as it does")),
                   key(&Move::rebuild, "rebuild", "The structure is rebuilt, or left as it was."),
                   pace_key(),
                   events_key({"leave", "test", "miss", "split", "store", "rotate"}),
               },
           .groups = {{{"to"}, {"velocity"}, {"turned"}, {"spin"}}, false}},
          read_move),
      verb<Sleep>({.doc = "Bodies fall asleep: nothing moves them until something wakes them.",
                   .keys = {bodies_key()}},
                  read_rest<true>),
      verb<Wake>({.doc = "Bodies wake up.", .keys = {bodies_key()}}, read_rest<false>),
      verb<ApplyForce>({.doc = "A force acts on a body from now on, until another takes its place; "
                               "one of zero ends it.",
                        .keys = {body_key(),
                                 key(&ApplyForce::force, "force", "In the world's axes.", must(),
                                     range(-kFar, kFar), in("N")),
                                 at_key<ApplyForce>()}},
                       read_push<ApplyForce>),
      verb<ApplyImpulse>({.doc = "A body is struck once.",
                          .keys = {body_key(),
                                   key(&ApplyImpulse::impulse, "impulse", "In the world's axes.",
                                       must(), range(-kFar, kFar), in("N s")),
                                   at_key<ApplyImpulse>()}},
                         read_push<ApplyImpulse>)};
}

}  // namespace lantern::language
