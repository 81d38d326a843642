#include <algorithm>

#include <fmt/format.h>

#include "draw/clip.hpp"
#include "draw/font.hpp"
#include "draw/solid_parts.hpp"
#include "draw/world_marks.hpp"

namespace lantern {
namespace {

std::size_t few(std::size_t count, std::size_t most) { return std::min(count, most); }

void add_views(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
               std::vector<Piece>& pieces) {
  const Stroke strong{Role::frustum, 2.6}, faint{Role::frustum, 1.6, 6};
  for (std::size_t k = 0; k < few(frame.views.size(), kMostViews); ++k) {
    const FrameView& seen = frame.views[k];
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

void add_rays(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
              std::vector<Piece>& pieces) {
  const std::size_t rays = few(frame.rays.size(), kMostRays);
  const double k = rays > 12 ? 0.6 : 1;
  for (std::size_t i = 0; i < rays; ++i) {
    const FrameRay& ray = frame.rays[i];
    add_line(ray.from, ray.to, {Role::ray, 3.6 * k}, {Role::panel, 6.4 * k}, bodies, view, pieces);
    add_head(ray.from, ray.to, 18 * k, Role::ray, view, pieces);
  }
}

// A ball is drawn as the eye sees it, over the edges of the box around it.
void add_queries(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
                 std::vector<Piece>& pieces) {
  for (std::size_t i = 0; i < few(frame.queries.size(), kMostQueries); ++i) {
    const FrameQuery& query = frame.queries[i];
    if (!is_valid(query.box)) continue;
    const bool ball = query.radius > 0;
    add_box(query.box, {Role::frustum, ball ? 1.4 : 3.0, 9}, bodies, view, pieces);
    const Vec<3> center = query.box.center();
    if (!ball || view.lost(center)) continue;
    Outline rim = cut_to(view.ball_cap(center, query.radius, view.light(), -1), view.panel());
    if (rim.size() < 3) continue;
    Piece piece{Convex::line(center, center), rim, true, false, {}};
    piece.shapes.emplace_back(PolygonShape{std::move(rim), Role::none, {Role::frustum, 3}});
    pieces.push_back(std::move(piece));
  }
}

// Numbered along the ray when there are several.
void draw_hits(const FrameRay& ray, const SolidView& view, DrawList& list, Labels& labels) {
  constexpr double kHit = 12.5;  // radius of a numbered mark
  const TextStyle style{kLeastLabel + 0.4, Weight::semibold, Role::ink};
  const double cap = cap_height(style.weight) * style.size;
  for (std::size_t i = 0; i < few(ray.hits.size(), kMostHits); ++i) {
    const Vec<3>& hit = ray.hits[i].position;
    if (view.lost(hit) || !view.in_front(hit)) continue;
    const Vec<2> at = view.to_page(hit);
    const std::string number = fmt::format("{}", i + 1);
    const double radius = std::max(kHit, text_width(number, style) / 2 + 4);
    const Box<2> box = Box<2>::around(at, Vec<2>(radius));
    const bool numbered = ray.hits.size() > 1 && labels.is_free(box, shrunk(view.panel(), 2));
    if (!holds(view.panel(), Box<2>::around(at, Vec<2>(8)))) continue;
    list.disc(at, numbered ? radius : 6, Role::panel, {Role::ray, 2.8});
    if (!numbered) continue;
    labels.add(number, {{at.x, at.y + cap / 2}, 0.5}, style, view.panel());
    labels.block(box);
  }
}

}  // namespace

void add_sight(const Frame& frame, const std::vector<SolidBody>& bodies, const SolidView& view,
               std::vector<Piece>& pieces) {
  add_views(frame, bodies, view, pieces);
  add_rays(frame, bodies, view, pieces);
  add_queries(frame, bodies, view, pieces);
}

void draw_sight_over(const Frame& frame, const SolidView& view, DrawList& list, Labels& labels) {
  for (std::size_t i = 0; i < few(frame.views.size(), kMostViews); ++i) {
    const FrameView& seen = frame.views[i];
    if (seen.corners.size() != 8 || view.lost(seen.eye) || !view.in_front(seen.eye)) continue;
    Vec<3> ahead{0.0};
    for (const Vec<3>& corner : seen.corners) ahead += (corner - seen.eye) / 8.0;
    const Vec<2> gaze{glm::dot(ahead, view.right()), -glm::dot(ahead, view.up())};
    const Vec<2> at = view.to_page(seen.eye);
    if (contains(shrunk(view.panel(), 20), at))
      draw_eye_mark(at, gaze, Role::frustum, view.panel(), list);
  }
  const std::size_t rays = few(frame.rays.size(), kMostRays);
  for (std::size_t i = 0; i < rays; ++i)
    draw_spot(frame.rays[i].from, rays > 12 ? 3.3 : 5.5, Role::ray, view, list);
  for (std::size_t i = 0; i < rays; ++i) draw_hits(frame.rays[i], view, list, labels);
}

}  // namespace lantern
