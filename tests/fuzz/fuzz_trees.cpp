// Run by tests/spatial/fuzz_test.cpp over seeded bytes. As a libFuzzer target:
//   clang++ -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -DLANTERN_LIBFUZZER -Isrc -Itests
//     tests/fuzz/fuzz_trees.cpp src/atlas/atlas.cpp src/spatial/*.cpp src/geometry/*.cpp -lfmt -o
//     fuzz_trees && ./fuzz_trees
#include "fuzz/fuzz_trees.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <set>
#include <vector>

#include "atlas/atlas.hpp"
#include "base/check.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/pairs.hpp"
#include "spatial/picture.hpp"
#include "spatial/query.hpp"
#include "spatial/trees/brute_force.hpp"
#include "spatial/trees/bsp.hpp"
#include "spatial/trees/orthtree.hpp"

namespace lantern::spatial {

using namespace atlas;

namespace {

constexpr std::size_t kMostBodies = 24;
constexpr std::uint64_t kMostEntries = 2000;
constexpr std::uint64_t kMostPairs = 2'000'000;

class ByteStream {
 public:
  explicit ByteStream(std::span<const std::uint8_t> bytes) : rest_(bytes) {}
  bool empty() const { return rest_.empty(); }
  std::uint8_t next() {
    if (rest_.empty()) return 0;
    const std::uint8_t byte = rest_.front();
    rest_ = rest_.subspan(1);
    return byte;
  }
  std::uint64_t word(int bytes) {
    std::uint64_t word = 0;
    for (int i = 0; i < bytes; ++i) word = word << 8 | next();
    return word;
  }
  // Mostly small whole and half numbers, on which trees split; now and then any bits at all.
  double number() {
    const std::uint8_t kind = next();
    if (kind < 200) return kind / 2.0 - 20.0;
    if (kind < 240) return static_cast<double>(static_cast<std::int16_t>(word(2))) / 512.0;
    return std::bit_cast<double>(word(8));
  }

 private:
  std::span<const std::uint8_t> rest_;
};

template <int D>
Box<D> read_box(ByteStream& bytes) {
  Box<D> box;
  const bool any = bytes.next() < 16;  // else in order
  for (int i = 0; i < D; ++i) {
    box.lo[i] = bytes.number();
    box.hi[i] = any ? bytes.number() : box.lo[i] + bytes.next() / 8.0;
  }
  return box;
}

// Inserts bodies as the bytes say. False if the structure's budget was passed. A box that is not
// valid must be refused without a trace.
template <int D, class Structure>
bool fill(Structure& structure, ByteStream& bytes, std::vector<Item<D>>& items) {
  while (!bytes.empty() && items.size() < kMostBodies) {
    const Item<D> item{static_cast<BodyId>(items.size() * 7919 % 101), read_box<D>(bytes)};
    const std::uint64_t entries = structure.counters().entries;
    try {
      structure.insert(item);
      LANTERN_CHECK(is_valid(item.box), ==, true);
      items.push_back(item);
    } catch (const Refused&) {
      if (is_valid(item.box)) return false;
      LANTERN_CHECK(structure.counters().entries, ==, entries);
    }
  }
  return true;
}

// Holds for every structure: the counters agree with what is seen, nobody is lost, and all pairs
// that overlap are found, by leaves and by queries.
template <int D, class Structure>
void check_structure(const Structure& structure, const std::vector<Item<D>>& items) {
  Counters seen;
  std::set<BodyId> stored;
  structure.visit([&](const NodeView<D>& view) {
    LANTERN_CHECK(view.id, ==, seen.nodes);
    LANTERN_CHECK(view.leaf || view.bodies.empty(), ==, true);
    LANTERN_CHECK(std::adjacent_find(view.bodies.begin(), view.bodies.end(),
                                     std::greater_equal<>()) == view.bodies.end(),
                  ==, true);
    ++seen.nodes;
    seen.leaves += view.leaf;
    seen.entries += view.bodies.size();
    stored.insert(view.bodies.begin(), view.bodies.end());
    return true;
  });
  const Counters c = structure.counters();
  LANTERN_CHECK(c.nodes, ==, seen.nodes);
  LANTERN_CHECK(c.leaves, ==, seen.leaves);
  LANTERN_CHECK(c.entries, ==, seen.entries);
  LANTERN_CHECK(stored.size(), ==, items.size());

  BruteForce<D> brute;
  for (const Item<D>& item : items) brute.insert(item);
  const auto box_of = [&](BodyId id) {
    return std::find_if(items.begin(), items.end(), [&](const auto& i) { return i.id == id; })->box;
  };
  const auto overlaps = [&](const Pair& p) { return overlap(box_of(p.a), box_of(p.b)); };
  const auto expected = candidate_pairs(brute, kMostPairs, overlaps).pairs;
  LANTERN_CHECK(candidate_pairs(structure, kMostPairs, overlaps).pairs == expected, ==, true);
  for (const Item<D>& a : items) {
    std::vector<BodyId> found;
    structure.near(a.box, found);
    const std::set<BodyId> near(found.begin(), found.end());
    for (const Item<D>& b : items)
      LANTERN_CHECK(!overlap(a.box, b.box) || near.contains(b.id), ==, true);
  }
}

template <int D>
void fuzz_orthtree(ByteStream& bytes) {
  testing::TreeConfig<D> config;
  config.bounds = {Vec<D>(0.0), Vec<D>(64.0)};
  if (bytes.next() < 32) config.bounds = read_box<D>(bytes);
  config.capacity = bytes.next() % 9;
  config.max_depth = bytes.next() % 12;
  const std::uint8_t flags = bytes.next();
  config.eager_children = (flags & 1) != 0;
  config.no_progress_stop = (flags & 2) != 0;
  config.most_entries = kMostEntries;
  std::optional<Orthtree<D>> tree;
  try {
    tree.emplace(config);
  } catch (const Refused&) {
    return;
  }
  std::vector<Item<D>> items;
  if (!fill(*tree, bytes, items)) {
    LANTERN_CHECK(testing::picture_of<D>(*tree).size(), ==, tree->counters().nodes);
    tree->clear();
    for (const Item<D>& item : items) tree->insert(item);  // these were not too many
  }
  check_structure(*tree, items);
  const auto picture = testing::picture_of<D>(*tree);
  // Where numbers get so small that halves round, the reference's middle is another one.
  if (config.bounds == Box<D>{Vec<D>(0.0), Vec<D>(64.0)}) {
    const testing::ReferenceTree<D> reference(config, items);
    LANTERN_CHECK(reference.picture() == picture, ==, true);
  }
  std::reverse(items.begin(), items.end());
  tree->clear();
  for (const Item<D>& item : items) tree->insert(item);
  LANTERN_CHECK(testing::picture_of<D>(*tree) == picture, ==, true);
}

template <int D>
void fuzz_bsp(ByteStream& bytes) {
  std::vector<BspPlane<D>> planes(bytes.next() % 12);
  const bool any = bytes.next() < 16;
  for (std::uint32_t i = 0; i < planes.size(); ++i) {
    for (int axis = 0; axis < D; ++axis) planes[i].plane.normal[axis] = bytes.number();
    planes[i].plane.offset = bytes.number();
    const std::uint8_t place = bytes.next();
    planes[i].front = place % 2 != 0;
    planes[i].parent = any ? place / 2 : i == 0 ? kNone : place / 2 % i;
  }
  std::optional<Bsp<D>> bsp;
  try {
    bsp.emplace(testing::bsp_config<D>(planes, {Vec<D>(0.0), Vec<D>(64.0)}, kMostEntries));
  } catch (const Refused&) {
    return;
  }
  std::vector<Item<D>> items;
  if (!fill(*bsp, bytes, items)) return;
  check_structure(*bsp, items);
}

// All kinds of broad phase on the same bodies, updated several times: the same pairs. And a ray and
// a ball find the same bodies in each.
template <int D>
void fuzz_broad_phase(ByteStream& bytes) {
  std::vector<BroadPhase<D>> phases;
  BroadPhaseConfig<D> config;
  config.bounds = {Vec<D>(0.0), Vec<D>(64.0)};
  config.capacity = 1 + bytes.next() % 5u;
  config.max_depth = bytes.next() % 12u;
  config.eager_children = bytes.next() % 2 != 0;
  config.no_progress_stop = bytes.next() % 2 != 0;
  config.split_static = bytes.next() % 4 != 0;
  config.levels = 1 + config.max_depth % 3;
  config.open = config.capacity % 2 == 0;
  config.cell = config.max_depth;
  Plane<D> plane;
  plane.normal[0] = plane.normal[1] = 1;
  plane.offset = bytes.number();
  if (std::isfinite(plane.offset)) config.planes.push_back({plane});
  for (const StructureKind kind : kStructureKinds)
    if (config.kind = kind; D == 3 || kind != StructureKind::octree) phases.emplace_back(config);
  std::vector<Proxy<D>> proxies;
  for (int update = 0; update < 4; ++update) {
    while (bytes.next() % 8 != 0 && proxies.size() < kMostBodies) {
      const std::uint8_t flags = bytes.next();
      const Proxy<D> proxy{static_cast<BodyId>(proxies.size() * 7919 % 101), read_box<D>(bytes),
                           flags % 3 == 0, flags % 5 != 0};
      if (is_valid(proxy.box)) proxies.push_back(proxy);
    }
    Ray<D> ray;
    Ball<D> ball;
    for (int i = 0; i < D; ++i) {
      ray.origin[i] = bytes.next();
      ball.center[i] = bytes.next();
      ray.direction[i] = bytes.next() - 128.0;
    }
    ball.radius = bytes.next() / 2.0;
    if (ray.direction == Vec<D>(0.0)) ray.direction[0] = 1;
    const auto box_of = [&](BodyId id) {
      return std::find_if(proxies.begin(), proxies.end(), [&](const auto& p) { return p.id == id; })
          ->box;
    };
    std::vector<RayHit> hits;
    std::vector<BodyId> near;
    for (BroadPhase<D>& phase : phases) {
      phase.update(proxies);
      LANTERN_CHECK(phase.pairs() == phases.front().pairs(), ==, true);
      {
        const StructureView<D> structure = phase.dynamic();
        const AllHits all = raycast_all(structure, ray, box_of);
        const Found found = overlap_query(structure, ball, box_of);
        const NearestHit first = raycast_nearest(structure, ray, box_of);
        if (&phase == &phases.front()) hits = all.hits, near = found.ids;
        LANTERN_CHECK(all.hits == hits, ==, true);
        LANTERN_CHECK(found.ids == near, ==, true);
        LANTERN_CHECK(first.hit == (hits.empty() ? std::nullopt : std::optional(hits.front())), ==,
                      true);
      }
    }
    for (Proxy<D>& proxy : proxies) {
      const std::uint8_t what = bytes.next();
      if (what % 2 == 0) proxy.awake = !proxy.awake;
      if (what % 8 == 1 && is_valid(Box<D>{proxy.box.lo + 1.0, proxy.box.hi + 1.0}))
        proxy.box = {proxy.box.lo + 1.0, proxy.box.hi + 1.0};
    }
  }
}

void check_atlas(const Atlas& atlas, const std::vector<std::pair<TextureId, Rect>>& packed) {
  std::int64_t used = 0, free = 0;
  std::set<TextureId> seen;
  atlas.visit([&](const AtlasNodeView& view) {
    const std::int64_t area = std::int64_t{view.rect.width} * view.rect.height;
    LANTERN_CHECK(area, >, 0);
    if (view.leaf) (view.texture ? used : free) += area;
    if (view.texture) LANTERN_CHECK(seen.insert(*view.texture).second, ==, true);
    return true;
  });
  LANTERN_CHECK(used, ==, atlas.used_area());
  LANTERN_CHECK(free, ==, atlas.free_area());
  LANTERN_CHECK(used + free, ==, std::int64_t{atlas.width()} * atlas.height());
  LANTERN_CHECK(seen.size(), ==, packed.size());
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const Rect& a = packed[i].second;
    LANTERN_CHECK(
        a.x >= 0 && a.y >= 0 && a.x + a.width <= atlas.width() && a.y + a.height <= atlas.height(),
        ==, true);
    for (std::size_t j = 0; j < i; ++j) {
      const Rect& b = packed[j].second;
      LANTERN_CHECK(a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y ||
                        b.y + b.height <= a.y,
                    ==, true);
    }
  }
}

void fuzz_atlas(ByteStream& bytes) {
  std::optional<Atlas> atlas;
  try {
    atlas.emplace(bytes.next() * 2, bytes.next() * 2);
  } catch (const Refused&) {
    return;
  }
  std::vector<std::pair<TextureId, Rect>> packed;
  for (TextureId id = 0; id < 100 && !bytes.empty(); ++id) {
    const int width = bytes.next() / 2;
    const int height = bytes.next() / 2;
    const std::int64_t used = atlas->used_area();
    try {
      const bool room = atlas->has_room(width, height);
      const auto rect = atlas->insert(id, width, height);
      LANTERN_CHECK(rect.has_value(), ==, room);
      if (!rect) {
        LANTERN_CHECK(atlas->used_area(), ==, used);
        continue;
      }
      LANTERN_CHECK(rect->width == width && rect->height == height, ==, true);
      packed.emplace_back(id, *rect);
    } catch (const Refused&) {
      LANTERN_CHECK(std::min(width, height), <, 1);
    }
  }
  check_atlas(*atlas, packed);
}

}  // namespace

void fuzz_trees(std::span<const std::uint8_t> input) {
  ByteStream bytes(input);
  switch (bytes.next() % 7) {
    case 0:
      return fuzz_orthtree<2>(bytes);
    case 1:
      return fuzz_orthtree<3>(bytes);
    case 2:
      return fuzz_bsp<2>(bytes);
    case 3:
      return fuzz_bsp<3>(bytes);
    case 4:
      return fuzz_broad_phase<2>(bytes);
    case 5:
      return fuzz_broad_phase<3>(bytes);
    default:
      return fuzz_atlas(bytes);
  }
}

}  // namespace lantern::spatial

#ifdef LANTERN_LIBFUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lantern::spatial::fuzz_trees({data, size});
  return 0;
}
#endif
