// The parts of the contact of two blocks: cores taken for boxes, capsules for boxes without
// thickness.
//
// 1. Separating axes (collide_blocks_axes.cpp): along which direction do the cores overlap least?
// 2. A face contact (collide_blocks_face.cpp): the face that looks at the other block is the
//    reference; the other block's face is clipped against its sides.
// 3. Cores that are apart where no face looks at the other block: their closest points
//    (collide_blocks_closest.cpp).
#pragma once

#include "physics/collide_cores.hpp"

namespace lantern::physics::narrow {

// A direction along which the cores were measured.
template <int D>
struct SeparatingAxis {
  // `side`: across a block without thickness, where it has no face.
  enum class Kind : std::uint8_t { face_of_a, face_of_b, edges, side };

  Vec<D> normal{0.0};     // unit, from a to b
  double separation = 0;  // of the cores along it; below 0 they overlap
  Kind kind = Kind::face_of_a;
  int axis_a = 0;  // of a's face or edge
  int axis_b = 0;  // of b's face or edge
};

template <int D>
struct SeparatingAxes {
  bool parted = false;         // one axis was enough; the others were not measured
  SeparatingAxis<D> chosen;    // the one to build the contact on
  SeparatingAxis<D> greatest;  // the one of the largest separation
  SeparatingAxis<D> face;      // the best of a face; its normal is 0 if neither block has any
};

// Gottschalk, Lin, Manocha (OBBTree, 1996). If the largest separation is above 0, the cores are at
// least so far apart. If not, they overlap, and it is the least depth.
//
// Where two axes are nearly equal, as for boxes that lie flat on each other, rounding must not
// choose. So a later kind of axis must be better than an earlier one by kAxisBias of the smallest
// half size: faces of a, faces of b, edges, sides.
inline constexpr double kAxisBias = 1e-3;

//
// It ends at the first axis along which the shapes, radii and all, are further apart than `margin`.
// Boxes that lie the same way have the same axes, which are measured once.
template <int D>
SeparatingAxes<D> separating_axes(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin,
                                  NarrowTrace<D>& trace);

// The smallest half size of both that is not 0; 0 if all are.
template <int D>
double smallest_half(const PlacedCore<D>& a, const PlacedCore<D>& b);

// A contact of two blocks and how far its closest point really is from the other core.
template <int D>
struct FaceContact {
  Manifold<D> manifold;
  double least_distance = 0;
};

// The contact in which a face of `reference` across `axis` meets `other`. `normal` is unit, from
// reference to other, and within a right angle of the face's; separations are along it. No more
// than `margin` apart; the manifold is empty if nothing of the other block's face is above the
// reference.
template <int D>
FaceContact<D> face_contact(const PlacedCore<D>& reference, const PlacedCore<D>& other, int axis,
                            const Vec<D>& normal, double margin);

// The point of each core that is closest to the other one, if they are apart, and a name of the
// features on which they lie. `axis` is one along which they are apart; the better it is, the less
// work is left.
template <int D>
struct ClosestFeatures {
  PointPair<D> points;
  std::uint32_t feature = 0;
};

template <int D>
ClosestFeatures<D> closest_features(const PlacedCore<D>& a, const PlacedCore<D>& b,
                                    const SeparatingAxis<D>& axis, NarrowTrace<D>& trace);

}  // namespace lantern::physics::narrow
