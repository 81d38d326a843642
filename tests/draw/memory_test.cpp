#include <gtest/gtest.h>

#include "draw/page.hpp"
#include "draw/sample_frames.hpp"

namespace lantern::draw {
namespace {

std::string texts_of(const Frame& frame) {
  Work work;
  std::string all;
  for (const LabelBox& label : draw_frame(frame, page_for(1600, 900), work).labels)
    all += label.text + "\n";
  return all;
}

Frame three_leaves() {
  Frame frame;
  frame.panels = {panel_named("memory")};
  frame.add<FrameStructure>().array_size = 24;
  for (BodyId id = 0; id < 3; ++id) {
    FrameBody body;
    body.id = id;
    body.name = std::string(1, static_cast<char>('a' + id));
    body.color = static_cast<int>(id) + 1;
    body.box = {{0, 0, 0}, {1, 1, 0}};
    frame.bodies.push_back(body);
  }
  for (std::uint32_t i = 0; i < 3; ++i) {
    FrameNode leaf;
    leaf.id = i;
    leaf.label = "leaf" + std::to_string(i);
    leaf.first = 4 * i;
    leaf.room = 4;
    leaf.mark = i == 1 ? Mark::lit : Mark::quiet;
    for (BodyId id = 0; id <= i; ++id) leaf.bodies.push_back(id);
    frame.nodes.push_back(leaf);
  }
  frame.counts = {{"entries", 6}, {"allocations", 1}};
  return frame;
}

TEST(Memory, HeadingCountsSlots) {
  EXPECT_NE(texts_of(three_leaves()).find("24 slots, 6 in use, 1 allocation\n"), std::string::npos);
  Frame uncounted = three_leaves();
  uncounted.counts.clear();
  EXPECT_NE(texts_of(uncounted).find("24 slots, 6 in use\n"), std::string::npos)
      << "bodies in leaves are counted where the frame does not";
}

TEST(Memory, EveryLeafAndItsBodiesAreNamed) {
  const std::string texts = texts_of(three_leaves());
  for (const char* name :
       {"leaf0: first 0, count 1\n", "leaf1: first 4, count 2\n", "leaf2: first 8, count 3\n"})
    EXPECT_NE(texts.find(name), std::string::npos) << name;
  Work work;
  const DrawList list = draw_frame(three_leaves(), page_for(1600, 900), work);
  const auto count = [&](const char* name) {
    return std::count_if(list.labels.begin(), list.labels.end(),
                         [&](const LabelBox& label) { return label.text == name; });
  };
  EXPECT_EQ(count("a"), 3) << "a is stored in three leaves";
  EXPECT_EQ(count("c"), 1);
}

TEST(Memory, NamesAreWholeOrNotThere) {
  Frame frame = three_leaves();
  frame.display.names = ShownNames::none;
  EXPECT_EQ(texts_of(frame).find("\na\n"), std::string::npos);
  frame = three_leaves();
  frame.bodies[0].name = "a very long name";
  const std::string texts = texts_of(frame);
  EXPECT_EQ(texts.find("\na\n"), std::string::npos) << "not cut to a letter";
  EXPECT_EQ(texts.find("\nc\n"), std::string::npos) << "all or none";
}

TEST(Memory, OnlyTheLitLeafIsLit) {
  Work work;
  int grounds = 0;
  for (const DrawShape& shape : draw_frame(three_leaves(), page_for(1600, 900), work).shapes)
    if (const auto* rect = std::get_if<RectShape>(&shape); rect && rect->fill == Role::lit_fill)
      ++grounds;
  EXPECT_EQ(grounds, 1);
}

TEST(Memory, AnArrayOfAnyLengthIsDrawn) {
  for (const std::uint32_t slots : {0u, 1u, 2u, 23u, 500u, 10000u, 4000000000u}) {
    Frame frame = three_leaves();
    frame.add<FrameStructure>().array_size = slots;
    const std::string texts = texts_of(frame);
    EXPECT_NE(texts.find(slots == 1 ? " slot," : " slots,"), std::string::npos) << slots;
    EXPECT_EQ(texts.find("are drawn") != std::string::npos, slots > 1000000) << slots;
  }
}

}  // namespace
}  // namespace lantern::draw
