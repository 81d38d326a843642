// Spatial structures at the ends of what boxes can be: every broad phase against brute force.
#include <set>

#include "geometry/random_vec.hpp"
#include "measure/broad_phase_cost.hpp"
#include "measure/stress_scene.hpp"
#include "spatial/pairs.hpp"

namespace lantern::measure {
namespace {

using namespace stress;

constexpr std::size_t kMany = 100'000;
constexpr double kSide = 64;  // of the world in which boxes lie, from the origin

// The world is cut in half on every axis, and its first quarter again.
template <int D>
BroadPhaseConfig<D> config_of(StructureKind kind) {
  BroadPhaseConfig<D> config;
  config.kind = kind;
  config.bounds = {Vec<D>(0.0), Vec<D>(kSide)};
  config.capacity = 2;
  const auto plane = [&](int axis, double offset, std::uint32_t parent, bool front) {
    Vec<D> normal(0.0);
    normal[axis] = 1;
    config.planes.push_back({{normal, offset}, parent, front});
  };
  plane(0, kSide / 2, kNone, false);
  plane(1, kSide / 2, 0, false);
  plane(1, kSide / 2, 0, true);
  plane(0, kSide / 4, 1, false);
  return config;
}

// Pairs of any broad phase that are missed, invented, or told twice, over seeded worlds whose boxes
// are made by `make(random)`; every seventh body is static.
template <int D, class Make>
std::size_t wrong_pairs(Make&& make, std::size_t& true_count) {
  std::size_t wrong = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    std::vector<Proxy<D>> proxies;
    for (BodyId id = 0; id < 150; ++id) proxies.push_back({id, make(random), id % 7 == 0, true});
    const std::vector<Pair> right = pairs_by_force<D>(proxies);
    for (const StructureKind kind : broad_phases_of<D>()) {
      BroadPhase<D> broad_phase(config_of<D>(kind));
      broad_phase.update(proxies);
      true_count += right.size();
      const std::vector<Pair>& found = broad_phase.pairs();
      const std::set<Pair> sorted(found.begin(), found.end());
      const std::vector<Pair> once(sorted.begin(), sorted.end());
      wrong += found.size() - once.size() + count_missing(right, once) + count_missing(once, right);
    }
  }
  return wrong;
}

// Of boxes that `make(random, std::integral_constant<int, D>)` makes.
auto pairs_case(auto make) {
  return [make] {
    std::size_t count = 0;
    const auto wrong_in = [&]<int D>(std::integral_constant<int, D> dimension) {
      return wrong_pairs<D>([&](Random& random) { return make(random, dimension); }, count);
    };
    const std::size_t wrong =
        wrong_in(std::integral_constant<int, 2>()) + wrong_in(std::integral_constant<int, 3>());
    if (count == 0) return at_most(0, kNan, "pairs", "no overlap");
    return at_most(0, static_cast<double>(wrong), "pairs",
                   fmt::format("missed, invented or repeated, of {}; all broad phases", count));
  };
}

const auto outside_the_root = []<int D>(Random& random, std::integral_constant<int, D>) {
  return Box<D>::around(random_point<D>(random, -2 * kSide, 3 * kSide),
                        random_point<D>(random, 0, 25));
};

// Corners on multiples of 4: on the planes at which every tree splits.
const auto on_splitting_planes = []<int D>(Random& random, std::integral_constant<int, D>) {
  Box<D> box;
  for (int i = 0; i < D; ++i) {
    box.lo[i] = 4.0 * static_cast<double>(random.whole(0, 15));
    box.hi[i] = box.lo[i] + 4.0 * static_cast<double>(random.whole(0, 2));
  }
  return box;
};

const auto size_ratio = []<int D>(Random& random, std::integral_constant<int, D>) {
  const double size = std::pow(10.0, static_cast<double>(random.whole(-6, 6)));
  return Box<D>::around(random_point<D>(random, 0, kSide),
                        random_point<D>(random, 0.1 * size, size));
};

const auto aspect_ratio = []<int D>(Random& random, std::integral_constant<int, D>) {
  Vec<D> half(10.0);
  half[static_cast<int>(random.whole(0, D - 1))] = 1e-3;
  return Box<D>::around(random_point<D>(random, 0, kSide), half);
};

const auto zero_size_boxes = []<int D>(Random& random, std::integral_constant<int, D>) {
  Vec<D> p;  // few places, so that some coincide
  for (int i = 0; i < D; ++i) p[i] = 8.0 * static_cast<double>(random.whole(0, 3));
  return Box<D>{p, p};
};

// --- 1e5 objects at one point ---

template <int D>
std::vector<Item<D>> coincident(const Vec<D>& place) {
  std::vector<Item<D>> items;
  for (BodyId id = 0; id < kMany; ++id) items.push_back({id, Box<D>::around(place, Vec<D>(0.5))});
  return items;
}

constexpr std::uint32_t kDeepest = 32;

// A quadtree or an octree.
template <int D>
std::unique_ptr<Structure<D>> orthtree(const StructureConfig<D>& config) {
  return make_structure(D == 2 ? StructureKind::quadtree : StructureKind::octree, config);
}
template <int D>
std::unique_ptr<Structure<D>> deep_tree(bool no_progress_stop) {
  return orthtree<D>({.bounds = {Vec<D>(0.0), Vec<D>(kSide)},
                      .capacity = 2,
                      .max_depth = no_progress_stop ? kDeepest : 8,
                      .no_progress_stop = no_progress_stop});
}

// Somewhere, and on the first splitting plane of every axis.
template <int D>
std::array<Vec<D>, 2> places() {
  return {Vec<D>(21.3), Vec<D>(kSide / 2)};
}

// The nodes that a tree makes although no split can part anything.
template <int D>
double futile_nodes() {
  double most = 0;
  for (const Vec<D>& place : places<D>()) {
    const auto tree = deep_tree<D>(true);
    const auto fitted = make_structure<D>(StructureKind::kd_tree, {.capacity = 2, .max_depth = 16});
    for (Structure<D>* one : {tree.get(), fitted.get()}) {
      one->build(coincident<D>(place));
      most = largest(most, static_cast<double>(one->counters().nodes));
    }
  }
  return most;
}

// Without the no-progress stop the depth limit alone ends the splits. A box of 1 on a corner of
// cells of 1/4 reaches up to 6 of them on each axis, however many bodies there are: entries a body
// over those of a single body.
template <int D>
double memory_growth() {
  double most = 0;
  for (const Vec<D>& place : places<D>()) {
    const auto entries_of = [&](std::size_t n) {
      const auto tree = deep_tree<D>(false);
      for (BodyId id = 0; id < n; ++id) tree->insert({id, Box<D>::around(place, Vec<D>(0.5))});
      return static_cast<double>(tree->counters().entries) / static_cast<double>(n);
    };
    most = largest(most, entries_of(kMany / 10) / entries_of(100));
  }
  return most;
}

template <int D>
double miscounted_pairs() {
  const auto tree = deep_tree<D>(true);
  tree->build(coincident<D>(Vec<D>(21.3)));
  return std::abs(static_cast<double>(count_pair_tests(*tree)) -
                  static_cast<double>(all_pairs(kMany)));
}

// The n(n-1)/2 pairs are refused by the stated budget, and the broad phase goes on.
template <int D>
int silent_kinds(int& tried) {
  int silent = 0;
  for (const StructureKind kind : broad_phases_of<D>()) {
    BroadPhaseConfig<D> config = config_of<D>(kind);
    config.most_pairs = 100'000;
    BroadPhase<D> broad_phase(config);
    std::vector<Proxy<D>> proxies;
    for (const Item<D>& item : coincident<D>(Vec<D>(21.3))) proxies.push_back({item.id, item.box});
    const auto why = refusal([&] { broad_phase.update(proxies); });
    bool good = why && why->find("100000") != std::string::npos && broad_phase.pairs().empty();
    proxies.resize(2);
    broad_phase.update(proxies);
    good = good && broad_phase.pairs() == std::vector<Pair>{{0, 1}};
    ++tried;
    silent += !good;
  }
  return silent;
}

// --- roots without a middle ---

// Bodies in a root that has no number between its bounds: nodes, or endless if pairs are missed.
template <int D>
double nodes_of_root(const Box<D>& bounds) {
  const auto tree = orthtree<D>(
      {.bounds = bounds, .capacity = 1, .max_depth = kDeepest, .no_progress_stop = false});
  for (BodyId id = 0; id < 3; ++id) tree->insert({id, bounds});
  if (candidate_pairs(*tree, 100).pairs.size() != 3) return kInfinity;
  return static_cast<double>(tree->counters().nodes);
}

double worst_root(std::initializer_list<double> lows) {
  return worst_over(lows, [](double low) {
    const double next = std::nextafter(low, kInfinity);
    return largest(nodes_of_root<2>({Vec<2>(low), Vec<2>(next)}),
                   nodes_of_root<3>({Vec<3>(low), Vec<3>(next)}));
  });
}
double root_too_small() { return worst_root({0.0, 1.0, 1 + 0x1p-52, 2 * 0x1p-1074, -1.0}); }
double root_too_far() { return worst_root({1e9, 1e16, 1e300, 1.7e308}); }

// Two bodies at the ends of the largest world: its middle must not overflow.
template <int D>
double wrong_largest() {
  constexpr double kHuge = std::numeric_limits<double>::max();
  const auto tree = orthtree<D>({.bounds = {Vec<D>(-kHuge), Vec<D>(kHuge)},
                                 .capacity = 1,
                                 .max_depth = 6,
                                 .no_progress_stop = false});
  tree->insert({0, {Vec<D>(-kHuge), Vec<D>(-1e308)}});
  tree->insert({1, {Vec<D>(1e308), Vec<D>(kHuge)}});
  return static_cast<double>(candidate_pairs(*tree, 100).pairs.size());
}

}  // namespace

std::vector<StressCase> tree_cases() {
  constexpr const char* kGroup = "extreme input";
  return {
      {"coincident_bodies", kGroup, "A tree does not split 1e5 objects at one point.",
       none_above(1, "nodes", "quadtree, octree and kD-trees of 100000 equal boxes, depth limit 32",
                  futile_nodes<2>, futile_nodes<3>)},
      {"coincident_memory", kGroup, "Memory grows with n where only the depth limit stops a tree.",
       none_above(1, "x",
                  "entries a body, 10000 equal boxes over 100, stopped by the depth limit 8 only",
                  memory_growth<2>, memory_growth<3>)},
      {"coincident_pairs_counted", kGroup, "The n(n-1)/2 pairs at one point can be counted.",
       none_above(0, "pairs", "off n(n-1)/2 = 4999950000, counted without being collected",
                  miscounted_pairs<2>, miscounted_pairs<3>)},
      {"coincident_pairs_refused", kGroup,
       "More pairs than the budget are refused, and the broad phase goes on.",
       none_wrong("broad phases", "of {} that do not refuse 5e9 pairs by a budget of 1e5",
                  silent_kinds<2>, silent_kinds<3>)},
      {"root_too_small", kGroup, "A node whose middle equals a bound stops splitting.",
       none_above(1, "nodes", "roots from one number to the next, near 0 and 1", root_too_small)},
      {"root_too_far", kGroup, "A root too far away to have a middle stops splitting.",
       none_above(1, "nodes", "roots from one number to the next, at 1e9 ... 1.7e308",
                  root_too_far)},
      {"root_too_large", kGroup, "The middle of the largest possible root does not overflow.",
       none_above(0, "pairs", "invented, of bodies at both ends of all numbers", wrong_largest<2>,
                  wrong_largest<3>)},
      {"outside_the_root", kGroup,
       "Objects outside the root's box are kept, and their pairs found.",
       pairs_case(outside_the_root)},
      {"on_splitting_planes", kGroup,
       "Objects on splitting planes, or touching exactly, give each pair once.",
       pairs_case(on_splitting_planes)},
      {"zero_size_boxes", kGroup, "Boxes of no size give the pairs of brute force.",
       pairs_case(zero_size_boxes)},
      {"size_ratio", kGroup, "Sizes from 1e-6 to 1e6 give the pairs of brute force.",
       pairs_case(size_ratio)},
      {"aspect_ratio", kGroup, "Aspects of 1 : 1e4 give the pairs of brute force.",
       pairs_case(aspect_ratio)}};
}

}  // namespace lantern::measure
