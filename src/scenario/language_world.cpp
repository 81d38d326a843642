// Tables of the world: its extent and rules, its structure, its level and its chart.
#include "scenario/language_key.hpp"
#include "scenario/language_parts.hpp"
#include "scenario/scenario.hpp"

namespace lantern {

using enum KeyType;

std::vector<std::string_view> integrator_names() {
  return {"explicit_euler", "semi_implicit_euler", "velocity_verlet",
          "runge_kutta_4",  "implicit_midpoint",   "implicit_euler"};
}

std::vector<std::string_view> rotation_names() {
  return {"splitting_2", "splitting_4", "explicit_gyroscopic"};
}

TableDoc world_table() {
  return {
      "world",
      "[world]",
      "Where the bodies are: x to the right, y up, z towards the viewer. With two numbers its "
      "extent "
      "makes a flat world, with three a solid one; every point of the file then has as many. A "
      "scenario has either a world or an atlas.",
      {
          Key(point, "size", "Its extent, from the origin; at least 0.000001 on each axis.")
              .above(0, kFar),
          Key(point, "min", "Its lowest corner, instead of `size`.").range(-kFar, kFar),
          Key(point, "max", "Its highest corner, instead of `size`.").range(-kFar, kFar),
          Key(number, "time_step", "How much time passes in one world step.")
              .above(0, 1e3)
              .in("s")
              .or_else("1/60"),
          Key(whole, "frame_every", "World steps from frame to frame, while time passes.")
              .range(1, kMostEvery)
              .in("steps")
              .by_default("1"),
          Key(point, "gravity", "Pulls at every body that forces move.")
              .range(-kFar, kFar)
              .in("units/s²")
              .or_else("none"),
          Key(number, "gravitation",
              "Bodies attract each other with this times both masses over the square of their "
              "distance. A static body attracts if it has a `mass`.")
              .range(0, kFar)
              .by_default("0"),
          Key(choice, "contacts",
              "How bodies that touch are parted: by sequential `impulse`s; by `soft` contacts in "
              "small steps; by the same in whole steps, `direct`ly; by one impulse a pair, as the "
              "`lecture` does it; or not at all.")
              .one_of(contact_method_names())
              .by_default("\"none\""),
          Key(choice, "integrator", "How forces become motion.")
              .one_of(integrator_names())
              .by_default("\"semi_implicit_euler\""),
          Key(choice, "rotation",
              "How bodies turn that nothing holds. `explicit_gyroscopic` is there to be seen "
              "failing.")
              .one_of(rotation_names())
              .by_default("\"splitting_2\""),
          Key(whole, "sub_steps", "Into which soft contacts divide a world step.")
              .range(1, 64)
              .by_default("8"),
          Key(whole, "iterations", "Of the impulses, in a world step.")
              .range(1, 1000)
              .by_default("10"),
          Key(whole, "impact_budget",
              "How many impacts are located in one world step; those that come later are soft. "
              "Bodies that bounce are met at the very moment, however often they do.")
              .range(0, 10'000'000)
              .by_default("10000"),
          Key(truth, "may_sleep", "Bodies that have been at rest for a while fall asleep.")
              .by_default("false"),
          Key(truth, "show_boxes", "The boxes of the broad phase are drawn.").by_default("false"),
          Key(truth, "show_velocities", "Velocities are drawn as arrows.").by_default("false"),
          Key(truth, "show_depths",
              "How deep bodies overlap stands beside their contacts; a unit is taken for a metre.")
              .by_default("false"),
          Key(point, "camera_eye", "From where a solid world is seen; with `camera_target`.")
              .range(-kFar, kFar)
              .or_else("so that all is seen"),
          Key(point, "camera_target", "What is in the middle of the picture.")
              .range(-kFar, kFar)
              .or_else("so that all is seen"),
          Key(choices_list, "quiet",
              "What is meant, and not to be warned of: a `view` without any body, a body `outside` "
              "the world, bodies that fall into each other where `contacts` are off, `joints` that "
              "part, `energy` that grows though nothing drives it, a body that is pushed `through` "
              "a static one.")
              .one_of({kWarnings.begin(), kWarnings.end()})
              .or_else("nothing"),
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
          Key(choice, "kind",
              "`brute_force` tests every pair; `bsp` cuts along the lines in `planes`; a "
              "`quadtree` cuts a solid world along x and z, an `octree` along all three; "
              "`lecture_quadtree` is the lecture's own code, which makes all children at a split "
              "and has no stop but the depth limit. On one frame, 2000000 pairs may meet.")
              .must()
              .one_of({"none", "brute_force", "sort_and_sweep", "quadtree", "octree", "bsp",
                       "kd_tree", "lecture_quadtree"}),
          Key(whole, "capacity", "A leaf that holds more splits, if depth is left.")
              .range(1, 1000)
              .in("bodies")
              .by_default("2"),
          Key(whole, "max_depth",
              "A leaf at this depth never splits; the root has depth 0. A tree may have 2000000 "
              "nodes and as many entries.")
              .range(0, 32)
              .by_default("6"),
          Key(choice, "children",
              "Made when something enters them (`lazy`), or all at a split (`eager`).")
              .one_of({"lazy", "eager"})
              .by_default("\"lazy\""),
          Key(truth, "no_progress_stop",
              "Bodies that all share one point are not split: that would part none.")
              .by_default("false"),
          Key(truth, "split_static",
              "One structure for what never moves, built once, and one for what does.")
              .by_default("false"),
          Key(tables, "planes", "A BSP's dividing lines or planes.")
              .at_most(255)
              .holds("structure.planes"),
      }};
}

TableDoc planes_table() {
  return {"structure.planes",
          "[[structure.planes]]",
          "A line, or a plane of a solid world, that divides a region of a BSP into what lies "
          "behind it and what lies in front.",
          {
              Key(text, "name", "Its label.").range(0, 24).by_default("\"\""),
              Key(point, "point", "A point on the line.").must().range(-kFar, kFar),
              Key(point, "normal", "At a right angle to the line, towards its front; not zero.")
                  .must()
                  .range(-kFar, kFar),
              Key(text, "at",
                  "The region it divides: `root`, or the way down, as `back` or `front.back`. The "
                  "lines on the way stand earlier.")
                  .range(1, 2000)
                  .or_else("`root` for the first"),
          }};
}

TableDoc level_table() {
  return {
      "level",
      "[level]",
      "Walls of a flat world that `do = \"compile\"` makes a BSP of, as for a first-person game.",
      {
          Key(loops, "loops",
              "Closed polygons, as `[[[0, 0], [8, 0], [8, 6]]]`: the solid lies to the right of "
              "the way round. 2000 walls in all are allowed.")
              .must()
              .range(-kFar, kFar),
          Key(number, "balance",
              "What a line's score counts for each wall that one side has more than the other.")
              .range(0, 1e6)
              .by_default("1"),
          Key(number, "cuts", "What it counts for each wall that the line cuts in two.")
              .range(0, 1e6)
              .by_default("8"),
          Key(choice, "choose", "The line with the lowest score, or the first wall's.")
              .one_of({"score", "first_wall"})
              .by_default("\"score\""),
      }};
}

TableDoc chart_table() {
  return {
      "chart",
      "[chart]",
      "Counts and measures as a picture. Each step with `plot` adds a point to the lines, or a "
      "bar; over `time`, every frame adds a point by itself.",
      {
          Key(text, "x", "The count or measure along the x axis of lines, or `time`.").range(1, 64),
          Key(text, "bars", "The count that bars show, instead of lines.").range(1, 64),
          Key(texts, "y", "Counts and measures, each a line; of one body as `energy.bob`.")
              .or_else("none"),
          Key(truth, "logarithmic", "Axes on which equal steps multiply; time has none.")
              .by_default("false"),
          Key(number, "least", "Where the y axis begins; lines leave the picture below it.")
              .range(-1e12, 1e12)
              .or_else("where the lines do"),
          Key(number, "most", "Where the y axis ends.")
              .range(-1e12, 1e12)
              .or_else("where the lines do"),
          Key(truth, "each_part", "Over time: lines begin anew with each part of the script.")
              .by_default("false"),
      },
      {.groups = {{"x", "y"}, {"bars"}}}};
}

}  // namespace lantern
