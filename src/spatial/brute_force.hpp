// Every body with every other: one leaf that holds them all. The oracle of every tree.
#pragma once

#include <span>
#include <vector>

#include "spatial/ids.hpp"
#include "spatial/structure.hpp"

namespace lantern {

template <int D>
class BruteForce {
 public:
  static constexpr Zones kZones = Zones::fitted;
  static constexpr StructureTraits kTraits{
      .words = "brute force", .is_tree = false, .splits = false};

  static BruteForce made(const StructureConfig<D>&) { return {}; }

  // Throws Refused for a box that is not valid; nothing changes then. Tells `store` only: there is
  // no node to be tested against.
  template <class Observer = NoObserver>
  void insert(const Item<D>& item, Observer&& observer = {}) {
    require_valid(item);
    const std::size_t capacity = ids_.capacity();
    ids_.push_back(item.id);
    allocations_ += ids_.capacity() != capacity;
    box_ = ids_.size() == 1 ? item.box : united(box_, item.box);
    observer(Event{Event::Kind::store, 0, item.id, static_cast<std::uint32_t>(ids_.size()), 0});
  }

  void clear() {
    ids_.clear();
    box_ = {};
  }

  // The node's box is the smallest one that holds all bodies.
  template <class F>
  void visit(F&& f) const {
    std::vector<BodyId> room;
    visit(f, room);
  }

  template <class F>
  void visit(F&& f, std::vector<BodyId>& room) const {
    NodeView<D> view;
    view.box = box_;
    view.bodies = ascending(ids_, room);
    f(view);
  }

  template <class F>
  void visit_toward(const Vec<D>&, F&& f) const {
    visit(f);
  }

  // Calls f(id) for every body, ascending: the one leaf is always reached.
  template <class F>
  void query(const Box<D>&, F&& f) const {
    each_once(ids_, f);
  }

  void near(const Box<D>&, std::vector<BodyId>& ids) const {
    ids.insert(ids.end(), ids_.begin(), ids_.end());
  }

  Counters counters() const {
    Counters c;
    c.nodes = c.leaves = 1;
    c.entries = ids_.size();
    c.allocations = allocations_;
    return c;
  }

 private:
  std::vector<BodyId> ids_;
  Box<D> box_;
  std::uint64_t allocations_ = 0;
};

}  // namespace lantern
