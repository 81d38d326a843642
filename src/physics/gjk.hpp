// The distance of two convex shapes by their support points alone: GJK, in the plane.
//
// The Minkowski difference A - B holds a - b for all points a of A and b of B. It is convex, and
//
//   - the origin is in it where the shapes have a point in common;
//   - if not, its point nearest to the origin is as far away as the shapes are from each other.
//
// Its point farthest along d is that of A along d less that of B along -d. So nobody has to make
// it: points are asked for, one after another, each farther towards the origin.
//
// Gilbert, Johnson, Keerthi (A Fast Procedure for Computing the Distance Between Complex Objects in
// Three-Dimensional Space, 1988); van den Bergen (A Fast and Robust GJK Implementation, 1999).
#pragma once

#include <optional>
#include <vector>

#include "physics/manifold.hpp"

namespace lantern::physics {

// A point of the difference, and the points of the shapes that it is made of.
struct SupportPair {
  Vec<2> a{0.0};  // in the world
  Vec<2> b{0.0};
  Vec<2> difference() const { return a - b; }

  static decltype(auto) fields(const auto& r, auto&& v) { return v("a", r.a)("b", r.b); }
};

// One search: from the point of the simplex that is nearest to the origin, towards the origin.
struct GjkStep {
  Vec<2> direction{0.0};  // unit
  SupportPair found;      // farthest along it
  // It lies no farther along it than the simplex does: there is nothing nearer to the origin.
  bool ends = false;
  // Afterwards: of the points found as few as have the nearest point between them, 1 ... 3. With
  // three the origin lies among them.
  std::vector<SupportPair> simplex;
  Vec<2> nearest{0.0};  // of it to the origin

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("direction", r.direction)("found", r.found)("simplex", r.simplex)("nearest", r.nearest)
        .drawn(r.ends);
  }
};

struct GjkAnswer {
  bool overlaps = false;
  double distance = 0;  // of the surfaces; 0 where they overlap
  SupportPair closest;  // their closest points, if they are apart
  int steps = 0;
};

// Of any two shapes but half-spaces: nothing for these. A shape is searched as its core, which is a
// point, a segment or a box, and its radius taken off the distance (geometry/shape.hpp); so the
// search ends after few steps, with the distance to about 1e-12 of the sizes. All inputs as for
// `collide`. `watch`, if there is one, gets each step.
std::optional<GjkAnswer> gjk(const Placed<2>& a, const Placed<2>& b,
                             std::vector<GjkStep>* watch = nullptr);

// The Minkowski difference of the cores as a convex polygon, counter-clockwise, 1 ... 8 corners;
// the shapes' difference is all that lies within `radius` of it. Nothing for half-spaces.
struct MinkowskiDifference {
  std::vector<Vec<2>> corners;
  double radius = 0;
};
std::optional<MinkowskiDifference> minkowski_difference(const Placed<2>& a, const Placed<2>& b);

// The points of a shape that lie farthest along a unit vector: of a face across it both ends, else
// the same point twice. Nothing for a half-space.
struct FarthestPoints {
  Vec<2> first{0.0};
  Vec<2> second{0.0};
};
std::optional<FarthestPoints> farthest_points(const Placed<2>& shape, const Vec<2>& along);

}  // namespace lantern::physics
