#include <algorithm>
#include <cmath>

#include "draw/pen.hpp"
#include "draw/world_marks.hpp"

namespace lantern {
namespace {

constexpr std::size_t kMostPoints = 500;
constexpr std::size_t kFewPoints = 60;  // more are drawn smaller
constexpr double kNormal = 24;          // page units
constexpr double kLeastImpulse = 20, kMostImpulse = 92;
constexpr double kFastest = 120;  // what the longest velocity arrows come near to

void draw_spring(Pen& pen, const Vec<2>& from, const Vec<2>& to, const Stroke& stroke) {
  const Vec<2> way = to - from;
  const double length = std::hypot(way.x, way.y);
  if (!(length > 1)) return;
  const Vec<2> along = way / length, side{-along.y, along.x};
  constexpr int kTurns = 7;
  const double end = std::min(0.17 * length, 26.0), reach = std::clamp(0.09 * length, 3.0, 10.0);
  std::vector<Vec<2>> points{from, from + along * end};
  for (int i = 0; i < 2 * kTurns; ++i) {
    const double at = end + (length - 2 * end) * (i + 0.5) / (2 * kTurns);
    points.push_back(from + along * at + side * (i % 2 == 0 ? reach : -reach));
  }
  points.push_back(to - along * end);
  points.push_back(to);
  pen.path(points, false, stroke);
}

}  // namespace

Box<2> mark_limit(const WorldMap& map) { return shrunk(map.rect, -8); }

void draw_links(const Frame& frame, const WorldMap& map, DrawList& list) {
  constexpr std::size_t kMostLinks = 120;
  Pen pen(list, mark_limit(map));
  for (std::size_t i = 0; i < std::min(frame.links.size(), kMostLinks); ++i) {
    const FrameLink& link = frame.links[i];
    const Vec<2> from = map.to_page(link.from), to = map.to_page(link.to);
    const Stroke rim{Role::panel, 1.6};
    if (link.kind == FrameLink::Kind::pin) {
      pen.line(from, to, {Role::ink, 1.6});
      pen.dot(to, 7.5, Role::panel, {Role::ink, 2.6});
      pen.dot(to, 2, Role::ink);
      continue;
    }
    const Stroke stroke = strain_stroke(link.strain);
    if (link.kind == FrameLink::Kind::spring)
      draw_spring(pen, from, to, stroke);
    else
      pen.line(from, to, {stroke.role, std::max(3.0, stroke.width), 0}, 1.6);
    for (const Vec<2>& end : {from, to}) pen.dot(end, 5, Role::ink, rim);
  }
}

bool draw_contacts(const Frame& frame, const WorldMap& map, DrawList& list) {
  std::size_t points = 0;
  double most = 0;  // impulse
  for (const FrameContact& contact : frame.contacts)
    for (const FrameContact::Point& point : contact.points) {
      ++points;
      if (std::isfinite(point.impulse)) most = std::max(most, point.impulse);
    }
  const double k = points > kFewPoints ? 0.6 : 1;
  Pen pen(list, mark_limit(map));
  std::size_t drawn = 0;
  for (const FrameContact& contact : frame.contacts) {
    const Vec<2> normal{contact.normal.x, -contact.normal.y};
    for (const FrameContact::Point& point : contact.points) {
      if (++drawn > kMostPoints) return false;
      const Vec<2> at = map.to_page(point.position);
      if (point.impulse > 0 && most > 0) {
        const double length =
            kLeastImpulse + (kMostImpulse - kLeastImpulse) * std::min(1.0, point.impulse / most);
        pen.arrow(at, at + normal * (k * length), {Role::contact, 4.4 * k}, 17 * k, 1.6 * k);
      } else {
        pen.arrow(at, at + normal * (k * kNormal), {Role::contact, 2.0 * k}, 9 * k, 1.2 * k);
      }
      if (contact.begins) pen.dot(at, 10 * k, Role::none, {Role::contact, 1.8});
      pen.dot(at, 5 * k, Role::contact, {Role::panel, 1.8 * k});
    }
  }
  return true;
}

void draw_velocities(const Frame& frame, const WorldMap& map, DrawList& list) {
  if (!frame.show_velocities) return;
  constexpr std::size_t kMostArrows = 300;
  if (frame.bodies.size() > kMostArrows) return;
  const Vec<3> size = frame.bounds.size();
  const double extent = std::max(size.x, size.y);
  Pen pen(list, mark_limit(map));
  for (const FrameBody& body : frame.bodies) {
    if (is_half_space(body)) continue;
    const Vec<2> from = map.to_page(body.position);
    const Vec<2> page_velocity = Vec<2>(body.velocity.x, -body.velocity.y);
    const double speed = std::hypot(page_velocity.x, page_velocity.y);
    if (!std::isfinite(speed) || !(speed > 1e-12)) continue;
    const double length = kFastest * arrow_share(speed, extent);
    const Vec<2> way = page_velocity * (length / speed);
    if (length > 2) pen.arrow(from, from + way, {Role::ink, 2.8}, 13, 1.6);
  }
}

}  // namespace lantern
