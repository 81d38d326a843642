#include <gtest/gtest.h>

#include "base/random.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

template <int D>
std::vector<Item<D>> spread(BodyId bodies, double width, Random& random) {
  std::vector<Item<D>> items;
  for (BodyId id = 0; id < bodies; ++id)
    items.push_back({id, Box<D>::around(random_point<D>(random, 0, width), Vec<D>(0.5))});
  return items;
}

TEST(StructureChoice, ComparesAllOfAFewAndOfACrowdAndPartsTheRest) {
  Random random(4);
  const StructureConfig<2> config;
  EXPECT_EQ(choose_structure<2>({}, config).kind, StructureKind::brute_force);
  EXPECT_EQ(choose_structure<2>(spread<2>(1, 9, random), config).kind, StructureKind::brute_force);
  EXPECT_EQ(choose_structure<2>(spread<2>(200, 19, random), config).kind,
            StructureKind::brute_force);
  const auto crowd = choose_structure<2>(spread<2>(3000, 0.5, random), config);
  EXPECT_EQ(crowd.kind, StructureKind::brute_force);
  EXPECT_NE(crowd.why.find("sampled pairs 100% overlap"), std::string::npos) << crowd.why;
  std::vector<Item<2>> on_ground = spread<2>(3000, 100, random);
  on_ground.push_back({3000, {Vec<2>(-1e150), Vec<2>(1e150, 0.0)}});
  const auto grounded = choose_structure<2>(on_ground, config);
  EXPECT_NE(grounded.why.find("largest 1 times"), std::string::npos) << grounded.why;
  EXPECT_LT(grounded.config.bounds.size().x, 200);
  on_ground.push_back({3001, {Vec<2>(50.0), Vec<2>(60.0)}});
  const auto with_large = choose_structure<2>(on_ground, config);
  EXPECT_NE(with_large.why.find("largest 10 times"), std::string::npos) << with_large.why;
  const auto many = choose_structure<2>(spread<2>(3000, 100, random), config);
  EXPECT_EQ(many.kind, StructureKind::grid);
  EXPECT_NE(many.why.find("3000 bodies"), std::string::npos) << many.why;
}

TEST(StructureChoice, FollowsBodiesThatComeAndGoAndGather) {
  Random random(5);
  BroadPhaseConfig<2> config;
  config.kind = StructureKind::automatic;
  BroadPhase<2> phase(config);
  EXPECT_EQ(phase.kind(), StructureKind::automatic);
  const auto update = [&](BodyId bodies, double width) {
    std::vector<Proxy<2>> proxies;
    for (const Item<2>& item : spread<2>(bodies, width, random))
      proxies.push_back({item.id, item.box, item.id % 5 == 0});
    phase.update(proxies);
    std::vector<Pair> truth;
    for (std::size_t i = 0; i < proxies.size(); ++i)
      for (std::size_t j = i + 1; j < proxies.size(); ++j)
        if (!(proxies[i].is_static && proxies[j].is_static) &&
            overlap(proxies[i].box, proxies[j].box))
          truth.push_back({proxies[i].id, proxies[j].id});
    EXPECT_EQ(phase.pairs(), truth) << bodies << " bodies in " << width;
    return phase.kind();
  };
  EXPECT_EQ(update(20, 10), StructureKind::brute_force);
  EXPECT_EQ(update(30, 10), StructureKind::brute_force);
  EXPECT_EQ(update(900, 60), StructureKind::grid);
  EXPECT_EQ(update(1000, 60), StructureKind::grid);
  update(1000, 0.6);  // they are compared far more often: the next time it is chosen again
  EXPECT_EQ(update(1000, 0.6), StructureKind::brute_force);
  EXPECT_EQ(update(20, 10), StructureKind::brute_force);
}

TEST(StructureChoice, FindsThePairsOfAnyWorld) {
  Random random(6);
  for (const testing::Sort sort : testing::kSorts)
    for (const std::size_t bodies : {3u, 120u, 500u}) {
      BroadPhaseConfig<3> config;
      config.kind = StructureKind::automatic;
      config.build = Build::at_once;
      BroadPhase<3> phase(config);
      std::vector<Proxy<3>> proxies;
      std::vector<Item<3>> items = testing::random_world<3>(sort, bodies, random);
      for (const Item<3>& item : items) proxies.push_back({item.id, item.box});
      phase.update(proxies);
      EXPECT_EQ(phase.pairs(), testing::true_overlaps(items)) << "sort " << static_cast<int>(sort);
    }
}

}  // namespace
}  // namespace lantern::spatial
