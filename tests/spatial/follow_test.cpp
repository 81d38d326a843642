// A broad phase that is told of what moves alone finds the pairs that one finds that is told of
// all.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/planes.hpp"

namespace lantern::spatial {
namespace {

// Bodies that move, fall asleep and wake; few or many of them at a time.
template <int D>
class Crowd {
 public:
  Crowd(std::size_t bodies, std::uint64_t seed) : random_(seed) {
    for (BodyId id = 0; id < bodies; ++id)
      all.push_back({seed % 4 < 2 ? 3 * id + 1 : id,
                     testing::random_box<D>(testing::Sort::uniform, random_), id % 5 == 0,
                     id % 3 == 0});
  }
  // All that stir are told of, and all that have changed.
  std::vector<Proxy<D>> moved(double most_awake) {
    std::vector<Proxy<D>> told;
    for (Proxy<D>& body : all) {
      const bool stirred = body.awake && !body.is_static;
      if (random_.between(0, 1) < 0.1) body.awake = random_.between(0, 1) < most_awake;
      if (body.is_static || !(stirred || body.awake)) continue;
      if (body.awake || random_.between(0, 1) < 0.5) {
        const Vec<D> way(random_.between(-1, 1));
        body.box = {body.box.lo + way, body.box.hi + way};
      }
      told.push_back(body);
    }
    return told;
  }
  std::vector<Proxy<D>> all;

 private:
  Random random_;
};

template <int D>
void expect_pairs_followed(StructureKind kind, bool split_static, std::uint64_t seed) {
  SCOPED_TRACE(fmt::format("{} in {}D, seed {}", to_string(kind), D, seed));
  Random random(seed);
  BroadPhaseConfig<D> config, simple;
  config.kind = kind;
  config.split_static = split_static;
  config.bounds = testing::bounds_of<D>(testing::Sort::uniform);
  config.planes = testing::random_planes<D>(testing::Sort::uniform, 9, random);
  simple.kind = StructureKind::brute_force;
  BroadPhase<D> told_of_few(config), told_of_all(simple);
  Crowd<D> crowd(seed % 2 == 0 ? 300 : 40, seed);
  told_of_few.tell(crowd.all);
  std::uint64_t found = 0, builds = 0;
  for (int step = 0; step < 60; ++step) {
    const double most_awake = step < 20 ? 0.02 : step < 40 ? 0.6 : 0;
    told_of_few.follow(crowd.moved(step == 0 ? 1 : most_awake));
    told_of_all.update(crowd.all);
    ASSERT_EQ(told_of_few.pairs(), told_of_all.pairs()) << "step " << step;
    found += told_of_few.pairs().size();
    if (step % 13 == 12) {  // somebody looks
      told_of_few.build(crowd.all);
      for (const Proxy<D>& body : crowd.all) EXPECT_EQ(told_of_few.box_of(body.id), body.box);
      builds = told_of_few.counters().dynamic_builds;
    }
  }
  EXPECT_GT(found, 0u);
  EXPECT_GT(builds, 0u);
}

template <int D>
void expect_pairs_followed() {
  std::uint64_t seed = 0;
  for (const StructureKind kind : kStructureKinds)
    if (is_possible(kind, D))
      for (const bool split_static : {true, false})
        for (int i = 0; i < 2; ++i) expect_pairs_followed<D>(kind, split_static, ++seed);
}

TEST(Follow, FindsThePairsOfAnUpdate2D) { expect_pairs_followed<2>(); }
TEST(Follow, FindsThePairsOfAnUpdate3D) { expect_pairs_followed<3>(); }

// Of ten thousand that rest nobody is asked anything, wherever they lie.
TEST(Follow, AsksNobodyWhoRestsElsewhere) {
  for (const StructureKind kind :
       {StructureKind::quadtree, StructureKind::grid, StructureKind::kd_tree}) {
    BroadPhaseConfig<2> config;
    config.kind = kind;
    BroadPhase<2> phase(config);
    std::vector<Proxy<2>> all;
    for (BodyId id = 0; id < 10'000; ++id) {
      const Vec<2> at(id % 100 * 2.0, id / 100 * 2.0);
      all.push_back({id, {at, at + 1.0}, false, id == 0});
    }
    phase.tell(all);
    for (int step = 0; step < 5; ++step) {
      all[0].box = {all[0].box.lo - 1.0, all[0].box.hi - 1.0};
      phase.follow(std::span(all).first(1));
      EXPECT_TRUE(phase.pairs().empty());
      EXPECT_EQ(phase.counters().pair_tests, 0u) << to_string(kind);
    }
    EXPECT_EQ(phase.counters().dynamic_builds, 0u) << "nobody has looked";
  }
}

}  // namespace
}  // namespace lantern::spatial
