// `rebuild`: the structure anew, with other settings.
#include "scenario/language_parts.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern {

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

}  // namespace lantern
