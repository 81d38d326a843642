// What frames show and say of a grid.
#include <gtest/gtest.h>

#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

constexpr const char* kDotPillAndBar =
    "[[body]]\nname = \"dot\"\nradius = 0.5\nposition = [1, 1]\n"
    "[[body]]\nname = \"pill\"\nhalf_size = [1, 0.5]\nposition = [4, 6]\n"
    "[[body]]\nname = \"bar\"\nhalf_size = [3.5, 0.5]\nposition = [11, 2]\n"
    "[[step]]\ndo = \"insert\"\nbodies = [\"dot\", \"pill\", \"bar\"]\n";

std::vector<Frame> on_grid(const std::string& keys, Pace pace = Pace::step) {
  return frames_of(
      good(world_text("size = [16, 8]", "[structure]\nkind = \"grid\"\n" + keys + kDotPillAndBar)),
      pace);
}

TEST(GridPictures, ShowEachCellWithAllThatReachIt) {
  const Frame frame = on_grid("cell = 4\n").back();
  EXPECT_EQ(frame.get<FrameStructure>().settings, "cells of 4");
  EXPECT_EQ(bodies_in(frame, "5"), Names{"dot"});
  EXPECT_EQ(bodies_in(frame, "1"), Names{"pill"});
  EXPECT_EQ(bodies_in(frame, "2"), Names{"pill"});
  for (const std::string cell : {"6", "7", "8"}) EXPECT_EQ(bodies_in(frame, cell), Names{"bar"});
  EXPECT_EQ(frame.nodes.size(), 7u) << "the root, and no empty cell";
  EXPECT_EQ(node(frame, "5").box, (Box<3>{{0, 0, 0}, {4, 4, 0}}));
  EXPECT_EQ(frame.count("nodes"), 7);
  EXPECT_EQ(frame.count("entries"), 6);
  EXPECT_EQ(frame.count("depth"), 1);
  for (const FrameNode& n : frame.nodes) EXPECT_FALSE(n.over_capacity);
}

TEST(GridPictures, OfLevelsAndBuckets) {
  const Frame levels = on_grid("cell = 1\nlevels = 3\n").back();
  EXPECT_EQ(levels.get<FrameStructure>().settings, "cells of 1, 3 levels");
  EXPECT_EQ(bodies_in(levels, "L1.97"), Names{"dot"}) << "row 7 of 8, 16 cells each";
  EXPECT_EQ(node(levels, "L2").leaf, false);
  EXPECT_EQ(levels.count("depth"), 2);
  const Frame hashed = on_grid("cell = 4\nopen = true\n").back();
  EXPECT_EQ(hashed.get<FrameStructure>().settings, "spatial hash, cells of 4");
  EXPECT_EQ(bodies_in(hashed, "B1.1"), Names{"dot"});
  EXPECT_EQ(on_grid("").back().get<FrameStructure>().settings, "cells that suit the bodies");
}

TEST(GridPictures, TellTheCellsThatABodyEnters) {
  const std::vector<Frame> frames = on_grid("cell = 4\n", Pace::event);
  std::vector<std::string> told;
  for (const Frame& frame : frames)
    if (frame.event == "make_child" || frame.event == "store") told.push_back(frame.caption);
  ASSERT_GE(told.size(), 2u);
  EXPECT_EQ(told[0], "Node 5 is made, because something enters it.");
  EXPECT_EQ(told[1], "Node 5 stores dot and holds 1.");
}

TEST(GridPictures, AFloorWithoutEndIsInEveryCellOrInOneLeafOfItsOwn) {
  const std::string floor =
      "[[body]]\nname = \"floor\"\nground = [0, 1]\nposition = [0, 1]\n"
      "static = true\n[[step]]\ndo = \"insert\"\nbodies = [\"floor\"]\n";
  const auto with_floor = [&](const std::string& keys) {
    return frames_of(good(world_text("size = [16, 8]", "[structure]\nkind = \"grid\"\n" + keys +
                                                           kDotPillAndBar + floor)))
        .back();
  };
  EXPECT_EQ(bodies_in(with_floor("cell = 4\n"), "8"), (Names{"bar", "floor"}));
  EXPECT_EQ(bodies_in(with_floor("cell = 4\nopen = true\n"), "large"), Names{"floor"});
}

}  // namespace
}  // namespace lantern::run
