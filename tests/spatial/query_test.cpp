// Rays, boxes, balls and views through every structure, against asking each body.
#include "spatial/query.hpp"

#include <map>

#include <gtest/gtest.h>

#include "geometry/random_vec.hpp"
#include "geometry/shape.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/grid/grid.hpp"
#include "spatial/planes.hpp"
#include "spatial/trees/aabb_tree.hpp"
#include "spatial/trees/brute_force.hpp"
#include "spatial/trees/bsp.hpp"
#include "spatial/trees/kd_tree.hpp"
#include "spatial/trees/orthtree.hpp"
#include "spatial/trees/sort_and_sweep.hpp"
#include "spatial/trees/wide_bvh.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::kSorts;
using testing::Sort;

template <int D>
class Scene {
 public:
  Scene(Sort sort, std::size_t bodies, std::uint64_t seed, double scale = 1)
      : random_(seed),
        sort_(sort),
        scale_(scale),
        items_(testing::random_world<D>(sort, bodies, random_)) {
    for (Item<D>& item : items_) boxes_[item.id] = item.box = scaled(item.box);
  }

  Random& random() { return random_; }
  const std::vector<Item<D>>& items() const { return items_; }
  Box<D> box_of(BodyId id) const { return boxes_.at(id); }

  // f(structure, name) for each, holding all bodies.
  template <class F>
  void with_each(F&& f) {
    testing::TreeConfig<D> config;
    config.bounds = scaled(testing::bounds_of<D>(sort_));
    config.capacity = static_cast<std::uint32_t>(random_.whole(1, 4));
    config.max_depth = static_cast<std::uint32_t>(random_.whole(0, 7));
    config.eager_children = random_.bits() % 2 == 0;
    config.no_progress_stop = true;
    Orthtree<D> orthtree(config);
    Bsp<D> bsp(testing::bsp_config<D>(scaled(testing::random_planes<D>(sort_, 12, random_)),
                                      config.bounds));
    BruteForce<D> brute;
    SortAndSweep<D> sweep;
    Grid<D> grid({.bounds = config.bounds,
                  .cell = random_.bits() % 2 == 0 ? 0 : random_.between(2, 20) * scale_,
                  .levels = static_cast<std::uint32_t>(random_.whole(1, 3)),
                  .open = random_.bits() % 2 == 0});
    grid.make(items_);
    KdTree<D> kd(testing::KdConfig<D>{config.capacity, config.max_depth});
    AabbTree<D> built({.margin = random_.between(0, 1) * scale_}), inserted;
    WideBvh<D> wide;
    built.make(items_);
    wide.make(items_);
    kd.make(items_);
    for (const Item<D>& item : items_) {
      orthtree.insert(item);
      bsp.insert(item);
      brute.insert(item);
      sweep.insert(item);
      inserted.insert(item);
    }
    f(orthtree, "orthtree");
    f(bsp, "bsp");
    f(brute, "brute force");
    f(sweep, "sort and sweep");
    f(kd, "kd-tree");
    f(grid, "grid");
    f(built, "AABB tree");
    f(wide, "wide BVH");
    f(inserted, "AABB tree, one by one");
    if constexpr (D == 3) {
      Upright<Quadtree> flat({.bounds = config.bounds,
                              .capacity = config.capacity,
                              .max_depth = config.max_depth,
                              .no_progress_stop = false});
      for (const Item<D>& item : items_) flat.insert(item);
      f(flat, "flat quadtree");
    }
  }

  Vec<D> point() {
    const Box<D> b = testing::bounds_of<D>(sort_);
    Vec<D> p = b.lo + random_point<D>(random_, -20, 84);
    if (sort_ == Sort::aligned)
      for (int i = 0; i < D; ++i) p[i] = 4.0 * static_cast<double>(random_.whole(-2, 18));
    return p * scale_;
  }

  // Some along an axis, some from a corner to a corner, some endless.
  Ray<D> ray() {
    Ray<D> ray{point(), random_point<D>(random_, -1, 1)};
    if (random_.bits() % 2 == 0) ray.direction = point() - ray.origin;
    if (random_.whole(0, 2) == 0) ray.direction[0] = 0;
    if (random_.whole(0, 2) == 0) ray.direction[1] = -0.0;
    if (ray.direction == Vec<D>(0.0)) ray.direction[D - 1] = -1;
    if (random_.bits() % 2 == 0) ray.length = random_.between(0, 2);
    return ray;
  }

  Frustum<D> view() {
    const double near = random_.between(0, 5), far = near + random_.between(1, 60);
    const double angle = random_.between(0.05, 2.8);
    if constexpr (D == 2)
      return view_wedge(point(), random_point<2>(random_, -1, 1), angle, near, far);
    else
      return view_frustum(point(), point() + Vec<3>(0.1, 0.2, 0.3), {0, 1, 0}, angle,
                          random_.between(0.3, 3), near, far);
  }

 private:
  Box<D> scaled(const Box<D>& box) const { return {box.lo * scale_, box.hi * scale_}; }
  std::vector<BspPlane<D>> scaled(std::vector<BspPlane<D>> planes) const {
    for (BspPlane<D>& one : planes) one.plane.offset *= scale_;
    return planes;
  }

  Random random_;
  Sort sort_;
  double scale_;
  std::vector<Item<D>> items_;
  std::map<BodyId, Box<D>> boxes_;
};

// Counts as told must be the counts returned, and no body is tested twice.
struct Tally {
  QueryCounts counts;
  std::set<BodyId> tested, hit;
  void operator()(const QueryEvent& event) {
    counts.nodes_visited += event.kind == QueryEvent::Kind::visit;
    counts.nodes_skipped += event.kind == QueryEvent::Kind::skip;
    if (event.kind == QueryEvent::Kind::test) {
      EXPECT_TRUE(tested.insert(event.body).second) << "body " << event.body << " tested twice";
      ++counts.objects_tested;
    }
    if (event.kind == QueryEvent::Kind::hit) hit.insert(event.body);
  }
  void expect_agrees(const QueryCounts& other) const {
    EXPECT_EQ(counts.nodes_visited, other.nodes_visited);
    EXPECT_EQ(counts.nodes_skipped, other.nodes_skipped);
    EXPECT_EQ(counts.objects_tested, other.objects_tested);
  }
};

// A ball within the box, as a true shape that is not its box.
template <int D>
std::optional<double> entry_of_ball_in(const Ray<D>& ray, const Box<D>& box) {
  double radius = std::numeric_limits<double>::infinity();
  for (int i = 0; i < D; ++i) radius = std::min(radius, box.size()[i] / 2);
  return entry<D>(ray, Sphere{radius}, box.center());
}

template <int D>
void rays_equal_brute_force(Sort sort, std::uint64_t seed) {
  Scene<D> scene(sort, 60, seed);
  const auto box_of = [&](BodyId id) { return scene.box_of(id); };
  scene.with_each([&](const auto& structure, const char* name) {
    for (int round = 0; round < 12; ++round) {
      const Ray<D> ray = scene.ray();
      for (const bool shapes : {false, true}) {
        std::vector<RayHit> expected;
        for (const Item<D>& item : scene.items())
          if (const auto span = span_in(ray, item.box)) {
            const auto t = shapes ? entry_of_ball_in(ray, item.box) : span->from;
            if (t) expected.push_back({item.id, std::max(*t, span->from)});
          }
        std::sort(expected.begin(), expected.end(), [](const RayHit& a, const RayHit& b) {
          return std::tie(a.distance, a.id) < std::tie(b.distance, b.id);
        });
        Tally all_told, nearest_told;
        const auto hit = [&](BodyId id) -> std::optional<double> {
          return shapes ? entry_of_ball_in(ray, box_of(id)) : span_in(ray, box_of(id))->from;
        };
        const AllHits all = raycast_all(structure, ray, box_of, hit, all_told);
        const NearestHit nearest = raycast_nearest(structure, ray, box_of, hit, nearest_told);
        ASSERT_EQ(all.hits, expected) << name << " lost or invented hits, sort "
                                      << static_cast<int>(sort) << ", seed " << seed;
        ASSERT_EQ(nearest.hit, expected.empty() ? std::nullopt : std::optional(expected.front()))
            << name << ", sort " << static_cast<int>(sort) << ", seed " << seed;
        ASSERT_TRUE(shapes || raycast_nearest(structure, ray, box_of).hit == nearest.hit) << name;
        all_told.expect_agrees(all.counts);
        nearest_told.expect_agrees(nearest.counts);
        EXPECT_EQ(all_told.hit.size(), all.hits.size());
        EXPECT_LE(nearest.counts.objects_tested, all.counts.objects_tested);
      }
    }
  });
}

template <int D>
void overlaps_equal_brute_force(Sort sort, std::uint64_t seed) {
  Scene<D> scene(sort, 60, seed);
  const auto box_of = [&](BodyId id) { return scene.box_of(id); };
  const auto expected = [&](const auto& what) {
    std::vector<BodyId> ids;
    for (const Item<D>& item : scene.items())
      if (overlap(what, item.box)) ids.push_back(item.id);
    std::sort(ids.begin(), ids.end());
    return ids;
  };
  const auto check = [&](const auto& query, const auto& what, const char* name, const char* of) {
    Tally told;
    const Found found = query(told);
    ASSERT_EQ(found.ids, expected(what))
        << of << " in " << name << ", sort " << static_cast<int>(sort) << ", seed " << seed;
    EXPECT_EQ(std::vector(told.hit.begin(), told.hit.end()), found.ids) << "hits as told";
    told.expect_agrees(found.counts);
  };
  scene.with_each([&](const auto& structure, const char* name) {
    for (int round = 0; round < 8; ++round) {
      const Vec<D> a = scene.point(), b = scene.point();
      const Box<D> box{glm::min(a, b), glm::max(a, b)};
      const Ball<D> ball{a, round % 4 == 0 ? 0.0 : scene.random().between(0, 30)};
      const Frustum<D> view = scene.view();
      check([&](auto& t) { return overlap_query(structure, box, box_of, t); }, box, name, "box");
      check([&](auto& t) { return overlap_query(structure, ball, box_of, t); }, ball, name, "ball");
      check([&](auto& t) { return overlap_query(structure, view, box_of, t); }, view, name, "view");
    }
  });
}

TEST(Query, RaysEqualBruteForceIn2D) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < 6; ++seed) rays_equal_brute_force<2>(sort, seed);
}
TEST(Query, RaysEqualBruteForceIn3D) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < 6; ++seed) rays_equal_brute_force<3>(sort, seed);
}
TEST(Query, OverlapsAndViewsEqualBruteForceIn2D) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < 6; ++seed) overlaps_equal_brute_force<2>(sort, seed);
}
TEST(Query, OverlapsAndViewsEqualBruteForceIn3D) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < 6; ++seed) overlaps_equal_brute_force<3>(sort, seed);
}

// Asked again and again, with nobody watching: by rows of boxes in float, where a structure has
// such, whatever the numbers are.
template <int D>
void unwatched_equal_brute_force(Sort sort, std::size_t bodies, double scale, std::uint64_t seed) {
  Scene<D> scene(sort, bodies, seed, scale);
  const auto box_of = [&](BodyId id) { return scene.box_of(id); };
  const auto overlaps = [&](const auto& what) {
    std::vector<BodyId> ids;
    for (const Item<D>& item : scene.items())
      if (overlap(what, item.box)) ids.push_back(item.id);
    std::sort(ids.begin(), ids.end());
    return ids;
  };
  scene.with_each([&](const auto& structure, const std::string& name) {
    SCOPED_TRACE(name + ", sort " + std::to_string(static_cast<int>(sort)) + ", scale " +
                 std::to_string(scale) + ", seed " + std::to_string(seed));
    for (int round = 0; round < 6; ++round) {
      const Ray<D> ray = scene.ray();
      std::vector<RayHit> hits;
      for (const Item<D>& item : scene.items())
        if (const auto span = span_in(ray, item.box)) hits.push_back({item.id, span->from});
      std::sort(hits.begin(), hits.end(), RayHit::before);
      ASSERT_EQ(raycast_all(structure, ray, box_of).hits, hits);
      ASSERT_EQ(overlap_query(structure, ray, box_of).ids, overlaps(ray));
      ASSERT_EQ(overlap_query(structure, ray, box_of, [](const QueryEvent&) {}).ids, overlaps(ray));
      const auto first = raycast_nearest(structure, ray, box_of).hit;
      ASSERT_EQ(first, hits.empty() ? std::nullopt : std::optional(hits.front()));

      const Vec<D> a = scene.point(), b = scene.point();
      const Box<D> box{glm::min(a, b), glm::max(a, b)};
      ASSERT_EQ(overlap_query(structure, box, box_of).ids, overlaps(box));
      const Ball<D> ball{a, round == 0 ? 0.0 : scene.random().between(0, 30) * scale};
      ASSERT_EQ(overlap_query(structure, ball, box_of).ids, overlaps(ball));

      std::optional<Neighbour> nearest;
      for (const Item<D>& item : scene.items()) {
        const Neighbour one{item.id, square_of(gaps<D>(a, item.box))};
        if (!nearest || Neighbour::before(one, *nearest)) nearest = one;
      }
      ASSERT_EQ(nearest_body(structure, a, box_of).body, nearest);
      const auto nobody_cares = [](const QueryEvent&) {};
      ASSERT_EQ(nearest_body(structure, a, box_of, nobody_cares).body, nearest) << "watched";
    }
  });
}

TEST(Query, UnwatchedTheyEqualBruteForce) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      unwatched_equal_brute_force<2>(sort, 80, 1, seed);
      unwatched_equal_brute_force<3>(sort, 80, 1, seed);
    }
}
TEST(Query, UnwatchedTheyEqualBruteForceAmongMany) {
  for (const Sort sort : {Sort::uniform, Sort::far, Sort::outside}) {
    unwatched_equal_brute_force<2>(sort, 900, 1, 7);
    unwatched_equal_brute_force<3>(sort, 900, 1, 7);
  }
}
TEST(Query, UnwatchedTheyEqualBruteForceAtAnyScale) {
  for (const double scale : {1e-90, 1e-40, 1e-20, 1e-9, 1e9, 1e20, 1e40, 1e90})
    for (const Sort sort : {Sort::uniform, Sort::aligned, Sort::ratios}) {
      unwatched_equal_brute_force<2>(sort, 60, scale, 5);
      unwatched_equal_brute_force<3>(sort, 60, scale, 5);
    }
}

TEST(Query, OfNoBodiesNoneIsNearest) {
  for (const StructureKind kind : known_structures()) {
    if (!is_possible(kind, 2) || kind == structure_named("auto")) continue;
    const auto empty = make_structure<2>(kind);
    for (int again = 0; again < 3; ++again)
      EXPECT_FALSE(nearest_body<2>(*empty, {1, 2}, {}).body) << to_string(kind);
    EXPECT_THROW(nearest_body<2>(*empty, {1, NAN}, {}), Refused);
  }
}

// Among 20,000 boxes of one size a question looks at some tens of them, in every structure that
// parts the world: counted, for a ray of a fortieth of the world, a box and a ball of ten bodies,
// and a point.
TEST(Query, AsksFewOfMany) {
  Random random(3);
  std::vector<Proxy<2>> boxes;
  for (BodyId id = 0; id < 20000; ++id)
    boxes.push_back({id, Box<2>::around(random_point<2>(random, 0, 283), Vec<2>(0.5))});
  for (const char* name : {"auto", "quadtree", "kd_tree", "grid", "aabb_tree"}) {
    BroadPhaseConfig<2> config;
    config.kind = *structure_named(name);
    config.bounds = {Vec<2>(0.0), Vec<2>(283)};
    config.build = Build::at_once;
    config.capacity = 16;
    config.max_depth = 12;
    BroadPhase<2> phase(config);
    phase.build(boxes);
    QueryCounts sum;
    std::uint64_t found = 0;
    constexpr std::uint64_t kAsked = 100;
    for (std::uint64_t i = 0; i < kAsked; ++i) {
      const Vec<2> at = random_point<2>(random, 0, 283);
      const Found in_box = overlap_query<2>(phase.dynamic(), Box<2>::around(at, Vec<2>(3)));
      const Found in_ball = overlap_query<2>(phase.dynamic(), Ball<2>{at, 3});
      const AllHits along = raycast_all<2>(phase.dynamic(), {at, random_direction<2>(random), 7});
      const NearestHit first = raycast_nearest<2>(phase.dynamic(), {at, {1, 0}, 7});
      const NearestBody nearest = nearest_body<2>(phase.dynamic(), at);
      if (i == 0) continue;  // the rows are made by the second question
      for (const QueryCounts& one :
           {in_box.counts, in_ball.counts, along.counts, first.counts, nearest.counts})
        sum += one;
      found += in_box.ids.size() + in_ball.ids.size() + along.hits.size() + 2;
    }
    EXPECT_GT(found, 20 * kAsked);
    EXPECT_LT(sum.boxes_compared, 5 * 80 * kAsked) << name;
    EXPECT_LT(sum.objects_tested, 5 * 12 * kAsked) << name;
    EXPECT_LT(sum.nodes_visited, 5 * 25 * kAsked) << name;
  }
}

// Of a grid only the cells that a question reaches are told of: of 1,024 those of the row that a
// ray goes along, or up to the first hit, and of a box those that it covers.
TEST(Query, OfAGridOnlyTheCellsThatAreReachedAreLookedAt) {
  Grid<2> grid({.bounds = {Vec<2>(0.0), Vec<2>(64)}, .cell = 2});
  std::map<BodyId, Box<2>> boxes;
  for (BodyId id = 0; id < 1024; ++id) {
    boxes[id] = Box<2>::around({2.0 * (id % 32) + 1, 2.0 * (id / 32) + 1}, Vec<2>(0.5));
    grid.insert({id, boxes[id]});
  }
  const auto box_of = [&](BodyId id) { return boxes.at(id); };
  std::uint64_t told = 0;
  const auto watch = [&](const QueryEvent& event) { told += event.kind != QueryEvent::Kind::hit; };
  const Ray<2> ray{{-1, 5}, {1, 0}};
  const AllHits all = raycast_all<2>(grid, ray, box_of, {}, watch);
  EXPECT_EQ(all.hits.size(), 32u);
  EXPECT_EQ(all.counts.nodes_visited, 1 + 32u) << "the root, and a row";
  EXPECT_EQ(all.counts.nodes_skipped, 0u);
  const NearestHit first = raycast_nearest<2>(grid, ray, box_of, {}, watch);
  EXPECT_EQ(first.counts.nodes_visited, 1 + 1u);
  const Found found = overlap_query<2>(grid, Box<2>{Vec<2>(10.5), Vec<2>(15.5)}, box_of, watch);
  EXPECT_EQ(found.counts.nodes_visited, 1 + 9u);
  EXPECT_EQ(told, (33 + 32) + (2 + 1) + (10 + 9u));
}

// Upper faces that are not the sums of lower ones and sizes, as they are rounded.
TEST(Query, ARayAlongTheUppermostFaceOfAGridMeetsIt) {
  Random random(1);
  std::uint64_t rounded = 0;
  for (int round = 0; round < 4000; ++round) {
    const double lo = -random.between(0.1, 3), hi = random.between(0.001, 0.2);
    rounded += lo + (hi - lo) < hi;
    const Box<2> box{{1, lo}, {4, hi}};
    Grid<2> grid({.bounds = {Vec<2>(-64.0), Vec<2>(64.0)}});
    grid.insert({7, box});
    const auto box_of = [&](BodyId) { return box; };
    EXPECT_EQ(overlap_query<2>(grid, Ray<2>{{0, hi}, {1, 0}, 9}, box_of).ids.size(), 1u);
    EXPECT_EQ(overlap_query<2>(grid, Ray<2>{{0, lo}, {1, 0}, 9}, box_of).ids.size(), 1u);
  }
  EXPECT_GT(rounded, 100u);
}

// Who asks once after each change does not pay for rows of all bodies.
TEST(Query, AskedOnceAfterEachInsertionNothingIsMadeOfAll) {
  Random random(4);
  AabbTree<2> tree;
  Quadtree quadtree(testing::TreeConfig<2>{{{0, 0}, {64, 64}}, 4, 6});
  std::map<BodyId, Box<2>> boxes;
  const auto box_of = [&](BodyId id) { return boxes.at(id); };
  for (BodyId id = 0; id < 200; ++id) {
    boxes[id] = Box<2>::around(random_point<2>(random, 0, 64), Vec<2>(0.5));
    tree.insert({id, boxes[id]});
    quadtree.insert({id, boxes[id]});
    for (const Structure<2>* one :
         {static_cast<Structure<2>*>(&tree), static_cast<Structure<2>*>(&quadtree)}) {
      const Box<2> here = Box<2>::around(boxes[id].center(), Vec<2>(1));
      EXPECT_EQ(overlap_query<2>(*one, here, box_of).counts.boxes_compared, 0u);
    }
  }
  const Box<2> all{Vec<2>(-1), Vec<2>(65)};
  EXPECT_EQ(overlap_query<2>(tree, all, box_of).counts.boxes_compared, 200u);
}

// A row of unit boxes at x = 10, 20, ... in a quadtree of cells.
TEST(Query, TheNearestHitEndsTheSearch) {
  Quadtree tree(testing::TreeConfig<2>{{{0, 0}, {128, 128}}, 1, 5});
  std::map<BodyId, Box<2>> boxes;
  for (BodyId id = 0; id < 12; ++id) {
    boxes[id] = Box<2>::around({10.0 * (id + 1), 3}, Vec<2>(0.5));
    tree.insert({id, boxes[id]});
  }
  const auto box_of = [&](BodyId id) { return boxes.at(id); };
  for (const bool back : {false, true}) {
    const Ray<2> ray = back ? Ray<2>{{200, 3}, {-1, 0}} : Ray<2>{{-5, 3}, {1, 0}};
    const NearestHit nearest = raycast_nearest(tree, ray, box_of);
    const AllHits all = raycast_all(tree, ray, box_of);
    ASSERT_TRUE(nearest.hit);
    EXPECT_EQ(nearest.hit->id, back ? 11u : 0u);
    EXPECT_EQ(nearest.hit->distance, back ? 79.5 : 14.5);
    EXPECT_EQ(nearest.counts.objects_tested, 1u) << "front to back, the first one tested is it";
    EXPECT_EQ(all.hits.size(), 12u);
    EXPECT_EQ(all.counts.objects_tested, 12u);
    EXPECT_LT(nearest.counts.nodes_visited, all.counts.nodes_visited);
    EXPECT_GT(nearest.counts.nodes_skipped, 0u);
  }
}

// Of two siblings that differ along some axes, the first one met is not behind on all of these.
template <int D, class Structure>
void expect_order_of_ray(const Structure& structure, const Vec<D>& toward, const char* name) {
  std::map<std::uint32_t, std::vector<std::pair<Box<D>, std::uint32_t>>> children;
  std::map<std::uint32_t, bool> back_first;
  std::uint32_t visited = 0;
  structure.visit(
      [&](const NodeView<D>& node) {
        EXPECT_EQ(node.id, visited++) << name;
        children[node.parent].push_back({node.box, node.slot});
        if (node.plane != nullptr) back_first[node.id] = glm::dot(node.plane->normal, toward) >= 0;
        return true;
      },
      toward);
  EXPECT_GT(children.size(), 4u) << name;
  for (const auto& [parent, met] : children)
    for (std::size_t i = 0; i < met.size(); ++i)
      for (std::size_t j = i + 1; j < met.size(); ++j) {
        if (back_first.contains(parent)) {
          EXPECT_EQ(met[i].second, back_first[parent] ? 0u : 1u) << name;
          continue;
        }
        bool all_behind = true;
        const Vec<D> way = met[j].first.center() - met[i].first.center();
        for (int axis = 0; axis < D; ++axis) all_behind &= way[axis] * toward[axis] <= 0;
        EXPECT_FALSE(all_behind) << name << ", siblings " << met[i].second << ", " << met[j].second;
      }
}

// Of two cells the first one met is not behind the other on all axes.
template <int D>
void expect_order_of_grid(const Grid<D>& grid, const Vec<D>& toward) {
  std::vector<Vec<D>> met;
  grid.visit(
      [&](const NodeView<D>& node) {
        for (const Vec<D>& before : met) {
          bool all_behind = node.leaf;
          for (int axis = 0; axis < D; ++axis)
            all_behind = all_behind && (node.box.center()[axis] - before[axis]) * toward[axis] <= 0;
          EXPECT_FALSE(all_behind);
        }
        if (node.leaf) met.push_back(node.box.center());
        return true;
      },
      toward);
  EXPECT_GT(met.size(), 20u);
}

template <int D>
void siblings_are_in_order(std::uint64_t seed) {
  Scene<D> scene(Sort::uniform, 60, seed);
  Vec<D> toward = random_direction<D>(scene.random());
  const Box<D> bounds = testing::bounds_of<D>(Sort::uniform);
  testing::TreeConfig<D> config;
  config.bounds = bounds;
  Orthtree<D> orthtree(config);
  Bsp<D> bsp(
      testing::bsp_config<D>(testing::random_planes<D>(Sort::uniform, 12, scene.random()), bounds));
  KdTree<D> kd(testing::KdConfig<D>{2, 6});
  kd.make(scene.items());
  for (const Item<D>& item : scene.items()) orthtree.insert(item);
  expect_order_of_ray<D>(orthtree, toward, "orthtree");
  expect_order_of_ray<D>(kd, toward, "kd-tree");
  Grid<D> grid({.bounds = bounds, .cell = 8});
  grid.make(scene.items());
  expect_order_of_grid<D>(grid, toward);
  expect_order_of_ray<D>(bsp, toward, "bsp");
  if constexpr (D == 3) {
    Upright<Quadtree> flat(
        {.bounds = bounds, .capacity = 2, .max_depth = 6, .no_progress_stop = false});
    for (const Item<D>& item : scene.items()) flat.insert(item);
    expect_order_of_ray<D>(flat, toward, "flat quadtree");
  }
}

TEST(Query, SiblingsAreMetInTheOrderOfTheRay) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    siblings_are_in_order<2>(seed);
    siblings_are_in_order<3>(seed);
  }
}

TEST(Query, BodiesOutsideTheRootAreFoundInRimCells) {
  Quadtree tree(testing::TreeConfig<2>{{{0, 0}, {64, 64}}, 1, 4});
  const Box<2> away = Box<2>::around({1000, 1000}, Vec<2>(1.0));
  tree.insert({1, away});
  tree.insert({2, Box<2>::around({8, 8}, Vec<2>(1.0))});
  tree.insert({3, Box<2>::around({40, 8}, Vec<2>(1.0))});
  const auto box_of = [&](BodyId id) { return id == 1 ? away : Box<2>{}; };
  const auto nearest = raycast_nearest(tree, Ray<2>{{1000, 900}, {0, 1}}, box_of);
  ASSERT_TRUE(nearest.hit) << "the ray never enters the root's box";
  EXPECT_EQ(nearest.hit->distance, 99);
  EXPECT_EQ(overlap_query(tree, Ball<2>{{1002, 1000}, 1.0}, box_of).ids, std::vector<BodyId>{1});
  EXPECT_EQ(overlap_query(tree, view_wedge({990, 1000}, {1, 0}, 0.5, 0, 20), box_of).ids,
            std::vector<BodyId>{1});
}

TEST(Query, ABspSkipsRegionsThatTheRayDoesNotReach) {
  // Two planes side by side: x = 10, and in front of it y = 10.
  Bsp<2> bsp(testing::bsp_config<2>({{{{1, 0}, 10}}, {{{0, 1}, 10}, 0, true}}, {{0, 0}, {20, 20}}));
  bsp.insert({1, Box<2>::around({5, 15}, Vec<2>(1.0))});
  bsp.insert({2, Box<2>::around({15, 15}, Vec<2>(1.0))});
  bsp.insert({3, Box<2>::around({15, 5}, Vec<2>(1.0))});
  const auto none = [](BodyId) { return Box<2>{Vec<2>(-9.0), Vec<2>(-9.0)}; };
  // Crosses y = 10 behind the first plane, where the second one does not count.
  const AllHits all = raycast_all(bsp, Ray<2>{{0, 5}, {1, 1}}, none);
  EXPECT_EQ(all.counts.objects_tested, 2u) << "bodies 1 and 2";
  EXPECT_EQ(all.counts.nodes_skipped, 1u) << "the region of body 3";
}

TEST(Query, ThroughABroadPhaseBodiesHaveTheirOwnIds) {
  BroadPhase<2> phase({});
  const Box<2> wall = Box<2>::around({10, 0}, Vec<2>(1.0));
  const Box<2> ball = Box<2>::around({5, 0}, Vec<2>(1.0));
  phase.update(std::vector<Proxy<2>>{{900, wall, true}, {77, ball}});
  const auto box_of = [&](BodyId id) { return id == 900 ? wall : ball; };
  const Ray<2> ray{{0, 0}, {1, 0}};
  const auto cast = [&](const auto& s) { return raycast_nearest(s, ray, box_of).hit; };
  EXPECT_EQ(cast(phase.fixed()), std::optional(RayHit{900, 9}));
  EXPECT_EQ(cast(phase.dynamic()), std::optional(RayHit{77, 4}));
}

TEST(Query, RefusesWhatIsNoQuery) {
  const BruteForce<2> brute;
  const auto box_of = [](BodyId) { return Box<2>{}; };
  EXPECT_THROW(raycast_nearest(brute, Ray<2>{{0, 0}, {0, 0}}, box_of), Refused);
  EXPECT_THROW(raycast_nearest(brute, Ray<2>{{0, NAN}, {1, 0}}, box_of), Refused);
  EXPECT_THROW(raycast_all(brute, Ray<2>{{0, 0}, {1, 0}, -1}, box_of), Refused);
  EXPECT_THROW(overlap_query(brute, Box<2>{{1, 0}, {0, 0}}, box_of), Refused);
  EXPECT_THROW(overlap_query(brute, Ball<2>{{0, 0}, -1}, box_of), Refused);
}

// What grazes is not cut off.
TEST(RayProbe, ARayInAPlaneLiesOnBothItsSides) {
  const Ray<2> ray{{0, 5}, {0, 1}, 7};
  const RayProbe<2> probe{ray};
  for (const bool front : {false, true}) {
    const auto part = probe.beside(probe.whole(), {{1, 0}, 0}, front);
    ASSERT_TRUE(part) << front;
    EXPECT_EQ(part->from, 0);
    EXPECT_EQ(part->to, 7);
  }
}

// Of each side of a plane the ray has a part, which ends, or begins, where it crosses.
TEST(RayProbe, ARayIsPartedWhereItCrossesAPlane) {
  const Plane<2> plane{{1, 0}, 4};
  for (const bool rises : {true, false}) {
    const Ray<2> ray{{rises ? 0.0 : 8.0, 5}, {rises ? 1.0 : -1.0, 0}, 7};
    const RayProbe<2> probe{ray};
    const auto first = probe.beside(probe.whole(), plane, !rises);
    const auto second = probe.beside(probe.whole(), plane, rises);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->from, 0);
    EXPECT_NEAR(first->to, 4, 1e-12);
    EXPECT_NEAR(second->from, 4, 1e-12);
    EXPECT_EQ(second->to, 7);
  }
}

}  // namespace
}  // namespace lantern::spatial
