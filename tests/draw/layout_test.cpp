#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "draw/draw_list.hpp"
#include "draw/layout_check.hpp"
#include "draw/page.hpp"
#include "draw/sample_frames.hpp"
#include "frame/parts/panels.hpp"

namespace lantern::draw {
namespace {

constexpr double kHair = 0.01;  // page units that rounding may cost

using Size = std::pair<int, int>;
constexpr Size kSizes[] = {{1600, 900},  {1280, 720}, {1200, 900},
                           {1000, 1000}, {900, 1600}, {2560, 1080}};

void for_each_page(
    const std::function<void(const std::string&, const Frame&, const DrawList&)>& f) {
  for (const auto& [name, frame] : samples::all())
    for (const auto& [width, height] : kSizes) {
      Work work;
      f(fmt::format("{} at {}x{}", name, width, height), frame,
        draw_frame(frame, page_for(width, height), work));
    }
}

std::string written(const DrawList& list) {
  std::string text = fmt::format("{} {}\n", list.page.x, list.page.y);
  for (const DrawShape& shape : list.shapes) {
    const Box<2> r = reach_of(shape);
    text += fmt::format("{} {:.17g} {:.17g} {:.17g} {:.17g}", shape.index(), r.lo.x, r.lo.y, r.hi.x,
                        r.hi.y);
    if (const auto* t = std::get_if<TextShape>(&shape)) text += t->text;
    if (const auto* p = std::get_if<PolygonShape>(&shape))
      for (const Vec<2>& q : p->points) text += fmt::format(" {:.17g} {:.17g}", q.x, q.y);
    text += '\n';
  }
  return text;
}

void expect_labels_apart(const std::string& where, const DrawList& list) {
  for (std::size_t i = 0; i < list.labels.size(); ++i)
    for (std::size_t j = i + 1; j < list.labels.size(); ++j)
      EXPECT_FALSE(overlap(shrunk(list.labels[i].box, kHair), shrunk(list.labels[j].box, kHair)))
          << where << ": '" << list.labels[i].text << "' covers '" << list.labels[j].text << "'";
}

void expect_labels_in_panels(const std::string& where, const DrawList& list) {
  const Box<2> page{Vec<2>(0.0), list.page};
  for (const LabelBox& label : list.labels) {
    EXPECT_TRUE(holds(shrunk(label.panel, -kHair), label.box))
        << where << ": '" << label.text << "' leaves its panel";
    EXPECT_TRUE(holds(page, label.box)) << where << ": '" << label.text << "'";
  }
}

void expect_shapes_on_page(const std::string& where, const DrawList& list) {
  const Box<2> page{Vec<2>(0.0), list.page};
  for (const DrawShape& shape : list.shapes) {
    const Box<2> r = reach_of(shape);
    EXPECT_TRUE(is_valid(r) && holds(page, r))
        << where << ": a shape of kind " << shape.index() << " reaches from (" << r.lo.x << ", "
        << r.lo.y << ") to (" << r.hi.x << ", " << r.hi.y << ")";
  }
}

void expect_large_type(const std::string& where, const Frame& frame, const DrawList& list) {
  for (const DrawShape& shape : list.shapes) {
    const auto* text = std::get_if<TextShape>(&shape);
    if (!text) continue;
    EXPECT_GE(text->size, kLeastLabel - kHair) << where << ": '" << text->text << "'";
    const bool caption =
        text->text.size() > 12 && frame.caption.find(text->text) != std::string::npos;
    if (caption) {
      EXPECT_GE(text->size, kLeastCaption - kHair) << where << ": '" << text->text << "'";
    }
  }
}

void expect_few_shapes(const std::string& where, const Frame& frame, const DrawList& list) {
  // Round bodies in space are many small pieces.
  const bool many_pieces = where.starts_with("solid_pit") || where.starts_with("solid_crowd");
  if (!many_pieces) {
    EXPECT_LT(list.shapes.size(), 5000u) << where;
  }
  if (frame.sides.empty() && frame.bodies.size() <= 4 && frame.nodes.size() < 10 &&
      frame.get<FrameTextures>().textures.empty() && frame.get<FrameChart>().series.size() < 4 &&
      frame.get<FrameTrace>().points.size() < 100 &&
      (!frame.find<FrameCollisions>() || frame.find<FrameCollisions>()->now < 100)) {
    EXPECT_LT(list.shapes.size(), 300u) << where << ": a typical frame";
  }
  for (const DrawShape& shape : list.shapes)
    if (const auto* polygon = std::get_if<PolygonShape>(&shape)) {
      EXPECT_LE(polygon->points.size(), 64u) << where << ": each pixel is tested against each edge";
    }
}

// Each page is drawn once for all of them: that is most of the time.
TEST(Layout, EveryPageKeepsTheRules) {
  for_each_page([](const std::string& where, const Frame& frame, const DrawList& list) {
    expect_labels_apart(where, list);
    expect_labels_in_panels(where, list);
    expect_shapes_on_page(where, list);
    expect_large_type(where, frame, list);
    expect_few_shapes(where, frame, list);
  });
}

TEST(Layout, CaptionHasAtMostTwoLinesAndLosesNoWordThatFits) {
  for (const std::size_t n : {2, 3, 4}) {
    const Frame frame = samples::ghosts(n);
    for (const auto& [width, height] : kSizes) {
      Work work;
      std::string told;
      int lines = 0;
      for (const LabelBox& label : draw_frame(frame, page_for(width, height), work).labels)
        if (frame.caption.find(label.text) != std::string::npos && label.text.size() > 12) {
          told += (lines++ > 0 ? " " : "") + label.text;
        }
      EXPECT_EQ(told, frame.caption) << width << "x" << height;
      EXPECT_LE(lines, 2);
    }
  }
}

TEST(Layout, TheSameFrameGivesTheSameList) {
  for (const auto& [name, frame] : samples::all()) {
    Work work;
    const Vec<2> page = page_for(1600, 900);
    EXPECT_EQ(written(draw_frame(frame, page, work)), written(draw_frame(frame, page, work)))
        << name;
  }
}

TEST(Layout, EveryBodyIsNamedWhileThereIsRoom) {
  for (const std::size_t n : {2, 3, 4}) {
    Work work;
    const Frame frame = samples::ghosts(n);
    const DrawList list = draw_frame(frame, page_for(1600, 900), work);
    for (const FrameBody& body : frame.bodies)
      EXPECT_TRUE(std::any_of(list.labels.begin(), list.labels.end(),
                              [&](const LabelBox& l) { return l.text == body.name; }))
          << body.name << " has no name, of " << n << " bodies";
  }
}

TEST(Layout, NoNameLiesOnAnotherBodyHoweverSmallThePage) {
  Frame frame = samples::ghosts(4);
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {  // close to each other, in a corner
    const Vec<3> at =
        frame.bounds.lo + frame.bounds.size() * Vec<3>(0.1 + 0.12 * double(i), 0.9, 0);
    frame.bodies[i].box = Box<3>::around(at, 0.05 * frame.bounds.size());
    frame.bodies[i].position = at;
  }
  for (const double width : {420.0, 500.0, 600.0, 800.0}) {
    Work work;
    const DrawList list = draw_frame(frame, page_across(frame, width), work);
    const WorldMap& map = list.maps.at(0);
    for (const FrameBody& body : frame.bodies) {
      const auto on_page = [&](double x, double y) {
        return map.origin + Vec<2>(x, -y) * map.scale;
      };
      const Box<2> box{on_page(body.box.lo.x, body.box.hi.y),
                       on_page(body.box.hi.x, body.box.lo.y)};
      for (const FrameBody& other : frame.bodies)
        for (const LabelBox& label : list.labels)
          EXPECT_FALSE(label.text == other.name && other.id != body.id && overlap(label.box, box))
              << other.name << " lies on " << body.name << " on a page " << width << " wide";
    }
  }
}

TEST(Layout, BodiesAtOnePlaceShareOneLabelThatNamesAll) {
  Work work;
  const DrawList list = draw_frame(samples::coincident(8), page_for(1600, 900), work);
  EXPECT_EQ(
      std::count_if(list.labels.begin(), list.labels.end(),
                    [](const LabelBox& l) { return l.text == "pink, red, player — one place"; }),
      1);
}

// How often a text stands in the world; the tree says the like of leaves.
std::ptrdiff_t times(const DrawList& list, std::string_view text) {
  return std::ranges::count_if(list.labels, [&](const LabelBox& l) {
    return l.text == text && holds(list.maps.at(0).picture, l.box);
  });
}

// As far as the outlines reach that are drawn of it in the world.
double width_of(const DrawList& list, const FrameBody& body) {
  double left = 1e9, right = -1e9;
  const auto see = [&](double x) { left = std::min(left, x), right = std::max(right, x); };
  for (std::size_t r = 0; r < list.runs.size(); ++r) {
    if (list.runs[r].key != body_key("world/body", body)) continue;
    const std::size_t end = r + 1 < list.runs.size() ? list.runs[r + 1].first : list.shapes.size();
    for (std::size_t i = list.runs[r].first; i < end; ++i) {
      if (const auto* rect = std::get_if<RectShape>(&list.shapes[i]))
        see(rect->box.lo.x), see(rect->box.hi.x);
      if (const auto* polygon = std::get_if<PolygonShape>(&list.shapes[i]))
        for (const Vec<2>& p : polygon->points) see(p.x);
    }
  }
  return right - left;
}

TEST(Layout, CoincidentBodiesLieOverEachOtherAndAreCounted) {
  Work work;
  Frame frame = samples::coincident(4);
  const DrawList list = draw_frame(frame, page_for(1600, 900), work);
  EXPECT_EQ(times(list, "×3"), 1);
  for (const FrameBody& body : frame.bodies)
    EXPECT_GT(width_of(list, body), 0.85 * body.box.size().x * list.maps.at(0).scale) << body.name;
  frame.bodies[2].box.hi.x += 0.01;
  EXPECT_EQ(times(draw_frame(frame, page_for(1600, 900), work), "×2"), 1)
      << "who is larger is seen beside the others";
  frame.bodies[1].box.hi.x += 0.02;
  for (const char* text : {"×2", "×3"})
    EXPECT_EQ(times(draw_frame(frame, page_for(1600, 900), work), text), 0);
}

TEST(Layout, NoStackIsLeftUncountedHoweverFullThePageIs) {
  Work work;
  Frame frame = samples::crowd(300, 2);
  for (std::size_t i = 0; i < 60; ++i) {
    FrameBody twin = frame.bodies[i];
    twin.id = static_cast<BodyId>(frame.bodies.size());
    frame.bodies.push_back(twin);
  }
  EXPECT_EQ(times(draw_frame(frame, page_for(1600, 900), work), "×2"), 60);
}

TEST(Layout, BodiesThatOnlyLookAsOneAreNotSaidToBe) {
  Work work;
  Frame frame = samples::coincident(8);
  for (FrameBody& body : frame.bodies) {
    const double aside = 0.02 * body.id;  // less than a pixel
    body.position.x += aside;
    body.box.lo.x += aside;
    body.box.hi.x += aside;
  }
  const DrawList list = draw_frame(frame, page_for(1600, 900), work);
  EXPECT_TRUE(std::ranges::any_of(list.labels, [](const LabelBox& l) {
    return l.text == "pink, red, player — close together";
  }));
}

TEST(Layout, CountsComeBeforeSettings) {
  Frame frame = samples::ghosts(4);
  frame.add<FrameStructure>().settings =
      "capacity 2, depth limit 8, all children made, stops without progress";
  Work work;
  double settings = 0, counts = 0;
  for (const LabelBox& label : draw_frame(frame, page_for(1600, 900), work).labels) {
    if (label.text == "stops without progress") settings = label.box.lo.y;
    if (label.text == "nodes") counts = label.box.hi.y;
  }
  EXPECT_LT(counts, settings) << "counts move when settings are told";
}

TEST(Layout, WhatIsLeftOutIsSaid) {
  const auto notes = [](const Frame& frame) {
    Work work;
    std::string all;
    for (const LabelBox& label : draw_frame(frame, page_for(1600, 900), work).labels)
      all += label.text + "\n";
    return all;
  };
  const char* cells = "the smallest cells are not drawn";
  EXPECT_EQ(notes(samples::coincident(8)).find(cells), std::string::npos);
  EXPECT_NE(notes(samples::coincident(10)).find(cells), std::string::npos);
  EXPECT_NE(notes(samples::crowd(20000, 0.2)).find("20000 bodies as"), std::string::npos);
  EXPECT_NE(notes(samples::crowd(600, 4)).find("not all pairs are drawn"), std::string::npos);
  EXPECT_NE(notes(samples::fine_atlas(4000)).find("not all textures are drawn"), std::string::npos);
}

TEST(Layout, BodiesOutsideTheBoundsAreShownAtTheRim) {
  Work work;
  const DrawList list = draw_frame(samples::outside(), page_for(1600, 900), work);
  for (const char* name : {"left", "far", "below, also below — outside"})
    EXPECT_TRUE(std::any_of(list.labels.begin(), list.labels.end(),
                            [&](const LabelBox& l) { return l.text == name; }))
        << name << " was dropped";
}

// Left ends of all texts on a page with these counts, and the lines of its caption.
struct Placed {
  std::map<std::string, double> left;
  std::vector<std::string> caption;
};

Placed placed(std::int64_t pairs, std::int64_t all, const std::string& caption) {
  Frame frame = samples::ghosts(4);
  frame.caption = caption;
  for (auto& [name, count] : frame.counts) {
    if (name == "pairs") count = pairs;
    if (name == "testable_pairs") count = all;
  }
  Work work;
  Placed found;
  for (const LabelBox& label : draw_frame(frame, page_for(1600, 900), work).labels) {
    found.left[label.text] = label.box.lo.x;
    if (label.text.starts_with("word")) found.caption.push_back(label.text);
  }
  return found;
}

TEST(Layout, NumbersInCountersKeepTheirPlace) {
  std::string caption;
  for (int words = 1; words <= 40; ++words) {
    caption += words == 1 ? "word" : " word";
    const Placed few = placed(2, 6, caption), many = placed(1111, 4950, caption);
    for (const char* text : {"candidate pairs", "by brute force"})
      EXPECT_EQ(few.left.at(text), many.left.at(text)) << text << " moved when a number grew";
    EXPECT_EQ(placed(1, 6, caption).left.at("candidate pair"), few.left.at("candidate pairs"));
    EXPECT_EQ(few.caption, many.caption) << "the caption was broken anew when a number grew";
  }
}

TEST(Layout, PanelsThatAreNotThereAreNotLaidOut) {
  Frame frame = samples::ghosts(4);
  frame.panels = {panel_named("world")};
  Work work;
  draw_frame(frame, page_for(1600, 900), work);
  EXPECT_EQ(work.world_layouts, 1u);
  EXPECT_EQ(work.tree_layouts, 0u);
  frame.panels = {panel_named("tree")};
  draw_frame(frame, page_for(1600, 900), work);
  EXPECT_EQ(work.world_layouts, 1u);
  EXPECT_EQ(work.tree_layouts, 1u);
}

TEST(Layout, PageIsNeverSmallerThanItsUnits) {
  for (const auto& [width, height] : kSizes) {
    const Vec<2> page = page_for(width, height);
    EXPECT_GE(page.x, 1600 - kHair);
    EXPECT_GE(page.y, 900 - kHair);
    EXPECT_NEAR(page.x / page.y, double(width) / height, 1e-12);
  }
  EXPECT_EQ(page_for(1920, 1080), Vec<2>(1600, 900));
}

}  // namespace
}  // namespace lantern::draw
