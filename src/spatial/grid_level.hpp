// One level of a grid as it is held: which cells are in use, and how they lie in memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "spatial/grid_raster.hpp"

namespace lantern::spatial {

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
