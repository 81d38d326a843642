#include "atlas/packer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "atlas/atlas.hpp"
#include "base/error.hpp"
#include "base/random.hpp"

namespace lantern::atlas {
namespace {

std::vector<TextureSize> random_sizes(std::size_t count, TextureSize least, TextureSize most,
                                      std::uint64_t seed) {
  Random random(seed);
  std::vector<TextureSize> sizes(count);
  for (TextureSize& size : sizes) {
    size.width = static_cast<int>(random.whole(least.width, most.width));
    size.height = static_cast<int>(random.whole(least.height, most.height));
  }
  return sizes;
}

// What must hold of any packing: sizes right, all inside one of the leaves, none over another.
void expect_sound(const std::vector<std::optional<TexturePlace>>& places,
                  const std::vector<TextureSize>& sizes, const std::vector<Rect>& leaves,
                  bool turn) {
  ASSERT_EQ(places.size(), sizes.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    const Rect& r = places[i]->rect;
    const TextureSize held =
        places[i]->turned ? TextureSize{r.height, r.width} : TextureSize{r.width, r.height};
    EXPECT_EQ(held, sizes[i]);
    EXPECT_TRUE(turn || !places[i]->turned) << "turned although it may not be";
    EXPECT_TRUE(std::ranges::any_of(leaves,
                                    [&](const Rect& leaf) {
                                      return r.x >= leaf.x && r.y >= leaf.y &&
                                             r.x + r.width <= leaf.x + leaf.width &&
                                             r.y + r.height <= leaf.y + leaf.height;
                                    }))
        << "texture " << i << " lies outside";
    for (std::size_t j = 0; j < i; ++j) {
      if (!places[j]) continue;
      const Rect& s = places[j]->rect;
      EXPECT_TRUE(r.x + r.width <= s.x || s.x + s.width <= r.x || r.y + r.height <= s.y ||
                  s.y + s.height <= r.y)
          << i << " lies over " << j;
    }
  }
}

bool equal(const Packing& a, const Packing& b) {
  return a.complete == b.complete && a.packed_area == b.packed_area && a.trials == b.trials &&
         a.leaf_tests == b.leaf_tests &&
         std::ranges::equal(a.steps, b.steps, [](const PackStep& s, const PackStep& t) {
           return s.kind == t.kind && s.turned == t.turned && s.value == t.value;
         });
}

std::int64_t area_of(const std::vector<TextureSize>& sizes) {
  std::int64_t sum = 0;
  for (const TextureSize& size : sizes) sum += std::int64_t{size.width} * size.height;
  return sum;
}

TEST(Packer, PacksRandomTexturesIntoRandomLeaves) {
  std::size_t complete = 0, unfinished = 0, turned = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const int most = static_cast<int>(random.whole(1, 60));
    const bool turn = seed % 2 == 1;
    const auto sizes = random_sizes(seed % 3 == 0 ? 300 : 80, {1, 1},
                                    {most, static_cast<int>(random.whole(1, 60))}, seed);
    std::vector<Rect> leaves;
    for (int x = 0; x < 700;) {  // side by side
      const int width = static_cast<int>(random.whole(1, 300));
      leaves.push_back({x, 5, width, static_cast<int>(random.whole(1, 250))});
      x += width;
    }
    Packer packer(sizes, turn);
    const Packing packing = packer.pack_most(leaves);
    EXPECT_TRUE(equal(packing, Packer(sizes, turn).pack_most(leaves))) << "not the same again";
    for (const PackStep& step : packing.steps) {
      EXPECT_TRUE(turn || !step.turned);
      EXPECT_TRUE(step.kind == PackStep::Kind::store || !step.turned) << "nothing to turn";
    }
    const auto places = places_of(packing, leaves, sizes.size());
    expect_sound(places, sizes, leaves, turn);
    std::int64_t packed = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      if (places[i]) packed += area_of({sizes[i]});
      turned += places[i] && places[i]->turned;
    }
    EXPECT_EQ(packed, packing.packed_area);
    EXPECT_EQ(packing.complete, packed == packer.area());
    (packing.complete ? complete : unfinished) += 1;
    const Packing all = packer.pack(leaves);
    EXPECT_EQ(all.complete, packing.complete) << "packs all only if it need not";
    EXPECT_TRUE(all.complete || all.steps.empty());
  }
  EXPECT_GT(complete, 5u);
  EXPECT_GT(unfinished, 5u);
  EXPECT_GT(turned, 100u);
}

// Of what is not packed, nothing would have fitted any leaf that is left.
TEST(Packer, WhatIsRefusedFitsNowhere) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const bool turn = seed % 2 == 1;
    const auto sizes = random_sizes(200, {1, 1}, {40, 30}, seed);
    std::vector<TextureId> ids(sizes.size());
    std::iota(ids.begin(), ids.end(), 100u);
    Atlas atlas(200, 220);
    const auto places = atlas.insert_all(ids, sizes, turn);
    expect_sound(places, sizes, {{0, 0, 200, 220}}, turn);
    std::size_t refused = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      if (places[i]) continue;
      ++refused;
      EXPECT_FALSE(atlas.has_room(sizes[i].width, sizes[i].height));
    }
    EXPECT_GT(refused, 0u);
  }
}

std::vector<TextureSize> named_set(const std::string& name, std::size_t count) {
  if (name == "square") return random_sizes(count, {1, 1}, {64, 64}, 1);
  if (name == "tall") return random_sizes(count, {2, 10}, {9, 209}, 1);
  if (name == "glyphs") return random_sizes(count, {6, 12}, {19, 21}, 1);
  std::vector<TextureSize> sizes = random_sizes(count, {0, 0}, {6, 6}, 1);  // powers of two
  for (TextureSize& size : sizes) size = {1 << size.width, 1 << size.height};
  return sizes;
}

// The first side, from that of the area, by steps of 0.2 %, that all fit into.
int smallest_side(const std::vector<TextureSize>& sizes, bool turn, std::uint64_t& leaf_tests) {
  Packer packer(sizes, turn);
  int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(packer.area()))));
  for (;; side = std::max(side + 1, static_cast<int>(std::ceil(side * 1.002)))) {
    const std::vector<Rect> leaf{{0, 0, side, side}};
    const Packing packing = packer.pack(leaf);
    leaf_tests += packing.leaf_tests;
    if (packing.complete) return side;
  }
}

// Whole numbers, equal on every machine: what fills worse or takes more work shows here.
TEST(Packer, FillsAsMuchWithAsMuchWorkAsItDid) {
  struct Known {
    const char* name;
    std::size_t count;
    int side, turned_side;
    std::uint64_t leaf_tests;  // of both
  };
  for (const Known& known : std::vector<Known>{{"square", 500, 741, 739, 31455},
                                               {"powers", 500, 425, 425, 4465},
                                               {"tall", 500, 563, 563, 2448},
                                               {"glyphs", 500, 327, 327, 13758},
                                               {"square", 5000, 2296, 2296, 85069},
                                               {"powers", 5000, 1294, 1294, 42485},
                                               {"tall", 5000, 1747, 1747, 10644},
                                               {"glyphs", 5000, 1023, 1023, 135367}}) {
    SCOPED_TRACE(std::string(known.name) + " " + std::to_string(known.count));
    const auto sizes = named_set(known.name, known.count);
    std::uint64_t leaf_tests = 0;
    EXPECT_EQ(smallest_side(sizes, false, leaf_tests), known.side);
    EXPECT_EQ(smallest_side(sizes, true, leaf_tests), known.turned_side);
    EXPECT_EQ(leaf_tests, known.leaf_tests);
  }
}

TEST(Packer, FewerTrialsAreTheFirstOfAll) {
  const auto sizes = random_sizes(90, {1, 1}, {50, 50}, 4);
  const std::vector<Rect> leaf{{0, 0, 200, 200}};  // less than their area
  Packer packer(sizes, true);
  std::int64_t last = 0;
  for (std::size_t trials = 0; trials <= trial_count(true) + 1; ++trials) {
    const Packing packing = packer.pack_most(leaf, trials);
    EXPECT_EQ(packing.trials, std::clamp<std::size_t>(trials, 1, trial_count(true)));
    EXPECT_GE(packing.packed_area, last) << "more trials pack less";
    last = packing.packed_area;
  }
  EXPECT_EQ(trial_count(true), 3 * trial_count(false));
}

TEST(Packer, EqualTexturesOfTheLeavesSizeFillIt) {
  const std::vector<TextureSize> sizes(12, {10, 20});
  const std::vector<Rect> leaf{{0, 0, 40, 60}};
  Packer packer(sizes);
  const Packing packing = packer.pack(leaf);
  EXPECT_TRUE(packing.complete);
  EXPECT_EQ(packing.trials, 1u);
  const std::vector<Rect> narrow{{0, 0, 39, 60}};
  EXPECT_EQ(packer.pack(narrow).trials, 0u) << "less area than the textures have";
  const Packing most = packer.pack_most(narrow);
  EXPECT_FALSE(most.complete);
  EXPECT_EQ(most.packed_area, 9 * 200);
}

// Rows 8 high, of which the last is filled up by 5 and 3: rows of 7, which come first, would waste.
TEST(Packer, SixTexturesOfAHeightAreRowsThatAreSplitAtOnce) {
  std::vector<TextureSize> sizes;
  for (const TextureSize size : {TextureSize{8, 8}, {8, 7}, {4, 5}, {4, 3}})
    sizes.insert(sizes.end(), 6, size);
  const std::vector<Rect> leaves{{0, 0, 72, 8}, {0, 8, 48, 7}};
  const Packing packing = Packer(sizes).pack(leaves);
  EXPECT_TRUE(packing.complete);
  EXPECT_EQ(packing.trials, 1u);
  expect_sound(places_of(packing, leaves, sizes.size()), sizes, leaves, false);
  sizes.pop_back();  // five: too few for rows of one height to be tried first
  EXPECT_GT(Packer(sizes).pack(leaves).trials, 1u);
}

// As many of each list as a power of two, so that none has room to spare.
TEST(Packer, CountsTheBytesItHolds) {
  std::vector<TextureSize> sizes;
  for (int height = 1; height <= 32; ++height)
    for (int width = 1; width <= 32; ++width) sizes.push_back({width, height});
  Packer packer(sizes);
  const std::uint64_t n = sizes.size(), alone = n * sizeof(TextureSize);
  EXPECT_EQ(packer.bytes(), alone);
  packer.pack(std::vector<Rect>{{0, 0, 1000, 1000}}, 1);
  // Of each kind also its place in the order, how many are left, and how wide they are.
  // Of sixteen kinds each how wide the narrowest is, and of each height, 0 too, its class.
  const std::uint64_t least = n * (sizeof(Stock::Kind) + 12) + 32 * sizeof(Stock::HeightClass) +
                              n / 16 * sizeof(int) + 33 * sizeof(std::uint32_t);
  EXPECT_GE(packer.bytes(), alone + least);
  EXPECT_LE(packer.bytes(), alone + least + n);
}

TEST(Packer, OnlyTurnedOnesFit) {
  const std::vector<TextureSize> sizes{{30, 10}, {10, 30}};
  const std::vector<Rect> leaf{{3, 4, 20, 30}};
  EXPECT_FALSE(Packer(sizes).pack(leaf).complete);
  const Packing packing = Packer(sizes, true).pack(leaf);
  ASSERT_TRUE(packing.complete);
  expect_sound(places_of(packing, leaf, 2), sizes, leaf, true);
}

// Turned or not it is the same rectangle: nobody shall have to turn its picture.
TEST(Packer, ASquareIsNeverTurned) {
  for (const auto& sizes : {std::vector<TextureSize>(4, {10, 10}),
                            std::vector<TextureSize>{{10, 10}, {10, 30}, {30, 10}, {10, 10}}}) {
    Packer packer(sizes, true);
    for (std::size_t trials = 1; trials <= trial_count(true); ++trials) {
      const Packing packing =
          packer.pack_most(std::vector<Rect>{{0, 0, 20, 25}, {20, 0, 10, 40}}, trials);
      for (const PackStep& step : packing.steps)
        EXPECT_FALSE(step.turned && sizes[step.value] == TextureSize(10, 10)) << trials;
    }
  }
  using Hold = Holding::Hold;
  for (const Hold hold : {Hold::as_given, Hold::lying, Hold::standing}) {
    const Stock stock(std::vector<TextureSize>{{10, 10}}, {hold, false});
    EXPECT_FALSE(stock.turns({10, 10}));
    EXPECT_EQ(stock.turns({10, 30}), hold == Hold::lying);
    EXPECT_EQ(stock.turns({30, 10}), hold == Hold::standing);
  }
}

TEST(Stock, NothingIsAsLowAsNoPixel) {
  const Stock stock(std::vector<TextureSize>{{3, 2}, {4, 5}}, {});
  ASSERT_EQ(stock.classes().size(), 2u);
  for (const int height : {0, 1}) {
    EXPECT_EQ(stock.class_up_to(height), 2u) << height;
    EXPECT_EQ(stock.tallest(9, height), Stock::kNone) << height;
  }
  EXPECT_EQ(stock.class_up_to(2), 1u);
  EXPECT_EQ(stock.class_up_to(5), 0u);
  EXPECT_EQ(stock.class_up_to(100), 0u);
}

TEST(Packer, NothingAndBadSizes) {
  const std::vector<Rect> leaf{{0, 0, 8, 8}};
  const Packing nothing = Packer({}).pack_most(leaf);
  EXPECT_TRUE(nothing.complete);
  EXPECT_TRUE(nothing.steps.empty());
  EXPECT_FALSE(Packer(std::vector<TextureSize>{{1, 1}}).pack_most({}).complete);
  for (const TextureSize& size : {TextureSize{0, 1}, {1, 0}, {-1, 1}, {65537, 1}, {1, 65537}})
    EXPECT_THROW(Packer(std::vector<TextureSize>{{1, 1}, size}), Refused);
  const std::vector<TextureSize> largest{{65536, 65536}};
  const std::vector<Rect> room{{0, 0, 65536, 65536}};
  EXPECT_TRUE(Packer(largest).pack(room).complete);
}

// The tree that comes of it: cuts and stores told in the order in which they are done.
TEST(Packer, TheAtlasFollowsThePlan) {
  Atlas atlas(64, 64);
  ASSERT_TRUE(atlas.insert(0, 20, 30));
  const auto sizes = random_sizes(120, {3, 4}, {12, 9}, 9);
  std::vector<TextureId> ids(sizes.size());
  std::iota(ids.begin(), ids.end(), 1u);
  std::vector<TextureId> stored, refused;
  std::optional<TextureId> cut_for;
  const auto places = atlas.insert_all(ids, sizes, true, SIZE_MAX, [&](const AtlasEvent& event) {
    if (event.kind == AtlasEvent::Kind::cut) cut_for = event.texture;
    if (event.kind == AtlasEvent::Kind::store) {
      EXPECT_TRUE(!cut_for || *cut_for == event.texture) << "cut for another";
      cut_for.reset();
      stored.push_back(event.texture);
    }
    if (event.kind == AtlasEvent::Kind::refuse) refused.push_back(event.texture);
  });
  EXPECT_EQ(stored.size() + refused.size(), sizes.size());
  EXPECT_GT(refused.size(), 0u);
  const std::vector<Rect> leaves{{0, 30, 20, 34}, {20, 0, 44, 64}};  // in order of descent
  const auto planned = places_of(Packer(sizes, true).pack_most(leaves), leaves, sizes.size());
  std::size_t planned_count = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!planned[i]) continue;
    ++planned_count;
    ASSERT_TRUE(places[i]);
    EXPECT_EQ(places[i]->rect, planned[i]->rect) << "not where the plan has it";
    EXPECT_EQ(places[i]->turned, planned[i]->turned);
  }
  EXPECT_GT(planned_count, 30u);
  expect_sound(places, sizes, {{20, 0, 44, 64}, {0, 30, 20, 34}}, true);
  std::int64_t free = 0;
  int widest = 0;
  atlas.visit([&](const AtlasNodeView& node) {
    EXPECT_GT(std::min(node.rect.width, node.rect.height), 0) << "a leaf without any room";
    if (!node.leaf || node.texture) return true;
    free += std::int64_t{node.rect.width} * node.rect.height;
    widest = std::max(widest, node.rect.width);
    return true;
  });
  EXPECT_EQ(free, atlas.free_area());
  ASSERT_GT(free, 0);
  EXPECT_TRUE(atlas.has_room(widest, 1));
  EXPECT_FALSE(atlas.has_room(widest + 1, 1)) << "a stale size of a free leaf";
}

}  // namespace
}  // namespace lantern::atlas
