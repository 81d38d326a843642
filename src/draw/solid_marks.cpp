#include <algorithm>
#include <cmath>
#include <map>

#include "draw/clip.hpp"
#include "draw/solid_parts.hpp"

namespace lantern {
namespace {

constexpr std::size_t kMostLinks = 900;
constexpr std::size_t kMostBoxed = 60;  // links with a casing and joints

using ById = std::map<BodyId, const SolidBody*>;

ById by_id(const std::vector<SolidBody>& bodies) {
  ById found;
  for (const SolidBody& b : bodies) found.emplace(b.body->id, &b);
  return found;
}

// The part of a line that is in front of the eye and in the panel, as one piece.
void add_piece(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, const Stroke& casing,
               const SolidView& view, std::vector<Piece>& pieces) {
  const auto seen = view.in_sight(from, to);
  const auto page = view.segment(from, to);
  if (!seen || !page) return;
  Piece piece{
      Convex::line(seen->first, seen->second), {page->first, page->second}, true, false, {}};
  if (casing.width > 0)
    piece.shapes.emplace_back(LineShape{page->first, page->second, casing, false});
  piece.shapes.emplace_back(LineShape{page->first, page->second, stroke, false});
  pieces.push_back(std::move(piece));
}

bool add_pairs(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
               std::vector<Piece>& pieces) {
  const ById found = by_id(bodies);
  const bool many = frame.pairs.size() > kMostBoxed;
  std::size_t drawn = 0;
  for (const bool lit : {false, true})
    for (const FramePair& pair : frame.pairs) {
      if (pair.lit != lit) continue;
      const auto a = found.find(pair.pair.a), b = found.find(pair.pair.b);
      if (a == found.end() || b == found.end()) continue;
      if (++drawn > kMostLinks) return false;
      const double width = (lit ? 4.4 : 3.0) * (many ? 0.6 : 1);
      add_line(a->second->body->position, b->second->body->position, {Role::pair, width, 0},
               {Role::panel, many ? 0 : width + 4, 0}, bodies, view, pieces);
    }
  return true;
}

void add_box(const Box<3>& box, const Stroke& stroke, const std::vector<SolidBody>& bodies,
             const SolidView& view, std::vector<Piece>& pieces) {
  const std::vector<Vec<3>> c = corners_of(box);
  for (unsigned i = 0; i < 8; ++i)
    for (const unsigned bit : {1u, 2u, 4u})
      if ((i & bit) == 0) add_line(c[i], c[i + bit], stroke, {}, bodies, view, pieces);
}

void add_views(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
               std::vector<Piece>& pieces) {
  const Stroke strong{Role::frustum, 2.6, 0}, faint{Role::frustum, 1.6, 6};
  for (const FrameView& seen : frame.views) {
    if (seen.corners.size() != 8) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t next = (i + 1) % 4;
      const Vec<3>&near_corner = seen.corners[i], &far_corner = seen.corners[i + 4];
      add_line(near_corner, seen.corners[next], strong, {}, bodies, view, pieces);
      add_line(far_corner, seen.corners[next + 4], strong, {}, bodies, view, pieces);
      add_line(near_corner, far_corner, strong, {}, bodies, view, pieces);
      add_line(seen.eye, near_corner, faint, {}, bodies, view, pieces);
    }
  }
}

// An arrow head at the end of a line on the page.
void add_head(const Vec<3>& from, const Vec<3>& to, double size, Role role, const SolidView& view,
              std::vector<Piece>& pieces) {
  if (!view.in_front(from) || !view.in_front(to)) return;
  const Vec<2> tip = view.to_page(to), way = tip - view.to_page(from);
  const double length = glm::length(way);
  if (!(length > size)) return;
  const Vec<2> along = way / length, side{-along.y, along.x};
  const Vec<2> back = tip - along * size;
  Outline head{tip, back + side * (0.45 * size), back - side * (0.45 * size)};
  if (!holds(view.panel(), box_of(head))) return;
  Piece piece{Convex::line(to, to), hull_of(head), true, false, {}};
  piece.shapes.emplace_back(PolygonShape{std::move(head), role, {}});
  pieces.push_back(std::move(piece));
}

void add_rays(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
              std::vector<Piece>& pieces) {
  for (const FrameRay& ray : frame.rays) {
    add_line(ray.from, ray.to, {Role::ray, 3.4, 0}, {Role::panel, 6, 0}, bodies, view, pieces);
    if (ray.hits.empty()) add_head(ray.from, ray.to, 16, Role::ray, view, pieces);
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
  for (const FrameLink& link : frame.links) {
    const Stroke stroke{Role::ink, 2.2, 0};
    if (link.kind == FrameLink::Kind::spring)
      add_spring(link, stroke, view, pieces);
    else if (link.kind == FrameLink::Kind::distance)
      add_line(link.from, link.to, stroke, {}, bodies, view, pieces);
  }
}

void add_velocities(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
                    std::vector<Piece>& pieces) {
  if (!frame.show_velocities) return;
  constexpr double kSeconds = 0.25;  // as far as it goes in this time
  for (const SolidBody& b : bodies) {
    const Vec<3> from = b.body->position, to = from + b.body->velocity * kSeconds;
    if (view.lost(to) || !(glm::length(to - from) > 1e-3 * view.size())) continue;
    add_line(from, to, {Role::ink, 2.2, 0}, {}, bodies, view, pieces);
    add_head(from, to, 11, Role::ink, view, pieces);
  }
}

void draw_spot(const Vec<3>& at, double radius, Role role, const SolidView& view, DrawList& list) {
  if (view.lost(at) || !view.in_front(at)) return;
  const Vec<2> page = view.to_page(at);
  if (!holds(view.panel(), Box<2>::around(page, Vec<2>(radius + 2)))) return;
  list.shapes.emplace_back(disc(page, radius, role, {Role::panel, 2, 0}));
}

// Where two bodies that are to be tested cover each other, in space.
void draw_joints(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
                 DrawList& list) {
  if (frame.pairs.size() > kMostBoxed) return;
  const ById found = by_id(bodies);
  for (const FramePair& pair : frame.pairs) {
    const auto a = found.find(pair.pair.a), b = found.find(pair.pair.b);
    if (a == found.end() || b == found.end()) continue;
    const Box<3>&one = a->second->body->box, &other = b->second->body->box;
    if (!overlap(one, other)) continue;
    const Box<3> common{glm::max(one.lo, other.lo), glm::min(one.hi, other.hi)};
    draw_spot(common.center(), 6, Role::pair, view, list);
  }
}

void draw_contacts(const Frame& frame, const SolidView& view, DrawList& list) {
  constexpr std::size_t kMostWithNormal = 60;
  const double length = 0.035 * view.size();
  for (const FrameContact& contact : frame.contacts)
    for (const FrameContact::Point& point : contact.points) {
      const Vec<3> end = point.position + contact.normal * length;
      if (view.lost(point.position) || view.lost(end)) continue;
      if (const auto line = view.segment(point.position, end);
          line && frame.contacts.size() <= kMostWithNormal) {
        list.shapes.emplace_back(LineShape{line->first, line->second, {Role::panel, 4, 0}, false});
        list.shapes.emplace_back(
            LineShape{line->first, line->second, {Role::contact, 2, 0}, false});
      }
      draw_spot(point.position, contact.begins ? 5 : 3.6, Role::contact, view, list);
    }
}

}  // namespace

void add_line(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, const Stroke& casing,
              const std::vector<SolidBody>& bodies, const SolidView& view,
              std::vector<Piece>& pieces) {
  if (view.lost(from) || view.lost(to)) return;
  const Box<3> reach{glm::min(from, to), glm::max(from, to)};
  std::vector<std::pair<double, double>> hidden;
  for (const SolidBody& b : bodies) {
    if (!overlap(b.body->box, reach)) continue;
    if (const auto part = inside_of(b.space, from, to)) hidden.push_back(*part);
  }
  std::sort(hidden.begin(), hidden.end());
  double start = 0;
  const auto add = [&](double end) {
    if (end - start > 1e-6)
      add_piece(from + (to - from) * start, from + (to - from) * end, stroke, casing, view, pieces);
  };
  for (const auto& [first, last] : hidden) {
    add(first);
    start = std::max(start, last);
  }
  add(1);
}

bool add_marks(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
               std::vector<Piece>& pieces) {
  const bool complete = add_pairs(frame, bodies, view, pieces);
  add_views(frame, bodies, view, pieces);
  add_rays(frame, bodies, view, pieces);
  add_links(frame, bodies, view, pieces);
  add_velocities(frame, bodies, view, pieces);
  if (frame.show_boxes && bodies.size() <= kMostBoxed)
    for (const SolidBody& b : bodies)
      add_box(b.body->box, {Role::quiet_ink, 1.4, 5}, bodies, view, pieces);
  for (const FrameQuery& query : frame.queries)
    add_box(query.box, {Role::ray, 2.6, query.radius > 0 ? 6.0 : 0.0}, bodies, view, pieces);
  return complete;
}

void draw_marks_over(const Frame& frame, const std::vector<SolidBody>& bodies,
                     const SolidView& view, DrawList& list) {
  draw_joints(frame, bodies, view, list);
  for (const FrameRay& ray : frame.rays) draw_spot(ray.from, 4, Role::ray, view, list);
  for (const FrameRay& ray : frame.rays)
    for (const FrameRay::Hit& hit : ray.hits) draw_spot(hit.position, 6, Role::ray, view, list);
  for (const FrameLink& link : frame.links) {
    draw_spot(link.from, 3.4, Role::ink, view, list);
    draw_spot(link.to, 3.4, Role::ink, view, list);
  }
  for (const FrameView& seen : frame.views) draw_spot(seen.eye, 6.5, Role::frustum, view, list);
  draw_contacts(frame, view, list);
}

}  // namespace lantern
