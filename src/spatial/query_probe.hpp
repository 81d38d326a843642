// What is looked for in a structure: a ray, a volume, or what is nearest to a point. A Probe has
//   Part                          what of it is left in a zone; copyable
//   whole()                       the Part that is everywhere
//   in_box(zone)                  optional<Part>: what lies in a box that may be infinite
//   beside(Part, plane, front)    optional<Part>: what of the part lies on that side; the plane is
//                                 scaled
//   beside(Part, axis, at, high)  the same of a plane across an axis
//   common(Part, Part)            what both have in common
//   kIsOrdered                    whether it meets one sooner than another
//   entry(Part)                   how soon: what the limit of the walk is compared with
//   high_first, front_first       which side of a plane it meets first
//   bits(row, limit, entries)     which of the first kRowBlock boxes of a row it meets, and no
//                                 later than when
// Parts may be larger than told, by rounding, never smaller.
#pragma once

#include <limits>
#include <type_traits>

#include "spatial/box_row.hpp"
#include "spatial/query_state.hpp"

namespace lantern::spatial {

// Of a block of which nothing is known.
inline BlockBits any_of_block(BlockEntries& entries) {
  entries.fill(0);
  return {~0u, 0};
}

// In the order in which boxes are met, or only which are.
template <int D, bool kOrdered = true>
class RayProbe {
 public:
  using Part = RaySpan;
  static constexpr bool kIsOrdered = kOrdered;

  explicit RayProbe(const Ray<D>& ray)
      : ray_(ray), in_float_(ray), is_usable_(in_float_.is_usable()) {
    for (int i = 0; i < D; ++i) {
      inverse_[i] = 1 / ray.direction[i];
      // Along an axis on which it (nearly) stands still everything is in its way, unless it begins
      // beside it.
      stands_[i] = !std::isfinite(inverse_[i]);
    }
  }

  Part whole() const { return {0, ray_.length}; }

  // As span_in of geometry/ray.hpp, but with products instead of quotients. What is lost by that is
  // given back, so that no box is missed that span_in meets, and none begins later than it says.
  std::optional<Part> in_box(const Box<D>& box) const {
    Part part = whole();
    for (int i = 0; i < D; ++i) {
      const double o = ray_.origin[i];
      if (stands_[i]) {
        if (ray_.direction[i] == 0 && (o < box.lo[i] || box.hi[i] < o)) return std::nullopt;
        continue;
      }
      const double low = (box.lo[i] - o) * inverse_[i], high = (box.hi[i] - o) * inverse_[i];
      part.from = std::max(part.from, std::min(low, high) * kLess);
      part.to = std::min(part.to, std::max(low, high) * kMore);
    }
    return part.from > part.to ? std::nullopt : std::optional(part);
  }
  std::optional<Part> beside(Part part, int axis, double at, bool high) const {
    const double o = ray_.origin[axis];
    if (stands_[axis]) {
      const bool is_outside = high ? o < at : at < o;
      return ray_.direction[axis] == 0 && is_outside ? std::nullopt : std::optional(part);
    }
    const double t = (at - o) * inverse_[axis];
    if (high == (inverse_[axis] > 0))
      part.from = std::max(part.from, t * kLess);
    else
      part.to = std::min(part.to, t * kMore);
    return part.from > part.to ? std::nullopt : std::optional(part);
  }
  // The height over the plane at t is h + t * rate, up to an error of at most e + t * r. So the
  // part in front is not longer than where (h + e) + t * (rate + r) >= 0; behind, all signs are
  // turned. Where numbers overflow, nothing is cut off.
  std::optional<Part> beside(Part part, const Plane<D>& plane, bool front) const {
    constexpr double kError = 64 * std::numeric_limits<double>::epsilon();
    double h = -plane.offset, rate = 0, e = std::abs(plane.offset), r = 0;
    for (int i = 0; i < D; ++i) {
      const double a = plane.normal[i] * ray_.origin[i], b = plane.normal[i] * ray_.direction[i];
      h += a;
      rate += b;
      e += std::abs(a);
      r += std::abs(b);
    }
    const double begin = (front ? h : -h) + e * kError;
    const double slope = (front ? rate : -rate) + r * kError;
    if (slope == 0) return begin < 0 ? std::nullopt : std::optional(part);
    if (begin + part.from * slope < 0 && begin + part.to * slope < 0) return std::nullopt;
    const double crossing = -begin / slope;
    if (slope > 0) part.from = std::max(part.from, crossing * (1 - kError));
    if (slope < 0) part.to = std::min(part.to, crossing * (1 + kError));
    return part;
  }
  static std::optional<Part> common(const Part& a, const Part& b) {
    const Part both{std::max(a.from, b.from), std::min(a.to, b.to)};
    return both.from > both.to ? std::nullopt : std::optional(both);
  }

  const Vec<D>& origin() const { return ray_.origin; }
  double at(double t, int axis) const { return ray_.origin[axis] + t * ray_.direction[axis]; }

  static double entry(const Part& part) { return part.from; }
  bool high_first(int axis, double) const { return ray_.direction[axis] < 0; }
  bool front_first(const Plane<D>& plane) const {
    return glm::dot(plane.normal, ray_.direction) < 0;
  }
  template <class Row>
  BlockBits bits(const Row& row, double limit, BlockEntries& entries) const {
    if (!is_usable_) return any_of_block(entries);
    return met_in_block(row, in_float_, BoxTable<D>::rounded_up(limit),
                        kOrdered ? &entries : nullptr);
  }

 private:
  static constexpr double kLess = 1 - 1e-15, kMore = 1 + 1e-15;

  const Ray<D>& ray_;
  FloatRay<D> in_float_;
  bool is_usable_;
  Vec<D> inverse_;
  bool stands_[D];
};

// Whether a volume may lie within the zone of a node, which may be infinite. Of a frustum only its
// planes are looked at, which is cheap and lets some in that lie outside, near its corners.
template <int D, template <int> class Volume>
bool may_overlap(const Volume<D>& volume, const Box<D>& zone) {
  return overlap(volume, zone);
}

// Whether it may reach that side of a plane; generous by more than the error of heights.
template <int D>
bool may_reach(const Box<D>& box, const Plane<D>& plane, bool front) {
  const Reach sides = reach(box, plane);
  return front ? sides.front : sides.back;
}
template <int D>
bool may_reach(const Ball<D>& ball, const Plane<D>& plane, bool front) {
  constexpr double kError = 64 * std::numeric_limits<double>::epsilon();
  double sum = std::abs(plane.offset), square = 0;
  for (int i = 0; i < D; ++i) {
    sum += std::abs(plane.normal[i] * ball.center[i]);
    square += plane.normal[i] * plane.normal[i];
  }
  const double h = height(ball.center, plane);
  const double most = (front ? h : -h) + ball.radius * std::sqrt(square);
  return !(most < -kError * (sum + ball.radius));
}
template <int D>
bool may_reach(const Frustum<D>& frustum, const Plane<D>& plane, bool front) {
  constexpr double kError = 1024 * std::numeric_limits<double>::epsilon();
  for (const Vec<D>& corner : frustum.corners) {
    double sum = std::abs(plane.offset);
    for (int i = 0; i < D; ++i) sum += std::abs(plane.normal[i] * corner[i]);
    const double h = height(corner, plane);
    if (!((front ? h : -h) < -kError * sum)) return true;
  }
  return false;
}

template <int D>
bool may_reach(const Ray<D>& ray, const Plane<D>& plane, bool front) {
  const RayProbe<D> probe(ray);
  return probe.beside(probe.whole(), plane, front).has_value();
}

// A box in which the volume lies; of what reaches without end there is none.
template <int D>
Box<D> box_around(const Box<D>& box) {
  return box;
}
template <int D>
Box<D> box_around(const Ball<D>& ball) {
  Box<D> box;
  for (int i = 0; i < D; ++i) {
    const double center = ball.center[i];
    const double reach = ball.radius + 1e-15 * (std::abs(center) + ball.radius);
    box.lo[i] = center - reach;
    box.hi[i] = center + reach;
  }
  return box;
}
template <int D>
Box<D> box_around(const Frustum<D>& frustum) {
  Box<D> box{frustum.corners[0], frustum.corners[0]};
  for (const Vec<D>& corner : frustum.corners)
    box = united(box, box_around(Ball<D>{corner, 1e-13 * glm::length(corner)}));
  return box;
}
template <int D>
Box<D> box_around(const Ray<D>&) {
  return {Vec<D>(-kInfinity), Vec<D>(kInfinity)};
}

// A volume is in a zone or not: it has no parts.
template <int D, template <int> class Volume>
class VolumeProbe {
 public:
  struct Part {};
  static constexpr bool kIsOrdered = false;

  explicit VolumeProbe(const Volume<D>& volume)
      : volume_(volume), around_(box_around(volume)), in_float_(around_) {
    if constexpr (kIsBall) ball_ = FloatBall<D>(volume.center, volume.radius);
  }

  const Box<D>& around() const { return around_; }
  Part whole() const { return {}; }
  std::optional<Part> in_box(const Box<D>& zone) const { return if_so(may_overlap(volume_, zone)); }
  std::optional<Part> beside(Part, const Plane<D>& plane, bool front) const {
    return if_so(may_reach(volume_, plane, front));
  }
  std::optional<Part> beside(Part, int axis, double at, bool high) const {
    return if_so(high ? around_.hi[axis] >= at : around_.lo[axis] <= at);
  }
  static std::optional<Part> common(Part, Part) { return Part{}; }

  static double entry(Part) { return 0; }
  static bool high_first(int, double) { return false; }
  static bool front_first(const Plane<D>&) { return false; }
  // Of a frustum and of a ball beyond float those that the box around it meets.
  template <class Row>
  BlockBits bits(const Row& row, double, BlockEntries&) const {
    if (kIsBall && ball_.is_usable()) return reached_in_block(row, ball_, nullptr);
    BlockBits bits = reached_in_block(row, in_float_);
    if (!std::is_same_v<Volume<D>, Box<D>>) bits.surely = 0;
    return bits;
  }

 private:
  static constexpr bool kIsBall = std::is_same_v<Volume<D>, Ball<D>>;

  static std::optional<Part> if_so(bool is_so) {
    return is_so ? std::optional(Part{}) : std::nullopt;
  }

  const Volume<D>& volume_;
  Box<D> around_;
  FloatBox<D> in_float_;
  FloatBall<D> ball_{Vec<D>(0.0), 0};
};

// How far a zone lies from a point, at least: on each axis, and beyond planes.
template <int D>
class PointProbe {
 public:
  struct Part {
    Vec<D> gaps{0.0};
    double square = 0;  // of how far beyond planes
  };
  static constexpr bool kIsOrdered = true;

  explicit PointProbe(const Vec<D>& point) : point_(point), ball_(point, 1) {}

  const Vec<D>& point() const { return point_; }
  Part whole() const { return {}; }
  std::optional<Part> in_box(const Box<D>& zone) const { return Part{gaps<D>(point_, zone), 0}; }
  std::optional<Part> beside(Part part, const Plane<D>& plane, bool front) const {
    constexpr double kError = 64 * std::numeric_limits<double>::epsilon();
    double sum = std::abs(plane.offset), square = 0;
    for (int i = 0; i < D; ++i) {
      sum += std::abs(plane.normal[i] * point_[i]);
      square += plane.normal[i] * plane.normal[i];
    }
    const double h = height(point_, plane);
    const double beyond = std::max((front ? -h : h) - kError * sum, 0.0);
    part.square = std::max(part.square, beyond * beyond / square * (1 - kError));
    return part;
  }
  std::optional<Part> beside(Part part, int axis, double at, bool high) const {
    part.gaps[axis] = std::max(part.gaps[axis], high ? at - point_[axis] : point_[axis] - at);
    return part;
  }
  static std::optional<Part> common(const Part& a, const Part& b) {
    return Part{glm::max(a.gaps, b.gaps), std::max(a.square, b.square)};
  }

  static double entry(const Part& part) { return std::max(part.square, square_of(part.gaps)); }
  bool high_first(int axis, double at) const { return point_[axis] > at; }
  bool front_first(const Plane<D>& plane) const { return height(point_, plane) > 0; }
  template <class Row>
  BlockBits bits(const Row& row, double limit, BlockEntries& entries) const {
    ball_.square = BoxTable<D>::rounded_up(std::clamp(limit, 1e-29, 1e29));
    if (!ball_.is_usable()) return any_of_block(entries);
    return reached_in_block(row, ball_, &entries);
  }

 private:
  const Vec<D>& point_;
  mutable FloatBall<D> ball_;  // as large as the limit
};

}  // namespace lantern::spatial
