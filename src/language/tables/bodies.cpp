// [[body]], and what it shares with a [[pattern]].
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "geometry/elementary.hpp"
#include "geometry/vec.hpp"
#include "language/keys/key.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {
namespace {

// Keys that make a box one that turns.
bool turns(const TableReader& table) {
  return table.has("turned") || table.has("heading") || table.has("spin");
}

void check_oriented(const TableReader& table, const BodySpec& body) {
  if (table.is_good("oriented") && !table.has("half_size"))
    table.bad_key("oriented", "only a box is 'oriented' or not",
                  "give it half_size, or leave out 'oriented'");
  else if (table.is_good("oriented") && !table.truth("oriented") && turns(table))
    table.bad_value("oriented", "a box that keeps to the axes does not turn",
                    "leave out 'oriented', or 'turned', 'heading' and 'spin'");
  else if (table.has("half_size") && table.is_good("may_turn") && body.may_turn &&
           !table.truth("oriented") && !turns(table))
    table.bad_key("may_turn", "a box that keeps to the axes does not turn",
                  "write oriented = true");
}

// Nothing for zero. Divided first, so that no square overflows.
std::optional<Vec<3>> scaled_to_one(const Vec<3>& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0)) return std::nullopt;
  const Vec<3> scaled = v / largest;
  return scaled / glm::length(scaled);
}

// Of unit length; nothing for zero, which is told.
std::optional<Vec<3>> unit(const TableReader& table, const char* key, int dimension) {
  const auto v = table.get<Vec<3>>(key);
  if (!v) return std::nullopt;
  if (const auto direction = scaled_to_one(*v)) return direction;
  table.bad_value(key, fmt::format("'{}' is zero: it points nowhere", key),
                  fmt::format("upwards is {} = {}", key, dimension == 3 ? "[0, 1, 0]" : "[0, 1]"));
  return std::nullopt;
}

Shape<3> read_shape(const TableReader& table, int dimension) {
  if (table.has("half_size")) {
    const auto half = table.get<Vec<3>>("half_size").value_or(Vec<3>(1, 1, dimension == 3));
    if (table.truth("oriented") || turns(table)) return OrientedBox<3>{half};
    return AxisBox<3>{half};
  }
  if (table.has("capsule")) {
    const auto sizes = table.get<Vec<2>>("capsule").value_or(Vec<2>(1.0));
    return Capsule{sizes.x, sizes.y};
  }
  if (table.has("ground"))
    return HalfSpace<3>{unit(table, "ground", dimension).value_or(Vec<3>(0, 1, 0))};
  return Sphere{table.get<double>("radius").value_or(1)};
}

BodyKind read_kind(const TableReader& table, BodyKind kind) {
  const bool is_static = kind == BodyKind::static_body;
  if (table.is_good("static") && table.is_good("kind") && table.truth("static") != is_static)
    table.bad_value("kind",
                    fmt::format("kind = \"{}\" contradicts static = {}",
                                language::names(kind)[static_cast<std::size_t>(kind)], !is_static),
                    "give one of them");
  if (table.truth("static")) kind = BodyKind::static_body;
  if (!table.has("ground")) return kind;
  for (const char* key : {"kind", "static"})
    if (table.has(key) && kind != BodyKind::static_body)
      table.bad_value(key, "the ground never moves", fmt::format("leave out '{}'", key));
  return BodyKind::static_body;
}

// Of unit length; `otherwise` where no axis is given, or one of length 0, which is told.
Vec<3> axis_of(const TableReader& table, const char* key, const Turn& turn,
               const Vec<3>& otherwise) {
  if (!turn.axis) return otherwise;
  if (const auto axis = scaled_to_one(*turn.axis)) return *axis;
  table.bad_value(key, fmt::format("the axis of '{}' is zero: it points nowhere", key),
                  "upwards is axis = [0, 1, 0]");
  return otherwise;
}

// As far as the body's own y axis must turn to point where `heading` does, the shortest way.
void read_heading(const TableReader& table, BodySpec& body, int dimension) {
  const auto heading = unit(table, "heading", dimension);
  if (!heading) return;
  if (table.is_good("turned"))
    table.bad_key("heading", "a 'heading' and a 'turned'", "one of them is enough");
  if (dimension == 2) {
    body.angle = geometry::atan2(-heading->x, heading->y);
    return;
  }
  const Vec<3> up(0, 1, 0), across = glm::cross(up, *heading);
  const double sine = glm::length(across);
  body.axis = sine > 0 ? across / sine : Vec<3>(1, 0, 0);
  body.angle = geometry::atan2(sine, glm::dot(up, *heading));
}

// How it is turned, and how it turns: each about an axis of its own, or about `axis`.
void read_turns(const TableReader& table, BodySpec& body, int dimension) {
  body.axis = dimension == 3 ? Vec<3>(0, 1, 0) : Vec<3>(0, 0, 1);
  for (const char* key : {"turned", "heading"})
    if (table.is_good(key) && table.has("ground"))
      table.bad_key(key, "the ground is not turned", "'ground' says where its face looks");
  if (table.is_good("axis") && dimension == 2)
    table.bad_key("axis", "a 2D world has no other axis to turn about", "leave it out");
  else if (const auto axis = unit(table, "axis", dimension))
    body.axis = *axis;
  const Vec<3> shared = body.axis;
  const Turn turned = table.get<Turn>("turned").value_or(Turn());
  const Turn spin = table.get<Turn>("spin").value_or(Turn());
  body.angle = turned.amount * kDegree;
  body.spin = spin.amount * kDegree;
  body.axis = axis_of(table, "turned", turned, shared);
  read_heading(table, body, dimension);
  if (dimension == 3 && (spin.axis || body.axis != shared))
    body.spin_axis =
        spin.axis ? orientation_of(body).q * axis_of(table, "spin", spin, shared) : shared;
}

void check_matter(const TableReader& table, const BodySpec& body, const Draft& draft) {
  const bool is_dynamic = body.kind == BodyKind::dynamic_body;
  if (table.is_good("density") && table.is_good("mass"))
    table.bad_key("mass", "a 'density' and a 'mass'", "one of them is enough");
  if (body.asleep && !draft.scenario.world.may_sleep && draft.dimension != 0)
    table.bad_key("asleep", kNothingSleeps, kGiveSleep);
  else if (body.asleep && !is_dynamic)
    table.bad_key("asleep", "only a dynamic body sleeps", "leave out 'asleep'");
  const WorldSpec& world = draft.scenario.world;
  const Integrator by = body.integrator.value_or(world.integrator);
  if (body.integrator)
    check_knows(table, "integrator", by, world.contacts != ContactMethod::none, "contacts");
  check_knows(table, "drag", by, is_dynamic && body.linear_drag > 0, "drag");
  check_knows(table, "angular_drag", by, is_dynamic && body.angular_drag > 0, "drag");
  for (const char* key : {"integrator", "rotation"})
    if (table.is_good(key) && !is_dynamic)
      table.bad_key(key, "no force moves or turns this body",
                    fmt::format("only a dynamic body has an '{}' of its own", key));
}

void read_follow(const TableReader& table, BodySpec& body) {
  if (table.is_good("follow_axes") && !table.has("follow"))
    table.bad_key("follow_axes", "'follow_axes' without 'follow'",
                  "say whom, as follow = \"ball\"");
  if (!table.has("follow")) return;
  body.brain = Brain::follow;
  for (int i = 0; i < 3; ++i)
    if (const double on = body.brain_axes[i]; on != 0 && on != 1) {
      table.bad_value("follow_axes",
                      fmt::format("'follow_axes' is {} on an axis, it takes 0 or 1", on),
                      "1 where it follows");
      break;
    }
  if (table.has("kind") && !table.is_good("kind")) return;
  if (body.kind != BodyKind::kinematic_body)
    table.bad_key("follow", "only a kinematic body follows", "give it kind = \"kinematic\"");
}

void read_brain(const TableReader& table, BodySpec& body) {
  read_follow(table, body);
  if (table.truth("wander")) {
    if (table.has("follow"))
      table.bad_key("wander", "a body either follows or wanders", "leave out one of them");
    else if (body.kind == BodyKind::static_body)
      table.bad_key("wander", "a static body does not wander", "leave out one of them");
    body.brain = Brain::wander;
  }
  if (body.brain == Brain::none) return;
  const auto speed = table.get<double>("speed");
  body.brain_speed = speed.value_or(0);
  constexpr const char* kMessage = "a body that follows or wanders needs a 'speed'";
  constexpr const char* kHint = "in units a second, as speed = 4";
  if (!table.has("speed"))
    table.bad_key(table.has("follow") ? "follow" : "wander", kMessage, kHint);
  else if (speed && *speed == 0)
    table.bad_value("speed", kMessage, kHint);
}

bool has_no_size(const BodySpec& body) {
  return bounding_box(body.shape, Vec<3>(0.0)).size() == Vec<3>(0.0);
}

// The shape's key.
const char* size_key(const TableReader& table) {
  for (const char* key : {"half_size", "capsule", "ground"})
    if (table.has(key)) return key;
  return "radius";
}

constexpr NamePattern kPaintPattern = {"#", "0-9a-fA-F", 7, "# and three or six of 0–9 and a–f",
                                       "#0077aa"};
constexpr NamePattern kBodyPattern = {
    kNamePattern.first,
    kNamePattern.rest,
    kNamePattern.most,
    kNamePattern.words,
    {},
    "; what the picture shows may be of any letters: label = \"Käfer\""};

KeyDoc color_key() {
  return key(
      &BodySpec::color, "color",
      "1 red, 2 pink, 3 yellow, 4 blue, 5 green, 6 sky, 7 orange, 8 violet, in the light theme.",
      range(1, 8), one_of({"red", "pink", "yellow", "blue", "green", "sky", "orange", "violet"}));
}

}  // namespace

void read_body(const TomlValue& value, Draft& draft, bool declared) {
  const TableReader table = open(completed(value, draft), language_table("body"), draft);
  BodySpec body = read_body_keys(table, draft);
  check_motion(table, "velocity", body, body.velocity != Vec<3>(0.0));
  if (table.is_good("speed") && body.brain == Brain::none)
    table.bad_key("speed", "'speed' is of a body that follows or wanders",
                  "say where it goes: velocity");
  draft.has_room_for(draft.scenario.bodies.size() + 1, kMostBodies, "bodies", value.where);
  if (!body.name.empty())
    draft.bodies.add(body.name, {draft.scenario.bodies.size(), 1, table.place("name")}, declared,
                     draft.problems);
  note_follower(table, 1, draft);
  draft.scenario.bodies.push_back(std::move(body));
}

std::vector<KeyDoc> body_keys(std::vector<KeyDoc> first) {
  using B = BodySpec;
  const std::vector<KeyDoc> shared = {
      key(&B::look, "look", "The character that is drawn.",
          or_else("`disc` with a radius or a capsule, `box` otherwise")),
      key(KeyType::text, "outline",
          "Instead of a look: an SVG path of M, L, H, V, C, Q and Z, which fills its box: `\"M0 0 "
          "L4 0 L2 3 Z\"`. As in SVG, y points down. Each closed part is filled by itself.",
          range(1, 8000)),
      key(&B::paint, "paint",
          "A colour of its own instead, as `\"#0077aa\"`; print themes take its grey. Eight "
          "colours in all.",
          like(kPaintPattern), or_else("the `color`")),
      key(KeyType::number, "radius", "Of a disc, or a ball in a 3D world.", range(0, kFar)),
      key(KeyType::point, "half_size", "Of a box.", range(0, kFar)),
      key(KeyType::two_numbers, "capsule",
          "All that lies within `radius` of a segment along the body's own y axis, which reaches "
          "`half_length` to either side.",
          range(0, kFar), written("[radius, half_length]")),
      key(KeyType::truth, "oriented",
          "A box that turns. One that is not oriented keeps to the axes.",
          or_else("whether `turned`, `heading` or `spin` is given")),
      key(KeyType::turn, "turned",
          "How far it is turned, counter-clockwise or about `axis`; in a 3D world also as `{ angle "
          "= 20, axis = [1, 0, 0] }`.",
          range(-kMostTurn, kMostTurn), in("°"), by_default("0"), holds("angle")),
      key(KeyType::point, "heading",
          "Instead of `turned`: where its own y axis points, a capsule's or a top's, as [1, 2]; "
          "the shortest way there.",
          range(-kFar, kFar), or_else("upwards")),
      key(KeyType::turn, "spin",
          "How fast it turns, counter-clockwise or about `axis`; in a 3D world also as `{ speed = "
          "720, axis = [0, 1, 0] }`, whose axis is the body's own: it has been turned with it.",
          range(-kMostTurn, kMostTurn), in("°/s"), by_default("0"), holds("speed")),
      key(KeyType::point, "axis",
          "In a 3D world: what `turned` and `spin` go about that have no axis of their own; not "
          "zero.",
          range(-kFar, kFar), or_else("[0, 1, 0]")),
      key(&B::kind, "kind",
          "`dynamic` is moved by forces and contacts, `kinematic` keeps its velocity whatever it "
          "meets, `static` never moves."),
      key(KeyType::truth, "static", "The same as kind = \"static\".", by_default("false")),
      key(&B::density, "density", "Mass of a unit of area, or of volume.", above(0, kHeavy),
          in("kg")),
      key(&B::mass, "mass", "Instead of the density.", above(0, kHeavy), in("kg"),
          or_else("from shape and density")),
      key(&Material::restitution, "restitution",
          "How much of its speed a bounce keeps; of two bodies, the larger counts. Joints bear "
          "their part of the blow. Pairs that touch at once are struck one after another, "
          "but those that joints hold, together; a blow that takes more than 64 rounds ends "
          "without restitution.",
          range(0, 1), by_hand(0, 1)),
      key(&Material::friction, "friction",
          "Of two bodies, the square root of their product counts.", range(0, 1000), by_hand(0, 2)),
      key(&B::linear_drag, "drag",
          "Force against its motion, for each unit a second. `velocity_verlet`, "
          "`implicit_midpoint` and `implicit_euler` bear any and never turn a velocity round. The "
          "other Eulers do so where a step's drag is more than the mass, and blow up beyond twice "
          "that, `runge_kutta_4` beyond 2.785 times.",
          range(0, kHeavy), in("N s")),
      key(&B::angular_drag, "angular_drag", "Torque against its turning, for each radian a second.",
          range(0, kHeavy), in("N s")),
      key(&B::may_turn, "may_turn", "Contacts and forces may turn it."),
      key(&B::has_volume, "volume", "Without one no structure holds it, and nothing meets it."),
      key(&B::address, "address",
          "Where it lies in the memory of the lecture's program, for a structure `as_printed`.",
          range(1, 4e9), or_else("64 behind the body before")),
      key(&B::integrator, "integrator", "How forces move this body.", or_else("as the world's")),
      key(&B::rotation, "rotation", "How it rotates when nothing holds it.",
          or_else("as the world's")),
      key(&B::asleep, "asleep", "When it enters; the world must have `may_sleep`."),
      key(KeyType::text, "follow",
          "A kinematic body goes to where the body of this name is, at most at `speed`.",
          range(1, 64), or_else("none")),
      key(&B::brain_axes, "follow_axes", "1 on axes on which it follows, 0 on the others.",
          range(0, 1), or_else("all")),
      key(KeyType::truth, "wander",
          "It keeps its `speed` and turns at random after it touches something.",
          by_default("false")),
  };
  first.insert(
      first.begin(),
      {key(&B::name, "name", "Unique over bodies and patterns.", must(), like(kBodyPattern)),
       key(KeyType::text, "like", "A prototype, whose keys it has but for its own.", range(1, 64),
           or_else("none"))});
  first.insert(first.end(), shared.begin(), shared.end());
  return first;
}

TableDoc body_table() {
  using B = BodySpec;
  TableDoc table = {
      "body", "[[body]]",
      "A body. It enters the world when a step inserts it. A body of no size must stand still."};
  table.keys = body_keys({
      key(&B::label, "label", "What pictures call it, in any letters.", range(1, 40),
          or_else("the name")),
      key(&B::position, "position", "Of its centre, or a point of the ground's face.", must(),
          range(-kFar, kFar)),
      key(&B::velocity, "velocity", "How it moves while time passes.", range(-kFar, kFar),
          in("units/s"), or_else("at rest")),
      key(KeyType::point, "ground",
          "Everything behind a face through `position` is solid: where the face looks, as [0, 1]. "
          "It never moves.",
          range(-kFar, kFar)),
      key(KeyType::number, "speed", "Of a body that follows or wanders.", above(0, kFar),
          in("units/s"), or_else("none")),
      color_key(),
  });
  table.groups = {{{"radius"}, {"half_size"}, {"capsule"}, {"ground"}}};
  return table;
}

BodySpec read_body_keys(const TableReader& table, Draft& draft) {
  BodySpec body;
  body.look = table.has("half_size") || table.has("ground") ? Look::box : Look::disc;
  table.fill(body);
  table.fill(body.material);
  body.where = draft.position(table.where());
  body.outline = read_outline(table);
  if (const std::size_t n = body.paint.size(); n != 0 && n != 4 && n != 7)
    table.bad_value("paint",
                    fmt::format("'paint' is {}, not # and three or six digits", body.paint),
                    fmt::format("as \"{}\"", kPaintPattern.example));
  for (const auto& [key, instead] : {std::pair("look", "outline"), std::pair("color", "paint")})
    if (table.has(key) && table.has(instead))
      table.bad_key(key, fmt::format("'{}' stands in place of '{}'", instead, key),
                    fmt::format("leave out either {} or {}", key, instead));
  check_oriented(table, body);
  body.shape = read_shape(table, draft.dimension);
  body.kind = read_kind(table, body.kind);
  read_turns(table, body, draft.dimension);
  check_matter(table, body, draft);
  read_brain(table, body);
  check_motion(table, "spin", body, body.spin != 0);
  return body;
}

void check_motion(const TableReader& table, const char* key, const BodySpec& body, bool moves) {
  if (!moves) return;
  if (body.kind == BodyKind::static_body)
    table.bad_value(key, fmt::format("a static body has no {}", key),
                    table.has("ground") ? fmt::format("leave out {}", key)
                                        : fmt::format("leave out either static or {}", key));
  else if (has_no_size(body))
    table.bad_value(size_key(table),
                    fmt::format("'{}' is zero: a body that moves needs a size", size_key(table)),
                    fmt::format("or leave out {}", key));
}

void read_bodies(const TableReader& file, Draft& draft) {
  const auto bodies = file.tables("body");
  const auto patterns = file.tables("pattern");
  if (!file.has("world") && (!bodies.empty() || !patterns.empty()))
    draft.problems.add((bodies.empty() ? patterns : bodies)[0]->where, "bodies need a [world]",
                       "add [world] with size = [64, 64]");
  read_prototypes(file, draft);
  for (const TomlValue* value : bodies) read_body(*value, draft);
  read_map(file, draft);
  for (const TomlValue* value : patterns) read_pattern(*value, draft);
  find_the_followed(draft);
  mix_paints(draft);
}

}  // namespace lantern::language
