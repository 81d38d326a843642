// Axis-aligned boxes. All are closed: a box that touches another one overlaps it, everywhere.
#pragma once

#include <algorithm>
#include <limits>

#include <glm/common.hpp>

#include "geometry/vec.hpp"

namespace lantern::geometry {

template <int D>
struct Box {
  Vec<D> lo{0.0};
  Vec<D> hi{0.0};

  static Box around(const Vec<D>& center, const Vec<D>& half_size) {
    return {center - half_size, center + half_size};
  }
  Vec<D> center() const { return lo + (hi - lo) * 0.5; }
  Vec<D> size() const { return hi - lo; }
  bool operator==(const Box&) const = default;
};

// The predicate that brute force and every tree share.
template <int D>
bool overlap(const Box<D>& a, const Box<D>& b) {
  bool all = true;  // and no branch for each axis
  for (int i = 0; i < D; ++i) all &= (a.lo[i] <= b.hi[i]) & (b.lo[i] <= a.hi[i]);
  return all;
}

template <int D>
bool contains(const Box<D>& box, const Vec<D>& point) {
  for (int i = 0; i < D; ++i)
    if (point[i] < box.lo[i] || box.hi[i] < point[i]) return false;
  return true;
}

// The smallest box that holds both.
template <int D>
Box<D> united(const Box<D>& a, const Box<D>& b) {
  return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
}

// What lies in both; not valid if that is nothing.
template <int D>
Box<D> common_part(const Box<D>& a, const Box<D>& b) {
  return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)};
}

// Finite, and nowhere is lo above hi.
template <int D>
bool is_valid(const Box<D>& box) {
  constexpr double kMost = std::numeric_limits<double>::max();
  bool valid = true;  // nothing that is not a number compares; and no branch for each bound
  for (int i = 0; i < D; ++i)
    valid &= (box.lo[i] >= -kMost) & (box.lo[i] <= box.hi[i]) & (box.hi[i] <= kMost);
  return valid;
}

// The largest of its extents.
template <int D>
double extent_of(const Box<D>& box) {
  double most = box.hi[0] - box.lo[0];
  for (int i = 1; i < D; ++i) most = std::max(most, box.hi[i] - box.lo[i]);
  return most;
}

}  // namespace lantern::geometry
