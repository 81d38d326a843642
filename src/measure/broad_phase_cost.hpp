// What it costs to find all pairs of a scene: by each structure, over leaf capacity and depth
// limit. The error of a broad phase is the pairs that it misses, which must be none; what it may do
// is look at too many, and that is what is counted here beside the time.
#pragma once

#include "measure/boxes/worlds.hpp"
#include "measure/row.hpp"
#include "spatial/pairs.hpp"

namespace lantern::measure {

// Sums over the scene's updates.
struct BroadPhaseCounts {
  std::uint64_t all_pairs = 0;       // n (n - 1) / 2: brute force compares them all
  std::uint64_t testable_pairs = 0;  // of them, those in which not both bodies are static: all that
                                     // an engine would test
  std::uint64_t true_pairs = 0;      // by comparing all boxes with all, without any structure
  std::uint64_t missed = 0;          // of them; anything but 0 is a bug
  std::uint64_t invented = 0;        // told, but not there; anything but 0 is a bug
  std::uint64_t candidates = 0;      // pairs that were compared, each once
  std::uint64_t pair_tests = 0;      // comparisons, a pair once for each leaf that it shares
  std::uint64_t entries = 0;         // bodies in leaves, each once a leaf
  std::uint64_t box_tests = 0;       // of a body against a node, while building; a sort counts none
  std::uint64_t nodes = 0;

  std::uint64_t false_candidates() const {  // a structure that misses pairs has none to spare
    return candidates > true_pairs ? candidates - true_pairs : 0;
  }
  // Comparisons of boxes with nodes while building and with each other while pairing: free of
  // noise, and what time goes with. Over capacities and depth limits of 2000 boxes its order agrees
  // with that of measured times (rank correlation 0.75 ... 0.95); that of pair tests and entries
  // does not (-0.1 ... 0.6), since small leaves are cheap to read but dear to fill.
  std::uint64_t work() const { return pair_tests + box_tests; }
  bool operator==(const BroadPhaseCounts&) const = default;
};

// One structure with one pair of settings on one scene.
struct BroadPhaseCost {
  std::string scene;
  int dimension = 2;
  StructureKind kind = StructureKind::quadtree;
  std::uint32_t capacity = 0;  // 0 and 0 for structures without settings
  std::uint32_t depth_limit = 0;
  std::uint64_t bodies = 0;
  std::uint64_t updates = 1;
  std::uint64_t depth = 0;  // of the deepest node
  BroadPhaseCounts counts = {};
  Timing timing = {};  // seconds an update: build and pairs

  bool has_settings() const { return capacity != 0; }
  double entries_per_body() const {
    return static_cast<double>(counts.entries) / static_cast<double>(bodies * updates);
  }
  // Of no true pairs: as though there were one.
  double false_per_true() const {
    const std::uint64_t pairs = counts.true_pairs > 0 ? counts.true_pairs : 1;
    return static_cast<double>(counts.false_candidates()) / static_cast<double>(pairs);
  }
};

struct BroadPhaseCostConfig {
  std::vector<std::uint32_t> capacities = {1, 2, 4, 8, 16, 32, 64};
  std::vector<std::uint32_t> depth_limits = {2, 3, 4, 5, 6, 7, 8, 9, 10};
  TimingRule timing{5, 0.002};
  std::vector<BoxScene> scenes = {};
};

using BroadPhaseResult = BenchResult<BroadPhaseCostConfig, BroadPhaseCost>;

// Rows of a scene in order of kinds, capacities and depth limits; brute force first. `told` is
// called after each row. BSP planes lie at the medians of the bodies' centres, as deep as capacity
// and limit ask for; they are given to it, as a level's designer would, so to choose them is not
// timed.
std::vector<BroadPhaseCost> measure_broad_phases(const BoxScene& scene,
                                                 const BroadPhaseCostConfig& config,
                                                 const std::function<void()>& told);

// How many rows the above gives.
std::size_t broad_phase_rows(const BoxScene& scene, const BroadPhaseCostConfig& config);

// Of all rows of one scene and kind those that cost least; the lower depth limit, then the larger
// capacity, among equals. Nothing if there are none.
enum class CostBy { work, time };
const BroadPhaseCost* cheapest(std::span<const BroadPhaseCost> rows, const std::string& scene,
                               StructureKind kind, CostBy by);

// The row with exactly these settings; nothing if there is none.
const BroadPhaseCost* row_of(std::span<const BroadPhaseCost> rows, const std::string& scene,
                             StructureKind kind, std::uint32_t capacity, std::uint32_t depth_limit);

// Whether the tree was out of proportion and built with half the depth limit instead: then a lower
// limit of the same capacity made a deeper one.
bool was_cut_back(std::span<const BroadPhaseCost> rows, const BroadPhaseCost& row);

// The planes of a BSP that halve the bodies, whose ids are their places, at the median of their
// centres, across the axis of their widest spread, while there are more than `capacity` on a side
// and no more than `most_depth` planes one below the other.
template <int D>
std::vector<BspPlane<D>> median_planes(std::span<const Proxy<D>> boxes, std::uint32_t capacity,
                                       std::uint32_t most_depth);

}  // namespace lantern::measure
