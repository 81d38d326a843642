// Velocities and forces as arrows, and lengths as rulers.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "draw/body_shapes.hpp"
#include "draw/keys.hpp"
#include "draw/marks.hpp"
#include "draw/number_text.hpp"
#include "frame/parts/motion.hpp"
#include "geometry/not_finite.hpp"

namespace lantern::draw {
namespace {

constexpr std::size_t kMostArrows = 300;
constexpr std::size_t kMostForces = 60;

// The part of its greatest length that a velocity's arrow has, in a world `extent` long. Speeds
// far above the world's measure are pressed together, so that the scale depends on no other body
// and an arrow changes from frame to frame only as its own body does.
double arrow_share(double speed, double extent) {
  const double half = 0.12 * extent;  // this far in a second: half the length
  return speed > 0 && half > 0 ? speed / (speed + half) : 0;
}

// How far it is from a body's centre to its outline, along a unit vector of the world; of a shape
// that turns, to its box.
double reach_of_body(const FrameBody& body, const Vec<3>& way) {
  if (const auto* ball = std::get_if<Sphere>(&body.shape)) return ball->radius;
  const Vec<3> half = body.box.size() * 0.5;
  double reach = std::numeric_limits<double>::max();
  for (int i = 0; i < 3; ++i)
    if (std::abs(way[i]) > 1e-12) reach = std::min(reach, half[i] / std::abs(way[i]));
  return reach < std::numeric_limits<double>::max() ? reach : 0;
}

// "40 N", beside the middle of an arrow of the page, else at its tip.
void write_size(const std::string& text, const Vec<2>& from, const Vec<2>& to, Role role,
                const Box<2>& room, Labels& labels) {
  const TextStyle style{std::max(kLabel, 22.0), Weight::semibold, role, Role::panel};
  const Vec<2> way = to - from, middle = (from + to) / 2.0;
  const double length = std::hypot(way.x, way.y);
  if (!(length > 0)) return;
  const Vec<2> along = way / length, side{-along.y, along.x};
  const Anchor tip = centred(to + along * 16.0, style,
                             along.x > 0.3    ? 0
                             : along.x < -0.3 ? 1
                                              : 0.5);
  const Anchor left = centred(middle - side * 22.0, style,
                              side.x > 0.3    ? 1
                              : side.x < -0.3 ? 0
                                              : 0.5);
  const Anchor right = centred(middle + side * 22.0, style,
                               side.x > 0.3    ? 0
                               : side.x < -0.3 ? 1
                                               : 0.5);
  labels.try_add(text, {tip, left, right}, style, room);
}

}  // namespace

void mark_velocities(const Frame& frame, Marks& marks) {
  constexpr double kLeastShare =
      1.0 / 12;                     // of the longest arrow: slower ones are as good as still
  constexpr double kLongest = 0.6;  // of what the picture has room for
  if (!frame.display.arrows || frame.bodies.size() > kMostArrows) return;
  const Projection& view = marks.projection();
  for (const FrameBody& body : frame.bodies) {
    const double speed = glm::length(body.velocity);
    if (is_half_space(body) || body.asleep || !std::isfinite(speed) || !(speed > 1e-12)) continue;
    const double share = arrow_share(speed, view.size());
    if (!(share > kLeastShare)) continue;
    const Marks::Scope scope(marks, body_key("world/velocity", body));
    const Vec<3> way = body.velocity / speed;
    const Vec<3> from = body.position + way * reach_of_body(body, way);
    marks.arrow(from, from + way * (share * kLongest * view.longest_arrow()), kVelocityStroke,
                kVelocityHead, 1.2);
    marks.tell(MarkKind::velocity);
  }
}

namespace {

struct ForceArrow {
  Vec<3> from{0.0};
  Vec<3> to{0.0};
  double size = 0;  // N
};

// Those that are not too small to be seen beside the largest one.
std::vector<ForceArrow> force_arrows(const Frame& frame, const Projection& view) {
  constexpr double kLeast = 0.35, kLeastSize = 0.02;  // of the largest
  std::vector<ForceArrow> arrows;
  const auto forces = first_of(frame.get<FrameForces>().forces, kMostForces);
  double most = 0;
  for (const FrameForce& f : forces)
    if (is_finite(f.force)) most = std::max(most, glm::length(f.force));
  for (const FrameForce& f : forces) {
    const double size = glm::length(f.force);
    if (!is_finite(f.force) || !(size > kLeastSize * most)) continue;
    const Vec<3> way = f.force / size;
    const FrameBody* body = frame.body_of(f.body);
    // At a body's centre it would be hidden by the body.
    const bool central = body && glm::distance(f.at, body->position) < 1e-9;
    const Vec<3> from = central ? f.at + way * reach_of_body(*body, way) : f.at;
    const double length = (kLeast + (1 - kLeast) * size / most) * view.longest_arrow();
    arrows.push_back({from, from + way * length, size});
  }
  return arrows;
}

}  // namespace

void mark_forces(const Frame& frame, Marks& marks) {
  for (const ForceArrow& arrow : force_arrows(frame, marks.projection())) {
    marks.arrow(arrow.from, arrow.to, kForceStroke, kForceHead, 1.6);
    marks.tell(MarkKind::force);
  }
}

void write_forces(const Frame& frame, const Projection& view, Labels& labels) {
  for (const ForceArrow& arrow : force_arrows(frame, view))
    if (const auto a = view.seen(arrow.from), b = view.seen(arrow.to); a && b)
      write_size(short_number(arrow.size) + " N", *a, *b, kForceStroke.role, view.panel(), labels);
}

void draw_ruler(const Vec<2>& from, const Vec<2>& to, const Stroke& stroke, Pen& pen) {
  const Vec<2> way = to - from;
  const double length = std::hypot(way.x, way.y);
  if (!(length > 0)) return;
  const Vec<2> across = Vec<2>(-way.y, way.x) / length * 9.0;
  pen.line(from, to, stroke, 1.6);
  for (const Vec<2>& end : {from, to}) pen.line(end - across, end + across, stroke, 1.6);
}

void mark_rulers(const Frame& frame, Marks& marks, Labels& labels) {
  constexpr double kBeside = 40;  // from the line between the two points to the ruler
  const Projection& view = marks.projection();
  for (const FrameRuler& ruler : frame.get<FrameRulers>().rulers) {
    const auto a = view.seen(ruler.from), b = view.seen(ruler.to);
    if (!a || !b || !is_finite(*a) || !is_finite(*b)) continue;
    const Vec<2> way = *b - *a;
    const double length = std::hypot(way.x, way.y);
    if (!(length > 1)) continue;
    const Vec<2> side = Vec<2>(-way.y, way.x) / length;
    const Vec<2> off = side * (side.x < 0 ? -kBeside : kBeside);
    Pen pen = marks.over();
    draw_ruler(*a + off, *b + off, {Role::ink, 2.2}, pen);
    marks.tell(MarkKind::ruler);
    std::string text = short_number(ruler.length);
    if (ruler.before && std::isfinite(*ruler.before) && ruler.length > 0) {
      const double change = ruler.length - *ruler.before;
      text = change == 0 ? "as long as before"
                         : fmt::format("{} {}", short_number(std::abs(change)),
                                       change > 0 ? "longer" : "shorter");
      const Vec<2> end = *a + way * (*ruler.before / ruler.length);
      draw_ruler(*a + off * 1.8, end + off * 1.8, {Role::quiet_ink, 1.8, 6}, pen);
    }
    if (!ruler.text.empty()) text = ruler.text + " " + text;
    const TextStyle style{std::max(kLabel, 22.0), Weight::semibold, Role::ink, Role::panel};
    const double far = ruler.before ? 2.6 : 1.8;
    const Vec<2> middle = (*a + *b) / 2.0;
    const double align = std::abs(off.x) > 8 ? 0 : 0.5;
    labels.try_add(text,
                   {centred(middle + off * far, style, align),
                    centred(middle - off, style, align > 0 ? 0.5 : 1),
                    centred(*b + way / length * 24.0, style, 0.5)},
                   style, view.panel());
  }
}

}  // namespace lantern::draw
