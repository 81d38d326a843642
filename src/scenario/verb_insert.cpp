// `insert`, `remove` and `rebuild`: bodies enter and leave the world and the structure.
#include "base/stop.hpp"
#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern::scenario {
TableDoc Insert::table() {
  return {.doc = "Bodies enter the world and the structure, one after another.",
          .keys = {bodies_key(), pace_key(),
                   events_key({"test", "miss", "make_child", "store", "split", "hand_down",
                               "depth_limit", "no_progress"})},
          .example = R"([[step]]
do = "insert"
bodies = ["blue"]
pace = "event"
events = ["split", "store"]
caption = "Blue is the fourth."
expect = { bodies = 4 }
)"};
}

void Insert::read(const TableReader& table, ScriptReading& script) {
  bodies = script.bodies.take(table.names("bodies"), script.state.in_world, true,
                              "is in the world already");
}

void Insert::change(Engine& engine) const {
  for (const std::size_t body : bodies) engine.enter(body);
}

void Insert::act(ScriptRun& run) const {
  for (const std::size_t body : bodies) {
    if (run.frames.stopped()) return;
    run.engine().enter(body);
    run.focus(body);
    run.frames.touched = {};  // the way down is each body's own
    run.engine().store(body, [&](const Event& event) { run.witness(event); });
  }
  run.frames.touched = {};
  run.frames.settle("insert");
}

TableDoc Remove::table() {
  return {.doc = "Bodies leave the world and the structure.",
          .keys = {bodies_key()},
          .example = R"([[step]]
do = "remove"
bodies = ["blue"]
expect = { bodies = 3 }
)"};
}

void Remove::read(const TableReader& table, ScriptReading& script) {
  bodies = script.bodies.take(table.names("bodies"), script.state.in_world, false,
                              "is not in the world at this step");
}

void Remove::change(Engine& engine) const {
  for (const std::size_t body : bodies) {
    stop_if_asked();
    engine.leave(body);
  }
}

void Remove::act(ScriptRun& run) const {
  change(run.engine());
  run.engine().rebuild();
  run.frames.settle("remove");
}

TableDoc Rebuild::table() {
  TableDoc verb = {.doc = "The structure is made anew with the settings given; the others stay.",
                   .keys = language_table("structure").keys,
                   .example = R"([[step]]
do = "rebuild"
kind = "bsp"
planes = [{ name = "middle", point = [8, 0], normal = [1, 0] }]
expect = { nodes = 3 }

[[step]]
do = "rebuild"
kind = "quadtree"
children = "eager"
expect = { nodes = 5 }
)"};
  for (KeyDoc& key : verb.keys) {
    key.required = false;
    key.fallback = {};
    key.otherwise = "as it was";
  }
  return verb;
}

void Rebuild::read(const TableReader& table, ScriptReading& script) {
  structure = script.state.structure = read_structure(table, script.state.structure, script.draft);
}

void Rebuild::act(ScriptRun& run) const {
  run.engine().rebuild_as(structure);
  run.frames.settle("rebuild");
}

}  // namespace lantern::scenario
