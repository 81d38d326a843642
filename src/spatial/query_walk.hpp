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
//
// So it goes where somebody watches, or asks but once. Who asks again and is told of nothing on the
// way gets the same answers from rows of rounded boxes, which a structure makes of its leaves.
#pragma once

#include <type_traits>
#include <utility>

#include "base/stop.hpp"
#include "spatial/query_probe.hpp"

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

// The zones of nodes in the order of visiting, for a Probe (query_probe.hpp).
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
      if (Tree::kFindsLeaves && node.leaf) return false;  // it is not even looked at
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

// The bodies that a walk has handed over lately: of those that lie in several leaves, which are met
// one soon after the other, nearly all are handed over once.
class Mailbox {
 public:
  // Whether it is new, as far as it is known.
  bool takes(BodyId id) {
    BodyId& place = last_[id % last_.size()];
    return std::exchange(place, id) != id;
  }
  Mailbox() { last_.fill(kNone); }

 private:
  std::array<BodyId, 64> last_;
};

// What a structure makes of its bodies for who asks again and again. The first question after a
// change is answered without it. Not to be asked by two threads at once until it is made.
template <class T>
class MadeWhenAsked {
 public:
  void forget() { asked_ = 0; }
  bool is_due() { return asked_ > 1 || ++asked_ > 1; }
  // fill(what)
  template <class Fill>
  const T& made(Fill&& fill) {
    if (asked_ < kMade) fill(what_);
    asked_ = kMade;
    return what_;
  }

 private:
  static constexpr int kMade = 3;
  T what_;
  int asked_ = 0;
};

// The way through a tree whose leaves are rows of rounded boxes:
//   Place                            a node on the way
//   has_rows()                       whether they are due to be made, or are made
//   boxes()                          of all leaves
//   root()
//   leaf_run(place)                  of a leaf its bodies, of an inner node nothing
//   open(place, probe, part, f)      f(child, its part, if it has one) for each child of an inner
//                                    node, about in the order in which they are met
template <int D, class Tree, class Probe, class Limit, class Soon, class F>
class RowWalk {
  using Place = typename Tree::Place;
  using Part = typename Probe::Part;

 public:
  RowWalk(const Tree& tree, const Probe& probe, Limit& limit, Soon& soon, F& f)
      : tree_(tree), boxes_(tree.boxes()), probe_(probe), limit_(limit), soon_(soon), f_(f) {}

  WalkCounts whole() {
    enter(tree_.root(), probe_.whole());
    return counts_;
  }

 private:
  void enter(const Place& at, const Part& part) {
    ++counts_.visited;
    if (const std::optional<LeafRun> leaf = tree_.leaf_run(at)) {
      stop_if_asked();
      counts_.compared += leaf->count;
      each_in_row(boxes_.row(*leaf), leaf->count, probe_, limit_, soon_, [&](BodyId id, bool sure) {
        if (Tree::kHoldsOnce || met_.takes(id)) f_(id, sure);
      });
      return;
    }
    tree_.open(at, probe_, part, [&](const Place& child, const std::optional<Part>& its) {
      if (its && probe_.entry(*its) <= limit_())
        enter(child, *its);
      else
        ++counts_.skipped;
    });
  }

  const Tree& tree_;
  const LeafBoxes<D>& boxes_;
  const Probe& probe_;
  Limit& limit_;
  Soon& soon_;
  F& f_;
  Mailbox met_;
  WalkCounts counts_;
};

template <class Tree>
concept HasLeafBoxes = requires(const Tree& tree) {
  tree.boxes();
};

// f(id, is_sure) for each body that the probe may meet before `limit()`, see each_in_block: by the
// structure's own way, if it has one.
template <class Tree, int D>
concept IsAskedByRows = requires(const Tree& t, const VolumeProbe<D, Box>& probe, double (&limit)(),
                                 void (&soon)(BodyId), void (&f)(BodyId, bool)) {
  t.each_met(probe, limit, soon, f);
};

template <int D>
void count(QueryOf<D>& query, const WalkCounts& walked, std::uint64_t tested) {
  query.counts = {walked.visited, walked.skipped, tested, walked.compared};
}

// One by one, each as soon as it is met: what is found limits what is looked for.
template <int D, class Tree, class Query, class Probe>
void seek(const Tree& tree, Query& query, const Probe& probe) {
  std::uint64_t tested = 0;
  auto limit = [&] { return query.limit(); };
  auto soon = [&](BodyId id) { query.fetch(id); };
  auto test = [&](BodyId id, bool) {
    ++tested;
    query.test(id);
  };
  const WalkCounts walked = tree.each_met(probe, limit, soon, test);
  count(query, walked, tested);
}

// First all that may be met, then what they are.
template <int D, class Tree, class Query, class Probe, class Sure, class Test>
void gather(const Tree& tree, Query& query, const Probe& probe, double most, Sure&& sure,
            Test&& test) {
  std::vector<BodyId>& met = *query.scratch;
  met.clear();
  auto limit = [&] { return most; };
  auto soon = [](BodyId) {};
  auto meet = [&](BodyId id, bool is_sure) {
    if (is_sure) return sure(id);
    met.push_back(id);
    query.fetch(id);
  };
  const WalkCounts walked = tree.each_met(probe, limit, soon, meet);
  for (const BodyId id : met) test(id);
  count(query, walked, met.size());
}

template <int D, class Tree>
void walk_along(const Tree& tree, RayQuery<D>& query) {
  if constexpr (requires { tree.narrow(query); }) tree.narrow(query);
  const RayProbe<D> probe(query.ray);
  if constexpr (IsAskedByRows<Tree, D>)
    if (!query.told && tree.has_rows()) {
      if (query.all == nullptr) return seek<D>(tree, query, probe);
      return gather<D>(
          tree, query, probe, query.ray.length, [](BodyId) {}, [&](BodyId id) { query.test(id); });
    }
  walk<D>(
      tree, query, probe, query.ray.direction,
      [&](const RaySpan& part) { return part.from <= query.limit(); },
      [&](BodyId id) { return query.test(id); });
}

template <int D, class Tree>
void walk_within(const Tree& tree, VolumeQuery<D>& query) {
  std::visit(
      [&]<template <int> class Volume>(const Volume<D>* volume) {
        const auto found = [&](BodyId id) { query.found->push_back(query.view.name(id)); };
        const auto test = [&](BodyId id) {
          if (!overlap(*volume, query.box(id))) return false;
          found(id);
          return true;
        };
        const VolumeProbe<D, Volume> probe(*volume);
        if constexpr (IsAskedByRows<Tree, D>)
          if (!query.told && tree.has_rows()) {
            if constexpr (requires { volume->length; })
              return gather<D>(tree, query, RayProbe<D, false>(*volume), volume->length, found,
                               test);
            else
              return gather<D>(tree, query, probe, 0, found, test);
          }
        walk<D>(
            tree, query, probe, Vec<D>(0.0), [](const auto&) { return true; }, test);
      },
      query.volume);
}

template <int D, class Tree>
void walk_around(const Tree& tree, NearestQuery<D>& query) {
  const PointProbe<D> probe(query.point);
  if constexpr (IsAskedByRows<Tree, D>)
    if (!query.told && tree.has_rows()) return seek<D>(tree, query, probe);
  walk<D>(
      tree, query, probe, Vec<D>(0.0),
      [&](const auto& part) { return probe.entry(part) <= query.limit(); },
      [&](BodyId id) { return query.test(id); });
}

}  // namespace lantern::spatial
