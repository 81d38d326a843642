#include "draw/world/narrow_marks.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "draw/body_shapes.hpp"
#include "draw/number_text.hpp"

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

using frame::FrameSearch;
using frame::SupportPair;

constexpr double kSearched = 46;  // length of the arrow of a search's direction

// Beside a point of a body, away from the other body's point.
void number_point(const std::string& number, const Vec<2>& at, const Vec<2>& away,
                  const View2D& map, Labels& labels) {
  const TextStyle style{kLabel, Weight::semibold, Role::ink, Role::panel};
  const double length = glm::length(away);
  const Vec<2> out = length > 0 ? away / length : Vec<2>(0, -1), side{-out.y, out.x};
  labels.try_add(number,
                 {centred(at + side * 24.0, style), centred(at - side * 24.0, style),
                  centred(at - out * 26.0, style), centred(at + out * 26.0, style)},
                 style, map.panel());
}

void mark_points(const FrameSearch& search, const View2D& map, DrawList& list, Labels& labels) {
  Pen pen(list, map.panel());
  for (const SupportPair& p : simplex_of(search)) {
    const Vec<2> a = map.to_page(p.a), b = map.to_page(p.b);
    const std::string number = search_number(search, p.difference());
    const DrawList::Scope scope(list, "world/searched/" + number);
    pen.line(b, a, {Role::ray, 2.4, 7}, 1.4);
    for (const Vec<2>& end : {a, b}) pen.dot(end, 8, Role::ray, {Role::panel, 2});
    number_point(number, a, a - b, map, labels);
    number_point(number, b, b - a, map, labels);
    list.marks.add(MarkKind::simplex);
  }
}

// From the second body's point to the first one's: the same arrow leads from the origin to the
// point of the difference.
void mark_newest(const FrameSearch& search, const View2D& map, DrawList& list, Labels& labels) {
  if (search.taken || search.answer) return;
  const auto& step = search.steps.back();
  const Vec<2> a = map.to_page(step.found.a), b = map.to_page(step.found.b);
  const Vec<2> d = Vec<2>(step.direction.x, -step.direction.y) * kSearched;
  const DrawList::Scope scope(list, "world/search");
  Pen pen(list, map.panel());
  pen.arrow(b, a, {Role::lit, 4}, 16, 1.8);
  pen.arrow(a, a + d, {Role::ink, 2.6}, 13, 1.6);
  pen.arrow(b, b - d, {Role::ink, 2.6}, 13, 1.6);
  for (const Vec<2>& end : {a, b}) draw_support(end, pen);
  list.marks.add(MarkKind::support);
  const std::string number = search_number(search, step.found.difference());
  number_point(number, a, d, map, labels);
  number_point(number, b, -d, map, labels);
}

void mark_answer(const FrameSearch& search, const View2D& map, DrawList& list, Labels& labels) {
  if (!search.answer || search.answer->overlaps) return;
  const Vec<2> a = map.to_page(search.answer->closest.a), b = map.to_page(search.answer->closest.b);
  const DrawList::Scope scope(list, "world/closest");
  Pen pen(list, map.panel());
  draw_ruler(a, b, {Role::lit, 4.6}, pen);
  list.marks.add(MarkKind::ruler);
  const TextStyle style{kLabel, Weight::semibold, Role::ink, Role::panel};
  const Vec<2> way = b - a, middle = (a + b) / 2.0;
  const double length = glm::length(way);
  const Vec<2> side = length > 0 ? Vec<2>(-way.y, way.x) / length : Vec<2>(0, 1);
  const std::string text = short_number(search.answer->distance);
  labels.try_add(text,
                 {centred(middle + side * 34.0, style), centred(middle - side * 34.0, style),
                  centred(middle + side * 60.0, style), centred(middle - side * 60.0, style)},
                 style, map.panel());
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

const std::vector<SupportPair>& simplex_of(const FrameSearch& search) {
  static const std::vector<SupportPair> none;
  const std::size_t n = search.steps.size();
  if (search.taken || search.answer) return n == 0 ? none : search.steps[n - 1].simplex;
  return n < 2 ? none : search.steps[n - 2].simplex;
}

std::string search_number(const FrameSearch& search, const Vec<2>& difference) {
  const auto found = std::ranges::find(search.steps, difference,
                                       [](const auto& step) { return step.found.difference(); });
  return fmt::format("{}", found - search.steps.begin() + 1);
}

void mark_search(const Frame& frame, const View2D& map, DrawList& list, Labels& labels) {
  const FrameSearch& search = frame.get<FrameSearch>();
  if (search.steps.empty()) return;
  mark_points(search, map, list, labels);
  mark_newest(search, map, list, labels);
  mark_answer(search, map, list, labels);
  list.referents.insert({"gjk_steps", "distance"});
}

}  // namespace lantern::draw
