#include "draw/marks.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "draw/body_shapes.hpp"
#include "draw/draw_list.hpp"
#include "draw/labels.hpp"
#include "draw/page.hpp"
#include "draw/pen.hpp"
#include "draw/sample_frames.hpp"
#include "draw/world/world3d_parts.hpp"
#include "frame/parts/asked.hpp"
#include "geometry/flat.hpp"
#include "scenario/directing.hpp"

namespace lantern::draw {
namespace {

using samples::page_of;

Frame sample(const std::string& name) {
  for (auto& [known, frame] : samples::worlds())
    if (known == name) return frame;
  ADD_FAILURE() << "no sample " << name;
  return {};
}

template <class Shape, class F>
int count(const DrawList& list, const F& matches) {
  int n = 0;
  for (const DrawShape& shape : list.shapes)
    if (const auto* s = std::get_if<Shape>(&shape)) n += matches(*s);
  return n;
}

int labels(const DrawList& list, const std::string& text) {
  return static_cast<int>(std::count_if(list.labels.begin(), list.labels.end(),
                                        [&](const LabelBox& l) { return l.text == text; }));
}

TEST(Clip, LinesAreCutToTheRectangle) {
  const Box<2> rect{{0, 0}, {10, 10}};
  const auto cut = cut_line({-5, 5}, {15, 5}, rect);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->first, Vec<2>(0, 5));
  EXPECT_EQ(cut->second, Vec<2>(10, 5));
  EXPECT_FALSE(cut_line({-5, 0}, {0, 20}, rect)) << "it passes the corner by";
  EXPECT_FALSE(cut_line({std::nan(""), 0}, {5, 5}, rect));
  EXPECT_FALSE(cut_line({0, 0}, {HUGE_VAL, 5}, rect));
  // Ends that are far away, where doubles skip whole pages.
  Random random(1);
  for (int i = 0; i < 200'000; ++i) {
    const auto far = [&] { return random.between(-1, 1) * std::pow(10, random.between(0, 17)); };
    const Vec<2> from(far(), far());
    const Vec<2> to = random.unit() < 0.5 ? Vec<2>(far(), far()) : -from + Vec<2>(far(), far());
    if (const auto part = cut_line(from, to, rect)) {
      ASSERT_TRUE(contains(rect, part->first) && contains(rect, part->second));
    }
  }
  const auto point = cut_line({3, 3}, {3, 3}, rect);
  ASSERT_TRUE(point);
  EXPECT_EQ(point->first, Vec<2>(3, 3));
}

TEST(Pen, NothingLeavesItsPlace) {
  DrawList list;
  const Box<2> place{{100, 100}, {300, 200}};
  Pen pen(list, place);
  pen.arrow({0, 0}, {500, 290}, {Role::ray, 3, 0}, 20);
  pen.polygon({{0, 0}, {400, 0}, {400, 400}, {0, 400}}, Role::view_fill);
  pen.hatch({{90, 90}, {350, 120}, {200, 260}}, 10, 1, {Role::ink, 1, 0});
  pen.dot({299, 150}, 5, Role::ink);
  EXPECT_FALSE(list.shapes.empty());
  for (const DrawShape& shape : list.shapes) {
    if (const auto* line = std::get_if<LineShape>(&shape)) {
      EXPECT_TRUE(contains(place, line->from) && contains(place, line->to));
    } else if (const auto* polygon = std::get_if<PolygonShape>(&shape)) {
      for (const Vec<2>& p : polygon->points) EXPECT_TRUE(holds(shrunk(place, -1e-9), {p, p}));
    } else {
      ADD_FAILURE() << "a dot that does not fit must not be drawn";
    }
  }
}

TEST(Pen, HatchOfAHugePlaceStaysFew) {
  DrawList list;
  Pen pen(list, {{0, 0}, {1e5, 1e5}});
  pen.hatch({{0, 0}, {1e5, 0}, {1e5, 1e5}, {0, 1e5}}, 2, 1, {Role::ink, 1, 0}, 30);
  EXPECT_LE(list.shapes.size(), 31u);
  EXPECT_GE(list.shapes.size(), 10u);
}

TEST(BodyShapes, ATurnedBoxTouchesAllSidesOfItsBox) {
  for (const double angle : {0.0, 0.3, 1.2, 2.9, -4.0})
    for (const Shape<2>& shape : {Shape<2>(OrientedBox<2>{{2, 1}}), Shape<2>(Capsule{0.5, 1.5})}) {
      FrameBody body;
      body.shape = in_dimension<3>(shape);
      body.angle = angle;
      body.box = solid(bounding_box(shape, Vec<2>(0.0), Rotation<2>{angle}));
      const Box<2> place = Box<2>::around({50, 60}, flat(body.box.size()) * 10.0);
      const std::vector<Vec<2>> outline = turned_outline(body, place);
      ASSERT_GE(outline.size(), 4u);
      Box<2> reached{outline[0], outline[0]};
      for (const Vec<2>& p : outline) reached = united(reached, Box<2>{p, p});
      // A capsule's round ends are drawn with corners.
      for (int axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(reached.lo[axis], place.lo[axis], 0.2) << angle;
        EXPECT_NEAR(reached.hi[axis], place.hi[axis], 0.2) << angle;
      }
    }
}

TEST(BodyShapes, CounterClockwiseIsCounterClockwiseOnThePage) {
  FrameBody body;
  body.shape = Capsule{0.1, 1};
  body.angle = 0.5;  // its upper end leans left
  body.box = solid(bounding_box(Shape<2>(Capsule{0.1, 1}), Vec<2>(0.0), Rotation<2>{0.5}));
  const auto outline = turned_outline(body, Box<2>::around({0, 0}, flat(body.box.size()) * 50.0));
  const auto top = std::min_element(outline.begin(), outline.end(),
                                    [](const Vec<2>& a, const Vec<2>& b) { return a.y < b.y; });
  EXPECT_LT(top->x, 0);
}

TEST(Marks, AnImpulseTwiceAsLargeHasALongerArrow) {
  Frame frame = sample("world_slope");
  FrameContact contact;
  contact.normal = {0, 1, 0};
  contact.points = {{{-4, 5, 0}, 0, 1}, {{0, 5, 0}, 0, 2}, {{4, 5, 0}, 0, 4}};
  frame.contacts = {contact};
  std::vector<double> lengths;
  for (const DrawShape& shape : page_of(frame).shapes)
    if (const auto* line = std::get_if<LineShape>(&shape);
        line && line->stroke.role == Role::contact && line->stroke.width == 2.4)
      lengths.push_back(line->from.y - line->to.y);
  ASSERT_EQ(lengths.size(), 3u);
  EXPECT_LT(lengths[0], lengths[1]);
  EXPECT_LT(lengths[1], lengths[2]);
  EXPECT_GT(lengths[0], 0) << "up in the world is up on the page";
}

TEST(Marks, OfSmallBodiesAreSmallThemselves) {
  const Box<2> panel{{0, 0}, {600, 600}};
  const auto longest = [&](double radius) {
    Frame frame;
    frame.bounds = {{-4, -4, -1}, {4, 4, 1}};
    FrameBody bead;
    bead.id = 1;
    bead.box = Box<3>::around({1, 1, 0}, Vec<3>(radius));
    frame.bodies = {bead};
    FrameContact contact;
    contact.pair = {0, 1};
    contact.normal = {0, 1, 0};
    contact.points.push_back({{1, 1, 0}, 0, 2.0});
    frame.contacts = {contact};
    DrawList list;
    const View2D plane(flat(frame.bounds), panel);
    const Marks marks(plane, panel, list);
    EXPECT_TRUE(mark_contacts(frame, marks));
    double most = 0;
    for (const DrawShape& shape : list.shapes)
      if (const auto* line = std::get_if<LineShape>(&shape))
        most = std::max(most, glm::distance(line->from, line->to));
    return most;
  };
  EXPECT_LT(longest(0.1), 0.3 * 600 / 8) << "not much more than the bead, 0.2 of 8 units wide";
  EXPECT_GT(longest(1.0), 36) << "and of a large one as large as they come";
}

TEST(Marks, HitsAreNumberedInOrder) {
  const DrawList list = page_of(sample("world_rays"));
  for (const char* number : {"1", "2", "3", "4", "5"}) EXPECT_GE(labels(list, number), 1) << number;
}

TEST(Marks, SectorsAreNumberedFromOneInOrder) {
  Frame frame = sample("world_level");
  frame.panels = {panel_named("world")};
  frame.steps = 0;
  frame.counts.clear();
  const DrawList list = page_of(frame);
  for (const char* number : {"1", "2", "3", "4"}) EXPECT_EQ(labels(list, number), 1) << number;
}

TEST(Marks, NeighbouringSectorsHaveDifferentTones) {
  Frame frame = sample("world_level");
  for (FrameNode& node : frame.nodes) {
    node.mark = Mark::quiet;
    node.solid = false;
  }
  std::vector<const PolygonShape*> sectors;
  const DrawList list = page_of(frame);
  for (const DrawShape& shape : list.shapes)
    if (const auto* polygon = std::get_if<PolygonShape>(&shape);
        polygon && polygon->fill >= Role::sector_1 && polygon->fill <= Role::sector_4)
      sectors.push_back(polygon);
  ASSERT_EQ(sectors.size(), 4u);
  EXPECT_NE(sectors[0]->fill, sectors[1]->fill) << "back.back and back.front share the corridor";
  EXPECT_NE(sectors[2]->fill, sectors[3]->fill) << "front.back and front.front share the gate";
}

TEST(Marks, DimmedBodiesAreDottedAndPale) {
  FrameBody body;
  body.look = Look::disc;
  body.dimmed = true;
  DrawList list;
  draw_character(body, {{0, 0}, {60, 60}}, false, list);
  const auto& rect = std::get<RectShape>(list.shapes[0]);
  EXPECT_EQ(rect.fill, Role::panel);
  EXPECT_GT(rect.stroke.dash, 0);
}

TEST(Marks, StaticBodiesAreHatchedInPrintToo) {
  FrameBody body;
  DrawList moving, still;
  draw_character(body, {{0, 0}, {60, 60}}, false, moving);
  body.is_static = true;
  draw_character(body, {{0, 0}, {60, 60}}, false, still);
  const auto any = [](const LineShape&) { return true; };
  EXPECT_EQ(count<LineShape>(moving, any), 0);
  EXPECT_GE(count<LineShape>(still, any), 3);
}

TEST(Marks, ASleepingBranchIsHatchedOnce) {
  const auto toned = [](const PolygonShape& ground) { return ground.fill == Role::free_space; };
  Frame frame = sample("world_sleepers");
  EXPECT_GT(count<PolygonShape>(page_of(frame), toned), 0);
  frame.add<FrameStructure>().may_sleep = false;
  EXPECT_EQ(count<PolygonShape>(page_of(frame), toned), 0) << "what only rests is not asleep";
  frame.add<FrameStructure>().may_sleep = true;
  for (FrameNode& node : frame.nodes) node.awake = true;
  EXPECT_EQ(count<PolygonShape>(page_of(frame), toned), 0);
}

TEST(Marks, LeavesOfABspAreNamedByTheirLastPlane) {
  Frame frame = sample("world_level");
  for (FrameNode& node : frame.nodes) {
    if (!node.leaf || node.label.find('.') == std::string::npos) continue;
    node.mark = Mark::quiet;
    EXPECT_TRUE(leaf_names(frame, node).empty()) << node.label;
    node.mark = Mark::lit;
    EXPECT_EQ(leaf_names(frame, node)[0],
              frame.nodes[node.parent].plane_name + (node.slot == 0 ? ": back" : ": front"));
  }
  for (const LabelBox& label : page_of(frame).labels)
    EXPECT_EQ(label.text.find("front."), std::string::npos) << label.text;
}

TEST(Marks, WhatAStaleStructureMissesIsSaid) {
  for (const Frame& frame : run::frames_of("kdtree_static")) {
    const DrawList list = page_of(frame);
    // By the kD-tree alone, then by the quadtree, too.
    const int misses = frame.event == "missed" ? 1 : frame.event == "crossed" ? 2 : 0;
    EXPECT_EQ(labels(list, "missed"), misses) << frame.event;
    EXPECT_EQ(list.marks.has(MarkKind::missed), misses > 0) << frame.event;
  }
}

// How much of the bodies is filled.
int filled_parts(const DrawList& list) {
  int filled = 0;
  for (std::size_t i = 0; i < list.runs.size(); ++i) {
    if (!list.runs[i].key.starts_with("world/body")) continue;
    const std::size_t end = i + 1 < list.runs.size() ? list.runs[i + 1].first : list.shapes.size();
    for (std::size_t k = list.runs[i].first; k < end; ++k)
      if (const auto* shape = std::get_if<PolygonShape>(&list.shapes[k]))
        filled += shape->fill != Role::none;
  }
  return filled;
}

TEST(Marks, WhatIsOutlinedHidesNoCells) {
  Frame frame = run::at(run::frames_of("coincident_max_depth"), "limit_6");
  EXPECT_EQ(filled_parts(page_of(frame)), 0);
  frame.display.outlined = false;
  EXPECT_GT(filled_parts(page_of(frame)), 0);
}

TEST(Marks, ATextureThatComesLaterWaitsNowhere) {
  const auto frames = run::frames_of("kdtree_atlas");
  EXPECT_EQ(labels(page_of(frames.front()), "banner"), 0);
  EXPECT_GT(labels(page_of(run::at(frames, "refused")), "banner"), 0);
}

TEST(Marks, ALineOfALevelHasTheNumberOfItsWall) {
  int chosen = 0;
  for (const Frame& frame : run::frames_of("doom_level_bsp")) {
    const DrawList list = page_of(frame);
    if (frame.event == "choose" && chosen++ == 0) {
      EXPECT_EQ(labels(list, "wall 18"), 1) << "at the wall";
      EXPECT_EQ(labels(list, "11 in front"), 1) << "in front of it";
      EXPECT_EQ(labels(list, "13 behind"), 1) << "behind it";
    }
    if (frame.event == "compiled") {
      EXPECT_EQ(labels(list, "18"), 1) << "in the tree";
    }
    if (frame.event == "locate_court") {
      EXPECT_EQ(labels(list, "18"), 2) << "the line is asked";
    }
  }
  EXPECT_GT(chosen, 0);
}

TEST(Marks, ASpinningBodyHasItsAxes) {
  const MarkKind kinds[] = {MarkKind::spin, MarkKind::longest_axis, MarkKind::middle_axis,
                            MarkKind::shortest_axis};
  Frame frame = run::frames_of("tumbling_box")[0];
  for (const MarkKind kind : kinds) EXPECT_TRUE(page_of(frame).marks.has(kind)) << words_of(kind);
  frame.bodies[0].shape = frame.bodies[1].shape = Sphere{2};
  EXPECT_TRUE(page_of(frame).marks.has(MarkKind::spin));
  EXPECT_FALSE(page_of(frame).marks.has(MarkKind::middle_axis)) << "a ball has none of its own";
  for (FrameBody& body : frame.bodies) body.angular_velocity = Vec<3>(0.0);
  EXPECT_FALSE(page_of(frame).marks.has(MarkKind::spin));
}

TEST(Marks, BothTreesOfAForestAreDrawn) {
  const Frame frame = sample("world_forest");
  const DrawList list = page_of(frame);
  EXPECT_EQ(labels(list, "dynamic"), 1);
  EXPECT_EQ(labels(list, "static: never moves"), 1);
  std::set<std::string> nodes;
  for (const KeyedRun& run : list.runs)
    if (run.key.starts_with("tree/node/")) nodes.insert(run.key);
  EXPECT_EQ(nodes.size(), frame.nodes.size()) << "both are shown whole";
}

TEST(Marks, GroundAtTheEdgeOfTheWorldIsStillSeen) {
  const DrawList list = page_of(sample("world_stack5"));
  EXPECT_GE(
      count<PolygonShape>(list, [](const PolygonShape& p) { return p.fill == Role::free_space; }),
      1);
}

TEST(Marks, BoxesAndVelocitiesOnlyWhenAskedFor) {
  Frame frame = sample("world_shapes");
  const auto dashed = [](const RectShape& r) { return r.stroke.dash == 6; };
  const auto arrows = [](const LineShape& l) {
    return l.stroke.role == kVelocityStroke.role && l.stroke.width == kVelocityStroke.width;
  };
  EXPECT_GT(count<RectShape>(page_of(frame), dashed), 3);
  EXPECT_EQ(count<LineShape>(page_of(frame), arrows), 2);
  frame.display.boxes = frame.display.arrows = false;
  EXPECT_EQ(count<RectShape>(page_of(frame), dashed), 0);
  EXPECT_EQ(count<LineShape>(page_of(frame), arrows), 0);
}

// The ends of the longest line in that role.
double longest_line(const DrawList& list, Role role) {
  double longest = 0;
  for (const DrawShape& shape : list.shapes)
    if (const auto* line = std::get_if<LineShape>(&shape); line && line->stroke.role == role)
      longest = std::max(longest, glm::distance(line->from, line->to));
  return longest;
}

// Seen straight from the front, what lies in one plane looks as in a 2D world.
TEST(Marks, LookTheSameIn2DAnd3D) {
  const Box<2> panel{{0, 0}, {600, 600}};
  Frame frame;
  frame.bounds = {{-4, -4, -1}, {4, 4, 1}};
  FrameContact contact;
  contact.normal = {0, 1, 0};
  contact.points.push_back({{1, 1, 0}, 0, 2.0});
  frame.contacts = {contact};
  FrameRay ray;
  ray.from = {-2, 0, 0};
  ray.to = {2, 0, 0};
  frame.add<FrameFinding>().rays = {ray};
  DrawList in_2d, in_3d;
  const View2D plane(flat(frame.bounds), panel);
  Marks flat_marks(plane, panel, in_2d);
  const View3D front(frame.bounds, Camera{{0, 0, 50}, {0, 0, 0}, 0.7}, panel);
  const std::vector<Body3D> nobody;
  Marks3D deep_marks(front, nobody, in_3d);
  for (Marks* marks : {static_cast<Marks*>(&flat_marks), static_cast<Marks*>(&deep_marks)})
    mark_rays(frame, *marks);
  deep_marks.paint();
  for (const Marks* marks : {static_cast<Marks*>(&flat_marks), static_cast<Marks*>(&deep_marks)})
    EXPECT_TRUE(mark_contacts(frame, *marks));
  ASSERT_EQ(in_2d.shapes.size(), in_3d.shapes.size());
  EXPECT_NEAR(longest_line(in_2d, Role::contact), longest_line(in_3d, Role::contact), 1e-6)
      << "an impulse has one length, whatever the world";
  const double ratio = front.scale_at({0, 0, 0}) / plane.scale();
  EXPECT_NEAR(longest_line(in_3d, Role::ray), ratio * longest_line(in_2d, Role::ray), 15);
}

// A pile whose boxes just touch: on the page some of them lie apart by a rounding.
TEST(Marks, EachPairThatTouchesHasItsMark) {
  for (const double width : {22.0, 19.7, 31.3}) {
    Frame frame;
    frame.panels = {panel_named("world")};
    frame.bounds = {Vec<3>(0.0), {width, 12.5, 0}};
    for (const double y : {1.9, 3.7, 5.5, 7.3, 9.1}) {
      const auto i = static_cast<BodyId>(frame.bodies.size());
      FrameBody body;
      body.id = i;
      body.name = "b" + std::to_string(i);
      body.position = {6.5, y, 0};
      const Vec<3> half{1.1, 0.9, 0};
      body.shape = OrientedBox<3>{half};
      body.box = {body.position - half, body.position + half};
      frame.bodies.push_back(body);
      if (i > 0) frame.pairs.push_back({.pair = {i - 1, i}, .overlaps = true});
    }
    Work work;
    const DrawList list = draw_frame(frame, page_for(1600, 900), work);
    EXPECT_EQ(std::ranges::count_if(list.runs,
                                    [](const auto& run) { return run.key.ends_with("/boxes"); }),
              4)
        << width;
  }
}

}  // namespace
}  // namespace lantern::draw
