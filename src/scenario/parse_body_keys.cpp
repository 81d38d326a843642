// What a [[body]] and a [[pattern]] share: shape, matter, and who steers.
#include <cmath>

#include <fmt/format.h>

#include "geometry/angle.hpp"
#include "scenario/draft.hpp"

namespace lantern {
namespace {

// Keys that make a box one that turns.
bool turns(const TableReader& table) { return table.has("turned") || table.has("spin"); }

void check_oriented(const TableReader& table, Draft& draft) {
  if (table.is_good("oriented") && !table.has("half_size"))
    draft.problems.add(table.key_place("oriented"), "only a box is 'oriented' or not",
                       "give it half_size, or leave out 'oriented'");
  else if (table.is_good("oriented") && !table.truth("oriented") && turns(table))
    draft.problems.add(table.place("oriented"), "a box that keeps to the axes does not turn",
                       "leave out 'oriented', or 'turned' and 'spin'");
  else if (table.has("half_size") && table.is_good("may_turn") && table.truth("may_turn") &&
           !table.truth("oriented") && !turns(table))
    draft.problems.add(table.key_place("may_turn"), "a box that keeps to the axes does not turn",
                       "write oriented = true");
}

// Of unit length; nothing for zero, which is told. Divided first, so that no square overflows.
std::optional<Vec<3>> unit(const TableReader& table, const char* key, Draft& draft) {
  const auto v = table.point(key);
  if (!v) return std::nullopt;
  const double largest = std::max({std::abs(v->x), std::abs(v->y), std::abs(v->z)});
  if (largest > 0) {
    const Vec<3> scaled = *v / largest;
    return scaled / glm::length(scaled);
  }
  draft.problems.add(table.place(key), fmt::format("'{}' is zero: it points nowhere", key),
                     draft.dimension == 3 ? fmt::format("upwards is {} = [0, 1, 0]", key)
                                          : fmt::format("upwards is {} = [0, 1]", key));
  return std::nullopt;
}

Shape<3> read_shape(const TableReader& table, Draft& draft) {
  check_oriented(table, draft);
  if (table.has("half_size")) {
    const Vec<3> half = table.point("half_size").value_or(Vec<3>(1, 1, draft.dimension == 3));
    if (table.truth("oriented") || turns(table)) return OrientedBox<3>{half};
    return AxisBox<3>{half};
  }
  if (table.has("capsule")) {
    const Vec<2> sizes = table.two("capsule").value_or(Vec<2>(1.0));
    return Capsule{sizes.x, sizes.y};
  }
  if (table.has("ground"))
    return HalfSpace<3>{unit(table, "ground", draft).value_or(Vec<3>(0, 1, 0))};
  return Sphere{table.number("radius").value_or(1)};
}

Look default_look(const TableReader& table) {
  return table.has("half_size") || table.has("ground") ? Look::box : Look::disc;
}

BodyKind read_kind(const TableReader& table, Draft& draft) {
  const auto chosen = table.choice("kind");
  BodyKind kind = static_cast<BodyKind>(chosen.value_or(0));
  const bool is_static = kind == BodyKind::static_body;
  if (table.is_good("static") && table.is_good("kind") && table.truth("static") != is_static)
    draft.problems.add(table.place("kind"),
                       fmt::format("kind = \"{}\" contradicts static = {}",
                                   table.text("kind").value_or(""), table.truth("static")),
                       "give one of them");
  if (table.truth("static")) kind = BodyKind::static_body;
  if (!table.has("ground")) return kind;
  for (const char* key : {"kind", "static"})
    if (table.has(key) && kind != BodyKind::static_body)
      draft.problems.add(table.place(key), "the ground never moves",
                         fmt::format("leave out '{}'", key));
  return BodyKind::static_body;
}

void read_turn(const TableReader& table, BodySpec& body, Draft& draft) {
  body.angle = table.number("turned").value_or(0) * kDegree;
  body.spin = table.number("spin").value_or(0) * kDegree;
  body.axis = draft.dimension == 3 ? Vec<3>(0, 1, 0) : Vec<3>(0, 0, 1);
  if (table.is_good("turned") && table.has("ground"))
    draft.problems.add(table.key_place("turned"), "the ground is not turned",
                       "'ground' says where its face looks");
  if (!table.is_good("axis")) return;
  if (draft.dimension == 2)
    draft.problems.add(table.key_place("axis"), "a flat world has no other axis to turn about",
                       "leave it out");
  else if (const auto axis = unit(table, "axis", draft))
    body.axis = *axis;
}

void read_matter(const TableReader& table, BodySpec& body, Draft& draft) {
  body.density = table.number("density").value_or(1);
  body.mass = table.number("mass").value_or(0);
  if (table.is_good("density") && table.is_good("mass"))
    draft.problems.add(table.key_place("mass"), "a 'density' and a 'mass'",
                       "one of them is enough");
  body.material = {table.number("restitution").value_or(0), table.number("friction").value_or(0.5)};
  body.linear_drag = table.number("drag").value_or(0);
  body.angular_drag = table.number("angular_drag").value_or(0);
  body.may_turn = table.truth("may_turn");
  body.asleep = table.truth("asleep");
  if (body.asleep && !draft.scenario.world.may_sleep && draft.dimension != 0)
    draft.problems.add(table.key_place("asleep"), "in this world nothing sleeps",
                       "give [world] may_sleep = true");
  else if (body.asleep && body.kind != BodyKind::dynamic_body)
    draft.problems.add(table.key_place("asleep"), "only a dynamic body sleeps",
                       "leave out 'asleep'");
}

void read_methods(const TableReader& table, BodySpec& body, Draft& draft) {
  if (const auto choice = table.choice("integrator"))
    body.integrator = static_cast<Integrator>(*choice);
  if (const auto choice = table.choice("rotation"))
    body.rotation = static_cast<RotationMethod>(*choice);
  for (const char* key : {"integrator", "rotation"})
    if (table.is_good(key) && body.kind != BodyKind::dynamic_body)
      draft.problems.add(table.key_place(key), "no force moves or turns this body",
                         fmt::format("only a dynamic body has an '{}' of its own", key));
}

void read_follow(const TableReader& table, BodySpec& body, Draft& draft) {
  if (table.is_good("follow_axes") && !table.has("follow"))
    draft.problems.add(table.key_place("follow_axes"), "'follow_axes' without 'follow'",
                       "say whom, as follow = \"ball\"");
  if (!table.has("follow")) return;
  body.brain = Brain::follow;
  if (const auto axes = table.point("follow_axes")) {
    body.brain_axes = *axes;
    for (int i = 0; i < 3; ++i)
      if ((*axes)[i] != 0 && (*axes)[i] != 1) {
        draft.problems.add(
            table.place("follow_axes"),
            fmt::format("'follow_axes' is {} on an axis, it takes 0 or 1", (*axes)[i]),
            "1 where it follows");
        break;
      }
  }
  if (table.has("kind") && !table.choice("kind")) return;
  if (body.kind != BodyKind::kinematic_body)
    draft.problems.add(table.key_place("follow"), "only a kinematic body follows",
                       "give it kind = \"kinematic\"");
}

void read_brain(const TableReader& table, BodySpec& body, Draft& draft) {
  read_follow(table, body, draft);
  if (table.truth("wander")) {
    if (table.has("follow"))
      draft.problems.add(table.key_place("wander"), "a body either follows or wanders",
                         "leave out one of them");
    else if (body.kind == BodyKind::static_body)
      draft.problems.add(table.key_place("wander"), "a static body does not wander",
                         "leave out one of them");
    body.brain = Brain::wander;
  }
  if (body.brain == Brain::none) return;
  body.brain_speed = table.number("speed").value_or(0);
  if (!table.has("speed") || (table.number("speed") && body.brain_speed == 0))
    draft.problems.add(
        table.has("speed") ? table.place("speed")
                           : table.key_place(table.has("follow") ? "follow" : "wander"),
        "a body that follows or wanders needs a 'speed'", "in units a second, as speed = 4");
}

}  // namespace

BodySpec read_body_keys(const TableReader& table, Draft& draft) {
  BodySpec body;
  body.where = draft.position(table.where());
  body.name = table.text("name").value_or("");
  body.color = static_cast<int>(table.whole("color").value_or(1));
  body.shape = read_shape(table, draft);
  body.look = default_look(table);
  if (const auto look = table.choice("look")) body.look = static_cast<Look>(*look);
  body.kind = read_kind(table, draft);
  read_turn(table, body, draft);
  read_matter(table, body, draft);
  read_methods(table, body, draft);
  read_brain(table, body, draft);
  return body;
}

}  // namespace lantern
