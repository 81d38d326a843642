// The kD-tree against its rule, read from kd_cut.hpp word by word and followed without any sweep.
#include <algorithm>
#include <tuple>

#include <gtest/gtest.h>

#include "spatial/trees/kd_tree.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::kSorts;
using testing::Sort;

template <int D>
struct RuledTree {
  struct Tried {
    std::size_t fuller = 0, both = 0;
    int axis = 0;
    double plane = 0;
    auto operator<=>(const Tried&) const = default;
  };

  std::uint32_t capacity = 1, max_depth = 16;
  std::vector<std::string> lines;  // a node each, in order of visiting
  std::uint64_t tests = 0;         // of a body with a plane
  std::uint64_t depth = 0, entries = 0, splits = 0;

  static double center(const Box<D>& box, int axis) {
    return 0.5 * box.lo[axis] + 0.5 * box.hi[axis];
  }

  static void keep(std::optional<Tried>& best, const std::vector<Item<D>>& items, int axis,
                   double plane) {
    std::size_t back = 0, front = 0;
    for (const Item<D>& item : items) {
      back += item.box.lo[axis] <= plane;
      front += item.box.hi[axis] > plane;
    }
    const Tried cut{std::max(back, front), back + front - items.size(), axis, plane};
    const bool parts = back < items.size() && front < items.size();
    if (parts && cut.both <= items.size() / 2 && (!best || cut < *best)) best = cut;
  }

  std::optional<Tried> cut_of(const std::vector<Item<D>>& items) {
    std::vector<std::pair<double, int>> axes;  // minus the spread
    for (int axis = 0; axis < D; ++axis) {
      const auto by_center = [&](const Item<D>& a, const Item<D>& b) {
        return center(a.box, axis) < center(b.box, axis);
      };
      const auto [least, most] = std::minmax_element(items.begin(), items.end(), by_center);
      axes.push_back({center(least->box, axis) - center(most->box, axis), axis});
    }
    std::sort(axes.begin(), axes.end());
    for (const auto& [spread, axis] : axes) {
      std::vector<double> centers, below, above;
      for (const Item<D>& item : items) centers.push_back(center(item.box, axis));
      std::sort(centers.begin(), centers.end());
      const double median = centers[(centers.size() - 1) / 2];
      for (const Item<D>& item : items)
        (item.box.hi[axis] <= median ? below : above).push_back(item.box.hi[axis]);
      std::optional<Tried> best;
      if (!below.empty()) keep(best, items, axis, *std::max_element(below.begin(), below.end()));
      if (!above.empty()) keep(best, items, axis, *std::min_element(above.begin(), above.end()));
      tests += items.size() * (std::size_t{!below.empty()} + std::size_t{!above.empty()});
      if (best) return best;
    }
    std::optional<Tried> best;
    for (int axis = 0; axis < D; ++axis)
      for (const Item<D>& item : items) keep(best, items, axis, item.box.hi[axis]);
    tests += D * items.size();
    return best;
  }

  void grow(const std::vector<Item<D>>& items, std::uint32_t at_depth) {
    depth = std::max<std::uint64_t>(depth, at_depth);
    const bool full = items.size() > capacity && at_depth < max_depth;
    const std::optional<Tried> cut = full ? cut_of(items) : std::nullopt;
    if (!cut) {
      std::vector<BodyId> ids;
      for (const Item<D>& item : items) ids.push_back(item.id);
      std::sort(ids.begin(), ids.end());
      lines.push_back(fmt::format("depth {}, leaf of {}", at_depth, fmt::join(ids, " ")));
      entries += ids.size();
      return;
    }
    lines.push_back(fmt::format("depth {}, axis {} at {}", at_depth, cut->axis, cut->plane));
    ++splits;
    tests += 2 * items.size();
    std::vector<Item<D>> back, front;
    for (const Item<D>& item : items) {
      if (item.box.lo[cut->axis] <= cut->plane) back.push_back(item);
      if (item.box.hi[cut->axis] > cut->plane) front.push_back(item);
    }
    grow(back, at_depth + 1);
    grow(front, at_depth + 1);
  }
};

template <int D>
std::vector<std::string> lines_of(const KdTree<D>& tree) {
  std::vector<std::string> lines;
  tree.visit([&](const NodeView<D>& view) {
    if (view.leaf) {
      lines.push_back(fmt::format("depth {}, leaf of {}", view.depth, fmt::join(view.bodies, " ")));
      return true;
    }
    int axis = 0;
    while (view.plane->normal[axis] == 0) ++axis;
    EXPECT_EQ(glm::length(view.plane->normal), 1);
    EXPECT_EQ(view.plane->normal[axis], 1);
    lines.push_back(fmt::format("depth {}, axis {} at {}", view.depth, axis, view.plane->offset));
    return true;
  });
  return lines;
}

template <int D>
void expect_ruled(std::vector<Item<D>> items, std::uint32_t capacity, std::uint32_t max_depth) {
  RuledTree<D> expected{capacity, max_depth, {}};
  expected.grow(items, 0);
  KdTree<D> tree(testing::KdConfig<D>{capacity, max_depth});
  tree.make(items);
  EXPECT_EQ(lines_of(tree), expected.lines);
  const Counters c = tree.counters();
  EXPECT_EQ(c.box_tests, expected.tests);
  EXPECT_EQ(c.depth, expected.depth);
  EXPECT_EQ(c.entries, expected.entries);
  EXPECT_EQ(c.splits, expected.splits);
}

TEST(KdRule, EveryTreeFollowsIt) {
  for (const Sort sort : kSorts)
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      SCOPED_TRACE(fmt::format("sort {}, seed {}", static_cast<int>(sort), seed));
      Random random(seed);
      const auto bodies = static_cast<std::size_t>(random.whole(1, 40));
      const auto capacity = static_cast<std::uint32_t>(random.whole(1, 3));
      const auto depth = static_cast<std::uint32_t>(random.whole(0, 9));
      expect_ruled<2>(testing::random_world<2>(sort, bodies, random), capacity, depth);
      expect_ruled<3>(testing::random_world<3>(sort, bodies, random), capacity, depth);
    }
}

// Small whole numbers: equal spreads, equal faces, and planes that cut just half.
TEST(KdRule, TiesAreDecidedAsItSays) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Item<3>> items;
    const auto bodies = static_cast<BodyId>(random.whole(1, 9));
    for (BodyId id = 0; id < bodies; ++id) {
      Box<3> box;
      for (int i = 0; i < 3; ++i) {
        box.lo[i] = static_cast<double>(random.whole(0, 4));
        box.hi[i] = box.lo[i] + static_cast<double>(random.whole(0, 3));
      }
      items.push_back({id, box});
    }
    expect_ruled<3>(items, static_cast<std::uint32_t>(random.whole(1, 2)), 16);
  }
}

// Nodes count as reused as long as earlier trees had as many.
TEST(KdRule, NodesTakeThePlacesOfThoseBefore) {
  const auto row = [](BodyId bodies) {
    std::vector<Item<2>> items;
    for (BodyId id = 0; id < bodies; ++id)
      items.push_back({id, Box<2>::around({3.0 * id, 0}, Vec<2>(1.0))});
    return items;
  };
  KdTree<2> tree(
      testing::KdConfig<2>{1, 16});  // of n bodies in a row: n leaves, and n - 1 nodes above them
  const auto reused_by = [&](BodyId bodies) {
    tree.make(row(bodies));
    EXPECT_EQ(tree.counters().nodes, bodies == 0 ? 1 : 2 * bodies - 1);
    EXPECT_EQ(tree.counters().leaves, bodies == 0 ? 1 : bodies);
    return tree.counters().nodes_reused;
  };
  EXPECT_EQ(reused_by(8), 1u) << "the empty leaf was all that there was";
  EXPECT_EQ(reused_by(3), 5u);
  EXPECT_EQ(reused_by(16), 15u) << "as many as the largest tree had, not the last";
  EXPECT_EQ(reused_by(16), 31u);
  EXPECT_EQ(reused_by(0), 1u);
}

}  // namespace
}  // namespace lantern::spatial
