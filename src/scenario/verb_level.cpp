// `compile`, `locate`, `order` and `see`: a level's BSP, and who sees whom in it.
#include <fmt/format.h>

#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern::scenario {
namespace {

void require_compiled(const TableReader& table, std::string_view verb,
                      const ScriptReading& script) {
  if (!script.state.compiled)
    table.bad_value("do", fmt::format("'{}' needs the compiled level", verb),
                    "add a step with do = \"compile\" before");
}

template <class V>
KeyDoc point_key(Vec<2> V::*member, std::string_view name, std::string_view meaning) {
  using namespace keys;
  return key(member, name, meaning, range(-kFar, kFar), written("[x, y]"), must());
}

}  // namespace

TableDoc CompileLevel::table() {
  return {.doc =
              "The level's walls become a BSP, whose leaves are the sectors. Bodies of a scenario "
              "without a [structure] lie in it from then on, each in every sector that its box "
              "reaches.",
          .keys = {pace_key(), events_key({"consider", "choose", "cut", "sector"})},
          .example = R"([[step]]
do = "compile"
pace = "event"
events = ["choose", "cut"]
caption = "{walls} walls, {sectors} sectors, {cuts:wall} cut in two."
expect = { walls = 8 }
)"};
}

void CompileLevel::read(const TableReader&, ScriptReading& script) {
  script.state.compiled = true;
  script.state.located = script.state.sighted = script.state.eyed = false;
  StructureSpec& structure = script.state.structure;
  if (script.draft.bodies.empty() || structure.kind != StructureKind::none) return;
  structure.kind = StructureKind::bsp;
  structure.of_level = true;
}

void CompileLevel::act(ScriptRun& run) const {
  FrameMaker& frames = run.frames;
  run.stage.level->compile([&](const LevelMoment& moment) {
    if (!frames.stopped() && frames.by_event() && frames.wanted(moment.event))
      frames.emit({}, moment.event, moment.text);
  });
  if (run.stage.engine) {
    const StructureSpec& structure = run.engine().structure();
    if (structure.of_level || structure.kind == StructureKind::none)
      run.engine().rebuild_as(run.stage.level->structure());
  }
  frames.settle("compile");
}

TableDoc Locate::table() {
  return {.doc = "In which sector of the compiled level is a point?",
          .keys = {point_key(&Locate::point, "point", "The point asked for.")},
          .example = R"([[step]]
do = "locate"
point = [2, 2]
caption = "Sector {sector}, after {planes_tested:line}."
)"};
}

void Locate::read(const TableReader& table, ScriptReading& script) {
  require_compiled(table, "locate", script);
  script.state.located = true;
}

void Locate::act(ScriptRun& run) const {
  run.stage.level->locate(point);
  run.frames.settle("locate");
}

TableDoc OrderFrom::table() {
  return {.doc = "The sectors of the compiled level, front to back.",
          .keys = {point_key(&OrderFrom::eye, "eye", "Where they are seen from.")},
          .example = R"([[step]]
do = "order"
eye = [2, 2]
)"};
}

void OrderFrom::read(const TableReader& table, ScriptReading& script) {
  require_compiled(table, "order", script);
  script.state.located = true;
}

void OrderFrom::act(ScriptRun& run) const {
  run.stage.level->order_from(eye);
  run.frames.settle("order");
}

TableDoc See::table() {
  using namespace keys;
  return {.doc =
              "Which sectors of the compiled level see which through the openings between them: "
              "found once, and then only looked up.",
          .keys = {pace_key(), events_key({"portals", "row"}),
                   key(&See::eye, "eye", "Whose sector's view is shown.", range(-kFar, kFar),
                       written("[x, y]"), or_else("no sector's"))},
          .example = R"([[step]]
do = "see"
eye = [2, 2]
caption = "{sectors_seen:sector} of {sectors} may be seen from here."
)"};
}

void See::read(const TableReader& table, ScriptReading& script) {
  require_compiled(table, "see", script);
  script.state.sighted = true;
  if (!eye) return;
  script.state.located = script.state.eyed = true;
  if (const Box<2> world = flat(script.draft.scenario.world.bounds);
      script.draft.has_world && table.is_good("eye") && !contains(world, *eye))
    table.bad_value("eye", fmt::format("[{}, {}] lies outside of the world", eye->x, eye->y));
}

void See::act(ScriptRun& run) const {
  FrameMaker& frames = run.frames;
  run.stage.level->see(eye, [&](const LevelMoment& moment) {
    if (!frames.stopped() && frames.by_event() && frames.wanted(moment.event))
      frames.emit({}, moment.event, moment.text);
  });
  frames.settle("see");
}

}  // namespace lantern::scenario
