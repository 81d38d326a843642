// [[pattern]]: many bodies, where they stand and which way they go.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/random.hpp"
#include "geometry/random_vec.hpp"
#include "scenario/draft.hpp"
#include "scenario/key.hpp"
#include "scenario/placement.hpp"

namespace lantern::scenario {
namespace {

struct PatternSpec {
  std::size_t count = 1;
  Arrange arrange = Arrange::random;
  double gap = 0;
  double speed = 0;
  int color = 0;  // 0: each the next
};

// Where a pattern's centres may be: as given, or so that its bodies lie in the world. A stack
// stands in the middle, on the world's floor.
Box<3> read_region(const TableReader& table, const BodySpec& body, bool stack, const Draft& draft) {
  const Box<3>& bounds = draft.scenario.world.bounds;
  const Vec<3> half = bounding_box(body.shape, Vec<3>(0.0), orientation_of(body)).hi;
  Box<3> region;
  for (int i = 0; i < 3; ++i) {
    const double middle = bounds.center()[i];
    const bool in_the_middle = stack && i != 1;
    region.lo[i] = in_the_middle ? middle : std::min(bounds.lo[i] + half[i], middle);
    region.hi[i] = in_the_middle ? middle : std::max(bounds.hi[i] - half[i], middle);
  }
  region.lo = table.get<Vec<3>>("min").value_or(region.lo);
  if (stack) {
    if (table.is_good("max"))
      table.bad_key("max", "a stack has no 'max'",
                    "it is as high as its bodies; 'min' is the place of the lowest");
    return {region.lo, region.lo};
  }
  region.hi = table.get<Vec<3>>("max").value_or(region.hi);
  if (is_valid(region)) return region;
  const auto text = [&](const Vec<3>& v) {
    return draft.dimension == 3 ? fmt::format("[{}, {}, {}]", v.x, v.y, v.z)
                                : fmt::format("[{}, {}]", v.x, v.y);
  };
  table.bad_value(table.has("max") ? "max" : "min",
                  fmt::format("no centre lies between {} and {}", text(region.lo), text(region.hi)),
                  "'max' lies to the upper right of 'min'");
  return bounds;
}

void tell_no_room(const TableReader& table, std::size_t placed, std::size_t count) {
  table.bad_value("count",
                  fmt::format("{} of {} bodies found a place apart from each other and from what "
                              "never moves",
                              placed, count),
                  "give them more room from 'min' to 'max', make them smaller, or take "
                  "arrange = \"grid\"");
}

// The bodies of a pattern, in their order, each like `like` but for place, velocity and colour.
void unroll(const BodySpec& like, const PatternSpec& pattern, const TableReader& table,
            Draft& draft) {
  const int dimension = draft.scenario.world.dimension;
  Random random(derived_seed(table, like.name, draft));
  const Box<3> region = read_region(table, like, pattern.arrange == Arrange::stack, draft);
  Placement places({pattern.arrange, region, pattern.count, pattern.gap, dimension}, like,
                   draft.scenario.bodies);
  const double speed = like.brain == Brain::follow ? 0 : pattern.speed;
  bool has_room = true;
  for (std::size_t i = 0; i < pattern.count; ++i) {
    const auto place = has_room ? places.next(random) : std::nullopt;
    if (!place && std::exchange(has_room, false)) tell_no_room(table, i, pattern.count);
    BodySpec body = like;
    body.name = fmt::format("{}{}", like.name, i + 1);
    body.color = cycled_color(pattern.color, i);
    body.position = place.value_or(region.lo);
    if (speed > 0)
      body.velocity = speed * (dimension == 2 ? solid(random_direction<2>(random))
                                              : random_direction<3>(random));
    const NamedRange range{draft.scenario.bodies.size(), 1, table.place("name")};
    draft.bodies.add(body.name, range, false, draft.problems);
    draft.scenario.bodies.push_back(std::move(body));
  }
}

}  // namespace

TableDoc pattern_table() {
  using namespace keys;
  using P = PatternSpec;
  TableDoc table = {"pattern", "[[pattern]]",
                    "Many bodies at once. Those of pattern `dot` are called `dot1`, `dot2`, …"};
  table.keys = body_keys({
      key(&P::count, "count", "How many; 20000 bodies in all are allowed.", must(),
          range(1, kMostBodies), in("bodies")),
      key(&P::arrange, "arrange",
          "At random places; in rows from the lowest corner; on a line from `min` to `max`; as a "
          "stack, each on the one before, the lowest at `min`; in rows of which every other one "
          "is shifted by half a place; or at random places `apart` from each other and from what "
          "never moves."),
      key(&P::gap, "gap", "Least room between bodies that stand `apart`.", range(0, kFar)),
      key(KeyType::point, "min", "Lowest corner of where centres may be.", range(-kFar, kFar),
          or_else("so that all lie in the world")),
      key(KeyType::point, "max", "Highest corner of where centres may be.", range(-kFar, kFar),
          or_else("so that all lie in the world")),
      key(&BodySpec::velocity, "velocity", "All move so when they enter.", range(-kFar, kFar),
          in("units/s"), or_else("at rest")),
      key(&P::speed, "speed",
          "Each in a random direction. For bodies that follow, their top speed.", range(0, kFar),
          in("units/s")),
      key(KeyType::whole, "seed", "Of this pattern alone.", range(0, kMostWhole),
          or_else("from the scenario's seed and the name")),
      key(&P::color, "color", "As a body's; 0 cycles through 1 to 8.", range(0, 8)),
  });
  table.groups = {{{"radius"}, {"half_size"}, {"capsule"}}};
  return table;
}

void read_pattern(const TomlValue& value, Draft& draft) {
  const TableReader table = open(completed(value, draft), language_table("pattern"), draft);
  const BodySpec like = read_body_keys(table, draft);
  PatternSpec pattern;
  table.fill(pattern);
  check_motion(table, "speed", like, pattern.speed > 0);
  check_motion(table, "velocity", like, like.velocity != Vec<3>(0.0));
  if (table.is_good("velocity") && table.is_good("speed") && like.brain == Brain::none)
    table.bad_key("speed", "a 'velocity' and a 'speed'", "one of them is enough");
  if (table.is_good("gap") && pattern.arrange != Arrange::apart)
    table.bad_key("gap", "a 'gap' is of bodies that stand apart", "give arrange = \"apart\"");
  const std::size_t before = draft.scenario.bodies.size();
  // One that goes over the limit is cut, so that its name is known to those who use it.
  if (!draft.has_room_for(before + pattern.count, kMostBodies, "bodies", table.place("count")))
    pattern.count = before < kMostBodies ? kMostBodies - before : 1;
  if (like.name.empty()) return;
  const NamedRange range{before, pattern.count, table.place("name")};
  if (!draft.bodies.add(like.name, range, true, draft.problems)) return;
  note_follower(table, pattern.count, draft);
  unroll(like, pattern, table, draft);
}

}  // namespace lantern::scenario
