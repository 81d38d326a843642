// Bodies by their ids, the outlines of their collision volumes on the page, and bodies as
// characters, made of few shapes and points in any size.
#pragma once

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "frame/frame.hpp"
#include "geometry/plane.hpp"

namespace lantern::draw {

inline bool is_half_space(const FrameBody& body) {
  return std::holds_alternative<HalfSpace<3>>(body.shape);
}

inline bool is_character(const FrameBody& body) {
  return body.look == Look::ghost || body.look == Look::player || body.look == Look::person ||
         body.look == Look::demon;
}

// The ground of a node that the step is about, or has passed.
inline Role ground_of(Mark mark) {
  if (mark == Mark::lit) return Role::lit_fill;
  return mark == Mark::passed ? Role::passed_fill : Role::panel;
}

// In a tree of many leaves that are nearly all lit the marks tell nothing.
inline bool is_nearly_all_lit(const std::vector<FrameNode>& nodes) {
  constexpr std::size_t kMany = 200;
  std::size_t leaves = 0, lit = 0;
  for (const FrameNode& node : nodes) {
    leaves += node.leaf;
    lit += node.leaf && node.mark == Mark::lit;
  }
  return nodes.size() > kMany && 10 * lit > 7 * leaves;
}
// Has a ray, view or region left it out, and not already what is above it?
inline bool is_topmost_skipped(const FrameNode& node, const Frame& frame) {
  return node.skipped && (node.parent == kNone || !frame.nodes[node.parent].skipped);
}
// The level in a leaf that is shown as a bucket, within its box; nothing where none is shown.
inline std::optional<Box<2>> level_in(const Frame& frame, const FrameNode& node, Box<2> box) {
  if (!frame.display.fill || frame.get<FrameStructure>().capacity == 0 || !node.leaf ||
      node.bodies.empty())
    return {};
  const double share =
      static_cast<double>(node.bodies.size()) / frame.get<FrameStructure>().capacity;
  box.lo.y = box.hi.y - std::min(share, 1.0) * box.size().y;
  return box;
}

using BodiesById = std::unordered_map<BodyId, const FrameBody*>;
BodiesById by_id(const std::vector<FrameBody>& bodies);
// Null if it is none of them.
inline const FrameBody* body_of(const BodiesById& bodies, BodyId id) {
  const auto found = bodies.find(id);
  return found == bodies.end() ? nullptr : found->second;
}

// The point of a half-space's surface that is nearest to a point.
Vec<3> foot_on(const FrameBody& ground, const Vec<3>& point);

// Where a pair's link ends at this body: its centre, or the place of the ground nearest to the
// other one.
Vec<3> link_end(const FrameBody& body, const FrameBody& other);

// The outline of a box or capsule that turns, when the body's box fills `place`; convex. Empty for
// any other shape.
std::vector<Vec<2>> turned_outline(const FrameBody& body, const Box<2>& place);

// The surface of a half-space through this point of the page; the solid is behind it.
Plane<2> page_surface(const FrameBody& body, const Vec<2>& through);

// Its colour: of a sleeping one, of furniture that never moves, or its own.
Role fill_of(const FrameBody& body);

// Draws the body so that it fills `place` (page units). Eyes and mouth turn along its velocity.
// Below some 14 units across, and when `plain`, a body is one simple shape.
void draw_character(const FrameBody& body, const Box<2>& place, bool plain, DrawList& list);

// The same in a part of `place`: a bat stays long and thin, down to a third. Nothing for null.
void draw_icon(const FrameBody* body, const Box<2>& place, DrawList& list);
// The emblem of a colour around `center`: what tells colours apart without colour.
void draw_emblem(int color, const Vec<2>& center, double radius, DrawList& list);

// The letter of sleep, in this box.
void draw_z(const Box<2>& box, const Stroke& stroke, DrawList& list);
// "z z", for what sleeps; the first letter's upper left corner lies `unit` / 5 under `corner`.
void draw_zz(const Vec<2>& corner, double unit, double width, DrawList& list);

}  // namespace lantern::draw
