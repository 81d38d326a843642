#include "scenario/placement.hpp"

#include <algorithm>
#include <cmath>

namespace lantern::scenario {
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

}  // namespace

Occupied::Occupied(const Box<3>& region, int dimension) : region_(region) {
  const std::size_t most = dimension == 2 ? 128 : 24;  // cells along an axis
  for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i) cells_[i] = most;
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
  own_.emplace(how_.region, how_.dimension);
  walls_.emplace(how_.region, how_.dimension);
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

}  // namespace lantern::scenario
