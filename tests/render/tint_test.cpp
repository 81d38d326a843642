// Shapes on their way in or out, or from one colour to another.
#include <cstdlib>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "render/renderer.hpp"
#include "render/sample_scene.hpp"
#include "render/support.hpp"
#include "render/svg.hpp"

namespace lantern::render {
namespace {

DrawList tinted_page(DrawShape shape, const Tint& tint) {
  DrawList list = page_of(160, 120, {std::move(shape)});
  list.tints = {tint};
  return list;
}

Rgba middle(const DrawList& list, bool transparent = false) {
  return at(drawn(list, 160, 120, transparent), 80, 60);
}

TEST(Tint, ThatChangesNothingChangesNoPixelAndNoByte) {
  const DrawList plain = sample_scene();
  DrawList tinted = plain;
  tinted.tints.resize(plain.shapes.size());
  EXPECT_EQ(drawn(plain, 320, 180).rgba, drawn(tinted, 320, 180).rgba);
  EXPECT_EQ(to_svg(plain, plain_theme(), false, 320, 180),
            to_svg(tinted, plain_theme(), false, 320, 180));
}

TEST(Tint, LetsThePaperThroughWhateverTheShape) {
  const DrawShape shapes[] = {
      rect(10, 10, 140, 100, Role::ink),            // large: its inside is drawn apart
      rect(70, 50, 20, 20, Role::ink),              // small
      rect(70, 50, 20, 20, Role::ink, {}, 10),      // a disc
      line(10, 60.5, 150, 60.5, {Role::ink, 9}),    // level
      line(20, 60, 140, 60, {Role::ink, 9}, true),  // on whole pixels
      line(40, 20, 121, 101, {Role::ink, 12}),      // slanting
      PolygonShape{{{20, 10}, {140, 15}, {80, 115}}, Role::ink, {}},
      PolygonShape{{{20, 60}, {140, 60}, {140, 61}}, Role::none, {Role::ink, 12}},
  };
  for (const DrawShape& shape : shapes) {
    const DrawList list = tinted_page(shape, {0.5});
    EXPECT_NEAR(middle(list).r, 127, 1) << "kind " << shape.index();
    const Rgba over_nothing = middle(list, true);
    EXPECT_EQ(over_nothing.r, 0);
    EXPECT_NEAR(over_nothing.a, 128, 1);
    EXPECT_EQ(middle(tinted_page(shape, {0})), (Rgba{255, 255, 255, 255}));
  }
  // Letters, which have no middle.
  DrawList words = tinted_page(text("MMM", 20, 80, 60), {0.5});
  const Image half = drawn(words, 160, 120);
  words.tints.clear();
  const Image whole = drawn(words, 160, 120);
  for (int x = 0; x < 160; ++x) EXPECT_NEAR(ink(half, x, 60), ink(whole, x, 60) / 2.0, 1.5) << x;
}

TEST(Tint, MixesTheColoursOfTwoRoles) {
  const DrawShape shape = rect(10, 10, 140, 100, Role::ink, {Role::warning, 8});
  const DrawList list = tinted_page(shape, {1, 0.25, Role::warning, Role::ink});
  EXPECT_EQ(middle(list), (Rgba{64, 0, 0, 255}));
  EXPECT_EQ(at(drawn(list, 160, 120), 80, 10), (Rgba{191, 0, 0, 255}));
  const std::string svg = to_svg(list, plain_theme(), false, 160, 120);
  EXPECT_NE(svg.find("fill=\"#400000\" stroke=\"#bf0000\" stroke-width=\"8\""), std::string::npos)
      << svg;
}

TEST(Tint, FromNoColourIsMoreOrLessOpaque) {
  const DrawList comes = tinted_page(rect(10, 10, 140, 100, Role::warning), {1, 0.75});
  EXPECT_EQ(middle(comes, true).r, 255);
  EXPECT_NEAR(middle(comes, true).a, 64, 1);
  const DrawList goes =
      tinted_page(rect(10, 10, 140, 100, Role::none), {0.5, 0.5, Role::warning, Role::none});
  EXPECT_NEAR(middle(goes, true).a, 64, 1);
}

TEST(Tint, IsWrittenAsOpacity) {
  DrawList list = page_of(160, 120,
                          {rect(1, 1, 9, 9, Role::ink, {Role::ink, 2}),
                           text("a", 20, 20, 10, Role::ink, 0, Weight::regular, Role::warning)});
  list.tints = {{0.5}, {0.25}};
  const std::string svg = to_svg(list, plain_theme(), false, 160, 120);
  EXPECT_NE(svg.find("fill=\"#000000\" fill-opacity=\"0.502\" stroke=\"#000000\" "
                     "stroke-opacity=\"0.502\""),
            std::string::npos)
      << svg;
  EXPECT_NE(svg.find("fill=\"#ff0000\" fill-opacity=\"0.251\""), std::string::npos) << svg;
}

TEST(Tint, IsThereForEachShapeOrForNone) {
  DrawList list = page_of(160, 120, {rect(1, 1, 9, 9, Role::ink), rect(1, 1, 9, 9, Role::ink)});
  list.tints.resize(1);
  EXPECT_THROW(drawn(list, 160, 120), Refused);
  EXPECT_THROW(to_svg(list, plain_theme(), false, 160, 120), Refused);
}

}  // namespace
}  // namespace lantern::render
