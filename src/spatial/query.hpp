// Walking through a structure with something that looks for bodies: a ray, a box, a ball, a view.
// One walk for every structure; raycast.hpp and overlap_query.hpp say what is looked for.
//
// A node is entered if what we look for reaches its zone: its box, without end where the box lies
// at the rim of an orthtree's root (bodies outside the root are stored there), or its sides of the
// planes of a BSP. Otherwise the whole branch is skipped.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/stop.hpp"
#include "geometry/not_finite.hpp"
#include "geometry/ray.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

struct QueryCounts {
  std::uint64_t nodes_visited = 0;
  std::uint64_t nodes_skipped = 0;   // their whole branches were; what lies below is not counted
  std::uint64_t objects_tested = 0;  // each at most once
};

// Whether each body lies in one leaf, so that none is met twice.
template <class Structure>
inline constexpr bool kHoldsOnce = [] {
  if constexpr (requires { Structure::kHoldsOnce; })
    return Structure::kHoldsOnce;
  else if constexpr (requires { Structure::kTraits; })
    return Structure::kTraits.holds_once;
  else
    return false;
}();

// Whether the structure offers ways for boxes and rays of its own, for when nobody watches:
//   each_near(box, f)         f(id, is_sure) for each body that the box may overlap, each once;
//                             is_sure: it does
//   each_along(ray, limit, f) f(id) for each body that the ray may meet, each once, about front to
//                             back; what the ray enters beyond `limit()` may be left out
// Both return how many nodes they visited and skipped.
template <class Structure, int D>
concept HasFastWays = requires(const Structure& s, const Box<D>& box, const Ray<D>& ray) {
  s.each_near(box, [](BodyId, bool) {});
  s.each_along(
      ray, [] { return 0.0; }, [](BodyId) {});
};

// What a query does, told while it does it.
struct QueryEvent {
  enum class Kind {
    visit,  // the node is entered
    skip,   // the node and all below it are left out
    test,   // the body, met in this leaf for the first time, is tested
    hit,    // and was found
  };
  Kind kind{};
  NodeHandle node = 0;
  BodyId body = 0;
};

struct NoQueryObserver {
  void operator()(const QueryEvent&) const {}
};

template <class Observer>
inline constexpr bool kIsWatched = !std::is_same_v<std::remove_cvref_t<Observer>, NoQueryObserver>;

// The bodies that a query found, ascending.
struct Found {
  std::vector<BodyId> ids;
  QueryCounts counts;
};

// The node's box, without end on the sides where it ends with the root.
template <int D>
Box<D> endless_at_rim(Box<D> box, const Box<D>& root) {
  for (int i = 0; i < D; ++i) {
    if (box.lo[i] == root.lo[i]) box.lo[i] = -kInfinity;
    if (box.hi[i] == root.hi[i]) box.hi[i] = kInfinity;
  }
  return box;
}
// The same of a box whose edges may have been rounded by as much as `slack`, grown by that.
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
template <int D, class Structure, class Probe>
class ZoneWalk {
 public:
  using Part = typename Probe::Part;

  explicit ZoneWalk(const Probe& probe) : probe_(probe) {}

  // What of the probe is in the node's zone. To be called once for each node visited.
  std::optional<Part> part_in(const NodeView<D>& node) {
    if constexpr (Structure::kZones == Zones::half_spaces) {
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
    } else if constexpr (Structure::kZones == Zones::endless_rim) {
      if (node.parent == kNone) root_ = node.box;
      return probe_.in_box(endless_at_rim(node.box, root_));
    } else if constexpr (Structure::kZones == Zones::rounded_rim) {
      if (node.parent == kNone) root_ = node.box;
      return probe_.in_box(endless_at_rim(node.box, root_, node.slack));
    } else {
      return probe_.in_box(node.box);
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
template <int D, class Structure, class Probe, class Enter, class Test, class Observer>
QueryCounts walk(const Structure& structure, const Probe& probe, const Vec<D>& toward,
                 Enter&& enter, Test&& test, Observer& told) {
  QueryCounts counts;
  ZoneWalk<D, Structure, Probe> zones(probe);
  std::conditional_t<kHoldsOnce<Structure>, MeetsOnce, MetBodies> met;
  const auto look = [&](const NodeView<D>& node) {
    const auto part = zones.part_in(node);
    if (!part || !enter(*part)) {
      ++counts.nodes_skipped;
      told(QueryEvent{QueryEvent::Kind::skip, node.handle, 0});
      return false;
    }
    ++counts.nodes_visited;
    told(QueryEvent{QueryEvent::Kind::visit, node.handle, 0});
    for (const BodyId id : node.bodies) {
      stop_if_asked();
      if (!met.insert(id)) continue;
      ++counts.objects_tested;
      told(QueryEvent{QueryEvent::Kind::test, node.handle, id});
      if (test(id)) told(QueryEvent{QueryEvent::Kind::hit, node.handle, id});
    }
    return true;
  };
  structure.visit_toward(toward, look);
  return counts;
}

}  // namespace lantern::spatial
