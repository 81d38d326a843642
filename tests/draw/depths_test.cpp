// How deep bodies overlap, as it is written beside contacts.
#include <gtest/gtest.h>

#include "draw/marks.hpp"
#include "draw/page.hpp"

namespace lantern::draw {
namespace {

TEST(Depths, HaveTwoFiguresAndAUnitThatFits) {
  const std::pair<double, const char*> kTexts[] = {{0, "0"},
                                                   {-1, "0"},
                                                   {9e-10, "0"},
                                                   {2.5e-9, "2.5 nm"},
                                                   {3.44e-6, "3.4 µm"},
                                                   {3.4e-5, "34 µm"},
                                                   {9.94e-4, "0.99 mm"},
                                                   {0.00034, "0.34 mm"},
                                                   {0.001, "1.0 mm"},
                                                   {0.0123, "12 mm"},
                                                   {0.099, "99 mm"},
                                                   {0.25, "25 cm"},
                                                   {1, "1.0 m"},
                                                   {25.2, "25 m"},
                                                   {0.9999, "1.0 m"},
                                                   {std::nan(""), "0"}};
  for (const auto& [depth, text] : kTexts) EXPECT_EQ(depth_text(depth), text) << depth;
}

// Four pairs of boxes, each pressed into the one below.
Frame pressed() {
  Frame frame;
  frame.panels = {panel_named("world")};
  frame.bounds = {Vec<3>(0.0), {16, 4, 0}};
  frame.display.depths = true;
  for (BodyId i = 0; i < 8; ++i) {
    FrameBody body;
    body.id = i;
    body.name = "box " + std::to_string(i);
    body.shape = OrientedBox<3>{{0.8, 0.8, 0}};
    body.position = {2 + 4.0 * (i / 2), 0.8 + 1.5 * (i % 2), 0};
    body.box = Box<3>::around(body.position, {0.8, 0.8, 0});
    frame.bodies.push_back(body);
  }
  for (BodyId i = 0; i < 4; ++i) {
    FrameContact contact;
    contact.pair = {2 * i, 2 * i + 1};
    contact.normal = {0, 1, 0};
    const double x = 2 + 4.0 * i, depth = 0.02 * (i + 1);
    contact.points = {{{x - 0.8, 1.55, 0}, -depth, 1}, {{x + 0.8, 1.55, 0}, -depth / 2, 1}};
    frame.contacts.push_back(contact);
  }
  return frame;
}

TEST(Depths, StandBesideTheirContactsAndCoverNothing) {
  Work work;
  const DrawList list = draw_frame(pressed(), page_for(1600, 900), work);
  for (const char* text : {"20 mm", "40 mm", "60 mm", "80 mm"}) {
    const auto found = std::find_if(list.labels.begin(), list.labels.end(),
                                    [&](const LabelBox& l) { return l.text == text; });
    ASSERT_NE(found, list.labels.end()) << text << " is missing: the deepest point counts";
    for (const LabelBox& other : list.labels) {
      if (&other == &*found) continue;
      EXPECT_FALSE(overlap(other.box, found->box)) << text << " covers " << other.text;
    }
    EXPECT_TRUE(holds(found->panel, found->box)) << text << " leaves its panel";
  }
}

TEST(Depths, AreSilentUnlessAsked) {
  Frame frame = pressed();
  frame.display.depths = false;
  Work work;
  for (const LabelBox& label : draw_frame(frame, page_for(1600, 900), work).labels)
    EXPECT_EQ(label.text.find(" mm"), std::string::npos) << label.text;
}

}  // namespace
}  // namespace lantern::draw
