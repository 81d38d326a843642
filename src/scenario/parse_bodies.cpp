// Bodies, one by one and by patterns.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/random.hpp"
#include "scenario/draft.hpp"

namespace lantern {
namespace {

// What [[body]] and [[pattern]] share.
BodySpec read_common(const TableReader& table, Draft& draft) {
  BodySpec body;
  body.where = draft.position(table.where());
  body.name = table.text("name").value_or("");
  body.color = static_cast<int>(table.whole("color").value_or(1));
  body.is_static = table.truth("static");
  body.shape = Sphere{table.number("radius").value_or(1)};
  if (const auto half_size = table.point("half_size")) body.shape = AxisBox<2>{*half_size};
  body.look = table.has("half_size") ? Look::box : Look::disc;
  if (const auto look = table.choice("look")) body.look = static_cast<Look>(*look);
  return body;
}

bool has_no_size(const BodySpec& body) {
  return bounding_box(body.shape, Vec<2>(0.0)).size() == Vec<2>(0.0);
}

// `speed_key` is what makes it move.
void check_motion(const BodySpec& body, bool moves, const TableReader& table, const char* speed_key,
                  Draft& draft) {
  const char* size_key = table.has("half_size") ? "half_size" : "radius";
  if (moves && body.is_static)
    draft.problems.add(table.place(speed_key), fmt::format("a static body has no {}", speed_key),
                       fmt::format("leave out either static or {}", speed_key));
  else if (moves && has_no_size(body))
    draft.problems.add(table.place(size_key),
                       fmt::format("'{}' is zero: a body that moves needs a size", size_key),
                       fmt::format("or leave out {}", speed_key));
}

// Are there few enough? Says so once, where they become too many.
bool has_room_for(std::size_t count, Place where, Draft& draft) {
  const std::size_t all = draft.scenario.bodies.size() + count;
  if (all <= kMostBodies) return true;
  draft.problems.add(where, fmt::format("{} bodies in all, the limit is {}", all, kMostBodies));
  return false;
}

void read_body(const TomlValue& value, Draft& draft) {
  const TableReader table(std::get<TomlTable>(value.data), value.where, language_table("body"),
                          draft.problems);
  BodySpec body = read_common(table, draft);
  body.position = table.point("position").value_or(Vec<2>(0.0));
  body.velocity = table.point("velocity").value_or(Vec<2>(0.0));
  check_motion(body, body.velocity != Vec<2>(0.0), table, "velocity", draft);
  if (!has_room_for(1, value.where, draft)) return;
  if (!body.name.empty())
    draft.bodies.add(body.name, {draft.scenario.bodies.size(), 1, table.place("name")}, true,
                     draft.problems);
  draft.scenario.bodies.push_back(std::move(body));
}

// Where a pattern's centres may be: as given, or so that its bodies lie in the world.
Box<2> read_region(const TableReader& table, const BodySpec& body, Draft& draft) {
  const Box<2>& bounds = draft.scenario.bounds;
  const Vec<2> half = bounding_box(body.shape, Vec<2>(0.0)).hi;
  Box<2> region;
  for (int i = 0; i < 2; ++i) {
    const double middle = bounds.center()[i];
    region.lo[i] = std::min(bounds.lo[i] + half[i], middle);
    region.hi[i] = std::max(bounds.hi[i] - half[i], middle);
  }
  region.lo = table.point("min").value_or(region.lo);
  region.hi = table.point("max").value_or(region.hi);
  if (is_valid(region)) return region;
  draft.problems.add(table.place(table.has("max") ? "max" : "min"),
                     fmt::format("no centre lies between [{}, {}] and [{}, {}]", region.lo.x,
                                 region.lo.y, region.hi.x, region.hi.y),
                     "'max' lies to the upper right of 'min'");
  return bounds;
}

// The middle of the `index`-th of `count` cells, in rows from the lower left, as square as may be.
Vec<2> grid_place(const Box<2>& region, std::size_t index, std::size_t count) {
  const Vec<2> size = region.size();
  const auto n = static_cast<double>(count);
  const double wish = size.y > 0 ? std::ceil(std::sqrt(n * size.x / size.y)) : n;
  const double columns = std::clamp(wish, 1.0, n);
  const double rows = std::ceil(n / columns);
  const double row = std::floor(static_cast<double>(index) / columns);
  const double column = static_cast<double>(index) - row * columns;
  return region.lo + size * Vec<2>((column + 0.5) / columns, (row + 0.5) / rows);
}

// A direction from points of the unit disc, but not of its middle, where they would be coarse. No
// sine, so it is the same on every machine.
Vec<2> random_direction(Random& random) {
  for (;;) {
    const double x = random.between(-1, 1);
    const double y = random.between(-1, 1);
    const double square = x * x + y * y;
    if (square < 0.01 || square > 1) continue;
    return Vec<2>(x, y) / std::sqrt(square);
  }
}

void unroll(const BodySpec& like, std::size_t count, const TableReader& table, Draft& draft) {
  const Box<2> region = read_region(table, like, draft);
  const bool grid = table.text("arrange") == "grid";
  const double speed = table.number("speed").value_or(0);
  const std::int64_t color = table.whole("color").value_or(0);
  Random random(derived_seed(table, like.name, draft));
  for (std::size_t i = 0; i < count; ++i) {
    BodySpec body = like;
    body.name = fmt::format("{}{}", like.name, i + 1);
    body.color = cycled_color(color, i);
    body.position = grid_place(region, i, count);
    if (!grid) {
      body.position.x = random.between(region.lo.x, region.hi.x);
      body.position.y = random.between(region.lo.y, region.hi.y);
    }
    if (speed > 0) body.velocity = random_direction(random) * speed;
    const NamedRange range{draft.scenario.bodies.size(), 1, table.place("name")};
    if (!draft.bodies.add(body.name, range, false, draft.problems)) return;
    draft.scenario.bodies.push_back(std::move(body));
  }
}

void read_pattern(const TomlValue& value, Draft& draft) {
  const TableReader table(std::get<TomlTable>(value.data), value.where, language_table("pattern"),
                          draft.problems);
  const BodySpec like = read_common(table, draft);
  check_motion(like, table.number("speed").value_or(0) > 0, table, "speed", draft);
  const auto count = static_cast<std::size_t>(table.whole("count").value_or(1));
  if (!has_room_for(count, table.place("count"), draft) || like.name.empty()) return;
  const NamedRange range{draft.scenario.bodies.size(), count, table.place("name")};
  if (draft.bodies.add(like.name, range, true, draft.problems)) unroll(like, count, table, draft);
}

}  // namespace

void read_bodies(const TableReader& file, Draft& draft) {
  const auto bodies = file.tables("body");
  const auto patterns = file.tables("pattern");
  if (!file.has("world") && (!bodies.empty() || !patterns.empty()))
    draft.problems.add((bodies.empty() ? patterns : bodies)[0]->where, "bodies need a [world]",
                       "add [world] with size = [64, 64]");
  for (const TomlValue* value : bodies) read_body(*value, draft);
  for (const TomlValue* value : patterns) read_pattern(*value, draft);
}

}  // namespace lantern
