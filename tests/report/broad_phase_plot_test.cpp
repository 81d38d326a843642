// The page of capacity and depth limit: everything is on it, and nothing covers anything.
#include <algorithm>

#include <gtest/gtest.h>

#include "draw/draw_list.hpp"
#include "draw/layout_check.hpp"
#include "report/benches.hpp"
#include "report/pages.hpp"

namespace lantern::report {
namespace {

BroadPhaseCostConfig config_of(int repeats) {
  BroadPhaseCostConfig config;
  config.timing = {repeats, 0};
  return config;
}

void expect_readable(const DrawList& list, const std::string& what) {
  for (std::size_t i = 0; i < list.labels.size(); ++i) {
    const LabelBox& a = list.labels[i];
    EXPECT_TRUE(holds(a.panel, a.box)) << what << ": '" << a.text << "' leaves its panel";
    EXPECT_TRUE(holds({Vec<2>(0.0), list.page}, a.box)) << what << ": '" << a.text << "'";
    for (std::size_t j = i + 1; j < list.labels.size(); ++j) {
      const LabelBox& b = list.labels[j];
      const Vec<2> lo = glm::max(a.box.lo, b.box.lo), hi = glm::min(a.box.hi, b.box.hi);
      EXPECT_FALSE(lo.x < hi.x && lo.y < hi.y)
          << what << ": '" << a.text << "' lies on '" << b.text << "'";
    }
  }
  for (const DrawShape& shape : list.shapes)
    if (const auto* text = std::get_if<TextShape>(&shape)) {
      EXPECT_GE(text->size, kLeastDeskLabel) << text->text << " is too small for a lecture";
    }
}

TEST(BroadPhasePage, NothingCoversAnything) {
  for (const BoxScene& scene : seeded_box_scenes(120, 1))
    for (const int repeats : {0, 1}) {
      const auto rows = measure_broad_phases(scene, config_of(repeats), [] {});
      for (const StructureKind kind :
           {StructureKind::quadtree, StructureKind::octree, StructureKind::kd_tree})
        expect_readable(draw_broad_phase_page(rows, scene, kind), scene.name);
    }
}

TEST(BroadPhasePage, TheCheapestCellIsNamed) {
  const BoxScene scene = seeded_box_scenes(120, 2)[1];
  const auto rows = measure_broad_phases(scene, config_of(0), [] {});
  const BroadPhaseCost* best = cheapest(rows, scene.name, StructureKind::quadtree, CostBy::work);
  const DrawList list = draw_broad_phase_page(rows, scene, StructureKind::quadtree);
  const auto numbers =
      std::ranges::count(list.labels, std::to_string(best->counts.work()), &LabelBox::text);
  EXPECT_EQ(numbers, 3) << "its cell, its line of the list and that of the lecture's quadtree";
  EXPECT_TRUE(says_part(list, "brute force")) << "nothing to hold it against";
  const auto frames = std::ranges::count_if(list.shapes, [](const DrawShape& shape) {
    const auto* rect = std::get_if<RectShape>(&shape);
    return rect != nullptr && rect->stroke.role == Role::lit;
  });
  EXPECT_EQ(frames, 1) << "one cell is marked";
}

TEST(BroadPhasePage, WithoutRowsItSaysSo) {
  const BoxScene scene = seeded_box_scenes(2, 3)[0];
  const DrawList list = draw_broad_phase_page({}, scene, StructureKind::quadtree);
  EXPECT_TRUE(says_part(list, "Nothing was measured."));
  expect_readable(list, "empty");
}

TEST(BroadPhaseTexts, TellEveryRowAndTheCheapestInTheTable) {
  BroadPhaseResult result;
  result.config.scenes = {seeded_box_scenes(100, 10)[1]};
  result.config.capacities = {1, 8};
  result.config.depth_limits = {3};
  result.config.timing.repeats = 0;
  const BoxScene& scene = result.config.scenes[0];
  result.rows = measure_broad_phases(scene, result.config, [] {});
  const Texts texts = texts_of(result);
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(texts.csv, '\n')), result.rows.size() + 1);
  EXPECT_NE(texts.json.find("\"lantern.measure.broad_phase/2\""), std::string::npos);
  EXPECT_NE(texts.json.find("\"words\": \"" + scene.words), std::string::npos) << texts.json;
  for (const char* words : {"clustered_2d", "quadtree", "depth limit 3", "false/true"})
    EXPECT_NE(texts.table.find(words), std::string::npos) << words << texts.table;
}

}  // namespace
}  // namespace lantern::report
