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

// A segment as pieces between the bodies that it passes through; what lies inside of them cannot be
// seen. `casing`, if it has a width, is painted under all of it.
void add_line(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, const Stroke& casing,
              const std::vector<SolidBody>& bodies, const SolidView& view,
              std::vector<Piece>& pieces);

// The floor with its grid, half-spaces, shadows and views' insides: what lies under all else.
void draw_ground(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
                 DrawList& list);

// The lines from bodies to the floor.
void add_drop_lines(const std::vector<SolidBody>& bodies, const SolidView& view,
                    std::vector<Piece>& pieces);

// The grounds of lit cells, which lie behind all bodies in them.
void draw_cell_grounds(const Frame& frame, const SolidView& view, DrawList& list);

// The edges of cells; false if there are too many, and the deepest are left out.
bool add_cells(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
               std::vector<Piece>& pieces);

// Pairs, joints, rays, views, regions asked for, boxes and velocities.
bool add_marks(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
               std::vector<Piece>& pieces);

// What is shown through whatever lies before it: joints of pairs, hits and contacts.
void draw_marks_over(const Frame& frame, const std::vector<SolidBody>& bodies,
                     const SolidView& view, DrawList& list);

void name_solids(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
                 DrawList& list, Labels& labels);

}  // namespace lantern
