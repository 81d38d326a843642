// Two searches over blocks: along which direction they overlap least, and where they are closest.
#pragma once

#include <array>
#include <limits>

#include "physics/narrow/cores.hpp"

namespace lantern::physics::narrow {

// The parts of the contact of two blocks: cores taken for boxes, capsules for boxes without
// thickness. First a direction along which they were measured.
template <int D>
struct SeparatingAxis {
  Vec<D> normal;      // unit, from a to b
  double separation;  // of the cores along it; below 0 they overlap
  AxisAcross across;  // never the closest points
  int axis_a;         // of a's face or edge
  int axis_b;         // of b's face or edge
};

inline constexpr double kAxisBias = 1e-3;

template <int D>
double least_half(const PlacedCore<D>& a, const PlacedCore<D>& b) {
  const Vec<D> least = glm::min(a.half, b.half);
  return D == 2 ? std::min(least.x, least.y) : std::min(least.x, std::min(least.y, least[D - 1]));
}

// The smallest half size of both that is not 0; 0 if all are.
template <int D>
inline double smallest_half(const PlacedCore<D>& a, const PlacedCore<D>& b) {
  if (const double least = least_half(a, b); least > 0) return least;
  double least = std::numeric_limits<double>::infinity();
  for (const PlacedCore<D>* block : {&a, &b})
    for (int i = 0; i < D; ++i)
      if (block->half[i] > 0) least = std::min(least, block->half[i]);
  return std::isfinite(least) ? least : 0;
}

// Edges that are nearer to parallel than this (the sine of their angle) have no axis of their own:
// the product of two unit vectors is rounded by 1e-16, so its direction is good to 1e-10 here. What
// is left out is an axis that the faces have already tried, but for a turn of 1e-6.
inline constexpr double kParallel = 1e-6;

// Gottschalk, Lin, Manocha (OBBTree, 1996). If the largest separation is above 0, the cores are at
// least so far apart. If not, they overlap, and it is the least depth.
//
// Where two axes are nearly equal, as for boxes that lie flat on each other, rounding must not
// choose. So a later kind of axis must be better than an earlier one by kAxisBias of the smallest
// half size: faces of a, faces of b, edges, sides.
//
// It ends at the first axis along which the shapes, radii and all, are further apart than `margin`.
// Boxes that lie the same way have the same axes, which are measured once.
template <int D>
class AxisSearch {
 public:
  AxisSearch(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin, NarrowTrace<D>& trace)
      : a_(a), b_(b), margin_(margin), trace_(trace) {}

  // False once an axis parts them; the others are not measured then.
  bool run() {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j)
        of_a_[i][j] = of_b_[j][i] = std::abs(glm::dot(a_.axes[i], b_.axes[j]));
    if (!try_faces(a_, b_, of_a_, AxisAcross::face_of_a)) return false;
    if (!same_axes_ && !try_faces(b_, a_, of_b_, AxisAcross::face_of_b)) return false;
    if (best_ != kinds_.data()) face_ = chosen_;
    if constexpr (D == 3)
      if (!try_edges()) return false;
    return full_ || try_sides();
  }
  // The one to build the contact on, the one of the largest separation, and the best of a face; its
  // normal is 0 if neither block has any.
  const SeparatingAxis<D>& chosen() const { return *chosen_; }
  const SeparatingAxis<D>& greatest() const { return *greatest_; }
  const SeparatingAxis<D>& face() const { return *face_; }

 private:
  bool try_faces(const PlacedCore<D>& own, const PlacedCore<D>& other, const Mat<D>& cosines,
                 AxisAcross across) {
    for (int i = 0; i < D; ++i)
      if (is_face(own, i) && !try_across(own, other, cosines[i], i, across)) return false;
    settle();
    return true;
  }

  bool try_edges() {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j)
        if (a_.half[i] > 0 && b_.half[j] > 0 && !try_edges(i, j)) return false;
    settle();
    return true;
  }

  bool try_sides() {
    for (int i = 0; i < D; ++i) {
      if (!is_face(a_, i) && !try_across(a_, b_, of_a_[i], i, AxisAcross::side)) return false;
      if (!is_face(b_, i) && !try_across(b_, a_, of_b_[i], i, AxisAcross::side)) return false;
    }
    settle();
    return true;
  }

  // A block without thickness has sides that are no faces. They separate too, but come last.
  static bool is_face(const PlacedCore<D>& block, int axis) {
    for (int i = 0; i < D; ++i)
      if (i != axis && block.half[i] <= 0) return false;
    return true;
  }

  bool try_across(const PlacedCore<D>& own, const PlacedCore<D>& other, const Vec<D>& cosines,
                  int axis, AxisAcross across) {
    const double along = glm::dot(own.axes[axis], offset_);
    trace_.lengths += 1 + D;
    const double separation = std::abs(along) - own.half[axis] - glm::dot(other.half, cosines);
    return consider(own.axes[axis], along, separation, across, axis, axis);
  }

  bool try_edges(int i, int j) {
    const Vec<3> product = glm::cross(a_.axes[i], b_.axes[j]);
    const double sine = glm::length(product);
    if (sine < kParallel) return true;
    const Vec<3> n = product / sine;
    const double along = glm::dot(n, offset_);
    trace_.lengths += 1 + 2 * D;
    return consider(n, along, std::abs(along) - a_.reach(n) - b_.reach(n), AxisAcross::edges, i, j);
  }

  bool consider(const Vec<D>& n, double along, double separation, AxisAcross across, int axis_a,
                int axis_b) {
    if (trace_.axes) trace_.note(along < 0 ? -n : n, separation - a_.radius - b_.radius, across);
    if (separation - radii_ > margin_) return false;
    if (!(separation > most_)) return true;
    most_ = separation;
    *best_ = {along < 0 ? -n : n, separation, across, axis_a, axis_b};
    return true;
  }

  // Ends a kind of axis.
  void settle() {
    if (most_ == kNone) return;
    if (best_ == kinds_.data() || most_ > greatest_->separation) greatest_ = best_;
    if (best_ == kinds_.data() || most_ > chosen_->separation + bias_) chosen_ = best_;
    ++best_;
    most_ = kNone;
  }

  const PlacedCore<D>&a_, &b_;
  const Vec<D> offset_ = b_.center - a_.center;
  const double radii_ = a_.radius + b_.radius, bias_ = kAxisBias * smallest_half(a_, b_);
  const bool full_ = least_half(a_, b_) > 0, same_axes_ = full_ && a_.axes == b_.axes;
  Mat<D> of_a_, of_b_;  // cosines of each axis of one to those of the other, without signs
  static constexpr double kNone = -std::numeric_limits<double>::infinity();
  std::array<SeparatingAxis<D>, 4> kinds_;   // the best of each that was measured
  SeparatingAxis<D>* best_ = kinds_.data();  // of the kind that is being measured, if
  double most_ = kNone;                      // there was one: its separation
  static inline const SeparatingAxis<D> kNoFace{};
  const SeparatingAxis<D>*chosen_ = best_, *greatest_ = best_, *face_ = &kNoFace;
  double margin_;
  NarrowTrace<D>& trace_;
};

// Calls f(edge, name) for each edge, as each_corner does.
template <class F>
void each_edge(const PlacedCore<3>& block, const F& f) {
  for (int i = 0; i < 3; ++i) {
    if (block.half[i] <= 0) continue;
    PlacedCore<3> start = block;  // its corners are where the edges along i begin
    start.center -= block.axes[i] * block.half[i];
    start.half[i] = 0;
    each_corner(start, [&](const Vec<3>& corner, std::uint32_t signs) {
      f(Segment<3>{corner, corner + block.axes[i] * (2 * block.half[i])},
        signs | static_cast<std::uint32_t>(i) << 3);
    });
  }
}

template <int D>
Vec<D> closest_point(const PlacedCore<D>& block, const Vec<D>& point) {
  return block.world(glm::clamp(block.local(point), -block.half, block.half));
}

// The point of each core that is closest to the other one, if they are apart, and a name of the
// features on which they lie. `axis` is one along which they are apart; the better it is, the less
// work is left.
template <int D>
struct ClosestFeatures {
  PointPair<D> points;
  std::uint32_t feature = 0;
};

// Two convex bodies with flat faces are closest in a corner and a point of the other one, or in two
// edges. They are tried one by one, but for those that lie too far back: if the closest points lie
// u and v behind the fronts of their blocks along the axis,
//
//   distance >= separation along the axis + u + v,
//
// so that features with a larger u + v than `distance so far - separation` cannot be better.
template <int D>
class ClosestSearch {
 public:
  ClosestSearch(const PlacedCore<D>& a, const PlacedCore<D>& b, const SeparatingAxis<D>& axis,
                NarrowTrace<D>& trace)
      : a_(a), b_(b), axis_(axis), trace_(trace) {}

  ClosestFeatures<D> run() {
    each_corner(a_, [&](const Vec<D>& corner, std::uint32_t name) {
      if (behind_a(corner) <= slack_)
        consider({corner, closest_point(b_, corner)}, 1u << 10 | name);
    });
    each_corner(b_, [&](const Vec<D>& corner, std::uint32_t name) {
      if (behind_b(corner) <= slack_)
        consider({closest_point(a_, corner), corner}, 2u << 10 | name);
    });
    if constexpr (D == 3) try_edges();
    return best_;
  }

 private:
  struct Edge {
    Segment<3> segment;
    double behind = 0;
    std::uint32_t name = 0;
  };

  // Ends of edges are corners, which have been tried: what is left is where edges cross.
  void try_edges() {
    std::array<Edge, 12> of_b;
    std::size_t count = 0;
    each_edge(b_, [&](const Segment<3>& edge, std::uint32_t name) {
      const double behind = std::min(behind_b(edge.a), behind_b(edge.b));
      if (behind <= slack_) of_b[count++] = {edge, behind, name};
    });
    each_edge(a_, [&](const Segment<3>& edge, std::uint32_t name) {
      const double behind = std::min(behind_a(edge.a), behind_a(edge.b));
      for (std::size_t i = 0; i < count; ++i)
        if (behind + of_b[i].behind <= slack_)
          consider(crossing_points(edge, of_b[i].segment), 3u << 10 | name << 5 | of_b[i].name);
    });
  }

  void consider(const PointPair<D>& points, std::uint32_t feature) {
    const double square = points.square();
    trace_.lengths += 2 + D;  // how far back, the other one's point, the distance
    if (square >= least_) return;
    least_ = square;
    best_ = {points, feature};
    const double rounding = kRounding * (reach_a_ + reach_b_ + std::abs(axis_.separation));
    slack_ = std::sqrt(square) - axis_.separation + rounding;
  }

  double behind_a(const Vec<D>& p) const {
    return reach_a_ - glm::dot(p - a_.center, axis_.normal);
  }
  double behind_b(const Vec<D>& p) const {
    return reach_b_ + glm::dot(p - b_.center, axis_.normal);
  }

  const PlacedCore<D>&a_, &b_;
  const SeparatingAxis<D>& axis_;
  NarrowTrace<D>& trace_;
  const double reach_a_ = a_.reach(axis_.normal), reach_b_ = b_.reach(axis_.normal);
  double least_ = std::numeric_limits<double>::infinity();  // the square of the least distance
  double slack_ = std::numeric_limits<double>::infinity();
  ClosestFeatures<D> best_;
};

}  // namespace lantern::physics::narrow
