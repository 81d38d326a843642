// What an in-between does with one shape, or with two that are the same thing.
#pragma once

#include <string>
#include <utility>

#include "draw/draw_list.hpp"

namespace lantern::draw {

// What the shape covers, without its stroke.
Box<2> extent_of(const DrawShape& shape);

// Equal for shapes that are drawn in one way, wherever they are: kind, roles, dashes, words.
std::string style_of(const DrawShape& shape);

// Can the one become the other by degrees? They are of one kind; polygons have equally many
// corners, lines are both dashed or both not, texts say the same.
bool can_blend(const DrawShape& a, const DrawShape& b);

// On the way from `a`, at 0, to `b`, at 1. They must be able to.
std::pair<DrawShape, Tint> blend(const DrawShape& a, const DrawShape& b, double share);

// The shape where it is when the box `from` is put upon the box `to`: moved, and as much larger or
// smaller. Of a box without width only the middle counts along that axis.
DrawShape put(DrawShape shape, const Box<2>& from, const Box<2>& to);

inline double mix(double a, double b, double share) { return a + (b - a) * share; }
inline Box<2> mix(const Box<2>& a, const Box<2>& b, double share) {
  return {a.lo + (b.lo - a.lo) * share, a.hi + (b.hi - a.hi) * share};
}

}  // namespace lantern::draw
