// A structure on trial: seeded random worlds of every sort that has ever broken a tree, against
// brute force, and the smallest world on which it fails; and how long it takes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/attempt.hpp"
#include "base/clock.hpp"
#include "spatial/box_worlds.hpp"
#include "spatial/structure_kind.hpp"

namespace lantern::spatial {

// The boxes of bodies, whose numbers begin with 1.
std::vector<Proxy<2>> proxies_of(const std::vector<TrialBody>& bodies);

// What goes wrong: a pair that is missed or is none, and what a structure of the user's own says
// that is not so, or that it does not come to its end. Nothing if all is well. A user's own is
// tried in a process of its own.
std::optional<std::string> fault_in(StructureKind kind, const TrialWorld& world);

// A smaller world, of rounder numbers, on which something still goes wrong, and as badly. `world`
// must be one.
TrialWorld shrunk(StructureKind kind, TrialWorld world, const AttemptLimits& limits = {});

// How one of a user's own ends, from what is least to what is worst.
enum class TrialEnd { fails, crashes, hangs };

struct Trial {
  StructureKind kind = StructureKind::none;
  std::uint64_t worlds = 0;  // that were tried: the first that does not come to its end is the last
  std::uint64_t failed = 0;
  TrialWorld smallest = {};  // of them, shrunk
  std::string fault = {};    // what goes wrong there; empty if none failed
  TrialEnd end = TrialEnd::fails;
  std::optional<BodyId> last = {};  // the number of whose insertion it did not come back from
};
Trial try_structure(StructureKind kind, std::uint64_t worlds, std::uint64_t seed,
                    const AttemptLimits& limits = {});

// How long structures take beside each other, those of a user's own among them: to build anew, and
// to find all pairs. Of one's own tree its own code is timed, insert and visit, not what looks at
// it afterwards.
struct StructureTime {
  StructureKind kind = StructureKind::none;
  std::string scene;  // "uniform_2d"
  std::uint64_t bodies = 0;
  Timing build = {};  // processor seconds
  Timing pairs = {};
  Timing rays = {};  // 64 of them; not of a user's own that has no ray query of its own
  std::uint64_t nodes = 0;
  std::uint64_t entries = 0;     // bodies in leaves, each once a leaf
  std::uint64_t pair_tests = 0;  // boxes compared with boxes
  std::uint64_t missed = 0;      // pairs that brute force finds
  std::uint64_t invented = 0;    // pairs that it does not
  std::string fault = {};        // why it was not timed; empty if it was
};

struct StructureBench {
  std::vector<StructureKind> kinds;
  std::vector<std::uint64_t> bodies;
  std::uint64_t seed = 1;
  int rounds = 9;
  double longest = 5;  // processor seconds of one build; one that takes longer is not timed
  double limit = 2;    // seconds of one call of a user's own
};

// Evenly spread and clustered boxes, and some that coincide; all structures with capacity 8 and
// depth limit 7, in turns. A user's own is first tried on them in a process of its own,
// and takes its turns in another.
// `told` is called after each row.
std::vector<StructureTime> bench_structures(const StructureBench& bench,
                                            const std::function<void()>& told);
std::uint64_t structure_bench_rows(const StructureBench& bench);

std::string to_table(std::span<const StructureTime> rows);
std::string to_csv(std::span<const StructureTime> rows);
// lantern.structure.bench/1
std::string to_json(std::span<const StructureTime> rows, std::uint64_t seed);

}  // namespace lantern::spatial
