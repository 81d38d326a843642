#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "draw/clip.hpp"
#include "draw/font.hpp"
#include "draw/pen.hpp"
#include "draw/world_marks.hpp"

namespace lantern {
namespace {

constexpr double kHit = 12.5;  // radius of a numbered mark

std::vector<Vec<2>> page_corners(const FrameView& view, const WorldMap& map) {
  std::vector<Vec<2>> corners;
  for (const Vec<3>& corner : view.corners) corners.push_back(map.to_page(corner));
  return corners;
}

bool are_finite(const std::vector<Vec<2>>& points) {
  return std::all_of(points.begin(), points.end(),
                     [](const Vec<2>& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

void draw_hits(const FrameRay& ray, const WorldMap& map, Pen& pen, Labels& labels) {
  const TextStyle style{kLeastLabel + 0.4, Weight::semibold, Role::ink};
  const double cap = cap_height(style.weight) * style.size;
  for (std::size_t i = 0; i < std::min(ray.hits.size(), kMostHits); ++i) {
    const Vec<2> at = map.to_page(ray.hits[i].position);
    const std::string number = fmt::format("{}", i + 1);
    const double radius = std::max(kHit, text_width(number, style) / 2 + 4);
    const Box<2> box = Box<2>::around(at, Vec<2>(radius));
    const bool numbered = ray.hits.size() > 1 && labels.is_free(box, map.rect);
    if (!numbered) {
      pen.dot(at, 6, Role::panel, {Role::ray, 2.8});
      continue;
    }
    pen.dot(at, radius, Role::panel, {Role::ray, 2.8});
    labels.add(number, {{at.x, at.y + cap / 2}, 0.5}, style, map.rect);
    labels.block(box);
  }
}

}  // namespace

void draw_eye_mark(const Vec<2>& at, const Vec<2>& gaze, Role role, const Box<2>& place,
                   DrawList& list) {
  constexpr int kPerLid = 9;
  constexpr double kWide = 17, kHigh = 10.5;
  const double length = std::hypot(gaze.x, gaze.y);
  const Vec<2> look = length > 0 ? gaze / length : Vec<2>(0, 0);
  std::vector<Vec<2>> lids;
  for (const int lid : {1, -1})
    for (int i = 0; i < kPerLid; ++i) {
      const double t = 2.0 * i / kPerLid - 1;  // from corner to corner
      lids.push_back(at + Vec<2>(lid * t * kWide, -lid * (1 - t * t) * kHigh));
    }
  Pen pen(list, place);
  pen.polygon(lids, Role::eye, {role, 2.8});
  pen.dot(at + look * 4.0, 5.6, Role::pupil);
  pen.dot(at + look * 4.0 + Vec<2>(1.6, -1.8), 1.5, Role::eye);
}

void fill_views(const Frame& frame, const WorldMap& map, DrawList& list, Grounds& grounds) {
  Pen pen(list, map.rect);
  for (std::size_t i = 0; i < std::min(frame.views.size(), kMostViews); ++i) {
    const std::vector<Vec<2>> corners = page_corners(frame.views[i], map);
    if (corners.size() < 3 || !are_finite(corners)) continue;
    pen.polygon(corners, Role::view_fill);
    grounds.push_back({cut_to(corners, map.rect), Role::view_fill});
  }
}

void draw_views(const Frame& frame, const WorldMap& map, DrawList& list) {
  Pen pen(list, map.rect);
  for (std::size_t i = 0; i < std::min(frame.views.size(), kMostViews); ++i) {
    const FrameView& view = frame.views[i];
    const std::vector<Vec<2>> corners = page_corners(view, map);
    if (!are_finite(corners)) continue;
    pen.path(corners, true, {Role::frustum, 3.4});
    const Vec<2> eye = map.to_page(view.eye);
    draw_eye_mark(eye, middle_of(corners) - eye, Role::frustum, shrunk(map.rect, -20), list);
  }
}

void draw_queries(const Frame& frame, const WorldMap& map, DrawList& list) {
  Pen pen(list, map.rect);
  for (std::size_t i = 0; i < std::min(frame.queries.size(), kMostQueries); ++i) {
    const FrameQuery& query = frame.queries[i];
    const Box<2> box = map.to_page(query.box);
    if (!is_valid(box)) continue;
    const Stroke stroke{Role::frustum, 3.2, 9};
    const bool within = holds(map.rect, box);
    if (query.radius > 0) {
      const double radius = query.radius * map.scale;
      const Vec<2> center = box.center();
      if (holds(map.rect, Box<2>::around(center, Vec<2>(radius))))
        list.disc(center, radius, Role::none, stroke);
      else if (std::isfinite(radius))
        pen.path(ring_of(center, radius, 60), true, {Role::frustum, 3.2});
      pen.line(center - Vec<2>(6, 0), center + Vec<2>(6, 0), {Role::frustum, 2.2});
      pen.line(center - Vec<2>(0, 6), center + Vec<2>(0, 6), {Role::frustum, 2.2});
    } else if (within) {
      list.rect(box, Role::none, stroke);
    } else {
      pen.path(polygon_of(box), true, stroke);
    }
  }
}

void draw_rays(const Frame& frame, const WorldMap& map, DrawList& list, Labels& labels) {
  Pen pen(list, mark_limit(map));
  const std::size_t rays = std::min(frame.rays.size(), kMostRays);
  const double k = rays > 12 ? 0.6 : 1;
  for (std::size_t i = 0; i < rays; ++i) {
    const FrameRay& ray = frame.rays[i];
    const Vec<2> from = map.to_page(ray.from), to = map.to_page(ray.to);
    pen.arrow(from, to, {Role::ray, 3.6 * k}, 20 * k, 1.8 * k);
    pen.dot(from, 5.5 * k, Role::ray, {Role::panel, 1.8 * k});
  }
  for (std::size_t i = 0; i < rays; ++i) draw_hits(frame.rays[i], map, pen, labels);
}

}  // namespace lantern
