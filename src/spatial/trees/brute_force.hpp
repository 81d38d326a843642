// Every body with every other: one leaf that holds them all. The oracle of every tree.
#pragma once

#include "spatial/structure_of.hpp"

namespace lantern::spatial {

template <int D>
class BruteForce final : public StructureOf<BruteForce<D>, D>, CountsAllocations {
 public:
  static constexpr Zones kZones = Zones::fitted;

  explicit BruteForce(const StructureConfig<D>& = {}) {}

  // Tells `store` only: there is no node to be tested against.
  template <class Observer>
  void add(const Item<D>& item, Observer&& observer) {
    append(ids_, item.id);
    box_ = ids_.size() == 1 ? item.box : united(box_, item.box);
    observer(Event{Event::Kind::store, 0, item.id, static_cast<std::uint32_t>(ids_.size()), 0});
  }
  void clear() override {
    ids_.clear();
    box_ = {};
  }

  // The node's box is the smallest one that holds all bodies.
  template <class F>
  void take(Tour<D> tour, F&& f) const {
    f(NodeView<D>{.box = box_, .bodies = tour.ascending(ids_)});
  }
  std::uint64_t near(const Box<D>&, std::vector<BodyId>& ids) const override {
    ids.insert(ids.end(), ids_.begin(), ids_.end());
    return 0;
  }
  Counters counters() const override {
    return {.nodes = 1, .leaves = 1, .entries = ids_.size(), .allocations = allocations_};
  }

 private:
  std::vector<BodyId> ids_;
  Box<D> box_;
};

}  // namespace lantern::spatial
