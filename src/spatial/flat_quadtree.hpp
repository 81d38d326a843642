// A quadtree in a world of three dimensions: it looks at x and z only, as the lecture's does, which
// is enough where the world is flat. Bodies above each other share a leaf.
#pragma once

#include <span>
#include <vector>

#include "spatial/orthtree.hpp"

namespace lantern::spatial {

class FlatQuadtree : public Visitable<FlatQuadtree, 3> {
 public:
  static constexpr Zones kZones = Zones::endless_rim;  // on y every node reaches from rim to rim
  static constexpr StructureTraits kTraits = Quadtree::kTraits;

  static FlatQuadtree made(const StructureConfig<3>& config) { return FlatQuadtree(config); }

  // Throws Refused as the quadtree does.
  explicit FlatQuadtree(const StructureConfig<3>& config)
      : tree_(Quadtree::made({.bounds = flat(config.bounds),
                              .capacity = config.capacity,
                              .max_depth = config.max_depth,
                              .eager_children = config.eager_children,
                              .no_progress_stop = config.no_progress_stop,
                              .most_entries = config.most_entries})),
        bounds_(config.bounds) {}

  template <class Observer = NoObserver>
  void insert(const Item<3>& item, Observer&& observer = {}) {
    require_valid(item);
    tree_.insert({item.id, flat(item.box)}, observer);
  }

  void build(std::span<const Item<3>> items) {
    flat_items_.clear();
    for (const Item<3>& item : items) {
      require_valid(item);
      flat_items_.push_back({item.id, flat(item.box)});
    }
    tree_.build(flat_items_);
  }

  void clear() { tree_.clear(); }

  // In the quadtree's order: what it calls up is towards larger z.
  template <class F>
  void take(Tour<3> tour, F&& f) const {
    tree_.take(Tour<2>{tour.ids, {tour.toward.x, tour.toward.z}},
               [&](const NodeView<2>& view) { return f(risen(view)); });
  }

  std::uint64_t near(const Box<3>& box, std::vector<BodyId>& ids) const {
    return tree_.near(flat(box), ids);
  }

  Counters counters() const { return tree_.counters(); }

 private:
  static Box<2> flat(const Box<3>& box) { return {{box.lo.x, box.lo.z}, {box.hi.x, box.hi.z}}; }

  NodeView<3> risen(const NodeView<2>& view) const {
    return {.handle = view.handle,
            .id = view.id,
            .parent = view.parent,
            .slot = view.slot,
            .depth = view.depth,
            .leaf = view.leaf,
            .box = {{view.box.lo.x, bounds_.lo.y, view.box.lo.y},
                    {view.box.hi.x, bounds_.hi.y, view.box.hi.y}},
            .bodies = view.bodies,
            .first = view.first,
            .room = view.room};
  }

  Quadtree tree_;
  std::vector<Item<2>> flat_items_;  // while building
  Box<3> bounds_;
};

}  // namespace lantern::spatial
