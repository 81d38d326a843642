#include "physics/gjk.hpp"

#include <algorithm>

#include "geometry/elementary.hpp"
#include "physics/narrow/cores.hpp"

namespace lantern::physics {
namespace {

using GjkCore = narrow::PlacedCore<2>;

std::optional<GjkCore> gjk_core(const Placed<2>& shape, const Vec<2>& center) {
  GjkCore core;
  return narrow::place(shape, center, core) ? std::optional(core) : std::nullopt;
}

Vec<2> left_of(const Vec<2>& v) { return {-v.y, v.x}; }

// Of a simplex the points that its nearest point to the origin lies between, and that point.
struct Nearest {
  std::vector<SupportPair> simplex;
  std::vector<double> weights;  // of its points; together 1
  Vec<2> point{0.0};
};

Nearest nearest_of(const SupportPair& p) { return {{p}, {1}, p.difference()}; }

Nearest nearest_of(const SupportPair& p, const SupportPair& q) {
  const Vec<2> from = p.difference(), along = q.difference() - from;
  const double square = glm::dot(along, along);
  const double t = square > 0 ? -glm::dot(from, along) / square : 0;
  if (t <= 0) return nearest_of(p);
  if (t >= 1) return nearest_of(q);
  // The foot of the origin on the line: of the line's normal it is exact where t is rounded.
  const Vec<2> normal = left_of(along);
  return {{p, q}, {1 - t, t}, normal * (glm::dot(from, normal) / square)};
}

// The newest point is the last one. The origin lies beyond the edge of the first two, or it would
// not have been searched for there: so the nearest point lies on an edge of the newest, if the
// origin is not inside.
Nearest nearest_of(const SupportPair& p, const SupportPair& q, const SupportPair& newest) {
  const Vec<2> a = p.difference(), b = q.difference(), c = newest.difference();
  const double turn = cross(b - a, c - a) < 0 ? -1 : 1;
  const auto inside = [&](const Vec<2>& from, const Vec<2>& to) {
    return turn * cross(to - from, -from) >= 0;
  };
  if (inside(a, b) && inside(b, c) && inside(c, a)) return {{p, q, newest}, {}, Vec<2>(0.0)};
  Nearest one = nearest_of(p, newest), other = nearest_of(q, newest);
  return glm::dot(one.point, one.point) <= glm::dot(other.point, other.point) ? one : other;
}

Nearest with(const Nearest& before, const SupportPair& found) {
  const std::vector<SupportPair>& s = before.simplex;
  return s.size() == 1 ? nearest_of(s[0], found) : nearest_of(s[0], s[1], found);
}

SupportPair closest_points_of(const Nearest& nearest) {
  SupportPair points;
  for (std::size_t i = 0; i < nearest.simplex.size(); ++i) {
    points.a += nearest.simplex[i].a * nearest.weights[i];
    points.b += nearest.simplex[i].b * nearest.weights[i];
  }
  return points;
}

// A corner of the plane's boxes is looked at once; more steps are rounding.
constexpr int kMostSearches = 32;

// Places are relative to the first shape.
class GjkSearch {
 public:
  GjkSearch(const GjkCore& a, const GjkCore& b, const Vec<2>& origin, std::vector<GjkStep>* watch)
      : a_(a), b_(b), origin_(origin), watch_(watch) {}

  GjkAnswer run() {
    // The first point is farthest along the way from one centre to the other.
    Vec<2> direction = direction_of(b_.center - a_.center, narrow::fallback_normal<2>()).unit;
    SupportPair found = farthest(direction);
    Nearest nearest = nearest_of(found);
    tell(direction, found, false, nearest);
    for (int steps = 1; steps < kMostSearches; ++steps) {
      const double distance = glm::length(nearest.point);
      if (nearest.simplex.size() == 3 || distance <= narrow::kRounding * size_)
        return {true, 0, {}, steps};
      direction = -nearest.point / distance;
      found = farthest(direction);
      const double farther = glm::dot(found.difference() - nearest.point, direction);
      const bool ends = farther <= narrow::kRounding * size_;
      if (!ends) nearest = with(nearest, found);
      tell(direction, found, ends, nearest);
      if (ends) return apart(nearest, direction, steps + 1);
    }
    return apart(nearest, direction, kMostSearches);
  }

 private:
  SupportPair farthest(const Vec<2>& d) const { return {a_.support(d), b_.support(-d)}; }

  // `direction` leads from the difference to the origin: from a to b.
  GjkAnswer apart(const Nearest& nearest, const Vec<2>& direction, int steps) const {
    const double distance = glm::length(nearest.point) - a_.radius - b_.radius;
    if (distance <= 0) return {true, 0, {}, steps};
    SupportPair closest = closest_points_of(nearest);
    closest.a += direction * a_.radius + origin_;
    closest.b += -direction * b_.radius + origin_;
    return {false, distance, closest, steps};
  }

  void tell(const Vec<2>& direction, const SupportPair& found, bool ends, const Nearest& nearest) {
    if (!watch_) return;
    GjkStep step{direction, in_world(found), ends, {}, nearest.point};
    for (const SupportPair& p : nearest.simplex) step.simplex.push_back(in_world(p));
    watch_->push_back(std::move(step));
  }
  SupportPair in_world(const SupportPair& p) const { return {p.a + origin_, p.b + origin_}; }

  const GjkCore &a_, &b_;
  Vec<2> origin_;
  std::vector<GjkStep>* watch_;
  const double size_ =
      glm::length(b_.center - a_.center) + a_.half.x + a_.half.y + b_.half.x + b_.half.y;
};

}  // namespace

std::optional<GjkAnswer> gjk(const Placed<2>& a, const Placed<2>& b, std::vector<GjkStep>* watch) {
  const auto core_a = gjk_core(a, Vec<2>(0.0)), core_b = gjk_core(b, b.position - a.position);
  if (!core_a || !core_b) return std::nullopt;
  return GjkSearch(*core_a, *core_b, a.position, watch).run();
}

// Between two neighbouring normals of either shape's faces, one corner is the farthest.
std::optional<MinkowskiDifference> minkowski_difference(const Placed<2>& a, const Placed<2>& b) {
  const auto core_a = gjk_core(a, Vec<2>(0.0)), core_b = gjk_core(b, b.position - a.position);
  if (!core_a || !core_b) return std::nullopt;
  std::vector<Vec<2>> normals;
  for (const GjkCore* core : {&*core_a, &*core_b})
    for (int i = 0; i < 2; ++i) normals.insert(normals.end(), {core->axes[i], -core->axes[i]});
  std::ranges::sort(normals, {}, [](const Vec<2>& n) { return geometry::atan2(n.y, n.x); });
  MinkowskiDifference difference{{}, core_a->radius + core_b->radius};
  for (std::size_t i = 0; i < normals.size(); ++i) {
    // Box axes stand at right angles: two neighbours are never opposite.
    const Vec<2> between = normals[i] + normals[(i + 1) % normals.size()];
    const Vec<2> corner = core_a->support(between) - core_b->support(-between);
    if (difference.corners.empty() || corner != difference.corners.back())
      difference.corners.push_back(corner);
  }
  if (difference.corners.size() > 1 && difference.corners.front() == difference.corners.back())
    difference.corners.pop_back();
  return difference;
}

std::optional<FarthestPoints> farthest_points(const Placed<2>& shape, const Vec<2>& along) {
  constexpr double kTilt = 1e-9;  // more than rounding turns a face
  const auto core = gjk_core(shape, Vec<2>(0.0));
  if (!core) return std::nullopt;
  const Vec<2> out = shape.position + along * core->radius;
  return FarthestPoints{core->support(along - left_of(along) * kTilt) + out,
                        core->support(along + left_of(along) * kTilt) + out};
}

}  // namespace lantern::physics
