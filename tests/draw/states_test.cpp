// States survive a projector: what may stand side by side differs by 1.5 : 1 in luminance, which is
// what grey leaves of it, or by a mark that shows on its ground, in every theme.
#include <algorithm>
#include <functional>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "draw/body_shapes.hpp"
#include "draw/colour_vision.hpp"
#include "draw/keys.hpp"
#include "draw/layout_check.hpp"
#include "draw/marks.hpp"
#include "draw/page.hpp"
#include "draw/panel.hpp"
#include "draw/sample_frames.hpp"
#include "frame/parts/level.hpp"
#include "geometry/flat.hpp"
#include "scenario/directing.hpp"

namespace lantern::draw {
namespace {

constexpr double kLeast = 1.5;
const Box<2> kPlace{{100, 100}, {160, 160}};

// What is painted of one thing: its ground, and all that lies on it.
struct Seen {
  Role ground = Role::paper;
  std::vector<DrawShape> marks;
};

Role fill_in(const DrawShape& shape) {
  if (const auto* rect = std::get_if<RectShape>(&shape)) return rect->fill;
  if (const auto* polygon = std::get_if<PolygonShape>(&shape)) return polygon->fill;
  return Role::none;
}

Stroke stroke_in(const DrawShape& shape) {
  return std::visit(
      [](const auto& s) {
        if constexpr (requires { s.stroke; })
          return s.stroke;
        else
          return Stroke{};
      },
      shape);
}

// The last that fills a third of the box or more is its ground.
Seen look_at(const DrawList& list, const Box<2>& box) {
  Seen look;
  std::optional<std::size_t> ground;
  const auto area = [](const Box<2>& b) { return b.size().x * b.size().y; };
  for (std::size_t i = 0; i < list.shapes.size(); ++i) {
    const Box<2> reach = shrunk(reach_of(list.shapes[i]), stroke_in(list.shapes[i]).width / 2);
    const Box<2> common{glm::max(reach.lo, box.lo), glm::min(reach.hi, box.hi)};
    if (fill_in(list.shapes[i]) == Role::none || !is_valid(common)) continue;
    if (area(common) < 0.33 * area(box)) continue;
    look.ground = fill_in(list.shapes[i]);
    ground = i;
  }
  for (std::size_t i = 0; i < list.shapes.size(); ++i)
    if (!std::holds_alternative<TextShape>(list.shapes[i]) &&
        holds(shrunk(box, -6), reach_of(list.shapes[i])) && (!ground || i >= *ground))
      look.marks.push_back(list.shapes[i]);
  return look;
}

Seen drawn(const std::function<void(DrawList&)>& draw, const Box<2>& box = kPlace) {
  DrawList list;
  list.rect(shrunk(box, -20), Role::panel);
  draw(list);
  return look_at(list, box);
}

// Kinds, dashes and weights of the marks that can be seen.
std::multiset<std::string> marks_of(const Seen& look, const Theme& theme) {
  std::multiset<std::string> marks;
  const auto shows = [&](Role role) {
    return role != Role::none && vision::contrast(theme[role], theme[look.ground]) >= kLeast;
  };
  for (const DrawShape& shape : look.marks) {
    const Stroke stroke = stroke_in(shape);
    const std::string kind = std::to_string(shape.index());
    if (shows(stroke.role))
      marks.insert(kind + (stroke.dash > 0 ? " dashed" : "") +
                   (stroke.width > 2.5   ? " heavy"
                    : stroke.width > 1.7 ? ""
                                         : " thin"));
    if (fill_in(shape) != look.ground && shows(fill_in(shape))) marks.insert(kind + " filled");
  }
  return marks;
}

using States = std::vector<std::pair<std::string, Seen>>;

void expect_distinct(const States& states) {
  for (const Theme& theme : themes())
    for (std::size_t a = 0; a < states.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const auto& [one, x] = states[a];
        const auto& [other, y] = states[b];
        const double contrast = vision::contrast(theme[x.ground], theme[y.ground]);
        EXPECT_TRUE(contrast >= kLeast || marks_of(x, theme) != marks_of(y, theme))
            << theme.name << ": " << one << " looks like " << other << ", " << contrast << " : 1, "
            << testing::PrintToString(marks_of(x, theme));
      }
}

// The second quarter of a world in a quadtree.
TEST(States, OfCells) {
  States states;
  const auto add = [&](const char* name, const std::function<void(Frame&)>& change) {
    Frame frame = samples::ghosts(3);
    frame.bodies.clear();
    for (FrameNode& node : frame.nodes) node.mark = Mark::quiet, node.bodies = {0};
    const Box<2> quarter = flat(frame.nodes[2].box);
    change(frame);
    const DrawList list = samples::page_of(frame);
    const WorldMap& map = list.maps.at(0);
    const auto on_page = [&](double x, double y) { return map.origin + Vec<2>(x, -y) * map.scale; };
    states.emplace_back(name, look_at(list, {on_page(quarter.lo.x, quarter.hi.y),
                                             on_page(quarter.hi.x, quarter.lo.y)}));
  };
  add("quiet", [](Frame&) {});
  add("lit", [](Frame& f) { f.nodes[2].mark = Mark::lit; });
  add("passed", [](Frame& f) { f.nodes[2].mark = Mark::passed; });
  add("asleep", [](Frame& f) { f.nodes[2].awake = false; });
  add("not made", [](Frame& f) { f.nodes.erase(f.nodes.begin() + 2); });
  expect_distinct(states);
}

TEST(States, OfPairs) {
  States states{{"none", drawn([](DrawList&) {})}};
  const char* const names[] = {"never tested",   "ruled out by the broad phase",
                               "candidate",      "apart by box",
                               "apart by shape", "contact"};
  for (std::size_t s = 0; s < frame::kPairStates; ++s)
    for (const bool is_new : {false, true}) {
      const auto state = static_cast<frame::PairState>(s);
      if (is_new && state < frame::PairState::candidate) continue;
      states.emplace_back(
          names[s] + std::string(is_new ? ", new" : ""),
          drawn([&](DrawList& list) { draw_pair_mark(state, is_new, shrunk(kPlace, 18), list); },
                shrunk(kPlace, 18)));
    }
  expect_distinct(states);
}

TEST(States, OfBodies) {
  for (const auto& [kind, color] : {std::pair{Look::ghost, 6}, {Look::disc, 3}}) {
    FrameBody body = samples::body(0, "b", kind, color, {1, 1});
    States states;
    const auto add = [&](const char* name) {
      states.emplace_back(
          name, drawn([&](DrawList& list) { draw_character(body, kPlace, false, list); }));
    };
    add("awake");
    body.dimmed = true;
    add("ruled out");
    body.refused = true;
    add("tested in vain");
    body.dimmed = false;
    add("tested in vain by a ray");
    body.refused = false;
    body.asleep = true;
    add("asleep");
    expect_distinct(states);
  }
}

// The places of what has this key.
Box<2> place_of(const DrawList& list, const std::string& key) {
  for (std::size_t i = 0; i + 1 < list.runs.size(); ++i)
    if (list.runs[i].key == key && list.runs[i].first < list.runs[i + 1].first)
      return shrunk(reach_of(list.shapes[list.runs[i].first]),
                    stroke_in(list.shapes[list.runs[i].first]).width / 2);
  ADD_FAILURE() << "nothing is " << key;
  return kPlace;
}

// Things of one page, by their keys.
States of_page(const DrawList& list,
               const std::vector<std::pair<std::string, std::string>>& names_and_keys) {
  States states;
  for (const auto& [name, key] : names_and_keys)
    states.emplace_back(name, look_at(list, place_of(list, key)));
  return states;
}

TEST(States, OfTreeNodes) {
  States states;
  const auto add = [&](const char* name, const std::function<void(FrameNode&)>& change) {
    Frame frame = samples::ghosts(3);
    for (FrameNode& node : frame.nodes) node.mark = Mark::quiet, node.bodies = {0};
    change(frame.nodes[2]);
    const DrawList list = samples::page_of(frame);
    const std::string key = node_key("tree/node", frame.nodes, frame.nodes[2]);
    states.emplace_back(name, look_at(list, place_of(list, key)));
  };
  add("awake", [](FrameNode&) {});
  add("lit", [](FrameNode& node) { node.mark = Mark::lit; });
  add("passed", [](FrameNode& node) { node.mark = Mark::passed; });
  add("asleep", [](FrameNode& node) { node.awake = false; });
  add("skipped", [](FrameNode& node) { node.skipped = true; });
  add("empty", [](FrameNode& node) { node.bodies.clear(); });
  expect_distinct(states);
}

TEST(States, OfAPool) {
  Frame frame = samples::ghosts(3);
  frame.panels = {panel_named("pool")};
  frame.add<FrameStructure>().pool_size = 8;
  for (FrameNode& node : frame.nodes) {
    node.pool_slot = node.id;
    node.mark = Mark::quiet;
    node.reused = node.id == 1;
  }
  frame.nodes[2].mark = Mark::lit;
  frame.nodes[3].mark = Mark::passed;
  expect_distinct(of_page(samples::page_of(frame), {{"new", "pool/0"},
                                                    {"reused", "pool/1"},
                                                    {"lit", "pool/2"},
                                                    {"passed", "pool/3"},
                                                    {"free", "pool/7"}}));
}

TEST(States, OfAMatrix) {
  Frame frame = samples::base("", {{0, 0}, {1, 1}}, {panel_named("matrix")});
  frame.add<FrameMatrix>().rows = {"1110", "1...", "1...", "0..."};
  frame.add<FrameMatrix>().lit = 1;
  const DrawList list = samples::page_of(frame);
  expect_distinct(of_page(
      list, {{"sees", "matrix/0-1"}, {"cannot see", "matrix/0-3"}, {"not known", "matrix/3-3"}}));
  expect_distinct(of_page(list, {{"asked", "matrix/1-0"}, {"cannot see", "matrix/0-3"}}));
  EXPECT_TRUE(holds(place_of(list, "matrix/lit"), place_of(list, "matrix/1-0"))) << "its outline";
}

TEST(States, OfAnAtlas) {
  States states;
  for (const Mark mark : {Mark::quiet, Mark::passed, Mark::lit}) {
    Frame frame = samples::atlas(12, 5);
    const auto free = std::ranges::find_if(frame.nodes, [](const FrameNode& node) {
      return node.leaf && node.bodies.empty() && node.box.size().x > 60 && node.box.size().y > 60;
    });
    ASSERT_NE(free, frame.nodes.end());
    for (FrameNode& node : frame.nodes) node.mark = Mark::quiet;
    free->mark = mark;
    const DrawList list = samples::page_of(frame);
    const std::string key = node_key("atlas/cell", frame.nodes, *free);
    states.emplace_back(mark == Mark::quiet ? "free"
                        : mark == Mark::lit ? "tried"
                                            : "too small",
                        look_at(list, place_of(list, key)));
    if (mark == Mark::lit)
      states.push_back({"used", of_page(list, {{"", "atlas/texture/A"}})[0].second});
  }
  expect_distinct(states);
}

// Islands asleep and awake, and what is seen and not seen of a level, are grounds alone.
TEST(States, OfGroundsWithoutMarks) {
  for (const Theme& theme : themes())
    for (unsigned tone = 0; tone < kSectorTones; ++tone)
      EXPECT_GE(vision::contrast(theme[sector_role(tone)], theme[Role::free_space]), kLeast)
          << theme.name << ": sector tone " << tone;
}

TEST(States, OfSectorsThatAreSeen) {
  std::size_t seen = 0, unseen = 0;
  for (const Frame& frame : run::frames_of("quake_visibility")) {
    const DrawList list = samples::page_of(frame);
    for (const FrameNode& node : frame.nodes) {
      if (!node.leaf || node.region.size() < 3 || list.maps.empty()) continue;
      if (!node.bodies.empty()) continue;  // who may stand in its middle
      const WorldMap& map = list.maps[0];
      Vec<2> lo(1e9), hi(-1e9);
      for (const Vec<2>& p : node.region) {
        const Vec<2> on_page = map.origin + Vec<2>(p.x, -p.y) * map.scale;
        lo = glm::min(lo, on_page), hi = glm::max(hi, on_page);
      }
      const Seen look = look_at(list, {lo, hi});
      if (node.unseen && node.mark == Mark::quiet) {
        ++unseen;
        EXPECT_EQ(look.ground, Role::free_space) << node.label;
      }
      if (node.mark != Mark::passed) continue;
      ++seen;
      EXPECT_TRUE(std::ranges::any_of(look.marks, [](const DrawShape& shape) {
        return shape.index() == 2 && stroke_in(shape) == kPassedStroke;
      })) << node.label;
    }
  }
  EXPECT_GE(seen, 6u);
  EXPECT_GE(unseen, 6u);
}

TEST(States, ACharacterStandsOutOnALitGround) {
  for (const Look kind : {Look::ghost, Look::player, Look::person, Look::demon}) {
    DrawList list;
    draw_character(samples::body(0, "b", kind, 3, {1, 1}), kPlace, false, list);
    const Stroke halo = stroke_in(list.shapes[0]), outline = stroke_in(list.shapes[1]);
    EXPECT_EQ(halo.role, Role::panel);
    EXPECT_EQ(outline.role, Role::body_line);
    EXPECT_GE(halo.width, outline.width + 2);
  }
  for (const Theme& theme : themes()) {
    EXPECT_GE(vision::contrast(theme[Role::panel], theme[Role::lit_fill]), kLeast) << theme.name;
    EXPECT_GE(vision::contrast(theme[Role::body_line], theme[Role::panel]), 3) << theme.name;
  }
}

}  // namespace
}  // namespace lantern::draw
