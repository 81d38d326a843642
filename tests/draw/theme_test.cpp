#include "draw/theme.hpp"

#include <set>

#include <gtest/gtest.h>

#include "draw/colour_vision.hpp"
#include "draw/font.hpp"
#include "draw/labels.hpp"
#include "draw/page.hpp"
#include "draw/sample_frames.hpp"
#include "draw/world/world2d_parts.hpp"

namespace lantern::draw {
namespace {

using vision::Eye;

TEST(Theme, IsFoundByName) {
  for (const char* name : {"light", "dark", "print"}) {
    ASSERT_TRUE(theme_named(name)) << name;
    EXPECT_EQ(theme_named(name)->name, name);
  }
  EXPECT_FALSE(theme_named("sepia")) << "an unknown name must not give some theme or other";
  EXPECT_EQ(themes().front().name, "light") << "the default is the first";
}

TEST(Theme, BodiesDifferForEveryEye) {
  for (const Theme& theme : themes()) {
    if (theme.name == "print") continue;
    for (const Eye eye : {Eye::normal, Eye::protan, Eye::deutan, Eye::tritan})
      for (int a = 1; a <= 8; ++a)
        for (int b = a + 1; b <= 8; ++b)
          EXPECT_GE(vision::distance(eye, theme[body_role(a)], theme[body_role(b)]), 18)
              << theme.name << ": bodies " << a << " and " << b << " look alike to eye "
              << static_cast<int>(eye);
  }
}

TEST(Theme, PrintHasGreysOnlyThatDiffer) {
  const Theme print = *theme_named("print");
  for (const Color& c : print.colors) EXPECT_TRUE(c.r == c.g && c.g == c.b) << "not a grey";
  for (int a = 1; a <= 8; ++a)
    for (int b = a + 1; b <= 8; ++b)
      EXPECT_GE(vision::distance(Eye::normal, print[body_role(a)], print[body_role(b)]), 7)
          << "bodies " << a << " and " << b << " are one grey on paper";
}

TEST(Theme, EmblemsShowOnTheirBodies) {
  for (const Theme& theme : themes())
    for (int color = 1; color <= 8; ++color) {
      const Color body = theme[body_role(color)], mark = theme[body_mark_role(color)];
      const double least = theme.name == "print" ? 30 : 9;
      EXPECT_GE(vision::distance(Eye::normal, body, mark), least)
          << theme.name << ": the second cue of body " << color << " cannot be seen";
    }
}

TEST(Theme, LinesNeverVanish) {
  for (const Theme& theme : themes()) {
    double last = 1e9;
    for (std::uint32_t depth = 0; depth < 4; ++depth) {
      const double c = vision::contrast(theme[cell_line_role(depth)], theme[Role::panel]);
      EXPECT_GE(c, 2.0) << theme.name << ": cell lines of depth " << depth << " are too faint";
      EXPECT_LT(c, last) << theme.name << ": deeper lines must be lighter";
      last = c;
    }
    for (const Role role : {Role::lit, Role::pair, Role::warning, Role::body_line})
      EXPECT_GE(vision::contrast(theme[role], theme[Role::panel]), 3.0)
          << theme.name << ": role " << static_cast<int>(role) << " is too faint";
  }
}

// What lies under a text: its halo, or the last shape before it that covers its middle.
Role ground_of(const DrawList& list, std::size_t text_at) {
  const auto& text = std::get<TextShape>(list.shapes[text_at]);
  if (text.halo != Role::none) return text.halo;
  const TextStyle style{text.size, text.weight, text.role, text.halo};
  const Vec<2> middle = Labels::extent(text.text, {text.at, text.align}, style).center();
  Role ground = Role::paper;
  for (std::size_t i = 0; i < text_at; ++i) {
    if (const auto* rect = std::get_if<RectShape>(&list.shapes[i])) {
      if (rect->fill != Role::none && contains(rect->box, middle)) ground = rect->fill;
    } else if (const auto* polygon = std::get_if<PolygonShape>(&list.shapes[i])) {
      if (polygon->fill != Role::none && inside(polygon->points, middle)) ground = polygon->fill;
    }
  }
  return ground;
}

TEST(Theme, TextCanBeReadWhereverItIsPainted) {
  std::set<std::pair<Role, Role>> used;
  for (const auto& [name, frame] : samples::all())
    for (const Vec<2> page : {page_for(1600, 900), page_for(900, 1600)}) {
      Work work;
      const DrawList list = draw_frame(frame, page, work);
      for (std::size_t i = 0; i < list.shapes.size(); ++i)
        if (const auto* text = std::get_if<TextShape>(&list.shapes[i]))
          used.emplace(text->role, ground_of(list, i));
    }
  EXPECT_GE(used.size(), 8u) << "the samples should use more than a few pairs of text and ground";
  for (const Theme& theme : themes())
    for (const auto& [text, ground] : used)
      EXPECT_GE(vision::contrast(theme[text], theme[ground]), 4.5)
          << theme.name << ": role " << static_cast<int>(text) << " on "
          << static_cast<int>(ground);
}

}  // namespace
}  // namespace lantern::draw
