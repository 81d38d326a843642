#include <algorithm>
#include <cmath>
#include <map>
#include <variant>

#include "draw/solid_parts.hpp"

namespace lantern {
namespace {

constexpr std::size_t kMostSolidLinks = 900;
constexpr std::size_t kMostJoined = 120;     // springs, joints and pins
constexpr std::size_t kMostSolidBoxed = 60;  // links with a casing and joints

// The bodies that are drawn, and half-spaces, which are ground.
using ById = std::map<BodyId, const FrameBody*>;

ById by_id(const Frame& frame, const std::vector<SolidBody>& bodies) {
  ById found;
  for (const SolidBody& b : bodies) found.emplace(b.body->id, b.body);
  if (bodies.empty()) return found;
  for (const FrameBody& body : frame.bodies)
    if (std::holds_alternative<HalfSpace<3>>(body.shape)) found.emplace(body.id, &body);
  return found;
}

// Where a pair's link ends at this body: its centre, or the place of the ground nearest to the
// other one.
Vec<3> end_at(const FrameBody& body, const FrameBody& other) {
  const auto* ground = std::get_if<HalfSpace<3>>(&body.shape);
  if (ground == nullptr) return body.position;
  const double above = glm::dot(ground->normal, other.position - body.position);
  return other.position - ground->normal * above;
}

bool add_pairs(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
               std::vector<Piece>& pieces) {
  const ById found = by_id(frame, bodies);
  const bool many = frame.pairs.size() > kMostSolidBoxed;
  std::size_t drawn = 0;
  for (const bool lit : {false, true})
    for (const FramePair& pair : frame.pairs) {
      if (pair.lit != lit) continue;
      const auto a = found.find(pair.pair.a), b = found.find(pair.pair.b);
      if (a == found.end() || b == found.end()) continue;
      if (++drawn > kMostSolidLinks) return false;
      const double width = (lit ? 4.4 : 3.0) * (many ? 0.6 : 1);
      add_line(end_at(*a->second, *b->second), end_at(*b->second, *a->second), {Role::pair, width},
               {Role::panel, many ? 0 : width + 4}, bodies, view, pieces);
    }
  return true;
}

// Where two bodies that are to be tested cover each other, in space.
void draw_joints(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
                 DrawList& list) {
  if (frame.pairs.size() > kMostSolidBoxed) return;
  const ById found = by_id(frame, bodies);
  for (const FramePair& pair : frame.pairs) {
    const auto a = found.find(pair.pair.a), b = found.find(pair.pair.b);
    if (a == found.end() || b == found.end()) continue;
    const FrameBody &one = *a->second, &other = *b->second;
    if (!overlap(one.box, other.box)) continue;
    const Box<3> common{glm::max(one.box.lo, other.box.lo), glm::min(one.box.hi, other.box.hi)};
    const bool on_ground = std::holds_alternative<HalfSpace<3>>(one.shape) ||
                           std::holds_alternative<HalfSpace<3>>(other.shape);
    const Vec<3> foot =
        std::holds_alternative<HalfSpace<3>>(one.shape) ? end_at(one, other) : end_at(other, one);
    draw_spot(on_ground ? foot : common.center(), 6, Role::pair, view, list);
  }
}
// A spring's turns stand across its line on the page.
void add_spring(const FrameLink& link, const Stroke& stroke, const SolidView& view,
                std::vector<Piece>& pieces) {
  const auto page = view.segment(link.from, link.to);
  const auto seen = view.in_sight(link.from, link.to);
  if (!page || !seen) return;
  constexpr int kTurns = 8;
  constexpr double kReach = 6;
  const Vec<2> way = page->second - page->first;
  const double length = glm::length(way);
  if (!(length > 4 * kReach)) return add_piece(link.from, link.to, stroke, {}, view, pieces);
  const Vec<2> side = Vec<2>(-way.y, way.x) * (kReach / length);
  Outline bends{page->first, page->first + way * 0.12};
  for (int i = 0; i < 2 * kTurns; ++i)
    bends.push_back(page->first + way * (0.12 + 0.76 * (i + 0.5) / (2 * kTurns)) +
                    side * (i % 2 == 0 ? 1.0 : -1.0));
  bends.push_back(page->first + way * 0.88);
  bends.push_back(page->second);
  if (!holds(view.panel(), box_of(bends)))
    return add_piece(link.from, link.to, stroke, {}, view, pieces);
  Piece piece{Convex::line(seen->first, seen->second), hull_of(bends), true, false, {}};
  for (std::size_t i = 0; i + 1 < bends.size(); ++i)
    piece.shapes.emplace_back(LineShape{bends[i], bends[i + 1], stroke, false});
  pieces.push_back(std::move(piece));
}

void add_links(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
               std::vector<Piece>& pieces) {
  for (std::size_t i = 0; i < std::min(frame.links.size(), kMostJoined); ++i) {
    const FrameLink& link = frame.links[i];
    if (view.lost(link.from) || view.lost(link.to)) continue;
    const Stroke stroke = strain_stroke(link.strain);
    if (link.kind == FrameLink::Kind::spring)
      add_spring(link, stroke, view, pieces);
    else if (link.kind == FrameLink::Kind::distance)
      add_line(link.from, link.to, {stroke.role, std::max(3.0, stroke.width), 0}, {}, bodies, view,
               pieces);
    else
      add_line(link.from, link.to, {Role::ink, 1.6}, {}, bodies, view, pieces);
  }
}

// The faster the longer, by one rule for all bodies and frames.
void add_velocities(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
                    std::vector<Piece>& pieces) {
  constexpr std::size_t kMostArrows = 300;
  if (!frame.show_velocities || bodies.size() > kMostArrows) return;
  for (const SolidBody& b : bodies) {
    const double speed = glm::length(b.body->velocity);
    if (!std::isfinite(speed) || !(speed > 1e-12)) continue;
    const double length = 0.18 * view.size() * arrow_share(speed, view.size());
    const Vec<3> from = b.body->position, to = from + b.body->velocity * (length / speed);
    if (view.lost(to) || !(glm::length(to - from) > 3e-3 * view.size())) continue;
    add_line(from, to, {Role::ink, 2.8}, {Role::panel, 5}, bodies, view, pieces);
    add_head(from, to, 13, Role::ink, view, pieces);
  }
}

double most_impulse(const Frame& frame) {
  double most = 0;
  for (const FrameContact& contact : frame.contacts)
    for (const FrameContact::Point& point : contact.points)
      if (std::isfinite(point.impulse)) most = std::max(most, point.impulse);
  return most;
}

// An arrow along the normal, longer for a larger impulse.
bool draw_contacts(const Frame& frame, const SolidView& view, DrawList& list) {
  constexpr std::size_t kMostPoints = 500, kFewPoints = 60;
  std::size_t points = 0;
  for (const FrameContact& contact : frame.contacts) points += contact.points.size();
  const double k = points > kFewPoints ? 0.6 : 1, most = most_impulse(frame);
  std::size_t drawn = 0;
  for (const FrameContact& contact : frame.contacts)
    for (const FrameContact::Point& point : contact.points) {
      if (++drawn > kMostPoints) return false;
      if (view.lost(point.position)) continue;
      const bool pushes = point.impulse > 0 && most > 0;
      const double part = pushes ? 0.02 + 0.05 * std::min(1.0, point.impulse / most) : 0.025;
      const Vec<3> end = point.position + contact.normal * (part * view.size());
      std::vector<Piece> arrow;
      const double width = (pushes ? 2.6 : 1.8) * k;
      add_piece(point.position, end, {Role::contact, width}, {Role::panel, width + 2}, view, arrow);
      add_head(point.position, end, 10 * k, Role::contact, view, arrow);
      for (Piece& piece : arrow)
        for (DrawShape& shape : piece.shapes) list.shapes.push_back(std::move(shape));
      draw_spot(point.position, (contact.begins ? 5.5 : 3.8) * k, Role::contact, view, list);
    }
  return true;
}

}  // namespace

bool add_marks(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
               std::vector<Piece>& pieces) {
  const bool complete = add_pairs(frame, bodies, view, pieces);
  add_links(frame, bodies, view, pieces);
  add_velocities(frame, bodies, view, pieces);
  for (const SolidBody& b : bodies)
    if (frame.show_boxes && (b.body->lit || bodies.size() <= kMostSolidBoxed))
      add_box(b.body->box, {b.body->lit ? Role::lit : Role::quiet_ink, 1.5, 5}, bodies, view,
              pieces);
  return complete;
}

bool draw_marks_over(const Frame& frame, const std::vector<SolidBody>& bodies,
                     const SolidView& view, DrawList& list) {
  draw_joints(frame, bodies, view, list);
  for (std::size_t i = 0; i < std::min(frame.links.size(), kMostJoined); ++i) {
    const FrameLink& link = frame.links[i];
    if (link.kind != FrameLink::Kind::pin) draw_spot(link.from, 4, Role::ink, view, list);
    draw_spot(link.to, link.kind == FrameLink::Kind::pin ? 6 : 4, Role::ink, view, list);
  }
  return draw_contacts(frame, view, list);
}

}  // namespace lantern
