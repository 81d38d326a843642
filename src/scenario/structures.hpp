// The structures of a scene: the one that finds candidate pairs and is pictured, or, where what
// never moves has one of its own, both.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/work.hpp"
#include "scenario/frame.hpp"
#include "scenario/touched.hpp"
#include "spatial/broad_phase.hpp"

namespace lantern {

// Pairs listed on one frame; more are refused.
inline constexpr std::uint64_t kMostPairs = 2'000'000;
// Entries and nodes of one tree; more are refused.
inline constexpr std::uint64_t kMostEntries = 2'000'000;

// A body as structures see it.
template <int D>
struct Resident {
  Item<D> item;
  bool is_static = false;
  bool awake = true;  // moves, or may: false for what is static or asleep
};

template <int D>
class Structures {
 public:
  using Watch = std::function<void(const Event&)>;
  // In a solid world the quadtree lies on the floor: it knows x and z.
  using Tree = std::conditional_t<
      D == 2,
      std::variant<std::monostate, BruteForce<D>, Quadtree, Bsp<D>, KdTree<D>, SortAndSweep<D>>,
      std::variant<std::monostate, BruteForce<D>, FlatQuadtree, Octree, Bsp<D>, KdTree<D>,
                   SortAndSweep<D>>>;

  // `only_awake`: pairs of which neither body is awake are left out.
  Structures(const StructureSpec& spec, const Box<D>& bounds, bool only_awake, Work& work);

  bool any() const { return spec_.kind != StructureKind::none; }
  const StructureSpec& spec() const { return spec_; }

  // One more body; trees that are fitted to all their bodies are built anew.
  void insert(const Resident<D>& resident, const Watch& watch);
  // All bodies anew, memory reused. What never moves is built again only if it changed.
  void rebuild(std::span<const Resident<D>> residents);

  // "root", "1.3", "front.back"
  std::string label_of(NodeHandle node) const;

  // Nodes, pairs and counts. `residents` as they are now: a tree may be older.
  void picture(const Touched& touched, std::span<const Resident<D>> residents, Frame& frame) const;

  // f(tree) for the structure of what moves and then, if there is one, of what does not.
  template <class F>
  void with_each(F&& f) const {
    for (const Tree* tree : {&tree_, &static_tree_})
      std::visit(
          [&](const auto& t) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(t)>, std::monostate>) f(t);
          },
          *tree);
  }

 private:
  Tree made() const;
  bool is_for_static(const Resident<D>& r) const { return spec_.split_static && r.is_static; }

  StructureSpec spec_;
  Box<D> bounds_;
  bool only_awake_;
  Tree tree_;
  Tree static_tree_;  // none unless the two are split
  std::vector<Item<D>> items_;
  std::vector<Item<D>> static_items_;
  std::uint64_t dynamic_builds_ = 0;
  std::uint64_t static_builds_ = 0;
};

// The same structure as the broad phase of the physics; without one, every pair is tested.
template <int D>
BroadPhaseConfig<D> broad_phase_of(const StructureSpec& spec, const Box<D>& bounds);

// Of a child of the node `parent`: "1.3", or in a BSP "front.back"; children of the root have no
// prefix.
std::string child_label(StructureKind kind, const std::string& parent, std::uint32_t slot);

// "capacity 2, depth limit 4, all children made"
std::string settings_text(const StructureSpec& structure);

extern template class Structures<2>;
extern template class Structures<3>;

}  // namespace lantern
