// Where the bodies of a pattern stand.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/random.hpp"
#include "language/specs.hpp"

namespace lantern::language {

enum class Arrange { random, grid, line, stack, staggered, apart };
inline EnumNames names(Arrange) {
  return {"random", "grid", "line", "stack", "staggered", "apart"};
}

// Boxes by the cells of a coarse grid over a region, so that only near ones are compared.
class Occupied {
 public:
  // For about so many boxes: with as many cells, up to a bound.
  Occupied(const Box<3>& region, int dimension, std::size_t expected = 1 << 14);

  void add(const Box<3>& box);
  // Is `holds` true of one of the boxes that may overlap this one?
  template <class F>
  bool any_near(const Box<3>& box, F&& holds) const {
    return std::ranges::any_of(wide_, holds) || any_cell(box, [&](std::size_t cell) {
             return std::ranges::any_of(grid_[cell],
                                        [&](std::size_t i) { return holds(boxes_[i]); });
           });
  }

 private:
  struct Cells {
    std::array<std::size_t, 3> lo, hi;  // both of them, too
  };
  Cells cells_of(const Box<3>& box) const;
  // Until it holds of one of the cells that the box reaches.
  template <class F>
  bool any_cell(const Box<3>& box, F&& holds) const {
    const auto [lo, hi] = cells_of(box);
    for (std::size_t z = lo[2]; z <= hi[2]; ++z)
      for (std::size_t y = lo[1]; y <= hi[1]; ++y)
        for (std::size_t x = lo[0]; x <= hi[0]; ++x)
          if (holds((z * cells_[1] + y) * cells_[0] + x)) return true;
    return false;
  }
  std::size_t cell_of(double x, int axis) const;

  Box<3> region_;
  std::array<std::size_t, 3> cells_{1, 1, 1};
  std::vector<std::vector<std::size_t>> grid_;
  std::vector<Box<3>> boxes_;
  std::vector<Box<3>> wide_;  // that reach so many cells that they are in none
};

struct Arrangement {
  Arrange arrange = Arrange::random;
  Box<3> region;  // of centres
  std::size_t count = 1;
  double gap = 0;  // between bodies that stand apart
  int dimension = 2;
};

// The centres of one pattern, in order. A body of it is like `like`; those that stand apart keep
// clear of each other and of the `others` that never move.
class Placement {
 public:
  Placement(const Arrangement& arrangement, const BodySpec& like,
            const std::vector<BodySpec>& others);

  // Nothing if they must stand apart and no free place was found for this one.
  std::optional<Vec<3>> next(Random& random);

 private:
  Vec<3> at_random(Random& random) const;
  Vec<3> in_grid(std::size_t index) const;
  std::optional<Vec<3>> apart(Random& random);
  bool is_free(const Vec<3>& place) const;
  Box<3> box_at(const Vec<3>& place) const;

  Arrangement how_;
  Vec<3> half_{0.0};              // of a body's box
  std::optional<double> radius_;  // of balls
  std::array<std::size_t, 3> cells_{1, 1, 1};
  std::vector<HalfSpace<3>> grounds_;
  std::vector<Vec<3>> ground_points_;
  std::optional<Occupied> walls_, own_;  // boxes; of those that stand apart
  std::size_t index_ = 0;
};

}  // namespace lantern::language
