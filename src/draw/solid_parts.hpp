// What the parts of a solid world's panel share.
#pragma once

#include <string>
#include <vector>

#include "draw/labels.hpp"
#include "draw/solid_order.hpp"

namespace lantern {

// A body that is drawn: where it is in space and on the page.
struct SolidBody {
  const FrameBody* body = nullptr;
  Convex space;
  Outline outline;
  Box<2> box;  // of the outline, what is in the panel
};

// The bodies that the view shows, in the frame's order. Half-spaces are ground, and not among them.
std::vector<SolidBody> solid_bodies(const Frame& frame, const SolidView& view);

// A body as one piece: its faces in three tones, or a character that faces the viewer.
Piece body_piece(const SolidBody& body, const SolidView& view);

// A dot for each body, the nearest last.
void draw_solid_crowd(const Frame& frame, const SolidView& view, DrawList& list);

// The part of a segment that is in front of the eye and in the panel, as one piece. `casing`, if it
// has a width, is painted under it.
void add_piece(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, const Stroke& casing,
               const SolidView& view, std::vector<Piece>& pieces);

// The same in several pieces, between the bodies that the segment passes through: what lies inside
// of them cannot be seen.
void add_line(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, const Stroke& casing,
              const std::vector<SolidBody>& bodies, const SolidView& view,
              std::vector<Piece>& pieces);

// The head of an arrow, `size` long on the page; none on a shorter arrow.
void add_head(const Vec<3>& from, const Vec<3>& to, double size, Role role, const SolidView& view,
              std::vector<Piece>& pieces);

// The twelve edges of a box.
void add_box(const Box<3>& box, const Stroke& stroke, const std::vector<SolidBody>& bodies,
             const SolidView& view, std::vector<Piece>& pieces);

// A disc on the page, over whatever is there; whole or not at all.
void draw_spot(const Vec<3>& at, double radius, Role role, const SolidView& view, DrawList& list);

// The floor with its grid, half-spaces, and views' insides: what lies under all else.
void draw_solid_ground(const Frame& frame, const SolidView& view, DrawList& list);

// Straight below each body on the floor; seen through the grounds of cells, or they would hide how
// high a body is.
void draw_shadows(const std::vector<SolidBody>& bodies, const SolidView& view, DrawList& list);

// The lines from bodies to the floor.
void add_drop_lines(const std::vector<SolidBody>& bodies, const SolidView& view,
                    std::vector<Piece>& pieces);

// The grounds of lit cells, which lie behind all bodies in them.
void draw_cell_grounds(const Frame& frame, const SolidView& view, DrawList& list);

// The edges of cells; false if there are too many, and the deepest are left out.
bool add_cells(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
               std::vector<Piece>& pieces);

// Pairs, springs and joints, velocities and the bodies' boxes; false if not all pairs are drawn.
bool add_marks(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
               std::vector<Piece>& pieces);

// Views, rays, and regions asked for.
void add_sight(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
               std::vector<Piece>& pieces);

// What is shown through whatever lies before it: where pairs meet, ends of links, and contacts;
// false if not all contacts are drawn.
bool draw_marks_over(const Frame& frame, const std::vector<SolidBody>& bodies,
                     const SolidView& view, DrawList& list);

// The same for hits, and for the eyes of views.
void draw_sight_over(const Frame& frame, const SolidView& view, DrawList& list, Labels& labels);

void name_solids(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
                 DrawList& list, Labels& labels);

}  // namespace lantern
