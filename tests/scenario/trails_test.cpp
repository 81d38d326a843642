// Where bodies have been, and the looks by which the moment of an impact is found.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frame/parts/motion.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

// A ball that flies 4 in a step at a wall of which 3 part it, and bounces.
const std::string kFlight =
    "title = \"x\"\n[world]\nsize = [20, 8]\ntime_step = 0.1\ncontacts = \"impulse\"\n"
    "quiet = [\"through\"]\n[display]\ntrail = 2\n"
    "[[body]]\nname = \"wall\"\nhalf_size = [0.5, 4]\nposition = [12.5, 4]\nstatic = true\n"
    "[[body]]\nname = \"ball\"\nradius = 1\nposition = [4, 4]\nvelocity = [40, 0]\n"
    "restitution = 1\nfriction = 0\n"
    "[[step]]\ndo = \"insert\"\nbodies = [\"wall\", \"ball\"]\n";

const FrameBody& ball_of(const Frame& frame) {
  return *std::ranges::find(frame.bodies, "ball", &FrameBody::name);
}

TEST(Trails, AreTheEndsOfStepsAndTheImpactsBetween) {
  const auto frames =
      frames_of(good(kFlight + "[[step]]\ndo = \"run\"\nseconds = 0.4\nevery = 1\n"));
  ASSERT_EQ(frames.size(), 5u);
  EXPECT_TRUE(ball_of(frames[0]).trail.empty()) << "it has been nowhere else";
  const auto xs = [](const Frame& frame) {
    std::vector<double> at;
    for (const FrameStop& stop : ball_of(frame).trail) at.push_back(stop.position.x);
    return at;
  };
  EXPECT_EQ(xs(frames[1]), (std::vector<double>{4}));
  const std::vector<FrameStop>& bounce = ball_of(frames[2]).trail;
  ASSERT_EQ(bounce.size(), 3u);
  EXPECT_TRUE(!bounce[0].impact && !bounce[1].impact && bounce[2].impact);
  EXPECT_NEAR(bounce[2].position.x, 11, 1e-9) << "it touches the wall there";
  EXPECT_NEAR(ball_of(frames[2]).position.x, 10, 1e-9);
  EXPECT_EQ(xs(frames[4]).size(), 2u) << "no more steps than are asked for";
  EXPECT_EQ(frames[2].count("impacts_located"), 1);
  EXPECT_NEAR(*frames[2].measure("time_of_impact"), 0.75, 1e-12);
  EXPECT_EQ(*frames[1].measure("time_of_impact"), 1) << "there was none";
}

TEST(Trails, LooksNarrowDownTheMomentOfTheImpact) {
  const std::string step =
      "[[step]]\ndo = \"run\"\nseconds = 0.1\n[[step]]\ndo = \"phases\"\nname = \"end\"\n"
      "events = [\"approach\", \"impact\"]\n";
  const auto frames = frames_of(good(kFlight + step));
  ASSERT_EQ(frames.size(), 5u) << "a look at the beginning, one at the impact, and the end";
  const std::vector<FrameLook>& looks = frames[3].get<FrameLooks>().looks;
  ASSERT_EQ(looks.size(), 2u);
  EXPECT_EQ(frames[2].get<FrameLooks>().looks.size(), 1u) << "no frame knows of a later look";
  EXPECT_NEAR(looks[0].gap, 3, 1e-12);
  EXPECT_NEAR(looks[0].free_until, 0.75, 1e-12);
  EXPECT_TRUE(looks[1].meets && !looks[0].meets);
  EXPECT_NEAR(looks[1].time, 0.75, 1e-12);
  EXPECT_NEAR(looks[1].gap, 0, 1e-12);
  EXPECT_NEAR(ball_of(frames[3]).position.x, 8, 1e-9) << "the step is not taken yet";
  EXPECT_NEAR(ball_of(frames[3]).ahead->position.x, 12, 1e-9) << "where it would be behind it";
  EXPECT_TRUE(frames[4].get<FrameLooks>().looks.empty());
  // Nobody pays for looks that nobody asks for, and the world is the same.
  const auto plain =
      frames_of(good(kFlight + "[[step]]\ndo = \"run\"\nseconds = 0.2\nevery = 2\n"));
  EXPECT_EQ(plain.back().hash, frames.back().hash);
}

}  // namespace
}  // namespace lantern::run
