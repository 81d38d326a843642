// The list of structures, ours and those that a program was given, and what they have in common.
#include "spatial/structure.hpp"

#include <deque>

#include "base/suggest.hpp"
#include "spatial/own_structure.hpp"
#include "spatial/structure_of.hpp"

namespace lantern::spatial {

namespace {

struct Ours {
  std::string_view name;
  const StructureEntry* entry;
};
constexpr Ours kOurs[] = {
#define LANTERN_KIND(name) {#name, &name##_entry},
    LANTERN_STRUCTURES(LANTERN_KIND) LANTERN_KIND(wide_bvh)
#undef LANTERN_KIND
};

// Given before anything else runs, and never changed again.
struct Own {
  OwnKind kind;
  StructureTraits traits;
};
std::deque<Own>& own_kinds() {
  static std::deque<Own> kinds;
  return kinds;
}

constexpr auto kFirst = static_cast<std::size_t>(kStructureKinds.front());
constexpr auto kFirstOwn = static_cast<std::size_t>(StructureKind::own);
static_assert(kFirstOwn - kFirst == kStructureKinds.size(), "no name between ours and own");

// Null for what is none of ours.
const Ours* ours(StructureKind kind) {
  if (kind == StructureKind::wide_bvh) return &kOurs[kStructureKinds.size()];
  const auto place = static_cast<std::size_t>(kind);
  return place < kFirst || place >= kFirstOwn ? nullptr : &kOurs[place - kFirst];
}

const Own* own(StructureKind kind) {
  if (kind < StructureKind::own) return nullptr;
  return &own_kinds().at(static_cast<std::size_t>(kind) - kFirstOwn);
}

}  // namespace

// --- kinds ---

void know_own_structures(std::vector<OwnKind> kinds) {
  for (OwnKind& kind : kinds) {
    require_own_name("structure", kind.name, structure_named(kind.name).has_value());
    if (kind.words.empty()) kind.words = kind.name;
    Own& own = own_kinds().emplace_back(Own{std::move(kind), {}});
    own.traits = {.words = own.kind.words,
                  .settings = bits_of({Setting::capacity, Setting::max_depth}),
                  .ignores_height = true,
                  .is_own = true};
  }
}

const OwnKind* own_structure(StructureKind kind) {
  const Own* one = own(kind);
  return one == nullptr ? nullptr : &one->kind;
}

std::vector<StructureKind> known_structures() {
  std::vector<StructureKind> kinds(kStructureKinds.begin(), kStructureKinds.end());
  for (std::size_t i = 0; i < own_kinds().size(); ++i)
    kinds.push_back(static_cast<StructureKind>(kFirstOwn + i));
  return kinds;
}

std::string_view to_string(StructureKind kind) {
  if (const OwnKind* own = own_structure(kind)) return own->name;
  if (const Ours* one = ours(kind)) return one->name;
  return kind == StructureKind::none ? "none" : "auto";
}

std::optional<StructureKind> structure_named(std::string_view name) {
  for (const StructureKind kind : {StructureKind::none, StructureKind::automatic})
    if (name == to_string(kind)) return kind;
  for (const StructureKind kind : known_structures())
    if (name == to_string(kind)) return kind;
  return std::nullopt;
}

const StructureTraits& traits_of(StructureKind kind) {
  static constexpr StructureTraits kNoKind{.words = "none", .is_tree = false, .splits = false};
  static constexpr StructureTraits kAutomatic{
      .words = "whichever suits", .is_tree = false, .splits = false};
  if (const Ours* one = ours(kind)) return one->entry->traits;
  if (const Own* one = own(kind)) return one->traits;
  return kind == StructureKind::none ? kNoKind : kAutomatic;
}

std::vector<StructureKind> kinds_with(Setting setting) {
  std::vector<StructureKind> kinds;
  for (const StructureKind kind : kStructureKinds)
    if (traits_of(kind).has(setting)) kinds.push_back(kind);
  return kinds;
}

// --- structures ---

template <int D>
std::unique_ptr<Structure<D>> make_structure(StructureKind kind, const StructureConfig<D>& config) {
  if (const OwnKind* own = own_structure(kind)) return own_tree<D>(*own, config);
  const Ours* one = ours(kind);
  if (one == nullptr) throw Refused("there is no structure to make");
  if constexpr (D == 3)
    return one->entry->make_3d(config);
  else if (one->entry->make_2d != nullptr)
    return one->entry->make_2d(config);
  throw Refused("broad phase: {} needs three dimensions", one->name);
}
template std::unique_ptr<Structure<2>> make_structure(StructureKind, const StructureConfig<2>&);
template std::unique_ptr<Structure<3>> make_structure(StructureKind, const StructureConfig<3>&);

template <int D>
void refuse_box(const Item<D>& item) {
  int i = 0;
  const auto is_bad = [](double lo, double hi) {
    return !std::isfinite(lo) || !std::isfinite(hi) || lo > hi;
  };
  while (i + 1 < D && !is_bad(item.box.lo[i], item.box.hi[i])) ++i;
  throw Refused(
      "body {}: its box goes from {} to {} on axis {}; both must be finite and in this order",
      item.id, item.box.lo[i], item.box.hi[i], "xyz"[i]);
}
template void refuse_box(const Item<2>&);
template void refuse_box(const Item<3>&);

std::string text_of(const OwnFault& fault, const std::function<std::string(BodyId)>& name_of) {
  std::string text = fault.text;
  for (std::size_t i = 0; i < fault.bodies.size(); ++i) {
    const std::string place = fmt::format("{{{}}}", i), name = name_of(fault.bodies[i]);
    for (std::size_t at = 0; (at = text.find(place, at)) != std::string::npos; at += name.size())
      text.replace(at, place.size(), name);
  }
  return text;
}

StructureFault::StructureFault(OwnFault fault)
    : std::runtime_error(text_of(fault, [](BodyId id) { return fmt::format("body {}", id); })),
      fault_(std::move(fault)) {}

}  // namespace lantern::spatial
