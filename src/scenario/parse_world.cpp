// The world: how many dimensions it has, how far it extends, and its rules.
#include <fmt/format.h>

#include "scenario/draft.hpp"

namespace lantern {
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

// What the run has to say of the world is said where its keys stand.
void read_places(const TableReader& world, Draft& draft) {
  WorldSpec& w = draft.scenario.world;
  w.where = draft.position(world.where());
  for (const KeyDoc& key : language_table("world").keys)
    if (world.has(key.key)) w.keys[key.key] = draft.position(world.key_place(key.key));
}

Box<3> read_bounds(const TableReader& world, Draft& draft) {
  const int dimension = draft.dimension == 3 ? 3 : 2;
  const Box<3> guess{Vec<3>(0.0), dimension == 3 ? Vec<3>(1.0) : Vec<3>(1, 1, 0)};
  Box<3> bounds{Vec<3>(0.0), world.point("size").value_or(guess.hi)};
  if (const auto min = world.point("min"), max = world.point("max"); min && max)
    bounds = {*min, *max};
  if (is_large_enough(bounds, dimension)) return bounds;
  draft.problems.add(world.place(world.has("max") ? "max" : "size"),
                     fmt::format("the world must extend at least {} on each axis", kLeastExtent),
                     "'max' lies to the upper right of 'min'");
  return guess;
}

void read_camera(const TableReader& world, Draft& draft) {
  WorldSpec& w = draft.scenario.world;
  const bool eye = world.has("camera_eye"), target = world.has("camera_target");
  if (!eye && !target) return;
  const char* key = eye ? "camera_eye" : "camera_target";
  if ((eye && !world.is_good("camera_eye")) || (target && !world.is_good("camera_target"))) return;
  if (draft.dimension == 2) {
    draft.problems.add(world.key_place(key), "a flat world has no camera",
                       "for a solid one, size = [16, 9, 16]");
  } else if (eye != target) {
    draft.problems.add(
        world.key_place(key),
        fmt::format("[world] has '{}' but no '{}'", key, eye ? "camera_target" : "camera_eye"),
        "'camera_eye' and 'camera_target' go together");
  } else {
    const auto from = world.point("camera_eye"), to = world.point("camera_target");
    if (!from || !to) return;
    if (*from == *to)
      draft.problems.add(world.place("camera_target"), "the camera looks at itself",
                         "'camera_target' lies where it looks");
    w.camera_eye = *from;
    w.camera_target = *to;
    w.has_camera = true;
  }
}

void read_rules(const TableReader& world, Draft& draft) {
  WorldSpec& w = draft.scenario.world;
  if (const auto h = world.number("time_step")) w.time_step = *h;
  if (const auto n = world.whole("frame_every")) w.frame_every = static_cast<int>(*n);
  if (const auto n = world.whole("sub_steps")) w.sub_steps = static_cast<int>(*n);
  if (const auto n = world.whole("iterations")) w.iterations = static_cast<int>(*n);
  if (const auto n = world.whole("impact_budget")) w.impact_budget = static_cast<int>(*n);
  w.gravity = world.point("gravity").value_or(Vec<3>(0.0));
  w.gravitation = world.number("gravitation").value_or(0);
  if (const auto choice = world.choice("contacts"))
    w.contacts = static_cast<ContactMethod>(*choice);
  if (const auto choice = world.choice("integrator"))
    w.integrator = static_cast<Integrator>(*choice);
  if (const auto choice = world.choice("rotation"))
    w.rotation = static_cast<RotationMethod>(*choice);
  w.may_sleep = world.truth("may_sleep");
  w.show_boxes = world.truth("show_boxes");
  w.show_velocities = world.truth("show_velocities");
  w.show_depths = world.truth("show_depths");
  for (const std::size_t kind : world.choices("quiet"))
    w.quiet.push_back(static_cast<Warning>(kind));
  if (w.show_depths && w.contacts == ContactMethod::none)
    draft.problems.add(world.key_place("show_depths"), "in this world nothing touches",
                       "give [world] contacts = \"impulse\" or \"soft\"");
}

}  // namespace

void read_world(const TableReader& file, Draft& draft) {
  draft.has_world = file.has("world");
  for (const TomlValue* value : file.tables("world")) {
    draft.dimension = dimension_of(std::get<TomlTable>(value->data));
    const TableReader world = open(*value, language_table("world"), draft);
    draft.scenario.world.dimension = draft.dimension == 3 ? 3 : 2;
    draft.scenario.world.bounds = read_bounds(world, draft);
    read_places(world, draft);
    read_rules(world, draft);
    read_camera(world, draft);
  }
  read_structures(file, draft);
}

}  // namespace lantern
