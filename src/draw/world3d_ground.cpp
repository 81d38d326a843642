#include <cmath>
#include <numbers>

#include "draw/body_shapes.hpp"
#include "draw/pen.hpp"
#include "draw/world3d_parts.hpp"
#include "geometry/polygon.hpp"

namespace lantern::draw {
namespace {

using Corners = std::vector<Vec<3>>;

// 1, 2 or 5 times a power of ten: about an eighth of the longer side.
double grid_step(const Box<3>& bounds) {
  const double wanted = std::max(bounds.size().x, bounds.size().z) / 8;
  if (!(wanted > 0)) return 1;
  double step = 1;
  while (step > wanted) step /= 10;
  while (step * 10 <= wanted) step *= 10;
  for (const double k : {5.0, 2.0})
    if (step * k <= wanted) return step * k;
  return step;
}

void fill(const Corners& corners, Role role, const Stroke& stroke, const View3D& view,
          DrawList& list) {
  Pen(list, view.panel()).polygon(view.polygon(corners), role, stroke);
}

void line(const Vec<3>& a, const Vec<3>& b, const Stroke& stroke, const View3D& view,
          DrawList& list) {
  if (const auto seen = view.segment(a, b)) list.line(seen->first, seen->second, stroke);
}

Corners cut_by(Corners corners, const Box<3>& bounds) {
  const double slack = 1e-9 * (glm::length(bounds.size()) + 1);
  for (int axis = 0; axis < 3; ++axis) {
    Vec<3> along{0.0};
    along[axis] = 1;
    corners = clipped(corners, along, bounds.lo[axis] - slack);
    corners = clipped(corners, -along, -bounds.hi[axis] - slack);
  }
  return corners;
}

Corners floor_of(const Box<3>& b) {
  return {{b.lo.x, b.lo.y, b.lo.z},
          {b.hi.x, b.lo.y, b.lo.z},
          {b.hi.x, b.lo.y, b.hi.z},
          {b.lo.x, b.lo.y, b.hi.z}};
}

void draw_grid(const View3D& view, DrawList& list) {
  const Box<3>& b = view.bounds();
  const double step = grid_step(b);
  const Stroke stroke{Role::rule, 1.3};
  for (const auto& [along, across] : {std::pair{0, 2}, std::pair{2, 0}}) {
    const double first = std::ceil(b.lo[across] / step), last = std::floor(b.hi[across] / step);
    if (!(last - first < 200)) continue;
    for (double k = first; k <= last; ++k) {
      Vec<3> from{0.0, b.lo.y, 0.0}, to = from;
      from[across] = to[across] = k * step;
      from[along] = b.lo[along];
      to[along] = b.hi[along];
      line(from, to, stroke, view, list);
    }
  }
  const Corners corners = floor_of(b);
  for (std::size_t i = 0; i < 4; ++i)
    line(corners[i], corners[(i + 1) % 4], {Role::cell_line_3, 1.6}, view, list);
}

// The plane's part in the bounds: a fixed thing, so it is hatched along its rim like ground in a
// drawing.
void draw_half_space(const FrameBody& body, const View3D& view, DrawList& list) {
  const Vec<3> n = std::get<HalfSpace<3>>(body.shape).normal;
  if (!(glm::length(n) > 0) || view.lost(body.position)) return;
  const Vec<3> middle =
      view.bounds().center() - n * glm::dot(n, view.bounds().center() - body.position);
  const Vec<3> u = across(n) * (2 * view.size());
  const Vec<3> v = glm::cross(n, u);
  const Corners patch =
      cut_by({middle - u - v, middle + u - v, middle + u + v, middle - u + v}, view.bounds());
  if (patch.size() < 3) return;
  const bool outer = glm::dot(view.eye() - body.position, n) > 0;
  const Role rim = body.lit ? Role::lit : Role::static_body;
  if (outer) fill(patch, n.y > 0.5 ? Role::free_space : Role::static_body, {rim, 3, 0}, view, list);
  Vec<3> center{0.0};
  for (const Vec<3>& p : patch) center += p / double(patch.size());
  const double tick = 0.025 * view.size();
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const Vec<3>&a = patch[i], &b = patch[(i + 1) % patch.size()];
    const Vec<3> mid = (a + b) * 0.5;
    const bool front = view.depth(mid) < view.depth(center);
    const double length = glm::length(b - a);
    if (!front || !(length > 0)) continue;
    const int ticks = static_cast<int>(std::min(60.0, length / tick));
    for (int k = 0; k < ticks; ++k) {
      const Vec<3> at = a + (b - a) * ((k + 0.5) / ticks);
      line(at, at - n * tick + (b - a) * (0.7 * tick / length), {Role::quiet_ink, 1.2}, view, list);
    }
    line(a, b, {Role::quiet_ink, 2}, view, list);
  }
}

// What a body covers of the floor, seen from straight above: x and z.
Outline seen_from_above(const Body3D& b) {
  Outline points;
  if (b.space.radius > 0) {
    const Vec<3> c = b.body->box.center(), half = b.body->box.size() * 0.5;
    constexpr int kCorners = 32;
    for (int i = 0; i < kCorners; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / kCorners;
      points.push_back({c.x + std::cos(angle) * half.x, c.z + std::sin(angle) * half.z});
    }
    return points;
  }
  for (int corner = 0; corner < 8; ++corner) {
    Vec<3> at = b.space.center;
    for (int axis = 0; axis < 3; ++axis)
      at += b.space.axes[axis] * (corner >> axis & 1 ? b.space.half[axis] : -b.space.half[axis]);
    points.push_back({at.x, at.z});
  }
  return hull_of(std::move(points));
}

// A view's inside, as the eye sees it from without, and the part of the floor that lies in it.
void fill_view(const FrameView& seen, const View3D& view, DrawList& list) {
  if (seen.corners.size() != 8) return;
  Outline points;
  const std::size_t faces[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                   {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  for (const auto& face : faces) {
    Corners corners;
    for (const std::size_t i : face) {
      if (view.lost(seen.corners[i])) return;
      corners.push_back(seen.corners[i]);
    }
    for (const Vec<2>& p : view.polygon(corners)) points.push_back(p);
  }
  Pen(list, view.panel()).polygon(hull_of(std::move(points)), Role::view_fill);
}

}  // namespace

void draw_ground3d(const Frame& frame, const View3D& view, DrawList& list) {
  if (view.eye().y > view.bounds().lo.y) fill(floor_of(view.bounds()), Role::panel, {}, view, list);
  for (const FrameBody& body : frame.bodies)
    if (is_half_space(body)) draw_half_space(body, view, list);
  for (const FrameView& seen : frame.views) fill_view(seen, view, list);
  draw_grid(view, list);
}

void draw_shadows(const std::vector<Body3D>& bodies, const View3D& view, DrawList& list) {
  const Box<3>& bounds = view.bounds();
  for (const Body3D& b : bodies) {
    if (b.body->box.center().y < bounds.lo.y || view.eye().y <= bounds.lo.y) continue;
    const DrawList::Scope scope(list, body_key("world/shadow", *b.body));
    Corners rim;
    for (const Vec<2>& p : seen_from_above(b)) rim.push_back({p.x, bounds.lo.y, p.y});
    fill(cut_by(rim, bounds), Role::rule, {}, view, list);  // cut off where the floor ends
  }
}

void add_drop_lines(Marks3D& marks) {
  constexpr std::size_t kMost = 80;
  constexpr double kFoot = 2.6;  // radius of the mark on the floor
  if (marks.bodies.size() > kMost) return;
  for (const Body3D& b : marks.bodies) {
    const Vec<3> c = b.body->box.center();
    const Vec<3> foot{c.x, marks.view.bounds().lo.y, c.z};
    if (b.body->is_static || c.y <= foot.y) continue;
    const Marks::Scope scope(marks, body_key("world/drop", *b.body));
    marks.line(c, foot, {Role::quiet_ink, 1.4, 5});
    if (const auto page = marks.view.segment(foot, foot); page && b.body->box.lo.y > foot.y) {
      const Box<2> spot = Box<2>::around(page->first, Vec<2>(kFoot));
      marks.add(Convex::line(foot, foot), polygon_of(spot),
                {RectShape{spot, kFoot, Role::quiet_ink}});
    }
  }
}

}  // namespace lantern::draw
