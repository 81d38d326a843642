// Verbs that let time pass, as they are read: `run`, `wait` and `phases`; and `solve_by`, which
// says how.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "language/keys/key.hpp"
#include "language/script/script_reading.hpp"

namespace lantern::language {

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

namespace {

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
  if (!table.is_good("event") || !table.has("bodies")) return;
  if (wait.event == Wait::Event::asleep) return script.require_sleep(table.place("event"));
  script.require_contacts(table.place("event"));
  if (written.empty() && wait.bodies.empty()) return;
  for (const Named& name : written)
    if (script.draft.bodies.find(name.name)) one_body(name, script.draft);
  // A range stands for several.
  const bool has_range = std::ranges::any_of(
      written, [&](const Named& name) { return name.name.find("..") != name.name.npos; });
  const std::size_t count = has_range ? wait.bodies.size() : written.size();
  if (count != 2)
    table.bad_value(
        "bodies",
        fmt::format("{} of them cannot {}: it takes two", count, *table.get<std::string>("event")),
        "as bodies = [\"ball\", \"wall\"]");
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

std::vector<VerbDoc> verbs_of_time() {
  using S = SolveBy;
  std::vector<std::string_view> methods = contact_method_names();
  std::erase(methods, to_string(ContactMethod::none));
  return {
      verb<Run>({.doc = "Time passes.",
                 .keys = {key(&Run::seconds, "seconds",
                              "A whole number of time steps; the frames of all steps are at most "
                              "100000, and the time steps 1000000.",
                              must(), above(0, kHundredYears), in("s")),
                          every_key<Run>()}},
                read_run),
      verb<Wait>({.doc = "Time passes until something happens. If it has not happened in time, the "
                         "scenario fails.",
                  .keys =
                      {
                          key(&Wait::event, "event",
                              "Two bodies `touch` or `part`; or one of the two is `crush`ed "
                              "between the other and a third; or all of some bodies are `asleep`.",
                              must()),
                          key(KeyType::texts, "bodies",
                              "Two names of bodies; of what falls asleep any number.", must()),
                          key(&Wait::at_most, "at_most", "A whole number of time steps.", must(),
                              above(0, kHundredYears), in("s")),
                          every_key<Wait>(),
                      }},
                 read_wait),
      verb<Phases>({.doc = "One world step, phase by phase.", .keys = {pace_key(), phase_events()}},
                   read_phases),
      verb<SolveBy>(
          {.doc = "From now on, contacts are solved another way; the world must have some.",
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
                       "Sweeps over the velocities in a world step, and as many over the "
                       "positions.",
                       range(1, 1000), or_else("as it was")),
               }},
          read_solve_by)};
}

}  // namespace lantern::language
