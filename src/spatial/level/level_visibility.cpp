#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/stop.hpp"
#include "spatial/level/level_bsp.hpp"

namespace lantern::spatial {

namespace {

// A point of a line, and how far along it.
struct Stop {
  double at = 0;
  Vec<2> point{0.0};
};
using Stretch = std::pair<Stop, Stop>;

// The parts of sectors' common borders that are no wall.
class PortalFinder {
 public:
  explicit PortalFinder(const LevelBsp& level) : level_(level), near_(4 * level.tolerance()) {
    walls_.resize(level.sectors().size());
    for (const WallPiece& piece : level.pieces())
      if (!level.walls()[piece.wall].two_sided) walls_[piece.sector].push_back(piece.line);
    for (const LevelSector& sector : level.sectors()) boxes_.push_back(grown_box(sector.floor));
  }

  std::vector<Portal> find() {
    const auto n = static_cast<std::uint32_t>(boxes_.size());
    for (std::uint32_t a = 0; a < n; ++a) {
      stop_if_asked();
      for (std::uint32_t b = a + 1; b < n; ++b)
        if (overlap(boxes_[a], boxes_[b])) add_between(a, b);
    }
    return std::move(portals_);
  }

 private:
  Box<2> grown_box(const Polygon& floor) const {
    const Box<2> box = box_of(floor);
    return {box.lo - near_, box.hi + near_};
  }

  void add_between(std::uint32_t a, std::uint32_t b) {
    const Polygon &of_a = level_.sectors()[a].floor, &of_b = level_.sectors()[b].floor;
    for (std::size_t i = 0; i < of_a.size(); ++i)
      for (std::size_t j = 0; j < of_b.size(); ++j) {
        const Segment<2> edge{of_a[i], of_a[(i + 1) % of_a.size()]};
        const auto common = common_part(edge, {of_b[j], of_b[(j + 1) % of_b.size()]});
        if (!common) continue;
        for (const Stretch& open : without_walls(edge, *common, a, b))
          portals_.push_back({a, b, {open.first.point, open.second.point}});
      }
  }

  // Of two segments on one line, what they share; in the direction of the first.
  std::optional<Stretch> common_part(const Segment<2>& edge, const Segment<2>& other) const {
    const double size = length(edge);
    if (!(size > near_)) return {};
    const Plane<2> line = line_of(edge);
    if (std::abs(height(other.a, line)) > near_ || std::abs(height(other.b, line)) > near_)
      return {};
    const Vec<2> along = (edge.b - edge.a) / size;
    Stop first{glm::dot(other.a - edge.a, along), other.a};
    Stop last{glm::dot(other.b - edge.a, along), other.b};
    if (first.at > last.at) std::swap(first, last);
    if (first.at < 0) first = {0, edge.a};
    if (last.at > size) last = {size, edge.b};
    if (!(last.at - first.at > near_)) return {};
    return Stretch{first, last};
  }

  std::vector<Stretch> without_walls(const Segment<2>& edge, const Stretch& common, std::uint32_t a,
                                     std::uint32_t b) const {
    std::vector<Stretch> open{common};
    for (const std::uint32_t sector : {a, b})
      for (const Segment<2>& wall : walls_[sector])
        if (const auto hidden = common_part(edge, wall)) {
          std::vector<Stretch> left;
          for (const Stretch& part : open) {
            const Stop before = hidden->first.at < part.second.at ? hidden->first : part.second;
            const Stop behind = hidden->second.at > part.first.at ? hidden->second : part.first;
            if (before.at - part.first.at > near_) left.emplace_back(part.first, before);
            if (part.second.at - behind.at > near_) left.emplace_back(behind, part.second);
          }
          open = std::move(left);
        }
    return open;
  }

  const LevelBsp& level_;
  double near_;
  std::vector<std::vector<Segment<2>>> walls_;  // by sector, one-sided ones
  std::vector<Box<2>> boxes_;
  std::vector<Portal> portals_;
};

// All lines of sight through a row of portals.
class Beam {
 public:
  // The differences of left and right ends lie between these two directions, counter-clockwise.
  struct Bounds {
    Vec<2> first{0.0};
    Vec<2> last{0.0};
    bool any = false;
  };

  explicit Beam(double tolerance) : tolerance_(tolerance) {}

  const Bounds& bounds() const { return bounds_; }

  // Through one portal more; false, and nothing changes, if no line passes that one as well.
  bool narrow(const Vec<2>& left, const Vec<2>& right) {
    Bounds bounds = bounds_;
    bool passes = widen(bounds, left - right);
    for (std::size_t i = 0; i < lefts_.size() && passes; ++i)
      passes = widen(bounds, left - rights_[i]) && widen(bounds, lefts_[i] - right);
    if (!passes) return false;
    bounds_ = bounds;
    lefts_.push_back(left);
    rights_.push_back(right);
    return true;
  }
  // Without the last portal, as it was before it.
  void go_back(const Bounds& before) {
    bounds_ = before;
    lefts_.pop_back();
    rights_.pop_back();
  }

  // One of the lines, far from the portals' ends; its direction, and a point on it.
  std::pair<Vec<2>, Vec<2>> line() const {
    const Vec<2> normal =
        glm::normalize(glm::normalize(bounds_.first) + glm::normalize(bounds_.last));
    double least = glm::dot(normal, lefts_[0]), most = glm::dot(normal, rights_[0]);
    for (const Vec<2>& left : lefts_) least = std::min(least, glm::dot(normal, left));
    for (const Vec<2>& right : rights_) most = std::max(most, glm::dot(normal, right));
    return {{normal.y, -normal.x}, normal * ((least + most) / 2)};
  }

 private:
  // Is b counter-clockwise of a (1), clockwise of it (-1), or in line with it?
  int turn(const Vec<2>& a, const Vec<2>& b) const {
    const double cross = a.x * b.y - a.y * b.x;
    const double least = tolerance_ * (glm::length(a) + glm::length(b));
    return cross > least ? 1 : cross < -least ? -1 : 0;
  }

  // Takes the direction between the bounds; false if they would be half a turn apart, or more.
  bool widen(Bounds& bounds, const Vec<2>& way) const {
    if (!(glm::length(way) > tolerance_)) return false;
    if (!bounds.any) {
      bounds = {way, way, true};
      return true;
    }
    const int from_first = turn(bounds.first, way), from_last = turn(bounds.last, way);
    if (from_last > 0) {
      if (from_first <= 0) return false;
      bounds.last = way;
    } else if (from_first < 0) {
      if (from_last >= 0) return false;
      bounds.first = way;
    } else if (from_first == 0 && from_last == 0) {
      return glm::dot(bounds.first, way) > 0;
    }
    return true;
  }

  double tolerance_;
  Bounds bounds_;
  std::vector<Vec<2>> lefts_, rights_;
};

// From where to where a line lies within a convex polygon, which it crosses.
std::pair<double, double> span_within(const Polygon& polygon, const Vec<2>& at,
                                      const Vec<2>& along) {
  double from = -1e300, to = 1e300;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2> edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const Vec<2> inwards{-edge.y, edge.x};
    const double rise = glm::dot(inwards, along), deep = glm::dot(inwards, at - polygon[i]);
    if (rise > 0) from = std::max(from, -deep / rise);
    if (rise < 0) to = std::min(to, -deep / rise);
  }
  return {from, to};
}

}  // namespace

// Looks out of each sector in turn.
class SightFinder {
 public:
  SightFinder(const LevelBsp& level, const VisibilityConfig& config)
      : level_(level), config_(config), beam_(level.tolerance()) {}

  LevelVisibility run(const VisibilityObserver& observer) {
    const std::size_t n = level_.sectors().size();
    if (n > config_.most_sectors)
      throw Refused("level: it has {} sectors, its visibility is found of at most {}", n,
                    config_.most_sectors);
    found_.sectors = static_cast<std::uint32_t>(n);
    found_.seen.assign(n * n, 0);
    for (std::size_t i = 0; i < n; ++i) found_.seen[i * n + i] = 1;
    found_.portals = PortalFinder(level_).find();
    ways_out_.resize(n);
    for (std::uint32_t p = 0; p < found_.portals.size(); ++p) {
      ways_out_[found_.portals[p].a].push_back(p);
      ways_out_[found_.portals[p].b].push_back(p);
    }
    if (observer) observer(found_);
    for (eye_ = 0; eye_ < n; ++eye_) {
      look_on(eye_, kNone);
      ++found_.done;
      if (observer) observer(found_);
    }
    return std::move(found_);
  }

 private:
  // Through all portals of a sector but the one that the view came by. A line enters a convex
  // sector once, so no view runs in circles.
  void look_on(std::uint32_t sector, std::uint32_t came_by) {
    for (const std::uint32_t p : ways_out_[sector]) {
      if (p == came_by) continue;
      stop_if_asked();
      if (++found_.portals_tested > config_.most_tests)
        throw Refused("level: its visibility takes more than {} tests of portals",
                      config_.most_tests);
      const Portal& portal = found_.portals[p];
      const bool forth = portal.a == sector;  // from a's side the line's end is on the left
      const Beam::Bounds before = beam_.bounds();
      if (!beam_.narrow(forth ? portal.line.b : portal.line.a,
                        forth ? portal.line.a : portal.line.b))
        continue;
      const std::uint32_t next = forth ? portal.b : portal.a;
      note(next);
      look_on(next, p);
      beam_.go_back(before);
    }
  }

  // The eye's sector sees this one.
  void note(std::uint32_t sector) {
    const std::size_t n = found_.sectors;
    if (found_.seen[eye_ * n + sector]) return;
    found_.seen[eye_ * n + sector] = found_.seen[sector * n + eye_] = 1;
    const auto [along, at] = beam_.line();
    const auto [from, out] = span_within(level_.sectors()[eye_].floor, at, along);
    const auto [in, to] = span_within(level_.sectors()[sector].floor, at, along);
    found_.sights.push_back(
        {eye_, sector, {at + along * ((from + out) / 2), at + along * ((in + to) / 2)}});
  }

  const LevelBsp& level_;
  const VisibilityConfig& config_;
  LevelVisibility found_;
  std::vector<std::vector<std::uint32_t>> ways_out_;  // of each sector: its portals
  std::uint32_t eye_ = 0;                             // the sector whose view is followed
  Beam beam_;
};

LevelVisibility find_visibility(const LevelBsp& level, const VisibilityConfig& config,
                                const VisibilityObserver& observer) {
  return SightFinder(level, config).run(observer);
}

}  // namespace lantern::spatial
