// Two bodies and what the narrow phase finds of them: shadows on axes, and searches for support
// points.
#pragma once

#include <string>
#include <vector>

#include "draw/marks.hpp"
#include "frame/parts/asked.hpp"

namespace lantern::draw {

// The marks themselves.
void draw_shadow(const Vec<2>& from, const Vec<2>& to, Role role, Pen& pen);
void draw_gap(const Vec<2>& from, const Vec<2>& to, Pen& pen);
void draw_shared_shadow(const Vec<2>& from, const Vec<2>& to, Pen& pen);
void draw_support(const Vec<2>& at, Pen& pen);
void draw_simplex(const std::vector<Vec<2>>& points, Pen& pen);
void draw_origin(const Vec<2>& at, Pen& pen);

// The axes along which the bodies of frame.find<FrameSeparation>() were measured, beside them:
// their shadows, and what lies between these. The newest axis, or the one that answers, with lines
// to the bodies; if it parts them, with a line that fits between; if not, with the shortest way
// out.
void mark_separation(const Frame& frame, const View2D& map, DrawList& list, Labels& labels);

// The support points of frame.find<FrameSearch>() on the bodies, and in the end their closest
// points.
void mark_search(const Frame& frame, const View2D& map, DrawList& list, Labels& labels);

// The number of the search that has found a point, from 1.
std::string search_number(const frame::FrameSearch& search, const Vec<2>& difference);
// The points that the search has between them at this frame.
const std::vector<frame::SupportPair>& simplex_of(const frame::FrameSearch& search);

}  // namespace lantern::draw
