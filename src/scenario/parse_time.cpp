// Verbs that let time pass.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenario/script.hpp"

namespace lantern {
namespace {

// World steps in the seconds that `key` gives; 1 and a problem if they are not a whole number, or
// too many.
std::uint64_t read_ticks(const TableReader& table, const char* key, Scope& scope) {
  const auto seconds = table.number(key);
  if (!seconds) return 1;
  const double h = scope.draft.scenario.world.time_step;
  const double ticks = *seconds / h;
  const double whole = std::max(1.0, std::round(ticks));
  // A file's decimals are rounded: a millionth of the time is no mistake.
  constexpr double kRounding = 1e-6;
  const Place where = table.place(key);
  Problems& problems = scope.draft.problems;
  if (whole > static_cast<double>(kMostWorldSteps)) {
    problems.add(where,
                 fmt::format("{} s are {} time steps, the limit is {} in all", *seconds, whole,
                             kMostWorldSteps),
                 "run for a shorter time, or take a larger time_step");
  } else if (std::abs(ticks - whole) > kRounding * whole) {
    const double less = std::max(1.0, std::floor(ticks));
    problems.add(where,
                 fmt::format("{} s are {:.6g} time steps of {:.6g} s, not a whole number", *seconds,
                             ticks, h),
                 fmt::format("{:.10g} s or {:.10g} s would be {} or {}", h * less, h * (less + 1),
                             less, less + 1));
  } else {
    return static_cast<std::uint64_t>(whole);
  }
  return 1;
}

// The seconds that `key` gives, their world steps and frames counted. `every` is the step's own.
double read_time(const TableReader& table, const char* key, int every, Scope& scope) {
  const std::uint64_t ticks = read_ticks(table, key, scope);
  const auto stride =
      static_cast<std::uint64_t>(every > 0 ? every : scope.draft.scenario.world.frame_every);
  scope.frames = (ticks + stride - 1) / stride;
  const bool had_room = scope.state.ticks <= kMostWorldSteps;
  scope.state.ticks += ticks;
  if (scope.state.ticks > kMostWorldSteps && had_room)
    scope.draft.problems.add(
        table.place(key),
        fmt::format("the steps up to here have {} time steps in all, the limit is {}",
                    scope.state.ticks, kMostWorldSteps));
  return table.number(key).value_or(0);
}

int read_every(const TableReader& table) {
  return static_cast<int>(table.whole("every").value_or(0));
}

// Can it happen at all in this world?
void check_event(const TableReader& table, Wait::Event event, Draft& draft) {
  const WorldSpec& world = draft.scenario.world;
  if (draft.dimension == 0) return;
  if (event == Wait::Event::asleep && !world.may_sleep)
    draft.problems.add(table.place("event"), "in this world nothing falls asleep",
                       "give [world] may_sleep = true");
  else if (event != Wait::Event::asleep && world.contacts == ContactMethod::none)
    draft.problems.add(table.place("event"), "in this world nothing touches",
                       "give [world] contacts = \"impulse\" or \"soft\"");
}

Wait read_wait(const TableReader& table, Scope& scope) {
  Wait wait;
  wait.every = read_every(table);
  wait.at_most = read_time(table, "at_most", wait.every, scope);
  const std::vector<Named> written = table.texts("bodies");
  wait.bodies = scope.bodies.present(written);
  const auto event = table.choice("event");
  if (!event || !table.has("bodies")) return wait;
  wait.event = static_cast<Wait::Event>(*event);
  check_event(table, wait.event, scope.draft);
  if (wait.event == Wait::Event::asleep || (written.empty() && wait.bodies.empty())) return wait;
  for (const Named& name : written)
    if (scope.draft.bodies.find(name.name)) one_body(name, scope.draft);
  if (written.size() != 2)
    scope.draft.problems.add(
        table.place("bodies"),
        fmt::format("{} of them cannot {}: it takes two", written.size(), *table.text("event")),
        "as bodies = [\"ball\", \"wall\"]");
  return wait;
}

SolveBy read_solve_by(const TableReader& table, Scope& scope) {
  SolveBy method;
  if (const auto name = table.text("contacts"))
    method.contacts = contact_method_named(*name).value_or(method.contacts);
  method.sub_steps = static_cast<int>(table.whole("sub_steps").value_or(0));
  method.iterations = static_cast<int>(table.whole("iterations").value_or(0));
  if (scope.draft.dimension != 0 && scope.draft.scenario.world.contacts == ContactMethod::none)
    scope.draft.problems.add(table.place("do"), "in this world nothing touches",
                             "give [world] contacts = \"impulse\" or \"soft\"");
  return method;
}

}  // namespace

std::optional<Verb> read_time_verb(const TableReader& table, std::string_view verb, Scope& scope) {
  if (verb == "run") {
    lantern::Run run;
    run.every = read_every(table);
    run.seconds = read_time(table, "seconds", run.every, scope);
    return run;
  }
  if (verb == "wait") return read_wait(table, scope);
  if (verb == "solve_by") return read_solve_by(table, scope);
  if (verb != "phases") return std::nullopt;
  ++scope.state.ticks;
  return Phases{};
}

}  // namespace lantern
