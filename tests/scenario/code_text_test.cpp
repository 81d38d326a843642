// The lecture's source as frames show it: what is shown stands so in the files that were compiled.
#include "language/code_text.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frame/parts/panels.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

std::vector<std::string> lines_of(const std::string& file) {
  std::istringstream text(read_text(std::string(LANTERN_ROOT) + "/src/lecture/" + file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

// Without comments and spaces.
std::string bare(std::string text) {
  text.resize(std::min(text.find("//"), text.size()));
  std::erase(text, ' ');
  return text;
}

// All that stands in a function's lines is shown, but for comments and what only this program
// needs, and nothing else is.
TEST(CodeText, ShowsWhatStandsInItsFile) {
  ASSERT_GT(code_functions().size(), 15u);
  for (const std::string& name : code_functions()) {
    const FrameCode code = *code_of(name);
    const std::vector<std::string> file = lines_of(code.file);
    const std::uint32_t first = code.lines.front().number, last = code.lines.back().number;
    std::string shown, written;
    for (const FrameCode::Line& line : code.lines) shown += bare(line.text);
    for (std::uint32_t number = first; number <= last; ++number) {
      const std::string line = bare(file.at(number - 1));
      if (!line.starts_with("watch.") && !line.starts_with("stop_if_asked")) written += line;
    }
    EXPECT_EQ(shown.substr(0, written.size()), written) << name;
    EXPECT_TRUE(shown.ends_with('}')) << name;
  }
}

// Where the tree tells its watcher of an event, the line before has done it.
TEST(CodeText, PlacesEventsWhereTheWatcherIsTold) {
  const std::map<std::string, std::string> calls = {{"test", "watch.Tested("},
                                                    {"store", "watch.Stored("},
                                                    {"split", "watch.Split("},
                                                    {"hand_down", "watch.HandedDown("}};
  for (const auto& [event, call] : calls) {
    const auto place = code_place(event);
    ASSERT_TRUE(place) << event;
    FrameCode code = *code_of(place->function);
    ASSERT_EQ(light_line(code, place->line), 1u) << event;
    for (const FrameCode::Line& line : code.lines)
      if (line.lit) {
        const auto lines = lines_of(code.file);  // one before it, and one behind
        const std::string near = lines.at(line.number - 2) + lines.at(line.number);
        EXPECT_NE(near.find(call), std::string::npos) << event;
      }
  }
  for (const char* event :
       {"miss", "make_child", "depth_limit", "broad_phase", "narrow_phase", "solve"}) {
    const auto place = code_place(event);
    FrameCode code = *code_of(place->function);
    EXPECT_GT(light_line(code, place->line), 0u) << event;
  }
  EXPECT_FALSE(code_place("rotate"));
}

TEST(CodeText, FindsFunctionsWithTheirClassOrWithout) {
  EXPECT_EQ(code_of("Insert")->function, "QuadTreeNode::Insert");
  EXPECT_EQ(code_of("QuadTree::Insert")->function, "QuadTree::Insert");
  EXPECT_EQ(code_of("NarrowPhase")->file, "physics_system.cpp");
  EXPECT_FALSE(code_of("nsert"));
  EXPECT_FALSE(code_of("Node::Insert"));
}

// Frames of events light their own line, the step's last frame the one that it names.
TEST(CodeText, FollowsEventsAndSteps) {
  const auto lit = [](const Frame& frame) {
    std::string text;
    for (const FrameCode::Line& line : frame.find<FrameCode>()->lines)
      if (line.lit) text += line.text;
    return text;
  };
  const std::vector<Frame> frames = frames_of("lecture_code");
  EXPECT_TRUE(lit(at(frames, "two")).starts_with("contents.push_back("));
  EXPECT_EQ(lit(at(frames, "split")), "Split(watch);");
  EXPECT_EQ(lit(at(frames, "three")), "contents.clear();");
  EXPECT_EQ(at(frames, "narrow_phase").find<FrameCode>()->function, "PhysicsSystem::NarrowPhase");
  EXPECT_EQ(at(frames, "answer").find<FrameCode>()->lines.front().lit, false);
}

// framesLeft, by the lecture's rule: five at a touch, one less at the end of each step, and the end
// is told when none is left.
TEST(CollisionLog, CountsDownAsTheLectureDoes) {
  const std::vector<Frame> frames = frames_of("collision_frames");
  const FrameCollisions& told = *frames.back().find<FrameCollisions>();
  ASSERT_EQ(told.remembered, 5);
  ASSERT_EQ(told.rows.size(), 1u);
  int left = -1;
  std::uint64_t step = 0, begins = 0, touches = 0;
  for (const FrameCollision::Moment& m : told.rows[0].moments) {
    EXPECT_TRUE(m.step == step + 1 || left < 0) << "none is left out while it lives";
    EXPECT_EQ(m.begins, m.touches && left < 0) << m.step;
    left = (m.touches ? 5 : left) - 1;
    EXPECT_EQ(m.frames_left, left) << m.step;
    step = m.step;
    begins += m.begins;
    touches += m.touches;
  }
  EXPECT_EQ(left, -1) << "it has ended";
  EXPECT_EQ(frames.back().count("begins_in_all"), static_cast<std::int64_t>(begins));
  EXPECT_EQ(frames.back().count("touches_in_all"), static_cast<std::int64_t>(touches));
}

}  // namespace
}  // namespace lantern::run
