// Verbs that change who is where, and those of the atlas.

#include <fmt/format.h>

#include "geometry/angle.hpp"
#include "scenario/script.hpp"

namespace lantern {

std::optional<std::size_t> read_present_body(const TableReader& table, const char* key,
                                             Scope& scope) {
  const auto name = table.text(key);
  const auto body = name ? one_body({*name, table.place(key)}, scope.draft) : std::nullopt;
  if (!body) return std::nullopt;
  if (!scope.state.in_world[*body])
    scope.draft.problems.add(table.place(key),
                             fmt::format("'{}' is not in the world at this step", *name),
                             "insert it first");
  return body;
}

namespace {

bool never_turns(const BodySpec& body) {
  return std::holds_alternative<AxisBox<3>>(body.shape) ||
         std::holds_alternative<HalfSpace<3>>(body.shape);
}

// Adds a problem if the body cannot go, or turn, as the key says.
void check_motion(const TableReader& table, const char* key, const BodySpec& body, Draft& draft) {
  const bool no_size = bounding_box(body.shape, Vec<3>(0.0)).size() == Vec<3>(0.0);
  const bool is_static = body.kind == BodyKind::static_body;
  if (!is_static && !no_size) return;
  draft.problems.add(table.place(key), fmt::format("'{}' {}, it can have no {}", body.name,
                                                   is_static ? "is static" : "has no size", key));
}

Move read_move(const TableReader& table, Scope& scope) {
  Move move{0,
            table.point("to"),
            table.point("velocity"),
            table.number("turned"),
            table.number("spin"),
            table.truth("rebuild")};
  const auto found = read_present_body(table, "body", scope);
  if (!found) return move;
  move.body = *found;
  const BodySpec& body = scope.draft.scenario.bodies[*found];
  if (move.velocity.value_or(Vec<3>(0.0)) != Vec<3>(0.0))
    check_motion(table, "velocity", body, scope.draft);
  if (move.spin.value_or(0) != 0) check_motion(table, "spin", body, scope.draft);
  for (const char* key : {"turned", "spin"})
    if (table.has(key) && never_turns(body))
      scope.draft.problems.add(table.key_place(key), fmt::format("'{}' never turns", body.name),
                               "a box turns if it has oriented = true");
  if (move.turned) *move.turned *= kDegree;
  if (move.spin) *move.spin *= kDegree;
  return move;
}

// A dynamic body, for `force` and `impulse`.
std::size_t read_pushed(const TableReader& table, std::string_view verb, Scope& scope) {
  const auto body = read_present_body(table, "body", scope);
  if (!body) return 0;
  const BodySpec& spec = scope.draft.scenario.bodies[*body];
  if (spec.kind != BodyKind::dynamic_body)
    scope.draft.problems.add(
        table.place("body"),
        fmt::format("'{}' is {}: no {} moves it", spec.name,
                    spec.kind == BodyKind::static_body ? "static" : "kinematic", verb),
        "name a dynamic body");
  return *body;
}

std::vector<std::size_t> read_sleepers(const TableReader& table, std::string_view verb,
                                       Scope& scope) {
  const std::vector<Named> written = table.texts("bodies");
  for (const Named& named : written) {
    const NamedRange* range = scope.draft.bodies.find(named.name);
    if (range && scope.draft.scenario.bodies[range->first].kind != BodyKind::dynamic_body)
      scope.draft.problems.add(named.where,
                               fmt::format("'{}' is not dynamic: it cannot {}", named.name, verb),
                               "only dynamic bodies sleep and wake");
  }
  if (!scope.draft.scenario.world.may_sleep && scope.draft.dimension != 0)
    scope.draft.problems.add(table.place("do"), "in this world nothing sleeps",
                             "give [world] may_sleep = true");
  return scope.bodies.present(written);
}

Pack read_pack(const TableReader& table, Scope& scope) {
  Pack pack;
  pack.textures =
      scope.textures.take(table.texts("textures"), scope.state.packed, true, "is packed already");
  pack.each = table.truth("each");
  pack.free_name = table.text("free_name").value_or("");
  if (pack.each && !pack.textures.empty()) scope.frames = pack.textures.size();
  return pack;
}

}  // namespace

std::optional<Verb> read_body_verb(const TableReader& table, std::string_view verb, Scope& scope) {
  auto& in_world = scope.state.in_world;
  if (verb == "show") return Show{};
  if (verb == "insert")
    return Insert{
        scope.bodies.take(table.texts("bodies"), in_world, true, "is in the world already")};
  if (verb == "remove")
    return Remove{scope.bodies.take(table.texts("bodies"), in_world, false,
                                    "is not in the world at this step")};
  if (verb == "move") return read_move(table, scope);
  if (verb == "sleep") return Sleep{read_sleepers(table, verb, scope)};
  if (verb == "wake") return Wake{read_sleepers(table, verb, scope)};
  const auto point = [&](const char* key) { return table.point(key).value_or(Vec<3>(0.0)); };
  if (verb == "force")
    return ApplyForce{read_pushed(table, verb, scope), point("force"), point("at")};
  if (verb == "impulse")
    return ApplyImpulse{read_pushed(table, verb, scope), point("impulse"), point("at")};
  if (verb == "rebuild") {
    scope.state.structure = read_structure(table, scope.state.structure, scope.draft);
    return Rebuild{scope.state.structure};
  }
  return std::nullopt;
}

std::optional<Verb> read_atlas_verb(const TableReader& table, std::string_view verb, Scope& scope) {
  if (verb == "pack") return read_pack(table, scope);
  if (verb != "ask_room") return std::nullopt;
  const Vec<2> size = table.two("size").value_or(Vec<2>(1.0));
  scope.state.asked_for_room = true;
  return AskRoom{static_cast<int>(size.x), static_cast<int>(size.y)};
}

}  // namespace lantern
