#include "spatial/structure_kinds.hpp"

namespace lantern::spatial {

namespace {

struct KindRow {
  StructureKind kind;
  std::string_view name;
  StructureTraits traits;
};
constexpr KindRow kKinds[] = {
    {StructureKind::none, "none", {.words = "none", .is_tree = false, .splits = false}},
#define LANTERN_KIND(name, Type) {StructureKind::name, #name, Type<3>::kTraits},
    LANTERN_STRUCTURES(LANTERN_KIND)
#undef LANTERN_KIND
};

}  // namespace

std::string_view to_string(StructureKind kind) {
  return kKinds[static_cast<std::size_t>(kind)].name;
}

std::optional<StructureKind> structure_named(std::string_view name) {
  for (const KindRow& row : kKinds)
    if (row.name == name) return row.kind;
  return std::nullopt;
}

StructureTraits traits_of(StructureKind kind) {
  return kKinds[static_cast<std::size_t>(kind)].traits;
}

template <int D>
AnyStructure<D> make_structure(StructureKind kind, const StructureConfig<D>& config) {
  switch (kind) {
    case StructureKind::none:
      break;
#define LANTERN_KIND(name, Type) \
  case StructureKind::name:      \
    return Type<D>::made(config);
      LANTERN_STRUCTURES(LANTERN_KIND)
#undef LANTERN_KIND
  }
  throw Refused("there is no structure to make");
}

template <int D>
void build_structure(AnyStructure<D>& structure, std::span<const Item<D>> items) {
  std::visit(
      [&](auto& s) {
        if constexpr (requires { s.build(items); }) {
          s.build(items);
        } else {
          s.clear();
          for (const Item<D>& item : items) s.insert(item);
        }
        if constexpr (requires { s.sort(); }) s.sort();
      },
      structure);
}

template AnyStructure<2> make_structure(StructureKind, const StructureConfig<2>&);
template AnyStructure<3> make_structure(StructureKind, const StructureConfig<3>&);
template void build_structure(AnyStructure<2>&, std::span<const Item<2>>);
template void build_structure(AnyStructure<3>&, std::span<const Item<3>>);

}  // namespace lantern::spatial
