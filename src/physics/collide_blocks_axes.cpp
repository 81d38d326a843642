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

  Search(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin, NarrowTrace<D>& trace)
      : a_(a),
        b_(b),
        offset_(b.center - a.center),
        bias_(kAxisBias * smallest_half(a, b)),
        margin_(margin),
        trace_(trace) {}

  SeparatingAxes<D> run() {
    found_.parted = !try_all();
    return found_;
  }

 private:
  // False once an axis parts them.
  bool try_all() {
    if (!try_faces(a_, b_, Kind::face_of_a)) return false;
    if (!same_axes() && !try_faces(b_, a_, Kind::face_of_b)) return false;
    found_.face = found_.chosen;
    if constexpr (D == 3)
      if (!try_edges()) return false;
    return try_sides();
  }

  bool same_axes() const {
    if (!(a_.axes == b_.axes)) return false;
    for (int i = 0; i < D; ++i)
      if (a_.half[i] <= 0 || b_.half[i] <= 0) return false;
    return true;
  }

  bool try_faces(const PlacedCore<D>& own, const PlacedCore<D>& other, Kind kind) {
    for (int i = 0; i < D; ++i)
      if (is_face(own, i) && !try_across(own, other, i, kind)) return false;
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
      if (!is_face(a_, i) && !try_across(a_, b_, i, Kind::side)) return false;
      if (!is_face(b_, i) && !try_across(b_, a_, i, Kind::side)) return false;
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

  bool try_across(const PlacedCore<D>& own, const PlacedCore<D>& other, int axis, Kind kind) {
    const Vec<D> n = own.axes[axis];
    const double along = glm::dot(n, offset_);
    trace_.lengths += 1 + D;
    return consider(
        {along < 0 ? -n : n, std::abs(along) - own.half[axis] - other.reach(n), kind, axis, axis});
  }

  bool try_edges(int i, int j) {
    const Vec<3> product = glm::cross(a_.axes[i], b_.axes[j]);
    const double sine = glm::length(product);
    if (sine < kParallel) return true;
    const Vec<3> n = product / sine;
    const double along = glm::dot(n, offset_);
    trace_.lengths += 1 + 2 * D;
    return consider(
        {along < 0 ? -n : n, std::abs(along) - a_.reach(n) - b_.reach(n), Kind::edges, i, j});
  }

  bool consider(const SeparatingAxis<D>& axis) {
    if (trace_.axes) tell(axis);
    if (axis.separation - (a_.radius + b_.radius) > margin_) return false;
    if (axis.separation > best_.separation) best_ = axis;
    return true;
  }

  void tell(const SeparatingAxis<D>& axis) {
    using Across = typename MeasuredAxis<D>::Across;
    const Across across = axis.kind == Kind::face_of_a   ? Across::face_of_a
                          : axis.kind == Kind::face_of_b ? Across::face_of_b
                          : axis.kind == Kind::edges     ? Across::edges
                                                         : Across::side;
    trace_.note(axis.normal, axis.separation - a_.radius - b_.radius, across);
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
  double margin_;
  NarrowTrace<D>& trace_;
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
SeparatingAxes<D> separating_axes(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin,
                                  NarrowTrace<D>& trace) {
  return Search<D>(a, b, margin, trace).run();
}

template double smallest_half(const PlacedCore<2>&, const PlacedCore<2>&);
template double smallest_half(const PlacedCore<3>&, const PlacedCore<3>&);
template SeparatingAxes<2> separating_axes(const PlacedCore<2>&, const PlacedCore<2>&, double,
                                           NarrowTrace<2>&);
template SeparatingAxes<3> separating_axes(const PlacedCore<3>&, const PlacedCore<3>&, double,
                                           NarrowTrace<3>&);

}  // namespace lantern::physics::narrow
