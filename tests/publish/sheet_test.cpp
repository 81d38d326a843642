// Contact sheets: every picture and every word in its place.
#include <string>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "draw/font.hpp"
#include "publish/paper.hpp"
#include "render/sample_scene.hpp"

namespace lantern::publish {
namespace {

TEST(SheetGrid, IsAcrossAndDown) {
  const auto grid = sheet_grid("3x2");
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->columns, 3);
  EXPECT_EQ(grid->rows, 2);
  EXPECT_TRUE(sheet_grid("1x1"));
  EXPECT_TRUE(sheet_grid("10x10"));
  for (const char* words : {"", "3", "x", "3x", "x2", "0x2", "2x0", "-1x2", "3x2x1", "3 x 2", "3X2",
                            "100x100", "11x1", "3x2 ", "99999999999x1", "2.5x2"})
    EXPECT_FALSE(sheet_grid(words)) << words;
}

Box<2> text_box(const TextShape& s) {
  const double width = text_width(s.text, s.size, s.weight);
  const double left = s.at.x - s.align * width;
  return {{left, s.at.y - s.size}, {left + width, s.at.y + 0.3 * s.size}};
}

// Frames of pictures, in order.
std::vector<Box<2>> frames_of(const DrawList& page) {
  std::vector<Box<2>> found;
  for (const DrawShape& shape : page.shapes)
    if (const auto* r = std::get_if<RectShape>(&shape); r && r->stroke.role == Role::rule)
      found.push_back(r->box);
  return found;
}

DrawList full_page(const SheetLayout& layout, const SheetGrid& grid, const std::string& caption) {
  SheetPicture picture{{}, "17", caption};
  picture.list.page = layout.picture();
  return layout.page(std::vector(grid.pictures(), picture), {"The title", "page 1 of 1"});
}

TEST(Sheet, PicturesAndCaptionsShareNoPlaceOnAnyGrid) {
  std::string caption;
  for (int i = 0; i < 8; ++i) caption += "quick brown foxes ";
  for (const Vec<2> paper : {Vec<2>(297, 210), Vec<2>(60, 90)})
    for (const int columns : {1, 3, 10})
      for (const int rows : {1, 2, 10}) {
        const SheetGrid grid{columns, rows};
        const SheetLayout layout(paper, grid);
        const DrawList page = full_page(layout, grid, caption);
        std::vector<Box<2>> boxes = frames_of(page);
        ASSERT_EQ(boxes.size(), grid.pictures());
        for (const DrawShape& shape : page.shapes)
          if (const auto* s = std::get_if<TextShape>(&shape)) boxes.push_back(text_box(*s));
        std::size_t outside = 0, overlaps = 0;
        for (std::size_t a = 0; a < boxes.size(); ++a) {
          outside += !holds({{0, 0}, page.page}, boxes[a]);
          const Box<2> core = shrunk(boxes[a], 0.14 * boxes[a].size().y);
          for (std::size_t b = 0; b < a; ++b) overlaps += overlap(core, boxes[b]);
        }
        EXPECT_EQ(outside, 0u) << columns << "x" << rows;
        EXPECT_EQ(overlaps, 0u) << columns << "x" << rows;
      }
}

TEST(Sheet, NoTypeIsBelowItsLeast) {
  for (const Vec<2> paper : {Vec<2>(297, 210), Vec<2>(210, 297), Vec<2>(148, 105)})
    for (const int columns : {1, 2, 4})
      for (const double points : {6.0, 9.0}) {
        const SheetGrid grid{columns, 2};
        const SheetLayout layout(paper, grid, points);
        if (!layout.is_roomy()) continue;
        SheetPicture picture{{}, "17", std::string(300, 'm')};
        picture.list.page = layout.picture();
        picture.list.shapes = {text("a", 50, 50, draw::kLeastLabel)};
        const DrawList page = layout.page({picture}, {"The title", "page 1 of 1"});
        for (const DrawShape& shape : page.shapes)
          if (const auto* s = std::get_if<TextShape>(&shape)) {
            EXPECT_GE(s->size * paper.x / page.page.x * 72 / 25.4, points - 1e-6)
                << s->text << " on " << columns << " columns";
          }
      }
  EXPECT_TRUE(SheetLayout({210, 297}, {2, 3}).is_roomy());
  EXPECT_FALSE(SheetLayout({297, 210}, {4, 4}).is_roomy());
  EXPECT_FALSE(SheetLayout({60, 90}, {10, 10}).is_roomy());
}

TEST(Sheet, AStripOfPaperIsRefused) {
  EXPECT_THROW(SheetLayout({500, 1}, {1, 1}), Refused);
  EXPECT_THROW(SheetLayout({1, 500}, {1, 1}), Refused);
  EXPECT_THROW(SheetLayout({500, 60}, {1, 10}), Refused);
}

TEST(Sheet, PicturesKeepTheirUnitsAndMoveAsAWhole) {
  const SheetGrid grid{2, 1};
  const SheetLayout layout({297, 210}, grid);
  SheetPicture picture;
  picture.list.page = layout.picture();
  picture.list.shapes = {rect(10, 20, 30, 40, Role::ink), line(1, 2, 3, 4, {Role::ink, 2}),
                         text("halo", 5, 6, 24), ghost_body(50, 60, 20, Role::body_1)};
  const DrawList page = layout.page({picture, picture}, {});
  const auto frames = frames_of(page);
  ASSERT_EQ(frames.size(), 2u);
  std::size_t seen = 0;
  for (const DrawShape& shape : page.shapes)
    if (const auto* r = std::get_if<RectShape>(&shape); r && r->fill == Role::ink) {
      const Vec<2> offset = r->box.lo - frames[seen++].lo;
      EXPECT_NEAR(offset.x, 10, 1e-9);
      EXPECT_NEAR(offset.y, 20, 1e-9);
      EXPECT_NEAR(r->box.size().x, 30, 1e-9);
    }
  EXPECT_EQ(seen, 2u);
}

TEST(Sheet, LongCaptionsEndWithAnEllipsisAndShortOnesAreWhole) {
  const SheetGrid grid{3, 2};
  const SheetLayout layout({297, 210}, grid);
  const auto words = [&](const std::string& caption) {
    std::string all;
    for (const DrawShape& shape : full_page(layout, grid, caption).shapes)
      if (const auto* s = std::get_if<TextShape>(&shape)) all += s->text + "\n";
    return all;
  };
  EXPECT_NE(words("The root is full: it splits.").find("The root is full: it splits."),
            std::string::npos);
  EXPECT_NE(words(std::string(50, 'w') + " " + std::string(400, 'm')).find("…"), std::string::npos);
  EXPECT_EQ(words("").find("…"), std::string::npos);
}

}  // namespace
}  // namespace lantern::publish
