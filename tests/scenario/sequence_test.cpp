// A sequence begins calmly and ends with what is to be kept in mind.
#include <algorithm>

#include <gtest/gtest.h>

#include "scenario/directing.hpp"

namespace lantern::run {
namespace {

class EverySequenceTold : public testing::TestWithParam<std::string> {};

TEST_P(EverySequenceTold, BeginsCalmlyAndEndsWithWhatItProves) {
  const std::vector<Frame> frames = frames_of(GetParam());
  ASSERT_FALSE(frames.empty());
  const auto is_lit = [](const FrameNode& node) { return node.mark == Mark::lit; };
  EXPECT_TRUE(std::ranges::none_of(frames.front().nodes, is_lit)) << "nothing has happened yet";
  for (const Frame& side : frames.front().sides)
    EXPECT_TRUE(std::ranges::none_of(side.nodes, is_lit))
        << "on side " << side.get<FrameSide>().name;
  const Frame& last = frames.back();
  EXPECT_TRUE(last.ending);
  EXPECT_FALSE(last.caption.empty());
  EXPECT_TRUE(!last.headline.empty() || last.find<FrameRulers>())
      << "the numbers that prove it, at the foot or on the picture";
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) EXPECT_FALSE(frames[i].ending);
  EXPECT_TRUE(std::ranges::any_of(frames, [](const Frame& f) {
    return f.find<FrameQuestion>() != nullptr;
  })) << "asks nothing of the students";
}

INSTANTIATE_TEST_SUITE_P(Scenarios, EverySequenceTold, testing::ValuesIn(all_scenarios()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace lantern::run
