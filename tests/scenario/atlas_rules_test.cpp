// Atlases whose leaves choose their textures, and textures that are turned.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "atlas/packer.hpp"
#include "frame/parts/atlas.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

std::string atlas_text(const std::string& keys, const std::string& textures,
                       const std::string& step) {
  return "title = \"t\"\n[atlas]\n" + keys + "\n" + textures + "[[step]]\ndo = \"pack\"\n" + step;
}

const std::string kMany =
    "[[texture_pattern]]\nname = \"t\"\ncount = 60\nmin = [2, 3]\nmax = [12, 30]\n";

void expect_apart(const Frame& frame) {
  for (const FrameTexture& s : frame.get<FrameTextures>().textures)
    for (const FrameTexture& t : frame.get<FrameTextures>().textures)
      EXPECT_FALSE(s.packed && t.packed && s.id < t.id && s.x < t.x + t.width &&
                   t.x < s.x + s.width && s.y < t.y + t.height && t.y < s.y + s.height)
          << s.name << " and " << t.name << " overlap";
}

TEST(AtlasRules, LeavesThatChoosePackMore) {
  const auto last = [](const std::string& keys) {
    const auto frames = frames_of(
        good(atlas_text("size = [94, 94]\n" + keys, kMany, "textures = [\"t\"]\neach = false\n")));
    EXPECT_EQ(frames.size(), 1u);
    expect_apart(frames.back());
    return frames.back();
  };
  const Frame taught = last(""), chosen = last("rule = \"best_texture\""),
              turned = last("rule = \"best_texture\"\nturn = true");
  EXPECT_EQ(taught.counts, last("rule = \"first_fit\"").counts) << "the taught rule is the default";
  EXPECT_GT(taught.count("refused"), 0);
  EXPECT_LT(*chosen.count("refused"), *taught.count("refused"));
  EXPECT_GE(*turned.count("used_area"), *chosen.count("used_area"));
  EXPECT_TRUE(std::ranges::any_of(turned.get<FrameTextures>().textures, &FrameTexture::turned));
  EXPECT_TRUE(std::ranges::none_of(chosen.get<FrameTextures>().textures, &FrameTexture::turned));
}

TEST(AtlasRules, EachTextureHasItsFrameInTheOrderOfTheLeaves) {
  const auto frames = frames_of(good(
      atlas_text("size = [60, 60]\nrule = \"best_texture\"\nturn = true", kMany,
                 "textures = [\"t\"]\ncaption = \"{texture}: {textures} in, {refused} out.\"\n")));
  ASSERT_EQ(frames.size(), 60u);
  std::int64_t before = 0;
  for (const Frame& frame : frames) {
    const std::int64_t done = *frame.count("textures") + *frame.count("refused");
    EXPECT_EQ(done, ++before) << "a frame that is about none or several";
    expect_apart(frame);
    EXPECT_EQ(*frame.count("used_area") + *frame.count("free_area"), 3600);
  }
  EXPECT_GT(frames.back().count("refused"), 0);
}

TEST(AtlasRules, EventsTellOfTurning) {
  const auto frames =
      frames_of(good(atlas_text("size = [30, 10]\nrule = \"best_texture\"\nturn = true",
                                "[[texture]]\nname = \"A\"\nsize = [8, 30]\n",
                                "textures = [\"A\"]\npace = \"event\"\nfree_name = \"F\"\n")),
                Pace::event);
  const Frame& cut = at(frames, "cut");
  EXPECT_NE(cut.caption.find("A, turned (30 × 8)"), std::string::npos) << cut.caption;
  const FrameTexture& a = frames.back().get<FrameTextures>().textures.at(0);
  EXPECT_TRUE(a.packed && a.turned);
  EXPECT_EQ(a.width, 30);
  EXPECT_EQ(a.height, 8);
  EXPECT_EQ(node(frames.back(), "F").box.size(), Vec<3>(30, 2, 0));
}

TEST(AtlasRules, ByFirstFitThoseAreTurnedThatFitNowhereElse) {
  const std::string textures =
      "[[texture]]\nname = \"A\"\nsize = [8, 30]\n[[texture]]\nname = \"B\"\nsize = [5, 2]\n";
  const auto with = [&](const std::string& turn) {
    return frames_of(good(atlas_text("size = [30, 10]\n" + turn, textures,
                                     "textures = [\"A\", \"B\"]\n")))
        .back();
  };
  EXPECT_EQ(with("").count("refused"), 1);
  const Frame turned = with("turn = true");
  EXPECT_EQ(turned.count("refused"), 0);
  EXPECT_TRUE(turned.get<FrameTextures>().textures.at(0).turned);
  EXPECT_FALSE(turned.get<FrameTextures>().textures.at(1).turned);
}

TEST(AtlasRules, TrialsAreThoseOfThePacker) {
  EXPECT_EQ(static_cast<std::size_t>(kMostTrials), trial_count(true));
}

}  // namespace
}  // namespace lantern::run
