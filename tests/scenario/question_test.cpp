// `question` and `answer`: what the students are asked, and the frame that answers it.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frame/frame.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

const std::string kAskBodies =
    "[[body]]\nname = \"red\"\nradius = 1\nposition = [1, 1]\nvelocity = [6, 0]\n"
    "[[body]]\nname = \"pink\"\nradius = 1\nposition = [2, 2]\n";

std::string asking(const std::string& sides, const std::string& keys) {
  return "title = \"x\"\n[world]\nsize = [64, 64]\n" + kTree + sides + kAskBodies +
         "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"pink\"]\n"
         "[[step]]\ndo = \"run\"\nseconds = 0.1\nevery = 2\n" +
         keys;
}

TEST(Question, StandsOnTheFrameThatAnswersItWithItsCounts) {
  const auto frames = frames_of(good(asking(
      "", "question = \"How many?\"\nanswer = \"{pairs:pair}.\"\nexpect = { pairs = 1 }\n")));
  ASSERT_EQ(frames.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(frames[i].find<FrameQuestion>());
  ASSERT_TRUE(frames[3].find<FrameQuestion>());
  EXPECT_EQ(frames[3].find<FrameQuestion>()->asked, "How many?");
  EXPECT_EQ(frames[3].find<FrameQuestion>()->answer, "1 pair.");
  EXPECT_NE(
      to_json(frames[3]).find("\"question\": {\"asked\": \"How many?\", \"answer\": \"1 pair.\"}"),
      std::string::npos);
}

TEST(Question, IsOfAllSidesTogether) {
  const auto frames = frames_of(good(
      asking("[[side]]\nname = \"one\"\n[[side]]\nname = \"none\"\nstructure = { capacity = 1 }\n",
             "question = \"Where?\"\nanswer = \"{one.nodes}, {none.nodes}.\"\nexpect.one = { nodes "
             "= 1 }\n")));
  const Frame& last = frames.back();
  ASSERT_TRUE(last.find<FrameQuestion>());
  EXPECT_EQ(last.find<FrameQuestion>()->answer, std::to_string(*last.count("one.nodes")) + ", " +
                                                    std::to_string(*last.count("none.nodes")) +
                                                    ".");
  for (const Frame& side : last.sides) EXPECT_FALSE(side.find<FrameQuestion>());
}

TEST(Question, HasAnAnswerAndTheAnswerAProof) {
  expect_mistakes(asking("", "@question = \"Why?\"\n"), {"without an 'answer'"});
  expect_mistakes(asking("", "@answer = \"So.\"\n"), {"without a 'question'"});
  expect_mistakes(asking("", "@question = \"Why?\"\nanswer = \"So.\"\n"), {"proved by nothing"});
  expect_mistakes(
      asking("", "question = \"Why?\"\nanswer = \"@{paris}.\"\nexpect = { pairs = 1 }\n"),
      {"cannot quote 'paris'"});
}

}  // namespace
}  // namespace lantern::run
