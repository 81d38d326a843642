// `phases`: one world step, phase by phase.
#include <algorithm>

#include "scenario/event_text.hpp"
#include "scenario/language_parts.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern {
namespace {

// Bodies and structure as they were before the step, contacts as it found them.
Frame met(const Frame& before, const Frame& after) {
  static constexpr std::string_view kOfTheStep[] = {
      "contacts",      "contact_points",    "impulses",     "begins",
      "ends",          "pairs_tested",      "narrow_tests", "constraint_rows",
      "friction_rows", "force_evaluations", "rotations"};
  Frame frame = before;
  frame.contacts = after.contacts;
  for (auto& [name, number] : frame.counts)
    if (std::ranges::find(kOfTheStep, name) != std::end(kOfTheStep))
      number = after.count(name).value_or(number);
  for (auto& [name, number] : frame.measures)
    if (name == "penetration") number = after.measure(name).value_or(number);
  return frame;
}

}  // namespace

TableDoc Phases::table() {
  return {.doc = "One world step, phase by phase.",
          .keys = {pace_key(), events_key({"broad_phase", "narrow_phase", "solve", "integrate"})},
          .example = R"([[step]]
do = "phases"
pace = "event"
caption = "Of {pairs:candidate pair}, {contacts} in contact."
)"};
}

void Phases::read(const TableReader&, ScriptReading& script) { ++script.state.ticks; }

// The state before the step, with what each phase of it finds, then the state after it.
void Phases::act(ScriptRun& run) const {
  const Frame before = run.frames.picture(run.frames.touched, "broad_phase");
  const auto show = [&](std::string_view event, const Frame& frame) {
    if (!run.frames.wanted(event)) return;
    Frame shown = frame;
    shown.event = event;
    shown.caption = phase_text(event, shown);
    run.frames.give(shown);
  };
  show("broad_phase", before);
  run.let_time_pass();
  const Frame after = run.frames.picture(run.frames.touched, "integrate");
  const Frame meeting = met(before, after);
  Frame narrow = meeting;
  for (FrameContact& contact : narrow.contacts)
    for (FrameContact::Point& point : contact.points) point.impulse = 0;
  for (auto& [name, number] : narrow.counts)
    if (name == "impulses") number = 0;
  show("narrow_phase", narrow);
  show("solve", meeting);
  run.frames.settle("integrate");
}

}  // namespace lantern
