// Seeded random worlds for the tests of trees, of every sort that has ever broken one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "geometry/random_vec.hpp"
#include "spatial/broad_phase.hpp"

namespace lantern::spatial::testing {

enum class Sort {
  uniform,
  clustered,
  coincident,  // all the same box
  crowded,     // all share one point, no two are equal
  aligned,     // corners lie exactly on planes at which a tree splits
  ratios,      // sizes from 1e-6 to 1e6 times the world's
  far,         // 1e9 from the origin
  points,      // boxes of no size
  outside,     // partly or wholly outside the world
};
inline constexpr std::array kSorts = {Sort::uniform, Sort::clustered, Sort::coincident,
                                      Sort::crowded, Sort::aligned,   Sort::ratios,
                                      Sort::far,     Sort::points,    Sort::outside};

// A tree with no stop but its depth limit, if nothing else is said.
template <int D>
struct TreeConfig {
  Box<D> bounds;
  std::uint32_t capacity = 2;
  std::uint32_t max_depth = 6;
  bool eager_children = false;
  bool no_progress_stop = false;
  std::uint64_t most_entries = std::uint64_t{1} << 22;

  operator StructureConfig<D>() const {
    return {.bounds = bounds,
            .capacity = capacity,
            .max_depth = max_depth,
            .eager_children = eager_children,
            .no_progress_stop = no_progress_stop,
            .most_entries = most_entries};
  }
};

template <int D>
struct KdConfig {
  std::uint32_t capacity = 2;
  std::uint32_t max_depth = 16;
  std::uint64_t most_entries = std::uint64_t{1} << 22;

  operator StructureConfig<D>() const {
    return {.capacity = capacity, .max_depth = max_depth, .most_entries = most_entries};
  }
};

template <int D>
StructureConfig<D> bsp_config(std::vector<BspPlane<D>> planes, const Box<D>& bounds,
                              std::uint64_t most_entries = std::uint64_t{1} << 22) {
  return {.bounds = bounds, .planes = std::move(planes), .most_entries = most_entries};
}

// The world's bounds: a cube of side 64, its corner at the origin unless it is far away.
template <int D>
Box<D> bounds_of(Sort sort) {
  const Vec<D> corner(sort == Sort::far ? 1e9 : 0.0);
  return {corner, corner + 64.0};
}

template <int D>
Box<D> random_box(Sort sort, Random& random) {
  const auto around = [&](const Vec<D>& center, double most) {
    return Box<D>::around(center, random_point<D>(random, 0, most));
  };
  switch (sort) {
    case Sort::uniform:
      return around(random_point<D>(random, 0, 64), 6);
    case Sort::clustered:
      return around(Vec<D>(random.bits() % 2 == 0 ? 10.0 : 41.0) + random_point<D>(random, 0, 1),
                    0.5);
    case Sort::coincident:
      return Box<D>::around(Vec<D>(21.0), Vec<D>(1.5));
    case Sort::crowded:
      return {Vec<D>(33.0) - random_point<D>(random, 0, 4),
              Vec<D>(33.0) + random_point<D>(random, 0, 4)};
    case Sort::aligned: {
      Box<D> box;
      for (int i = 0; i < D; ++i) {
        box.lo[i] = 4.0 * static_cast<double>(random.whole(0, 15));
        box.hi[i] = box.lo[i] + 4.0 * static_cast<double>(random.whole(0, 2));
      }
      return box;
    }
    case Sort::ratios:
      return around(random_point<D>(random, 0, 64), 64 * std::pow(10.0, random.between(-6, 6)));
    case Sort::far:
      return around(Vec<D>(1e9) + random_point<D>(random, 0, 64), 5);
    case Sort::points: {
      const Vec<D> p = random_point<D>(random, 0, 64);
      return {p, p};
    }
    case Sort::outside:
      return around(random_point<D>(random, -100, 164), 40);
  }
  return {};
}

// Bodies in random order, their ids any different 32-bit numbers.
template <int D>
std::vector<Item<D>> random_world(Sort sort, std::size_t bodies, Random& random) {
  std::vector<Item<D>> items;
  std::set<BodyId> taken;
  while (items.size() < bodies) {
    const auto id = static_cast<BodyId>(random.bits());
    if (taken.insert(id).second) items.push_back({id, random_box<D>(sort, random)});
  }
  return items;
}

template <class T>
void shuffle(std::vector<T>& list, Random& random) {
  for (std::size_t i = list.size(); i > 1; --i)
    std::swap(list[i - 1],
              list[static_cast<std::size_t>(random.whole(0, static_cast<std::int64_t>(i) - 1))]);
}

template <int D>
std::vector<Box<D>> boxes_of(const std::vector<Item<D>>& items) {
  std::vector<Box<D>> boxes;
  for (const Item<D>& item : items) boxes.push_back(item.box);
  return boxes;
}

template <int D>
Box<D> box_of(const std::vector<Item<D>>& items, BodyId id) {
  return std::find_if(items.begin(), items.end(), [&](const auto& i) { return i.id == id; })->box;
}

// n(n-1)/2 comparisons, without any structure: the oracle of them all.
template <int D>
std::vector<Pair> true_overlaps(const std::vector<Item<D>>& items) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < items.size(); ++i)
    for (std::size_t j = 0; j < items.size(); ++j)
      if (items[i].id < items[j].id && overlap(items[i].box, items[j].box))
        pairs.push_back({items[i].id, items[j].id});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// The candidate pairs whose boxes really overlap; touching counts. `box_of(id)` is the box with
// which the body was inserted. Every structure gives the same pairs for the same bodies.
template <int D, class BoxOf>
std::vector<Pair> overlapping_pairs(const Structure<D>& structure, BoxOf&& box_of,
                                    std::uint64_t budget) {
  const auto wanted = [&](const Pair& pair) { return overlap(box_of(pair.a), box_of(pair.b)); };
  return candidate_pairs(structure, budget, wanted).pairs;
}

// The bodies of all leaves that the box reaches.
template <int D>
std::set<BodyId> near_in(const Structure<D>& structure, const Box<D>& box) {
  std::vector<BodyId> ids;
  structure.near(box, ids);
  return {ids.begin(), ids.end()};
}

// What a broad phase of these must find, by comparing all.
template <int D>
std::vector<Pair> true_pairs(const std::vector<Proxy<D>>& proxies) {
  std::vector<Pair> pairs;
  for (const Proxy<D>& a : proxies)
    for (const Proxy<D>& b : proxies)
      if (a.id < b.id && overlap(a.box, b.box) &&
          ((a.awake && !a.is_static) || (b.awake && !b.is_static)))
        pairs.push_back({a.id, b.id});
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace lantern::spatial::testing
