// `ray`, `cull` and `query`: what the structure is asked.
#include <fmt/format.h>

#include "scenario/event_text.hpp"
#include "scenario/key.hpp"
#include "scenario/running_finding.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern::scenario {
namespace {

// A ray and a view need a direction.
void check_apart(const TableReader& table, const char* from, const char* to) {
  const auto a = table.get<Vec<3>>(from), b = table.get<Vec<3>>(to);
  if (a && b && *a == *b)
    table.bad_value(to, fmt::format("'{}' and '{}' are the same point", from, to),
                    "it goes nowhere");
}

void require_structure(const TableReader& table, std::string_view verb, ScriptReading& script) {
  if (script.state.structure.kind == StructureKind::none)
    table.bad_value("do", fmt::format("there is no structure at this step: nothing for '{}'", verb),
                    "kind = \"brute_force\" tests every body");
  script.state.queried = true;
}

KeyDoc walk_events() { return events_key({"visit", "skip", "hit", "miss"}); }

// One frame for each thing that the walk did, of which each knows what was found up to it.
void replay(const Finding& whole, ScriptRun& run) {
  using Kind = QueryEvent::Kind;
  FrameMaker& frames = run.frames;
  const std::vector<QueryEvent>& walk = whole.walk;
  RunningFinding running(whole);
  for (std::size_t i = 0; i < walk.size() && !frames.stopped(); ++i) {
    const QueryEvent& event = walk[i];
    const bool of_static = running.is_of_static();
    running.go_on();
    const bool hit = i + 1 < walk.size() && walk[i + 1].kind == Kind::hit;
    if (hit) running.go_on(), ++i;  // told with its test
    const bool is_test = event.kind == Kind::test;
    const std::string_view name =
        is_test ? (hit ? "hit" : "miss") : (event.kind == Kind::visit ? "visit" : "skip");
    if (!frames.wanted(name)) continue;
    frames.show_finding(running.so_far());
    Touched now = running.touched();
    if (event.kind != Kind::skip && !of_static) now.lit.insert(event.node);
    frames.emit(now, name,
                query_text(name, run.engine().label_of(event.node), run.name_of(event.body)),
                is_test ? std::optional(event.body) : std::nullopt);
  }
}

void answer(Finding finding, std::string_view verb, ScriptRun& run) {
  if (run.frames.by_event()) replay(finding, run);
  RunningFinding all(finding);
  for (std::size_t i = 0; i < finding.walk.size(); ++i) all.go_on();
  run.frames.touched = all.touched();
  run.frames.show_finding(std::move(finding));
  run.frames.settle(verb);
}

}  // namespace

TableDoc CastRay::table() {
  using namespace keys;
  return {.doc = "Which bodies does a ray hit? The structure leaves out what it cannot hit.",
          .keys = {key(&CastRay::from, "from", "Where it begins.", must(), range(-kFar, kFar)),
                   key(&CastRay::to, "to", "Where it ends, unless something stops it.", must(),
                       range(-kFar, kFar)),
                   key(KeyType::choice, "hits",
                       "It stops at the `nearest` body, or goes through `all`.",
                       one_of({"nearest", "all"}), by_default("\"nearest\"")),
                   pace_key(), walk_events()},
          .example = R"([[step]]
do = "ray"
from = [0, 6]
to = [16, 6]
caption = "{objects_tested:body/bodies} of {bodies} tested, {hits:hit}."
expect = { hits_are = ["red"] }
)"};
}

void CastRay::read(const TableReader& table, ScriptReading& script) {
  require_structure(table, "ray", script);
  check_apart(table, "from", "to");
  all = table.get<std::string>("hits") == "all";
}

void CastRay::act(ScriptRun& run) const { answer(run.engine().ask(*this), "ray", run); }

TableDoc Cull::table() {
  using namespace keys;
  return {.doc = "Which bodies can a camera see? Whole nodes outside its view are left out.",
          .keys = {key(&Cull::eye, "eye", "Where the camera is.", must(), range(-kFar, kFar)),
                   key(&Cull::target, "target", "Where it looks.", must(), range(-kFar, kFar)),
                   key(&Cull::angle, "angle",
                       "How wide its view opens; in a 3D world from bottom to top.", above(0, 170),
                       in("°")),
                   key(&Cull::near, "near", "It sees nothing nearer.", above(0, kFar)),
                   key(&Cull::far, "far", "It sees nothing farther.", above(0, kFar)), pace_key(),
                   walk_events()},
          .example = R"([[step]]
do = "cull"
eye = [0, 6]
target = [16, 6]
angle = 40
far = 8
expect = { hits_are = ["red"] }
)"};
}

void Cull::read(const TableReader& table, ScriptReading& script) {
  require_structure(table, "cull", script);
  check_apart(table, "eye", "target");
  const bool good =
      table.is_good("near") == table.has("near") && table.is_good("far") == table.has("far");
  if (good && far <= near)
    table.bad_value(table.has("far") ? "far" : "near",
                    fmt::format("it sees from {} to {}: that is nothing", near, far),
                    "'far' is greater than 'near'");
}

void Cull::act(ScriptRun& run) const { answer(run.engine().ask(*this), "cull", run); }

TableDoc Query::table() {
  using namespace keys;
  return {
      .doc = "Which bodies overlap a box, or a disc or ball?",
      .keys = {key(KeyType::point, "min", "Lowest corner of the box.", range(-kFar, kFar)),
               key(KeyType::point, "max", "Highest corner of the box.", range(-kFar, kFar)),
               key(KeyType::point, "center", "Of the disc or ball, instead.", range(-kFar, kFar)),
               key(KeyType::number, "radius", "Of the disc or ball.", above(0, kFar)), pace_key(),
               walk_events()},
      .groups = {{{"min", "max"}, {"center", "radius"}}},
      .example = R"([[step]]
do = "query"
min = [0, 4]
max = [8, 9]
expect = { hits_are = ["red"] }
)"};
}

void Query::read(const TableReader& table, ScriptReading& script) {
  require_structure(table, "query", script);
  if (const auto center = table.get<Vec<3>>("center")) {
    radius = table.get<double>("radius").value_or(1);
    Vec<3> half(radius);
    if (script.draft.dimension != 3) half.z = 0;
    box = Box<3>::around(*center, half);
  }
  const auto min = table.get<Vec<3>>("min"), max = table.get<Vec<3>>("max");
  if (!min || !max) return;
  box = {*min, *max};
  if (!is_valid(box))
    table.bad_value("max", "the box has no inside", "'max' lies to the upper right of 'min'");
}

void Query::act(ScriptRun& run) const { answer(run.engine().ask(*this), "query", run); }

}  // namespace lantern::scenario
