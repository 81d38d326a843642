// Tables of bodies, one by one and many at once, and of what ties them together.
#include "scenario/language_key.hpp"
#include "scenario/language_parts.hpp"

namespace lantern {
namespace {

using enum KeyType;

constexpr double kHeavy = 1e12;  // masses, densities, stiffness and drag at most

const std::vector<std::string_view> kLooks = {"ghost", "player", "ball", "bat", "disc", "box"};

KeyDoc name_key() {
  return Key(text, "name", "Unique over bodies and patterns.").must().like(kNamePattern);
}

// What [[body]] and [[pattern]] share.
std::vector<KeyDoc> body_keys(std::vector<KeyDoc> first, std::string_view color_doc,
                              std::string_view color_fallback, double least_color) {
  const std::vector<KeyDoc> shared = {
      Key(choice, "look", "The character that is drawn.")
          .one_of(kLooks)
          .or_else("`disc` with a radius or a capsule, `box` otherwise"),
      Key(whole, "color", color_doc).range(least_color, 8).by_default(color_fallback),
      Key(number, "radius", "Of a disc, or a ball in a solid world.").range(0, kFar),
      Key(point, "half_size", "Of a box.").range(0, kFar),
      Key(two_numbers, "capsule",
          "All that lies within `radius` of a segment along the body's own y axis, which reaches "
          "`half_length` to either side.")
          .range(0, kFar)
          .written("[radius, half_length]"),
      Key(truth, "oriented", "A box that turns. One that is not oriented keeps to the axes.")
          .or_else("whether `turned` or `spin` is given"),
      Key(number, "turned", "How far it is turned, counter-clockwise or about `axis`.")
          .range(-kMostTurn, kMostTurn)
          .in("°")
          .by_default("0"),
      Key(number, "spin", "How fast it turns, the same way.")
          .range(-kMostTurn, kMostTurn)
          .in("°/s")
          .by_default("0"),
      Key(point, "axis", "Of a solid world: what `turned` and `spin` go about; not zero.")
          .range(-kFar, kFar)
          .or_else("[0, 1, 0]"),
      Key(choice, "kind",
          "`dynamic` is moved by forces and contacts, `kinematic` keeps its velocity whatever it "
          "meets, `static` never moves.")
          .one_of({"dynamic", "kinematic", "static"})
          .by_default("\"dynamic\""),
      Key(truth, "static", "The same as kind = \"static\".").by_default("false"),
      Key(number, "density", "Mass of a unit of area, or of volume.")
          .above(0, kHeavy)
          .in("kg")
          .by_default("1"),
      Key(number, "mass", "Instead of the density.")
          .above(0, kHeavy)
          .in("kg")
          .or_else("from shape and density"),
      Key(number, "restitution", "How much of its speed a bounce keeps; of two bodies the larger.")
          .range(0, 1)
          .by_default("0"),
      Key(number, "friction", "Of two bodies, the square root of their product counts.")
          .range(0, 1000)
          .by_default("0.5"),
      Key(number, "drag", "Force against its motion, for each unit a second.")
          .range(0, kHeavy)
          .in("N s")
          .by_default("0"),
      Key(number, "angular_drag", "Torque against its turning, for each radian a second.")
          .range(0, kHeavy)
          .in("N s")
          .by_default("0"),
      Key(truth, "may_turn", "Contacts and forces may turn it.").by_default("true"),
      Key(choice, "integrator", "How forces move this body.")
          .one_of(integrator_names())
          .or_else("as the world's"),
      Key(choice, "rotation", "How it turns when nothing holds it.")
          .one_of(rotation_names())
          .or_else("as the world's"),
      Key(truth, "asleep", "When it enters; the world must have `may_sleep`.").by_default("false"),
      Key(text, "follow",
          "A kinematic body goes to where the body of this name is, at most at `speed`.")
          .range(1, 64)
          .or_else("none"),
      Key(point, "follow_axes", "1 on axes on which it follows, 0 on the others.")
          .range(0, 1)
          .or_else("all"),
      Key(truth, "wander", "It keeps its `speed` and turns at random after it touches something.")
          .by_default("false"),
  };
  first.insert(first.end(), shared.begin(), shared.end());
  return first;
}

// What springs and joints share.
std::vector<KeyDoc> link_keys(std::vector<KeyDoc> first) {
  const std::vector<KeyDoc> shared = {
      Key(text, "a", "A body.").range(1, 64),
      Key(text, "b", "The other body.").range(1, 64).or_else("none: give `to`"),
      Key(point, "to", "A point of the world, instead of `b`.")
          .range(-kFar, kFar)
          .or_else("none: give `b`"),
      Key(text, "along", "A pattern, instead of `a`: each member is tied to the next.")
          .range(1, 64),
      Key(point, "at_a", "Where it is fixed, from the centre of `a`, in the body's own axes.")
          .range(-kFar, kFar)
          .or_else("the centre"),
      Key(point, "at_b", "The same for `b`.").range(-kFar, kFar).or_else("the centre"),
  };
  first.insert(first.begin(), shared.begin(), shared.end());
  return first;
}

}  // namespace

TableDoc body_table() {
  return {"body",
          "[[body]]",
          "A body. It enters the world when a step inserts it. A body of no size must stand still.",
          body_keys(
              {
                  name_key(),
                  Key(point, "position", "Of its centre, or a point of the ground's face.")
                      .must()
                      .range(-kFar, kFar),
                  Key(point, "velocity", "Where it goes while time passes.")
                      .range(-kFar, kFar)
                      .in("units/s")
                      .or_else("at rest"),
                  Key(point, "ground",
                      "Everything behind a face through `position` is solid: where the face looks, "
                      "as [0, 1]. It never moves.")
                      .range(-kFar, kFar),
                  Key(number, "speed", "Of a body that follows or wanders.")
                      .above(0, kFar)
                      .in("units/s")
                      .or_else("none"),
              },
              "1 red, 2 pink, 3 yellow, 4 blue, 5 green, 6 sky, 7 orange, 8 violet, in the light "
              "theme.",
              "1", 1),
          {.groups = {{"radius"}, {"half_size"}, {"capsule"}, {"ground"}}}};
}

TableDoc pattern_table() {
  return {"pattern",
          "[[pattern]]",
          "Many bodies at once. Those of pattern `dot` are called `dot1`, `dot2`, …",
          body_keys(
              {
                  name_key(),
                  Key(whole, "count", "How many; 20000 bodies in all are allowed.")
                      .must()
                      .range(1, kMostBodies)
                      .in("bodies"),
                  Key(choice, "arrange",
                      "At random places; in rows from the lowest corner; on a line from `min` to "
                      "`max`; or as a stack, each on the one before, the lowest at `min`.")
                      .one_of({"random", "grid", "line", "stack"})
                      .by_default("\"random\""),
                  Key(point, "min", "Lowest corner of where centres may be.")
                      .range(-kFar, kFar)
                      .or_else("so that all lie in the world"),
                  Key(point, "max", "Highest corner of where centres may be.")
                      .range(-kFar, kFar)
                      .or_else("so that all lie in the world"),
                  Key(number, "speed",
                      "Each in a random direction. Of bodies that follow, the most they go at.")
                      .range(0, kFar)
                      .in("units/s")
                      .by_default("0"),
                  Key(whole, "seed", "Of this pattern alone.")
                      .range(0, kMostWhole)
                      .or_else("from the scenario's seed and the name"),
              },
              "As a body's; 0 cycles through 1 to 8.", "0", 0),
          {.groups = {{"radius"}, {"half_size"}, {"capsule"}}}};
}

TableDoc spring_table() {
  return {"spring",
          "[[spring]]",
          "A damped spring between two bodies, or a body and a point of the world. It is there "
          "while its bodies are.",
          link_keys({
              Key(number, "rest_length", "Where it neither pulls nor pushes.")
                  .range(0, kFar)
                  .or_else("as long as it is at first"),
              Key(number, "stiffness", "Force for each unit that it is longer.")
                  .must()
                  .above(0, kHeavy)
                  .in("N/unit"),
              Key(number, "damping", "Force against each unit a second that it grows.")
                  .range(0, kHeavy)
                  .in("N s/unit")
                  .by_default("0"),
          }),
          {.groups = {{"a"}, {"along"}}}};
}

TableDoc joint_table() {
  return {"joint",
          "[[joint]]",
          "Keeps two points at one distance, or pins them together. It is there while its bodies "
          "are.",
          link_keys({
              Key(choice, "kind", "A rod of fixed length, or a hinge.")
                  .must()
                  .one_of({"distance", "pin"}),
              Key(number, "length", "Of kind `distance`.")
                  .above(0, kFar)
                  .or_else("as long as it is at first"),
          }),
          {.groups = {{"a"}, {"along"}}}};
}

}  // namespace lantern
