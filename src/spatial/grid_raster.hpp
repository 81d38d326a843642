// Which cell of a grid a point lies in. The cells are cubes that begin at the lower corner of the
// bounds; those at the upper rim end with the bounds.
//
// One function says it for everything that is held, asked or shown, and it is monotone: a larger
// coordinate never lies in an earlier cell, however it was rounded. So of two boxes that share a
// point both reach that point's cell, and no pair is lost by rounding.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "geometry/box.hpp"

namespace lantern::spatial {

// Counted from the corner of the bounds; in an open grid also backwards.
template <int D>
using GridCell = std::array<std::int64_t, D>;

template <int D>
class GridRaster {
 public:
  GridRaster() = default;

  // `side` is positive and a normal number, as its inverse is. Closed: what lies outside of the
  // bounds lies in the cells at the rim. Open: cells go on without end; beyond 2^52 of them, where
  // numbers are no finer than cells, there are no others.
  GridRaster(const Box<D>& bounds, double side, bool open)
      : bounds_(bounds), side_(side), inverse_(1 / side), open_(open) {
    for (int i = 0; i < D; ++i) {
      first_[i] = open ? -kFar : 0;
      // A cell that only rounding makes would be too thin to see.
      const double cells = std::ceil((bounds.hi[i] - bounds.lo[i]) * inverse_ * (1 - 1e-12));
      last_[i] = open ? kFar : std::clamp(cells - 1, 0.0, kFar);
    }
  }

  double side() const { return side_; }

  std::int64_t at(double x, int axis) const {
    const double t = std::clamp((x - bounds_.lo[axis]) * inverse_, first_[axis], last_[axis]);
    const auto cell = static_cast<std::int64_t>(t);
    return cell - (static_cast<double>(cell) > t);
  }
  GridCell<D> at(const Vec<D>& point) const {
    GridCell<D> cell;
    for (int i = 0; i < D; ++i) cell[static_cast<std::size_t>(i)] = at(point[i], i);
    return cell;
  }

  // Of a closed grid: on an axis, and in all; at most 2^52, rounded.
  std::uint64_t cells(int axis) const { return static_cast<std::uint64_t>(last_[axis]) + 1; }
  double cells() const {
    double all = 1;
    for (int i = 0; i < D; ++i) all *= last_[i] + 1;
    return all;
  }

  // The cell, but for what of the world beyond the rim belongs to it.
  Box<D> box(const GridCell<D>& cell) const {
    Box<D> box;
    for (int i = 0; i < D; ++i) {
      const auto k = static_cast<double>(cell[static_cast<std::size_t>(i)]);
      box.lo[i] = bounds_.lo[i] + k * side_;
      box.hi[i] = !open_ && k == last_[i] ? bounds_.hi[i] : bounds_.lo[i] + (k + 1) * side_;
    }
    return box;
  }

 private:
  static constexpr double kFar = 0x1p52;

  Box<D> bounds_;
  double side_ = 1, inverse_ = 1;
  Vec<D> first_{0.0}, last_{0.0};
  bool open_ = false;
};

}  // namespace lantern::spatial
