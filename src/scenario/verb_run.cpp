// `run`, `wait` and `phases`: time passes.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenario/event_text.hpp"
#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern::scenario {

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

template <class V>
KeyDoc every_key() {
  using namespace keys;
  return key(&V::every, "every", "World steps from one frame to the next.", range(1, kMostEvery),
             in("steps"), or_else("the world's `frame_every`"));
}

}  // namespace

TableDoc Run::table() {
  using namespace keys;
  return {.doc = "Time passes.",
          .keys = {key(&Run::seconds, "seconds",
                       "A whole number of time steps; the frames of all steps are at most 100000, "
                       "and the time steps 1000000.",
                       must(), above(0, kHundredYears), in("s")),
                   every_key<Run>()},
          .example = R"([[step]]
do = "run"
seconds = 0.5
every = 6
caption = "{time} s: pink runs to the right, {pairs:pair} to test."
always = { bodies = 3 }
expect = { position = { pink = [4.5, 2] } }
)"};
}

void Run::read(const TableReader& table, ScriptReading& script) {
  const std::uint64_t before = script.state.ticks;
  count_time(table, "seconds", every, script);
  script.state.least_ticks += script.state.ticks - before;
}

void Run::act(ScriptRun& run) const {
  if (run.stage.engine) run.watch_movers();
  const std::uint32_t ticks = run.ticks_in(seconds);
  for (std::uint32_t tick = 1; tick <= ticks && !run.frames.stopped(); ++tick) {
    run.let_time_pass();
    if (tick % run.frame_every(every) == 0 || tick == ticks)
      run.frames.settle("run", tick == ticks);
  }
}

TableDoc Wait::table() {
  using namespace keys;
  return {.doc =
              "Time passes until something happens. If it has not happened in time, the scenario "
              "fails.",
          .keys =
              {
                  key(&Wait::event, "event",
                      "Two bodies `touch` or `part`; or one of the two is `crush`ed between the "
                      "other and "
                      "a third; or all of some bodies are `asleep`.",
                      must()),
                  key(KeyType::texts, "bodies",
                      "Two names of bodies; of what falls asleep any number.", must()),
                  key(&Wait::at_most, "at_most", "A whole number of time steps.", must(),
                      above(0, kHundredYears), in("s")),
                  every_key<Wait>(),
              },
          .example = R"([[step]]
do = "wait"
event = "touch"
bodies = ["pink", "player"]
at_most = 2
every = 6
caption = "After {time} s they touch: {contacts:contact}."
expect = { contacts_are = [["pink", "player"]] }
)"};
}

void Wait::read(const TableReader& table, ScriptReading& script) {
  count_time(table, "at_most", every, script);
  ++script.state.least_ticks;
  const std::vector<Named> written = table.names("bodies");
  bodies = script.bodies.present(written);
  if (!table.is_good("event") || !table.has("bodies")) return;
  if (event == Event::asleep) return script.require_sleep(table.place("event"));
  script.require_contacts(table.place("event"));
  if (written.empty() && bodies.empty()) return;
  for (const Named& name : written)
    if (script.draft.bodies.find(name.name)) one_body(name, script.draft);
  // A range stands for several.
  const bool has_range = std::ranges::any_of(
      written, [&](const Named& name) { return name.name.find("..") != name.name.npos; });
  const std::size_t count = has_range ? bodies.size() : written.size();
  if (count != 2)
    table.bad_value(
        "bodies",
        fmt::format("{} of them cannot {}: it takes two", count, *table.get<std::string>("event")),
        "as bodies = [\"ball\", \"wall\"]");
}

// Until the event, which must happen in time.
void Wait::act(ScriptRun& run) const {
  run.watch_movers();
  const std::uint32_t ticks = run.ticks_in(at_most);
  for (std::uint32_t tick = 1; tick <= ticks && !run.frames.stopped(); ++tick) {
    run.let_time_pass();
    if (run.engine().has_happened(event, bodies)) return run.frames.settle("wait");
    if (tick == ticks)
      run.frames.fail(
          fmt::format("what this step waits for has not happened within {} s", at_most));
    if (tick % run.frame_every(every) == 0 || tick == ticks)
      run.frames.settle("wait", tick == ticks);
  }
}

namespace {

bool is_look(std::string_view event) { return event == "approach" || event == "impact"; }

// Bodies as they were before the step, and the looks so far; nobody knows yet who will touch.
void show_looks(const std::vector<FrameLook>& looks, StepFindings found, Frame frame,
                ScriptRun& run) {
  frame.phase = StepPhase::narrow;
  found.contacts.clear();
  found.begins = found.ends = found.work.impacts_located = 0;
  found.time_of_impact = 1;
  for (const FrameLook& look : looks) {
    frame.add<FrameLooks>().looks.push_back(look);
    frame.event = look.meets ? "impact" : "approach";
    if (!run.frames.wanted(frame.event)) continue;
    found.work.impact_looks = static_cast<std::uint64_t>(look.number);
    if (look.meets) found.time_of_impact = look.time;
    found.put_on(frame);
    frame.caption = look_text(look);
    run.frames.give(frame);
  }
}

}  // namespace

TableDoc Phases::table() {
  KeyDoc events = events_key(
      {"broad_phase", "boxes", "narrow_phase", "approach", "impact", "solve", "integrate"});
  events.doc =
      "Only these give frames: those named, else all but `approach` and `impact`. An `approach` is "
      "a look at the two bodies of the step's first impact on the way to its moment.";
  events.otherwise = "all but two";
  return {.doc = "One world step, phase by phase.",
          .keys = {pace_key(), std::move(events)},
          .example = R"([[step]]
do = "phases"
pace = "event"
caption = "Of {pairs:candidate pair}, {contacts} in contact."
)"};
}

void Phases::read(const TableReader& table, ScriptReading& script) {
  constexpr std::uint64_t kMostPhases = 5;
  script.frames = kMostPhases;
  const std::vector<Named> events = table.names("events");
  const bool looks = std::ranges::any_of(events, [](const Named& n) { return is_look(n.name); });
  if (looks) script.require_contacts(table.place("events"));
  if (looks) script.frames += kMostLooks;
  ++script.state.ticks;
  ++script.state.least_ticks;
}

// The state before the step, with what each phase of it finds, then the state after it.
void Phases::act(ScriptRun& run) const {
  const Frame before = run.frames.picture(run.frames.touched, "broad_phase");
  const auto show = [&](std::string_view event, StepPhase phase, const StepFindings& found) {
    if (!run.frames.wanted(event)) return;
    Frame shown = before;
    found.put_on(shown);
    shown.event = event;
    shown.phase = phase;
    shown.caption = phase_text(event, shown);
    run.frames.show_phase(event, shown);
    run.frames.give(shown);
  };
  const StepFindings nothing;
  show("broad_phase", StepPhase::broad, nothing);
  if (before.count("overlaps") && before.count("contacts"))
    show("boxes", StepPhase::boxes, nothing);
  const std::vector<FrameLook> looks =
      run.let_time_pass(std::ranges::any_of(run.frames.step().events, is_look));
  const StepFindings found = run.stage.engine ? run.engine().findings() : nothing;
  StepFindings narrow = found;  // before any impulse
  for (FrameContact& contact : narrow.contacts)
    for (FrameContact::Point& point : contact.points) point.impulse = 0;
  show("narrow_phase", StepPhase::narrow, narrow);
  show_looks(looks, narrow, before, run);
  show("solve", StepPhase::resolve, found);
  run.frames.settle("integrate");
}

}  // namespace lantern::scenario
