#include "spatial/structure_kinds.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace lantern::spatial {

namespace {

struct KindRow {
  StructureKind kind;
  std::string_view name;
  StructureTraits traits;
};
constexpr KindRow kKinds[] = {
    {StructureKind::none, "none", {.words = "none", .is_tree = false, .splits = false}},
    {StructureKind::automatic,
     "auto",
     {.words = "whichever suits", .is_tree = false, .splits = false}},
    {StructureKind::brute_force, "brute_force", BruteForce<3>::kTraits},
    {StructureKind::sort_and_sweep, "sort_and_sweep", SortAndSweep<3>::kTraits},
    {StructureKind::quadtree, "quadtree", Quadtree::kTraits},
    {StructureKind::octree, "octree", Octree::kTraits},
    {StructureKind::bsp, "bsp", Bsp<3>::kTraits},
    {StructureKind::kd_tree, "kd_tree", KdTree<3>::kTraits},
    {StructureKind::lecture_quadtree, "lecture_quadtree", LectureQuadtree<3>::kTraits},
    {StructureKind::grid, "grid", Grid<3>::kTraits},
    {StructureKind::aabb_tree, "aabb_tree", AabbTree<3>::kTraits},
};

// Given before anything else runs, and never changed again.
std::vector<OwnKind>& own_kinds() {
  static std::vector<OwnKind> kinds;
  return kinds;
}

StructureKind own_number(std::size_t place) {
  return static_cast<StructureKind>(static_cast<std::size_t>(StructureKind::own) + place);
}

void require_name(const std::string& name) {
  const bool written_well = !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  if (!written_well)
    throw Refused(fmt::format("structure '{}': a name is of a–z, 0–9 and _", name));
  if (structure_named(name))
    throw Refused(fmt::format("structure '{}': there is one of this name already", name));
}

}  // namespace

void know_own_structures(std::vector<OwnKind> kinds) {
  for (OwnKind& kind : kinds) {
    require_name(kind.name);
    if (kind.words.empty()) kind.words = kind.name;
    own_kinds().push_back(std::move(kind));
  }
}

const OwnKind* own_structure(StructureKind kind) {
  if (kind < StructureKind::own) return nullptr;
  return &own_kinds().at(static_cast<std::size_t>(kind) -
                         static_cast<std::size_t>(StructureKind::own));
}

std::span<const OwnKind> own_structures() { return own_kinds(); }

std::vector<StructureKind> known_structures() {
  std::vector<StructureKind> kinds(kStructureKinds.begin(), kStructureKinds.end());
  for (std::size_t i = 0; i < own_kinds().size(); ++i) kinds.push_back(own_number(i));
  return kinds;
}

std::string_view to_string(StructureKind kind) {
  if (const OwnKind* own = own_structure(kind)) return own->name;
  return kKinds[static_cast<std::size_t>(kind)].name;
}

std::optional<StructureKind> structure_named(std::string_view name) {
  for (const KindRow& row : kKinds)
    if (row.name == name) return row.kind;
  for (std::size_t i = 0; i < own_kinds().size(); ++i)
    if (own_kinds()[i].name == name) return own_number(i);
  return std::nullopt;
}

StructureTraits traits_of(StructureKind kind) {
  if (const OwnKind* own = own_structure(kind))
    return {.words = own->words,
            .settings = bits_of({Setting::capacity, Setting::max_depth}),
            .ignores_height = true,
            .is_own = true};
  return kKinds[static_cast<std::size_t>(kind)].traits;
}

std::string_view to_string(Setting setting) {
  constexpr std::string_view kNames[] = {"capacity",  "max_depth", "children", "no_progress_stop",
                                         "cell",      "levels",    "open",     "margin",
                                         "following", "axis",      "planes"};
  return kNames[static_cast<std::size_t>(setting)];
}

std::vector<StructureKind> kinds_with(Setting setting) {
  std::vector<StructureKind> kinds;
  for (const StructureKind kind : kStructureKinds)
    if (traits_of(kind).has(setting)) kinds.push_back(kind);
  return kinds;
}

template <int D>
AnyStructure<D> make_structure(StructureKind kind, const StructureConfig<D>& config) {
  switch (kind) {
    case StructureKind::none:
    case StructureKind::automatic:
      throw Refused("there is no structure to make");
    case StructureKind::brute_force:
      return BruteForce<D>::made(config);
    case StructureKind::sort_and_sweep:
      return SortAndSweep<D>::made(config);
    case StructureKind::quadtree:
      return QuadtreeIn<D>::made(config);
    case StructureKind::octree:
      return OctreeIn<D>::made(config);
    case StructureKind::bsp:
      return Bsp<D>::made(config);
    case StructureKind::kd_tree:
      return KdTree<D>::made(config);
    case StructureKind::lecture_quadtree:
      return LectureQuadtree<D>::made(config);
    case StructureKind::grid:
      return Grid<D>::made(config);
    case StructureKind::aabb_tree:
      return AabbTree<D>::made(config);
    case StructureKind::own:
      break;
  }
  return OwnStructure<D>(*own_structure(kind), config);
}

template <int D>
void build_structure(AnyStructure<D>& structure, std::span<const Item<D>> items, Build way) {
  std::visit(
      [&](auto& s) {
        constexpr bool at_once = requires { s.build(items); };
        constexpr bool one_by_one = requires { s.insert(Item<D>()); };
        if constexpr (at_once) {
          if (!one_by_one || way == Build::at_once) s.build(items);
        }
        if constexpr (one_by_one) {
          if (!at_once || way == Build::one_by_one) {
            s.clear();
            for (const Item<D>& item : items) s.insert(item);
          }
        }
        if constexpr (requires { s.sort(); }) s.sort();
        if constexpr (requires { s.look(); }) s.look();
      },
      structure);
}

template AnyStructure<2> make_structure(StructureKind, const StructureConfig<2>&);
template AnyStructure<3> make_structure(StructureKind, const StructureConfig<3>&);
template void build_structure(AnyStructure<2>&, std::span<const Item<2>>, Build);
template void build_structure(AnyStructure<3>&, std::span<const Item<3>>, Build);

}  // namespace lantern::spatial
