#include <algorithm>

#include <fmt/format.h>

#include "draw/marks.hpp"
#include "frame/parts/asked.hpp"
#include "geometry/elementary.hpp"
#include "geometry/not_finite.hpp"

namespace lantern::draw {
namespace {

constexpr std::size_t kMostQueries = 60;
constexpr std::size_t kMostRays = 120;
constexpr std::size_t kMostHits = 60;

// Many rays are drawn thinner.
double ray_scale(const Frame& frame) {
  return frame.get<FrameFinding>().rays.size() > 12 ? 0.6 : 1;
}

void mark_hits_of(const FrameRay& ray, const Marks& marks, Labels& labels) {
  constexpr double kHit = 12.5;  // radius of a numbered mark
  const TextStyle style{kLeastLabel, Weight::semibold, Role::ink};
  const Box<2>& picture = marks.projection().picture();
  int number = 0;
  for (const auto& hit : first_of(ray.hits, kMostHits)) {
    const std::string text = fmt::format("{}", ++number);
    const auto at = marks.projection().seen(hit.position);
    if (!at) continue;
    const double radius = std::max(kHit, text_width(text, style) / 2 + 4);
    const Box<2> box = Box<2>::around(*at, Vec<2>(radius));
    const bool numbered = ray.hits.size() > 1 && labels.is_free(box, picture);
    marks.over().dot(*at, numbered ? radius : 7, Role::panel, {Role::ray, 2.8});
    marks.tell(MarkKind::ray_hit);
    if (!numbered) continue;
    labels.add(text, centred(*at, style), style, picture);
    labels.block(box);
  }
}

}  // namespace

void draw_eye(const Vec<2>& at, const Vec<2>& gaze, Role role, const Box<2>& place,
              DrawList& list) {
  constexpr int kPerLid = 9;
  constexpr double kWide = 17, kHigh = 10.5;
  const double length = geometry::hypot(gaze.x, gaze.y);
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

// Of a 2D view its border, of a 3D one its edges, and from the eye to them. Each is a thing of its
// own, so that a view that turns is seen to turn.
void mark_views(const Frame& frame, Marks& marks) {
  int edge = 0;
  const auto draw = [&](const Vec<3>& from, const Vec<3>& to, const Stroke& stroke) {
    const Marks::Scope scope(marks, fmt::format("world/view/edge {}", edge++));
    marks.line(from, to, stroke);
  };
  for (const FrameView& view : first_of(frame.get<FrameFinding>().views, kMostViews)) {
    const std::vector<Vec<3>>& c = view.corners;
    if (!std::ranges::all_of(c, is_finite<3>)) continue;
    marks.tell(MarkKind::view);
    if (c.size() != 8) {
      for (std::size_t i = 0; i < c.size() && c.size() > 2; ++i)
        draw(c[i], c[(i + 1) % c.size()], {Role::frustum, 3.4});
      continue;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const Stroke strong{Role::frustum, 2.6};
      const std::size_t next = (i + 1) % 4;
      draw(c[i], c[next], strong);
      draw(c[i + 4], c[next + 4], strong);
      draw(c[i], c[i + 4], strong);
      draw(view.eye, c[i], {Role::frustum, 1.6, 6});
    }
  }
}

void mark_eyes(const Frame& frame, const Projection& projection, const Box<2>& place,
               DrawList& list) {
  const auto& views = frame.get<FrameFinding>().views;
  for (const FrameView& view : first_of(views, kMostViews)) {
    const DrawList::Scope scope(list, fmt::format("world/view/eye {}", &view - views.data()));
    const auto at = projection.seen(view.eye);
    if (!at || view.corners.empty()) continue;
    Vec<3> ahead{0.0};
    for (const Vec<3>& corner : view.corners)
      ahead += (corner - view.eye) / static_cast<double>(view.corners.size());
    if (is_finite(ahead)) draw_eye(*at, projection.turned(ahead), Role::frustum, place, list);
  }
}

void mark_queries(const Frame& frame, Marks& marks) {
  const Stroke stroke{Role::frustum, 3.2, 9};
  for (const FrameQuery& query : first_of(frame.get<FrameFinding>().queries, kMostQueries)) {
    if (!is_valid(query.box)) continue;
    const Marks::Scope scope(
        marks, fmt::format("world/query/{}", &query - frame.get<FrameFinding>().queries.data()));
    marks.tell(MarkKind::region);
    if (query.radius > 0)
      marks.ball(query.box.center(), query.radius, stroke);
    else
      marks.box(query.box, stroke);
  }
}

void mark_rays(const Frame& frame, Marks& marks) {
  const double k = ray_scale(frame);
  for (const FrameRay& ray : first_of(frame.get<FrameFinding>().rays, kMostRays)) {
    if (ray.from == ray.to) continue;
    const Marks::Scope scope(
        marks, fmt::format("world/ray/{}", &ray - frame.get<FrameFinding>().rays.data()));
    marks.tell(MarkKind::ray);
    marks.arrow(ray.from, ray.to, {Role::ray, 3.6 * k}, 20 * k, 1.8 * k);
  }
}

void mark_found(const Frame& frame, const Marks& marks, DrawList& list) {
  if (!frame.get<FrameFinding>().rays.empty() || frame.get<FrameFinding>().hits.size() > kMostHits)
    return;
  const Box<2> room = shrunk(marks.place(), 10);
  for (const FrameBody& body : frame.bodies) {
    if (!std::ranges::binary_search(frame.get<FrameFinding>().hits, body.id)) continue;
    const auto at = marks.projection().seen({body.box.hi.x, body.box.hi.y, body.position.z});
    if (at && contains(room, *at)) draw_tick(*at, list);
  }
  marks.depict("hits");
}

void mark_hits(const Frame& frame, const Marks& marks, Labels& labels) {
  const double k = ray_scale(frame);
  const auto rays = first_of(frame.get<FrameFinding>().rays, kMostRays);
  for (const FrameRay& ray : rays) marks.dot(ray.from, 5.5 * k, Role::ray, {Role::panel, 1.8 * k});
  for (const FrameRay& ray : rays) mark_hits_of(ray, marks, labels);
  if (!rays.empty()) marks.depict("hits");
}

}  // namespace lantern::draw
