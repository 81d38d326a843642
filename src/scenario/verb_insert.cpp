// `insert`, `emit`, `remove` and `rebuild`: bodies enter and leave the world and the structure.
#include <span>

#include "base/stop.hpp"
#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern::scenario {
TableDoc Insert::table() {
  return {.doc = "Bodies enter the world and the structure, one after another.",
          .keys = {bodies_key(), pace_key(),
                   events_key({"test", "miss", "make_child", "store", "split", "hand_down",
                               "depth_limit", "no_progress", "rotate"})},
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

// Where somebody looks on, each enters the world when the one before it is stored.
void Insert::act(ScriptRun& run) const {
  const EventWatch watch = run.watch_of_insertion();
  for (const std::size_t& body : bodies) {
    if (run.frames.stopped()) return;
    run.engine().enter(body);
    run.focus(body);
    run.frames.touched = {};  // the way down is each body's own
    if (watch) run.engine().store(std::span(&body, 1), watch);
  }
  if (!watch) run.engine().store(bodies, {});
  run.frames.touched = {};
  run.frames.settle("insert");
}

TableDoc Emit::table() {
  using namespace keys;
  return {.doc =
              "Bodies enter the world one after another while time passes: the first at once, the "
              "others when later steps let time pass.",
          .keys = {bodies_key(), key(KeyType::number, "every",
                                     "From one to the next, a whole number of time steps.", must(),
                                     above(0, kHundredYears), in("s"))},
          .example = R"([[pattern]]
name = "drop"
count = 3
radius = 0.4
min = [2, 2]
max = [2, 2]
velocity = [24, 0]

[[step]]
do = "emit"
bodies = ["drop1..drop3"]
every = 0.1
expect = { bodies = 5 }

[[step]]
do = "run"
seconds = 0.2
every = 12
expect = { bodies = 7 }
)"};
}

void Emit::read(const TableReader& table, ScriptReading& script) {
  bodies = script.bodies.take(table.names("bodies"), script.state.in_world, true,
                              "is in the world already");
  every = script.read_ticks(table, "every");
  for (std::size_t i = 0; i < bodies.size(); ++i)
    script.state.due[bodies[i]] = script.state.least_ticks + i * every;
}

void Emit::change(Engine& engine) const { engine.emit(bodies, every); }

void Emit::act(ScriptRun& run) const {
  change(run.engine());
  run.engine().rebuild();
  run.focus(bodies.front());
  run.frames.settle("emit");
}

TableDoc Remove::table() {
  return {.doc = "Bodies leave the world and the structure.",
          .keys = {bodies_key()},
          .example = R"([[step]]
do = "remove"
bodies = ["blue", "drop"]
expect = { bodies = 3 }
)"};
}

void Remove::read(const TableReader& table, ScriptReading& script) {
  bodies = script.bodies.take(table.names("bodies"), script.state.in_world, false,
                              "is not in the world at this step");
}

void Remove::change(Engine& engine) const {
  stop_if_asked();
  engine.leave(bodies);
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
  StructureSpec& now = script.state.structure;
  if (now.of_level && !table.has("kind"))
    return table.bad_value("do", "the compiled level holds the bodies, and takes no other settings",
                           "add the kind of another structure, as kind = \"quadtree\"");
  now.of_level = false;
  structure = now = read_structure(table, now, script.draft);
}

void Rebuild::act(ScriptRun& run) const {
  run.engine().rebuild_as(structure);
  run.frames.settle("rebuild");
}

}  // namespace lantern::scenario
