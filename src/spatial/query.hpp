// Walking through a structure with something that looks for bodies: a ray, a box, a ball, a view.
// One walk for every structure; raycast.hpp and overlap_query.hpp say what is looked for.
//
// A node is entered if what we look for reaches its zone: its box, without end where the box lies
// at the rim of an orthtree's root (bodies outside the root are stored there), or its sides of the
// planes of a BSP. Otherwise the whole branch is skipped.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <unordered_set>
#include <vector>

#include "base/stop.hpp"
#include "geometry/not_finite.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

struct QueryCounts {
  std::uint64_t nodes_visited = 0;
  std::uint64_t nodes_skipped = 0;   // their whole branches were; what lies below is not counted
  std::uint64_t objects_tested = 0;  // each at most once
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

// Enters each node for which `enter(part)` holds, and tests each body of its leaves once:
// `test(id)` says whether it was found. A direction of zero keeps the lecture's order.
template <int D, class Structure, class Probe, class Enter, class Test, class Observer>
QueryCounts walk(const Structure& structure, const Probe& probe, const Vec<D>& toward,
                 Enter&& enter, Test&& test, Observer& told) {
  QueryCounts counts;
  ZoneWalk<D, Structure, Probe> zones(probe);
  std::unordered_set<BodyId> met;  // only asked: its order does not matter
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
      if (!met.insert(id).second) continue;
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
