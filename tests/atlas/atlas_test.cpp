#include "atlas/atlas.hpp"

#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/random.hpp"

namespace lantern::atlas {
namespace {

using Kind = AtlasEvent::Kind;

struct Packed {
  TextureId id = 0;
  Rect rect;
};

std::vector<AtlasNodeView> nodes_of(const Atlas& atlas) {
  std::vector<AtlasNodeView> nodes;
  atlas.visit([&](const AtlasNodeView& view) {
    nodes.push_back(view);
    return true;
  });
  return nodes;
}

// Every node as text: equal texts are equal atlases.
std::string text_of(const Atlas& atlas) {
  std::string text;
  for (const AtlasNodeView& n : nodes_of(atlas))
    text += fmt::format("{} {} {} {} {},{} {}x{} {} {} {}\n", n.handle, n.id, n.parent, n.slot,
                        n.rect.x, n.rect.y, n.rect.width, n.rect.height, n.leaf, n.cut_vertically,
                        n.texture ? static_cast<int>(*n.texture) : -1);
  return text;
}

bool apart(const Rect& a, const Rect& b) {
  return a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y ||
         b.y + b.height <= a.y;
}

// All that must hold of any atlas with these textures, each compared with each.
void expect_sound(const Atlas& atlas, const std::vector<Packed>& packed) {
  std::map<TextureId, Rect> stored;
  std::int64_t free = 0;
  const auto nodes = nodes_of(atlas);
  for (const AtlasNodeView& n : nodes) {
    EXPECT_GT(std::min(n.rect.width, n.rect.height), 0) << "a leaf without any room was made";
    EXPECT_TRUE(!n.texture || (n.leaf && stored.emplace(*n.texture, n.rect).second));
    if (n.leaf && !n.texture) free += std::int64_t{n.rect.width} * n.rect.height;
    if (n.id == 0) continue;
    const AtlasNodeView& parent = nodes.at(n.parent);
    EXPECT_EQ(n.depth, parent.depth + 1);
    EXPECT_LT(n.parent, n.id) << "parents come first";
    EXPECT_EQ(n.slot == 0, n.rect.x == parent.rect.x && n.rect.y == parent.rect.y);
  }
  EXPECT_EQ(free, atlas.free_area());
  EXPECT_EQ(atlas.used_area() + free, std::int64_t{atlas.width()} * atlas.height());
  ASSERT_EQ(stored.size(), packed.size()) << "a texture was lost";
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const Rect& r = packed[i].rect;
    EXPECT_EQ(stored.at(packed[i].id), r) << "a texture moved";
    EXPECT_TRUE(r.x >= 0 && r.y >= 0 && r.x + r.width <= atlas.width() &&
                r.y + r.height <= atlas.height());
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_TRUE(apart(r, packed[j].rect)) << "textures lie over one another";
  }
}

// The plain rule, leaf by leaf in order of descent: what no pruning may change.
std::optional<Rect> first_fit(const Atlas& atlas, int width, int height) {
  for (const AtlasNodeView& n : nodes_of(atlas))
    if (n.leaf && !n.texture && n.rect.width >= width && n.rect.height >= height) return n.rect;
  return std::nullopt;
}

TEST(Atlas, PacksRandomTexturesBesideOneAnother) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Atlas atlas(static_cast<int>(random.whole(1, 300)), static_cast<int>(random.whole(1, 300)));
    const int largest = static_cast<int>(random.whole(1, 120));
    std::vector<Packed> packed;
    for (TextureId id = 0; id < 150; ++id) {
      const int width = static_cast<int>(random.whole(1, largest));
      const int height = static_cast<int>(random.whole(1, largest));
      const auto leaf = first_fit(atlas, width, height);
      EXPECT_EQ(atlas.has_room(width, height), leaf.has_value());
      const std::string before = text_of(atlas);
      const auto rect = atlas.insert(id, width, height);
      ASSERT_EQ(rect.has_value(), leaf.has_value()) << "refused although there was room";
      if (!rect) {
        EXPECT_EQ(text_of(atlas), before) << "a refusal left its mark";
        continue;
      }
      EXPECT_EQ(*rect, (Rect{leaf->x, leaf->y, width, height})) << "not the first leaf that fits";
      packed.push_back({id, *rect});
    }
    expect_sound(atlas, packed);
  }
}

TEST(Atlas, TheLecturesExample) {
  Atlas atlas(512, 512);
  EXPECT_EQ(atlas.insert(0, 200, 300), (Rect{0, 0, 200, 300}));
  auto nodes = nodes_of(atlas);
  ASSERT_EQ(nodes.size(), 5u);
  EXPECT_TRUE(nodes[0].cut_vertically) << "more room to spare sideways: the first cut is vertical";
  EXPECT_EQ(nodes[1].rect, (Rect{0, 0, 200, 512}));
  EXPECT_EQ(nodes[2].texture, 0u);
  EXPECT_EQ(nodes[3].rect, (Rect{0, 300, 200, 212})) << "the left free leaf";
  EXPECT_EQ(nodes[4].rect, (Rect{200, 0, 312, 512})) << "the right child";

  std::vector<std::pair<Kind, std::uint32_t>> told;
  const auto listen = [&](const AtlasEvent& e) { told.emplace_back(e.kind, e.node); };
  EXPECT_EQ(atlas.insert(1, 312, 240, listen), (Rect{200, 0, 312, 240}));
  EXPECT_EQ(told, (std::vector<std::pair<Kind, std::uint32_t>>{{Kind::used, nodes[2].handle},
                                                               {Kind::too_small, nodes[3].handle},
                                                               {Kind::cut, nodes[4].handle},
                                                               {Kind::store, 5}}));
  nodes = nodes_of(atlas);
  ASSERT_EQ(nodes.size(), 7u);
  EXPECT_EQ(nodes[6].rect, (Rect{200, 240, 312, 272})) << "C stays free";
  EXPECT_FALSE(nodes[6].texture.has_value());
}

TEST(Atlas, ARectOfNothingIsEmpty) { EXPECT_EQ(Rect{}, (Rect{0, 0, 0, 0})); }

TEST(Atlas, AnExactFitIsNotCut) {
  Atlas atlas(64, 32);
  EXPECT_EQ(atlas.insert(7, 64, 32), (Rect{0, 0, 64, 32}));
  EXPECT_EQ(nodes_of(atlas).size(), 1u);
  EXPECT_EQ(atlas.free_area(), 0);
  EXPECT_FALSE(atlas.insert(8, 1, 1).has_value());

  Atlas tall(64, 32);
  tall.insert(1, 64, 10);  // nothing to spare on x: a single cut
  EXPECT_EQ(nodes_of(tall).size(), 3u);
}

TEST(Atlas, ARefusalIsToldAndHandlesStay) {
  Atlas atlas(100, 100);
  atlas.insert(0, 60, 60);
  const std::string before = text_of(atlas);
  std::vector<Kind> told;
  EXPECT_FALSE(atlas.insert(1, 70, 70, [&](const AtlasEvent& e) {
    EXPECT_EQ(e.texture, 1u);
    if (e.kind == Kind::refuse) {
      EXPECT_EQ(e.node, 0u) << "the whole atlas refuses";
    }
    EXPECT_EQ(text_of(atlas), before) << "an event before the refusal already shows a change";
    told.push_back(e.kind);
  }));
  EXPECT_EQ(told, (std::vector<Kind>{Kind::used, Kind::too_small, Kind::too_small, Kind::refuse}));
  EXPECT_EQ(text_of(atlas), before);
  EXPECT_FALSE(atlas.has_room(70, 70));
  EXPECT_TRUE(atlas.has_room(60, 40));
  EXPECT_FALSE(atlas.insert(1, 101, 1)) << "wider than the atlas";

  std::map<std::uint32_t, std::pair<int, int>> corner;
  for (const auto& n : nodes_of(atlas)) corner[n.handle] = {n.rect.x, n.rect.y};
  atlas.insert(2, 10, 10);
  for (const auto& n : nodes_of(atlas)) {
    if (corner.contains(n.handle)) {
      EXPECT_EQ(corner[n.handle], (std::pair{n.rect.x, n.rect.y})) << "a handle changed its node";
    }
  }
}

TEST(Atlas, WatchingChangesNeitherPlacesNorCounts) {
  Atlas watched(256, 256), alone(256, 256);
  Random random(2);
  std::uint64_t leaves_told = 0;
  for (TextureId id = 0; id < 200; ++id) {
    const int width = static_cast<int>(random.whole(1, 50));
    const int height = static_cast<int>(random.whole(1, 50));
    // The leaves before the one found, all of them and in order of descent.
    std::vector<std::uint32_t> expected, told;
    for (const auto& n : nodes_of(watched)) {
      if (!n.leaf) continue;
      if (!n.texture && n.rect.width >= width && n.rect.height >= height) break;
      expected.push_back(n.handle);
    }
    watched.insert(id, width, height, [&](const AtlasEvent& e) {
      if (e.kind == Kind::used || e.kind == Kind::too_small) told.push_back(e.node);
    });
    EXPECT_EQ(told, expected);
    leaves_told += told.size();
    alone.insert(id, width, height);
  }
  EXPECT_EQ(text_of(watched), text_of(alone));
  EXPECT_EQ(watched.leaf_tests(), alone.leaf_tests());
  EXPECT_LT(watched.leaf_tests(), leaves_told) << "no branch without room was passed by";
}

TEST(Atlas, AsMuchToSpareOnBothAxesIsCutAcross) {
  Atlas atlas(10, 10);
  atlas.insert(0, 4, 4);
  const auto nodes = nodes_of(atlas);
  EXPECT_FALSE(nodes[0].cut_vertically);
  EXPECT_EQ(nodes[1].rect, (Rect{0, 0, 10, 4}));
}

// Leaves that a search looks at which knows, of each node, the widest and the highest free leaf
// below it: by the same descent over nodes whose free sizes are gathered anew.
std::uint64_t least_leaf_tests(const Atlas& atlas, int width, int height) {
  const auto nodes = nodes_of(atlas);
  std::vector<std::pair<int, int>> free(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const AtlasNodeView& n = nodes[i];
    if (n.leaf && !n.texture) free[i] = {n.rect.width, n.rect.height};
    if (i == 0) break;
    free[n.parent].first = std::max(free[n.parent].first, free[i].first);
    free[n.parent].second = std::max(free[n.parent].second, free[i].second);
  }
  std::uint64_t tests = 0;
  std::vector<bool> entered(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i > 0 && !entered[nodes[i].parent]) continue;
    tests += nodes[i].leaf;
    entered[i] = width <= free[i].first && height <= free[i].second;
    if (entered[i] && nodes[i].leaf) break;
  }
  return tests;
}

TEST(Atlas, LooksOnlyWhereThereMayBeRoom) {
  Atlas atlas(200, 200);
  EXPECT_EQ(atlas.leaf_tests(), 0u);
  Random random(3);
  for (TextureId id = 0; id < 120; ++id) {
    const int width = static_cast<int>(random.whole(1, 60));
    const int height = static_cast<int>(random.whole(1, 60));
    const std::uint64_t before = atlas.leaf_tests(), least = least_leaf_tests(atlas, width, height);
    atlas.has_room(width, height);
    ASSERT_EQ(atlas.leaf_tests() - before, least) << "texture " << id;
    atlas.insert(id, width, height);
    ASSERT_EQ(atlas.leaf_tests() - before, 2 * least) << "texture " << id;
  }
}

TEST(Atlas, AVetoSkipsTheBranch) {
  Atlas atlas(512, 512);
  atlas.insert(0, 200, 300);
  std::vector<std::uint32_t> seen;
  atlas.visit([&](const AtlasNodeView& view) {
    seen.push_back(view.handle);
    return view.depth == 0;
  });
  EXPECT_EQ(seen, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Atlas, BadSizesAreRefused) {
  for (const auto& [width, height] : {std::pair{0, 5}, {5, 0}, {-1, 5}, {65537, 5}, {5, 65537}})
    EXPECT_THROW(Atlas(width, height), Refused) << width << " x " << height;
  for (const auto& [width, height] : {std::pair{1, 5}, {5, 1}, {1, 1}, {65536, 1}, {1, 65536}})
    EXPECT_TRUE(Atlas(width, height).insert(0, width, height)) << width << " x " << height;
  Atlas atlas(65536, 65536);
  EXPECT_EQ(atlas.free_area(), std::int64_t{1} << 32) << "areas need more than 32 bits";
  EXPECT_THROW(atlas.insert(0, 0, 5), Refused);
  EXPECT_THROW(atlas.insert(0, 5, 0), Refused);
  EXPECT_THROW(atlas.insert(0, 5, -1), Refused);
  EXPECT_EQ(nodes_of(atlas).size(), 1u);
}

// A tree as deep as it is wide: recursion would exhaust the stack.
TEST(Atlas, ThousandsOfNarrowTexturesMakeADeepTree) {
  Atlas atlas(4096, 16);
  for (TextureId id = 0; id < 4096; ++id) {
    ASSERT_TRUE(atlas.insert(id, 1, 16));
    const std::uint64_t tests = atlas.leaf_tests();
    EXPECT_FALSE(atlas.has_room(4096 - static_cast<int>(id), 16));
    EXPECT_EQ(atlas.leaf_tests(), tests) << "the root does not know the widest free leaf";
  }
  EXPECT_EQ(atlas.free_area(), 0);
  const auto nodes = nodes_of(atlas);
  EXPECT_EQ(nodes.size(), 2u * 4096 - 1);
  EXPECT_EQ(nodes.back().depth, 4095u);
}

TEST(Atlas, TenThousandTextures) {
  Atlas atlas(8192, 8192);
  Random random(1);
  std::vector<Packed> packed;
  for (TextureId id = 0; id < 10'000; ++id) {
    const int width = static_cast<int>(random.whole(8, 100));
    const auto rect = atlas.insert(id, width, static_cast<int>(random.whole(8, 100)));
    ASSERT_TRUE(rect.has_value());
    packed.push_back({id, *rect});
  }
  // Each with each would be 5e7 comparisons: sorted by x, only neighbours can overlap.
  std::sort(packed.begin(), packed.end(),
            [](const Packed& a, const Packed& b) { return a.rect.x < b.rect.x; });
  std::uint64_t overlaps = 0;
  for (std::size_t i = 0; i < packed.size(); ++i)
    for (std::size_t j = i + 1;
         j < packed.size() && packed[j].rect.x < packed[i].rect.x + packed[i].rect.width; ++j)
      overlaps += !apart(packed[i].rect, packed[j].rect);
  EXPECT_EQ(overlaps, 0u);
}

}  // namespace
}  // namespace lantern::atlas
