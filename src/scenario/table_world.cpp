// [world]: how many dimensions it has, how far it extends, and its rules.
#include <fmt/format.h>

#include "scenario/draft.hpp"
#include "scenario/key.hpp"

namespace lantern::scenario {
namespace {

constexpr double kLeastExtent = 1e-6;

// As many as its extent has numbers; 0 if that cannot be told, which is a mistake told elsewhere.
int dimension_of(const TomlTable& world) {
  for (const std::string_view key : {"size", "min", "max"})
    for (const TomlEntry& e : world) {
      const auto* list = e.key == key ? std::get_if<TomlArray>(&e.value.data) : nullptr;
      if (list && (list->size() == 2 || list->size() == 3)) return static_cast<int>(list->size());
    }
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
  std::size_t corners = 0;
  for (const auto& polygon : w.land) corners += polygon.size();
  if (corners > kMostWalls)
    world.bad_value("land", fmt::format("{} corners in all, the limit is {}", corners, kMostWalls));
}

}  // namespace

TableDoc world_table() {
  using namespace keys;
  using W = WorldSpec;
  TableDoc table = {
      "world", "[world]",
      "Where the bodies are: x to the right, y up, z towards the viewer. If its extent has two "
      "numbers the world is 2D, if three it is 3D, and every point in the file then has as many. A "
      "scenario has either a world or an atlas."};
  table.keys = {
      key(KeyType::point, "size", "Its extent, from the origin; at least 0.000001 on each axis.",
          above(0, kFar)),
      key(KeyType::point, "min", "Its lowest corner, instead of `size`.", range(-kFar, kFar)),
      key(KeyType::point, "max", "Its highest corner, instead of `size`.", range(-kFar, kFar)),
      key(&W::time_step, "time_step", "How much time passes in one world step.", above(0, 1e3),
          in("s"), or_else("1/60")),
      key(&W::frame_every, "frame_every", "World steps from one frame to the next.",
          range(1, kMostEvery), in("steps")),
      key(&W::gravity, "gravity", "Acts on every body that forces move.", range(-kFar, kFar),
          in("units/s²"), or_else("none")),
      key(&W::gravitation, "gravitation",
          "Bodies attract each other with this times both masses over the square of their "
          "distance. A static body attracts if it has a `mass`.",
          range(0, kFar)),
      key(&W::contacts, "contacts",
          "How touching bodies are kept apart: by sequential `impulse`s; by `soft` contacts in "
          "small steps; by the same in whole steps, `direct`ly; by one impulse a pair, as the "
          "`lecture` does it; or not at all. Without a [structure], every pair is tested for it."),
      key(&W::integrator, "integrator", "How forces become motion."),
      key(&W::rotation, "rotation",
          "How free bodies rotate. Where a splitting would change the energy by more than a "
          "thousandth, because a body turns far in a step, it is turned exactly. "
          "`explicit_gyroscopic` is there to be seen failing."),
      key(&W::sub_steps, "sub_steps", "How many parts soft contacts divide a world step into.",
          range(1, 64)),
      key(&W::wanted_error, "wanted_error",
          "The error that is wanted of soft contacts of many bodies: by how much they may be out "
          "of "
          "place, in units. 0.01 is quick, 0.0001 is slow, 0 as exact as can be; `sub_steps` are "
          "then made as far as the error asks for them.",
          range(0, 1)),
      key(&W::iterations, "iterations",
          "Sweeps over the velocities in a world step, and as many over the positions.",
          range(1, 1000)),
      key(&W::impact_budget, "impact_budget",
          "How many impacts are located in one world step; later ones are treated as soft. "
          "Bouncing bodies are stopped at the moment of impact, however often they bounce.",
          range(0, 10'000'000)),
      key(&W::may_sleep, "may_sleep", "Bodies that have been at rest for a while fall asleep."),
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
      key(&W::quiet, "quiet",
          "What is intended and needs no warning: a `view` without any body, a body `outside` "
          "the world, bodies that fall into each other where `contacts` are off, `joints` that "
          "come apart, `energy` that grows though nothing drives it, a body pushed `through` a "
          "static one, a body that is `crush`ed between two others; an `expect` that cannot fail, "
          "`settings` of contacts where nothing touches, `bodies` that never enter, `prototypes` "
          "that nobody is like, `letters` that stand nowhere in the map, `links` (springs or "
          "joints) that are there twice, `needs` of a scenario that is not there, a `problem` "
          "whose solution is another one's.",
          or_else("nothing")),
  };
  table.groups = {{{"size"}, {"min", "max"}}};
  return table;
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
    if (draft.scenario.display.depths && w.contacts == ContactMethod::none)
      world.bad_key("show_depths", kNothingTouches, kGiveContacts);
    check_camera(world, w, draft.dimension);
    check_land(world, w, draft.dimension);
  }
  read_structures(file, draft);
}

}  // namespace lantern::scenario
