#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <unordered_map>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/body_shapes.hpp"
#include "draw/keys.hpp"
#include "draw/marks.hpp"
#include "draw/number_text.hpp"
#include "draw/world/world3d_parts.hpp"
#include "frame/parts/motion.hpp"
#include "geometry/elementary.hpp"
#include "geometry/not_finite.hpp"

namespace lantern::draw {
namespace {

constexpr std::size_t kMostDrawnLinks = 120;
constexpr std::size_t kMostPoints = 500;
constexpr std::size_t kFewPoints = 60;  // more are drawn smaller
constexpr double kContact = 10;         // half a contact's bar, page units
constexpr double kLeastImpulse = 18, kMostImpulse = 46;

constexpr std::size_t kMostDepths = 60;
constexpr double kNumberBeside = 16;  // between a contact's outermost point and its number

struct Depth {
  double depth = 0;
  Box<2> points;  // of the contact, on the page
};

std::vector<Depth> depths_of(const Frame& frame, const Projection& view) {
  std::vector<Depth> found;
  for (const FrameContact& contact : frame.contacts) {
    Outline points;
    double depth = 0;
    for (const FrameContact::Point& point : contact.points) {
      const auto at = view.seen(point.position);
      if (!at) continue;
      points.push_back(*at);
      depth = std::max(depth, -point.separation);
    }
    if (!points.empty()) found.push_back({depth, box_of(points)});
  }
  std::ranges::stable_sort(found, std::greater(), &Depth::depth);
  if (found.size() > kMostDepths) found.resize(kMostDepths);
  return found;
}

// Of a spring or joint that is stretched, pressed together, or neither: by colour, and the more the
// heavier. `strain` is the change of length, as a part of the length at rest.
Stroke strain_stroke(double strain) {
  constexpr double kRest = 0.005;
  const double size = std::min(std::abs(strain), 1.0);
  if (!(size > kRest)) return {Role::quiet_ink, 2.2};
  return {strain > 0 ? Role::warning : Role::ray, 2.4 + 3.2 * size, 0};
}

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
  const double length = geometry::hypot(way.x, way.y);
  if (!(length > 0)) return;
  const Vec<2> along = way / length, side{-along.y, along.x};
  const auto beside = [&](const Vec<2>& at, const Vec<2>& away, double gap) {
    return centred(at + away * gap, style, away.x > 0.3 ? 0 : away.x < -0.3 ? 1 : 0.5);
  };
  labels.try_add(text, {beside(to, along, 16), beside(middle, -side, 22), beside(middle, side, 22)},
                 style, room);
}

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

std::vector<Vec<2>> spring_bends(const Vec<2>& from, const Vec<2>& to) {
  constexpr int kTurns = 7;
  const Vec<2> way = to - from;
  const double length = geometry::hypot(way.x, way.y);
  if (!(length > 1)) return {};
  const Vec<2> along = way / length, side{-along.y, along.x};
  const double end = std::min(0.17 * length, 26.0), reach = std::clamp(0.09 * length, 3.0, 10.0);
  std::vector<Vec<2>> points{from, from + along * end};
  for (int i = 0; i < 2 * kTurns; ++i) {
    const double at = end + (length - 2 * end) * (i + 0.5) / (2 * kTurns);
    points.push_back(from + along * at + side * (i % 2 == 0 ? reach : -reach));
  }
  points.insert(points.end(), {to - along * end, to});
  return points;
}

void mark_links(const Frame& frame, Marks& marks) {
  for (const FrameLink& link : first_of(frame.get<FrameLinks>().links, kMostDrawnLinks)) {
    const auto number =
        &link - frame.get<FrameLinks>().links.data();  // of the scenario's springs and joints
    const Marks::Scope scope(marks, fmt::format("world/link/{}", number));
    const Stroke stroke = strain_stroke(link.strain);
    constexpr MarkKind kKinds[] = {MarkKind::spring, MarkKind::rod, MarkKind::pin};
    marks.tell(kKinds[static_cast<std::size_t>(link.kind)]);
    if (link.kind == FrameLink::Kind::pin) {
      marks.line(link.from, link.to, {Role::ink, 1.6});
      marks.dot(link.to, 7.5, Role::panel, {Role::ink, 2.6});
      marks.dot(link.to, 2, Role::ink);
      marks.tell(MarkKind::pin);
      continue;
    }
    if (link.kind == FrameLink::Kind::spring)
      marks.spring(link.from, link.to, stroke);
    else
      marks.line(link.from, link.to, {stroke.role, std::max(3.0, stroke.width)}, 1.6);
    for (const Vec<3>& end : {link.from, link.to}) marks.dot(end, 5, Role::ink, {Role::panel, 1.6});
  }
}

void draw_contact(const Vec<2>& at, const Vec<2>& normal, double k, Pen& pen) {
  const double length = geometry::hypot(normal.x, normal.y);
  const Vec<2> half = (length > 0 ? normal / length : Vec<2>(0, -1)) * (kContact * k);
  pen.line(at - half, at + half, {Role::contact, 5.2 * k}, 1.8 * k);
}

void draw_beginning(const Vec<2>& at, double k, Pen& pen) {
  pen.dot(at, 14 * k, Role::none, {Role::contact, 2 * k});
}

void draw_impulse(const Vec<2>& from, const Vec<2>& to, double k, Pen& pen) {
  pen.arrow(from, to, {Role::contact, 2.4 * k}, 11 * k, 1.2 * k);
}

// How large the moving bodies are: of each id the longest side of its box, world units.
using Sizes = std::unordered_map<BodyId, double>;

Sizes sizes_of_moving(const Frame& frame) {
  Sizes sizes;
  for (const FrameBody& body : frame.bodies) {
    const Vec<3> size = body.box.size();
    if (!body.is_static) sizes[body.id] = std::max({size.x, size.y, size.z});
  }
  return sizes;
}

// Marks of small bodies are small: else they would hide them.
double mark_scale(const FrameContact& contact, const Vec<3>& at, const Sizes& sizes,
                  const Projection& view, double k) {
  constexpr double kWide = 1.5;   // as many times the body as the longest arrow is long
  constexpr double kLeast = 0.2;  // below this nothing can be told apart
  for (const BodyId id : {contact.pair.a, contact.pair.b})
    if (const auto size = sizes.find(id); size != sizes.end())
      k = std::min(k, kWide * size->second * view.scale_at(at) / kMostImpulse);
  return std::max(k, kLeast);
}

bool mark_contacts(const Frame& frame, const Marks& marks) {
  std::size_t points = 0, pushing = 0;
  double most = 0;  // impulse
  for (const FrameContact& contact : frame.contacts)
    for (const FrameContact::Point& point : contact.points) {
      ++points;
      if (!std::isfinite(point.impulse)) continue;
      most = std::max(most, point.impulse);
      pushing += point.impulse > 0;
    }
  const double most_scale = points > kFewPoints ? 0.6 : 1;
  const Sizes sizes = sizes_of_moving(frame);
  const Projection& view = marks.projection();
  Pen pen = marks.over();
  std::size_t drawn = 0;
  for (const FrameContact& contact : frame.contacts) {
    const std::string key = fmt::format("world/contact/{}/{}", contact.pair.a, contact.pair.b);
    const Marks::Scope scope(marks, key, key);
    for (const FrameContact::Point& point : contact.points) {
      if (++drawn > kMostPoints) return false;
      const auto at = view.seen(point.position);
      if (!at) continue;
      const auto beside = view.seen(
          point.position + contact.normal * (kMostImpulse / view.scale_at(point.position)));
      const Vec<2> normal = beside ? *beside - *at : Vec<2>(0, -1);
      const double k = mark_scale(contact, point.position, sizes, view, most_scale);
      draw_contact(*at, normal, k, pen);
      if (contact.begins) draw_beginning(*at, k, pen);
      if (!(point.impulse > 0) || !(most > 0)) continue;
      const double share = std::min(1.0, point.impulse / most);
      const double length = kLeastImpulse + (kMostImpulse - kLeastImpulse) * share;
      draw_impulse(*at, *at + normal * (k * length / kMostImpulse), k, pen);
    }
  }
  if (points == 0) return true;
  marks.tell(MarkKind::contact);
  if (pushing > 0) marks.tell(MarkKind::impulse);
  if (std::ranges::any_of(frame.contacts, &FrameContact::begins))
    marks.tell(MarkKind::contact_begins);
  return true;
}

std::string depth_text(double depth) {
  if (!(depth >= 0.995e-9)) return "0";  // rounding of places, not depth
  static constexpr struct {
    double size;
    double from;  // depths, so that nothing is rounded up to the next unit
    const char* name;
  } kUnits[] = {{1, 0.995, "m"},
                {0.01, 0.0995, "cm"},
                {1e-3, 0.995e-4, "mm"},
                {1e-6, 0.995e-6, "µm"},
                {1e-9, 0, "nm"}};
  for (const auto& unit : kUnits) {
    if (depth < unit.from) continue;
    const double number = depth / unit.size;
    const int decimals = number < 0.995 ? 2 : number < 9.95 ? 1 : 0;
    return decimal(fmt::format("{:.{}f} {}", number, decimals, unit.name));
  }
  return "0";
}

void write_depths(const Frame& frame, const Projection& view, const std::vector<Box<2>>& bodies,
                  Labels& labels) {
  if (!frame.display.depths) return;
  const TextStyle style{kLabel, Weight::semibold, Role::contact, Role::panel};
  const Box<2>& panel = view.panel();
  const Box<2> room = shrunk(panel, 4);
  for (const Depth& d : depths_of(frame, view)) {
    const std::string text = depth_text(d.depth);
    // Above the line on which one lies on the other, or else below it, or across it.
    const double above = d.points.center().y - 7, below = d.points.center().y + style.size;
    const double middle = d.points.center().y + 0.36 * style.size;
    const double right = d.points.hi.x + kNumberBeside, left = d.points.lo.x - kNumberBeside;
    double far_right = right,
           far_left = left;  // beside the bodies that touch there
    for (const Box<2>& body : bodies) {
      if (!overlap(body, d.points)) continue;
      far_right = std::max(far_right, body.hi.x + kNumberBeside);
      far_left = std::min(far_left, body.lo.x - kNumberBeside);
    }
    const Anchor anchors[] = {{{right, above}, 0},      {{left, above}, 1},     {{right, below}, 0},
                              {{left, below}, 1},       {{right, middle}, 0},   {{left, middle}, 1},
                              {{far_right, middle}, 0}, {{far_left, middle}, 1}};
    for (const bool clear : {true, false})
      if (labels.try_add(text, anchors, style, room, panel,
                         [&](const Box<2>& extent) { return !clear || !touches(bodies, extent); }))
        break;
  }
}

// Velocities and forces as arrows, and lengths as rulers.

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

void mark_spins(const Frame& frame, Marks& marks) {
  constexpr int kParts = 14;
  if (!frame.display.arrows || frame.bodies.size() > kMostArrows) return;
  const double out = 0.05 * marks.projection().size();
  for (const FrameBody& body : frame.bodies) {
    const double spin = glm::length(body.angular_velocity);
    if (is_half_space(body) || body.asleep || !std::isfinite(spin) || !(spin > 1e-3)) continue;
    const Marks::Scope scope(marks, body_key("world/spin", body));
    const Convex space = Convex::of(body);
    const Vec<3> axis = body.angular_velocity / spin, side = across(axis);
    const Vec<3> end = axis * (glm::length(space.half) + space.radius + out);
    marks.line(body.position - end, body.position + end, kSpinStroke, 1.2);
    const auto round = [&](int part) {  // three quarters of a turn
      const double angle = 1.5 * std::numbers::pi * part / kParts;
      return body.position + end - axis * out +
             (side * geometry::cos(angle) + glm::cross(axis, side) * geometry::sin(angle)) * out;
    };
    for (int i = 1; i < kParts; ++i) marks.line(round(i - 1), round(i), kSpinStroke);
    marks.arrow(round(kParts - 1), round(kParts), kSpinStroke, kSpinHead, 0);
    marks.tell(MarkKind::spin);
    std::array<int, 3> axes{0, 1, 2};
    std::ranges::sort(axes, std::greater(), [&](int i) { return space.half[i]; });
    if (space.half[axes[2]] == space.half[axes[0]]) continue;  // a ball or a cube
    for (int rank = 0; rank < 3; ++rank) {  // on one side: which end is up is seen
      const int i = axes[static_cast<std::size_t>(rank)];
      const Vec<3> face = body.position + space.axes[i] * space.half[i];
      marks.line(face, face + space.axes[i] * (2 * out), own_axis_stroke(rank));
      marks.tell(static_cast<MarkKind>(static_cast<int>(MarkKind::longest_axis) + rank));
    }
  }
}

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
  const double length = geometry::hypot(way.x, way.y);
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
    const double length = geometry::hypot(way.x, way.y);
    if (!(length > 1)) continue;
    const Vec<2> side = Vec<2>(-way.y, way.x) / length;
    const Vec<2> off = side * (side.x < 0 ? -kBeside : kBeside);
    Pen pen = marks.over();
    draw_ruler(*a + off, *b + off, {Role::ink, 2.2}, pen);
    marks.tell(MarkKind::ruler);
    std::string text = short_number(ruler.length);
    if (ruler.before && std::isfinite(*ruler.before) && ruler.length > 0) {
      const double change = ruler.length - *ruler.before;
      const std::string by = short_number(std::abs(change));
      text = change == 0  ? word("as long as before")
             : change > 0 ? say("{} longer", by)
                          : say("{} shorter", by);
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
