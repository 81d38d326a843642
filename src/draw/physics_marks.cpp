#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "draw/body_shapes.hpp"
#include "draw/marks.hpp"

namespace lantern {
namespace {

constexpr std::size_t kMostDrawnLinks = 120;
constexpr std::size_t kMostArrows = 300;
constexpr std::size_t kMostPoints = 500;
constexpr std::size_t kFewPoints = 60;  // more are drawn smaller
constexpr double kNormal = 24;          // page units
constexpr double kLeastImpulse = 20, kMostImpulse = 92;

constexpr std::size_t kMostDepths = 60;
constexpr double kNumberBeside = 16;  // between a contact's outermost point and its number

struct Depth {
  double depth = 0;
  Box<2> points;  // of the contact, on the page
};

std::vector<Depth> depths_of(const Frame& frame, const Projection& view) {
  std::vector<Depth> found;
  for (const FrameContact& contact : frame.contacts) {
    Depth d;
    bool seen = false;
    for (const FrameContact::Point& point : contact.points) {
      const auto at = view.seen(point.position);
      if (!at) continue;
      d.points =
          seen ? Box<2>{glm::min(d.points.lo, *at), glm::max(d.points.hi, *at)} : Box<2>{*at, *at};
      d.depth = std::max(d.depth, -point.separation);
      seen = true;
    }
    if (seen) found.push_back(d);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Depth& a, const Depth& b) { return a.depth > b.depth; });
  if (found.size() > kMostDepths) found.resize(kMostDepths);
  return found;
}

}  // namespace

std::vector<Vec<2>> spring_bends(const Vec<2>& from, const Vec<2>& to) {
  constexpr int kTurns = 7;
  const Vec<2> way = to - from;
  const double length = std::hypot(way.x, way.y);
  if (!(length > 1)) return {};
  const Vec<2> along = way / length, side{-along.y, along.x};
  const double end = std::min(0.17 * length, 26.0), reach = std::clamp(0.09 * length, 3.0, 10.0);
  std::vector<Vec<2>> points{from, from + along * end};
  for (int i = 0; i < 2 * kTurns; ++i) {
    const double at = end + (length - 2 * end) * (i + 0.5) / (2 * kTurns);
    points.push_back(from + along * at + side * (i % 2 == 0 ? reach : -reach));
  }
  points.push_back(to - along * end);
  points.push_back(to);
  return points;
}

void mark_links(const Frame& frame, Marks& marks) {
  for (const FrameLink& link : first_of(frame.links, kMostDrawnLinks)) {
    const Stroke stroke = strain_stroke(link.strain);
    switch (link.kind) {
      case FrameLink::Kind::pin:
        marks.line(link.from, link.to, {Role::ink, 1.6});
        marks.dot(link.to, 7.5, Role::panel, {Role::ink, 2.6});
        marks.dot(link.to, 2, Role::ink);
        continue;
      case FrameLink::Kind::spring:
        marks.spring(link.from, link.to, stroke);
        break;
      case FrameLink::Kind::distance:
        marks.line(link.from, link.to, {stroke.role, std::max(3.0, stroke.width)}, 1.6);
        break;
    }
    for (const Vec<3>& end : {link.from, link.to}) marks.dot(end, 5, Role::ink, {Role::panel, 1.6});
  }
}

bool mark_contacts(const Frame& frame, const Marks& marks) {
  std::size_t points = 0;
  double most = 0;  // impulse
  for (const FrameContact& contact : frame.contacts)
    for (const FrameContact::Point& point : contact.points) {
      ++points;
      if (std::isfinite(point.impulse)) most = std::max(most, point.impulse);
    }
  const double k = points > kFewPoints ? 0.6 : 1;
  const Projection& view = marks.projection();
  Pen pen = marks.over();
  std::size_t drawn = 0;
  for (const FrameContact& contact : frame.contacts)
    for (const FrameContact::Point& point : contact.points) {
      if (++drawn > kMostPoints) return false;
      const auto at = view.seen(point.position);
      if (!at) continue;
      const bool pushes = point.impulse > 0 && most > 0;
      const double share = pushes ? std::min(1.0, point.impulse / most) : 0;
      const double length =
          k * (pushes ? kLeastImpulse + (kMostImpulse - kLeastImpulse) * share : kNormal);
      const auto tip =
          view.seen(point.position + contact.normal * (length / view.scale_at(point.position)));
      const Stroke stroke{Role::contact, (pushes ? 4.4 : 2.0) * k};
      if (tip) pen.arrow(*at, *tip, stroke, (pushes ? 17 : 9) * k, (pushes ? 1.6 : 1.2) * k);
      if (contact.begins) pen.dot(*at, 10 * k, Role::none, {Role::contact, 1.8});
      pen.dot(*at, 5 * k, Role::contact, {Role::panel, 1.8 * k});
    }
  return true;
}

void mark_velocities(const Frame& frame, Marks& marks) {
  constexpr double kLeastShare = 1.0 / 60;  // of the longest arrow
  if (!frame.show_velocities || frame.bodies.size() > kMostArrows) return;
  const Projection& view = marks.projection();
  for (const FrameBody& body : frame.bodies) {
    const double speed = glm::length(body.velocity);
    if (is_half_space(body) || !std::isfinite(speed) || !(speed > 1e-12)) continue;
    const double share = arrow_share(speed, view.size());
    if (share > kLeastShare)
      marks.arrow(body.position,
                  body.position + body.velocity * (share * view.longest_arrow() / speed),
                  {Role::ink, 2.8}, 13, 1.6);
  }
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
    return fmt::format("{:.{}f} {}", number, decimals, unit.name);
  }
  return "0";
}

void write_depths(const Frame& frame, const Projection& view, const std::vector<Box<2>>& bodies,
                  Labels& labels) {
  if (!frame.show_depths) return;
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
    for (const bool clear : {true, false}) {
      const Anchor* free = labels.free_anchor(
          text, anchors, style, room,
          [&](const Box<2>& extent) { return !clear || !touches(bodies, extent); });
      if (!free) continue;
      labels.add(text, *free, style, panel);
      break;
    }
  }
}

}  // namespace lantern
