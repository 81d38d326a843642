// The matrix of who sees whom.
#include <gtest/gtest.h>

#include "draw/layout_check.hpp"
#include "draw/sample_frames.hpp"
#include "frame/parts/level.hpp"

namespace lantern::draw {
namespace {

Frame frame_of(std::size_t sectors) {
  Frame frame;
  frame.title = "Who sees whom";
  frame.panels = {panel_named("matrix")};
  frame.add<FrameMatrix>().rows.assign(sectors, std::string(sectors, '0'));
  for (std::size_t i = 0; i < sectors; ++i) frame.add<FrameMatrix>().rows[i][i] = '1';
  return frame;
}

std::size_t squares(const DrawList& list, Role fill) {
  std::size_t n = 0;
  for (const DrawShape& shape : list.shapes)
    if (const auto* rect = std::get_if<RectShape>(&shape)) n += rect->fill == fill;
  return n;
}

TEST(Matrix, HasASquareForEachTwoSectorsAndLightsARow) {
  Frame frame = frame_of(3);
  frame.add<FrameMatrix>().rows = {"11.", "111", ".1."};
  frame.add<FrameMatrix>().lit = 1;
  const DrawList list = samples::page_of(frame);
  EXPECT_EQ(squares(list, Role::lit), 3u);
  EXPECT_EQ(squares(list, Role::cell_line_1), 3u + 1) << "and one in the key";
  EXPECT_EQ(squares(list, Role::free_space), 0u + 1);
  for (const char* const number : {"1", "2", "3"}) EXPECT_TRUE(says(list, number));
  EXPECT_TRUE(list.referents.contains("sectors_seen"));
}

TEST(Matrix, OfManySectorsStaysInItsPanel) {
  for (const std::size_t sectors : {1u, 13u, 40u, 200u}) {
    SCOPED_TRACE(sectors);
    const DrawList list = samples::page_of(frame_of(sectors));
    EXPECT_EQ(squares(list, Role::cell_line_1), sectors + 1);
    expect_laid_out(list, {{0, 0}, list.page}, 24, "the matrix");
  }
}

}  // namespace
}  // namespace lantern::draw
