// A part of the world, notes, switches and the legend.
#include <map>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "draw/layout_check.hpp"
#include "draw/page.hpp"
#include "draw/panel.hpp"
#include "draw/pen.hpp"
#include "draw/projection.hpp"
#include "draw/sample_frames.hpp"
#include "draw/theme.hpp"
#include "draw/world3d_samples.hpp"

namespace lantern::draw {
namespace {

using samples::page_of;

// A part about the frame's first body, a third as wide as the world.
Frame zoomed(Frame frame) {
  const Box<2> bounds = {{frame.bounds.lo.x, frame.bounds.lo.y},
                         {frame.bounds.hi.x, frame.bounds.hi.y}};
  const Vec<2> size = bounds.size() / 3.0;
  const Vec<3> at = frame.bodies[0].position;
  const Vec<2> lo =
      glm::clamp(Vec<2>(at.x, at.y) - size / 2.0, bounds.lo, glm::max(bounds.lo, bounds.hi - size));
  frame.view = {lo, lo + size};
  return frame;
}

std::size_t runs_of(const DrawList& list, const std::string& key) {
  return static_cast<std::size_t>(std::ranges::count(list.runs, key, &KeyedRun::key));
}

TEST(View, OfAPartIsCutToItsPanelAndHasALocator) {
  const Box<2> panel{{200, 100}, {900, 500}};
  for (const auto& [name, frame] : samples::worlds()) {
    if (frame.dimension != 2 || frame.bodies.empty()) continue;
    DrawList list;
    Labels labels(list);
    const Frame part = zoomed(frame);
    draw_world(part, Staging(part), panel, list, labels);
    EXPECT_EQ(runs_of(list, "world/locator"), 1u) << name;
    for (const DrawShape& shape : list.shapes)
      EXPECT_TRUE(holds(shrunk(panel, -6), reach_of(shape))) << name << " " << shape.index();
  }
}

TEST(View, KeepsThePicturesPlaceAndEnlarges) {
  const Frame frame = samples::ghosts(4), part = zoomed(frame);
  const Box<2> panel{{200, 100}, {900, 500}},
      bounds{{frame.bounds.lo.x, frame.bounds.lo.y}, {frame.bounds.hi.x, frame.bounds.hi.y}};
  const View2D whole(bounds, panel), zoom(bounds, panel, part.view);
  EXPECT_NEAR(zoom.scale(), 3 * whole.scale(), 1e-9);
  EXPECT_NEAR(zoom.picture().lo.x, whole.picture().lo.x, 1e-9);
  EXPECT_NEAR(zoom.picture().hi.y, whole.picture().hi.y, 1e-9);
  EXPECT_TRUE(shows_a_body(part));
  Frame away = part;
  away.view = Box<2>{bounds.lo, bounds.lo + Vec<2>(1e-3)};
  EXPECT_FALSE(shows_a_body(away));
}

TEST(KeepWithin, CutsLinesAndOutlinesAndKeepsRuns) {
  DrawList list;
  list.line({0, 0}, {1, 1}, {Role::ink, 1});  // before: stays as it is
  const std::size_t first = list.shapes.size();
  {
    const DrawList::Scope scope(list, "gone");
    list.line({-50, 5}, {-20, 5}, {Role::ink, 1});
  }
  {
    const DrawList::Scope scope(list, "cut");
    list.line({-50, 5}, {50, 5}, {Role::ink, 1});
    list.rect({{5, 5}, {50, 8}}, Role::panel, {Role::ink, 1});
  }
  keep_within(list, first, {{0, 0}, {10, 10}});
  ASSERT_EQ(list.shapes.size(), 6u) << "line, line, ground, and three sides of the outline";
  const auto& line = std::get<LineShape>(list.shapes[1]);
  EXPECT_EQ(line.from, Vec<2>(0, 5));
  EXPECT_EQ(line.to, Vec<2>(10, 5));
  std::map<std::string, std::size_t> firsts;
  for (const KeyedRun& run : list.runs)
    if (!run.key.empty()) firsts[run.key] = run.first;
  EXPECT_EQ(firsts.at("gone"), 1u);
  EXPECT_EQ(firsts.at("cut"), 1u);
  EXPECT_EQ(list.runs.back().first, 6u);
}

TEST(Camera, ThatGoesRoundKeepsItsScale) {
  const Box<3> bounds{{0, 0, 0}, {8, 4, 12}};
  const Box<2> panel{{0, 0}, {800, 600}};
  std::set<long> scales;
  for (int i = 0; i < 7; ++i) {
    Camera camera{{4 + 30 * std::sin(i * 0.7), 9, 6 + 30 * std::cos(i * 0.7)}, {4, 2, 6}};
    camera.goes_round = true;
    const View3D view(bounds, camera, panel);
    scales.insert(std::lround(1e6 * view.scale_at({4, 2, 6})));
    for (const Vec<3>& corner : corners_of(bounds))
      EXPECT_TRUE(contains(panel, view.to_page(corner))) << i;
  }
  EXPECT_LE(*scales.rbegin() - *scales.begin(), *scales.begin() / 200);
}

FrameNote note_on(const std::string& text, NoteOf of, std::vector<BodyId> bodies = {}) {
  FrameNote note;
  note.text = text;
  note.of = of;
  note.bodies = std::move(bodies);
  return note;
}

Frame noted() {
  Frame frame = samples::ghosts(4);
  frame.notes = {
      note_on("the first of them", NoteOf::body, {frame.bodies[0].id}),
      note_on("these two are to be tested", NoteOf::pair, {frame.bodies[1].id, frame.bodies[2].id}),
      note_on("the whole", NoteOf::node), note_on("so many", NoteOf::count),
      note_on("here", NoteOf::point)};
  frame.notes[2].node = 0;
  frame.notes[3].count = "nodes";
  frame.notes[4].point = frame.bounds.center();
  return frame;
}

TEST(Notes, StandFreeAndLargeEnough) {
  for (const auto& [width, height] : {std::pair{1600, 900}, {1200, 900}, {900, 1600}}) {
    Work work;
    const DrawList list = draw_frame(noted(), page_for(width, height), work);
    expect_laid_out(list, {{0, 0}, list.page}, kLeastLabel, fmt::format("{}x{}", width, height));
    for (const char* text : {"the first of them", "the whole", "so many", "here"})
      EXPECT_TRUE(says(list, text)) << text << " at " << width << "x" << height;
    for (const DrawShape& shape : list.shapes)
      if (const auto* text = std::get_if<TextShape>(&shape); text && text->text == "here") {
        EXPECT_GE(text->size, 24);
      }
  }
  EXPECT_TRUE(says(page_of(noted()), "nodes")) << "a count that is noted stands in the foot";
}

TEST(Notes, CoverNoBody) {
  Frame frame = noted();
  frame.panels = {panel_named("world")};
  const DrawList list = page_of(frame);
  for (const DrawShape& shape : list.shapes) {
    const auto* rect = std::get_if<RectShape>(&shape);
    if (!rect || rect->fill != Role::paper || rect->radius != 6) continue;  // a note's plate
    for (const DrawShape& other : list.shapes)
      if (const auto* eye = std::get_if<RectShape>(&other); eye && eye->fill == Role::eye) {
        EXPECT_FALSE(overlap(rect->box, eye->box));
      }
  }
}

TEST(Switches, LeaveOutWhatTheySay) {
  Frame frame = samples::ghosts(4);
  frame.add<FrameStructure>().settings = "capacity 2";
  const auto list_with = [&](auto change) {
    Frame changed = frame;
    change(changed.display);
    return page_of(changed);
  };
  const DrawList all = page_of(frame);
  ASSERT_TRUE(says(all, frame.title) && says(all, "candidate pairs") && says(all, "capacity 2"));
  ASSERT_TRUE(says(all, frame.bodies[0].name));
  EXPECT_FALSE(says(list_with([](Display& d) { d.title = false; }), frame.title));
  EXPECT_FALSE(says(list_with([](Display& d) { d.counters = false; }), "candidate pairs"));
  EXPECT_FALSE(says(list_with([](Display& d) { d.settings = false; }), "capacity 2"));
  EXPECT_FALSE(
      says(list_with([](Display& d) { d.names = ShownNames::none; }), frame.bodies[0].name));
  const DrawList silent = list_with([](Display& d) { d.caption = d.counters = false; });
  EXPECT_FALSE(says_part(silent, frame.caption.substr(0, 12)));
  EXPECT_FALSE(list_with([](Display& d) { d.pairs = false; }).marks.has(MarkKind::candidate));
  EXPECT_FALSE(list_with([](Display& d) { d.not_made = false; }).marks.has(MarkKind::not_made));
  EXPECT_FALSE(list_with([](Display& d) { d.cells = false; }).marks.has(MarkKind::lit));
}

// The shapes of a list, with the colours of a theme instead of roles.
std::string in_colors(const DrawList& list, const Theme& theme) {
  std::string text;
  const auto color = [&](Role role) {
    const Color& c = theme.colors[static_cast<std::size_t>(role)];
    return role == Role::none ? std::string("-") : fmt::format("{},{},{}", c.r, c.g, c.b);
  };
  for (const DrawShape& shape : list.shapes) {
    const Box<2> r = reach_of(shape);
    text += fmt::format("{} {:.2f} {:.2f} {:.2f} {:.2f} ", shape.index(), r.lo.x, r.lo.y, r.hi.x,
                        r.hi.y);
    std::visit(
        [&](const auto& s) {
          if constexpr (requires { s.fill; }) text += color(s.fill) + " ";
          if constexpr (requires { s.stroke; })
            text += fmt::format("{} {}\n", color(s.stroke.role), s.stroke.dash);
        },
        shape);
  }
  return text;
}

TEST(Legend, EveryMarkHasAPictureAndWordsOfItsOwnAlsoInGrey) {
  std::set<std::string> pictures, words;
  for (unsigned i = 0; i < kMarkKinds; ++i) {
    const auto kind = static_cast<MarkKind>(i);
    DrawList list;
    draw_sample(kind, {{0, 0}, {58, 38}}, list);
    EXPECT_TRUE(pictures.insert(in_colors(list, *theme_named("print"))).second)
        << words_of(kind) << " looks like another mark";
    EXPECT_TRUE(words.insert(std::string(words_of(kind))).second) << words_of(kind);
  }
  DrawList blank;
  Labels labels(blank);
  Frame nothing;
  nothing.bounds = {{0, 0, 0}, {64, 44, 0}};
  draw_world(nothing, Staging(nothing), {{-6, -6}, {64, 44}}, blank, labels);
  keep_within(blank, 0, {{0, 0}, {58, 38}});
  EXPECT_FALSE(pictures.contains(in_colors(blank, *theme_named("print"))))
      << "a sample shows nothing";
}

TEST(Legend, SamplesAreMadeByWhatDrawsTheMark) {
  for (unsigned i = 0; i < kMarkKinds; ++i) {
    const auto kind = static_cast<MarkKind>(i);
    DrawList list;
    EXPECT_TRUE(draw_sample(kind, {{0, 0}, {58, 38}}, list).has(kind)) << words_of(kind);
  }
}

TEST(Legend, ListsExactlyWhatIsDrawn) {
  for (const auto& [name, sample] : samples::worlds()) {
    Frame frame = sample;
    frame.display.legend = true;
    frame.panels = {panel_named("world")};
    const DrawList list = page_of(frame);
    for (unsigned i = 0; i < kMarkKinds; ++i) {
      const auto kind = static_cast<MarkKind>(i);
      EXPECT_EQ(runs_of(list, "legend/" + std::string(words_of(kind))) > 0, list.marks.has(kind))
          << name << ": " << words_of(kind);
    }
    // What a role is for alone tells the same, without the marks' own word for it.
    frame.display.legend = false;
    const DrawList plain = page_of(frame);
    const auto has = [&](Role role) {
      return std::ranges::any_of(plain.shapes, [&](const DrawShape& shape) {
        return std::visit(
            [&](const auto& s) {
              if constexpr (requires { s.fill; })
                if (s.fill == role) return true;
              if constexpr (requires { s.stroke; }) return s.stroke.role == role;
              return false;
            },
            shape);
      });
    };
    EXPECT_EQ(has(Role::pair),
              plain.marks.has(MarkKind::candidate) || plain.marks.has(MarkKind::box_overlap))
        << name;
    EXPECT_EQ(has(Role::contact), plain.marks.has(MarkKind::contact)) << name;
    EXPECT_EQ(plain.marks, list.marks) << name;
    expect_laid_out(list, {{0, 0}, list.page}, kLeastLabel, name);
  }
}

}  // namespace
}  // namespace lantern::draw
