#include "measure/broad_phase_cost.hpp"

#include <iterator>
#include <numeric>
#include <tuple>

#include "base/memory.hpp"

namespace lantern::measure {
namespace {

// Pairs of n bodies, each a bit.
class PairSet {
 public:
  explicit PairSet(std::size_t bodies) : bodies_(bodies) {
    require_memory(bodies * bodies / 8, fmt::format("the pairs of {} bodies", bodies),
                   "take fewer bodies");
    bits_.resize(bodies * bodies);
  }
  void add(BodyId a, BodyId b) {
    std::vector<bool>::reference bit = bits_[std::min(a, b) * bodies_ + std::max(a, b)];
    size_ += bit ? 0 : 1;
    bit = true;
  }
  std::uint64_t size() const { return size_; }

 private:
  std::size_t bodies_;
  std::vector<bool> bits_;
  std::uint64_t size_ = 0;
};

// Bodies that share a leaf, each pair once.
template <int D>
std::uint64_t count_candidates(const BroadPhase<D>& broad_phase, std::span<const Proxy<D>> boxes) {
  // A structure that does not pair leaf by leaf compares each pair once.
  if (!traits_of(broad_phase.config().kind).meets_in_leaves)
    return broad_phase.counters().pair_tests;
  PairSet met(boxes.size());
  broad_phase.dynamic().visit([&](const NodeView<D>& node) {
    for (std::size_t i = 0; i < node.bodies.size(); ++i) {
      stop_if_asked();
      for (std::size_t j = i + 1; j < node.bodies.size(); ++j)
        if (!boxes[node.bodies[i]].is_static || !boxes[node.bodies[j]].is_static)
          met.add(node.bodies[i], node.bodies[j]);
    }
    return true;
  });
  return met.size();
}

// Along which the boxes' centres are spread most.
template <int D>
int widest_axis(std::span<const Proxy<D>> boxes, const std::vector<BodyId>& bodies) {
  const Vec<D> first = boxes[bodies[0]].box.center();
  Box<D> around{first, first};
  for (const BodyId i : bodies) {
    const Vec<D> center = boxes[i].box.center();
    around = united(around, {center, center});
  }
  int widest = 0;
  for (int i = 1; i < D; ++i)
    if (around.size()[i] > around.size()[widest]) widest = i;
  return widest;
}

}  // namespace

template <int D>
std::vector<BspPlane<D>> median_planes(std::span<const Proxy<D>> boxes, std::uint32_t capacity,
                                       std::uint32_t most_depth) {
  std::vector<BspPlane<D>> planes;
  const auto halve = [&](const auto& self, std::vector<BodyId> bodies, std::uint32_t parent,
                         bool front, std::uint32_t depth) {
    if (bodies.size() <= capacity || depth == most_depth) return;
    const int axis = widest_axis(boxes, bodies);
    const auto at = [&](BodyId i) { return boxes[i].box.center()[axis]; };
    std::ranges::sort(bodies, {}, [&](BodyId i) { return std::pair(at(i), i); });
    const auto middle = bodies.begin() + static_cast<std::ptrdiff_t>(bodies.size() / 2);
    const double offset = 0.5 * (at(*(middle - 1)) + at(*middle));
    if (at(bodies.front()) == at(bodies.back())) return;  // it would part nobody
    Vec<D> normal(0.0);
    normal[axis] = 1;
    const auto own = static_cast<std::uint32_t>(planes.size());
    planes.push_back({{normal, offset}, parent, front});
    self(self, {bodies.begin(), middle}, own, false, depth + 1);
    self(self, {middle, bodies.end()}, own, true, depth + 1);
  };
  std::vector<BodyId> all(boxes.size());
  std::iota(all.begin(), all.end(), BodyId{0});
  halve(halve, all, kNone, false, 0);
  return planes;
}
template std::vector<BspPlane<2>> median_planes<2>(std::span<const Proxy<2>>, std::uint32_t,
                                                   std::uint32_t);
template std::vector<BspPlane<3>> median_planes<3>(std::span<const Proxy<3>>, std::uint32_t,
                                                   std::uint32_t);

namespace {

template <int D>
void count_update(BroadPhase<D>& broad_phase, std::span<const Proxy<D>> boxes,
                  std::span<const Pair> truth, BroadPhaseCost& cost) {
  broad_phase.update(boxes);
  BroadPhaseCounts& c = cost.counts;
  const auto fixed =
      static_cast<std::size_t>(std::ranges::count(boxes, true, &Proxy<D>::is_static));
  c.all_pairs += all_pairs(boxes.size());
  c.testable_pairs += testable_pairs(boxes.size(), fixed);
  c.true_pairs += truth.size();
  c.missed += count_missing(truth, broad_phase.pairs());
  c.invented += count_missing(broad_phase.pairs(), truth);
  c.candidates += count_candidates(broad_phase, boxes);
  c.pair_tests += broad_phase.counters().pair_tests;
  const Counters tree = broad_phase.dynamic().counters();
  c.entries += tree.entries;
  // What such a structure calls its tests are those of pairs, which are counted above.
  if (traits_of(cost.kind).meets_in_leaves) c.box_tests += tree.box_tests;
  c.nodes += tree.nodes;
  cost.depth = std::max(cost.depth, tree.depth);
}

template <int D>
BroadPhaseCost measure_one(const BoxUpdates<D>& scene, const std::vector<std::vector<Pair>>& truth,
                           const BroadPhaseCost& what, const TimingRule& plan) {
  BroadPhaseConfig<D> config;
  config.kind = what.kind;
  config.bounds = scene.bounds;
  config.split_static = false;
  if (what.has_settings()) {
    config.capacity = what.capacity;
    config.max_depth = what.depth_limit;
  }
  if (traits_of(what.kind).has(Setting::planes))
    config.planes = median_planes<D>(scene.frames[0], what.capacity, what.depth_limit);
  BroadPhase<D> broad_phase(config);
  BroadPhaseCost cost = what;
  for (std::size_t i = 0; i < scene.frames.size(); ++i)
    count_update<D>(broad_phase, scene.frames[i], truth[i], cost);
  std::size_t next = 0;
  cost.timing = timed(plan, [&] {
    broad_phase.update({});  // or an update of the same boxes would do nothing
    broad_phase.update(scene.frames[next]);
    next = (next + 1) % scene.frames.size();
  });
  return cost;
}

std::vector<BroadPhaseCost> planned(const BoxScene& scene, const BroadPhaseCostConfig& config) {
  std::vector<BroadPhaseCost> rows;
  for (const StructureKind kind : kStructureKinds) {
    if (!is_possible(kind, scene.dimension())) continue;
    BroadPhaseCost row{.scene = scene.name, .dimension = scene.dimension(), .kind = kind};
    std::visit(
        [&](const auto& boxes) {
          row.bodies = boxes.frames[0].size();
          row.updates = boxes.frames.size();
        },
        scene.boxes);
    if (kind == StructureKind::brute_force || !traits_of(kind).meets_in_leaves) {
      rows.push_back(row);
      continue;
    }
    for (const std::uint32_t capacity : config.capacities)
      for (const std::uint32_t depth : config.depth_limits) {
        row.capacity = capacity;
        row.depth_limit = depth;
        rows.push_back(row);
      }
  }
  return rows;
}

}  // namespace

std::size_t broad_phase_rows(const BoxScene& scene, const BroadPhaseCostConfig& config) {
  return planned(scene, config).size();
}

std::vector<BroadPhaseCost> measure_broad_phases(const BoxScene& scene,
                                                 const BroadPhaseCostConfig& config,
                                                 const std::function<void()>& told) {
  std::vector<BroadPhaseCost> rows;
  std::visit(
      [&]<int D>(const BoxUpdates<D>& boxes) {
        std::vector<std::vector<Pair>> truth;
        for (const auto& frame : boxes.frames) truth.push_back(pairs_by_force<D>(frame));
        for (const BroadPhaseCost& what : planned(scene, config)) {
          rows.push_back(measure_one(boxes, truth, what, config.timing));
          told();
        }
      },
      scene.boxes);
  return rows;
}

const BroadPhaseCost* cheapest(std::span<const BroadPhaseCost> rows, const std::string& scene,
                               StructureKind kind, CostBy by) {
  const BroadPhaseCost* best = nullptr;
  const auto cost = [&](const BroadPhaseCost& row) {
    const double spent =
        by == CostBy::work ? static_cast<double>(row.counts.work()) : row.timing.least;
    return std::tuple(spent, row.depth_limit, -std::int64_t{row.capacity});
  };
  for (const BroadPhaseCost& row : rows)
    if (row.scene == scene && row.kind == kind && (!best || cost(row) < cost(*best))) best = &row;
  return best;
}

bool was_cut_back(std::span<const BroadPhaseCost> rows, const BroadPhaseCost& row) {
  return std::ranges::any_of(rows, [&](const BroadPhaseCost& other) {
    return other.scene == row.scene && other.kind == row.kind && other.capacity == row.capacity &&
           other.depth_limit < row.depth_limit && other.depth > row.depth;
  });
}

const BroadPhaseCost* row_of(std::span<const BroadPhaseCost> rows, const std::string& scene,
                             StructureKind kind, std::uint32_t capacity,
                             std::uint32_t depth_limit) {
  const auto found = std::ranges::find_if(rows, [&](const BroadPhaseCost& row) {
    return row.scene == scene && row.kind == kind && row.capacity == capacity &&
           row.depth_limit == depth_limit;
  });
  return found == rows.end() ? nullptr : &*found;
}

}  // namespace lantern::measure
