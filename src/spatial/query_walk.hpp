// How a question goes through a structure: one walk for every structure and all that is asked.
//
// A node is entered if what we look for reaches its zone: its box, without end where the box lies
// at the rim of an orthtree's root (bodies outside the root are stored there), or its sides of the
// planes of a BSP. Otherwise the whole branch is skipped. A ray enters nodes front to back, as far
// as the tree's cells have such an order, and none that begins behind the nearest hit so far: what
// is left of the tree then is never looked at.
//
//     origin .--->--+--------+--------+     the hit in the first cell is nearer than where the ray
//                   |  hit   |skipped |     enters the second
//                   +--------+--------+
#pragma once

#include <limits>
#include <type_traits>
#include <utility>

#include "base/stop.hpp"
#include "geometry/not_finite.hpp"
#include "spatial/query.hpp"

namespace lantern::spatial {

// Where the bodies of a node, or at least the parts of them for which the node answers, may lie.
enum class Zones {
  fitted,       // within its box
  endless_rim,  // within its box, but without end where that box lies at the root's rim
  rounded_rim,  // as endless_rim, and beyond the box by its slack
  half_spaces,  // on the node's sides of all planes above it; its box says nothing
};

// The node's box, whose edges may have been rounded by as much as `slack`, grown by that, and
// without end on the sides where it ends with the root.
template <int D>
Box<D> endless_at_rim(Box<D> box, const Box<D>& root, double slack) {
  for (int i = 0; i < D; ++i) {
    box.lo[i] = box.lo[i] <= root.lo[i] + slack ? -kInfinity : box.lo[i] - slack;
    box.hi[i] = box.hi[i] >= root.hi[i] - slack ? kInfinity : box.hi[i] + slack;
  }
  return box;
}

// The zones of nodes in the order of visiting, for a Probe, which has
//   Part                        what of the probe is left in a zone; copyable
//   whole()                     the Part that is everywhere
//   in_box(zone)                optional<Part>: what lies in a box that may be infinite
//   beside(Part, plane, front)  optional<Part>: what of the part lies on that side; the plane is
//                               scaled
template <int D, Zones kZones, class Probe>
class ZoneWalk {
 public:
  using Part = typename Probe::Part;

  explicit ZoneWalk(const Probe& probe) : probe_(probe) {}

  // What of the probe is in the node's zone. To be called once for each node visited.
  std::optional<Part> part_in(const NodeView<D>& node) {
    if constexpr (kZones == Zones::half_spaces) {
      std::optional<Part> part = probe_.whole();
      if (node.depth > 0) {
        const Above& above = way_[node.depth - 1];
        part = probe_.beside(above.part, above.plane, node.slot == 1);
      }
      if (part && !node.leaf) {
        way_.resize(node.depth);
        way_.push_back({*part, scaled(*node.plane)});
      }
      return part;
    } else if constexpr (kZones == Zones::fitted) {
      return probe_.in_box(node.box);
    } else {
      if (node.parent == kNone) root_ = node.box;
      const double slack = kZones == Zones::rounded_rim ? node.slack : 0;
      return probe_.in_box(endless_at_rim(node.box, root_, slack));
    }
  }

 private:
  struct Above {
    Part part;
    Plane<D> plane;
  };
  const Probe& probe_;
  Box<D> root_;
  std::vector<Above> way_;  // the inner nodes above, the root first
};

template <int D>
struct RayProbe {
  using Part = RaySpan;
  const Ray<D>& ray;

  RaySpan whole() const { return {0, ray.length}; }
  std::optional<RaySpan> in_box(const Box<D>& zone) const { return span_in(ray, zone); }

  // The height over the plane at t is h + t * rate, up to an error of at most e + t * r. So the
  // part in front is not longer than where (h + e) + t * (rate + r) >= 0; behind, all signs are
  // turned. Where numbers overflow, nothing is cut off.
  std::optional<RaySpan> beside(RaySpan part, const Plane<D>& plane, bool front) const {
    constexpr double kError = 64 * std::numeric_limits<double>::epsilon();
    double h = -plane.offset, rate = 0, e = std::abs(plane.offset), r = 0;
    for (int i = 0; i < D; ++i) {
      const double a = plane.normal[i] * ray.origin[i], b = plane.normal[i] * ray.direction[i];
      h += a;
      rate += b;
      e += std::abs(a);
      r += std::abs(b);
    }
    const double begin = (front ? h : -h) + e * kError;
    const double slope = (front ? rate : -rate) + r * kError;
    if (slope == 0) return begin < 0 ? std::nullopt : std::optional(part);
    if (begin + part.from * slope < 0 && begin + part.to * slope < 0) return std::nullopt;
    const double crossing = -begin / slope;
    if (slope > 0) part.from = std::max(part.from, crossing * (1 - kError));
    if (slope < 0) part.to = std::min(part.to, crossing * (1 + kError));
    return part;
  }
};

// Whether a volume may lie within the zone of a node, which may be infinite. Of a frustum only its
// planes are looked at, which is cheap and lets some in that lie outside, near its corners.
template <int D, template <int> class Volume>
bool may_overlap(const Volume<D>& volume, const Box<D>& zone) {
  return overlap(volume, zone);
}

// Whether it may reach that side of a plane; generous by more than the error of heights.
template <int D>
bool may_reach(const Box<D>& box, const Plane<D>& plane, bool front) {
  const Reach sides = reach(box, plane);
  return front ? sides.front : sides.back;
}
template <int D>
bool may_reach(const Ball<D>& ball, const Plane<D>& plane, bool front) {
  constexpr double kError = 64 * std::numeric_limits<double>::epsilon();
  double sum = std::abs(plane.offset), square = 0;
  for (int i = 0; i < D; ++i) {
    sum += std::abs(plane.normal[i] * ball.center[i]);
    square += plane.normal[i] * plane.normal[i];
  }
  const double h = height(ball.center, plane);
  const double most = (front ? h : -h) + ball.radius * std::sqrt(square);
  return !(most < -kError * (sum + ball.radius));
}
template <int D>
bool may_reach(const Frustum<D>& frustum, const Plane<D>& plane, bool front) {
  constexpr double kError = 1024 * std::numeric_limits<double>::epsilon();
  for (const Vec<D>& corner : frustum.corners) {
    double sum = std::abs(plane.offset);
    for (int i = 0; i < D; ++i) sum += std::abs(plane.normal[i] * corner[i]);
    const double h = height(corner, plane);
    if (!((front ? h : -h) < -kError * sum)) return true;
  }
  return false;
}

// A volume is in a zone or not: it has no parts.
template <int D, class Volume>
struct VolumeProbe {
  struct Part {};
  const Volume& volume;

  Part whole() const { return {}; }
  std::optional<Part> in_box(const Box<D>& zone) const {
    return may_overlap(volume, zone) ? std::optional(Part{}) : std::nullopt;
  }
  std::optional<Part> beside(Part, const Plane<D>& plane, bool front) const {
    return may_reach(volume, plane, front) ? std::optional(Part{}) : std::nullopt;
  }
};

// A box in which the volume lies.
template <int D>
Box<D> box_around(const Box<D>& box) {
  return box;
}
template <int D>
Box<D> box_around(const Ball<D>& ball) {
  Box<D> box;
  for (int i = 0; i < D; ++i) {
    const double center = ball.center[i];
    const double reach = ball.radius + 1e-15 * (std::abs(center) + ball.radius);
    box.lo[i] = center - reach;
    box.hi[i] = center + reach;
  }
  return box;
}

// The bodies that a walk has met: a table of open addressing, whose places are ids or empty.
class MetBodies {
 public:
  // False if it was there.
  bool insert(BodyId id) {
    if (2 * count_ >= places_.size()) grow();
    std::uint64_t& place = place_of(id);
    if (place != 0) return false;
    place = kTaken | id;
    ++count_;
    return true;
  }

 private:
  static constexpr std::uint64_t kTaken = std::uint64_t{1} << 32;

  // Where it is, or will be.
  std::uint64_t& place_of(BodyId id) {
    const std::size_t mask = places_.size() - 1;
    std::size_t at = (id * 0x9e3779b97f4a7c15u >> 32) & mask;
    while (places_[at] != 0 && places_[at] != (kTaken | id)) at = (at + 1) & mask;
    return places_[at];
  }
  void grow() {
    const std::vector<std::uint64_t> before = std::exchange(
        places_, std::vector<std::uint64_t>(std::max<std::size_t>(64, 2 * places_.size())));
    for (const std::uint64_t place : before)
      if (place != 0) place_of(static_cast<BodyId>(place)) = place;
  }

  std::vector<std::uint64_t> places_;
  std::size_t count_ = 0;
};
// Of a structure in which each body lies in one leaf.
struct MeetsOnce {
  static constexpr bool insert(BodyId) { return true; }
};

// Enters each node for which `enter(part)` holds, and tests each body of its leaves once:
// `test(id)` says whether it was found. A direction of zero keeps the lecture's order.
template <int D, class Tree, class Probe, class Enter, class Test>
void walk(const Tree& tree, QueryOf<D>& query, const Probe& probe, const Vec<D>& toward,
          Enter&& enter, Test&& test) {
  using Kind = QueryEvent::Kind;
  ZoneWalk<D, Tree::kZones, Probe> zones(probe);
  std::conditional_t<Tree::kHoldsOnce, MeetsOnce, MetBodies> met;
  std::vector<BodyId> room;
  tree.take(Tour<D>{room, toward}, [&](const NodeView<D>& node) {
    const auto part = zones.part_in(node);
    if (!part || !enter(*part)) {
      ++query.counts.nodes_skipped;
      query.tell(Kind::skip, node.handle);
      return false;
    }
    ++query.counts.nodes_visited;
    query.tell(Kind::visit, node.handle);
    for (const BodyId id : node.bodies) {
      stop_if_asked();
      if (!met.insert(id)) continue;
      ++query.counts.objects_tested;
      if (!query.told) {
        test(id);
        continue;
      }
      const BodyId name = query.view.name(id);
      query.tell(Kind::test, node.handle, name);
      if (test(id)) query.tell(Kind::hit, node.handle, name);
    }
    return true;
  });
}

// Whether the tree has ways for boxes and rays of its own, for when nobody watches:
//   each_near(box, f)         f(id, is_sure) for each body that the box may overlap, each once;
//                             is_sure: it does
//   each_along(ray, limit, f) f(id) for each body that the ray may meet, each once, about front to
//                             back; what the ray enters beyond `limit()` may be left out
// Both return how many nodes they visited and skipped.
template <class Tree, int D>
concept HasFastWays = requires(const Tree& t, const Box<D>& box, const Ray<D>& ray) {
  t.each_near(box, [](BodyId, bool) {});
  t.each_along(
      ray, [] { return 0.0; }, [](BodyId) {});
};

template <int D, class Tree>
void walk_along(const Tree& tree, RayQuery<D>& query) {
  if constexpr (HasFastWays<Tree, D>)
    if (!query.told) {
      std::uint64_t tested = 0;
      const auto walked = tree.each_along(
          query.ray, [&] { return query.limit(); },
          [&](BodyId id) {
            ++tested;
            query.test(id);
          });
      query.counts = {walked.visited, walked.skipped, tested};
      return;
    }
  walk<D>(
      tree, query, RayProbe<D>{query.ray}, query.ray.direction,
      [&](const RaySpan& part) { return !query.nearest || part.from <= query.nearest->distance; },
      [&](BodyId id) { return query.test(id); });
}

template <int D, class Tree>
void walk_within(const Tree& tree, VolumeQuery<D>& query) {
  std::visit(
      [&]<template <int> class Volume>(const Volume<D>* volume) {
        const auto test = [&](BodyId id) {
          if (!overlap(*volume, query.box(id))) return false;
          query.found->push_back(query.view.name(id));
          return true;
        };
        if constexpr (HasFastWays<Tree, D>)
          if constexpr (requires { box_around(*volume); })
            if (!query.told) {
              std::uint64_t tested = 0;
              const auto walked = tree.each_near(box_around(*volume), [&](BodyId id, bool is_sure) {
                ++tested;
                if (std::is_same_v<Volume<D>, Box<D>> && is_sure)
                  query.found->push_back(query.view.name(id));
                else
                  test(id);
              });
              query.counts = {walked.visited, walked.skipped, tested};
              return;
            }
        walk<D>(
            tree, query, VolumeProbe<D, Volume<D>>{*volume}, Vec<D>(0.0),
            [](const auto&) { return true; }, test);
      },
      query.volume);
}

}  // namespace lantern::spatial
