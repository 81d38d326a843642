#include "draw/body_shapes.hpp"

#include <numbers>

#include "geometry/elementary.hpp"
#include "geometry/flat.hpp"
namespace lantern::draw {
namespace {

// Round the ends of a segment along y, in the body's own axes, counter-clockwise.
std::vector<Vec<2>> capsule_outline(const Capsule& capsule) {
  constexpr int kPerEnd = 14;
  std::vector<Vec<2>> points;
  for (const int end : {1, -1})
    for (int i = 0; i <= kPerEnd; ++i) {
      const double angle = (i / double(kPerEnd) + (end < 0)) * std::numbers::pi;
      points.push_back(unit_at(angle) * capsule.radius + Vec<2>(0, end * capsule.half_length));
    }
  return points;
}

// In the body's own axes; empty for what looks the same however it is turned, or never turns.
std::vector<Vec<2>> turning_outline(const Shape<3>& shape) {
  using Points = std::vector<Vec<2>>;
  return std::visit(
      EachShape{[](const Sphere&) { return Points(); }, [](const AxisBox<3>&) { return Points(); },
                [](const OrientedBox<3>& box) {
                  return polygon_of({-flat(box.half_size), flat(box.half_size)});
                },
                [](const Capsule& capsule) { return capsule_outline(capsule); },
                [](const HalfSpace<3>&) { return Points(); }},
      shape);
}

}  // namespace

BodiesById by_id(const std::vector<FrameBody>& bodies) {
  BodiesById found;
  for (const FrameBody& body : bodies) found[body.id] = &body;
  return found;
}

Vec<3> foot_on(const FrameBody& ground, const Vec<3>& point) {
  const Vec<3>& normal = std::get<HalfSpace<3>>(ground.shape).normal;
  return point - normal * glm::dot(normal, point - ground.position);
}

Vec<3> link_end(const FrameBody& body, const FrameBody& other) {
  return is_half_space(body) ? foot_on(body, other.position) : body.position;
}

std::vector<Vec<2>> turned_outline(const FrameBody& body, const Box<2>& place) {
  std::vector<Vec<2>> points = turning_outline(body.shape);
  if (points.empty()) return points;
  const auto [s, c] = geometry::sin_cos(body.angle);
  Vec<2> reach{0.0};  // from the middle
  for (Vec<2>& p : points) {
    p = Vec<2>(c * p.x - s * p.y, -(s * p.x + c * p.y));
    reach = glm::max(reach, glm::abs(p));
  }
  Vec<2> size(body.box.size());
  const Vec<2> room = place.size();
  for (int i = 0; i < 2; ++i)  // far from the origin its box is rounded to a line
    if (!(size[i] > 0)) size[i] = 2 * reach[i];
  // One scale for both axes, or the shape would not keep its angles.
  const double scale = std::max(size.x, size.y) > 0 ? std::min(size.x > 0 ? room.x / size.x : 1e300,
                                                               size.y > 0 ? room.y / size.y : 1e300)
                                                    : 0;
  for (Vec<2>& p : points) p = place.center() + p * scale;
  return points;
}

Plane<2> page_surface(const FrameBody& body, const Vec<2>& through) {
  const Vec<3>& normal = std::get<HalfSpace<3>>(body.shape).normal;
  Vec<2> on_page{normal.x, -normal.y};
  if (!(geometry::hypot(on_page.x, on_page.y) > 1e-9)) on_page = {0, -1};  // seen from above
  return Plane<2>::through(through, on_page / geometry::hypot(on_page.x, on_page.y));
}

void draw_icon(const FrameBody* body, const Box<2>& place, DrawList& list) {
  if (!body) return;
  const Vec<2> size = body->box.size();
  const double longest = std::max(size.x, size.y);
  if (!(longest > 0)) return draw_character(*body, place, false, list);
  const Vec<2> half{std::max(size.x / longest, 0.34), std::max(size.y / longest, 0.34)};
  draw_character(*body, Box<2>::around(place.center(), half * place.size() * 0.5), false, list);
}

}  // namespace lantern::draw
