#include "draw/world/narrow_marks.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "draw/body_shapes.hpp"
#include "draw/number_text.hpp"
#include "geometry/plane.hpp"

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

// Separating axes: lines beside two bodies, with the bodies' shadows on them.
//
//      a     b
//     ___   /\                 the shadows end where lines across the axis leave the bodies
//    |   | /  \                .
//    |___| \  /                .
//    .   .  \/ .
//    =====..====  gap
//   ---------------> axis
constexpr double kAxisBeside = 60;  // from the bodies to the axis
constexpr double kTrack = 9;        // from the axis to the middle of a shadow
constexpr double kBeyond = 26;      // of the axis, beyond the shadows
constexpr double kNormal = 44;      // length of a face's normal

std::vector<Vec<2>> outline_on_page(const FrameBody& body, const View2D& map) {
  const Box<2> place = map.to_page(body.box);
  std::vector<Vec<2>> outline = turned_outline(body, place);
  if (!outline.empty()) return outline;
  if (std::holds_alternative<Sphere>(body.shape))
    return ring_of(place.center(), place.size().x / 2, 48);
  return polygon_of(place);
}

class SeparationMarks {
 public:
  SeparationMarks(const Frame& frame, const FrameBody& a, const FrameBody& b, const View2D& map,
                  DrawList& list, Labels& labels)
      : separation_(frame.get<FrameSeparation>()),
        a_(a),
        b_(b),
        map_(map),
        list_(list),
        labels_(labels) {
    outline_.insert(outline_.end(), outline_b_.begin(), outline_b_.end());
  }

  void draw() {
    const std::size_t front = separation_.answer.value_or(separation_.axes.size() - 1);
    for (std::size_t i = 0; i < separation_.axes.size(); ++i) {
      const DrawList::Scope scope(list_, fmt::format("world/axis/{}", i));
      set(separation_.axes[i]);
      draw_axis(i, i == front);
      if (i == front && separation_.answer) draw_answer();
    }
  }

 private:
  // The axis to draw. Those across faces of the first body lie below it or on its left, so that
  // they leave room for the others.
  void set(const FrameAxis& axis) {
    axis_ = &axis;
    along_ = {axis.direction.x, -axis.direction.y};
    side_ = {-along_.y, along_.x};
    const bool below = axis.across == a_.id;
    if ((side_.y - 0.9 * side_.x > 0) != below) side_ = -side_;
    lowest_ = reach(-side_), at_ = reach(side_) + kAxisBeside;
    for (std::size_t i = 0; i < 4; ++i) ends_[i] = glm::dot(map_.to_page(axis.ends[i]), along_);
  }

  double reach(const Vec<2>& way) const {
    return greatest_of<double>(-1e300, outline_, [&](const Vec<2>& p) { return glm::dot(p, way); });
  }
  // The point of the axis, or so far beside it.
  Vec<2> on_axis(double along, double beside = 0) const {
    return along_ * along + side_ * (at_ + beside);
  }

  void draw_axis(std::size_t number, bool front) {
    if (front) draw_drop_lines();
    const double from = std::min(ends_[0], ends_[2]) - kBeyond;
    const double to = std::max(ends_[1], ends_[3]) + kBeyond;
    const Stroke stroke = front ? Stroke{Role::ink, 2.6} : Stroke{Role::quiet_ink, 1.8};
    pen_.arrow(on_axis(from), on_axis(to), stroke, 14);
    draw_shadow(on_axis(ends_[0], -kTrack), on_axis(ends_[1], -kTrack), body_role(a_.color), pen_);
    draw_shadow(on_axis(ends_[2], kTrack), on_axis(ends_[3], kTrack), body_role(b_.color), pen_);
    list_.marks.add(MarkKind::shadow);
    const bool apart = axis_->separation > 0;
    const Vec<2> first = on_axis(ends_[1]), second = on_axis(ends_[2]);
    if (apart)
      draw_gap(first, second, pen_);
    else
      draw_shared_shadow(second, first, pen_);
    list_.marks.add(apart ? MarkKind::shadow_gap : MarkKind::shadow_overlap);
    write(fmt::format("{}", number + 1), on_axis(to), front);
    if (front && axis_->face.size() == 2) draw_face();
  }

  void draw_drop_lines() {
    for (std::size_t i = 0; i < 4; ++i)
      pen_.line(map_.to_page(axis_->ends[i]), on_axis(ends_[i], i < 2 ? -kTrack : kTrack),
                {Role::quiet_ink, 1.8, 6});
  }

  // The face that the axis stands on, and its normal.
  void draw_face() {
    const Vec<2> first = map_.to_page(axis_->face[0]), second = map_.to_page(axis_->face[1]);
    const Vec<2> middle = (first + second) / 2.0;
    const Vec<2> out = along_ * (axis_->across == a_.id ? kNormal : -kNormal);
    pen_.line(first, second, {Role::lit, 7}, 1.6);
    pen_.arrow(middle, middle + out, {Role::lit, 4}, 15, 1.6);
  }

  // Where the axis ends.
  void write(const std::string& number, const Vec<2>& end, bool front) {
    const TextStyle style{kLabel, Weight::semibold, front ? Role::ink : Role::quiet_ink,
                          Role::panel};
    const Anchor anchors[] = {
        centred(end + along_ * 18.0, style), centred(end + side_ * 22.0, style),
        centred(end - side_ * 22.0, style), centred(end + along_ * 40.0, style)};
    labels_.try_add(number, anchors, style, shrunk(map_.panel(), 2), map_.panel(),
                    [](const Box<2>&) { return true; });
  }

  void draw_answer() {
    if (axis_->separation > 0) {  // a line fits between them
      const double middle = (ends_[1] + ends_[2]) / 2;
      pen_.line(along_ * middle - side_ * (lowest_ + 30), on_axis(middle, -kShadowRoom),
                {Role::lit, 3.6, 12});
      return;
    }
    const Vec<2> way = along_ * (ends_[1] - ends_[2]);
    std::vector<Vec<2>> moved = outline_b_;
    for (Vec<2>& p : moved) p += way;
    pen_.path(moved, true, {Role::lit, 2.8, 8});
    const Vec<2> from = middle_of(outline_b_);
    pen_.arrow(from, from + way, {Role::lit, 4.6}, 16, 1.8);
  }

  static constexpr double kShadowRoom = 22;

  const FrameSeparation& separation_;
  const FrameBody& a_;
  const FrameBody& b_;
  const View2D& map_;
  DrawList& list_;
  Labels& labels_;
  Pen pen_{list_, map_.panel()};
  std::vector<Vec<2>> outline_ = outline_on_page(a_, map_);    // of both
  std::vector<Vec<2>> outline_b_ = outline_on_page(b_, map_);  // of the second
  // Of the axis that is being drawn, on the page.
  const FrameAxis* axis_ = nullptr;
  Vec<2> along_{0.0}, side_{0.0};
  double at_ = 0, lowest_ = 0;
  std::array<double, 4> ends_{};
};

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

void mark_separation(const Frame& frame, const View2D& map, DrawList& list, Labels& labels) {
  if (!frame.find<FrameSeparation>() || frame.find<FrameSeparation>()->axes.empty()) return;
  const BodiesById bodies = by_id(frame.bodies);
  const auto a = bodies.find(frame.find<FrameSeparation>()->a),
             b = bodies.find(frame.find<FrameSeparation>()->b);
  if (a == bodies.end() || b == bodies.end()) return;
  SeparationMarks(frame, *a->second, *b->second, map, list, labels).draw();
  list.referents.insert({"axes_tested", "gap", "overlap"});
}

}  // namespace lantern::draw
