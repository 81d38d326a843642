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
#include <cstdlib>
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

// One level of a grid as it is held: which cells are in use, and how they lie in memory.
template <int D>
struct GridLevel {
  GridRaster<D> raster;
  Box<D> corners;  // the smallest box around its bodies' lower corners
  double widest = 0;
  GridCell<D> base{};  // of the cells in use the first, on each axis
  GridCell<D> last{};
  std::array<std::int64_t, D> fold{};  // slots on each axis
  std::int64_t reach = 1;              // how many cells a body reaches beyond its first, at most
  bool folded = false;
  std::uint32_t first_slot = 0, slots = 0;
  std::uint32_t first = 0, count = 0;  // places

  std::int64_t fold_of(std::int64_t u, std::size_t axis) const {
    return folded ? u % fold[axis] : u;
  }

  // Of a cell in use.
  std::uint32_t slot(const GridCell<D>& cell) const {
    std::int64_t slot = 0;
    for (std::size_t i = D; i-- > 0;) slot = slot * fold[i] + fold_of(cell[i] - base[i], i);
    return static_cast<std::uint32_t>(slot);
  }

  // The first slot of a row, whose cells are counted from the base.
  std::uint32_t row(std::int64_t y, std::int64_t z) const {
    const std::int64_t row = D == 3 ? fold_of(z, D - 1) * fold[1] + fold_of(y, 1) : fold_of(y, 1);
    return first_slot + static_cast<std::uint32_t>(row * fold[0]);
  }

  std::int64_t buckets(std::size_t axis) const { return std::max(fold[axis], kLeastFold); }

  // Which bucket any cell belongs to, from 0; while the level is not folded the cells in use have
  // one each.
  std::uint32_t bucket(const GridCell<D>& cell) const {
    std::int64_t bucket = 0;
    for (std::size_t i = D; i-- > 0;) {
      const std::int64_t u = (cell[i] - base[i]) % buckets(i);
      bucket = bucket * buckets(i) + (u < 0 ? u + buckets(i) : u);
    }
    return static_cast<std::uint32_t>(bucket);
  }

  // How the cells lie, when all bodies are counted. If there are more than eight a body, the
  // longest axes are folded.
  void lay_out() {
    if (count == 0) return;
    base = raster.at(corners.lo);
    last = raster.at(corners.hi);
    double cells = 1;
    bool sharp = widest <= 0.999 * raster.side();
    for (std::size_t i = 0; i < D; ++i) {
      fold[i] = last[i] - base[i] + 1;
      cells *= static_cast<double>(fold[i]);
      sharp = sharp && std::abs(base[i]) < kSharp && std::abs(last[i]) < kSharp;
    }
    reach = sharp ? 1 : 2;
    const double most = 64 + 8.0 * count;
    folded = cells > most;
    while (cells > most) {
      std::int64_t& longest = *std::max_element(fold.begin(), fold.end());
      if (longest <= kLeastFold) break;
      const std::int64_t less =
          prime_up_to(std::max(kLeastFold, std::min(longest / 2, std::int64_t{16} * count)));
      cells = cells / static_cast<double>(longest) * static_cast<double>(less);
      longest = less;
    }
    slots = static_cast<std::uint32_t>(cells + 0.5);
  }

 private:
  static constexpr std::int64_t kLeastFold = 7;  // more than twice as far as a body reaches
  // Cells so near to the bounds' corner that what is a thousandth smaller than a cell reaches the
  // next one at most, however it is rounded.
  static constexpr std::int64_t kSharp = std::int64_t{1} << 40;

  static std::int64_t prime_up_to(std::int64_t n) {
    const auto is_prime = [](std::int64_t p) {
      for (std::int64_t d = 2; d * d <= p; ++d)
        if (p % d == 0) return false;
      return true;
    };
    while (!is_prime(n)) --n;
    return n;
  }
};

}  // namespace lantern::spatial
