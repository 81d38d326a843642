// What stands beside a frame: all that it promises, in as many dimensions as the world has.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "scenario/directing.hpp"

namespace lantern::run {
namespace {

using nlohmann::json;

constexpr const char* kSolidFrames = R"(title = "test"
[world]
size = [8, 8, 8]
gravity = [0, -10, 0]
contacts = "soft"
[structure]
kind = "octree"
capacity = 1
[[body]]
name = "floor"
static = true
half_size = [4, 0.5, 4]
position = [4, 0.5, 4]
[[body]]
name = "box"
half_size = [0.5, 0.5, 0.5]
oriented = true
position = [3, 1.5, 3]
[[body]]
name = "bob"
radius = 0.25
position = [6, 4, 6]
[[spring]]
a = "bob"
to = [6, 7, 6]
stiffness = 50
[[step]]
do = "insert"
bodies = ["floor", "box", "bob"]
[[step]]
do = "run"
seconds = 0.05
[[step]]
do = "ray"
from = [3, 7, 3]
to = [3, 1, 3]
)";

TEST(FrameJson, OfASolidWorldHasThreeNumbersAPoint) {
  const auto frames = frames_of(parse_scenario(kSolidFrames, "solid.toml"), Pace::step);
  ASSERT_FALSE(frames.empty());
  const json frame = json::parse(to_json(frames.back()));
  EXPECT_EQ(frame["format"], "lantern.frame/2");
  for (const char* key : {"scenario", "frame", "time", "step", "event", "caption", "seed", "bodies",
                          "nodes", "pairs", "overlaps", "contacts", "counts", "hash"})
    EXPECT_TRUE(frame.contains(key)) << key << " is promised, but missing";
  ASSERT_EQ(frame["bodies"].size(), 3u) << "the spring's anchor is nobody";
  EXPECT_FALSE(frame.contains("since_last_frame")) << "no step was made for the ray";
  const json run = json::parse(to_json(*(frames.end() - 2)));
  EXPECT_GT(run["since_last_frame"]["narrow_tests"], 0);
  for (const json& body : frame["bodies"]) {
    for (const char* key : {"position", "velocity", "angular_momentum"})
      EXPECT_EQ(body[key].size(), 3u) << key;
    EXPECT_EQ(body["orientation"].size(), 4u) << "a quaternion: w, x, y, z";
    EXPECT_EQ(body["box"]["min"].size(), 3u);
    for (const char* key : {"id", "name", "shape", "static", "asleep"})
      EXPECT_TRUE(body.contains(key)) << key;
  }
  ASSERT_FALSE(frame["contacts"].empty()) << "the box stands on the floor";
  EXPECT_EQ(frame["contacts"][0]["points"].size(), 4u) << "a face on a face";
  EXPECT_EQ(frame["contacts"][0]["normal"].size(), 3u);
  ASSERT_EQ(frame["links"].size(), 1u);
  EXPECT_EQ(frame["links"][0]["kind"], "spring");
  ASSERT_EQ(frame["rays"].size(), 1u);
  ASSERT_EQ(frame["rays"][0]["hits"].size(), 1u);
  EXPECT_EQ(frame["rays"][0]["hits"][0]["body"], frame["bodies"][1]["id"]);
}

TEST(FrameJson, ItsPageNamesEveryCounterOfASum) {
  const std::string page = read_file(LANTERN_ROOT "/scenarios/FRAME.md", 1 << 20);
  for (const WorldCounter& counter : kWorldCounters)
    EXPECT_NE(page.find(fmt::format("`{}`", counter.name)), std::string::npos) << counter.name;
}

TEST(FrameJson, LosesNoBitOfANumber) {
  const auto frames = frames_of(parse_scenario(kSolidFrames, "solid.toml"), Pace::step);
  const Frame& last = frames.back();
  const json frame = json::parse(to_json(last));
  for (std::size_t i = 0; i < last.bodies.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      EXPECT_EQ(frame["bodies"][i]["position"][k].get<double>(), last.bodies[i].position[axis]);
      EXPECT_EQ(frame["bodies"][i]["velocity"][k].get<double>(), last.bodies[i].velocity[axis]);
    }
}

}  // namespace
}  // namespace lantern::run
