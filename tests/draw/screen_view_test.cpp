// A screen that is drawn from textures: what its rows tell.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "draw/layout_check.hpp"
#include "draw/sample_frames.hpp"

namespace lantern::draw {
namespace {

const Frame& screen_sample(const std::string& name) {
  static const samples::Named all = samples::screens();
  for (const auto& [known, frame] : all)
    if (known == name) return frame;
  throw std::invalid_argument(name);
}

std::ptrdiff_t screen_runs(const DrawList& list, std::string_view prefix) {
  return std::ranges::count_if(list.runs,
                               [&](const KeyedRun& run) { return run.key.starts_with(prefix); });
}

TEST(ScreenPanel, HasAMarkForEachBindingAndASwatchForEachDraw) {
  const DrawList list = samples::page_of(screen_sample("screen_midst"));
  EXPECT_EQ(screen_runs(list, "screen/bind/0."), 4);
  EXPECT_EQ(screen_runs(list, "screen/draw/0."), 4) << "the fifth is bound and not yet drawn";
  EXPECT_EQ(screen_runs(list, "screen/element/"), 4);
  EXPECT_EQ(screen_runs(list, "screen/outline/"), 8);
  EXPECT_TRUE(says(list, "as listed"));
  EXPECT_TRUE(says(list, "bindings"));
  EXPECT_TRUE(says(list, "8 textures, each an image of its own"));
  EXPECT_TRUE(list.referents.contains("bindings"));
}

TEST(ScreenPanel, ShowsAllElementsBeforeTheFirstWay) {
  const DrawList list = samples::page_of(screen_sample("screen_before"));
  EXPECT_EQ(screen_runs(list, "screen/element/"), 12);
  EXPECT_EQ(screen_runs(list, "screen/outline/"), 0);
  EXPECT_FALSE(says(list, "as listed")) << "nothing is told before it happens";
}

}  // namespace
}  // namespace lantern::draw
