// `move`, `force`, `impulse`, `sleep`, `wake` and `solve_by`: one change, shown when it is done.
#include <fmt/format.h>

#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern::scenario {
namespace {

bool never_turns(const BodySpec& body) { return !turns<3>(body.shape); }

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
              pace_key(),
              events_key({"leave", "test", "miss", "split", "store", "rotate"}),
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
  run.focus(body);
  if (rebuild && run.frames.by_event())
    run.engine().follow([&](const Event& event) { run.witness(event); });
  else if (rebuild)
    run.engine().rebuild();
  run.frames.touched = {};
  run.frames.settle("move");
}

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

template <bool kAsleep>
TableDoc Rest<kAsleep>::table() {
  if constexpr (kAsleep)
    return {.doc = "Bodies fall asleep: nothing moves them until something wakes them.",
            .keys = {bodies_key()},
            .example = R"([[step]]
do = "sleep"
bodies = ["red"]
expect = { asleep = ["red"] }
)"};
  else
    return {.doc = "Bodies wake up.", .keys = {bodies_key()}, .example = R"([[step]]
do = "wake"
bodies = ["red"]
expect = { awake = ["red"] }
)"};
}

template <bool kAsleep>
void Rest<kAsleep>::read(const TableReader& table, ScriptReading& script) {
  const std::vector<Named> written = table.names("bodies");
  for (const Named& named : written) {
    const NamedRange* range = script.draft.bodies.find(named.name);
    if (range && script.draft.scenario.bodies[range->first].kind != BodyKind::dynamic_body)
      script.draft.problems.add(
          named.where, fmt::format("'{}' is not dynamic: it cannot {}", named.name, kTraits.name),
          "only dynamic bodies sleep and wake");
  }
  script.require_sleep(table.place("do"));
  bodies = script.bodies.present(written);
}

template <bool kAsleep>
void Rest<kAsleep>::change(Engine& engine) const {
  if constexpr (kAsleep)
    for (const std::size_t body : bodies) engine.sleep(body);
  else
    engine.wake(bodies);
}

template struct Rest<true>;
template struct Rest<false>;

TableDoc SolveBy::table() {
  using namespace keys;
  using S = SolveBy;
  std::vector<std::string_view> methods = contact_method_names();
  std::erase(methods, to_string(ContactMethod::none));
  return {.doc = "From now on, contacts are solved another way; the world must have some.",
          .keys =
              {
                  key(&S::contacts, "contacts", "As [world] has it, but `none`.", must(),
                      one_of(methods)),
                  key(&S::sub_steps, "sub_steps",
                      "How many parts soft contacts divide a world step into.", range(1, 64),
                      or_else("as it was")),
                  key(&S::wanted_error, "wanted_error",
                      "The error that is wanted of soft contacts, as [world] has it.", range(0, 1),
                      or_else("as it was")),
                  key(&S::iterations, "iterations",
                      "Sweeps over the velocities in a world step, and as many over the positions.",
                      range(1, 1000), or_else("as it was")),
              },
          .example = R"([[step]]
do = "solve_by"
contacts = "impulse"
iterations = 20
)"};
}

void SolveBy::read(const TableReader& table, ScriptReading& script) {
  script.require_contacts(table.place("do"));
}

void SolveBy::change(Engine& engine) const { engine.solve_by(*this); }

}  // namespace lantern::scenario
