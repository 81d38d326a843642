#include "spatial/trees/bsp.hpp"

#include <limits>
#include <map>

#include <gtest/gtest.h>

#include "spatial/pairs.hpp"
#include "spatial/picture.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::Sort;

// Planes of all directions in random places of a growing tree.
template <int D>
std::vector<BspPlane<D>> random_planes(std::size_t count, const Box<D>& bounds, Random& random) {
  std::vector<BspPlane<D>> planes;
  std::vector<std::pair<std::uint32_t, bool>> places = {{kNone, false}};
  while (planes.size() < count) {
    const auto pick =
        static_cast<std::size_t>(random.whole(0, static_cast<std::int64_t>(places.size()) - 1));
    const auto [parent, front] = places[pick];
    places.erase(places.begin() + static_cast<std::ptrdiff_t>(pick));
    Vec<D> normal = random_point<D>(random, -3, 3);
    if (random.bits() % 3 == 0) {
      normal = Vec<D>(0.0);
      normal[static_cast<int>(random.whole(0, D - 1))] = random.bits() % 2 == 0 ? 1.0 : -2.0;
    }
    Vec<D> point;
    for (int i = 0; i < D; ++i) point[i] = random.between(bounds.lo[i], bounds.hi[i]);
    const auto index = static_cast<std::uint32_t>(planes.size());
    planes.push_back({Plane<D>::through(point, normal), parent, front});
    places.emplace_back(index, false);
    places.emplace_back(index, true);
  }
  return planes;
}

template <int D>
void expect_sound(Sort sort, std::uint64_t seed) {
  SCOPED_TRACE(fmt::format("{}D, sort {}, seed {}", D, static_cast<int>(sort), seed));
  Random random(seed);
  const Box<D> bounds = testing::bounds_of<D>(sort);
  const auto planes =
      random_planes<D>(static_cast<std::size_t>(random.whole(0, 12)), bounds, random);
  auto items = testing::random_world<D>(sort, 25, random);
  Bsp<D> bsp(testing::bsp_config<D>(planes, bounds));
  for (const auto& item : items) bsp.insert(item);
  EXPECT_EQ(bsp.counters().nodes, 2 * planes.size() + 1) << "all leaves exist always";

  const auto overlaps = testing::true_overlaps(items);
  const auto candidates = candidate_pairs(bsp, 1'000'000).pairs;
  EXPECT_TRUE(std::includes(candidates.begin(), candidates.end(), overlaps.begin(), overlaps.end()))
      << "an overlapping pair was parted";

  const auto picture = testing::picture_of<D>(bsp);
  const auto allocations = bsp.counters().allocations;
  for (const bool shuffled : {false, true}) {
    if (shuffled) testing::shuffle(items, random);
    bsp.clear();
    EXPECT_EQ(bsp.counters().entries, 0u);
    for (const auto& item : items) bsp.insert(item);
    EXPECT_EQ(testing::picture_of<D>(bsp), picture) << "the order of insertion shows";
    if (!shuffled) {
      EXPECT_EQ(bsp.counters().allocations, allocations) << "memory was asked for again";
    }
  }

  // Asking with a body's own box finds at least whoever overlaps it.
  const std::set<BodyId> near = testing::near_in(bsp, items[0].box);
  for (const auto& item : items)
    EXPECT_TRUE(!overlap(item.box, items[0].box) || near.contains(item.id));
}

TEST(Bsp, NeverPartsAnOverlappingPair) {
  for (const Sort sort : testing::kSorts)
    for (std::uint64_t seed = 0; seed < 25; ++seed) {
      expect_sound<2>(sort, seed);
      expect_sound<3>(sort, seed);
    }
}

TEST(Bsp, TheSizeOfANormalDoesNotMatter) {
  // Products with the largest normal overflow; nothing may vanish because of it.
  const double huge = std::numeric_limits<double>::max();
  for (const double size : {1e-300, 1.0, huge}) {
    Bsp<2> bsp(
        testing::bsp_config<2>({{{{size, -size}, 0}, kNone, false}}, {{-64, -64}, {64, 64}}));
    bsp.insert({0, {{10, -10}, {20, -5}}});           // x > y
    bsp.insert({1, {{-20, 10}, {-10, 20}}});          // x < y
    bsp.insert({2, {{-huge, -huge}, {huge, huge}}});  // everywhere
    bsp.insert({3, {{10, 10}, {20, 15}}});            // across, its products of both signs
    bsp.insert({4, {{10, 1}, {20, 5}}});              // x > y
    std::map<std::uint32_t, std::vector<BodyId>> leaves;
    bsp.visit([&](const NodeView<2>& view) {
      if (view.leaf) leaves[view.slot].assign(view.bodies.begin(), view.bodies.end());
      return true;
    });
    EXPECT_EQ(leaves[0], (std::vector<BodyId>{1, 2, 3})) << "behind, normal of size " << size;
    EXPECT_EQ(leaves[1], (std::vector<BodyId>{0, 2, 3, 4})) << "in front, normal of size " << size;
  }
}

TEST(Bsp, ShowsPlanesAndBehindBeforeFront) {
  const Plane<2> net{{1, 0}, 32}, wall{{0, 2}, 20};
  const Box<2> world{{0, 0}, {64, 36}};
  Bsp<2> bsp(testing::bsp_config<2>({{net, kNone, false}, {wall, 0, true}}, world));
  std::vector<std::string> seen;
  bsp.visit([&](const NodeView<2>& view) {
    EXPECT_EQ(view.box, world);
    EXPECT_EQ(view.plane != nullptr, !view.leaf);
    if (view.plane) {
      EXPECT_EQ(view.plane->normal, view.depth == 0 ? net.normal : wall.normal);
    }
    seen.push_back(fmt::format("{}:{}:{}", view.depth, view.slot, view.leaf));
    return true;
  });
  EXPECT_EQ(seen, (std::vector<std::string>{"0:0:false", "1:0:true", "1:1:false", "2:0:true",
                                            "2:1:true"}));
}

TEST(Bsp, TellsTestsMissesAndStores) {
  Bsp<2> bsp(testing::bsp_config<2>({{{{1, 0}, 32}, kNone, false}}, {{0, 0}, {64, 36}}));
  std::vector<std::pair<Event::Kind, NodeHandle>> told;
  bsp.insert({9, {{40, 1}, {41, 2}}}, [&](const Event& e) {
    EXPECT_EQ(e.body, 9u);
    told.emplace_back(e.kind, e.node);
    EXPECT_EQ(e.count, e.kind == Event::Kind::store ? 1u : 0u);
  });
  using Kind = Event::Kind;
  EXPECT_EQ(told, (std::vector<std::pair<Kind, NodeHandle>>{
                      {Kind::test, 0}, {Kind::miss, 1}, {Kind::test, 2}, {Kind::store, 2}}));
  EXPECT_EQ(bsp.counters().box_tests, 1u);
}

TEST(Bsp, WithoutPlanesItIsOneLeaf) {
  Bsp<3> bsp(testing::bsp_config<3>({}, {Vec<3>(0.0), Vec<3>(1.0)}));
  bsp.insert({1, {Vec<3>(0.0), Vec<3>(0.0)}});
  bsp.insert({2, {Vec<3>(9.0), Vec<3>(9.0)}});
  EXPECT_EQ(bsp.counters().nodes, 1u);
  EXPECT_EQ(candidate_pairs(bsp, 10).pairs.size(), 1u);
}

TEST(Bsp, RefusesListsThatAreNoTree) {
  const Box<2> world{{0, 0}, {64, 36}};
  const Plane<2> plane{{1, 0}, 32};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = [&](std::vector<BspPlane<2>> planes, const char* why) {
    EXPECT_THROW(Bsp<2>(testing::bsp_config<2>(std::move(planes), world)), Refused) << why;
  };
  refuses({{plane, 0, false}}, "the first must be the root");
  refuses({{plane, kNone, false}, {plane, kNone, false}}, "two roots");
  refuses({{plane, kNone, false}, {plane, 1, false}}, "its own parent");
  refuses({{plane, kNone, false}, {plane, 2, false}, {plane, 0, false}}, "child before parent");
  refuses({{plane, kNone, false}, {plane, 0, true}, {plane, 0, true}}, "a place taken twice");
  refuses({{{{0, 0}, 1}, kNone, false}}, "no direction");
  refuses({{{{nan, 1}, 1}, kNone, false}}, "no number");
  refuses({{{{1, 1}, nan}, kNone, false}}, "no number");
  EXPECT_THROW(Bsp<2>(testing::bsp_config<2>({}, {{0, 0}, {nan, 1}})), Refused);

  std::vector<BspPlane<2>> chain = {{plane, kNone, false}};
  for (std::uint32_t i = 0; i < kDeepestBsp; ++i) chain.push_back({plane, i, true});
  refuses(chain, "so deep a chain would exhaust the stack");
  chain.pop_back();
  EXPECT_NO_THROW(Bsp<2>(testing::bsp_config<2>(chain, world)).insert({1, {{40, 1}, {41, 2}}}));
}

TEST(Bsp, KeepsItsBudget) {
  Bsp<2> bsp(testing::bsp_config<2>({{{{1, 0}, 32}, kNone, false}}, {{0, 0}, {64, 36}}, 3));
  bsp.insert({0, {{30, 0}, {34, 1}}});
  EXPECT_THROW(bsp.insert({1, {{30, 0}, {34, 1}}}), Refused);
  EXPECT_EQ(bsp.counters().entries, 3u);
  bsp.clear();
  EXPECT_NO_THROW(bsp.insert({1, {{30, 0}, {34, 1}}}));
}

// A leaf's zone is what lies on its sides of the planes above it.
TEST(Bsp, CountsWhatStandsAndWhatWasTested) {
  Random random(12);
  for (int round = 0; round < 20; ++round) {
    const Box<2> bounds = testing::bounds_of<2>(Sort::uniform);
    const auto planes =
        random_planes<2>(static_cast<std::size_t>(random.whole(0, 9)), bounds, random);
    Bsp<2> bsp(testing::bsp_config<2>(planes, bounds));
    for (int again = 0; again < 2; ++again) {
      const auto items = testing::random_world<2>(Sort::uniform, 20, random);
      Counters expected;
      std::vector<std::vector<BodyId>> leaves;
      for (const Item<2>& item : items)
        bsp.insert(item, [&](const Event& event) {
          expected.entries += event.kind == Event::Kind::store;
        });
      bsp.visit([&](const NodeView<2>& node) {
        ++expected.nodes;
        expected.leaves += node.leaf;
        expected.depth = std::max<std::uint64_t>(expected.depth, node.depth);
        EXPECT_EQ(node.leaf, node.plane == nullptr);
        if (node.leaf) leaves.emplace_back(node.bodies.begin(), node.bodies.end());
        return true;
      });
      std::size_t shown = 0;
      for (const auto& leaf : leaves) shown += leaf.size();
      // A body is tested against the plane of each inner node that it reaches.
      std::uint64_t tests = 0;
      Bsp<2> alone(testing::bsp_config<2>(planes, bounds));
      for (const Item<2>& item : items) {
        std::uint64_t reached = 0, stored = 0;
        alone.insert(item, [&](const Event& event) {
          reached += event.kind == Event::Kind::test;
          stored += event.kind == Event::Kind::store;
        });
        tests += reached - stored;
      }
      const Counters c = bsp.counters();
      EXPECT_EQ(c.nodes, expected.nodes);
      EXPECT_EQ(c.nodes, 2 * planes.size() + 1);
      EXPECT_EQ(c.leaves, expected.leaves);
      EXPECT_EQ(c.depth, expected.depth);
      EXPECT_EQ(c.entries, expected.entries);
      EXPECT_EQ(c.entries, shown);
      EXPECT_EQ(c.box_tests, tests);
      bsp.clear();
      EXPECT_EQ(bsp.counters().entries, 0u);
      EXPECT_EQ(bsp.counters().box_tests, 0u);
    }
  }
}

}  // namespace
}  // namespace lantern::spatial
