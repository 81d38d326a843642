// What is told of structures beside the pairs: the way to them, their work, and which to choose.
#include <map>
#include <set>
#include <unordered_map>

#include "geometry/shape.hpp"
#include "lecture/collision_detection.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/pairs.hpp"
#include "spatial/trees/kd_tree.hpp"

namespace lantern::spatial {
namespace {

template <int D>
std::uint64_t dynamic_tests(const BroadPhase<D>& broad) {
  return broad.dynamic().structure->work().box_tests;
}

// Are those that move where they were?
template <int D>
bool same_movers(std::span<const Proxy<D>> before, std::span<const Proxy<D>> after) {
  return std::ranges::equal(before, after, [](const Proxy<D>& a, const Proxy<D>& b) {
    return a.is_static || (a.box.lo == b.box.lo && a.box.hi == b.box.hi);
  });
}

template <int D>
bool some_stand(std::span<const Proxy<D>> boxes) {
  return std::ranges::count(boxes, true, &Proxy<D>::is_static) > 0;
}

// Planes for a BSP as a level's compiler finds them (level_bsp.hpp): of those through an upper face
// of a box that never moves, or of any box if all move, the best for these boxes. `tests` counts
// comparisons of a box with a plane. No deeper than a tree that halves every axis `max_depth`
// times.
template <int D>
std::vector<BspPlane<D>> compiled_planes(std::span<const Proxy<D>> boxes,
                                         const StructureConfig<D>& config, std::uint64_t& tests) {
  std::vector<BspPlane<D>> planes;
  const auto divide = [&](const auto& self, const std::vector<Box<D>>& held, std::uint32_t parent,
                          bool front, std::uint32_t depth) -> void {
    if (held.size() <= config.capacity || depth == D * config.max_depth) return;
    std::optional<KdCut> best;
    for (const Box<D>& one : held)
      for (int axis = 0; axis < D; ++axis) {
        stop_if_asked();
        KdCut cut{axis, one.hi[axis]};
        std::size_t behind = 0, in_front = 0;
        for (const Box<D>& box : held) {
          behind += cut.behind(box);
          in_front += cut.in_front(box);
        }
        tests += held.size();
        cut.fuller = std::max(behind, in_front);
        cut.both = behind + in_front - held.size();
        if (cut.fuller < held.size() && (!best || cut.better_than(*best))) best = cut;
      }
    if (!best) return;
    std::vector<Box<D>> behind, in_front;
    for (const Box<D>& box : held) {
      if (best->behind(box)) behind.push_back(box);
      if (best->in_front(box)) in_front.push_back(box);
    }
    Vec<D> normal(0.0);
    normal[best->axis] = 1;
    const auto own = static_cast<std::uint32_t>(planes.size());
    planes.push_back({{normal, best->plane}, parent, front});
    self(self, behind, own, false, depth + 1);
    self(self, in_front, own, true, depth + 1);
  };
  std::vector<Box<D>> all;
  const bool some = some_stand(boxes);
  for (const Proxy<D>& proxy : boxes)
    if (proxy.is_static || !some) all.push_back(proxy.box);
  divide(divide, all, kNone, false, 0);
  return planes;
}

// What finding all pairs of a body costs, in ns, as measured: to compare it with another one,
// sixteen at a time; to part it from the others in cells; and how much more a pair costs there,
// since pairs of all with all come in order.
template <int D>
constexpr double kCompare = D == 2 ? 0.35 : 0.5;
constexpr double kPart = 60, kPutInOrder = 4.5;

// Of a sample of pairs: which share overlaps.
template <int D>
double share_of_overlaps(Items<D> items) {
  constexpr std::size_t kSamples = 2000;
  if (items.size() < 2) return 0;
  std::size_t tested = 0, overlaps = 0;
  std::uint64_t random = 1;  // Knuth's MMIX generator: any spread of numbers will do
  const auto any = [&] {
    random = random * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::size_t>(random >> 33) % items.size();
  };
  while (tested < kSamples) {
    const std::size_t a = any(), b = any();
    if (a == b) continue;
    ++tested;
    overlaps += overlap(items.box(a), items.box(b));
  }
  return static_cast<double>(overlaps) / static_cast<double>(tested);
}

template <int D>
bool reaches_without_end(const Box<D>& box) {
  for (int i = 0; i < D; ++i)
    if (box.lo[i] <= -kEndless || box.hi[i] >= kEndless) return true;
  return false;
}

// The longest side of each body that has one, in order.
template <int D>
std::vector<double> sizes_of(Items<D> items) {
  std::vector<double> sizes;
  for (const Item<D>& item : items)
    if (!reaches_without_end(item.box)) sizes.push_back(extent_of(item.box));
  std::ranges::sort(sizes);
  return sizes;
}

template <int D>
Box<D> around_all(Items<D> items) {
  std::optional<Box<D>> all;
  for (const Item<D>& item : items)
    if (!reaches_without_end(item.box)) all = all ? united(*all, item.box) : item.box;
  return all.value_or(Box<D>{Vec<D>(-1.0), Vec<D>(1.0)});
}

std::string percent(double share) {
  return share > 0 && share < 0.01 ? "less than 1%" : fmt::format("{:.0f}%", 100 * share);
}

}  // namespace

template <int D>
PairChain BroadPhase<D>::pair_chain(FunctionRef<bool(BodyId)> awake, std::uint64_t most,
                                    FunctionRef<std::uint64_t(BodyId)> address) const {
  std::vector<bool> stirring;
  for (std::size_t i = 0; i < dynamic_.boxes.size(); ++i)
    stirring.push_back(!dynamic_.state(i).is_static && awake(dynamic_.id(i)));
  PairChain chain;
  const auto meet = [&](BodyId i, const Store& store, BodyId j) {
    require_within(++chain.met, most);
    const BodyId a = dynamic_.id(i), b = store.id(j);
    chain.pairs.push_back({std::min(a, b), std::max(a, b)});
  };
  // What sorts its bodies before it is asked does so in a copy, and stays as it is.
  const auto dynamic_copy = dynamic_.structure->sorted(), static_copy = static_.structure->sorted();
  const Structure<D>& of_dynamic = dynamic_copy ? *dynamic_copy : *dynamic_.structure;
  const Structure<D>& of_static = static_copy ? *static_copy : *static_.structure;
  chain.besides = of_dynamic.compare([&](BodyId i) -> bool { return stirring[i]; },
                                     [&](BodyId i, BodyId j) { meet(i, dynamic_, j); });
  for (std::uint32_t i = 0; i < stirring.size() && !static_.boxes.empty(); ++i) {
    std::vector<BodyId> near;
    if (stirring[i]) chain.besides += of_static.near(dynamic_.boxes[i], near);
    for (const BodyId j : near) meet(i, static_, j);
  }
  std::map<lecture::CollisionDetection::CollisionInfoAsPrinted, Pair> first;
  std::set<Pair> lost;
  if (address)
    std::erase_if(chain.pairs, [&](const Pair& pair) {
      const auto [low, high] = std::minmax({address(pair.a), address(pair.b)});
      const Pair& known = first.try_emplace({low, high}, pair).first->second;
      return known != pair && (lost.insert(pair), true);
    });
  chain.lost = lost.size();
  std::ranges::sort(chain.pairs, [](const Pair& x, const Pair& y) {
    stop_if_asked();
    return x < y;
  });
  chain.pairs.erase(std::ranges::unique(chain.pairs).begin(), chain.pairs.end());
  for (const Pair& pair : chain.pairs)
    if (overlap(*box_of(pair.a), *box_of(pair.b))) chain.overlapping.push_back(pair);
  return chain;
}

template PairChain BroadPhase<2>::pair_chain(FunctionRef<bool(BodyId)>, std::uint64_t,
                                             FunctionRef<std::uint64_t(BodyId)>) const;
template PairChain BroadPhase<3>::pair_chain(FunctionRef<bool(BodyId)>, std::uint64_t,
                                             FunctionRef<std::uint64_t(BodyId)>) const;

bool counts_its_work(StructureKind kind) {
  return std::ranges::count(kStructureKinds, kind) > 0 && !traits_of(kind).is_plain;
}

template <int D>
StructureWork structure_work(BroadPhaseConfig<D> config, std::span<const Proxy<D>> before,
                             std::span<const Proxy<D>> after, std::uint64_t most) {
  config.split_static = true;
  StructureWork work;
  const bool chooses = traits_of(config.kind).has(Setting::planes) && config.planes.empty();
  if (chooses) config.planes = compiled_planes(before, config, work.build);
  std::optional<BroadPhase<D>> broad(std::in_place, config);
  broad->build(before);
  std::uint64_t at_first = dynamic_tests(*broad), builds = broad->counters().dynamic_builds;
  work.build += at_first + broad->fixed().structure->work().box_tests;
  const bool moved = !same_movers(before, after);
  if (chooses && moved && !some_stand(before)) {  // its planes were chosen for where they were
    config.planes = compiled_planes(after, config, work.renew);
    broad.emplace(config);
    at_first = builds = 0;
  }
  broad->build(after);
  // What is built anew begins to count anew, as does a tree that follows its bodies; what stands
  // goes on.
  const bool anew =
      (traits_of(config.kind).follows && moved) || broad->counters().dynamic_builds > builds;
  work.renew += dynamic_tests(*broad) - (anew ? 0 : at_first);

  std::unordered_map<BodyId, bool> stirs;
  for (const Proxy<D>& proxy : after) stirs[proxy.id] = proxy.awake && !proxy.is_static;
  const PairChain chain = broad->pair_chain([&](BodyId id) { return stirs.at(id); }, most);
  work.pair = chain.met + chain.besides;
  work.pairs = chain.pairs.size();
  work.overlaps = chain.overlapping.size();
  return work;
}

template StructureWork structure_work(BroadPhaseConfig<2>, std::span<const Proxy<2>>,
                                      std::span<const Proxy<2>>, std::uint64_t);
template StructureWork structure_work(BroadPhaseConfig<3>, std::span<const Proxy<3>>,
                                      std::span<const Proxy<3>>, std::uint64_t);

template <int D>
StructureChoice<D> choose_structure(Items<D> items, const StructureConfig<D>& config, Use use) {
  StructureChoice<D> choice;
  choice.config = config;
  if (use == Use::questions) {
    choice.kind = StructureKind::wide_bvh;
    choice.why = fmt::format("{} bodies are asked, not paired", items.size());
    return choice;
  }
  const double share = share_of_overlaps(items);
  const double others = static_cast<double>(items.size()) / 2;
  if (others * kCompare<D> < kPart + others * share * kPutInOrder) {
    choice.why = fmt::format(
        "{} bodies, of sampled pairs {} overlap: comparing all with all costs less than "
        "partitioning them",
        items.size(), percent(share));
    return choice;
  }
  const std::vector<double> sizes = sizes_of(items);
  const double median = sizes.empty() ? 0 : sizes[sizes.size() / 2];
  const double largest = sizes.empty() ? 0 : sizes.back();
  choice.kind = StructureKind::grid;
  choice.config.bounds = around_all(items);
  choice.config.cell = 0;
  choice.config.levels = 1;
  choice.why = fmt::format("{} bodies, the largest {:.3g} times as large as the median",
                           items.size(), median > 0 ? largest / median : 1.0);
  return choice;
}

template StructureChoice<2> choose_structure(Items<2>, const StructureConfig<2>&, Use);
template StructureChoice<3> choose_structure(Items<3>, const StructureConfig<3>&, Use);

}  // namespace lantern::spatial
