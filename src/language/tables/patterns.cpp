// [[pattern]]: many bodies, where they stand and which way they go.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/random.hpp"
#include "geometry/random_vec.hpp"
#include "language/keys/key.hpp"
#include "language/tables/draft.hpp"
#include "language/tables/placement.hpp"

namespace lantern::language {
namespace {

// Places tried for a body that must stand apart; so many misses mean that there is hardly any room.
constexpr int kMostTries = 1000;
constexpr double kTouch = 1e-9;  // of a body's size: overlaps that rounding makes

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

Box<3> grown(const Box<3>& box, double by) { return {box.lo - Vec<3>(by), box.hi + Vec<3>(by)}; }

bool overlap(const Box<3>& a, const Box<3>& b, int dimension) {
  for (int i = 0; i < dimension; ++i)
    if (!(a.lo[i] < b.hi[i] && b.lo[i] < a.hi[i])) return false;
  return true;
}

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
  table.bad_value(
      "count",
      fmt::format("{} of {} bodies found a place apart from each other and from what never moves",
                  placed, count),
      "give them more room from 'min' to 'max', make them smaller, or take arrange = \"grid\"");
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

Occupied::Occupied(const Box<3>& region, int dimension, std::size_t expected) : region_(region) {
  const std::size_t most = dimension == 2 ? 128 : 24;  // cells along an axis
  std::size_t along = 1;
  while (along < most && along * along * (dimension == 2 ? 1 : along) < expected) ++along;
  for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i) cells_[i] = along;
  grid_.resize(cells_[0] * cells_[1] * cells_[2]);
}

void Occupied::add(const Box<3>& box) {
  constexpr std::size_t kMostCells = 256;
  const auto [lo, hi] = cells_of(box);
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) count *= hi[axis] - lo[axis] + 1;
  if (count > kMostCells) return wide_.push_back(box);
  any_cell(box, [&](std::size_t cell) {
    grid_[cell].push_back(boxes_.size());
    return false;
  });
  boxes_.push_back(box);
}

// What lies beyond the region belongs to the cells at its rim.
std::size_t Occupied::cell_of(double x, int axis) const {
  const auto i = static_cast<std::size_t>(axis);
  const double size = region_.size()[axis];
  const auto last = static_cast<double>(cells_[i] - 1);
  const double cell = size > 0 ? std::floor((x - region_.lo[axis]) / size * (last + 1)) : 0;
  return static_cast<std::size_t>(std::clamp(cell, 0.0, last));
}

Occupied::Cells Occupied::cells_of(const Box<3>& box) const {
  Cells cells{};
  for (int axis = 0; axis < 3; ++axis) {
    cells.lo[static_cast<std::size_t>(axis)] = cell_of(box.lo[axis], axis);
    cells.hi[static_cast<std::size_t>(axis)] = cell_of(box.hi[axis], axis);
  }
  return cells;
}

Placement::Placement(const Arrangement& arrangement, const BodySpec& like,
                     const std::vector<BodySpec>& others)
    : how_(arrangement), half_(bounding_box(like.shape, Vec<3>(0.0), orientation_of(like)).hi) {
  if (how_.arrange == Arrange::grid || how_.arrange == Arrange::staggered)
    cells_ = grid_cells(how_.region.size(), how_.count);
  if (how_.arrange != Arrange::apart) return;
  if (const auto* ball = std::get_if<Sphere>(&like.shape)) radius_ = ball->radius;
  own_.emplace(how_.region, how_.dimension, how_.count);
  walls_.emplace(how_.region, how_.dimension, others.size());
  for (const BodySpec& other : others) {
    if (other.kind != BodyKind::static_body) continue;
    if (const auto* ground = std::get_if<HalfSpace<3>>(&other.shape)) {
      grounds_.push_back(*ground);
      ground_points_.push_back(other.position);
    } else {
      walls_->add(bounding_box(other.shape, other.position, orientation_of(other)));
    }
  }
}

std::optional<Vec<3>> Placement::next(Random& random) {
  const std::size_t index = index_++;
  const auto i = static_cast<double>(index);
  const Box<3>& region = how_.region;
  switch (how_.arrange) {
    case Arrange::random:
      return at_random(random);
    case Arrange::grid:
    case Arrange::staggered:
      return in_grid(index);
    case Arrange::stack:
      return region.lo + Vec<3>(0, i * 2 * half_.y, 0);
    case Arrange::line:
      if (index + 1 == how_.count && index > 0) return region.hi;
      return region.lo +
             region.size() * (how_.count > 1 ? i / static_cast<double>(how_.count - 1) : 0);
    case Arrange::apart:
      return apart(random);
  }
  return std::nullopt;
}

Vec<3> Placement::at_random(Random& random) const {
  Vec<3> place = how_.region.lo;
  for (int axis = 0; axis < how_.dimension; ++axis)
    place[axis] = random.between(how_.region.lo[axis], how_.region.hi[axis]);
  return place;
}

// The middle of the `index`-th cell, in rows from the lowest corner. Staggered, cells are a little
// narrower, and every other row stands half a cell further to the right.
Vec<3> Placement::in_grid(std::size_t index) const {
  const bool is_staggered = how_.arrange == Arrange::staggered;
  const std::size_t column = index % cells_[0], row = index / cells_[0];
  const std::array<std::size_t, 3> cell = {column, row % cells_[1], row / cells_[1]};
  const bool is_odd = (cell[1] + cell[2]) % 2 == 1;
  Vec<3> place = how_.region.lo;
  for (int i = 0; i < 3; ++i) {
    const bool shifts = is_staggered && i == 0;
    const double n = static_cast<double>(cells_[static_cast<std::size_t>(i)]) + (shifts ? 0.5 : 0);
    const double middle = shifts && is_odd ? 1 : 0.5;
    place[i] += how_.region.size()[i] *
                ((static_cast<double>(cell[static_cast<std::size_t>(i)]) + middle) / n);
  }
  return place;
}

// Darts, until one hits a free place.
std::optional<Vec<3>> Placement::apart(Random& random) {
  for (int attempt = 0; attempt < kMostTries; ++attempt) {
    const Vec<3> place = at_random(random);
    if (!is_free(place)) continue;
    own_->add(box_at(place));
    return place;
  }
  return std::nullopt;
}

Box<3> Placement::box_at(const Vec<3>& place) const { return {place - half_, place + half_}; }

bool Placement::is_free(const Vec<3>& place) const {
  const double clear = how_.gap - kTouch * std::max({half_.x, half_.y, half_.z});
  const Box<3> wanted = grown(box_at(place), clear);
  const auto meets = [&](const Box<3>& box) { return overlap(wanted, box, how_.dimension); };
  for (std::size_t i = 0; i < grounds_.size(); ++i) {
    const Vec<3>& up = grounds_[i].normal;
    const double reach = radius_ ? *radius_ : glm::dot(glm::abs(up), half_);
    if (glm::dot(place - ground_points_[i], up) - reach < clear) return false;
  }
  if (walls_->any_near(wanted, meets)) return false;
  return !own_->any_near(wanted, [&](const Box<3>& box) {
    if (!meets(box)) return false;
    return !radius_ || glm::length(box.center() - place) < 2 * *radius_ + clear;
  });
}

TableDoc pattern_table() {
  using P = PatternSpec;
  TableDoc table = {"pattern", "[[pattern]]",
                    "Many bodies at once. Those of pattern `dot` are called `dot1`, `dot2`, …"};
  table.keys = body_keys({
      key(&P::count, "count", "How many; 20000 bodies in all are allowed.", must(),
          range(1, kMostBodies), in("bodies"), by_hand(1, 200)),
      key(&P::arrange, "arrange",
          "At random places; in rows from the lowest corner; on a line from `min` to `max`; as a "
          "stack, each on the one before, the lowest at `min`; in rows of which every other one is "
          "shifted by half a place; or at random places `apart` from each other and from what "
          "never moves.",
          by_hand()),
      key(&P::gap, "gap", "Least room between bodies that stand `apart`.", range(0, kFar),
          by_hand_in_world(0, 0.1)),
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

}  // namespace lantern::language
