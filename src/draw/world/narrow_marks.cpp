#include "draw/world/narrow_marks.hpp"

namespace lantern::draw {
namespace {

constexpr double kShadow = 6;    // half of a shadow's width
constexpr double kShared = 19;   // half of the frame round what two shadows share
constexpr double kGapTick = 15;  // half of the tick at a gap's end

Vec<2> unit(const Vec<2>& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : Vec<2>(1, 0);
}

std::vector<Vec<2>> strip(const Vec<2>& from, const Vec<2>& to, double half) {
  const Vec<2> n = unit(to - from), side = Vec<2>(-n.y, n.x) * half;
  return {from + side, to + side, to - side, from - side};
}

}  // namespace

void draw_shadow(const Vec<2>& from, const Vec<2>& to, Role role, Pen& pen) {
  pen.polygon(strip(from, to, kShadow), role, {Role::body_line, 1.6});
}

void draw_gap(const Vec<2>& from, const Vec<2>& to, Pen& pen) {
  const Vec<2> n = unit(to - from), tick = Vec<2>(-n.y, n.x) * kGapTick;
  pen.line(from, to, {Role::lit, 5}, 2);
  for (const Vec<2>& end : {from, to}) pen.line(end - tick, end + tick, {Role::lit, 3.4}, 1.5);
}

void draw_shared_shadow(const Vec<2>& from, const Vec<2>& to, Pen& pen) {
  const std::vector<Vec<2>> frame = strip(from, to, kShared);
  pen.path(frame, true, {Role::panel, 5.6});
  pen.path(frame, true, {Role::pair, 3});
}

void draw_support(const Vec<2>& at, Pen& pen) { pen.dot(at, 9, Role::lit, {Role::panel, 2}); }

void draw_simplex(const std::vector<Vec<2>>& points, Pen& pen) {
  if (points.size() > 1) pen.path(points, points.size() > 2, {Role::ray, 4.6});
  for (const Vec<2>& p : points) pen.dot(p, 8, Role::ray, {Role::panel, 2});
}

void draw_origin(const Vec<2>& at, Pen& pen) {
  pen.dot(at, 10, Role::panel, {Role::ink, 2.8});
  pen.dot(at, 3.4, Role::ink);
}

bool draw_narrow_sample(MarkKind kind, const Vec<2>& left, const Vec<2>& right, Pen& pen) {
  const Vec<2> c = (left + right) / 2.0, a{left.x + 8, left.y}, b{right.x - 8, right.y};
  switch (kind) {
    case MarkKind::shadow:
      draw_shadow(left, right, body_role(4), pen);
      return true;
    case MarkKind::shadow_gap:
      draw_gap(a, b, pen);
      return true;
    case MarkKind::shadow_overlap:
      draw_shared_shadow(a, b, pen);
      return true;
    case MarkKind::support:
      draw_support(c, pen);
      return true;
    case MarkKind::simplex:
      draw_simplex({a, b}, pen);
      return true;
    case MarkKind::origin:
      draw_origin(c, pen);
      return true;
    default:
      return false;
  }
}

}  // namespace lantern::draw
