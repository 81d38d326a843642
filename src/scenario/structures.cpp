#include "scenario/structures.hpp"

#include <algorithm>
#include <map>
#include <type_traits>

#include <fmt/format.h>

#include "spatial/pairs.hpp"

namespace lantern {
namespace {

template <int D>
std::vector<BspPlane<D>> planes_of(const StructureSpec& spec) {
  std::vector<BspPlane<D>> planes;
  std::map<std::string, std::uint32_t> node_at;  // way from the root -> index
  for (const PlaneSpec& p : spec.planes) {
    BspPlane<D> plane{Plane<D>::through(in_dimension<D>(p.point), in_dimension<D>(p.normal)), kNone,
                      false};
    if (p.at != "root") {
      const std::size_t dot = p.at.rfind('.');
      const std::string parent = dot == std::string::npos ? "root" : p.at.substr(0, dot);
      plane.parent = node_at.at(parent);
      plane.front = p.at.substr(dot == std::string::npos ? 0 : dot + 1) == "front";
    }
    node_at[p.at] = static_cast<std::uint32_t>(planes.size());
    planes.push_back(plane);
  }
  return planes;
}

template <int D>
typename Orthtree<D>::Config orthtree_config(const StructureSpec& spec, const Box<D>& bounds) {
  typename Orthtree<D>::Config config;
  config.bounds = bounds;
  config.capacity = spec.capacity;
  config.max_depth = spec.max_depth;
  config.eager_children = spec.children == Children::eager;
  config.no_progress_stop = spec.no_progress_stop;
  config.most_entries = kMostEntries;
  return config;
}

}  // namespace

template <int D>
BroadPhaseConfig<D> broad_phase_of(const StructureSpec& spec, const Box<D>& bounds) {
  BroadPhaseConfig<D> config;
  const auto kind = broad_phase_named(to_string(spec.kind));
  config.kind = kind.value_or(BroadPhaseKind::brute_force);
  config.bounds = bounds;
  config.capacity = spec.capacity;
  config.max_depth = spec.max_depth;
  config.eager_children = spec.children == Children::eager;
  config.planes = planes_of<D>(spec);
  config.split_static = spec.split_static;
  return config;
}

std::string child_label(StructureKind kind, const std::string& parent, std::uint32_t slot) {
  std::string way = fmt::format("{}", slot + 1);
  if (kind == StructureKind::bsp) way = slot == 0 ? "back" : "front";
  return parent == "root" ? way : parent + "." + way;
}

std::string settings_text(const StructureSpec& s) {
  const std::string split = s.split_static ? ", static bodies apart" : "";
  switch (s.kind) {
    case StructureKind::none:
      return "";
    case StructureKind::brute_force:
      return "every body with every other" + split;
    case StructureKind::sort_and_sweep:
      return "sorted along one axis, then swept" + split;
    case StructureKind::bsp:
      return fmt::format("{} dividing line{}{}", s.planes.size(), s.planes.size() == 1 ? "" : "s",
                         split);
    case StructureKind::kd_tree:
      return fmt::format("fitted to its bodies, capacity {}, depth limit {}{}", s.capacity,
                         s.max_depth, split);
    case StructureKind::quadtree:
    case StructureKind::octree:
      break;
  }
  return fmt::format("capacity {}, depth limit {}, {}{}{}", s.capacity, s.max_depth,
                     s.children == Children::eager ? "all children made" : "children on demand",
                     s.no_progress_stop ? ", stops without progress" : "", split);
}

template <int D>
Structures<D>::Structures(const StructureSpec& spec, const Box<D>& bounds, bool only_awake,
                          Work& work)
    : spec_(spec), bounds_(bounds), only_awake_(only_awake), tree_(made()) {
  if (any()) ++work.structures_created;
  if (!any() || !spec_.split_static) return;
  static_tree_ = made();
  ++work.structures_created;
}

template <int D>
auto Structures<D>::made() const -> Tree {
  switch (spec_.kind) {
    case StructureKind::none:
      break;
    case StructureKind::brute_force:
      return BruteForce<D>();
    case StructureKind::quadtree:
      if constexpr (D == 2)
        return Quadtree(orthtree_config(spec_, bounds_));
      else
        return FlatQuadtree({bounds_, orthtree_config(spec_, Box<2>())});
    case StructureKind::octree:
      if constexpr (D == 3) return Octree(orthtree_config(spec_, bounds_));
      break;
    case StructureKind::bsp:
      return Bsp<D>(planes_of<D>(spec_), bounds_);
    case StructureKind::kd_tree:
      return KdTree<D>({spec_.capacity, spec_.max_depth, kMostEntries});
    case StructureKind::sort_and_sweep:
      return SortAndSweep<D>();
  }
  return std::monostate();
}

template <int D>
void Structures<D>::insert(const Resident<D>& resident, const Watch& watch) {
  std::vector<Item<D>>& items = is_for_static(resident) ? static_items_ : items_;
  std::uint64_t& builds = is_for_static(resident) ? static_builds_ : dynamic_builds_;
  items.push_back(resident.item);
  // The first body begins the structure; one that is fitted to its bodies begins again with each.
  if (builds == 0 || spec_.kind == StructureKind::kd_tree) ++builds;
  std::visit(
      [&](auto& tree) {
        using T = std::decay_t<decltype(tree)>;
        if constexpr (std::is_same_v<T, KdTree<D>>) {
          tree.build(items);
        } else if constexpr (!std::is_same_v<T, std::monostate>) {
          if (watch)
            tree.insert(resident.item, watch);
          else
            tree.insert(resident.item);
        }
      },
      is_for_static(resident) ? static_tree_ : tree_);
}

template <int D>
void Structures<D>::rebuild(std::span<const Resident<D>> residents) {
  std::vector<Item<D>> of_static;
  items_.clear();
  for (const Resident<D>& r : residents) (is_for_static(r) ? of_static : items_).push_back(r.item);
  const auto fill = [](Tree& tree, const std::vector<Item<D>>& items) {
    std::visit(
        [&](auto& t) {
          using T = std::decay_t<decltype(t)>;
          if constexpr (std::is_same_v<T, KdTree<D>>) {
            t.build(items);
          } else if constexpr (!std::is_same_v<T, std::monostate>) {
            t.clear();
            for (const Item<D>& item : items) t.insert(item);
          }
        },
        tree);
  };
  fill(tree_, items_);
  ++dynamic_builds_;
  if (!spec_.split_static || of_static == static_items_) return;
  static_items_ = std::move(of_static);
  fill(static_tree_, static_items_);
  ++static_builds_;
}

template <int D>
std::string Structures<D>::label_of(NodeHandle handle) const {
  std::vector<std::string> labels;
  std::string found;
  with_each([&](const auto& tree) {
    labels.clear();
    tree.visit([&](const NodeView<D>& node) {
      labels.push_back(
          node.parent == kNone ? "root" : child_label(spec_.kind, labels[node.parent], node.slot));
      if (node.handle == handle && found.empty()) found = labels.back();
      return found.empty();
    });
  });
  return found;
}

template BroadPhaseConfig<2> broad_phase_of(const StructureSpec&, const Box<2>&);
template BroadPhaseConfig<3> broad_phase_of(const StructureSpec&, const Box<3>&);
template class Structures<2>;
template class Structures<3>;

}  // namespace lantern
