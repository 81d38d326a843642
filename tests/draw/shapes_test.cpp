// Characters, patterns and the atlas's image: that they stay where they belong.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "draw/body_shapes.hpp"
#include "draw/draw_list.hpp"
#include "draw/page.hpp"
#include "draw/pen.hpp"
#include "draw/sample_frames.hpp"
#include "draw/texture_picture.hpp"

namespace lantern::draw {
namespace {

Box<2> painted(const DrawShape& shape) {
  if (const auto* rect = std::get_if<RectShape>(&shape)) {
    const bool stroked = rect->stroke.role != Role::none;
    return shrunk(rect->box, stroked ? -rect->stroke.width / 2 : 0);
  }
  if (const auto* line = std::get_if<LineShape>(&shape))
    return shrunk(united(Box<2>{line->from, line->from}, Box<2>{line->to, line->to}),
                  -line->stroke.width / 2);
  const auto& polygon = std::get<PolygonShape>(shape);
  Box<2> box{polygon.points[0], polygon.points[0]};
  for (const Vec<2>& p : polygon.points) box = united(box, Box<2>{p, p});
  return shrunk(box, polygon.stroke.role != Role::none ? -polygon.stroke.width / 2 : 0);
}

// Of a body so far from the origin that its box has no height left.
TEST(Characters, OfAThinBodyFarAwayStayInTheirPlace) {
  FrameBody body;
  body.look = Look::box;
  body.shape = Capsule{1e-7, 1.5};
  body.position = {1.7, 1e30, 0};
  body.box = {{1.7 - 1e-7, 1e30, 0}, {1.7 + 1e-7, 1e30, 0}};
  const Box<2> place{{10, 20}, {40, 50}};
  const std::vector<Vec<2>> outline = turned_outline(body, place);
  ASSERT_FALSE(outline.empty());
  for (const Vec<2>& p : outline)
    EXPECT_TRUE(contains(shrunk(place, -1e-6), p)) << p.x << " " << p.y;
}

TEST(Characters, FillTheirPlaceAndStayInIt) {
  for (const Look look : {Look::ghost, Look::player, Look::ball, Look::bat, Look::disc, Look::box,
                          Look::demon, Look::item})
    for (const double size : {3.0, 18.0, 26.0, 80.0, 400.0})
      for (int color = 1; color <= 8; ++color) {
        FrameBody body;
        body.look = look;
        body.color = color;
        body.velocity = {-2.0, 1.0, 0.0};
        const Box<2> place{{10, 20}, {10 + size, 20 + 1.3 * size}};
        DrawList list;
        draw_character(body, place, false, list);
        ASSERT_FALSE(list.shapes.empty());
        EXPECT_LE(list.shapes.size(), 9u);
        const bool has_halo = is_character(body) && size > 14;
        if (has_halo) list.shapes.erase(list.shapes.begin());
        Box<2> all = painted(list.shapes[0]);
        for (const DrawShape& shape : list.shapes) {
          all = united(all, painted(shape));
          if (const auto* polygon = std::get_if<PolygonShape>(&shape)) {
            EXPECT_LE(polygon->points.size(), look == Look::player ? 40u : 48u);
          }
        }
        EXPECT_TRUE(holds(shrunk(place, -1.3), all)) << "look " << int(look) << " size " << size;
        EXPECT_GE(all.size().x, 0.85 * size) << "look " << int(look) << " size " << size;
      }
}

TEST(Characters, LookWhereTheyMove) {
  for (const double x : {-3.0, 3.0}) {
    FrameBody body;
    body.look = Look::ghost;
    body.velocity = {x, 0, 0};
    DrawList list;
    draw_character(body, {{0, 0}, {100, 100}}, false, list);
    double white = 0, pupil = 0;
    for (const DrawShape& shape : list.shapes)
      if (const auto* rect = std::get_if<RectShape>(&shape)) {
        if (rect->fill == Role::eye) white += rect->box.center().x;
        if (rect->fill == Role::pupil) pupil += rect->box.center().x;
      }
    EXPECT_GT((pupil - white) * x, 0) << "the pupils are on the wrong side";
  }
}

TEST(Characters, ColoursHaveDifferentEmblems) {
  std::vector<std::vector<Box<2>>> drawn;
  for (int color = 1; color <= 8; ++color) {
    DrawList list;
    draw_emblem(color, {50, 50}, 10, list);
    std::vector<Box<2>> boxes{
        {Vec<2>(double(list.shapes[0].index())), Vec<2>(double(list.shapes.size()))}};
    for (const DrawShape& shape : list.shapes) boxes.push_back(painted(shape));
    for (const auto& other : drawn) EXPECT_NE(boxes, other) << "colour " << color;
    drawn.push_back(boxes);
  }
}

TEST(Pattern, StaysInItsRectangleAndIsBounded) {
  Random random(3);
  for (std::uint32_t id = 0; id < 400; ++id) {
    const Vec<2> lo{random.between(-100, 100), random.between(-100, 100)};
    const Box<2> rect{lo, lo + Vec<2>(random.between(0.5, 900), random.between(0.5, 900))};
    DrawList list;
    const int most = static_cast<int>(random.whole(1, kMostPatternParts));
    draw_pattern(id, static_cast<int>(id % 8) + 1, rect, random.between(0.3, 2), most, list);
    EXPECT_LE(list.shapes.size(), static_cast<std::size_t>(most) + 1) << "texture " << id;
    EXPECT_GE(list.shapes.size(), 2u) << "texture " << id << " has no pattern";
    for (const DrawShape& shape : list.shapes)
      EXPECT_TRUE(holds(shrunk(rect, -1e-9), painted(shape))) << "texture " << id;
  }
}

TEST(AtlasImage, HoldsEachPackedTextureAndNothingElse) {
  const Frame frame = samples::atlas(60, 60);
  const DrawList list = draw_atlas_image(frame);
  EXPECT_EQ(list.page, Vec<2>(512, 512)) << "one unit a pixel";
  EXPECT_TRUE(list.labels.empty());
  std::size_t grounds = 0;
  for (const DrawShape& shape : list.shapes) {
    ASSERT_FALSE(std::holds_alternative<TextShape>(shape));
    const Box<2> box = painted(shape);
    bool in_one = false;
    for (const FrameTexture& t : frame.get<FrameTextures>().textures) {
      const Box<2> place{{t.x, t.y}, {t.x + t.width, t.y + t.height}};
      if (!t.packed) continue;
      in_one = in_one || holds(shrunk(place, -1e-9), box);
      grounds += box == place && std::get_if<RectShape>(&shape) != nullptr;
    }
    EXPECT_TRUE(in_one) << "something is painted between the textures";
  }
  const auto packed = std::count_if(frame.get<FrameTextures>().textures.begin(),
                                    frame.get<FrameTextures>().textures.end(),
                                    [](const FrameTexture& t) { return t.packed; });
  EXPECT_GE(grounds, static_cast<std::size_t>(packed)) << "a packed texture is not painted";
}

TEST(Clip, KeepsWhatLiesInside) {
  const Box<2> rect{{0, 0}, {10, 10}};
  DrawList list;
  list.disc({0, 5}, 3, Role::body_1);
  list.disc({50, 5}, 3, Role::body_2);
  list.shapes.emplace_back(LineShape{{1, 1}, {2, 2}, {Role::ink, 0, 0}, false});
  cut_shapes(list, 0, rect);
  ASSERT_EQ(list.shapes.size(), 2u) << "the disc outside goes, the line inside stays";
  for (const DrawShape& shape : list.shapes)
    EXPECT_TRUE(holds(shrunk(rect, -1e-9), painted(shape)));
  EXPECT_NEAR(painted(list.shapes[0]).hi.x + painted(list.shapes[1]).hi.x, 5, 0.05);
}

}  // namespace
}  // namespace lantern::draw
