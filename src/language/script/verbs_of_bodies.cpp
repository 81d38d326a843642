// Verbs of bodies, as they are read: `insert`, `emit`, `remove`, `move`, `sleep`, `wake`, `force`
// and `impulse`.
#include <algorithm>
#include <cmath>

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

// Counts the world steps and frames of the seconds that `key` gives. `every` is the step's own.
void count_time(const TableReader& table, const char* key, int every, ScriptReading& script) {
  const std::uint64_t ticks = script.read_ticks(table, key);
  const auto stride =
      static_cast<std::uint64_t>(every > 0 ? every : script.draft.scenario.world.frame_every);
  script.frames = (ticks + stride - 1) / stride;
  const bool had_room = script.state.ticks <= kMostWorldSteps;
  script.state.ticks += ticks;
  if (script.state.ticks > kMostWorldSteps && had_room)
    table.bad_value(key,
                    fmt::format("the steps up to here have {} time steps in all, the limit is {}",
                                script.state.ticks, kMostWorldSteps));
}

void read_run(Run& run, const TableReader& table, ScriptReading& script) {
  const std::uint64_t before = script.state.ticks;
  count_time(table, "seconds", run.every, script);
  script.state.least_ticks += script.state.ticks - before;
}

void read_wait(Wait& wait, const TableReader& table, ScriptReading& script) {
  count_time(table, "at_most", wait.every, script);
  ++script.state.least_ticks;
  const std::vector<Named> written = table.names("bodies");
  wait.bodies = script.bodies.present(written);
  wait.named = mapped(written, &Named::name);
  if (!table.is_good("event") || !table.has("bodies")) return;
  const std::string event = *table.get<std::string>("event");
  if (table.has("node") ? !wait.for_node() && table.is_good("node") : wait.for_node())
    return wait.for_node() ? table.bad_value("event", fmt::format("'{}' needs a node", event),
                                             "name it by its label, as node = \"1.3\"")
                           : table.bad_key("node", fmt::format("'{}' is of no node", event),
                                           "bodies `enter` and `leave` a node");
  if (wait.event == Wait::Event::asleep) return script.require_sleep(table.place("event"));
  if (wait.for_node()) return void(has_nodes(table, "node", script.state.past));
  script.require_contacts(table.place("event"));
  if (wait.bodies.empty()) return;
  if (written.size() > 2 || (written.size() == 1 && wait.bodies.size() == 1))
    return table.bad_value("bodies",
                           fmt::format("{} of them cannot {}: it takes two", written.size(), event),
                           "as bodies = [\"ball\", \"wall\"], or [\"ball\", \"wall1..wall4\"]");
  // Of one name any two; else one of the first and one of the second.
  wait.others = wait.bodies;
  if (written.size() == 1) return;
  Problems told;  // already
  std::size_t first = 0;
  for (const Named& name : without_ranges({written[0]}, script.draft.bodies, "body", told))
    if (const NamedRange* range = script.draft.bodies.find(name.name)) first += range->count;
  wait.others.erase(wait.others.begin(), wait.others.begin() + std::ptrdiff_t(first));
  wait.bodies.resize(first);
}

void read_phases(Phases&, const TableReader& table, ScriptReading& script) {
  constexpr std::uint64_t kMostPhases = 5;
  script.frames = kMostPhases;
  const bool looks = std::ranges::any_of(table.names("events"), [](const Named& event) {
    return event.name == "approach" || event.name == "impact";
  });
  if (looks) script.require_contacts(table.place("events"));
  if (looks) script.frames += kMostLooks;
  ++script.state.ticks;
  ++script.state.least_ticks;
}

void read_solve_by(SolveBy&, const TableReader& table, ScriptReading& script) {
  script.require_contacts(table.place("do"));
}

template <class V>
KeyDoc every_key() {
  return key(&V::every, "every", "World steps from one frame to the next.", range(1, kMostEvery),
             in("steps"), or_else("the world's `frame_every`"));
}

KeyDoc phase_events() {
  KeyDoc events = events_key(
      {"broad_phase", "boxes", "narrow_phase", "approach", "impact", "solve", "integrate"});
  events.doc =
      "Only these give frames: those named, else all but `approach` and `impact`. An `approach` is "
      "a look at the two bodies of the step's first impact on the way to its moment.";
  events.otherwise = "all but two";
  return events;
}

}  // namespace

std::vector<VerbDoc> verbs_of_bodies() {
  return {
      verb<Insert>("Bodies enter the world and the structure, one after another.",
                   {bodies_key(), pace_key(),
                    events_key({"test", "miss", "make_child", "store", "split", "hand_down",
                                "depth_limit", "no_progress", "rotate"})},
                   read_insert),
      verb<Emit>("Bodies enter the world one after another while time passes: the first at "
                 "once, the others when later steps let time pass.",
                 {bodies_key(), key(KeyType::number, "every",
                                    "From one to the next, a whole number of time steps.", must(),
                                    above(0, kHundredYears), in("s"))},
                 read_emit),
      verb<Remove>("Bodies leave the world and the structure.", {bodies_key()}, read_remove),
      verb<Move>(
          "A body is put elsewhere, turned, or goes another way from now on.",
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
          read_move, {{{"to"}, {"velocity"}, {"turned"}, {"spin"}}, false}),
      verb<Sleep>("Bodies fall asleep: nothing moves them until something wakes them.",
                  {bodies_key()}, read_rest<true>),
      verb<Wake>("Bodies wake up.", {bodies_key()}, read_rest<false>),
      verb<ApplyForce>("A force acts on a body from now on, until another takes its place; "
                       "one of zero ends it.",
                       {body_key(),
                        key(&ApplyForce::force, "force", "In the world's axes.", must(),
                            range(-kFar, kFar), in("N")),
                        at_key<ApplyForce>()},
                       read_push<ApplyForce>),
      verb<ApplyImpulse>("A body is struck once.",
                         {body_key(),
                          key(&ApplyImpulse::impulse, "impulse", "In the world's axes.", must(),
                              range(-kFar, kFar), in("N s")),
                          at_key<ApplyImpulse>()},
                         read_push<ApplyImpulse>)};
}

// Verbs that let time pass, as they are read: `run`, `wait` and `phases`; and `solve_by`, which
// says how.

std::uint64_t ScriptReading::read_ticks(const TableReader& table, const char* key) {
  const auto seconds = table.get<double>(key);
  if (!seconds) return 1;
  const double h = draft.scenario.world.time_step;
  const double ticks = *seconds / h;
  const double whole = std::max(1.0, std::round(ticks));
  // A file's decimals are rounded: a millionth of the time is no mistake.
  constexpr double kRounding = 1e-6;
  if (whole > static_cast<double>(kMostWorldSteps)) {
    table.bad_value(key,
                    fmt::format("{} s are {} time steps, the limit is {} in all", *seconds, whole,
                                kMostWorldSteps),
                    "run for a shorter time, or take a larger time_step");
  } else if (std::abs(ticks - whole) > kRounding * whole) {
    const double less = std::max(1.0, std::floor(ticks));
    table.bad_value(key,
                    fmt::format("{} s are {:.6g} time steps of {:.6g} s, not a whole number",
                                *seconds, ticks, h),
                    fmt::format("{:.10g} s or {:.10g} s would be {} or {}", h * less,
                                h * (less + 1), less, less + 1));
  } else {
    return static_cast<std::uint64_t>(whole);
  }
  return 1;
}

std::vector<VerbDoc> verbs_of_time() {
  using S = SolveBy;
  std::vector<std::string_view> methods = contact_method_names();
  std::erase(methods, to_string(ContactMethod::none));
  return {
      verb<Run>("Time passes.",
                {key(&Run::seconds, "seconds",
                     "A whole number of time steps; the frames of all steps are at most "
                     "100000, and the time steps 1000000.",
                     must(), above(0, kHundredYears), in("s")),
                 every_key<Run>()},
                read_run),
      verb<Wait>("Time passes until something happens. If it has not happened in time, the "
                 "scenario fails.",
                 {
                     key(&Wait::event, "event",
                         "Two bodies `touch` or `part`; or one of the two is `crush`ed "
                         "between the other and a third; or all of some bodies are `asleep`; or "
                         "one of some bodies `enter`s or `leave`s a `node`, as the structure "
                         "begins or ceases to store it there or below.",
                         must()),
                     key(KeyType::texts, "bodies",
                         "Two names, of what falls asleep or goes through a node any number. That "
                         "of a pattern stands for whichever of its bodies is first, and alone for "
                         "any two of them.",
                         must()),
                     key(&Wait::node, "node",
                         "Of `enter` and `leave`: a node by its label, as \"1.3\"; of a BSP the "
                         "sides of its lines, as \"front.back\".",
                         range(1, 64), or_else("none")),
                     key(&Wait::at_most, "at_most", "A whole number of time steps.", must(),
                         above(0, kHundredYears), in("s")),
                     every_key<Wait>(),
                 },
                 read_wait),
      verb<Phases>("One world step, phase by phase.", {pace_key(), phase_events()}, read_phases),
      verb<SolveBy>("From now on, contacts are solved another way; the world must have some.",
                    {
                        key(&S::contacts, "contacts", "As [world] has it, but `none`.", must(),
                            one_of(methods)),
                        key(&S::sub_steps, "sub_steps",
                            "How many parts soft contacts divide a world step into.", range(1, 64),
                            or_else("as it was")),
                        key(&S::wanted_error, "wanted_error",
                            "How deep two bodies may lie in each other, as [world] has it.",
                            range(0, 1), or_else("as it was")),
                        key(&S::iterations, "iterations",
                            "Sweeps over the velocities in a world step, and as many over the "
                            "positions.",
                            range(1, 1000), or_else("as it was")),
                    },
                    read_solve_by)};
}

}  // namespace lantern::language
