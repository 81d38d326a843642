// A screen that is drawn from textures and from their atlas.
#include <string>

#include <gtest/gtest.h>

#include "frame/parts/atlas.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

const std::string kScreenScene = R"(title = "t"
[atlas]
size = [32, 16]
screen = [40, 20]
[[texture]]
name = "slot"
size = [10, 10]
[[texture]]
name = "coin"
size = [6, 6]
[[texture_pattern]]
name = "t"
count = 2
min = [4, 4]
max = [4, 4]
)";
const std::string kElements = R"([[element]]
texture = "slot"
at = [0, 0]
[[element]]
texture = "coin"
at = [2, 2]
[[element]]
texture = "slot"
at = [30, 10]
[[element]]
texture = "coin"
at = [32, 12]
)";
const std::string kDrawStep = "[[step]]\ndo = \"draw\"\n";
const std::string kPackStep =
    "[[step]]\ndo = \"pack\"\ntextures = [\"slot\", \"coin\"]\neach = false\n";

TEST(Screen, EachWayCountsItsOwnBindings) {
  const auto frames =
      frames_of(good(kScreenScene + kElements + kDrawStep + kDrawStep + "order = \"by_texture\"\n" +
                     kPackStep + kDrawStep + "from = \"atlas\"\n"));
  ASSERT_EQ(frames.size(), 4u);
  const std::int64_t expected[] = {4, 2, 2, 1};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].count("bindings"), expected[i]) << i;
    EXPECT_EQ(frames[i].count("draws"), 4) << i;
    EXPECT_EQ(frames[i].get<FrameScreen>().planned, 3u);
  }
  const FrameScreen& last = frames.back().get<FrameScreen>();
  ASSERT_EQ(last.ways.size(), 3u);
  EXPECT_EQ(last.ways[0].bindings, 4u) << "earlier ways stay";
  EXPECT_TRUE(last.ways[1].by_texture);
  EXPECT_EQ(last.ways[1].draws[1].element, 2u) << "both slots first";
  EXPECT_TRUE(last.ways[2].from_atlas);
  EXPECT_EQ(last.bound, kNone);
  EXPECT_FALSE(last.atlas_bound) << "nothing is lit when it is done";
  EXPECT_EQ(frames[0].panels,
            (std::vector<Panel>{panel_named("screen"), panel_named("atlas"), panel_named("tree")}));
}

TEST(Screen, EventsTellEachBindingAndEachDraw) {
  const std::string events = "pace = \"event\"\n";
  const auto frames = frames_of(
      good(kScreenScene + kElements + kPackStep + kDrawStep + "from = \"atlas\"\n" + events));
  ASSERT_EQ(frames.size(), 1u + 1u + 4u + 1u) << "packed, a binding, draws, all drawn";
  const Frame& bind = frames[1];
  EXPECT_EQ(bind.event, "bind");
  EXPECT_EQ(bind.caption, "Nothing is bound yet. Bind the atlas: binding 1.");
  EXPECT_TRUE(bind.get<FrameScreen>().atlas_bound);
  EXPECT_FALSE(bind.get<FrameScreen>().elements[0].drawn) << "it is bound and not drawn yet";
  EXPECT_TRUE(bind.get<FrameScreen>().elements[0].lit);
  const Frame& second = frames[3];
  EXPECT_EQ(second.event, "draw");
  EXPECT_EQ(second.count("draws"), 2);
  EXPECT_TRUE(second.get<FrameScreen>().elements[1].lit);
  for (const FrameNode& node : second.nodes)
    EXPECT_EQ(node.mark == Mark::lit, node.label == "coin") << "the leaf that it comes from";
  const auto single = frames_of(good(kScreenScene + kElements + kDrawStep + events));
  ASSERT_EQ(single.size(), 9u);
  EXPECT_EQ(single[2].caption, "Next comes coin, but slot is bound. Bind coin: binding 2.");
  EXPECT_EQ(single[2].get<FrameScreen>().bound, 1u);
}

TEST(Screen, MistakesAreTold) {
  const auto element = [](const std::string& texture, const std::string& at) {
    return "[[element]]\ntexture = " + texture + "\nat = " + at + "\n";
  };
  const std::string show = "[[step]]\ndo = \"show\"\n";
  expect_mistakes(kScreenScene + element("@\"slt\"", "[0, 0]") + show, {"did you mean 'slot'?"});
  expect_mistakes(kScreenScene + element("@\"t\"", "[0, 0]") + show, {"is a pattern of textures"});
  good(kScreenScene + element("\"t2\"", "[36, 16]") + show);
  expect_mistakes(kScreenScene + element("\"slot\"", "@[31, 10]") + show,
                  {"'slot' (10 × 10) reaches beyond the screen (40 × 20)\nat most [30, 10]"});
  expect_mistakes(
      "title = \"t\"\n[atlas]\nsize = [8, 8]\n[[texture]]\nname = \"a\"\nsize = [4, 4]\n@" +
          element("\"a\"", "[0, 0]") + show,
      {"needs a screen"});
  expect_mistakes(kScreenScene + "[[step]]\ndo = @\"draw\"\n", {"no [[element]] to draw"});
  expect_mistakes(kScreenScene + kElements + kDrawStep + "from = @\"atlas\"\n",
                  {"the texture 'slot' is not in the atlas yet"});
  expect_mistakes(kScreenScene + kElements + "[[step]]\ndo = \"show\"\ncaption = \"@{bindings}\"\n",
                  {"no step has drawn the screen yet"});
  expect_mistakes("panels = [@\"screen\"]\n" + kScreenScene + kElements + show,
                  {"a step that draws them"});
  std::string draws = kDrawStep + kDrawStep + kDrawStep + kDrawStep;
  expect_mistakes(kScreenScene + kElements + draws + "[[step]]\ndo = @\"draw\"\n",
                  {"more than 4 steps draw the screen"});
}

TEST(Screen, CannotBeDrawnFromAnAtlasThatRefusedATexture) {
  std::string text = kScreenScene + kElements + kPackStep + kDrawStep + "from = \"atlas\"\n";
  text.replace(text.find("size = [32, 16]"), 15, "size = [12, 12]");
  try {
    frames_of(good(text));
    FAIL() << "it was drawn";
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("the atlas has refused 'coin'"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace lantern::run
