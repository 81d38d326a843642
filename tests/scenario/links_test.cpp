// Springs and joints come and go with their bodies; the points they are tied to are no bodies.
#include <gtest/gtest.h>

#include "frame/parts/motion.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

const std::string kTiedTwo = R"([structure]
kind = "quadtree"
[[body]]
name = "a"
radius = 0.5
position = [4, 8]
[[body]]
name = "b"
radius = 0.5
position = [7, 8]
[[spring]]
a = "a"
b = "b"
stiffness = 10
rest_length = 2
[[joint]]
kind = "pin"
a = "a"
to = [4, 8]
)";

TEST(Links, ComeAndGoWithTheirBodies) {
  const auto frames = frames_of(good(world_text(
      "size = [16, 16]\ncontacts = \"impulse\"\ntime_step = 0.0625",
      kTiedTwo + steps({"do = \"insert\"\nbodies = [\"a\"]", "do = \"insert\"\nbodies = [\"b\"]",
                        "do = \"run\"\nseconds = 0.5",
                        "do = \"remove\"\nbodies = [\"b\"]\nname = \"without_b\"",
                        "do = \"remove\"\nbodies = [\"a\"]\nname = \"empty\"",
                        "do = \"insert\"\nbodies = [\"b\", \"a\"]\nname = \"again\""}))));
  const auto kinds = [](const Frame& frame) {
    std::vector<FrameLink::Kind> list;
    for (const FrameLink& link : frame.get<FrameLinks>().links) list.push_back(link.kind);
    return list;
  };
  using Kinds = std::vector<FrameLink::Kind>;
  using enum FrameLink::Kind;
  EXPECT_EQ(kinds(frames[0]), Kinds{pin}) << "the spring's other end is not there yet";
  EXPECT_EQ(kinds(frames[1]), (Kinds{spring, pin}));
  EXPECT_EQ(frames[1].get<FrameLinks>().links[0].from, Vec<3>(4, 8, 0));
  EXPECT_EQ(frames[1].get<FrameLinks>().links[0].to, Vec<3>(7, 8, 0));
  EXPECT_DOUBLE_EQ(frames[1].get<FrameLinks>().links[0].strain, 0.5) << "(3 - 2) / 2";
  EXPECT_EQ(frames[1].get<FrameLinks>().links[1].strain, 0);
  EXPECT_EQ(kinds(at(frames, "without_b")), Kinds{pin});
  EXPECT_TRUE(at(frames, "empty").get<FrameLinks>().links.empty());
  EXPECT_EQ(kinds(at(frames, "again")), (Kinds{spring, pin}));
  for (const Frame& frame : frames) {
    EXPECT_LE(frame.bodies.size(), 2u) << "an anchor is pictured";
    EXPECT_EQ(frame.count("bodies"), std::int64_t(frame.bodies.size()));
    for (const FrameNode& n : frame.nodes)
      EXPECT_EQ(names(frame, n.bodies).size(), n.bodies.size()) << "an anchor is in the tree";
  }
  EXPECT_LT(body(frames[4], "b").position.x, 7) << "the spring does not pull";
  EXPECT_NEAR(body(frames[4], "a").position.x, 4, 1e-3) << "the pin does not hold";
}

// An anchor is a point of the world, not an obstacle.
TEST(Links, AnchorsAreNotInTheWay) {
  for (const std::string contacts : {"impulse", "soft"})
    for (const std::string at_height : {"8", "8.1"}) {
      SCOPED_TRACE(contacts + " at " + at_height);
      const std::string hung =
          "[[body]]\nname = \"weight\"\nradius = 0.5\nposition = [8, 2]\n"
          "[[joint]]\nkind = \"distance\"\na = \"weight\"\nto = [8, 8]\n";
      const std::string ball = "[[body]]\nname = \"ball\"\nradius = 1\nposition = [3, " +
                               at_height + "]\nvelocity = [8, 0]\n";
      const auto frames = frames_of(
          good(world_text("size = [16, 16]\ntime_step = 0.0625\ncontacts = \"" + contacts + "\"",
                          hung + ball +
                              steps({"do = \"insert\"\nbodies = [\"weight\", \"ball\"]",
                                     "do = \"run\"\nseconds = 1"}))));
      const FrameBody& free = body(frames.back(), "ball");
      EXPECT_DOUBLE_EQ(free.position.x, 11) << "it has hit the point that another body hangs on";
      EXPECT_EQ(free.velocity, Vec<3>(8, 0, 0));
    }
}

TEST(Links, ASpringToItsOwnPlaceIsAtRest) {
  const auto frames = frames_of(good(
      world_text("size = [16, 16]\ntime_step = 0.0625\ncontacts = \"impulse\"",
                 "[[body]]\nname = \"a\"\nradius = 1\nposition = [8, 8]\n"
                 "[[spring]]\na = \"a\"\nto = [8.5, 8]\nstiffness = 10\n" +
                     steps({"do = \"insert\"\nbodies = [\"a\"]", "do = \"run\"\nseconds = 1"}))));
  EXPECT_NEAR(body(frames.back(), "a").position.x, 8, 1e-12)
      << "the body was pushed off the point that it hangs on";
}

TEST(Links, KeepTheirEnergyInMind) {
  const auto frames = frames_of(good(world_text(
      "size = [16, 16]\ntime_step = 0.0625",
      kTiedTwo +
          steps({"do = \"insert\"\nbodies = [\"a\", \"b\"]\n"
                 "caption = \"{potential_energy} J in the spring, {bodies:body/bodies}.\""}))));
  EXPECT_DOUBLE_EQ(*frames[0].measure("potential_energy"), 5) << "10 / 2 · 1²";
  EXPECT_EQ(frames[0].caption, "5 J in the spring, 2 bodies.");
}

}  // namespace
}  // namespace lantern::run
