// What the verbs of bodies do: `insert`, `emit`, `remove`, `move`, `sleep`, `wake`, `force`,
// `impulse`, and `solve_by`; and those with which time passes: `run`, `wait` and `phases`.
#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "run/event_text.hpp"
#include "run/script_run.hpp"
#include "run/waiting.hpp"

namespace lantern::run {

void carry_out(const Verb& any, Engine& engine, double time_step) {
  const auto carry = [&]<class V>(const V& verb) {
    if constexpr (V::kTraits.changes_bodies) engine.apply(verb);
    if constexpr (V::kTraits.passes_time)
      for (auto n = std::llround(verb.seconds_of(time_step) / time_step); n > 0; --n) engine.step();
  };
  std::visit(carry, any);
}

// Where somebody looks on, each enters the world when the one before it is stored.
void act(const Insert& insert, ScriptRun& run) {
  const EventWatch watch = run.watch_of_insertion();
  for (const std::size_t& body : insert.bodies) {
    if (run.frames.stopped()) return;
    run.engine().enter(body);
    run.focus(body);
    run.frames.touched = {};  // the way down is each body's own
    if (watch) run.engine().store(std::span(&body, 1), watch);
  }
  if (!watch) run.engine().store(insert.bodies, {});
  run.frames.touched = {};
  run.frames.settle("insert");
}

void act(const Emit& emit, ScriptRun& run) {
  run.engine().apply(emit);
  run.engine().rebuild();
  run.focus(emit.bodies.front());
  run.frames.settle("emit");
}

void act(const Remove& remove, ScriptRun& run) {
  run.engine().apply(remove);
  run.engine().rebuild();
  run.frames.settle("remove");
}

void act(const Move& move, ScriptRun& run) {
  run.engine().apply(move);
  run.focus(move.body);
  if (move.rebuild && run.frames.by_event())
    run.engine().follow([&](const Event& event) { run.witness(event); });
  else if (move.rebuild)
    run.engine().rebuild();
  run.frames.touched = {};
  run.frames.settle("move");
}

void act(const Run& verb, ScriptRun& run) {
  if (run.stage.engine) run.watch_movers();
  const std::uint32_t ticks = run.ticks_in(verb.seconds);
  for (std::uint32_t tick = 1; tick <= ticks && !run.frames.stopped(); ++tick) {
    run.let_time_pass();
    if (tick % run.frame_every(verb.every) == 0 || tick == ticks)
      run.frames.settle("run", tick == ticks);
  }
}

// Until the event, which must happen in time.
void act(const Wait& wait, ScriptRun& run) {
  run.watch_movers();
  Waiting waiting(wait, run.scenario, run.engine());
  const std::uint32_t ticks = run.ticks_in(wait.at_most);
  for (std::uint32_t tick = 1; tick <= ticks && !run.frames.stopped(); ++tick) {
    run.let_time_pass();
    if (waiting.is_over()) return run.frames.settle("wait");
    if (tick == ticks) run.frames.fail(waiting.in_vain());
    if (tick % run.frame_every(wait.every) == 0 || tick == ticks)
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

// The state before the step, with what each phase of it finds, then the state after it.
void act(const Phases&, ScriptRun& run) {
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

}  // namespace lantern::run
