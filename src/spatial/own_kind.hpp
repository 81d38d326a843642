// A structure of a user's own among ours: one type for all of them, since only the program that was
// given one knows what it is. What it holds is read from its OwnView; the tree itself is only
// called to insert, to clear, and for one visit after that.
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "spatial/own_view.hpp"
#include "spatial/tour.hpp"

namespace lantern::spatial {

class OwnFlat : public Visitable<OwnFlat, 2> {
 public:
  static constexpr Zones kZones = Zones::rounded_rim;

  // Whatever goes wrong in the tree is thrown by the next insert or look.
  OwnFlat(const OwnKind& kind, const StructureConfig<2>& config);

  // Throws StructureFault; the structure must be cleared then. An observer is told what must have
  // happened, when it has.
  template <class Observer = NoObserver>
  void insert(const Item<2>& item, Observer&& observer = {}) {
    put(item);
    if constexpr (!std::is_same_v<std::remove_cvref_t<Observer>, NoObserver>) {
      const OwnView before = looked();
      const auto place = static_cast<BodyId>(ids_.size() - 1);
      for (Event event : view_.events_since(before, place, rules_)) {
        event.body = item.id;
        observer(event);
      }
    }
  }
  // To be called after insertions that nobody observed, and before anything is asked. Throws
  // StructureFault.
  void look() {
    if (!seen_) looked();
  }
  void clear();

  template <class F>
  void take(Tour<2> tour, F&& f) const {
    visit_from(0, kNone, tour, f);
  }
  std::uint64_t near(const Box<2>& box, std::vector<BodyId>& ids) const;
  Counters counters() const { return view_.counters(); }

  // What is wrong with the tree as it stands.
  std::span<const OwnFault> faults() const { return faults_; }

 private:
  void renew();
  void put(const Item<2>& item);
  OwnView looked();  // what was seen before
  std::vector<std::uint32_t> children_of(std::uint32_t node, const Vec<2>& toward) const;

  template <class F>
  void visit_from(std::uint32_t index, std::uint32_t parent, Tour<2>& tour, F& f) const {
    const OwnView::Node& node = view_.nodes()[index];
    tour.ids.clear();
    for (const BodyId place : view_.bodies(node)) tour.ids.push_back(ids_[place]);
    std::sort(tour.ids.begin(), tour.ids.end());
    const NodeView<2> view{.handle = node.handle,
                           .id = tour.next_id++,
                           .parent = parent,
                           .slot = node.slot,
                           .depth = node.depth,
                           .leaf = node.leaf,
                           .box = node.box,
                           .slack = view_.slack(),
                           .bodies = tour.ids};
    if (!f(view)) return;
    for (const std::uint32_t child : children_of(index, tour.toward))
      visit_from(child, view.id, tour, f);
  }

  OwnKind kind_;
  OwnRules rules_;
  std::unique_ptr<OwnTree> tree_;
  std::vector<BodyId> ids_;    // of the bodies, in the order of their insertion: the tree is told
  std::vector<Box<2>> boxes_;  // their places in it, and their boxes, cut to the bounds
  OwnView view_;
  bool seen_ = false;  // it shows what the tree holds
  std::vector<OwnFault> faults_;
  std::exception_ptr broken_;  // the tree could not be made or cleared
};

// In three dimensions it looks at x and z only.
class OwnUpright : public Visitable<OwnUpright, 3> {
 public:
  static constexpr Zones kZones = Zones::rounded_rim;

  OwnUpright(const OwnKind& kind, const StructureConfig<3>& config);

  template <class Observer = NoObserver>
  void insert(const Item<3>& item, Observer&& observer = {}) {
    require_valid(item);
    flat_.insert({item.id, flat(item.box)}, observer);
  }
  void look() { flat_.look(); }
  void clear() { flat_.clear(); }

  template <class F>
  void take(Tour<3> tour, F&& f) const {
    flat_.take(Tour<2>{tour.ids, {tour.toward.x, tour.toward.z}},
               [&](const NodeView<2>& view) { return f(risen(view)); });
  }
  std::uint64_t near(const Box<3>& box, std::vector<BodyId>& ids) const {
    return flat_.near(flat(box), ids);
  }
  Counters counters() const { return flat_.counters(); }
  std::span<const OwnFault> faults() const { return flat_.faults(); }

 private:
  static Box<2> flat(const Box<3>& box) { return {{box.lo.x, box.lo.z}, {box.hi.x, box.hi.z}}; }
  NodeView<3> risen(const NodeView<2>& view) const;

  OwnFlat flat_;
  Box<3> bounds_;
};

template <int D>
using OwnStructure = std::conditional_t<D == 2, OwnFlat, OwnUpright>;

}  // namespace lantern::spatial
