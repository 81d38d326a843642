// [[pattern]]: many bodies, where they stand and which way they go.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/random.hpp"
#include "geometry/random_vec.hpp"
#include "scenario/draft.hpp"
#include "scenario/key.hpp"

namespace lantern::scenario {
namespace {

enum class Arrange { random, grid, line, stack };
EnumNames names(Arrange) { return {"random", "grid", "line", "stack"}; }

struct PatternSpec {
  std::size_t count = 1;
  Arrange arrange = Arrange::random;
  double speed = 0;
  int color = 0;  // 0: each the next
};

// As the scenario turns it.
Rotation<3> orientation_of(const BodySpec& body) {
  return turned(Rotation<3>{}, body.axis * body.angle);
}

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

// Columns, rows and layers of cells for `count` bodies, as cubic as may be: the longest side of a
// cell is cut until there are enough.
std::array<std::size_t, 3> grid_cells(const Vec<3>& size, std::size_t count) {
  std::array<std::size_t, 3> cells{1, 1, 1};
  while (cells[0] * cells[1] * cells[2] < count) {
    int longest = 0;
    const auto side = [&](int i) { return size[i] / static_cast<double>(cells[std::size_t(i)]); };
    for (int i = 1; i < 3; ++i)
      if (side(i) > side(longest)) longest = i;
    ++cells[static_cast<std::size_t>(longest)];
  }
  return cells;
}

// The middle of the `index`-th cell, in rows from the lowest corner.
Vec<3> grid_place(const Box<3>& region, std::size_t index,
                  const std::array<std::size_t, 3>& cells) {
  Vec<3> place = region.lo;
  for (int i = 0; i < 3; ++i) {
    const std::size_t n = cells[static_cast<std::size_t>(i)];
    place[i] +=
        region.size()[i] * ((static_cast<double>(index % n) + 0.5) / static_cast<double>(n));
    index /= n;
  }
  return place;
}

// The places of one pattern, in order.
class Places {
 public:
  Places(const BodySpec& like, const PatternSpec& pattern, const TableReader& table,
         const Draft& draft)
      : arrange_(pattern.arrange),
        region_(read_region(table, like, arrange_ == Arrange::stack, draft)),
        count_(pattern.count),
        dimension_(draft.scenario.world.dimension) {
    if (arrange_ == Arrange::grid) cells_ = grid_cells(region_.size(), count_);
    height_ = bounding_box(like.shape, Vec<3>(0.0), orientation_of(like)).size().y;
  }

  Vec<3> at(std::size_t index, Random& random) const {
    const auto i = static_cast<double>(index);
    if (arrange_ == Arrange::grid) return grid_place(region_, index, cells_);
    if (arrange_ == Arrange::stack) return region_.lo + Vec<3>(0, i * height_, 0);
    if (arrange_ == Arrange::line) {
      if (index + 1 == count_ && index > 0) return region_.hi;
      return region_.lo + region_.size() * (count_ > 1 ? i / static_cast<double>(count_ - 1) : 0);
    }
    Vec<3> place = region_.lo;
    for (int axis = 0; axis < dimension_; ++axis)
      place[axis] = random.between(region_.lo[axis], region_.hi[axis]);
    return place;
  }

 private:
  Arrange arrange_;
  Box<3> region_;
  std::size_t count_;
  int dimension_;
  std::array<std::size_t, 3> cells_{1, 1, 1};
  double height_ = 0;  // of a body's box
};

// The bodies of a pattern, in their order, each like `like` but for place, velocity and colour.
void unroll(const BodySpec& like, const PatternSpec& pattern, const TableReader& table,
            Draft& draft) {
  const int dimension = draft.scenario.world.dimension;
  const Places places(like, pattern, table, draft);
  const double speed = like.brain == Brain::follow ? 0 : pattern.speed;
  Random random(derived_seed(table, like.name, draft));
  for (std::size_t i = 0; i < pattern.count; ++i) {
    BodySpec body = like;
    body.name = fmt::format("{}{}", like.name, i + 1);
    body.color = cycled_color(pattern.color, i);
    body.position = places.at(i, random);
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
          "At random places; in rows from the lowest corner; on a line from `min` to "
          "`max`; or as a stack, each on the one before, the lowest at `min`."),
      key(KeyType::point, "min", "Lowest corner of where centres may be.", range(-kFar, kFar),
          or_else("so that all lie in the world")),
      key(KeyType::point, "max", "Highest corner of where centres may be.", range(-kFar, kFar),
          or_else("so that all lie in the world")),
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
  const TableReader table = open(value, language_table("pattern"), draft);
  const BodySpec like = read_body_keys(table, draft);
  PatternSpec pattern;
  table.fill(pattern);
  check_motion(table, "speed", like, pattern.speed > 0);
  const std::size_t before = draft.scenario.bodies.size();
  if (!draft.has_room_for(before + pattern.count, kMostBodies, "bodies", table.place("count")) ||
      like.name.empty())
    return;
  const NamedRange range{before, pattern.count, table.place("name")};
  if (!draft.bodies.add(like.name, range, true, draft.problems)) return;
  note_follower(table, pattern.count, draft);
  unroll(like, pattern, table, draft);
}

}  // namespace lantern::scenario
