// Separating axes: lines beside two bodies, with the bodies' shadows on them.
//
//      a     b
//     ___   /\                 the shadows end where lines across the axis leave the bodies
//    |   | /  \                .
//    |___| \  /                .
//    .   .  \/ .
//    =====..====  gap
//   ---------------> axis
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "draw/body_shapes.hpp"
#include "draw/world/narrow_marks.hpp"
#include "geometry/plane.hpp"

namespace lantern::draw {
namespace {

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
      : separation_(*frame.find<FrameSeparation>()),
        a_(a),
        b_(b),
        map_(map),
        list_(list),
        labels_(labels),
        pen_(list, map.panel()),
        outline_(outline_on_page(a, map)),
        outline_b_(outline_on_page(b, map)) {
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
    double most = -1e300;
    for (const Vec<2>& p : outline_) most = std::max(most, glm::dot(p, way));
    return most;
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
  Pen pen_;
  std::vector<Vec<2>> outline_, outline_b_;  // of both; of the second
  // Of the axis that is being drawn, on the page.
  const FrameAxis* axis_ = nullptr;
  Vec<2> along_{0.0}, side_{0.0};
  double at_ = 0, lowest_ = 0;
  std::array<double, 4> ends_{};
};

}  // namespace

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
