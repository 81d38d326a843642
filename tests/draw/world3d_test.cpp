#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "draw/colour_vision.hpp"
#include "draw/page.hpp"
#include "draw/panel.hpp"
#include "draw/theme.hpp"
#include "draw/world/world3d_parts.hpp"
#include "draw/world3d_samples.hpp"
#include "geometry/random_vec.hpp"

namespace lantern::draw {
namespace {

const Box<2> kPanel{{60, 104}, {1540, 720}};

DrawList drawn(const Frame& frame, const Box<2>& panel = kPanel) {
  DrawList list;
  Labels labels(list);
  draw_world(frame, Staging(frame), panel, list, labels);
  return list;
}

std::vector<Vec<2>> points_of(const DrawShape& shape) {
  if (const auto* rect = std::get_if<RectShape>(&shape)) return {rect->box.lo, rect->box.hi};
  if (const auto* line = std::get_if<LineShape>(&shape)) return {line->from, line->to};
  if (const auto* polygon = std::get_if<PolygonShape>(&shape)) return polygon->points;
  return {std::get<TextShape>(shape).at};
}

// Cameras that a file may ask for, and no one should.
std::vector<Camera> extreme_cameras(const Box<3>& bounds) {
  const Vec<3> c = bounds.center();
  return {{c, c + Vec<3>(1, 0, 0), 0.7},                  // in the middle
          {c, c - Vec<3>(0, 1, 0), 3.1},                  // straight down, very wide
          {bounds.lo, bounds.hi, 0.7},                    // in a corner
          {bounds.hi, bounds.hi + Vec<3>(1, 1, 1), 0.7},  // with all behind it
          {c + Vec<3>(1e9, 1e9, 1e9), c, 0.001},          // from the moon
          {{c.x, bounds.lo.y - 3, c.z + 40}, c, 0.7},     // from under the floor
          {c + Vec<3>(0, 50, 0), c, 0.0},                 // from straight above
          {c + Vec<3>(1e-13, 0, 0), c, 0.7}};             // looking nowhere
}

void expect_sound(const DrawList& list, const std::string& name) {
  for (const DrawShape& shape : list.shapes) {
    if (const auto* polygon = std::get_if<PolygonShape>(&shape)) {
      ASSERT_GE(polygon->stroke.width, 0) << name;
      ASSERT_LE(polygon->stroke.width, kPanel.size().x) << name;
    }
    for (const Vec<2>& p : points_of(shape)) {
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << name << ": not a place on a page";
      ASSERT_TRUE(contains(shrunk(kPanel, -4), p))
          << name << ": " << p.x << ", " << p.y << " is out of the panel, shape " << shape.index();
    }
  }
  for (std::size_t i = 0; i < list.labels.size(); ++i) {
    EXPECT_TRUE(holds(kPanel, list.labels[i].box)) << name << ": " << list.labels[i].text;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(overlap(list.labels[i].box, list.labels[j].box))
          << name << ": '" << list.labels[i].text << "' lies on '" << list.labels[j].text << "'";
  }
}

TEST(World3D, StaysInItsPanelAndLabelsKeepApart) {
  for (const auto& [name, frame] : samples::all_solid()) expect_sound(drawn(frame), name);
}

TEST(World3D, IsSoundForEveryCamera) {
  for (const auto& [name, sample] : samples::all_solid()) {
    Frame frame = sample;
    int number = 0;
    for (const Camera& camera : extreme_cameras(frame.bounds)) {
      frame.camera = camera;
      expect_sound(drawn(frame), name + " " + std::to_string(number++));
    }
  }
}

TEST(World3D, IsSoundForStrangeBodies) {
  Frame frame = samples::tower_frame();
  frame.bodies.push_back(samples::solid_body(90, "far", Sphere{1}, {1e200, 0, 0}, 2));
  frame.bodies.push_back(samples::solid_body(91, "giant", Sphere{1e6}, {0, -1e6, 0}, 2));
  frame.bodies.push_back(samples::solid_body(92, "flat", AxisBox<3>{{1, 0, 1}}, {0, 8, 0}, 3));
  frame.bodies.push_back(samples::solid_body(93, "point", Sphere{0}, {1, 8, 0}, 3));
  frame.bodies.push_back(samples::solid_body(94, "same", Sphere{0.7}, {3.1, 3.4, 2.0}, 3));
  frame.bodies.push_back(
      samples::solid_body(95, "slope", HalfSpace<3>{{0.6, 0.8, 0}}, {0, 1, 0}, 3));
  frame.bounds = {{-5, 0, -5}, {5, 9, 5}};
  expect_sound(drawn(frame), "strange bodies");
  frame.bounds = {{2, 2, 2}, {2, 2, 2}};
  expect_sound(drawn(frame), "a world without extent");
}

TEST(World3D, WhoFliesFarAwayIsFewShapes) {
  Frame frame;
  frame.dimension = 3;
  frame.bounds = {{0, 0, 0}, {16, 12, 16}};
  frame.camera = Camera{{9, 2, 6}, {2, 9, 4}, 0.7};
  for (const double height : {1e4, 1e6, 1e7}) {
    frame.bodies = {samples::solid_body(0, "high", Sphere{6}, {height, height, height}, 1),
                    samples::solid_body(1, "here", Sphere{1}, {5, 5, 5}, 2)};
    const DrawList list = drawn(frame);
    expect_sound(list, "far away");
    EXPECT_LT(list.shapes.size(), 500u);
  }
}

// Their faces have corners before it and behind it.
TEST(World3D, IsSoundForBoxesThatReachPastTheEye) {
  Random random(7);
  const auto somewhere = [&] { return geometry::random_point<3>(random, 0, 16); };
  for (int i = 0; i < 500; ++i) {
    Frame frame;
    frame.dimension = 3;
    frame.bounds = {{0, 0, 0}, {16, 12, 16}};
    frame.camera = Camera{somewhere(), somewhere(), 0.7};
    frame.bodies.push_back(
        samples::solid_body(0, "tall", AxisBox<3>{{313, 2054, 1}}, somewhere(), 1));
    expect_sound(drawn(frame), "tall box " + std::to_string(i));
  }
}

TEST(World3D, ItsAxesHaveLettersWhereItsHeightsHaveNumbers) {
  Frame frame = samples::octree_frame();
  const auto letters = [&] {
    std::string found;
    for (const LabelBox& label : drawn(frame).labels)
      if (label.text == "x" || label.text == "y" || label.text == "z") found += label.text;
    return found;
  };
  EXPECT_EQ(letters(), "yxz");
  for (FrameBody& body : frame.bodies) body.is_static = true;
  EXPECT_EQ(letters(), "") << "nothing floats";
}

TEST(World3D, IsTheSameListEachTime) {
  for (const auto& [name, frame] : samples::all_solid()) {
    const DrawList a = drawn(frame), b = drawn(frame);
    ASSERT_EQ(a.shapes.size(), b.shapes.size()) << name;
    for (std::size_t i = 0; i < a.shapes.size(); ++i) {
      ASSERT_EQ(a.shapes[i].index(), b.shapes[i].index()) << name;
      ASSERT_EQ(points_of(a.shapes[i]), points_of(b.shapes[i])) << name;
    }
  }
}

TEST(World3D, AFrameOfThreeDimensionsIsDrawnInSpace) {
  Frame frame = samples::octree_frame();
  Work work;
  const auto polygons = [&] {
    const DrawList list = draw_frame(frame, page_for(1600, 900), work);
    return std::count_if(list.shapes.begin(), list.shapes.end(), [](const DrawShape& shape) {
      const auto* polygon = std::get_if<PolygonShape>(&shape);
      return polygon != nullptr && polygon->fill >= Role::body_lit_1;
    });
  };
  EXPECT_GT(polygons(), 5) << "faces in tones";
  frame.dimension = 2;
  EXPECT_EQ(polygons(), 0) << "a flat world has none";
}

// The last shape with a fill over a place on the page.
Role fill_at(const DrawList& list, const Vec<2>& at) {
  Role fill = Role::none;
  for (const DrawShape& shape : list.shapes)
    if (const auto* polygon = std::get_if<PolygonShape>(&shape);
        polygon != nullptr && polygon->fill != Role::none &&
        cover_each_other(hull_of(polygon->points), {at, at + Vec<2>(0.5, 0.5)}))
      fill = polygon->fill;
  return fill;
}

TEST(World3D, ANearBodyHidesAFarOne) {
  Frame frame;
  frame.dimension = 3;
  frame.bounds = {{0, 0, 0}, {10, 10, 10}};
  frame.camera = Camera{{5, 5, 30}, {5, 5, 5}, 0.7};
  const Shape<3> plate = AxisBox<3>{{2, 2, 0.2}};
  for (const bool swapped : {false, true}) {
    frame.bodies = {samples::solid_body(0, "", plate, {5, 5, swapped ? 8 : 2}, 1),
                    samples::solid_body(1, "", plate, {5, 5, swapped ? 2 : 8}, 5)};
    const Role near_color = body_role(swapped ? 1 : 5);
    const View3D view(frame.bounds, frame.camera, kPanel);
    const Role seen = fill_at(drawn(frame), view.to_page({6.2, 6.2, 8.2}));
    EXPECT_TRUE(seen == near_color || seen == in_tone(near_color, Tone::lit) ||
                seen == in_tone(near_color, Tone::shade))
        << "the order of the bodies in the frame must not decide what is seen";
  }
}

TEST(World3D, CellEdgesAreDrawnOnce) {
  Frame frame = samples::octree_frame();
  frame.bodies.clear();
  frame.pairs.clear();
  frame.camera = Camera{{3, 9, 30}, {4, 4, 4}, 0.7};
  std::set<std::pair<std::pair<double, double>, std::pair<double, double>>> seen;
  for (const DrawShape& shape : drawn(frame).shapes) {
    const auto* line = std::get_if<LineShape>(&shape);
    if (line == nullptr || line->stroke.role == Role::rule) continue;
    std::pair<double, double> from{line->from.x, line->from.y}, to{line->to.x, line->to.y};
    if (to < from) std::swap(from, to);
    if (line->stroke.width == 1.6) continue;  // the floor's rim
    EXPECT_TRUE(seen.insert({from, to}).second) << "an edge is drawn twice";
  }
  EXPECT_GT(seen.size(), 20u);
}

TEST(World3D, DeepLevelsAreLeftOutOfACrowdAndSaid) {
  const DrawList list = drawn(samples::crowd_frame());
  EXPECT_LT(list.shapes.size(), 2500u);
  const bool said = std::any_of(list.labels.begin(), list.labels.end(), [](const LabelBox& label) {
    return label.text.find("1000 bodies as dots") != std::string::npos;
  });
  EXPECT_TRUE(said) << "what a picture leaves out must be said in it";
}

TEST(World3D, TonesOfAColourDiffer) {
  std::vector<Role> colors{Role::static_body, Role::asleep};
  for (int color = 1; color <= 8; ++color) colors.push_back(body_role(color));
  for (const Theme& theme : themes())
    for (const Role color : colors) {
      const Color lit = theme[in_tone(color, Tone::lit)], middle = theme[color],
                  shade = theme[in_tone(color, Tone::shade)];
      EXPECT_GE(vision::distance(vision::Eye::normal, middle, shade), 7) << theme.name;
      EXPECT_GE(vision::distance(vision::Eye::normal, lit, shade), 12) << theme.name;
      EXPECT_GE(vision::contrast(lit, shade), 1.4) << theme.name << ": one grey on paper";
    }
}

}  // namespace
}  // namespace lantern::draw
