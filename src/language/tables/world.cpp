// [world], [display] and how a step is looked at, and [level].
#include <fmt/format.h>

#include "language/keys/key.hpp"
#include "language/script/script_reading.hpp"
#include "physics/integrate/integrator.hpp"

namespace lantern::language {
namespace {

constexpr double kLeastExtent = 1e-6;

// As many as its extent has numbers; 0 if that cannot be told, which is a mistake told elsewhere.
int dimension_of(const TomlTable& world) {
  for (const std::string_view key : {"size", "min", "max"})
    if (const auto* list = value_of<TomlArray>(world, key))
      if (list->size() == 2 || list->size() == 3) return static_cast<int>(list->size());
  return 0;
}

bool is_large_enough(const Box<3>& bounds, int dimension) {
  for (int i = 0; i < dimension; ++i)
    if (!(bounds.size()[i] >= kLeastExtent)) return false;
  return true;
}

Box<3> read_bounds(const TableReader& world, int dimension) {
  const Box<3> guess{Vec<3>(0.0), dimension == 3 ? Vec<3>(1.0) : Vec<3>(1, 1, 0)};
  Box<3> bounds{Vec<3>(0.0), world.get<Vec<3>>("size").value_or(guess.hi)};
  if (const auto min = world.get<Vec<3>>("min"), max = world.get<Vec<3>>("max"); min && max)
    bounds = {*min, *max};
  if (is_large_enough(bounds, dimension)) return bounds;
  world.bad_value(world.has("max") ? "max" : "size",
                  fmt::format("the world must extend at least {} on each axis", kLeastExtent),
                  "'max' lies to the upper right of 'min'");
  return guess;
}

void check_camera(const TableReader& world, WorldSpec& w, int dimension) {
  const bool eye = world.has("camera_eye"), target = world.has("camera_target");
  if (!eye && !target) return;
  const char* key = eye ? "camera_eye" : "camera_target";
  if ((eye && !world.is_good("camera_eye")) || (target && !world.is_good("camera_target"))) return;
  if (dimension == 2) {
    world.bad_key(key, "a 2D world has no camera", "for a 3D one, size = [16, 9, 16]");
  } else if (eye != target) {
    world.bad_key(
        key, fmt::format("[world] has '{}' but no '{}'", key, eye ? "camera_target" : "camera_eye"),
        "'camera_eye' and 'camera_target' go together");
  } else {
    if (w.camera_eye == w.camera_target)
      world.bad_value("camera_target", "the camera looks at itself",
                      "'camera_target' is what it looks at");
    w.has_camera = true;
  }
}

void check_land(const TableReader& world, const WorldSpec& w, int dimension) {
  if (!world.is_good("land")) return;
  if (dimension == 3)
    return world.bad_key("land", "a 3D world has no land to draw on",
                         "for a 2D one, size = [16, 9]");
  const auto corners = sum_of<std::size_t>(w.land, [](const auto& land) { return land.size(); });
  if (corners > kMostWalls)
    world.bad_value("land", fmt::format("{} corners in all, the limit is {}", corners, kMostWalls));
}

constexpr const char* kGiveView = "a part of it: view = { at = [4, 3], width = 6 }";
constexpr const char* kGiveCamera = "its part is camera = { eye = [9, 6, 9], target = [2, 2, 2] }";

// What [world] and [display] both say.
constexpr std::pair<const char*, const char*> kTwice[] = {{"boxes", "show_boxes"},
                                                          {"arrows", "show_velocities"},
                                                          {"depths", "show_depths"},
                                                          {"forces", "show_forces"},
                                                          {"coordinates", "show_coordinates"}};

// Depths are of contacts.
void check_depths(const TableReader& table, const Display& display, const Draft& draft) {
  if (table.truth("depths") && display.depths && draft.dimension != 0 &&
      !draft.scenario.has_contacts())
    table.bad_key("depths", kNothingTouches, kGiveContacts);
}

std::optional<ViewSpec> checked(const TableReader& table, const ViewSpec& view,
                                const Draft& draft) {
  if (table.has("at") != table.has("width")) {
    const char* given = table.has("at") ? "at" : "width";
    table.bad_key(
        given, fmt::format("'view' has '{}' but no '{}'", given, table.has("at") ? "width" : "at"),
        "'at' and 'width' go together; view = {} shows all");
    return std::nullopt;
  }
  if (!view.at || !table.is_good("width")) return view;
  const Box<3>& bounds = draft.scenario.world.bounds;
  if (!contains(bounds, *view.at))
    table.bad_value("at", "the view's middle lies outside the world",
                    fmt::format("the world reaches from [{:.6g}, {:.6g}] to [{:.6g}, {:.6g}]",
                                bounds.lo.x, bounds.lo.y, bounds.hi.x, bounds.hi.y));
  else if (view.width > bounds.size().x)
    table.bad_value(
        "width",
        fmt::format("the view is wider than the world, which is {:.6g} wide", bounds.size().x),
        "view = {} shows all of it");
  return view;
}

std::optional<CameraSpec> checked(const TableReader& table, const CameraSpec& camera) {
  if (!table.is_good("eye") || !table.is_good("target")) return std::nullopt;
  if (camera.eye != camera.target) return camera;
  table.bad_value("target", "the camera looks at itself", "'target' is what it looks at");
  return std::nullopt;
}

// Is there a world of so many dimensions? Else says so at the step's key.
bool has_world(const TableReader& step, const char* key, int dimension, const Draft& draft) {
  if (!draft.has_world) {
    step.bad_key(key, fmt::format("'{}' needs a [world], the scenario has none", key),
                 "leave it out");
    return false;
  }
  if (draft.dimension == dimension || draft.dimension == 0) return draft.dimension != 0;
  step.bad_key(key, fmt::format("a {}D world has no '{}'", draft.dimension, key),
               dimension == 2 ? kGiveCamera : kGiveView);
  return false;
}

// Walls of no length have no line.
void check_loops(const LevelSpec& level, const TableReader& table) {
  std::size_t walls = 0, number = 0;
  for (const auto& loop : level.loops) {
    ++number;
    walls += loop.size();
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (loop[i] == loop[(i + 1) % loop.size()]) {
        table.bad_value("loops",
                        fmt::format("polygon {} has the corner [{}, {}] twice in a row", number,
                                    loop[i].x, loop[i].y),
                        "the last corner is joined to the first by itself");
        break;
      }
  }
  if (walls > kMostWalls)
    table.bad_value("loops", fmt::format("{} walls in all, the limit is {}", walls, kMostWalls));
}

}  // namespace

TableDoc world_table() {
  using W = WorldSpec;
  TableDoc table = {"world", "[world]",
                    "Where the bodies are: x to the right, y up, z towards the viewer. If its "
                    "extent has two numbers the world is 2D, if three it is 3D, and every point in "
                    "the file then has as many. A scenario has either a world or an atlas."};
  table.keys = {
      key(KeyType::point, "size", "Its extent, from the origin; at least 0.000001 on each axis.",
          above(0, kFar)),
      key(KeyType::point, "min", "Its lowest corner, instead of `size`.", range(-kFar, kFar)),
      key(KeyType::point, "max", "Its highest corner, instead of `size`.", range(-kFar, kFar)),
      key(&W::time_step, "time_step", "How much time passes in one world step.", above(0, 1e3),
          in("s"), or_else("1/60"), by_hand(0.005, 0.1)),
      key(&W::frame_every, "frame_every", "World steps from one frame to the next.",
          range(1, kMostEvery), in("steps")),
      key(&W::gravity, "gravity", "Acts on every body that forces move.", range(-kFar, kFar),
          in("units/s²"), or_else("none"), by_hand(-20, 20)),
      key(&W::gravitation, "gravitation",
          "Bodies attract each other with this times both masses over the square of their "
          "distance. A static body attracts if it has a `mass`.",
          range(0, kFar)),
      key(&W::contacts, "contacts",
          "How touching bodies are kept apart: by sequential `impulse`s; by `soft` contacts in "
          "small steps; by the same in whole steps, `direct`ly, which holds pyramids of up to "
          "3,240 boxes, while heaps of hundreds that fell creep, 3e-6 a second (of more than some "
          "thousands, whose equations take more than 8 MB, sweeps alone are left, and they creep); "
          "by one impulse a pair, as the `lecture` does it; or not at all. Without a [structure], "
          "every pair is tested for it. Rolling off an edge, rocking, and turning on a face are of "
          "first order in the step: at 60 a second a ball leaves a round top 2 to 4 % too fast; in "
          "3D, a plank with unlike inertias that rocks under another integrator than the Euler "
          "methods may swing 8 % wider or 16 % less within 20 s. Taut joints under 500 times a "
          "plank's weight part by 6 % of it by `direct` and `impulse`, and in fast chains beside "
          "contacts by up to two links for a step, which by `explicit_euler` may gain energy. What "
          "bounces in a stack until it is too slow to may lose 5e-7 of its energy in a step, or "
          "gain 6e-7.",
          by_hand()),
      key(&W::integrator, "integrator",
          "How forces become motion. By `semi_implicit_euler` places follow the new velocities, "
          "half a step ahead of what a steady force speeds up, but for balls on what stands still; "
          "what joints hold and nothing touches it moves as `velocity_verlet`. Beside contacts, "
          "joints take about half the square of the angle that bodies turn by in a step, of their "
          "energy. By `implicit_midpoint`, however exactly solved, what swings on a stiff spring "
          "by an angle a in a step of h seconds has at times a²h²k/16m of its energy too much, "
          "and may gain without bound where ah√(k/m) is above 3: a pendulum of 1 kg that swings "
          "by 20 J gets 2e8 J from a spring of 1e12 N a unit in 6 s at 60 steps a second; "
          "`implicit_euler` loses instead. `kahan_li_8` (order 8, 17 evaluations of the forces a "
          "step, symplectic and reversible) and `dormand_prince` (order 5, 6 evaluations) are for "
          "forces that follow from places alone: gravity, `gravitation`, springs and pushes. They "
          "refuse `contacts`, drag, the damping of springs, and joints.",
          by_hand()),
      key(&W::rotation, "rotation",
          "How free bodies rotate: exactly, to rounding, at any spin and step; or by a splitting "
          "of order 2 or 4, and exactly only where it would change the energy by more than a "
          "thousandth. `explicit_gyroscopic` is there to be seen failing."),
      key(&W::sub_steps, "sub_steps", "How many parts soft contacts divide a world step into.",
          range(1, 64), by_hand(1, 16)),
      key(&W::wanted_error, "wanted_error",
          "How deep two bodies may lie in each other at the end of a step, in units, or as deep "
          "as before it, if that is more; 0 asks for 0.000001. What lies deeper is pushed out, "
          "or its step made anew in up to 64 parts. What cannot be kept, between walls that close "
          "or at 0 by single ones of many bodies, is counted (`errors_missed`). Soft contacts of "
          "many bodies are swept as exactly, too: 0.01 is quick, 0.0001 is slow, 0 solves all "
          "rows at once. Without it, or by the lecture's contacts, what falls and turns may for a "
          "while lie some tenths of a unit in another.",
          range(0, 1), or_else("any")),
      key(&W::iterations, "iterations",
          "Sweeps over the velocities in a world step, and as many over the positions. Ten hold a "
          "stack of 10 equal boxes of size 1 at 60 steps a second, and of 20 at 120; what is r "
          "times as heavy as what carries it needs about r of them. What nearly tips needs more: "
          "a box on a slope at 99 % of its limit 50, an overhang at 99.5 % 200.",
          range(1, 1000), by_hand(1, 50)),
      key(&W::impact_budget, "impact_budget",
          "How many impacts are located in one world step; later ones are treated as soft. "
          "Bouncing bodies, and those that fly or spin fast, are stopped at the moment of impact, "
          "however often they meet. Where contacts must hold what spins fast, a world step is cut "
          "into up to 1024 parts, so that what flies or spins fast gets through no wall, as long "
          "as forces alone move it by less than a wall's thickness in a step; what even these "
          "cannot move on waits until the next step. The lecture's own contacts do none of this.",
          range(0, 10'000'000)),
      key(&W::may_sleep, "may_sleep", "Bodies that have been at rest for a while fall asleep.",
          by_hand()),
      key(&Display::boxes, "show_boxes", "The boxes of the broad phase are drawn."),
      key(&Display::arrows, "show_velocities", "Velocities are drawn as arrows."),
      key(&Display::depths, "show_depths",
          "Penetration depths are written beside the contacts, taking one unit as one metre."),
      key(&Display::forces, "show_forces",
          "The forces of `do = \"force\"` and the pulls of springs are drawn as arrows, with their "
          "sizes."),
      key(&Display::coordinates, "show_coordinates",
          "Where the borders of the lit nodes and of those above them lie stands at the edges of a "
          "2D world."),
      key(&W::camera_eye, "camera_eye", "Where a 3D world is seen from; with `camera_target`.",
          range(-kFar, kFar), or_else("so that all is seen")),
      key(&W::camera_target, "camera_target", "What is in the middle of the picture.",
          range(-kFar, kFar), or_else("so that all is seen")),
      key(&W::land, "land",
          "Polygons that are only drawn, under all else in a 2D world, as the land of a map: "
          "`[[[0, 0], [8, 0], [8, 6]]]`. No body meets them. 2000 corners in all are allowed.",
          range(-kFar, kFar), or_else("none")),
      key(&W::sea, "sea", "What is no `land` has the colour of water."),
      key(&W::quiet, "quiet",
          "What is intended and needs no warning: a `view` without any body, a body `outside` the "
          "world, bodies that fall into each other where `contacts` are off, `joints` that come "
          "apart, `energy` that grows though nothing drives it, a body pushed `through` a static "
          "one, a body that is `crush`ed between two others; an `expect` that cannot fail, "
          "`settings` of contacts where nothing touches, `bodies` that never enter, `prototypes` "
          "that nobody is like, `letters` that stand nowhere in the map, `paint` that stands out "
          "little, `links` (springs or joints) that are there twice, `needs` of a scenario that is "
          "not there, a `problem` whose solution is another one's.",
          or_else("nothing")),
  };
  table.groups = {{{"size"}, {"min", "max"}}};
  return table;
}

bool check_knows(const TableReader& table, std::string_view key, Integrator by, bool acts,
                 std::string_view what) {
  if (!acts || !integration(by).of_places) return false;
  table.bad_value(key, fmt::format("'{}' knows no {}", to_string(by), what),
                  "it takes forces that follow from places alone; \"runge_kutta_4\" knows others");
  return true;
}

void read_world(const TableReader& file, Draft& draft) {
  draft.has_world = file.has("world");
  for (const TomlValue* value : file.tables("world")) {
    draft.dimension = dimension_of(std::get<TomlTable>(value->data));
    const TableReader world = open(*value, language_table("world"), draft);
    WorldSpec& w = draft.scenario.world;
    world.fill(w);
    world.fill(draft.scenario.display);
    w.dimension = draft.dimension == 3 ? 3 : 2;
    w.bounds = read_bounds(world, w.dimension);
    w.where = draft.position(value->where);
    for (const KeyDoc& key : world.doc().keys)
      if (world.has(key.key)) w.keys[key.key] = draft.position(world.key_place(key.key));
    check_knows(world, "integrator", w.integrator, w.contacts != ContactMethod::none, "contacts");
    if (draft.scenario.display.depths && w.contacts == ContactMethod::none)
      world.bad_key("show_depths", kNothingTouches, kGiveContacts);
    check_camera(world, w, draft.dimension);
    check_land(world, w, draft.dimension);
  }
  read_structures(file, draft);
}

TableDoc display_table() {
  using D = Display;
  return {
      "display",
      "[display] and display",
      "What frames show of what there is: for the whole scenario as `[display]`, for one step "
      "alone as `display = { names = \"none\", arrows = true }`; what a step does not name stays "
      "as `[display]` has it.",
      {
          key(&D::names, "names",
              "Names beside bodies. `story`: of more than 8 bodies only of those that are lit, or "
              "that the caption names; `all`: of all, as far as there is room; `none`."),
          key(&D::pairs, "pairs", "Links between bodies that are to be tested."),
          key(&D::contacts, "contacts", "Contact points, normals and impulses."),
          key(&D::arrows, "arrows", "Velocities as arrows; `show_velocities` of [world]."),
          key(&D::forces, "forces", "Forces as arrows."),
          key(&D::cells, "cells", "The nodes' cells in the world."),
          key(&D::not_made, "not_made", "Hatching where a child was not made."),
          key(&D::fill, "fill",
              "Leaves as buckets, with a level in each: how much of its capacity it holds."),
          key(&D::outlined, "outlined",
              "A 2D world's bodies in outline, so that the cells under them can be seen."),
          key(&D::boxes, "boxes", "The boxes of the broad phase; `show_boxes` of [world]."),
          key(&D::depths, "depths",
              "How deep bodies overlap, beside their contacts; `show_depths` of [world]."),
          key(&D::coordinates, "coordinates",
              "The borders of the lit way, at a 2D world's edges; `show_coordinates` of [world]."),
          key(&D::trail, "trail",
              "Where moving bodies were at the ends of so many world steps before, in outline, and "
              "their way from one to the next by the impacts between; before a step is taken "
              "(`phases`), dotted, also where they would be after it if they met nothing.",
              range(0, kMostTrail), in("steps")),
          key(&D::counters, "counters", "The numbers at the right of the caption."),
          key(&D::title, "title", "The thin line above."),
          key(&D::caption, "caption", "The caption below."),
          key(&D::settings, "settings", "What the structure was told, under its tree."),
          key(&D::legend, "legend", "The marks of the frame with their meanings, above the foot."),
      }};
}

TableDoc view_table() {
  return {
      "view",
      "view",
      "Which part of a 2D world is shown from this step on, with a locator of the whole; `view = "
      "{}` shows all again. The part is as wide as it says and as high as the world's proportions "
      "make it; it stays within the world.",
      {key(&ViewSpec::at, "at", "Its middle.", range(-kFar, kFar), or_else("all is shown")),
       key(&ViewSpec::width, "width", "How wide it is.", above(0, kFar), or_else("all is shown"))}};
}

TableDoc camera_table() {
  return {"camera",
          "camera",
          "From where a 3D world is seen from this step on, instead of [world]'s camera.",
          {key(&CameraSpec::eye, "eye", "Where the eye is.", must(), range(-kFar, kFar)),
           key(&CameraSpec::target, "target", "What is in the middle of the picture.", must(),
               range(-kFar, kFar))}};
}

void read_display(const TableReader& file, Draft& draft) {
  for (const TomlValue* value : file.tables("display")) {
    const TableReader table = open(*value, language_table("display"), draft);
    for (const auto& [key, old] : kTwice)
      if (table.has(key) && draft.scenario.world.keys.contains(old))
        table.bad_key(key, fmt::format("[world] has '{}', which says the same", old),
                      "give one of them");
    table.fill(draft.scenario.display);
    check_depths(table, draft.scenario.display, draft);
  }
}

void read_look(const TableReader& step, Step& to, Draft& draft) {
  for (const TomlValue* value : step.tables("display")) {
    const TableReader table = open(*value, language_table("display"), draft, "'display'");
    to.display = draft.scenario.display;
    table.fill(*to.display);
    check_depths(table, *to.display, draft);
  }
  if (step.is_good("view") && has_world(step, "view", 2, draft))
    for_each<ViewSpec>(
        step, "view", draft,
        [&](const TableReader& table, const ViewSpec& view) {
          to.view = checked(table, view, draft);
        },
        "'view'");
  if (step.is_good("camera") && has_world(step, "camera", 3, draft))
    for_each<CameraSpec>(
        step, "camera", draft,
        [&](const TableReader& table, const CameraSpec& camera) {
          to.camera = checked(table, camera);
        },
        "'camera'");
  if (step.is_good("orbit")) has_world(step, "orbit", 3, draft);
}

TableDoc level_table() {
  using L = LevelSpec;
  TableDoc table = {
      "level", "[level]",
      "Walls in a 2D world that `do = \"compile\"` turns into a BSP, as for a first-person game."};
  table.keys = {
      key(&L::loops, "loops",
          "Closed polygons, as `[[[0, 0], [8, 0], [8, 6]]]`, each with its solid side on the right "
          "as you go round. 2000 walls in all are allowed.",
          must(), range(-kFar, kFar)),
      key(&L::balance, "balance",
          "What a line's score counts for each wall that one side has more than the other.",
          range(0, 1e6), by_hand(0, 10)),
      key(&L::cuts, "cuts", "What it counts for each wall that the line cuts in two.",
          range(0, 1e6), by_hand(0, 10)),
      key(&L::first_wall, "choose", "The line with the lowest score, or the first wall's.",
          one_of({"score", "first_wall"}), by_hand()),
  };
  return table;
}

void read_level(const TableReader& file, Draft& draft) {
  if (file.has("level")) draft.scenario.level.emplace();  // a bad one is told once
  for_each<LevelSpec>(file, "level", draft, [&](const TableReader& table, LevelSpec& level) {
    check_loops(level, table);
    draft.scenario.level = std::move(level);
    if (!draft.has_world)
      draft.problems.add(table.where(), "a [level] needs a [world]",
                         "add [world] with size = [64, 64]");
    else if (draft.dimension == 3)
      draft.problems.add(table.where(), "a [level] needs a 2D world, this one is 3D",
                         "write [world] with size = [64, 64]");
  });
}

}  // namespace lantern::language
