#include <limits>

#include "physics/collide_blocks.hpp"

namespace lantern::physics::narrow {
namespace {

// Edges that are nearer to parallel than this (the sine of their angle) have no axis of their own:
// the product of two unit vectors is rounded by 1e-16, so its direction is good to 1e-10 here. What
// is left out is an axis that the faces have already tried, but for a turn of 1e-6.
constexpr double kParallel = 1e-6;

template <int D>
class Search {
 public:
  using Kind = typename SeparatingAxis<D>::Kind;

  Search(const PlacedCore<D>& a, const PlacedCore<D>& b)
      : a_(a), b_(b), offset_(b.center - a.center), bias_(kAxisBias * smallest_half(a, b)) {}

  SeparatingAxes<D> run() {
    for (int i = 0; i < D; ++i)
      if (is_face(a_, i)) try_across(a_, b_, i, Kind::face_of_a);
    settle();
    for (int i = 0; i < D; ++i)
      if (is_face(b_, i)) try_across(b_, a_, i, Kind::face_of_b);
    settle();
    found_.face = found_.chosen;
    if constexpr (D == 3) {
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
          if (a_.half[i] > 0 && b_.half[j] > 0) try_edges(i, j);
      settle();
    }
    for (int i = 0; i < D; ++i) {
      if (!is_face(a_, i)) try_across(a_, b_, i, Kind::side);
      if (!is_face(b_, i)) try_across(b_, a_, i, Kind::side);
    }
    settle();
    return found_;
  }

 private:
  // A block without thickness has sides that are no faces. They separate too, but come last.
  static bool is_face(const PlacedCore<D>& block, int axis) {
    for (int i = 0; i < D; ++i)
      if (i != axis && block.half[i] <= 0) return false;
    return true;
  }

  void try_across(const PlacedCore<D>& own, const PlacedCore<D>& other, int axis, Kind kind) {
    const Vec<D> n = own.axes[axis];
    const double along = glm::dot(n, offset_);
    consider(
        {along < 0 ? -n : n, std::abs(along) - own.half[axis] - other.reach(n), kind, axis, axis});
  }

  void try_edges(int i, int j) {
    const Vec<3> product = glm::cross(a_.axes[i], b_.axes[j]);
    const double sine = glm::length(product);
    if (sine < kParallel) return;
    const Vec<3> n = product / sine;
    const double along = glm::dot(n, offset_);
    consider({along < 0 ? -n : n, std::abs(along) - a_.reach(n) - b_.reach(n), Kind::edges, i, j});
  }

  void consider(const SeparatingAxis<D>& axis) {
    if (axis.separation > best_.separation) best_ = axis;
  }

  // Ends a kind of axis.
  void settle() {
    const double none = -std::numeric_limits<double>::infinity();
    if (best_.separation == none) return;
    if (!any_ || best_.separation > found_.greatest.separation) found_.greatest = best_;
    if (!any_ || best_.separation > found_.chosen.separation + bias_) found_.chosen = best_;
    any_ = true;
    best_.separation = none;
  }

  const PlacedCore<D>& a_;
  const PlacedCore<D>& b_;
  Vec<D> offset_;
  double bias_;
  SeparatingAxis<D> best_{Vec<D>(0.0), -std::numeric_limits<double>::infinity()};
  SeparatingAxes<D> found_;
  bool any_ = false;
};

}  // namespace

template <int D>
double smallest_half(const PlacedCore<D>& a, const PlacedCore<D>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const PlacedCore<D>* block : {&a, &b})
    for (int i = 0; i < D; ++i)
      if (block->half[i] > 0) least = std::min(least, block->half[i]);
  return std::isfinite(least) ? least : 0;
}

template <int D>
SeparatingAxes<D> separating_axes(const PlacedCore<D>& a, const PlacedCore<D>& b) {
  return Search<D>(a, b).run();
}

template double smallest_half(const PlacedCore<2>&, const PlacedCore<2>&);
template double smallest_half(const PlacedCore<3>&, const PlacedCore<3>&);
template SeparatingAxes<2> separating_axes(const PlacedCore<2>&, const PlacedCore<2>&);
template SeparatingAxes<3> separating_axes(const PlacedCore<3>&, const PlacedCore<3>&);

}  // namespace lantern::physics::narrow
