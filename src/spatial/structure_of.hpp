// What a structure needs to have the face of structure.hpp: for who writes one. It has
//   add(item, observer)      inserts one, and tells the observer; not if it is fitted to its bodies
//   make(items)              builds it of all at once, if it can
//   take(tour, f)            the one way through its nodes: f(NodeView) -> bool, see Tour
//   kZones                   where a node's bodies may be, see query_walk.hpp
// and, if it finds pairs otherwise than leaf by leaf,
//   find_pairs(exact, found) adds all pairs of its bodies that overlap, each once, in any order, as
//                            RunScanner does; returns how many pairs of boxes it compared
//   meet(awake, f)           see Structure::compare
// and overrides the rest. All of this is compiled into the structure: nothing in it is virtual.
#pragma once

#include <type_traits>

#include "spatial/pair_search.hpp"
#include "spatial/query_walk.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

// The observer of what nobody watches: its calls compile to nothing.
struct NoObserver {
  void operator()(const Event&) const {}
};

// Lists that count their calls for memory.
class CountsAllocations {
 protected:
  template <class T>
  void append(std::vector<T>& list, const std::type_identity_t<T>& value) {
    allocations_ += list.size() == list.capacity();
    list.push_back(value);
  }

  std::uint64_t allocations_ = 0;
};

template <class Tree, int D>
class StructureOf : public Structure<D> {
 public:
  static constexpr bool kHoldsOnce = false;  // each body lies in one leaf
  static constexpr bool kFindsLeaves =
      false;  // it reckons which leaves are reached, and skips none
  static constexpr bool kAsksForPairs = false;  // for those of each body

  bool insert(const Item<D>& item, const EventWatch& watch = {}) final {
    NoObserver nobody;
    if constexpr (requires { tree().add(item, nobody); }) {
      require_valid(item);
      watch ? tree().add(item, watch) : tree().add(item, nobody);
      return true;
    }
    return false;
  }

  void build(Items<D> items, Build way = Build::one_by_one) final {
    NoObserver nobody;
    constexpr bool one_by_one = requires { tree().add(Item<D>(), nobody); };
    constexpr bool at_once = requires { tree().make(items); };
    static_assert(one_by_one || at_once);
    if (at_once && (!one_by_one || way == Build::at_once)) {
      if constexpr (at_once) tree().make(items);
    } else if constexpr (one_by_one) {
      this->clear();
      for (const Item<D>& item : items) {
        require_valid(item);
        tree().add(item, nobody);
      }
    }
    this->sort();
    this->look();
  }

  void visit(NodeLook<D> f, const Vec<D>& toward = Vec<D>(0.0)) const final {
    std::vector<BodyId> room;
    tree().take(Tour<D>{room, toward}, f);
  }

  void ask(RayQuery<D>& query) const final { walk_along<D>(tree(), query); }
  void ask(VolumeQuery<D>& query) const final { walk_within<D>(tree(), query); }
  void ask(NearestQuery<D>& query) const final { walk_around<D>(tree(), query); }

  // Of one with leaves in rows.
  template <class Probe, class Limit, class Soon, class F>
  WalkCounts each_met(const Probe& probe, Limit& limit, Soon& soon,
                      F& f) const requires HasLeafBoxes<Tree> {
    return RowWalk<D, Tree, Probe, Limit, Soon, F>(tree(), probe, limit, soon, f).whole();
  }

  void pair(PairSearch<D>& search) final {
    if constexpr (Tree::kAsksForPairs ||
                  requires { tree().find_pairs(std::span<const Box<D>>(), search.found); })
      search.by_itself(tree());
    else
      search.in_leaves(tree());
  }

  std::uint64_t compare(FunctionRef<bool(BodyId)> awake,
                        FunctionRef<void(BodyId, BodyId)> f) const final {
    if constexpr (requires { tree().meet(awake, f); }) return tree().meet(awake, f);
    if constexpr (requires { tree().tells_pairs(awake, f); })
      if (tree().tells_pairs(awake, f)) return 0;
    visit([&](const NodeView<D>& node) {
      for (std::size_t i = 0; i < node.bodies.size(); ++i) {
        stop_if_asked();
        for (std::size_t j = i + 1; j < node.bodies.size(); ++j)
          if (awake(node.bodies[i]) || awake(node.bodies[j])) f(node.bodies[i], node.bodies[j]);
      }
      return true;
    });
    return 0;
  }

 private:
  Tree& tree() { return static_cast<Tree&>(*this); }
  const Tree& tree() const { return static_cast<const Tree&>(*this); }
};

// What the list of structures knows of one.
struct StructureEntry {
  StructureTraits traits;
  std::unique_ptr<Structure<2>> (*make_2d)(const StructureConfig<2>&);  // null: it needs the other
  std::unique_ptr<Structure<3>> (*make_3d)(const StructureConfig<3>&);
};
#define LANTERN_KIND(name) extern const StructureEntry name##_entry;
LANTERN_STRUCTURES(LANTERN_KIND)
#undef LANTERN_KIND
extern const StructureEntry wide_bvh_entry;
template <class Tree, int D>
std::unique_ptr<Structure<D>> made(const StructureConfig<D>& config) {
  return std::make_unique<Tree>(config);
}

// --- a flat structure in a world of three dimensions ---

inline Box<2> seen_from_above(const Box<3>& box) {
  return {{box.lo.x, box.lo.z}, {box.hi.x, box.hi.z}};
}

// It looks at x and z only, which is enough where the world is flat: bodies above each other share
// a leaf. On y every node reaches from rim to rim.
template <class Flat>
class Upright final : public StructureOf<Upright<Flat>, 3> {
 public:
  static constexpr Zones kZones = Flat::kZones;

  template <class... Args>
  explicit Upright(const StructureConfig<3>& config, const Args&... args)
      : flat_({.bounds = seen_from_above(config.bounds),
               .capacity = config.capacity,
               .max_depth = config.max_depth,
               .eager_children = config.eager_children,
               .no_progress_stop = config.no_progress_stop,
               .most_entries = config.most_entries},
              args...),
        bounds_(config.bounds) {}

  template <class Observer>
  void add(const Item<3>& item, Observer&& observer) {
    flat_.add({item.id, seen_from_above(item.box)}, observer);
  }
  void make(Items<3> items) requires requires(Flat& flat) { flat.make(Items<2>()); }
  {
    flat_items_.clear();
    for (const Item<3>& item : items) {
      require_valid(item);
      flat_items_.push_back({item.id, seen_from_above(item.box)});
    }
    flat_.make(flat_items_);
  }
  void clear() override { flat_.clear(); }
  void look() override { flat_.look(); }

  // In the flat one's order: what it calls up is towards larger z.
  template <class F>
  void take(Tour<3> tour, F&& f) const {
    flat_.take(Tour<2>{tour.ids, {tour.toward.x, tour.toward.z}},
               [&](const NodeView<2>& view) { return f(risen(view)); });
  }
  std::uint64_t near(const Box<3>& box, std::vector<BodyId>& ids) const override {
    return flat_.near(seen_from_above(box), ids);
  }
  Counters counters() const override { return flat_.counters(); }
  std::span<const OwnFault> faults() const override { return flat_.faults(); }

 private:
  NodeView<3> risen(const NodeView<2>& view) const {
    return {.handle = view.handle,
            .id = view.id,
            .parent = view.parent,
            .slot = view.slot,
            .depth = view.depth,
            .leaf = view.leaf,
            .box = {{view.box.lo.x, bounds_.lo.y, view.box.lo.y},
                    {view.box.hi.x, bounds_.hi.y, view.box.hi.y}},
            .slack = view.slack,
            .bodies = view.bodies,
            .first = view.first,
            .room = view.room};
  }

  Flat flat_;
  std::vector<Item<2>> flat_items_;  // while building
  Box<3> bounds_;
};

}  // namespace lantern::spatial
