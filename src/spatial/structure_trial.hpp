// A structure on trial: seeded random worlds of every sort that has ever broken a tree, against
// brute force; and the smallest world on which it fails.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spatial/structure.hpp"

namespace lantern::spatial {

struct TrialBody {
  Vec<2> center{0.0};
  Vec<2> half{0.0};
  bool operator==(const TrialBody&) const = default;
};

// Bodies are called b1, b2, … in their order.
struct TrialWorld {
  std::string_view sort;  // "clustered"
  Box<2> bounds;
  std::uint32_t capacity = 1;
  std::uint32_t max_depth = 1;
  std::vector<TrialBody> bodies;
  std::vector<TrialBody> moved;  // where they are next; empty: they stay
};

// The `number`-th world of this seed; all sorts in turn.
TrialWorld trial_world(std::uint64_t seed, std::uint64_t number);

// What goes wrong: a pair that is missed or is none, and what a structure of the user's own says
// that is not so. Nothing if all is well.
std::optional<std::string> fault_in(StructureKind kind, const TrialWorld& world);

// A smaller world, of rounder numbers, on which something still goes wrong. `world` must be one.
TrialWorld shrunk(StructureKind kind, TrialWorld world);

struct Trial {
  StructureKind kind = StructureKind::none;
  std::uint64_t worlds = 0;
  std::uint64_t failed = 0;
  TrialWorld smallest;  // of them, shrunk
  std::string fault;    // what goes wrong there; empty if none failed
};
Trial try_structure(StructureKind kind, std::uint64_t worlds, std::uint64_t seed);

}  // namespace lantern::spatial
