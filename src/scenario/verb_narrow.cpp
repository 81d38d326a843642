// `test_shapes`, `separate` and `gjk`: what the narrow phase does with bodies.
#include <tuple>

#include <fmt/format.h>

#include "scenario/event_text.hpp"
#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern::scenario {
namespace {

KeyDoc pair_key() {
  using namespace keys;
  return key(KeyType::texts, "pair", "Two bodies that are there; no half-spaces.", must());
}

// Two of a flat world. The first two bodies, and problems, if they are not.
std::pair<std::size_t, std::size_t> read_pair(const TableReader& table, ScriptReading& script) {
  constexpr std::pair<std::size_t, std::size_t> kNone = {0, 0};
  Draft& draft = script.draft;
  if (draft.dimension == 3)
    table.bad_value("do", "this is drawn of flat worlds only",
                    "give the world a size of two numbers");
  const std::vector<Named> written =
      without_ranges(table.names("pair"), draft.bodies, "body", draft.problems);
  if (!table.has("pair")) return kNone;
  script.bodies.present(written);
  std::vector<std::size_t> found;
  for (const Named& name : written) {
    if (!draft.bodies.find(name.name)) return kNone;  // which is told already
    const auto body = one_body(name, draft);
    if (!body) return kNone;
    if (std::holds_alternative<HalfSpace<3>>(draft.scenario.bodies[*body].shape))
      draft.problems.add(name.where,
                         fmt::format("'{}' is a half-space: it has no end to measure", name.name));
    found.push_back(*body);
  }
  if (found.size() != 2) {
    table.bad_value("pair", "a pair is two bodies", "as pair = [\"red\", \"pink\"]");
    return kNone;
  }
  return {found[0], found[1]};
}

std::string own_name(const ScriptRun& run, std::size_t body) {
  return run.scenario.bodies[body].name;
}

}  // namespace

TableDoc TestShapes::table() {
  return {.doc =
              "The shapes of all candidate pairs are tested, without comparing boxes first, as "
              "the lecture's narrow phase does. Nothing moves.",
          .keys = {},
          .example = R"([[step]]
do = "test_shapes"
caption = "{shapes_tested:pair} tested, {touching} in contact."
expect = { touching = 1 }
)"};
}

void TestShapes::read(const TableReader& table, ScriptReading& script) {
  if (script.state.structure.kind == StructureKind::none)
    table.bad_value("do", "there is no structure at this step: no pairs to test",
                    "kind = \"brute_force\" has all of them");
  script.state.shapes_tested = true;
}

void TestShapes::act(ScriptRun& run) const {
  run.frames.narrow.show(run.engine().test_shapes());
  run.frames.settle("test_shapes");
}

TableDoc Separate::table() {
  return {.doc =
              "Which axis parts two bodies? The narrow phase's own test, axis by axis, until "
              "there is a gap; in a flat world.",
          .keys = {pair_key(), pace_key(), events_key({"axis"})},
          .example = R"([[step]]
do = "separate"
pair = ["red", "pink"]
caption = "{axes_tested:axis/axes} tested: a gap of {gap}."
expect = { axes_tested = 1 }
)"};
}

void Separate::read(const TableReader& table, ScriptReading& script) {
  std::tie(a, b) = read_pair(table, script);
  script.state.separated = true;
}

void Separate::act(ScriptRun& run) const {
  const FrameSeparation whole = run.engine().separate(a, b);
  if (run.frames.by_event() && run.frames.wanted("axis"))
    for (std::size_t n = 1; n <= whole.axes.size() && !run.frames.stopped(); ++n) {
      FrameSeparation so_far = whole;
      so_far.axes.resize(n);
      so_far.answer.reset();
      const std::string text = axis_text(so_far, own_name(run, a), own_name(run, b));
      run.frames.narrow.show(std::move(so_far));
      run.frames.emit({}, "axis", text);
    }
  run.frames.narrow.show(whole);
  run.frames.settle("separate");
}

TableDoc SearchDistance::table() {
  return {.doc =
              "How far are two bodies apart? GJK finds it by asking for points of their Minkowski "
              "difference, each farther towards the origin; in a flat world.",
          .keys = {pair_key(), pace_key(), events_key({"support", "simplex"})},
          .example = R"([[step]]
do = "gjk"
pair = ["red", "pink"]
caption = "{gjk_steps:search/searches}: a distance of {distance}."
expect = { distance = 4.724, tolerance = 0.001 }
)"};
}

void SearchDistance::read(const TableReader& table, ScriptReading& script) {
  std::tie(a, b) = read_pair(table, script);
  script.state.searched = true;
}

void SearchDistance::act(ScriptRun& run) const {
  const FrameSearch whole = run.engine().search(a, b);
  const auto show = [&](std::size_t steps, bool taken) {
    const std::string_view event = taken ? "simplex" : "support";
    if (!run.frames.wanted(event) || run.frames.stopped()) return;
    FrameSearch so_far = whole;
    so_far.steps.resize(steps);
    so_far.taken = taken;
    so_far.answer.reset();
    const std::string text = search_text(so_far, own_name(run, a), own_name(run, b));
    run.frames.narrow.show(std::move(so_far));
    run.frames.emit({}, event, text);
  };
  for (std::size_t n = 1; run.frames.by_event() && n <= whole.steps.size(); ++n) {
    show(n, false);
    if (!whole.steps[n - 1].ends) show(n, true);
  }
  run.frames.narrow.show(whole);
  run.frames.settle("gjk");
}

}  // namespace lantern::scenario
