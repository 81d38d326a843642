// What the parts of a 3D world's panel share.
#pragma once

#include <string>
#include <vector>

#include "draw/marks.hpp"
#include "geometry/rotation.hpp"

namespace lantern::draw {

// --- hidden surfaces in painter's order: what is farther is painted first, and what is nearer
// covers it ---

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

// --- bodies, marks and ground ---

// A body that is drawn: where it is in space and on the page.
struct Body3D {
  const FrameBody* body = nullptr;
  Convex space;
  Outline outline;
  Box<2> box;  // of the outline, what is in the panel
};

// The bodies that the view shows, in the frame's order. Half-spaces are ground, and not among them.
std::vector<Body3D> bodies_in_view(const Frame& frame, const View3D& view);

// A body as one piece: its faces in three tones, or a character that faces the viewer.
Piece body_piece(const Body3D& body, const View3D& view);

// A dot for each body, the nearest last.
void draw_crowd3d(const Frame& frame, const View3D& view, DrawList& list);

// Marks of a 3D world: pieces to be painted in order, as far as no body hides them.
class Marks3D : public Marks {
 public:
  Marks3D(const View3D& seen_from, const std::vector<Body3D>& shown, DrawList& list)
      : Marks(seen_from, seen_from.panel(), list), view(seen_from), bodies(shown) {
    over_ = &above_;
    above_.prefix = list.prefix;
  }

  const View3D& view;
  const std::vector<Body3D>& bodies;
  std::vector<Piece> pieces;

  void line(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, double casing = 0) override;
  void arrow(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, double head,
             double casing) override;
  void spring(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke) override;
  void box(const Box<3>& box, const Stroke& stroke) override;
  void ball(const Vec<3>& center, double radius, const Stroke& stroke) override;
  void add(const Convex& space, Outline outline, std::vector<DrawShape> shapes);

  // All pieces, and what lies over them; what comes later is drawn as it comes.
  void paint();

 private:
  // What is in front of the eye and in the panel, as one piece.
  void add_part(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, double casing);

  DrawList above_;
};

// The floor with its grid, half-spaces, and views' insides: what lies under all else.
void draw_ground3d(const Frame& frame, const View3D& view, DrawList& list);

// Straight below each body on the floor; seen through the grounds of cells, or they would hide how
// high a body is.
void draw_shadows(const std::vector<Body3D>& bodies, const View3D& view, DrawList& list);

// The lines from bodies to the floor, with a tick for each step of the floor's grid.
void add_drop_lines(Marks3D& marks);

// A scale of heights at an upright edge of the bounds that nothing lies before; for few bodies.
void write_heights(const std::vector<Body3D>& bodies, const View3D& view, DrawList& list,
                   Labels& labels);

// The planes that divide the nodes that the step has split, within their cells: their grounds,
// which lie behind all bodies, and their outlines.
void draw_cut_grounds(const Frame& frame, const View3D& view, DrawList& list);
void add_cuts(const Frame& frame, Marks3D& marks);

// The grounds of lit cells, which lie behind all bodies in them.
void draw_cell_grounds(const Frame& frame, const View3D& view, DrawList& list);

// The edges of cells; false if there are too many, and the deepest are left out.
bool add_cells(const Frame& frame, Marks3D& marks);

// Links between the bodies of each pair; false if not all are drawn.
bool add_pairs(const Frame& frame, Marks3D& marks);
// Where they meet, shown through whatever lies before it.
void draw_joints(const Frame& frame, const Marks3D& marks);

}  // namespace lantern::draw
