// `force` and `impulse`.
#include <fmt/format.h>

#include "scenario/key.hpp"
#include "scenario/language_parts.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern {
namespace {

template <class V>
KeyDoc at_key() {
  using namespace keys;
  return key(&V::at, "at", "Where, from the body's centre, in the world's axes.",
             range(-kFar, kFar), or_else("the centre"));
}

// A dynamic body.
std::size_t read_pushed(const TableReader& table, std::string_view verb, ScriptReading& script) {
  const auto body = script.present_body(table, "body");
  if (!body) return 0;
  const BodySpec& spec = script.draft.scenario.bodies[*body];
  if (spec.kind != BodyKind::dynamic_body)
    table.bad_value("body",
                    fmt::format("'{}' is {}: no {} moves it", spec.name,
                                names(spec.kind)[static_cast<std::size_t>(spec.kind)], verb),
                    "name a dynamic body");
  return *body;
}

}  // namespace

TableDoc ApplyForce::table() {
  using namespace keys;
  return {.doc =
              "A force acts on a body from now on, until another takes its place; one of zero "
              "ends it.",
          .keys = {body_key(),
                   key(&ApplyForce::force, "force", "In the world's axes.", must(),
                       range(-kFar, kFar), in("N")),
                   at_key<ApplyForce>()},
          .example = R"([[step]]
do = "force"
body = "player"
force = [-4, 0]
)"};
}

void ApplyForce::read(const TableReader& table, ScriptReading& script) {
  body = read_pushed(table, "force", script);
}

void ApplyForce::change(Engine& engine) const { engine.apply(*this); }

TableDoc ApplyImpulse::table() {
  using namespace keys;
  return {.doc = "A body is struck once.",
          .keys = {body_key(),
                   key(&ApplyImpulse::impulse, "impulse", "In the world's axes.", must(),
                       range(-kFar, kFar), in("N s")),
                   at_key<ApplyImpulse>()},
          .example = R"([[step]]
do = "impulse"
body = "pink"
impulse = [2.56, 0]
)"};
}

void ApplyImpulse::read(const TableReader& table, ScriptReading& script) {
  body = read_pushed(table, "impulse", script);
}

void ApplyImpulse::change(Engine& engine) const { engine.apply(*this); }

}  // namespace lantern
