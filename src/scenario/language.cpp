#include "scenario/language.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "scenario/language_key.hpp"
#include "scenario/language_parts.hpp"

namespace lantern {
namespace {

using enum KeyType;

TableDoc file_table() {
  return {
      "",
      "The file's own keys",
      "A scenario of Lantern. These keys stand at the top, before the first [table].",
      {
          Key(text, "title", "The thin line above every frame.").must().range(1, 80),
          Key(text, "source", "The section of the lecture that the scenario shows.")
              .range(0, 80)
              .by_default("\"\""),
          Key(text, "name", "Names the output folder and its files.")
              .like(kFilePattern)
              .or_else("the file's name"),
          Key(whole, "seed",
              "Where random patterns begin; the same seed gives the same frames everywhere.")
              .range(0, kMostWhole)
              .by_default("1"),
          Key(choice, "pace", "One frame a step, or one for each thing that the algorithm does.")
              .one_of({"step", "event"})
              .by_default("\"step\""),
          Key(choices_list, "panels", "What is drawn, from left to right.")
              .one_of({"world", "tree", "atlas", "chart", "memory"})
              .or_else("what the scenario uses"),
          Key(table, "world", "Where bodies are.").holds("world"),
          Key(table, "structure", "How the world is partitioned.").holds("structure"),
          Key(tables, "body", "One body each.").at_most(kMostBodies).holds("body"),
          Key(tables, "pattern", "Many bodies each.").at_most(kMostBodies).holds("pattern"),
          Key(tables, "spring", "One spring each.").at_most(kMostLinks).holds("spring"),
          Key(tables, "joint", "One joint each.").at_most(kMostLinks).holds("joint"),
          Key(table, "level", "Walls, to be made a BSP of.").holds("level"),
          Key(table, "chart", "Counts of steps as lines or bars.").holds("chart"),
          Key(table, "problem", "The known answer that it is measured against.").holds("problem"),
          Key(table, "atlas", "The image that textures are packed into.").holds("atlas"),
          Key(tables, "texture", "One texture each.").at_most(kMostTextures).holds("texture"),
          Key(tables, "texture_pattern", "Many textures each.")
              .at_most(kMostTextures)
              .holds("texture_pattern"),
          Key(tables, "step", "The script.").must().at_most(kMostSteps).holds("step"),
      }};
}

TableDoc step_table() {
  return {"step",
          "[[step]]",
          "One step of the script. Each has a verb in `do`, the verb's own keys, and any of these.",
          {
              Key(text, "do", "The verb, one of those below.").must(),
              Key(text, "name", "To ask for this step's frames with `--at`.")
                  .like(kEventPattern)
                  .or_else("the verb"),
              Key(text, "part", "Stands behind the title from here on.")
                  .range(1, 60)
                  .or_else("as before"),
              Key(text, "caption", "Explains the frame. It may quote counts.")
                  .range(0, kMostCaption)
                  .by_default("\"\""),
              Key(text, "plot", "Adds a point to the [chart], or a bar with this label.")
                  .range(1, 40)
                  .or_else("adds none"),
              Key(table, "expect", "What must hold when the step is done.").holds("expect"),
              Key(table, "always", "What must hold on every frame of the step.").holds("expect"),
          }};
}

}  // namespace

const KeyDoc* TableDoc::find(std::string_view key) const {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const KeyDoc& k) { return k.key == key; });
  return found == keys.end() ? nullptr : &*found;
}

std::span<const TableDoc> language_tables() {
  static const std::vector<TableDoc> tables = {
      file_table(),    world_table(),           structure_table(), planes_table(),
      body_table(),    pattern_table(),         spring_table(),    joint_table(),
      level_table(),   chart_table(),           problem_table(),   atlas_table(),
      texture_table(), texture_pattern_table(), step_table(),      expect_table()};
  return tables;
}

const TableDoc& language_table(std::string_view name) {
  const auto tables = language_tables();
  const auto found = std::find_if(tables.begin(), tables.end(),
                                  [&](const TableDoc& table) { return table.name == name; });
  LANTERN_CHECK(found == tables.end(), ==, false);
  return *found;
}

}  // namespace lantern
