// What a sequence owes to whoever looks at it: every frame shows something, another picture than
// the one before it, and a sentence that does not stand too long.
#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "draw/page.hpp"
#include "draw/sample_frames.hpp"
#include "frame/parts/atlas.hpp"
#include "frame/parts/level.hpp"
#include "scenario/directing.hpp"

namespace lantern::draw {
namespace {

constexpr std::size_t kMostFramesOfASentence = 6;

// All but the title, the caption and the counters.
std::vector<DrawShape> picture_of(const DrawList& list) {
  std::vector<DrawShape> picture;
  for (std::size_t i = 0; i < list.runs.size(); ++i) {
    if (list.runs[i].key == "page/words") continue;
    const std::size_t end = i + 1 < list.runs.size() ? list.runs[i + 1].first : list.shapes.size();
    picture.insert(picture.end(), list.shapes.begin() + std::ptrdiff_t(list.runs[i].first),
                   list.shapes.begin() + std::ptrdiff_t(end));
  }
  return picture;
}

// Without its numbers: "0.50 s: 2 nodes" and "0.75 s: 3 nodes" are one sentence.
std::string sentence_of(const Frame& frame) {
  std::string words;
  for (const char c : frame.caption)
    if (!std::isdigit(static_cast<unsigned char>(c))) words += c;
  return words;
}

bool is_blank(const Frame& frame) {
  return frame.sides.empty() && shows(frame.panels, "world") && frame.bodies.empty() &&
         !frame.find<FrameLevel>() && !frame.find<FrameTextures>();
}

// The frames that break a rule, each with what it does.
std::vector<std::string> faults_of(const std::vector<Frame>& frames) {
  std::vector<std::string> faults;
  const auto tell = [&](const Frame& frame, const char* fault) {
    faults.push_back("frame " + std::to_string(frame.index) + " " + fault);
  };
  std::size_t stands = 0, next = 0;
  std::optional<Staging> staging;
  std::vector<DrawShape> before;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i == next) {  // a group begins
      const auto group = Staging::first_group(std::span(frames).subspan(i));
      next += group.size();
      staging.emplace(group);
    }
    Work work;
    std::vector<DrawShape> now =
        picture_of(draw_frame(frames[i], *staging, page_for(1600, 900), work));
    if (i > 0 && now == before) tell(frames[i], "has the picture of the one before");
    if (is_blank(frames[i])) tell(frames[i], "shows an empty world");
    const bool same = i > 0 && frames[i].step == frames[i - 1].step &&
                      sentence_of(frames[i]) == sentence_of(frames[i - 1]);
    stands = same ? stands + 1 : 1;
    if (stands == kMostFramesOfASentence + 1) tell(frames[i], "has a sentence for too long");
    before = std::move(now);
  }
  return faults;
}

// Those that are not well made yet. None may join them, and one that is mended leaves.
const std::set<std::string> kToBeMended = {};

class EveryCourse : public testing::TestWithParam<std::string> {};

TEST_P(EveryCourse, IsWellMade) {
  const std::vector<std::string> faults = faults_of(run::frames_of(GetParam()));
  if (kToBeMended.contains(GetParam()))
    EXPECT_FALSE(faults.empty()) << GetParam() << " is mended: take it off the list";
  else
    EXPECT_TRUE(faults.empty()) << GetParam() << ": " << faults.size() << " faults, first "
                                << faults.front();
}

INSTANTIATE_TEST_SUITE_P(Scenarios, EveryCourse, testing::ValuesIn(run::all_scenarios()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace lantern::draw
