#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/body_shapes.hpp"
#include "draw/keys.hpp"
#include "draw/number_text.hpp"
#include "draw/world/world3d_parts.hpp"
#include "frame/parts/asked.hpp"
#include "geometry/elementary.hpp"
#include "geometry/plane.hpp"

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
      points.push_back({c.x + geometry::cos(angle) * half.x, c.z + geometry::sin(angle) * half.z});
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
  const DrawList::Scope scope(list, "world/view/ground");
  Pen(list, view.panel()).polygon(hull_of(std::move(points)), Role::view_fill);
}

constexpr std::size_t kMostScaled = 12;  // bodies, of more heights are not counted

// The heights of the floor's grid above the floor, up to `top`; none if that is so high that nobody
// would count them.
std::vector<double> heights_of(const Box<3>& bounds, double top) {
  constexpr int kMost = 12, kCountable = 100;
  double step = grid_step(bounds);
  while ((bounds.hi.y - bounds.lo.y) / step > kMost) step *= 2;
  std::vector<double> heights;
  if (!((top - bounds.lo.y) / step <= kCountable)) return heights;
  for (int i = 1; bounds.lo.y + i * step <= top + 1e-9 * step; ++i) heights.push_back(i * step);
  return heights;
}

// Across a drop line, so that a height can be counted.
void add_ticks(const Vec<3>& from, const Vec<3>& foot, Marks3D& marks) {
  constexpr double kHalf = 4.5;  // page units
  for (const double height : heights_of(marks.view.bounds(), from.y)) {
    const Vec<3> at{foot.x, foot.y + height, foot.z};
    const Vec<3> half = marks.view.right() * (kHalf / marks.view.scale_at(at));
    marks.line(at - half, at + half, {Role::quiet_ink, 1.6});
  }
}

// The numbers of a scale at an upright edge, on one side of it: all or none.
bool write_scale(const Vec<3>& foot, int side, const View3D& view, DrawList& list, Labels& labels) {
  const TextStyle style{24, Weight::regular, Role::quiet_ink, Role::paper};
  constexpr double kTick = 8;
  std::vector<double> heights = heights_of(view.bounds(), view.bounds().hi.y);
  heights.insert(heights.begin(), 0);
  const auto at = [&](double height) { return view.to_page({foot.x, foot.y + height, foot.z}); };
  const auto anchor = [&](double height) {
    return centred(at(height) + Vec<2>(side * (kTick + 6), 0), style, side < 0 ? 1 : 0);
  };
  const auto text = [&](double height) { return short_number(view.bounds().lo.y + height); };
  // Every other one where they stand too close.
  while (heights.size() > 2 && std::abs(at(heights[0]).y - at(heights[1]).y) < 1.15 * style.size) {
    std::vector<double> fewer;
    for (std::size_t i = 0; i < heights.size(); i += 2) fewer.push_back(heights[i]);
    heights = fewer;
  }
  for (const double height : heights)
    if (!labels.is_free(Labels::extent(text(height), anchor(height), style), view.panel()))
      return false;
  for (const double height : heights) {
    list.line(at(height), at(height) + Vec<2>(side * kTick, 0), {Role::quiet_ink, 1.6});
    labels.add(text(height), anchor(height), style, view.panel());
  }
  return true;
}

// The axes' letters: y over the scale at `foot`, x and z outside of the floor's nearer edges.
void name_axes(const Vec<3>& foot, const View3D& view, Labels& labels) {
  constexpr double kGap = 22;
  const TextStyle style{24, Weight::semibold, Role::quiet_ink, Role::paper};
  const Box<3>& b = view.bounds();
  const auto name = [&](const char* letter, const Vec<2>& at) {
    labels.try_add(letter, {centred(at, style)}, style, view.panel());
  };
  name("y", view.to_page({foot.x, b.hi.y, foot.z}) - Vec<2>(0, kGap));
  const Vec<3> middle{b.center().x, b.lo.y, b.center().z};
  for (const int axis : {0, 2}) {
    Vec<3> low = middle, high = middle;
    low[2 - axis] = b.lo[2 - axis];
    high[2 - axis] = b.hi[2 - axis];
    const Vec<2> at = view.to_page(view.depth(low) < view.depth(high) ? low : high);
    const Vec<2> out = at - view.to_page(middle);
    if (glm::length(out) > 1) name(axis == 0 ? "x" : "z", at + out * (kGap / glm::length(out)));
  }
}

}  // namespace

void draw_ground3d(const Frame& frame, const View3D& view, DrawList& list) {
  if (view.eye().y > view.bounds().lo.y) fill(floor_of(view.bounds()), Role::panel, {}, view, list);
  for (const FrameBody& body : frame.bodies)
    if (is_half_space(body)) draw_half_space(body, view, list);
  for (const FrameView& seen : frame.get<FrameFinding>().views) fill_view(seen, view, list);
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

void write_heights(const std::vector<Body3D>& bodies, const View3D& view, DrawList& list,
                   Labels& labels) {
  const Box<3>& b = view.bounds();
  const auto floats = [&](const Body3D& body) {
    return !body.body->is_static && body.body->box.lo.y > b.lo.y;
  };
  if (bodies.size() > kMostScaled || std::ranges::none_of(bodies, floats)) return;
  // The edges that are farthest out on the page, to the left and to the right.
  std::vector<Vec<3>> feet = floor_of(b);
  std::erase_if(feet, [&](const Vec<3>& p) {
    return !view.in_front(p) || !view.in_front({p.x, b.hi.y, p.z});
  });
  if (feet.size() < 4) return;
  const auto x_of = [&](const Vec<3>& p) { return view.to_page(p).x; };
  const Vec<3> left = *std::ranges::min_element(feet, {}, x_of);
  const Vec<3> right = *std::ranges::max_element(feet, {}, x_of);
  for (const auto& [foot, side] : {std::pair{left, -1}, std::pair{right, 1}})
    if (write_scale(foot, side, view, list, labels)) return name_axes(foot, view, labels);
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
    marks.line(c, foot, {b.body->lit ? Role::ink : Role::quiet_ink, b.body->lit ? 1.8 : 1.4, 5});
    if (marks.bodies.size() <= kMostScaled) add_ticks(c, foot, marks);
    if (const auto page = marks.view.segment(foot, foot); page && b.body->box.lo.y > foot.y) {
      const Box<2> spot = Box<2>::around(page->first, Vec<2>(kFoot));
      marks.add(Convex::line(foot, foot), polygon_of(spot),
                {RectShape{spot, kFoot, Role::quiet_ink}});
    }
  }
}

}  // namespace lantern::draw
