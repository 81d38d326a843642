// No memory is asked for in the steady state: counted where memory is really asked for.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "counted_memory.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/planes.hpp"

namespace lantern::spatial {
namespace {

TEST(SteadyState, AnUpdateAsksForNoMemory) {
  Random random(9);
  for (std::size_t run = 0; run < 2 * kStructureKinds.size(); ++run) {
    const StructureKind kind = kStructureKinds[run / 2];
    BroadPhaseConfig<3> config;
    config.kind = kind;
    config.build = run % 2 == 0 ? Build::one_by_one : Build::at_once;
    config.bounds = testing::bounds_of<3>(testing::Sort::uniform);
    config.planes = testing::random_planes<3>(testing::Sort::uniform, 9, random);
    BroadPhase<3> phase(config);
    std::vector<Proxy<3>> proxies;
    for (BodyId id = 0; id < 300; ++id)
      proxies.push_back(
          {id, testing::random_box<3>(testing::Sort::uniform, random), id % 4 == 0, id % 7 != 0});
    const auto shake = [&](double by) {
      for (Proxy<3>& p : proxies)
        if (!p.is_static && p.awake) p.box = {p.box.lo + by, p.box.hi + by};
      phase.update(proxies);
    };
    for (const double by : {0.1, -0.1, 0.1, -0.1}) shake(by);
    const std::uint64_t before = counted_memory::calls, counted = phase.counters().allocations;
    EXPECT_GT(counted, 0u);
    for (int step = 0; step < 10; ++step) shake(step % 2 == 0 ? 0.1 : -0.1);
    const std::uint64_t asked = counted_memory::calls - before;
    EXPECT_EQ(asked == 0, !traits_of(kind).is_plain) << to_string(kind) << " asked for memory";
    EXPECT_EQ(phase.counters().allocations - counted, asked) << to_string(kind) << ": wrong count";
  }
}

constexpr std::size_t kBodies = 4096;

double held() { return static_cast<double>(counted_memory::held_bytes) / kBodies; }

// As close to each other however many there are.
template <int D>
std::vector<Proxy<D>> crowd() {
  Random random(5);
  const double side = 2 * std::pow(static_cast<double>(kBodies), 1.0 / D);
  std::vector<Proxy<D>> proxies;
  for (BodyId id = 0; id < kBodies; ++id)
    proxies.push_back({id, Box<D>::around(random_point<D>(random, 0, side),
                                          random_point<D>(random, 0.25, 0.75))});
  return proxies;
}

// Bytes a body that a broad phase holds beside the structure and the boxes.
template <int D>
double beside_boxes(const std::vector<Proxy<D>>& proxies) {
  std::vector<Box<D>> boxes;
  for (const Proxy<D>& proxy : proxies) boxes.push_back(proxy.box);
  const double before = held();
  const auto tree = make_structure<D>(StructureKind::aabb_tree);
  tree->build(boxes, Build::at_once);
  const double of_tree = held() - before;
  BroadPhaseConfig<D> config;
  config.kind = StructureKind::aabb_tree;
  config.build = Build::at_once;
  BroadPhase<D> phase(config);
  phase.build(proxies);
  return held() - before - 2 * of_tree - sizeof(Box<D>);
}

template <int D>
void expect_lean() {
  std::vector<Proxy<D>> proxies = crowd<D>();
  constexpr double kFixed = 1;  // what any broad phase takes, shared out
  EXPECT_LT(beside_boxes<D>(proxies), kFixed);
  proxies[7].awake = false;
  EXPECT_LT(beside_boxes<D>(proxies), kFixed + sizeof(ProxyState));
  for (Proxy<D>& proxy : proxies) proxy.id *= 3;
  EXPECT_LT(beside_boxes<D>(proxies), kFixed + sizeof(ProxyState) + sizeof(BodyId));
}

TEST(SteadyState, ABroadPhaseHoldsOfABodyItsBox) {
  expect_lean<2>();
  expect_lean<3>();
}

template <int D>
void expect_no_more_when_all_move() {
  std::vector<Proxy<D>> proxies = crowd<D>();
  BroadPhaseConfig<D> config;
  config.kind = StructureKind::grid;
  BroadPhase<D> phase(config);
  phase.update(proxies);
  const double before = held();
  for (Proxy<D>& proxy : proxies) proxy.box = {proxy.box.lo + 0.1, proxy.box.hi + 0.1};
  phase.update(proxies);
  EXPECT_LT(held() - before, 0.1);
}

TEST(SteadyState, AnUpdateHoldsNoMoreOfWhatMoves) {
  expect_no_more_when_all_move<2>();
  expect_no_more_when_all_move<3>();
}

}  // namespace
}  // namespace lantern::spatial
