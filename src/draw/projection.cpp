#include "draw/projection.hpp"

#include <cmath>
#include <numbers>

#include "geometry/elementary.hpp"
#include "geometry/not_finite.hpp"

namespace lantern::draw {
namespace {

double cross(const Vec<2>& o, const Vec<2>& a, const Vec<2>& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

std::pair<double, double> extent_along(const Vec<2>& direction, const Outline& points) {
  std::pair<double, double> extent{1e300, -1e300};
  for (const Vec<2>& p : points) {
    extent.first = std::min(extent.first, glm::dot(direction, p));
    extent.second = std::max(extent.second, glm::dot(direction, p));
  }
  return extent;
}

// Some edge of `a` has all of `b` on its outer side.
bool parted_by_edge(const Outline& a, const Outline& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec<2> along = a[(i + 1) % a.size()] - a[i];
    const Vec<2> normal{-along.y, along.x};
    const auto [a_lo, a_hi] = extent_along(normal, a);
    const auto [b_lo, b_hi] = extent_along(normal, b);
    if (a_hi <= b_lo || b_hi <= a_lo) return true;
  }
  return false;
}

// Normals at an angle to a unit axis whose cosine is given: a circle.
std::vector<Vec<3>> circle(const Vec<3>& axis, double cosine) {
  constexpr int kPoints = 48;
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const Vec<3> side = across(axis);
  const Vec<3> other = glm::cross(axis, side);
  std::vector<Vec<3>> normals;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPoints;
    normals.push_back(axis * cosine +
                      (side * geometry::cos(angle) + other * geometry::sin(angle)) * sine);
  }
  return normals;
}

// Where the corners of a box come by when it turns about the upright line through `middle`: so that
// a picture that fits them fits from every side, and does not breathe while the eye goes round.
std::vector<Vec<3>> all_round(const Box<3>& box, const Vec<3>& middle) {
  constexpr int kWays = 48;
  double radius = 0;
  for (const Vec<3>& c : corners_of(box))
    radius = std::max(radius, geometry::hypot(c.x - middle.x, c.z - middle.z));
  std::vector<Vec<3>> points;
  for (int i = 0; i < kWays; ++i) {
    const double angle = 2 * std::numbers::pi * i / kWays;
    for (const double y : {box.lo.y, box.hi.y})
      points.push_back(
          {middle.x + radius * geometry::cos(angle), y, middle.z + radius * geometry::sin(angle)});
  }
  return points;
}

}  // namespace

// Andrew's monotone chain (1979).
Outline hull_of(Outline points) {
  std::ranges::sort(points, {}, [](const Vec<2>& p) { return std::pair(p.x, p.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Outline hull;
  const auto go = [&](const auto& first, const auto& last) {
    const std::size_t start = hull.size();
    for (auto p = first; p != last; ++p) {
      while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), *p) <= 0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();  // where the other half starts
  };
  go(points.begin(), points.end());
  go(points.rbegin(), points.rend());
  return hull;
}

bool cover_each_other(const Outline& a, const Outline& b) {
  return !parted_by_edge(a, b) && !parted_by_edge(b, a);
}

std::vector<Vec<3>> clipped(const std::vector<Vec<3>>& polygon, const Vec<3>& normal,
                            double offset) {
  std::vector<Vec<3>> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<3>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = glm::dot(normal, a) - offset, at_b = glm::dot(normal, b) - offset;
    if (at_a >= 0) kept.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) kept.push_back(a + (b - a) * (at_a / (at_a - at_b)));
  }
  return kept;
}

std::vector<Vec<3>> corners_of(const Box<3>& box) {
  std::vector<Vec<3>> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners.push_back({(i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
                       (i & 4) != 0 ? box.hi.z : box.lo.z});
  return corners;
}

View2D::View2D(const Box<2>& bounds, const Box<2>& panel, const std::optional<Box<2>>& part)
    : Projection(panel) {
  constexpr double kMargin = 3;  // half of the thickest line
  const Vec<2> room = shrunk(panel, kMargin).size();
  const Box<2> shown = part.value_or(bounds);
  const Vec<2> size = shown.size();
  scale_ = std::min(size.x > 0 ? room.x / size.x : 1e300, size.y > 0 ? room.y / size.y : 1e300);
  if (scale_ == 1e300) scale_ = 1;
  origin_ = panel.center() - Vec<2>(shown.center().x, -shown.center().y) * scale_;
  picture_ = to_page(shown);
  size_ = std::max(bounds.size().x, bounds.size().y);
  longest_arrow_ = 120 / scale_;
}

View3D::View3D(const Box<3>& bounds, const std::optional<Camera>& camera, const Box<2>& panel)
    : Projection(panel), bounds_(bounds) {
  size_ = glm::length(bounds.size());
  if (!(size_ > 0)) size_ = 1;
  near_ = 1e-3 * size_;
  longest_arrow_ = 0.18 * size_;
  origin_ = panel.center();
  const bool usable = camera && is_finite(camera->eye) && is_finite(camera->target) &&
                      glm::length(camera->target - camera->eye) > 1e-9 * size_;
  const Camera used = usable ? *camera : usual_camera(bounds);
  aim(used);
  fit(used, usable);
}

void View3D::aim(const Camera& camera) {
  eye_ = camera.eye;
  forward_ = glm::normalize(camera.target - camera.eye);
  // Straight up or down, away from the viewer is up on the page.
  const Vec<3> above = std::abs(forward_.y) > 0.9999 ? Vec<3>(0, 0, -1) : Vec<3>(0, 1, 0);
  right_ = glm::normalize(glm::cross(forward_, above));
  up_ = glm::cross(right_, forward_);
  // From above and the left, so that a box shows a lit top, a middle and a shaded side.
  const Vec<3> level_back = glm::cross(right_, Vec<3>(0, 1, 0));
  light_ = glm::normalize(Vec<3>(0, 0.72, 0) - right_ * 0.6 + level_back * 0.35);
}

void View3D::fit(const Camera& camera, bool chosen) {
  constexpr double kMargin = 6;        // for the thickest line
  constexpr double kBeside = 40;       // for a scale of heights
  constexpr double kClearlyOut = 1.3;  // of the panel's height
  Box<2> room = shrunk(panel_, kMargin);
  if (room.size().x > 6 * kBeside) {
    room.lo.x += kBeside;
    room.hi.x -= kBeside;
  }
  const double field = camera.field_of_view;
  const double angle = field > 0.01 && field < 3 ? field : 0.7;
  scale_ = std::max(room.size().y, 1.0) / 2 / geometry::tan(angle / 2);
  if (contains(bounds_, eye_)) return;
  Outline corners;
  for (const Vec<3>& corner :
       camera.goes_round ? all_round(bounds_, camera.target) : corners_of(bounds_)) {
    if (depth(corner) < 10 * near_) return;
    corners.push_back(to_page(corner));
  }
  const Box<2> seen = box_of(corners);
  const Vec<2> size = seen.size();
  if (!(size.x > 0) && !(size.y > 0)) return;
  if (chosen && size.y > kClearlyOut * room.size().y) return;
  const double k =
      std::min(room.size().x / std::max(size.x, 1e-9), room.size().y / std::max(size.y, 1e-9));
  if (!(k > 0)) return;
  origin_ = room.center() + (origin_ - seen.center()) * k;
  scale_ *= k;
}

double View3D::farness(const Vec<3>& p) const {
  double least = 1e300, most = -1e300;
  for (const Vec<3>& corner : corners_of(bounds_)) {
    least = std::min(least, depth(corner));
    most = std::max(most, depth(corner));
  }
  return most > least ? std::clamp((depth(p) - least) / (most - least), 0.0, 1.0) : 0;
}

bool View3D::lost(const Vec<3>& p) const {
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(p[i] - eye_[i]) < 1e6 * size_)) return true;
  return false;
}

Vec<2> View3D::to_page(const Vec<3>& p) const { return origin_ + turned(p - eye_) * scale_at(p); }

std::optional<Vec<2>> View3D::seen(const Vec<3>& p) const {
  if (lost(p) || !in_front(p)) return std::nullopt;
  return to_page(p);
}

Outline View3D::polygon(const std::vector<Vec<3>>& corners) const {
  Outline outline = mapped(clipped(corners, forward_, glm::dot(forward_, eye_) + near_),
                           [&](const Vec<3>& p) { return to_page(p); });
  if (outline.size() < 3) outline.clear();
  return outline;
}

std::optional<std::pair<Vec<3>, Vec<3>>> View3D::in_sight(const Vec<3>& a, const Vec<3>& b) const {
  const double at_a = depth(a) - near_, at_b = depth(b) - near_;
  if (at_a < 0 && at_b < 0) return std::nullopt;
  const auto cut = [&] { return a + (b - a) * (at_a / (at_a - at_b)); };
  if (at_a < 0) return std::pair{cut(), b};
  if (at_b < 0) return std::pair{a, cut()};
  return std::pair{a, b};
}

std::optional<std::pair<Vec<2>, Vec<2>>> View3D::segment(const Vec<3>& a, const Vec<3>& b) const {
  const auto seen = in_sight(a, b);
  if (!seen) return std::nullopt;
  return cut_line(to_page(seen->first), to_page(seen->second), panel_);
}

//      axis          The eye sees the normals n with n . v >= r / d: v towards the eye, d the
//     .-^-.          distance. The cap as seen is bounded by its own rim, as far as that is seen,
//    /-----\  rim    and by the outline of the ball, as far as that lies in the cap.
//   |   c   |
Outline View3D::ball_cap(const Vec<3>& center, double radius, const Vec<3>& axis,
                         double least_cosine) const {
  const Vec<3> to_eye = eye_ - center;
  const double distance = glm::length(to_eye);
  if (!(distance > radius * 1.0001) || !(radius > 0)) return {};
  const Vec<3> v = to_eye / distance;
  const double horizon = radius / distance;
  std::vector<Vec<3>> rim;
  for (const Vec<3>& n : circle(v, horizon))
    if (least_cosine <= -1 || glm::dot(n, axis) >= least_cosine) rim.push_back(center + n * radius);
  if (least_cosine > -1)
    for (const Vec<3>& n : circle(axis, least_cosine))
      if (glm::dot(n, v) > horizon) rim.push_back(center + n * radius);
  return hull_of(polygon(rim));
}

}  // namespace lantern::draw
