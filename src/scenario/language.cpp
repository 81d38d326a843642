#include "scenario/language.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "scenario/language_row.hpp"

namespace lantern {
namespace {

using enum KeyType;

const std::vector<std::string_view> kLooks = {"ghost", "player", "ball", "bat", "disc", "box"};

TableDoc file_table() {
  return {
      "",
      "The file's own keys",
      "A scenario of Lantern. These keys stand at the top, before the first [table].",
      {
          Row(text, "title", "The thin line above every frame.").must().range(1, 80),
          Row(text, "source", "The section of the lecture that the scenario shows.")
              .range(0, 80)
              .by_default("\"\""),
          Row(text, "name", "Names the output folder and its files.")
              .like(kFilePattern)
              .or_else("the file's name"),
          Row(whole, "seed",
              "Where random patterns begin; the same seed gives the same frames everywhere.")
              .range(0, kMostWhole)
              .by_default("1"),
          Row(choice, "pace", "One frame a step, or one for each thing that the algorithm does.")
              .one_of({"step", "event"})
              .by_default("\"step\""),
          Row(choices_list, "panels", "What is drawn, from left to right.")
              .one_of({"world", "tree", "atlas"})
              .or_else("what the scenario uses"),
          Row(table, "world", "Where bodies are.").holds("world"),
          Row(table, "structure", "How the world is partitioned.").holds("structure"),
          Row(tables, "body", "One body each.").at_most(kMostBodies).holds("body"),
          Row(tables, "pattern", "Many bodies each.").at_most(kMostBodies).holds("pattern"),
          Row(table, "atlas", "The image that textures are packed into.").holds("atlas"),
          Row(tables, "texture", "One texture each.").at_most(kMostTextures).holds("texture"),
          Row(tables, "texture_pattern", "Many textures each.")
              .at_most(kMostTextures)
              .holds("texture_pattern"),
          Row(tables, "step", "The script.").must().at_most(kMostSteps).holds("step"),
      }};
}

TableDoc world_table() {
  return {"world",
          "[world]",
          "The flat world of the bodies: x to the right, y up. A scenario has either a world or an "
          "atlas.",
          {
              Row(point, "size", "Its extent, from the origin; at least 0.000001 on each axis.")
                  .above(0, kFar),
              Row(point, "min", "Its lower left corner, instead of `size`.").range(-kFar, kFar),
              Row(point, "max", "Its upper right corner, instead of `size`.").range(-kFar, kFar),
              Row(number, "time_step", "How much time passes from frame to frame.")
                  .above(0, 1e3)
                  .in("s")
                  .or_else("1/60"),
          },
          {.groups = {{"size"}, {"min", "max"}}}};
}

TableDoc structure_table() {
  return {
      "structure",
      "[structure]",
      "The spatial structure that finds the candidate pairs. It may be rebuilt later as another "
      "one.",
      {
          Row(choice, "kind",
              "`brute_force` tests every pair; `bsp` cuts along the lines in `planes`. On one "
              "frame, "
              "2000000 pairs may meet.")
              .must()
              .one_of({"none", "brute_force", "quadtree", "bsp"}),
          Row(whole, "capacity", "A quadtree's leaf that holds more splits, if depth is left.")
              .range(1, 1000)
              .in("bodies")
              .by_default("2"),
          Row(whole, "max_depth",
              "A quadtree's leaf at this depth never splits; the root has depth 0. A tree may have "
              "2000000 "
              "nodes and as many entries.")
              .range(0, 32)
              .by_default("6"),
          Row(choice, "children",
              "Made when something enters them (`lazy`), or all four at a split (`eager`).")
              .one_of({"lazy", "eager"})
              .by_default("\"lazy\""),
          Row(truth, "no_progress_stop",
              "A quadtree does not split bodies that all share one point: it would part none.")
              .by_default("false"),
          Row(tables, "planes", "A BSP's dividing lines.").at_most(255).holds("structure.planes"),
      }};
}

TableDoc planes_table() {
  return {"structure.planes",
          "[[structure.planes]]",
          "A line that divides a region of a BSP into what lies behind it and what lies in front.",
          {
              Row(text, "name", "Its label.").range(0, 24).by_default("\"\""),
              Row(point, "point", "A point on the line.").must().range(-kFar, kFar),
              Row(point, "normal", "At a right angle to the line, towards its front; not zero.")
                  .must()
                  .range(-kFar, kFar),
              Row(text, "at",
                  "The region it divides: `root`, or the way down, as `back` or `front.back`. The "
                  "lines on the way stand earlier.")
                  .range(1, 2000)
                  .or_else("`root` for the first"),
          }};
}

// What [[body]] and [[pattern]] share.
std::vector<KeyDoc> body_keys(std::vector<KeyDoc> first, std::string_view color_doc,
                              std::string_view color_fallback, double least_color) {
  const std::vector<KeyDoc> shared = {
      Row(choice, "look", "The character that is drawn.")
          .one_of(kLooks)
          .or_else("`disc` with a radius, `box` with half sizes"),
      Row(whole, "color", color_doc).range(least_color, 8).by_default(color_fallback),
      Row(number, "radius", "Of a disc.").range(0, kFar),
      Row(point, "half_size", "Of a box, instead of `radius`.").range(0, kFar),
      Row(truth, "static", "Never moves.").by_default("false"),
  };
  first.insert(first.end(), shared.begin(), shared.end());
  return first;
}

TableDoc body_table() {
  return {"body",
          "[[body]]",
          "A body. It enters the world when a step inserts it. A body of no size must stand still.",
          body_keys(
              {
                  Row(text, "name", "Unique over bodies and patterns.").must().like(kNamePattern),
                  Row(point, "position", "Of its centre.").must().range(-kFar, kFar),
                  Row(point, "velocity", "Where it goes while time passes.")
                      .range(-kFar, kFar)
                      .in("units/s")
                      .by_default("[0, 0]"),
              },
              "1 red, 2 pink, 3 yellow, 4 blue, 5 green, 6 sky, 7 orange, 8 violet, in the light "
              "theme.",
              "1", 1),
          {.groups = {{"radius"}, {"half_size"}}}};
}

TableDoc pattern_table() {
  return {"pattern",
          "[[pattern]]",
          "Many bodies at once. Those of pattern `dot` are called `dot1`, `dot2`, …",
          body_keys(
              {
                  Row(text, "name", "Unique over bodies and patterns.").must().like(kNamePattern),
                  Row(whole, "count", "How many; 20000 bodies in all are allowed.")
                      .must()
                      .range(1, kMostBodies)
                      .in("bodies"),
                  Row(choice, "arrange", "At random places, or in rows from the lower left.")
                      .one_of({"random", "grid"})
                      .by_default("\"random\""),
                  Row(point, "min", "Lower left corner of where centres may be.")
                      .range(-kFar, kFar)
                      .or_else("so that all lie in the world"),
                  Row(point, "max", "Upper right corner of where centres may be.")
                      .range(-kFar, kFar)
                      .or_else("so that all lie in the world"),
                  Row(number, "speed", "Each in a random direction.")
                      .range(0, kFar)
                      .in("units/s")
                      .by_default("0"),
                  Row(whole, "seed", "Of this pattern alone.")
                      .range(0, kMostWhole)
                      .or_else("from the scenario's seed and the name"),
              },
              "As a body's; 0 cycles through 1 to 8.", "0", 0),
          {.groups = {{"radius"}, {"half_size"}}}};
}

TableDoc atlas_table() {
  return {"atlas",
          "[atlas]",
          "One large image that textures are packed into, by a kD-tree. Its origin is the upper "
          "left corner.",
          {Row(size, "size", "Its width and height; it is also written as an image.")
               .must()
               .range(1, kMostAtlas)
               .in("px")}};
}

TableDoc texture_table() {
  return {
      "texture",
      "[[texture]]",
      "A texture. It enters the atlas when a step packs it.",
      {
          Row(text, "name", "Unique over textures and their patterns.").must().like(kNamePattern),
          Row(size, "size", "Its width and height.").must().range(1, kMostPixels).in("px"),
          Row(whole, "color", "As a body's.").range(1, 8).by_default("1"),
      }};
}

TableDoc texture_pattern_table() {
  return {
      "texture_pattern",
      "[[texture_pattern]]",
      "Many textures at once, of random sizes. Those of pattern `t` are called `t1`, `t2`, …",
      {
          Row(text, "name", "Unique over textures and their patterns.").must().like(kNamePattern),
          Row(whole, "count", "How many; 20000 textures in all are allowed.")
              .must()
              .range(1, kMostTextures)
              .in("textures"),
          Row(size, "min", "The least width and height.").must().range(1, kMostPixels).in("px"),
          Row(size, "max", "The largest width and height.").must().range(1, kMostPixels).in("px"),
          Row(whole, "multiple", "Widths and heights are multiples of it.")
              .range(1, kMostPixels)
              .in("px")
              .by_default("1"),
          Row(choice, "order", "In which they are named and packed.")
              .one_of({"as_made", "tallest_first"})
              .by_default("\"as_made\""),
          Row(whole, "color", "As a body's; 0 cycles through 1 to 8.").range(0, 8).by_default("0"),
          Row(whole, "seed", "Of this pattern alone.")
              .range(0, kMostWhole)
              .or_else("from the scenario's seed and the name"),
      }};
}

TableDoc step_table() {
  return {"step",
          "[[step]]",
          "One step of the script. Each has a verb in `do`, the verb's own keys, and any of these.",
          {
              Row(text, "do", "The verb, one of those below.").must(),
              Row(text, "name", "To ask for this step's frames with `--at`.")
                  .like(kEventPattern)
                  .or_else("the verb"),
              Row(text, "part", "Stands behind the title from here on.")
                  .range(1, 60)
                  .or_else("as before"),
              Row(text, "caption", "Explains the frame. It may quote counts.")
                  .range(0, kMostCaption)
                  .by_default("\"\""),
              Row(table, "expect", "What must hold when the step is done.").holds("expect"),
              Row(table, "always", "What must hold on every frame of the step.").holds("expect"),
          }};
}

TableDoc expect_table() {
  TableDoc expect = {
      "expect",
      "expect and always",
      "Promises that `lantern check` verifies. Any count may be a key, as in "
      "`expect = { nodes = 5, pairs = 1 }`.",
      {
          Row(name_wholes, "in_leaves", "In how many leaves a body is stored, as `{ pink = 2 }`.")
              .range(0, kMostWhole),
          Row(name_pairs, "pairs_are",
              "The candidate pairs, these and no others, as `[[\"red\", \"pink\"]]`."),
          Row(name_points, "position", "Where a body's centre is, as `{ ball = [12, 14] }`.")
              .range(-kFar, kFar),
          Row(number, "tolerance", "How far off a position may be on each axis.")
              .range(0, kFar)
              .by_default("1e-9"),
      }};
  for (const CountDoc& count : known_counts())
    expect.keys.push_back(Row(whole, count.name, count.doc).range(0, kMostWhole));
  return expect;
}

}  // namespace

const KeyDoc* TableDoc::find(std::string_view key) const {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const KeyDoc& k) { return k.key == key; });
  return found == keys.end() ? nullptr : &*found;
}

std::span<const TableDoc> language_tables() {
  static const std::vector<TableDoc> tables = {
      file_table(),    world_table(), structure_table(), planes_table(),          body_table(),
      pattern_table(), atlas_table(), texture_table(),   texture_pattern_table(), step_table(),
      expect_table()};
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
