// `separate` and `gjk` tell what the narrow phase does with two bodies, and refuse what has no end.
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "frame/parts/asked.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

const std::string kTwoBoxes =
    "title = \"x\"\n[world]\nsize = [32, 16]\n"
    "[[body]]\nname = \"red\"\nhalf_size = [2, 2]\noriented = true\nposition = [8, 8]\n"
    "[[body]]\nname = \"pink\"\nhalf_size = [2, 1]\noriented = true\nturned = 45\n"
    "position = [20, 8]\n"
    "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"pink\"]\n";

std::string ask(const std::string& verb, const std::string& more = "") {
  return "[[step]]\ndo = \"" + verb + "\"\npair = [\"red\", \"pink\"]\npace = \"event\"\n" + more;
}
const std::string kMove = "[[step]]\ndo = \"move\"\nbody = \"pink\"\nto = [10, 9]\n";

TEST(Separate, TellsAxisByAxisAndNoMoreThanHasHappened) {
  const auto frames = frames_of(good(kTwoBoxes + ask("separate") + kMove + ask("separate")));
  ASSERT_EQ(frames.size(), 1u + 2 + 1 + 5);
  EXPECT_FALSE(frames[0].find<FrameSeparation>());
  EXPECT_EQ(frames[1].event, "axis");
  EXPECT_FALSE(frames[1].find<FrameSeparation>()->answer) << "the result is told with the axis";
  EXPECT_EQ(frames[2].find<FrameSeparation>()->answer, 0u);
  EXPECT_NEAR(*frames[2].measure("gap"), 12 - 2 - 3 / std::sqrt(2.0), 1e-12);
  EXPECT_FALSE(frames[3].find<FrameSeparation>()) << "the next step is not about it";
  EXPECT_EQ(frames[3].count("axes_tested"), 1) << "its count stays";
  for (std::size_t i = 4; i < 8; ++i)
    EXPECT_EQ(frames[i].count("axes_tested"), static_cast<std::int64_t>(i) - 3);
  EXPECT_EQ(frames[8].measure("gap"), 0);
  double least = 1e300;
  for (const FrameAxis& axis : frames[8].find<FrameSeparation>()->axes) {
    least = std::min(least, -axis.separation);
    EXPECT_NEAR(glm::dot(axis.ends[2] - axis.ends[1], axis.direction), axis.separation, 1e-12);
    ASSERT_EQ(axis.face.size(), 2u);
    EXPECT_NEAR(glm::dot(axis.face[1] - axis.face[0], axis.direction), 0, 1e-12);
  }
  EXPECT_NEAR(*frames[8].measure("overlap"), least, 1e-12);
}

TEST(SearchDistance, TellsSupportBySupport) {
  const auto frames = frames_of(good("panels = [\"world\", \"difference\"]\n" + kTwoBoxes +
                                     ask("gjk") + kMove + ask("gjk", "events = [\"support\"]\n")));
  ASSERT_TRUE(frames[0].find<FrameDifference>()) << "of the two that are there";
  EXPECT_EQ(frames[0].find<FrameDifference>()->corners.size(), 8u);
  EXPECT_FALSE(frames[1].measure("distance")) << "nobody knows it yet";
  std::size_t n = 1;
  while (frames[n].event != "gjk") {
    const FrameSearch& search = *frames[n].find<FrameSearch>();
    EXPECT_EQ(search.taken, frames[n].event == "simplex");
    EXPECT_FALSE(search.answer);
    ++n;
  }
  EXPECT_NEAR(*frames[n].measure("distance"), 12 - 2 - 3 / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(frames[n].count("gjk_steps"), std::ssize(frames[n].find<FrameSearch>()->steps));
  EXPECT_TRUE(frames.back().find<FrameSearch>()->answer->overlaps);
  EXPECT_EQ(frames.back().measure("distance"), 0);
}

// Every candidate pair once, and those touch whose discs are near enough.
TEST(TestShapes, TestsAllPairsOfTheStructure) {
  const auto scene = [](const std::string& kind) {
    return "title = \"x\"\n[world]\nsize = [16, 16]\n[structure]\nkind = \"" + kind +
           (kind == "quadtree" ? "\"\ncapacity = 3\n" : "\"\n") +
           "[[pattern]]\nname = \"disc\"\ncount = 20\nradius = 1.4\n"
           "[[step]]\ndo = \"insert\"\nbodies = [\"disc\"]\n[[step]]\ndo = \"test_shapes\"\n"
           "[[step]]\ndo = \"show\"\n";
  };
  std::int64_t touching = 0;
  for (const std::string kind : {"brute_force", "quadtree"}) {
    const auto frames = frames_of(good(scene(kind)));
    EXPECT_TRUE(frames[0].tested.empty());
    const Frame& frame = frames[1];
    ASSERT_EQ(frame.tested.size(), frame.pairs.size());
    EXPECT_EQ(frame.count("narrow_work"), frame.count("shapes_tested")) << "one length for discs";
    std::set<Pair> near;
    for (const FrameBody& a : frame.bodies)
      for (const FrameBody& b : frame.bodies)
        if (a.id < b.id && glm::distance(a.position, b.position) <= 2.8) near.insert({a.id, b.id});
    EXPECT_EQ(frame.count("touching"), std::ssize(near));
    for (const FrameContact& contact : frame.contacts) EXPECT_TRUE(near.contains(contact.pair));
    if (kind == "quadtree") {
      EXPECT_LT(frame.count("shapes_tested"), frame.count("all_pairs"));
      EXPECT_EQ(frame.count("touching"), touching) << "no leaf loses a contact";
    }
    touching = *frame.count("touching");
    EXPECT_GT(touching, 0);
    EXPECT_TRUE(frames[2].contacts.empty()) << "the next step is not about them";
    EXPECT_EQ(frames[2].count("touching"), touching);
  }
}

TEST(NarrowMistakes, OfPairsThatHaveNoTest) {
  for (const std::string verb : {"separate", "gjk"}) {
    const auto step = [&](const std::string& pair) {
      return "[[step]]\ndo = \"" + verb + "\"\npair = " + pair + "\n";
    };
    expect_mistakes(kTwoBoxes + step("@[\"red\"]"), {"a pair is two bodies"});
    expect_mistakes(kTwoBoxes + step("[\"red\", @\"red\"]"), {"named twice"});
    // A range stands for several.
    const std::string dots = kTwoBoxes + "[[pattern]]\nname = \"dot\"\nradius = 0.1\ncount = 4\n";
    const std::string insert = "[[step]]\ndo = \"insert\"\nbodies = [\"dot\"]\n";
    expect_mistakes(dots + insert + step("@[\"dot1..dot4\"]"), {"a pair is two bodies"});
    good(dots + insert + step("[\"dot2..dot3\"]"));
    expect_mistakes(kTwoBoxes + step("[\"red\", @\"pinc\"]"), {"pinc"});
    expect_mistakes(kTwoBoxes + "[[step]]\ndo = \"remove\"\nbodies = [\"pink\"]\n" +
                        step("[\"red\", @\"pink\"]"),
                    {"not in the world"});
    expect_mistakes(
        "title = \"x\"\n[world]\nsize = [8, 8]\n[[body]]\nname = \"red\"\nradius = 1\n"
        "position = [1, 4]\n[[body]]\nname = \"ground\"\nground = [0, 1]\nposition = [0, 1]\n"
        "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"ground\"]\n" +
            step("[\"red\", @\"ground\"]"),
        {"is a half-space"});
    expect_mistakes(
        "title = \"x\"\n[world]\nsize = [8, 8, 8]\n[[body]]\nname = \"red\"\nradius = 1\n"
        "position = [1, 4, 1]\n[[body]]\nname = \"pink\"\nradius = 1\nposition = [5, 4, 1]\n"
        "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"pink\"]\n[[step]]\ndo = @\"" +
            verb + "\"\npair = [\"red\", \"pink\"]\n",
        {"flat worlds only"});
  }
  expect_mistakes(kTwoBoxes + "[[step]]\ndo = @\"test_shapes\"\n", {"no structure at this step"});
  expect_mistakes(kTwoBoxes + "[[step]]\ndo = \"show\"\nexpect = { @axes_tested = 1 }\n",
                  {"no step has separated two bodies yet"});
  expect_mistakes(kTwoBoxes + "[[step]]\ndo = \"show\"\nexpect = { @distance = 1 }\n",
                  {"no step has asked for a distance by gjk yet"});
}

}  // namespace
}  // namespace lantern::run
