// How a step is looked at: [display], `view`, `camera` and `orbit`.
#include <fmt/format.h>

#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"

namespace lantern::scenario {
namespace {

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

std::optional<ViewSpec> read_view(const TomlValue& value, Draft& draft) {
  const TableReader table = open(value, language_table("view"), draft, "'view'");
  ViewSpec view;
  table.fill(view);
  view.where = draft.position(value.where);
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

std::optional<CameraSpec> read_camera(const TomlValue& value, Draft& draft) {
  const TableReader table = open(value, language_table("camera"), draft, "'camera'");
  CameraSpec camera;
  table.fill(camera);
  camera.where = draft.position(value.where);
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
  if (dimension == 2)
    step.bad_key(key, fmt::format("a 3D world has no '{}'", key), kGiveCamera);
  else
    step.bad_key(key, fmt::format("a 2D world has no '{}'", key), kGiveView);
  return false;
}

}  // namespace

TableDoc display_table() {
  using namespace keys;
  using D = Display;
  return {
      "display",
      "[display] and display",
      "What frames show of what there is: for the whole scenario as `[display]`, for one step "
      "alone "
      "as `display = { names = \"none\", arrows = true }`; what a step does not name stays as "
      "`[display]` has it.",
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
  using namespace keys;
  return {
      "view",
      "view",
      "Which part of a 2D world is shown from this step on, with a locator of the whole; "
      "`view = {}` shows all again. The part is as wide as it says and as high as the world's "
      "proportions make it; it stays within the world.",
      {key(&ViewSpec::at, "at", "Its middle.", range(-kFar, kFar), or_else("all is shown")),
       key(&ViewSpec::width, "width", "How wide it is.", above(0, kFar), or_else("all is shown"))}};
}

TableDoc camera_table() {
  using namespace keys;
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
    for (const TomlValue* value : step.tables("view")) to.view = read_view(*value, draft);
  if (step.is_good("camera") && has_world(step, "camera", 3, draft))
    for (const TomlValue* value : step.tables("camera")) to.camera = read_camera(*value, draft);
  if (step.is_good("orbit")) has_world(step, "orbit", 3, draft);
}

}  // namespace lantern::scenario
