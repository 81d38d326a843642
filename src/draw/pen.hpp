// Cutting shapes to a place, so that nothing leaves its panel, and a pen whose marks are cut:
// lines, arrows, dots, and hatched ground.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "draw/draw_list.hpp"
#include "geometry/plane.hpp"

namespace lantern::draw {

// The part of a polygon that lies in the rectangle; empty if there is none. Of a polygon that is
// not convex, parts may stay joined along the rectangle's edge.
std::vector<Vec<2>> cut_to(std::vector<Vec<2>> polygon, const Box<2>& rect);

// Cuts the list's rectangles and polygons from index `first` on; what lies outside goes. Lines
// stay only when they lie inside, texts never.
void cut_shapes(DrawList& list, std::size_t first, const Box<2>& rect);

// The same, but of lines the part inside stays, and texts stay; an outline is cut without a new
// edge along the rectangle's. Keyed runs keep what they show.
void keep_within(DrawList& list, std::size_t first, const Box<2>& rect);

// The part of a line that lies in the rectangle; nothing if there is none, or an end is not finite.
std::optional<std::pair<Vec<2>, Vec<2>>> cut_line(const Vec<2>& from, const Vec<2>& to,
                                                  const Box<2>& rect);

class Pen {
 public:
  Pen(DrawList& list, const Box<2>& place) : list_(list), place_(place) {}

  // With a `casing` of the panel's tone under it, a line can be told from what it crosses.
  void line(const Vec<2>& from, const Vec<2>& to, const Stroke& stroke, double casing = 0);
  void path(const std::vector<Vec<2>>& points, bool closed, const Stroke& stroke);
  // A line with a head at its end, `head` long.
  void arrow(const Vec<2>& from, const Vec<2>& to, const Stroke& stroke, double head,
             double casing = 0);
  // Whole or not at all.
  void dot(const Vec<2>& center, double radius, Role fill, const Stroke& stroke = {});
  // A convex polygon.
  void polygon(std::vector<Vec<2>> points, Role fill, const Stroke& stroke = {});
  // Diagonals over a convex polygon, `space` apart along the page's x, leaning right (1) or left
  // (-1). They lie on one grid for the whole page, so that they do not jump when something moves.
  // At most `most` lines: a larger polygon gets a wider spacing.
  void hatch(const std::vector<Vec<2>>& polygon, double space, int lean, const Stroke& stroke,
             int most = 60);

 private:
  DrawList& list_;
  Box<2> place_;
};

// The corners of an arrow's head at `to`, `head` long, its tip first.
std::vector<Vec<2>> arrow_head(const Vec<2>& from, const Vec<2>& to, double head);

// The corners of a regular polygon, or of a circle with enough of them.
std::vector<Vec<2>> ring_of(const Vec<2>& center, double radius, int corners, double turn = 0);

// The mean of the points; the origin if there are none.
Vec<2> middle_of(const std::vector<Vec<2>>& points);

}  // namespace lantern::draw
