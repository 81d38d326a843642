#include "spatial/trees/aabb_tree.hpp"

#include <cmath>
#include <limits>
#include <map>

#include <gtest/gtest.h>

#include "spatial/broad_phase.hpp"
#include "spatial/query.hpp"
#include "spatial/trees/brute_force.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::kSorts;
using testing::Sort;

// Numbered from 0, as `update` wants them.
template <int D>
std::vector<Item<D>> numbered_world(Sort sort, std::size_t bodies, Random& random) {
  std::vector<Item<D>> items;
  for (std::size_t i = 0; i < bodies; ++i)
    items.push_back({static_cast<BodyId>(i), testing::random_box<D>(sort, random)});
  return items;
}

template <int D>
bool holds(const Box<D>& outer, const Box<D>& inner) {
  return united(outer, inner) == outer;
}

// Each body in one leaf whose box holds it, each inner node the smallest box around two children,
// handles without gaps.
template <int D>
void expect_sound(const AabbTree<D>& tree, const std::vector<Item<D>>& items) {
  struct Seen {
    Box<D> box, around;
    bool leaf = true;
    int children = 0;
  };
  std::vector<Seen> nodes;
  std::set<BodyId> bodies;
  std::set<NodeHandle> handles;
  std::uint64_t deepest = 0;
  tree.visit([&](const NodeView<D>& view) {
    handles.insert(view.handle);
    deepest = std::max<std::uint64_t>(deepest, view.depth);
    nodes.push_back({view.box, view.box, view.leaf});
    EXPECT_EQ(view.bodies.size(), view.leaf && !items.empty() ? 1u : 0u);
    for (const BodyId id : view.bodies) {
      EXPECT_TRUE(bodies.insert(id).second) << id << " lies in two leaves";
      EXPECT_TRUE(holds(view.box, testing::box_of(items, id)));
    }
    if (view.parent == kNone) return true;
    Seen& parent = nodes[view.parent];
    parent.around = parent.children++ == 0 ? view.box : united(parent.around, view.box);
    return true;
  });
  for (const Seen& node : nodes) {
    EXPECT_EQ(node.children, node.leaf ? 0 : 2);
    EXPECT_EQ(node.around, node.box) << "not the smallest box around its children";
  }
  EXPECT_EQ(bodies.size(), items.size());
  const Counters c = tree.counters();
  EXPECT_EQ(c.nodes, nodes.size());
  EXPECT_EQ(c.nodes, std::max<std::size_t>(2 * items.size(), 2) - 1);
  EXPECT_EQ(handles.size(), nodes.size());
  EXPECT_EQ(*handles.rbegin(), nodes.size() - 1) << "handles have gaps";
  EXPECT_EQ(c.entries, items.size());
  EXPECT_EQ(c.depth, deepest);
  EXPECT_LE(c.depth, AabbTree<D>::kHighest);
}

template <int D>
std::vector<Pair> paired(AabbTree<D>& tree, const std::vector<Item<D>>& exact) {
  FoundPairs found;
  tree.find_pairs(testing::boxes_of(exact), found);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < found.size(); ++i)
    pairs.push_back({std::min(found.first()[i], found.second()[i]),
                     std::max(found.first()[i], found.second()[i])});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// Pairs, boxes, balls and rays, as if each body had been asked.
template <int D>
void expect_finds_all(AabbTree<D>& tree, const std::vector<Item<D>>& items, Sort sort,
                      Random& random) {
  EXPECT_EQ(paired(tree, items), testing::true_overlaps(items));
  std::set<Pair> compared;
  std::uint64_t count = 0;
  tree.compare([](BodyId) { return true; },
               [&](BodyId a, BodyId b) {
                 ++count;
                 compared.insert({std::min(a, b), std::max(a, b)});
               });
  EXPECT_EQ(compared.size(), count) << "a pair was compared twice";
  for (const Pair& pair : testing::true_overlaps(items)) EXPECT_TRUE(compared.contains(pair));
  BruteForce<D> force;
  for (const Item<D>& item : items) force.insert(item);
  const auto box_of = [&](BodyId id) { return items[id].box; };
  const auto point = [&] {
    return testing::bounds_of<D>(sort).lo + random_point<D>(random, -20, 84);
  };
  for (int i = 0; i < 4; ++i) {
    const Box<D> box = testing::random_box<D>(sort, random);
    EXPECT_EQ(overlap_query(tree, box, box_of).ids, overlap_query(force, box, box_of).ids);
    const Ball<D> ball{point(), random.between(0, 20)};
    EXPECT_EQ(overlap_query(tree, ball, box_of).ids, overlap_query(force, ball, box_of).ids);
    Ray<D> ray{point(), random_point<D>(random, -1, 1), random.between(0, 90)};
    if (i % 3 == 0) ray.direction[0] = 0;
    if (i % 4 == 1) ray.length = std::numeric_limits<double>::infinity();
    if (i % 4 == 3) ray.direction[1] = 1e-310;
    if (i == 2) ray.direction = point() - ray.origin;
    if (ray.direction == Vec<D>(0.0)) ray.direction[D - 1] = 1;
    EXPECT_EQ(raycast_all(tree, ray, box_of).hits, raycast_all(force, ray, box_of).hits);
    EXPECT_EQ(raycast_nearest(tree, ray, box_of).hit, raycast_nearest(force, ray, box_of).hit);
  }
}

template <int D>
void built_inserted_and_updated_trees_find_the_same() {
  for (const Sort sort : kSorts)
    for (const double margin : {0.0, sort == Sort::uniform ? 1e4 : 0.3})
      for (const std::size_t bodies : {0, 1, 2, 9, 30}) {
        SCOPED_TRACE(::testing::Message() << D << "D, sort " << static_cast<int>(sort)
                                          << ", margin " << margin << ", " << bodies << " bodies");
        Random random(bodies + static_cast<std::uint64_t>(sort));
        auto items = numbered_world<D>(sort, bodies, random);
        AabbTree<D> built({.margin = margin}), inserted({.margin = margin});
        built.make(items);
        for (const Item<D>& item : items) inserted.insert(item);
        for (int step = 0; step < 3; ++step) {
          for (AabbTree<D>* tree : {&built, &inserted}) {
            expect_sound(*tree, items);
            expect_finds_all(*tree, items, sort, random);
          }
          for (Item<D>& item : items)
            if (step == 1 || random.whole(0, 80) == 0)
              item.box = testing::random_box<D>(sort, random);
          built.update(items);
          inserted.update(items);
        }
      }
}

TEST(AabbTree, ShowsFiniteBoxesAroundBodiesWithoutEnd) {
  AabbTree<2> tree;
  tree.insert({0, {Vec<2>(-1e150), Vec<2>(1e150, 0.0)}});  // the ground
  tree.insert({1, {{3, 1}, {4, 2}}});
  tree.visit([&](const NodeView<2>& node) {
    EXPECT_TRUE(is_valid(node.box)) << "not finite";
    EXPECT_TRUE(!node.leaf || node.bodies[0] == 1 || node.box.lo.x <= -1e150);
    return true;
  });
}

TEST(AabbTree, BuiltInsertedAndUpdatedTreesFindTheSameIn2d) {
  built_inserted_and_updated_trees_find_the_same<2>();
}
TEST(AabbTree, BuiltInsertedAndUpdatedTreesFindTheSameIn3d) {
  built_inserted_and_updated_trees_find_the_same<3>();
}

// One in a hundred leaves its enlarged box at each step: it is taken out and put back.
TEST(AabbTree, FollowsAFewThatLeaveTheirBoxes) {
  Random random(4);
  auto items = numbered_world<2>(Sort::uniform, 150, random);
  AabbTree<2> tree({.margin = 0.5});
  tree.make(items);
  for (int step = 0; step < 10; ++step) {
    for (Item<2>& item : items) {
      const double far = random.whole(0, 99) == 0 ? 20 : 0.01;
      const Vec<2> by = random_point<2>(random, -far, far);
      item.box = {item.box.lo + by, item.box.hi + by};
    }
    tree.update(items);
    expect_sound(tree, items);
    EXPECT_EQ(paired(tree, items), testing::true_overlaps(items)) << "step " << step;
  }
}

TEST(AabbTree, AMoveWithinTheEnlargedBoxChangesNothing) {
  Random random(5);
  auto items = numbered_world<2>(Sort::uniform, 50, random);
  AabbTree<2> tree({.margin = 1});
  tree.make(items);
  const auto boxes = [&] {
    std::vector<Box<2>> all;
    tree.visit([&](const NodeView<2>& view) { return all.push_back(view.box), true; });
    return all;
  };
  const auto before = boxes();
  for (Item<2>& item : items) item.box = {item.box.lo + 0.9, item.box.hi + 0.9};
  tree.update(items);
  EXPECT_EQ(boxes(), before);
  EXPECT_EQ(paired(tree, items), testing::true_overlaps(items));
  for (Item<2>& item : items) item.box = {item.box.lo + 0.9, item.box.hi + 0.9};
  tree.update(items);
  EXPECT_NE(boxes(), before);
}

TEST(AabbTree, DoesNotDependOnTheOrderInWhichItIsBuilt) {
  Random random(6);
  for (const Sort sort : kSorts) {
    auto items = testing::random_world<3>(sort, 90, random);
    AabbTree<3> tree, other;
    tree.make(items);
    testing::shuffle(items, random);
    other.make(items);
    const auto seen = [](const AabbTree<3>& t) {
      std::vector<std::pair<Box<3>, BodyId>> all;
      t.visit([&](const NodeView<3>& v) {
        all.emplace_back(v.box, v.bodies.empty() ? kNone : v.bodies[0]);
        return true;
      });
      return all;
    };
    EXPECT_EQ(seen(tree), seen(other)) << "sort " << static_cast<int>(sort);
  }
}

// Boxes within boxes, each pair of which grows least as a chain; and all the same.
TEST(AabbTree, StaysLow) {
  std::vector<Item<2>> nested, same;
  for (BodyId i = 0; i < 700; ++i) {
    nested.push_back({i, Box<2>::around(Vec<2>(0.0), Vec<2>(1.0 + i))});
    same.push_back({i, Box<2>::around(Vec<2>(5.0), Vec<2>(1.0))});
  }
  for (const auto* items : {&nested, &same}) {
    AabbTree<2> built, inserted;
    built.make(*items);
    for (const Item<2>& item : *items) inserted.insert(item);
    EXPECT_LE(built.counters().depth, 18u);
    expect_sound(inserted, *items);
    EXPECT_LE(inserted.counters().depth, items == &same ? 24u : AabbTree<2>::kHighest);
  }
}

// In a row each cut is in its middle; where distances grow by and by it would be a chain, which is
// followed as far as the height allows.
// Boxes within boxes, each put around all before it: a chain, which is built anew while some of the
// bodies are out of the tree.
TEST(AabbTree, HoldsEachBodyOnceThoughItGrowsTooHighWhileTheyAreInsertedAgain) {
  AabbTree<2> tree({.following = Following::reinsert});
  std::vector<Item<2>> items;
  for (BodyId id = 0; id < 150; ++id)
    items.push_back({id, {Vec<2>(0.0), Vec<2>(std::pow(1.3, id))}});
  tree.make(items);
  for (Item<2>& item : items) item.box.hi = Vec<2>(std::pow(1.3, 150 - item.id));
  tree.update(items);
  expect_sound(tree, items);
}

TEST(AabbTree, IsCutWhereBoxesStaySmall) {
  std::vector<Item<2>> row, growing;
  for (BodyId i = 0; i < 256; ++i) row.push_back({i, Box<2>::around({2.0 * i, 0}, Vec<2>(0.5))});
  for (BodyId i = 0; i < 300; ++i)
    growing.push_back({i, Box<2>::around({std::pow(1.2, i), 0}, Vec<2>(1e-3))});
  AabbTree<2> tree;
  tree.make(row);
  EXPECT_EQ(tree.counters().depth, 8u);
  tree.make(growing);
  EXPECT_GT(tree.counters().depth, 9u) << "cut at the median";
  EXPECT_LE(tree.counters().depth, 9u + 8);
}

// A ray visits the nodes whose boxes it meets, one by one where somebody watches.
TEST(AabbTree, CountsTheNodesThatARayVisits) {
  Random random(31);
  const auto items = numbered_world<2>(Sort::uniform, 60, random);
  AabbTree<2> tree;
  for (const Item<2>& item : items) tree.insert(item);
  for (int round = 0; round < 50; ++round) {
    const Ray<2> ray{random_point<2>(random, -10, 74), random_direction<2>(random)};
    std::uint64_t met = 0;
    tree.visit([&](const NodeView<2>& view) {
      met += span_in(ray, view.box).has_value();
      return true;
    });
    const auto box_of = [&](BodyId id) { return items[id].box; };
    const auto watched = [](const QueryEvent&) {};
    EXPECT_EQ(raycast_all<2>(tree, ray, box_of, {}, watched).counts.nodes_visited, met);
  }
}

// Beyond float, and so far apart that the distance is: no number of the rule of cuts is lost.
TEST(AabbTree, HoldsWhatFloatCannot) {
  std::vector<Item<2>> items;
  for (BodyId i = 0; i < 40; ++i) {
    const double at = (i % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, 30.0 + 6.0 * i);
    items.push_back({i, {Vec<2>(at), Vec<2>(at)}});
    if (i % 4 == 3) items.back().box = {Vec<2>(-1e300), Vec<2>(1e300)};
  }
  AabbTree<2> tree, inserted;
  tree.make(items);
  for (const Item<2>& item : items) inserted.insert(item);
  for (AabbTree<2>* each : {&tree, &inserted})
    EXPECT_EQ(paired(*each, items), testing::true_overlaps(items));
}

// Two far apart, then one beside each: each comes to its neighbour, not to the root.
TEST(AabbTree, ABodyComesToTheNeighbourWithWhichBoxesGrowLeast) {
  AabbTree<2> tree;
  std::vector<Event::Kind> told;
  const auto watch = [&](const Event& event) {
    told.push_back(event.kind);
    const bool is_test = event.kind == Event::Kind::test, parts = event.kind == Event::Kind::split;
    EXPECT_EQ(event.count, is_test ? 0u : parts ? 2u : 1u);
    EXPECT_EQ(event.limit, is_test ? 0u : 1u);
    EXPECT_EQ(event.body, told.size() == 1 && !is_test ? 0u : 1u);
  };
  const auto unit_at = [](double x) { return Box<2>::around({x, 0}, Vec<2>(0.5)); };
  tree.insert({0, unit_at(0)}, watch);
  EXPECT_EQ(told, std::vector{Event::Kind::store});
  told.clear();
  tree.insert({1, unit_at(100)}, watch);
  EXPECT_EQ(told, (std::vector{Event::Kind::test, Event::Kind::split, Event::Kind::store}));
  tree.insert({2, unit_at(99)});
  tree.insert({3, unit_at(1)});
  std::map<BodyId, std::uint32_t> parent;
  tree.visit([&](const NodeView<2>& view) {
    for (const BodyId id : view.bodies) parent[id] = view.parent;
    return true;
  });
  EXPECT_EQ(parent[0], parent[3]);
  EXPECT_EQ(parent[1], parent[2]);
  EXPECT_NE(parent[0], parent[1]);
}

TEST(AabbTree, RotationsMakeItBetter) {
  Random random(8);
  AabbTree<2> tree;
  std::uint64_t rotations = 0;
  double area = 0, least = 0;
  const auto watch = [&](const Event& event) {
    double now = 0;
    tree.visit([&](const NodeView<2>& view) {
      now += view.leaf ? 0 : view.box.size().x + view.box.size().y;
      return true;
    });
    if (event.kind == Event::Kind::rotate) {
      ++rotations;
      EXPECT_LT(now, area) << "a rotation must shrink a box";
    }
    area = now;
    least = std::max(least, now);
  };
  for (const Item<2>& item : testing::random_world<2>(Sort::uniform, 60, random))
    tree.insert(item, watch);
  EXPECT_GT(rotations, 5u);
}

// What leaves its box is taken out and inserted again, as it is told; nobody else is touched.
TEST(AabbTree, InsertsAgainThoseThatLeftTheirBoxesAndTellsIt) {
  Random random(21);
  std::vector<Item<2>> items = testing::random_world<2>(Sort::uniform, 40, random);
  for (BodyId i = 0; i < items.size(); ++i) items[i].id = i;  // only then is the tree followed
  for (const Following following : {Following::reinsert, Following::refit}) {
    AabbTree<2> tree({.margin = 0.5, .following = following});
    for (const Item<2>& item : items) tree.insert(item);
    for (int step = 0; step < 20; ++step) {
      std::set<BodyId> moved;
      for (Item<2>& item : items) {
        const double way = random.unit() < 0.2 ? 2 : 0;  // out of its box, or not at all
        if (way > 0) moved.insert(item.id);
        item.box.lo += Vec<2>(way);
        item.box.hi += Vec<2>(way);
      }
      std::set<BodyId> left, stored;
      tree.update(items, [&](const Event& event) {
        std::size_t nodes = 0;
        tree.visit([&](const NodeView<2>&) { return ++nodes > 0; });
        EXPECT_GT(nodes, 0u);
        if (event.kind == Event::Kind::leave) left.insert(event.body);
        if (event.kind == Event::Kind::store) stored.insert(event.body);
      });
      const Counters c = tree.counters();
      const bool again = following == Following::reinsert;
      EXPECT_EQ(again ? c.reinserted : c.refitted, moved.size());
      EXPECT_EQ(again ? c.refitted : c.reinserted, 0u);
      EXPECT_GE(c.box_tests, items.size()) << "each is asked whether it has left";
      EXPECT_EQ(left, again ? moved : std::set<BodyId>());
      EXPECT_EQ(stored, left);
      expect_sound(tree, items);
    }
  }
}

TEST(AabbTree, RefusesWhatItCannotHold) {
  EXPECT_THROW(AabbTree<2>({.margin = -1.0}), Refused);
  EXPECT_THROW(AabbTree<2>({.margin = std::numeric_limits<double>::quiet_NaN()}), Refused);
  EXPECT_THROW(AabbTree<3>({.margin = std::numeric_limits<double>::infinity()}), Refused);
  AabbTree<2> tree;
  const std::vector<Item<2>> good = {{0, {{0, 0}, {1, 1}}}, {1, {{2, 0}, {3, 1}}}};
  tree.make(good);
  std::vector<Item<2>> bad = good;
  bad[1].box.hi.x = 1;
  EXPECT_THROW(tree.make(bad), Refused);
  EXPECT_THROW(tree.update(bad), Refused);
  EXPECT_THROW(tree.insert(bad[1]), Refused);
  expect_sound(tree, good);
}

TEST(AabbTree, WhatIsUpdatedWithOtherBodiesIsBuiltAnew) {
  Random random(9);
  AabbTree<2> tree;
  tree.make(numbered_world<2>(Sort::uniform, 20, random));
  const auto more = numbered_world<2>(Sort::uniform, 25, random);
  tree.update(more);
  expect_sound(tree, more);
  const auto strangers = testing::random_world<2>(Sort::uniform, 25, random);
  tree.update(strangers);
  expect_sound(tree, strangers);
  tree.update({});
  expect_sound(tree, {});
}

TEST(AabbTree, NodesAreSmall) {
  EXPECT_EQ(sizeof(AabbNode<2>), 24u);
  EXPECT_EQ(sizeof(AabbNode<3>), 32u);
}

// Found through the broad phase, by names, with and without an observer.
TEST(AabbTree, WhoWatchesFindsTheSame) {
  Random random(10);
  BroadPhaseConfig<3> config;
  config.kind = StructureKind::aabb_tree;
  config.split_static = false;
  config.margin = 0.2;
  BroadPhase<3> phase(config);
  std::vector<Proxy<3>> proxies;
  for (BodyId id = 0; id < 80; ++id)
    proxies.push_back({7 * id + 3, testing::random_box<3>(Sort::uniform, random)});
  phase.update(proxies);
  const auto box_of = [&](BodyId id) { return proxies[id / 7].box; };
  const StructureView<3> tree = phase.dynamic();
  for (int i = 0; i < 20; ++i) {
    const Ray<3> ray{random_point<3>(random, 0, 64), random_point<3>(random, -1, 1)};
    std::uint64_t tests = 0;
    const auto watch = [&](const QueryEvent& e) { tests += e.kind == QueryEvent::Kind::test; };
    const AllHits watched = raycast_all<3>(tree, ray, box_of, {}, watch);
    const AllHits all = raycast_all<3>(tree, ray, box_of);
    EXPECT_EQ(all.hits, watched.hits);
    EXPECT_EQ(watched.counts.objects_tested, tests);
    EXPECT_GE(all.counts.objects_tested, all.hits.size());
    const Box<3> box = testing::random_box<3>(Sort::uniform, random);
    EXPECT_EQ(overlap_query<3>(tree, box, box_of).ids,
              overlap_query<3>(tree, box, box_of, [](const QueryEvent&) {}).ids);
  }
}

TEST(AabbTree, WithoutAMarginRefitsWhoseBoxHasChanged) {
  std::vector<Item<2>> items;
  for (BodyId id = 0; id < 20; ++id)
    items.push_back({id, {Vec<2>(3.0 * id), Vec<2>(3.0 * id + 1)}});
  AabbTree<2> tree({.margin = 0});
  tree.make(items);
  tree.update(items);
  EXPECT_EQ(tree.counters().refitted + tree.counters().reinserted, 0u);
  items[7].box.lo.x -= 0.25;
  tree.update(items);
  EXPECT_EQ(tree.counters().refitted + tree.counters().reinserted, 1u) << "a lower side";
  items[9].box.hi.y += 0.25;
  tree.update(items);
  EXPECT_EQ(tree.counters().refitted + tree.counters().reinserted, 1u) << "an upper one";
}

// All have changed places: mended, the boxes would be far too large.
TEST(AabbTree, IsBuiltAnewOnceItHasBecomeMuchWorse) {
  Random random(13);
  auto items = numbered_world<2>(Sort::uniform, 60, random);
  const auto boxes = [](const AabbTree<2>& tree) {
    std::vector<Box<2>> all;
    tree.visit([&](const NodeView<2>& view) { return all.push_back(view.box), true; });
    return all;
  };
  AabbTree<2> automatic, mended({.following = Following::refit}), anew;
  automatic.make(items);
  mended.make(items);
  for (Item<2>& item : items) item.box = testing::random_box<2>(Sort::uniform, random);
  automatic.update(items);
  mended.update(items);
  anew.make(items);
  EXPECT_EQ(boxes(automatic), boxes(anew));
  EXPECT_NE(boxes(mended), boxes(anew)) << "mending is as good: no test";
}

// Of an inner node that a ray enters each child is entered or skipped.
TEST(AabbTree, ARayEntersOrSkipsEachChild) {
  Random random(32);
  const auto items = numbered_world<2>(Sort::uniform, 60, random);
  AabbTree<2> tree;
  for (const Item<2>& item : items) tree.insert(item);
  const auto watched = [](const QueryEvent&) {};  // so that no boxes stand in rows
  const auto box_of = [&](BodyId id) { return items[id].box; };
  std::uint64_t skipped = 0;
  for (int round = 0; round < 50; ++round) {
    const Ray<2> ray{random_point<2>(random, 0, 64), random_direction<2>(random), 40};
    for (const QueryCounts& counts : {raycast_all<2>(tree, ray, box_of, {}, watched).counts,
                                      raycast_nearest<2>(tree, ray, box_of, {}, watched).counts}) {
      if (counts.nodes_visited == 0) continue;  // not even the root
      const std::uint64_t inner = counts.nodes_visited - counts.objects_tested;
      EXPECT_EQ(counts.nodes_visited + counts.nodes_skipped, 1 + 2 * inner);
      skipped += counts.nodes_skipped;
    }
  }
  EXPECT_GT(skipped, 0u);
}

}  // namespace
}  // namespace lantern::spatial
