// What kinds of structures are said to do for the same bodies.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/pairs.hpp"

namespace lantern::spatial {
namespace {

constexpr std::uint64_t kMost = 100'000;

template <int D>
std::vector<Proxy<D>> town(Random& random, std::uint32_t bodies, std::uint32_t movers) {
  std::vector<Proxy<D>> all;
  for (BodyId id = 0; id < bodies; ++id) {
    Vec<D> at;
    for (int i = 0; i < D; ++i) at[i] = random.between(16, 48);
    all.push_back({id, Box<D>::around(at, Vec<D>(random.between(1, 4))), id >= movers, true});
  }
  return all;
}

template <int D>
void expect_same_pairs() {
  Random random(D);
  BroadPhaseConfig<D> config;
  config.bounds = {Vec<D>(0.0), Vec<D>(64.0)};
  for (const std::uint32_t movers : {120u, 20u}) {
    const std::vector<Proxy<D>> before = town<D>(random, 120, movers);
    std::vector<Proxy<D>> after = before;
    for (Proxy<D>& body : after)
      if (!body.is_static) body.box = {body.box.lo + 0.25, body.box.hi + 0.25};
    config.kind = StructureKind::brute_force;
    const StructureWork all = structure_work<D>(config, before, after, kMost);
    EXPECT_EQ(all.step(), testable_pairs(120, 120 - movers)) << "each with each, and nothing else";
    EXPECT_EQ(all.build, 0u);
    EXPECT_GT(all.overlaps, 0u);
    for (const StructureKind kind : kStructureKinds) {
      if (!is_possible(kind, D) || !counts_its_work(kind)) continue;
      config.kind = kind;
      const StructureWork work = structure_work<D>(config, before, after, kMost);
      EXPECT_EQ(work.overlaps, all.overlaps) << to_string(kind);
      EXPECT_LE(work.pairs, all.pairs) << to_string(kind);
      EXPECT_GE(work.pair, work.pairs) << to_string(kind) << ": each was compared";
      EXPECT_EQ(work.build > 0, kind != StructureKind::brute_force) << to_string(kind);
    }
  }
}

TEST(StructureWork, IsOfTheSamePairsForEveryKind) {
  expect_same_pairs<2>();
  expect_same_pairs<3>();
}

TEST(StructureWork, OfWhatNeverMovesIsDoneOnce) {
  Random random(7);
  BroadPhaseConfig<2> config;
  config.bounds = {Vec<2>(0.0), Vec<2>(64.0)};
  config.kind = StructureKind::quadtree;
  const std::vector<Proxy<2>> still = town<2>(random, 50, 0);
  const StructureWork work = structure_work<2>(config, still, still, kMost);
  EXPECT_GT(work.build, 50u);
  EXPECT_EQ(work.step(), 0u);
}

// The lecture, "Choosing a structure": to choose a BSP's planes is not fast, so it is for what
// never moves. A plane for each face of each box is held against each box: n² at the root alone.
TEST(StructureWork, ChoosesABspsPlanesAnewUnlessSomeBodiesNeverMove) {
  const auto work = [](std::uint32_t movers) {
    Random random(11);
    BroadPhaseConfig<2> config;
    config.bounds = {Vec<2>(0.0), Vec<2>(64.0)};
    config.kind = StructureKind::bsp;
    const std::vector<Proxy<2>> before = town<2>(random, 100, movers);
    std::vector<Proxy<2>> after = before;
    for (Proxy<2>& body : after)
      if (!body.is_static) body.box = {body.box.lo + 0.25, body.box.hi + 0.25};
    return structure_work<2>(config, before, after, kMost);
  };
  const StructureWork all_move = work(100), few_move = work(20);
  EXPECT_GE(all_move.build, 2u * 100 * 100);
  EXPECT_GE(all_move.renew, 2u * 100 * 100);
  EXPECT_GE(few_move.build, 2u * 80 * 80);
  EXPECT_LT(few_move.renew, 20u * 100) << "its planes stand";
  EXPECT_LT(few_move.pairs, testable_pairs(100, 80)) << "they part the bodies";
}

TEST(StructureWork, OfAGridIsACellABody) {
  Random random(8);
  BroadPhaseConfig<2> config;
  config.bounds = {Vec<2>(0.0), Vec<2>(64.0)};
  config.kind = StructureKind::grid;
  const std::vector<Proxy<2>> before = town<2>(random, 50, 50);
  std::vector<Proxy<2>> after = before;
  after[0].box = {after[0].box.lo + 1.0, after[0].box.hi + 1.0};
  const StructureWork work = structure_work<2>(config, before, after, kMost);
  EXPECT_EQ(work.build, 50u);
  EXPECT_EQ(work.renew, 50u);
}

TEST(StructureWork, IsNotKnownOfTheLecturesOwnCode) {
  EXPECT_FALSE(counts_its_work(StructureKind::lecture_quadtree));
  EXPECT_FALSE(counts_its_work(StructureKind::automatic));
  EXPECT_TRUE(counts_its_work(StructureKind::aabb_tree));
}

TEST(StructureWork, BuildsWhatMovesAndWhatNeverMovesApart) {
  Random random(9);
  BroadPhaseConfig<2> config;
  config.bounds = {Vec<2>(0.0), Vec<2>(64.0)};
  config.kind = StructureKind::quadtree;
  const std::vector<Proxy<2>> all = town<2>(random, 80, 30);
  const std::vector<Proxy<2>> movers(all.begin(), all.begin() + 30),
      still(all.begin() + 30, all.end());
  const auto build = [&](const std::vector<Proxy<2>>& bodies) {
    return structure_work<2>(config, bodies, bodies, kMost).build;
  };
  EXPECT_GT(build(all), build(movers));
  EXPECT_EQ(build(all), build(movers) + build(still));
}

}  // namespace
}  // namespace lantern::spatial
