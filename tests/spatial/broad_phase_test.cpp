// Every kind of broad phase against n(n-1)/2 comparisons, in worlds that move, sleep and wake.
#include "spatial/broad_phase.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "geometry/shape.hpp"
#include "spatial/planes.hpp"
#include "spatial/query.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::kSorts;
using testing::Sort;
using testing::true_pairs;

template <int D>
std::vector<Proxy<D>> random_proxies(Sort sort, std::size_t bodies, Random& random) {
  std::vector<Proxy<D>> proxies;
  const bool numbered = random.bits() % 2 == 0;
  for (const Item<D>& item : testing::random_world<D>(sort, bodies, random))
    proxies.push_back({numbered ? static_cast<BodyId>(proxies.size()) : item.id, item.box,
                       random.whole(0, 2) == 0, random.whole(0, 2) != 0});
  // A floor without end, standing in for a half-space.
  Box<D> floor{Vec<D>(-kEndless), Vec<D>(kEndless)};
  floor.hi.y = 7;
  if (random.bits() % 2 == 0) proxies.front().box = floor;
  return proxies;
}

template <int D>
void move(Sort sort, std::vector<Proxy<D>>& proxies, Random& random) {
  for (Proxy<D>& proxy : proxies) {
    if (random.whole(0, 3) == 0) proxy.awake = !proxy.awake;
    if (proxy.awake && !proxy.is_static && random.bits() % 2 == 0)
      proxy.box = testing::random_box<D>(sort, random);
    if (random.whole(0, 60) == 0) proxy.is_static = !proxy.is_static;
  }
  if (random.whole(0, 2) == 0 && proxies.size() > 1) proxies.pop_back();
  testing::shuffle(proxies, random);
}

template <int D>
std::vector<StructureKind> kinds() {
  std::vector<StructureKind> kinds(kStructureKinds.begin(), kStructureKinds.end());
  if (D == 2) std::erase(kinds, StructureKind::octree);
  kinds.push_back(StructureKind::wide_bvh);
  return kinds;
}

template <int D>
BroadPhaseConfig<D> config_of(StructureKind kind, Sort sort, Random& random) {
  BroadPhaseConfig<D> config;
  config.kind = kind;
  config.bounds = testing::bounds_of<D>(sort);
  config.capacity = static_cast<std::uint32_t>(random.whole(1, 6));
  config.max_depth = static_cast<std::uint32_t>(random.whole(0, 6));
  config.eager_children = random.bits() % 2 == 0;
  config.no_progress_stop = random.bits() % 2 == 0;
  config.split_static = random.whole(0, 3) != 0;
  config.planes = testing::random_planes<D>(sort, 9, random);
  config.cell = random.bits() % 2 == 0 ? 0 : random.between(0.5, 20);
  config.levels = static_cast<std::uint32_t>(random.whole(1, 4));
  config.open = random.bits() % 2 == 0;
  return config;
}

// What the counters of an update must be, seen from outside: a node is visited if a body below it
// is awake, else it is skipped where its parent was not; in a leaf, the awake bodies are compared
// with each other and with those that sleep.
template <int D>
void expect_counted(const BroadPhase<D>& phase, const std::vector<Proxy<D>>& proxies) {
  const StructureKind kind = phase.config().kind;
  const bool in_leaves = traits_of(kind).meets_in_leaves;
  std::set<BodyId> stirs;
  bool has_static = false;
  for (const Proxy<D>& p : proxies) {
    if (p.awake && !p.is_static) stirs.insert(p.id);
    has_static |= p.is_static;
  }
  const BroadPhaseCounters c = phase.counters();
  if (stirs.empty()) {
    EXPECT_EQ(c.nodes_visited + c.nodes_skipped_asleep + c.pair_tests + c.nodes_reused, 0u);
    return;
  }
  struct Node {
    std::uint32_t parent = 0;
    bool awake = false;
  };
  std::vector<Node> nodes;
  std::uint64_t tests = 0;
  phase.dynamic().visit([&](const NodeView<D>& view) {
    std::uint64_t awake = 0;
    for (const BodyId id : view.bodies) awake += stirs.count(id);
    nodes.push_back({view.parent, awake > 0});
    tests += awake * (view.bodies.size() - awake) + awake * (awake - 1) / 2;
    return true;
  });
  for (std::size_t i = nodes.size(); i-- > 1;)
    if (nodes[i].awake) nodes[nodes[i].parent].awake = true;
  std::uint64_t visited = 0, skipped = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    visited += nodes[i].awake;
    skipped += !nodes[i].awake && nodes[nodes[i].parent].awake;
  }
  EXPECT_EQ(c.nodes_skipped_asleep, in_leaves ? skipped : 0);
  if (!in_leaves) return;
  EXPECT_EQ(c.nodes_visited, visited);
  if (phase.config().split_static && has_static) {
    EXPECT_GE(c.pair_tests, tests) << "besides those with static bodies";
  } else {
    EXPECT_EQ(c.pair_tests, tests);
  }
}

template <int D>
void every_kind_is_exact(std::size_t bodies, std::uint64_t seeds) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      Random random(100 * seed + static_cast<std::uint64_t>(sort));
      std::vector<BroadPhase<D>> phases;
      for (const StructureKind kind : kinds<D>())
        phases.emplace_back(config_of<D>(kind, sort, random));
      auto proxies = random_proxies<D>(sort, bodies, random);
      for (int update = 0; update < 5; ++update) {
        const auto expected = true_pairs(proxies);
        for (BroadPhase<D>& phase : phases) {
          phase.update(proxies);
          ASSERT_EQ(phase.pairs(), expected)
              << to_string(phase.config().kind) << " in " << D << "D, sort "
              << static_cast<int>(sort) << ", seed " << seed << ", update " << update;
          expect_counted(phase, proxies);
        }
        move(sort, proxies, random);
      }
    }
}

TEST(BroadPhase, EveryKindEqualsBruteForceIn2D) { every_kind_is_exact<2>(70, 12); }
TEST(BroadPhase, EveryKindEqualsBruteForceIn3D) { every_kind_is_exact<3>(70, 8); }

TEST(BroadPhase, NamesAreReadBack) {
  for (const StructureKind kind : kStructureKinds)
    EXPECT_EQ(structure_named(to_string(kind)), kind) << to_string(kind);
  EXPECT_EQ(structure_named("quad tree"), std::nullopt);
}

TEST(BroadPhase, RefusesWhatItCannotDoAndStaysAsItWas) {
  BroadPhaseConfig<2> config;
  config.kind = StructureKind::octree;
  EXPECT_THROW(BroadPhase<2>{config}, Refused) << "an octree in two dimensions";
  BroadPhase<2> phase({});
  const Box<2> box{{0, 0}, {1, 1}};
  phase.update(std::vector<Proxy<2>>{{4, box}, {2, box}});
  const std::vector<Pair> before = phase.pairs();
  ASSERT_EQ(before, (std::vector<Pair>{{2, 4}}));
  EXPECT_THROW(phase.update(std::vector<Proxy<2>>{{2, box}, {2, box}}), Refused) << "an id twice";
  EXPECT_THROW(phase.update(std::vector<Proxy<2>>{{2, {{1, 0}, {0, 1}}}}), Refused) << "inverted";
  EXPECT_EQ(phase.pairs(), before);
}

TEST(BroadPhase, TooManyPairsAreRefusedAndTheNextUpdateIsRight) {
  for (const StructureKind kind : kinds<2>()) {
    BroadPhaseConfig<2> config;
    config.kind = kind;
    config.most_pairs = 44;
    BroadPhase<2> phase(config);
    std::vector<Proxy<2>> proxies;
    for (BodyId id = 0; id < 10; ++id) proxies.push_back({id, {{1, 1}, {2, 2}}});
    EXPECT_THROW(phase.update(proxies), Refused) << to_string(kind) << ": 45 pairs";
    EXPECT_TRUE(phase.pairs().empty()) << to_string(kind);
    std::size_t held = 0;
    phase.dynamic().visit([&](const NodeView<2>& node) {
      held += node.bodies.size();
      return true;
    });
    EXPECT_EQ(held, 0u) << to_string(kind) << ": it shows bodies that it has forgotten";
    proxies.pop_back();
    phase.update(proxies);
    EXPECT_EQ(phase.pairs().size(), 36u) << to_string(kind);
  }
}

// Bodies on a grid, each overlapping its neighbours to the right and above.
std::vector<Proxy<2>> grid(int side) {
  std::vector<Proxy<2>> proxies;
  for (int i = 0; i < side * side; ++i) {
    const Vec<2> center(4.0 * (i % side) + 2, 4.0 * (i / side) + 2);
    proxies.push_back({static_cast<BodyId>(i), Box<2>::around(center, Vec<2>(2.1))});
  }
  return proxies;
}

BroadPhaseConfig<2> grid_config(StructureKind kind, int side) {
  BroadPhaseConfig<2> config;
  config.kind = kind;
  config.bounds = {Vec<2>(0.0), Vec<2>(4.0 * side)};
  for (std::uint32_t i = 0; i + 1 < 8; ++i)
    config.planes.push_back({Plane<2>{{1, 0}, side / 2.0 * (i + 1)}, i == 0 ? kNone : i - 1, true});
  return config;
}

TEST(BroadPhase, TheStaticStructureIsBuiltOnceAndAgainOnlyWhenStaticBodiesChange) {
  for (const StructureKind kind : kinds<2>()) {
    BroadPhase<2> phase(grid_config(kind, 12));
    auto proxies = grid(12);
    for (std::size_t i = 0; i < proxies.size(); ++i) proxies[i].is_static = i % 3 != 0;
    for (int step = 0; step < 10; ++step) {
      for (Proxy<2>& p : proxies)
        if (!p.is_static) p.box = {p.box.lo + 0.01, p.box.hi + 0.01};
      phase.update(proxies);
    }
    EXPECT_EQ(phase.counters().static_builds, 1u) << to_string(kind) << ": nothing static changed";
    EXPECT_EQ(phase.counters().dynamic_builds, kind == StructureKind::aabb_tree ? 1u : 10u)
        << to_string(kind) << ": mended, or built";
    proxies[1].awake = false;  // says nothing of a static body
    phase.update(proxies);
    EXPECT_EQ(phase.counters().static_builds, 1u) << to_string(kind);
    proxies.erase(proxies.begin() + 1);  // a wall is blown up
    phase.update(proxies);
    EXPECT_EQ(phase.counters().static_builds, 2u) << to_string(kind) << ": a static body went";
    EXPECT_EQ(phase.pairs(), true_pairs(proxies)) << to_string(kind);
  }
}

// A row of walls, and one body that touches two of them.
TEST(BroadPhase, ABodyIsComparedOnlyWithStaticOnesThatAreNear) {
  for (const StructureKind kind : kinds<2>()) {
    BroadPhase<2> phase(grid_config(kind, 100));
    std::vector<Proxy<2>> proxies;
    for (BodyId id = 0; id < 100; ++id)
      proxies.push_back({id, Box<2>::around({4.0 * id + 2, 2}, Vec<2>(2.0)), true});
    proxies.push_back({100, Box<2>::around({350.5, 2}, Vec<2>(2.0))});
    phase.update(proxies);
    EXPECT_EQ(phase.pairs(), (std::vector<Pair>{{87, 100}, {88, 100}})) << to_string(kind);
    const std::uint64_t tests = phase.counters().pair_tests;
    if (kind == StructureKind::brute_force) {
      EXPECT_EQ(tests, 100u);
    } else if (kind == StructureKind::sort_and_sweep) {
      EXPECT_EQ(tests, 2u);
    } else {
      EXPECT_GE(tests, 2u) << to_string(kind);
      EXPECT_LE(tests, kind == StructureKind::bsp ? 60u : 14u) << to_string(kind);
    }
  }
}

TEST(BroadPhase, WhereNothingIsAwakeNothingIsBuilt) {
  for (const StructureKind kind : kinds<2>()) {
    BroadPhase<2> phase(grid_config(kind, 8));
    auto proxies = grid(8);
    for (Proxy<2>& p : proxies) p.awake = false;
    for (int step = 0; step < 5; ++step) phase.update(proxies);
    EXPECT_EQ(phase.counters().dynamic_builds, 0u) << to_string(kind);
    EXPECT_EQ(phase.counters().pair_tests, 0u) << to_string(kind);
    EXPECT_TRUE(phase.pairs().empty()) << to_string(kind);
    proxies[0].awake = true;
    phase.update(proxies);
    EXPECT_EQ(phase.pairs(), true_pairs(proxies)) << to_string(kind) << ": the first one woke";
    proxies[0].awake = false;
    phase.update(proxies);
    EXPECT_EQ(phase.counters().dynamic_builds, 1u) << to_string(kind) << ": all sleep again";
    std::size_t shown = 0;
    phase.dynamic().visit(
        [&](const NodeView<2>& node) { return shown += node.bodies.size(), true; });
    EXPECT_GE(shown, proxies.size()) << to_string(kind) << ": the tree that stood is still right";
    proxies[5].box.hi += 1.0;
    phase.update(proxies);
    shown = 0;
    phase.dynamic().visit(
        [&](const NodeView<2>& node) { return shown += node.bodies.size(), true; });
    EXPECT_EQ(shown, 0u) << to_string(kind) << ": a tree that is wrong must not be shown";
  }
}

TEST(BroadPhase, BranchesWhereAllSleepAreSkipped) {
  for (const StructureKind kind :
       {StructureKind::quadtree, StructureKind::kd_tree, StructureKind::bsp}) {
    BroadPhase<2> phase(grid_config(kind, 16));
    auto proxies = grid(16);
    phase.update(proxies);
    const BroadPhaseCounters all_awake = phase.counters();
    EXPECT_EQ(all_awake.nodes_skipped_asleep, 0u) << to_string(kind);
    for (Proxy<2>& p : proxies) p.awake = p.id == 0;
    phase.update(proxies);
    const BroadPhaseCounters one_awake = phase.counters();
    EXPECT_GT(one_awake.nodes_skipped_asleep, 0u) << to_string(kind);
    EXPECT_LT(one_awake.nodes_visited, all_awake.nodes_visited) << to_string(kind);
    EXPECT_LT(5 * one_awake.pair_tests, all_awake.pair_tests) << to_string(kind);
    EXPECT_EQ(phase.pairs(), true_pairs(proxies)) << to_string(kind);

    AwakeNodes awake;
    const StructureView<2> tree = phase.dynamic();
    awake.find(
        tree.counters().nodes, [&](NodeLook<2> look) { tree.visit(look); },
        [](BodyId id) { return id == 0; });
    phase.dynamic().visit([&](const NodeView<2>& node) {
      const bool has = std::count(node.bodies.begin(), node.bodies.end(), 0u) != 0;
      EXPECT_TRUE(!node.leaf || awake[node.handle] == has) << to_string(kind);
      EXPECT_TRUE(node.parent != kNone || awake[node.handle]) << to_string(kind) << ": the root";
      return true;
    });
  }
}

TEST(BroadPhase, WhatIsAskedAndMovesIsFollowed) {
  BroadPhase<2> phase(grid_config(StructureKind::automatic, 16));
  std::vector<Proxy<2>> proxies = grid(16);
  phase.build(proxies);
  EXPECT_EQ(phase.kind(), StructureKind::wide_bvh);
  for (std::size_t step = 0; step < 9; ++step) {
    Box<2>& box = proxies[7 * step].box;
    box = {box.lo + 0.4, box.hi + 0.4};
    phase.build(proxies);
    EXPECT_EQ(phase.kind(), StructureKind::aabb_tree);
    EXPECT_EQ(phase.counters().dynamic_builds, 2u) << step;
    for (const Proxy<2>& proxy : proxies) {
      const Found found = overlap_query<2>(phase.dynamic(), proxy.box);
      EXPECT_TRUE(std::ranges::binary_search(found.ids, proxy.id)) << proxy.id;
    }
  }
}

TEST(BroadPhase, ASteadyStateAsksForNoMemoryAndReusesNodes) {
  for (const StructureKind kind : kinds<2>()) {
    BroadPhase<2> phase(grid_config(kind, 16));
    auto proxies = grid(16);
    for (Proxy<2>& p : proxies) p.is_static = p.id % 5 == 0;
    std::uint64_t before = 0;
    for (int step = 0; step < 24; ++step) {
      if (step == 4) before = phase.counters().allocations;
      for (Proxy<2>& p : proxies)
        if (!p.is_static) {
          const Vec<2> by(step % 2 == 0 ? 0.05 : -0.05);
          p.box = {p.box.lo + by, p.box.hi + by};
        }
      phase.update(proxies);
    }
    const bool asks = traits_of(kind).is_plain || kind == StructureKind::wide_bvh;
    EXPECT_EQ(phase.counters().allocations == before, !asks) << to_string(kind);
    const bool has_nodes = kind == StructureKind::quadtree || kind == StructureKind::kd_tree;
    EXPECT_TRUE(!has_nodes || phase.counters().nodes_reused > 100) << to_string(kind);
  }
}

TEST(BroadPhase, CallsForMemoryAreNeverForgotten) {
  for (const StructureKind kind : kinds<2>()) {
    BroadPhase<2> phase(grid_config(kind, 16));
    std::uint64_t before = 0, grown = 0;
    for (int side = 1; side <= 16; ++side) {
      auto proxies = grid(side);
      for (Proxy<2>& p : proxies) p.is_static = p.id % 3 == 0;
      phase.update(proxies);
      EXPECT_GE(phase.counters().allocations, before) << to_string(kind) << ", side " << side;
      grown += phase.counters().allocations > before;
      before = phase.counters().allocations;
    }
    EXPECT_GE(grown, 8u) << to_string(kind) << ": 256 bodies were given room for nothing";
  }
}

// The nodes of the dynamic structure of these bodies, or of the static one.
std::vector<std::pair<std::uint32_t, std::vector<BodyId>>> nodes_shown(
    std::vector<Proxy<2>> proxies, bool as_static, const BroadPhaseConfig<2>& config) {
  BroadPhase<2> phase(config);
  for (Proxy<2>& p : proxies) p.is_static = as_static;
  phase.update(proxies);
  std::vector<std::pair<std::uint32_t, std::vector<BodyId>>> nodes;
  const auto look = [&](const NodeView<2>& node) {
    nodes.push_back({node.depth, {node.bodies.begin(), node.bodies.end()}});
    return true;
  };
  (as_static ? phase.fixed() : phase.dynamic()).visit(look);
  return nodes;
}

TEST(BroadPhase, StaticBodiesHaveTheSameTreeAsMovingOnes) {
  for (const StructureKind kind : kinds<2>()) {
    BroadPhaseConfig<2> config = grid_config(kind, 48);
    config.capacity = 1;
    const auto proxies = grid(48);  // of more entries than a tree may have that is made for none
    EXPECT_EQ(nodes_shown(proxies, true, config), nodes_shown(proxies, false, config))
        << to_string(kind);
  }
}

// Of a structure that is fitted to its bodies as well, though it takes none after the others.
TEST(BroadPhase, WhatIsInsertedIsFoundAtOnce) {
  const Box<2> world{Vec<2>(0.0), Vec<2>(64.0)};
  for (const StructureKind kind : kinds<2>()) {
    Random random(21);
    BroadPhaseConfig<2> config = config_of<2>(kind, Sort::uniform, random);
    config.split_static = false;
    BroadPhase<2> phase(config);
    std::vector<Proxy<2>> proxies;
    for (BodyId id = 0; id < 40; ++id)
      proxies.push_back({id, testing::random_box<2>(Sort::uniform, random)});
    const std::span<const Proxy<2>> all(proxies);
    std::size_t inserted = 0;
    for (const std::size_t more : {1u, 24u, 15u}) {
      phase.insert(all.subspan(inserted, more));
      inserted += more;
      std::vector<BodyId> ids(inserted);
      std::iota(ids.begin(), ids.end(), BodyId{0});
      const auto box_of = [&](BodyId id) { return proxies[id].box; };
      EXPECT_EQ(overlap_query<2>(phase.dynamic(), world, box_of).ids, ids) << to_string(kind);
    }
  }
}

TEST(BroadPhase, WhatIsInsertedIsPaired) {
  for (const BodyId gap : {1u, 3u}) {
    Random random(22);
    BroadPhaseConfig<2> config;
    config.kind = StructureKind::aabb_tree;
    BroadPhase<2> phase(config);
    std::vector<Proxy<2>> proxies;
    for (BodyId i = 0; i < 40; ++i) {
      proxies.push_back(
          {gap * i, testing::random_box<2>(Sort::uniform, random), i % 3 == 2, i % 4 != 3});
      phase.insert(std::span(proxies).last(1));
      phase.update(proxies);
      EXPECT_EQ(phase.pairs(), true_pairs(proxies));
      EXPECT_EQ(phase.counters().static_builds, i < 2 ? 0u : 1u) << "no body was taken anew";
    }
  }
}

TEST(BroadPhase, ATreeThatHadToBeShallowerIsDeepAgainWhenThereIsRoom) {
  BroadPhaseConfig<2> config;
  config.bounds = {Vec<2>(0.0), Vec<2>(64.0)};
  config.capacity = 1;
  config.max_depth = 8;
  config.no_progress_stop = false;
  const auto deepest_of = [](const BroadPhase<2>& phase) {
    std::uint32_t deepest = 0;
    phase.dynamic().visit([&](const NodeView<2>& node) {
      deepest = std::max(deepest, node.depth);
      return true;
    });
    return deepest;
  };
  BroadPhase<2> phase(config);
  std::vector<Proxy<2>> proxies;
  for (BodyId id = 0; id < 4; ++id) proxies.push_back({id, Box<2>{Vec<2>(0.0), Vec<2>(64.0)}});
  phase.update(proxies);
  EXPECT_EQ(deepest_of(phase), 4u) << "4 * 4^8 entries were too many: half of the depth";
  proxies.clear();
  for (BodyId id = 0; id < 9; ++id) proxies.push_back({id, Box<2>{Vec<2>(0.1), Vec<2>(0.2)}});
  phase.update(proxies);
  EXPECT_EQ(deepest_of(phase), 8u) << "a tree for more bodies begins with all of its depth";
}

TEST(BroadPhase, BodiesOutsideTheBoundsAndFarAwayKeepTheirPairs) {
  for (const StructureKind kind : kinds<3>()) {
    BroadPhaseConfig<3> config;
    config.kind = kind;
    config.bounds = {Vec<3>(0.0), Vec<3>(1.0)};
    config.capacity = 1;
    BroadPhase<3> phase(config);
    const auto at = [](BodyId id, double x) {
      return Proxy<3>{id, Box<3>::around(Vec<3>(x, -x, x), Vec<3>(1.0))};
    };
    phase.update(std::vector{at(0, 1e9), at(1, 1e9 + 2), at(2, -1e9), at(3, 1e9 + 4.5), at(4, 0)});
    EXPECT_EQ(phase.pairs(), (std::vector<Pair>{{0, 1}})) << to_string(kind);
  }
}

TEST(BroadPhase, AFlatQuadtreeLooksAtXAndZOnly) {
  BroadPhaseConfig<3> config;
  config.kind = StructureKind::quadtree;
  config.bounds = {Vec<3>(0.0), Vec<3>(64.0)};
  config.capacity = 2;
  BroadPhase<3> phase(config);
  const auto at = [](BodyId id, double x, double y, double z) {
    return Proxy<3>{id, Box<3>::around(Vec<3>(x, y, z), Vec<3>(1.0))};
  };
  phase.update(
      std::vector{at(0, 10, 5, 10), at(1, 10, 60, 10), at(2, 50, 5, 10), at(3, 10, 5, 50)});
  std::vector<std::vector<BodyId>> leaves;
  phase.dynamic().visit([&](const NodeView<3>& node) {
    EXPECT_EQ(node.box.lo.y, 0) << "nodes reach from bottom to top";
    EXPECT_EQ(node.box.hi.y, 64);
    if (node.leaf) leaves.emplace_back(node.bodies.begin(), node.bodies.end());
    return true;
  });
  EXPECT_EQ(leaves, (std::vector<std::vector<BodyId>>{{3}, {0, 1}, {2}}))
      << "those above each other share a leaf, z parts the upper from the lower";
  EXPECT_TRUE(phase.pairs().empty()) << "they share a leaf, but do not overlap";
}

TEST(BroadPhase, AnyNumberOfThreadsFindsTheSamePairs) {
  Random random(8);
  std::vector<Proxy<2>> proxies;  // so crowded that it is worth a thread
  for (BodyId id = 0; id < 2000; ++id)
    proxies.push_back({3 * id, Box<2>::around(random_point<2>(random, 20, 44), Vec<2>(4.0))});
  const std::vector<Pair> truth = true_pairs(proxies);
  EXPECT_GT(truth.size(), 300'000u);
  for (const StructureKind kind : {StructureKind::sort_and_sweep, StructureKind::quadtree})
    for (const unsigned threads : {1u, 2u, 3u, 7u}) {
      BroadPhaseConfig<2> config;
      config.kind = kind;
      config.threads = threads;
      BroadPhase<2> phase(config);
      phase.update(proxies);
      EXPECT_EQ(phase.pairs() == truth, true) << to_string(kind) << ", threads " << threads;
      config.most_pairs = 290'000;
      EXPECT_THROW(BroadPhase<2>(config).update(proxies), Refused) << "on whichever thread it was";
    }
}

TEST(BroadPhase, AHundredThousandAtOnePointAreNoHangWhileTheySleep) {
  for (const StructureKind kind : kinds<3>()) {
    BroadPhaseConfig<3> config;
    config.kind = kind;
    BroadPhase<3> phase(config);
    std::vector<Proxy<3>> proxies(100'000, Proxy<3>{0, {Vec<3>(-1.0), Vec<3>(1.0)}, false, false});
    for (BodyId id = 0; id < proxies.size(); ++id) proxies[id].id = id;
    proxies[77].awake = true;
    phase.update(proxies);
    EXPECT_EQ(phase.pairs().size(), 99'999u) << to_string(kind);
    // The lecture's tree splits them in vain; each of four leaves then holds them all.
    const std::uint64_t leaves = traits_of(kind).is_plain ? 4 : 1;
    EXPECT_EQ(phase.counters().pair_tests, leaves * 99'999) << to_string(kind);
  }
}

TEST(BroadPhase, ManyBodiesLargerThanAllCellsMakeTheTreeShallowerAndNothingWorse) {
  Random random(5);
  BroadPhaseConfig<2> config;
  config.bounds = {Vec<2>(0.0), Vec<2>(64.0)};
  config.capacity = 1;
  config.max_depth = 10;
  config.no_progress_stop = false;
  std::vector<Proxy<2>> proxies;
  for (BodyId id = 0; id < 300; ++id)
    proxies.push_back({id, Box<2>::around(random_point<2>(random, 0, 64), Vec<2>(60.0))});
  BroadPhase<2> phase(config);
  phase.update(proxies);
  EXPECT_EQ(phase.pairs(), true_pairs(proxies));
  std::uint64_t entries = 0;
  phase.dynamic().visit(
      [&](const NodeView<2>& node) { return entries += node.bodies.size(), true; });
  EXPECT_LE(entries, 4096u + 64u * 512u) << "the tree grew out of proportion";
}

TEST(BroadPhase, AsManyPairsAsAreAllowedAreFound) {
  for (const StructureKind kind : kinds<2>())
    for (const std::uint32_t bodies : {9u, 33u, 65u, 100u, 129u, 257u}) {
      BroadPhaseConfig<2> config;
      config.kind = kind;
      config.most_pairs = bodies * (bodies - 1) / 2;
      std::vector<Proxy<2>> proxies;
      for (BodyId id = 0; id < bodies; ++id) proxies.push_back({id, {{1, 1}, {2, 2}}});
      BroadPhase<2> phase(config);
      phase.update(proxies);
      EXPECT_EQ(phase.pairs().size(), config.most_pairs) << to_string(kind);
      --config.most_pairs;
      EXPECT_THROW(BroadPhase<2>(config).update(proxies), Refused) << to_string(kind);
    }
}

}  // namespace
}  // namespace lantern::spatial
