// `move`: a body is put elsewhere, turned, or goes another way.
#include <fmt/format.h>

#include "scenario/key.hpp"
#include "scenario/language_parts.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern {
namespace {

bool never_turns(const BodySpec& body) {
  return std::holds_alternative<AxisBox<3>>(body.shape) ||
         std::holds_alternative<HalfSpace<3>>(body.shape);
}

// Adds a problem if the body cannot go, or turn, as the key says.
void check_can(const TableReader& table, const char* key, const BodySpec& body) {
  const bool no_size = bounding_box(body.shape, Vec<3>(0.0)).size() == Vec<3>(0.0);
  const bool is_static = body.kind == BodyKind::static_body;
  if (is_static || no_size)
    table.bad_value(key, fmt::format("'{}' {}, it can have no {}", body.name,
                                     is_static ? "is static" : "has no size", key));
}

}  // namespace

TableDoc Move::table() {
  using namespace keys;
  return {
      .doc = "A body is put elsewhere, turned, or goes another way from now on.",
      .keys =
          {
              body_key(),
              key(&Move::to, "to", "Its new position.", range(-kFar, kFar), or_else("where it is")),
              key(&Move::velocity, "velocity", "Its new velocity.", range(-kFar, kFar),
                  in("units/s"), or_else("as it is")),
              key(&Move::turned, "turned", "How far it is turned from now on.",
                  range(-kMostTurn, kMostTurn), in("°"), or_else("as it is")),
              key(&Move::spin, "spin", "How fast it turns from now on.",
                  range(-kMostTurn, kMostTurn), in("°/s"), or_else("as it does")),
              key(&Move::rebuild, "rebuild", "The structure is rebuilt, or left as it was."),
          },
      .groups = {{{"to"}, {"velocity"}, {"turned"}, {"spin"}}, false},
      .example = R"([[step]]
do = "move"
body = "pink"
to = [2, 2]
velocity = [4, 0]
expect = { position = { pink = [2, 2] } }
)"};
}

void Move::read(const TableReader& table, ScriptReading& script) {
  const auto found = script.present_body(table, "body");
  if (!found) return;
  body = *found;
  const BodySpec& moved = script.draft.scenario.bodies[body];
  if (velocity.value_or(Vec<3>(0.0)) != Vec<3>(0.0)) check_can(table, "velocity", moved);
  if (spin.value_or(0) != 0) check_can(table, "spin", moved);
  for (const char* key : {"turned", "spin"})
    if (table.has(key) && never_turns(moved))
      table.bad_key(key, fmt::format("'{}' never turns", moved.name),
                    "a box turns if it has oriented = true");
}

void Move::change(Engine& engine) const { engine.move(*this); }

void Move::act(ScriptRun& run) const {
  change(run.engine());
  if (rebuild) run.engine().rebuild();
  run.focus(body);
  run.frames.settle("move");
}

}  // namespace lantern
