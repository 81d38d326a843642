// Where a kD-tree cuts a node, so that it fits the objects.
//
//   1. Axes are tried in the order of the spread of the bodies' centres, the largest first (of
//   equal
//      ones, x before y before z).
//   2. On an axis, the plane goes through the upper face nearest below or at the median of the
//      centres, or the nearest above it: the one that leaves fewer bodies on its fuller side, then
//      the one that cuts fewer bodies, then the lower one. It must leave something out on each side
//      and cut at most half of the bodies.
//   3. If no axis has such a plane, all upper faces of all axes are compared in the same way.
//   4. If that fails, too, there is no cut: either all boxes share a point, so that no plane parts
//      any pair (no progress), or every plane would copy more than it parts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "spatial/structure_of.hpp"

namespace lantern::spatial {

struct KdCut {
  int axis = 0;
  double plane = 0;
  std::size_t fuller = 0;  // bodies on the side that holds more
  std::size_t both = 0;    // bodies on both sides

  template <int D>
  bool behind(const Box<D>& box) const {
    return box.lo[axis] <= plane;
  }
  template <int D>
  bool in_front(const Box<D>& box) const {
    return box.hi[axis] > plane;
  }
  bool better_than(const KdCut& other) const {
    return std::tie(fuller, both, axis, plane) <
           std::tie(other.fuller, other.both, other.axis, other.plane);
  }
};

template <int D>
class KdCuts : CountsAllocations {
 public:
  // The cut of those items that are chosen, which are at least one. Keeps its scratch memory.
  std::optional<KdCut> best(std::span<const Item<D>> items, std::span<const std::uint32_t> chosen) {
    items_ = items;
    chosen_ = chosen;
    for (const int axis : axes_by_spread())
      if (const auto cut = at_median(axis)) return cut;
    std::optional<KdCut> best;
    for (int axis = 0; axis < D; ++axis) keep_better(best, best_of(axis));
    return best;
  }

  // Comparisons of a body with a plane since they were forgotten.
  std::uint64_t tests() const { return tests_; }
  void forget_tests() { tests_ = 0; }
  std::uint64_t allocations() const { return allocations_; }

 private:
  static void keep_better(std::optional<KdCut>& best, const std::optional<KdCut>& cut) {
    if (cut && (!best || cut->better_than(*best))) best = cut;
  }

  double center(std::uint32_t item, int axis) const {
    return 0.5 * items_[item].box.lo[axis] + 0.5 * items_[item].box.hi[axis];
  }

  std::array<int, D> axes_by_spread() const {
    std::array<double, D> spread{};
    std::array<int, D> axes{};
    for (int axis = 0; axis < D; ++axis) {
      double least = center(chosen_.front(), axis), most = least;
      for (const std::uint32_t i : chosen_) {
        least = std::min(least, center(i, axis));
        most = std::max(most, center(i, axis));
      }
      spread[axis] = most - least;
      axes[axis] = axis;
    }
    std::sort(axes.begin(), axes.end(), [&](int a, int b) {
      return spread[a] > spread[b] || (spread[a] == spread[b] && a < b);
    });
    return axes;
  }

  std::optional<KdCut> at_median(int axis) {
    lower_.clear();
    for (const std::uint32_t i : chosen_) append(lower_, center(i, axis));
    const auto middle = lower_.begin() + static_cast<std::ptrdiff_t>((lower_.size() - 1) / 2);
    std::nth_element(lower_.begin(), middle, lower_.end());
    double below = -std::numeric_limits<double>::infinity(), above = -below;
    for (const std::uint32_t i : chosen_) {
      const double face = items_[i].box.hi[axis];
      if (face <= *middle) below = std::max(below, face);
      if (face > *middle) above = std::min(above, face);
    }
    std::optional<KdCut> best;
    for (const double plane : {below, above})
      if (std::isfinite(plane)) keep_better(best, tried(axis, plane));
    return best;
  }

  // Nothing if the plane parts no pair, or cuts more than half.
  std::optional<KdCut> judged(int axis, double plane, std::size_t back, std::size_t front) const {
    const KdCut cut{axis, plane, std::max(back, front), back + front - chosen_.size()};
    if (cut.fuller == chosen_.size() || 2 * cut.both > chosen_.size()) return std::nullopt;
    return cut;
  }

  std::optional<KdCut> tried(int axis, double plane) {
    const KdCut cut{axis, plane};
    std::size_t back = 0, front = 0;
    for (const std::uint32_t i : chosen_) {
      back += cut.behind(items_[i].box);
      front += cut.in_front(items_[i].box);
    }
    tests_ += chosen_.size();
    return judged(axis, plane, back, front);
  }

  // Of all upper faces, in one sweep.
  std::optional<KdCut> best_of(int axis) {
    lower_.clear();
    upper_.clear();
    for (const std::uint32_t i : chosen_) {
      append(lower_, items_[i].box.lo[axis]);
      append(upper_, items_[i].box.hi[axis]);
    }
    std::sort(lower_.begin(), lower_.end());
    std::sort(upper_.begin(), upper_.end());
    tests_ += upper_.size();
    std::optional<KdCut> best;
    std::size_t back = 0;
    for (std::size_t i = 0; i < upper_.size(); ++i) {
      if (i + 1 < upper_.size() && upper_[i + 1] == upper_[i]) continue;
      while (back < lower_.size() && lower_[back] <= upper_[i]) ++back;
      keep_better(best, judged(axis, upper_[i], back, upper_.size() - i - 1));
    }
    return best;
  }

  std::span<const Item<D>> items_;
  std::span<const std::uint32_t> chosen_;
  std::vector<double> lower_, upper_;  // faces, or centres
  std::uint64_t tests_ = 0;
};

}  // namespace lantern::spatial
