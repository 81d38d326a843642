// Hidden surfaces in painter's order: what is farther is painted first, and what is nearer covers
// it.
#pragma once

#include <string>
#include <vector>

#include "draw/projection.hpp"
#include "geometry/rotation.hpp"

namespace lantern::draw {

// A convex piece of space: all points within `radius` of a box that may be thin. A ball is a point
// with a radius, a capsule a segment with one, a line a segment without.
struct Convex {
  Vec<3> center{0.0};
  Mat<3> axes{1.0};  // unit columns
  Vec<3> half{0.0};  // along them
  double radius = 0;

  static Convex line(const Vec<3>& a, const Vec<3>& b);
  static Convex of(const FrameBody& body);  // of a half-space: its box
};

// Where, from 0 at `a` to 1 at `b`, a segment is in the piece; nothing when it misses it.
std::optional<std::pair<double, double>> inside_of(const Convex& piece, const Vec<3>& a,
                                                   const Vec<3>& b);

// True when `a` may cover `b` for this eye, and not the other way round. Some plane parts two
// convex pieces that do not meet; what lies on the eye's side of it is never covered by the other.
// Of pieces that do meet, the plane that they pass least decides.
bool nearer(const Convex& a, const Convex& b, const Vec<3>& eye);

// What is painted at one go.
struct Piece {
  Convex space;
  Outline outline;       // what it may cover on the page, convex
  bool is_line = false;  // lines are ordered against bodies, not against each other
  bool yields = false;   // a line that is thinner where it passes before a body
  std::vector<DrawShape> shapes;
  std::string key = {}, from = {};  // what it shows (KeyedRun)
};

// The part of a segment on the page, from 0 to 1, that lies in a convex outline.
std::optional<std::pair<double, double>> inside_of(const Outline& outline, const Vec<2>& a,
                                                   const Vec<2>& b);

// Paints all pieces, each after those that it covers. Where three or more cover each other in turn
// the farthest goes first.
void paint(std::vector<Piece> pieces, const View3D& view, DrawList& list);

}  // namespace lantern::draw
