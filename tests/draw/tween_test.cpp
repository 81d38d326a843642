// In-betweens: who is who, where it is on its way, and what is never shown.
#include "draw/tween.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <utility>

#include <gtest/gtest.h>

#include "base/work.hpp"
#include "draw/page.hpp"
#include "draw/sample_frames.hpp"
#include "frame/parts/asked.hpp"
#include "scenario/directing.hpp"

namespace lantern::draw {
namespace {

DrawList between(const DrawList& a, const DrawList& b, double t, Motion motion = Motion::eased) {
  return between(a, b, passages(a, b), t, motion);
}

constexpr double kTimes[] = {0.02, 0.2, 0.35, 0.5, 0.65, 0.8, 0.98};

// A thing of one rectangle.
struct Thing {
  std::string key, from;
  Box<2> box;
  Role role = Role::ink;
};

DrawList things(const std::vector<Thing>& things) {
  DrawList list;
  for (const Thing& thing : things) {
    const DrawList::Scope scope(list, thing.key, thing.from);
    list.rect(thing.box, thing.role);
  }
  return list;
}

// The rectangles of this role, each with its opacity.
std::vector<std::pair<Box<2>, double>> tinted_rects(const DrawList& list, Role role) {
  std::vector<std::pair<Box<2>, double>> found;
  for (std::size_t i = 0; i < list.shapes.size(); ++i)
    if (const auto* rect = std::get_if<RectShape>(&list.shapes[i]); rect && rect->fill == role)
      found.emplace_back(rect->box, list.tints.empty() ? 1 : list.tints[i].opacity);
  return found;
}

std::pair<Box<2>, double> only(const DrawList& list, Role role) {
  const auto found = tinted_rects(list, role);
  EXPECT_EQ(found.size(), 1u);
  return found.empty() ? std::pair{Box<2>{}, -1.0} : found[0];
}

const Box<2> kUpper{{100, 100}, {200, 140}}, kLower{{300, 400}, {360, 440}};

TEST(Tween, GoesFromRestToRest) {
  EXPECT_EQ(eased(-1), 0);
  EXPECT_EQ(eased(0), 0);
  EXPECT_EQ(eased(1), 1);
  EXPECT_EQ(eased(2), 1);
  EXPECT_DOUBLE_EQ(eased(0.5), 0.5);
  for (int i = 0; i < 100; ++i) EXPECT_LT(eased(i / 100.0), eased((i + 1) / 100.0)) << i;
  EXPECT_LT(eased(0.01), 0.001);
  EXPECT_GT(eased(0.99), 0.999);
}

TEST(Tween, ManyTexturesSetOutInWaves) {
  const auto moved = [](int many, int i) {  // how far on its way the i-th is, a third through
    std::vector<Thing> from, to;
    for (int k = 0; k < many; ++k) {
      const std::string key = "atlas/texture/" + std::to_string(k);
      from.push_back({key, "", kUpper, body_role(k + 1)});
      to.push_back({key, "", kLower, body_role(k + 1)});
    }
    const auto [box, opacity] = only(between(things(from), things(to), 1.0 / 3), body_role(i + 1));
    return box.center().y - kUpper.center().y;
  };
  EXPECT_EQ(moved(3, 0), moved(3, 2)) << "few go together";
  EXPECT_GT(moved(6, 0), moved(6, 2));
  EXPECT_EQ(moved(6, 0), moved(6, 1));
  EXPECT_EQ(moved(6, 5), 0) << "the last wave waits";
}

TEST(Tween, WhatHasTheSameKeyGoesToItsNewPlaceWhereverItStandsInTheList) {
  const DrawList a =
      things({{"x", "", kUpper, Role::body_1}, {"y", "", {{5, 5}, {6, 6}}, Role::body_2}});
  const DrawList b =
      things({{"y", "", {{5, 5}, {6, 6}}, Role::body_2}, {"x", "", kLower, Role::body_1}});
  for (const Motion motion : {Motion::eased, Motion::steady}) {
    double x = kUpper.lo.x;
    for (const double t : kTimes) {
      const auto [box, opacity] = only(between(a, b, t, motion), Role::body_1);
      EXPECT_EQ(opacity, 1);
      EXPECT_GE(box.lo.x, x);
      EXPECT_LE(box.lo.x, kLower.lo.x);
      x = box.lo.x;
      EXPECT_EQ(only(between(a, b, t, motion), Role::body_2).first, (Box<2>{{5, 5}, {6, 6}}));
    }
  }
  EXPECT_DOUBLE_EQ(only(between(a, b, 0.25, Motion::steady), Role::body_1).first.lo.x, 150);
}

TEST(Tween, ColoursAreMixedOnTheWay) {
  const DrawList a = things({{"x", "", kUpper, Role::panel}});
  const DrawList b = things({{"x", "", kUpper, Role::lit_fill}});
  double before = 1;
  for (const double t : kTimes) {
    const DrawList list = between(a, b, t);
    ASSERT_EQ(list.shapes.size(), 1u);
    EXPECT_EQ(std::get<RectShape>(list.shapes[0]).fill, Role::lit_fill);
    EXPECT_EQ(list.tints[0].fill, Role::panel);
    EXPECT_LE(list.tints[0].share, before);
    before = list.tints[0].share;
  }
  EXPECT_LT(before, 0.01);
}

TEST(Tween, ChildrenComeOutOfTheirParentAndGoBackIntoIt) {
  const Thing root{"tree/node/root", "", kUpper, Role::body_1};
  const Thing child{"tree/node/root.2", "tree/node/root", kLower, Role::body_2};
  const Thing grandchild{
      "tree/node/root.2.1", "tree/node/root.2", {{400, 600}, {430, 640}}, Role::body_3};
  const DrawList one = things({root}), all = things({root, child, grandchild});
  for (const bool out : {true, false}) {
    double y = out ? kUpper.lo.y : kLower.lo.y;
    bool seen = false;
    for (const double t : kTimes) {
      const DrawList list = out ? between(one, all, t) : between(all, one, t);
      EXPECT_EQ(only(list, Role::body_1).first, kUpper);
      for (const Role role : {Role::body_2, Role::body_3})
        for (const auto& [box, opacity] : tinted_rects(list, role)) {
          seen = true;
          EXPECT_GE(box.lo.x, kUpper.lo.x - 1e-9);
          EXPECT_LE(box.lo.y, 600);
          if (role != Role::body_2) continue;
          EXPECT_TRUE(out ? box.lo.y >= y : box.lo.y <= y) << t;
          y = box.lo.y;
        }
    }
    EXPECT_TRUE(seen);
  }
  // As soon as it is to be seen it is as good as in its parent's box.
  const auto [box, opacity] = only(between(one, all, 0.25), Role::body_2);
  EXPECT_LT(opacity, 0.1);
  EXPECT_LT(box.lo.y, kUpper.lo.y + 0.02 * (kLower.lo.y - kUpper.lo.y));
}

TEST(Tween, WhatIsHandedDownIsNeverGoneNorThereTwice) {
  const DrawList a = things({{"tree/body/blue/root", "", kUpper, Role::body_1}});
  const DrawList b =
      things({{"tree/body/blue/root.0.3", "tree/body/blue/root.0", kLower, Role::body_1}});
  for (const bool down : {true, false}) {
    double y = down ? kUpper.lo.y : kLower.lo.y;
    for (const double t : kTimes) {
      const auto [box, opacity] = only(down ? between(a, b, t) : between(b, a, t), Role::body_1);
      EXPECT_EQ(opacity, 1);
      EXPECT_TRUE(down ? box.lo.y >= y : box.lo.y <= y) << t;
      y = box.lo.y;
    }
    EXPECT_NEAR(y, down ? kLower.lo.y : kUpper.lo.y, 1);
  }
  // In two leaves at once: both come from the one place.
  const DrawList two = things(
      {{"tree/body/blue/root.0", "tree/body/blue/root", kLower, Role::body_1},
       {"tree/body/blue/root.1", "tree/body/blue/root", {{500, 400}, {560, 440}}, Role::body_1}});
  const auto found = tinted_rects(between(a, two, 0.05), Role::body_1);
  ASSERT_EQ(found.size(), 2u);
  for (const auto& [box, opacity] : found) {
    EXPECT_EQ(opacity, 1);
    EXPECT_NEAR(box.lo.x, kUpper.lo.x, 1);
  }
}

TEST(Tween, WhatNamesItselfUnfoldsFromItsMiddle) {
  DrawList b;
  {
    const DrawList::Scope scope(b, "cut", "cut");
    b.crisp_line({100, 50}, {300, 50}, {Role::ink, 2});
  }
  double length = 0;
  for (const double t : kTimes)
    for (const DrawShape& shape : between({}, b, t).shapes) {
      const auto& line = std::get<LineShape>(shape);
      EXPECT_TRUE(line.snapped) << "or it would be seen to jump when it is done";
      EXPECT_DOUBLE_EQ(line.from.x + line.to.x, 400);
      EXPECT_GE(line.to.x - line.from.x, length);
      length = line.to.x - line.from.x;
    }
  EXPECT_GT(length, 199);
}

TEST(Tween, WordsComeLast) {
  DrawList a, b;
  const auto say = [](DrawList& list, const char* key, const char* text) {
    const DrawList::Scope scope(list, key);
    list.shapes.emplace_back(TextShape{text, {100, 800}, 30, Weight::regular, 0, Role::ink});
  };
  say(a, "page/words", "3 pairs"), say(a, "world/name/x", "17");
  say(b, "page/words", "4 pairs"), say(b, "page/more", "5 bodies"), say(b, "world/name/x", "23");
  for (const double t : kTimes)
    for (const Motion motion : {Motion::eased, Motion::steady}) {
      const DrawList list = between(a, b, t, motion);
      std::set<std::string> texts;
      for (std::size_t i = 0; i < list.shapes.size(); ++i) {
        texts.insert(std::get<TextShape>(list.shapes[i]).text);
        EXPECT_EQ(list.tints[i].opacity, 1);
      }
      EXPECT_EQ(texts, (std::set<std::string>{"3 pairs", "17"})) << t;
    }
}

// All texts that can be seen, those of one line joined from left to right.
std::set<std::string> lines_of(const DrawList& list) {
  std::map<std::pair<double, double>, const TextShape*> digits;
  std::set<std::string> lines;
  for (std::size_t i = 0; i < list.shapes.size(); ++i)
    if (const auto* text = std::get_if<TextShape>(&list.shapes[i])) {
      if (text->text.size() == 1 && std::isdigit(text->text[0]))
        digits[{text->at.y, text->at.x}] = text;
      else
        lines.insert(text->text);
    }
  double y = -1, x = 0;
  std::string number;
  for (const auto& [at, digit] : digits) {
    if (at.first != y || at.second - x > 0.7 * digit->size) lines.insert(std::exchange(number, ""));
    number += digit->text;
    std::tie(y, x) = at;
  }
  lines.insert(number);
  return lines;
}

TEST(Tween, ANumberGivesWayAtOnce) {
  const auto numbered = [](std::int64_t n) {
    DrawList list;
    Labels(list).add_number(n, {300, 100}, {}, {{0, 0}, {1600, 900}});
    return list;
  };
  for (const auto& [from, to] : {std::pair{13, 9}, {9, 13}, {103, 107}, {7, 1234}})
    for (const double t : kTimes)
      EXPECT_EQ(lines_of(between(numbered(from), numbered(to), t)),
                (std::set<std::string>{"", std::to_string(from)}))
          << from << " to " << to << " at " << t;
}

// How strongly a point is painted by lines of this role.
double painted(const DrawList& list, Role role, const Vec<2>& point) {
  double most = 0;
  for (std::size_t i = 0; i < list.shapes.size(); ++i) {
    const auto* line = std::get_if<LineShape>(&list.shapes[i]);
    if (!line || line->stroke.role != role) continue;
    const Vec<2> way = line->to - line->from;
    const double length = glm::dot(way, way);
    const double at =
        length > 0 ? std::clamp(glm::dot(point - line->from, way) / length, 0.0, 1.0) : 0;
    if (glm::distance(line->from + way * at, point) < 1)
      most = std::max(most, list.tints.empty() ? 1 : list.tints[i].opacity);
  }
  return most;
}

TEST(Tween, AWallThatIsCutIsNeverGone) {
  DrawList a, b;
  a.line({100, 100}, {500, 400}, {Role::ink, 10});
  a.line({100, 100}, {500, 400}, {Role::lit, 6});
  b.line({100, 100}, {300, 250}, {Role::ink, 5});
  b.line({300, 250}, {500, 400}, {Role::ink, 5});
  for (const Motion motion : {Motion::eased, Motion::steady})
    for (int i = 1; i < 50; ++i)
      for (const double at : {0.1, 0.45, 0.8})
        EXPECT_GE(painted(between(a, b, i / 50.0, motion), Role::ink,
                          Vec<2>(100, 100) + at * Vec<2>(400, 300)),
                  0.999)
            << i << ", " << at;
}

DrawList page_drawn(const Frame& frame) {
  Work work;
  return draw_frame(frame, page_for(1600, 900), work);
}

std::string looks(const DrawList& list) {
  std::string text;
  for (const DrawShape& shape : list.shapes) {
    text += style_of(shape);
    const Box<2> box = extent_of(shape);
    for (const double x : {box.lo.x, box.lo.y, box.hi.x, box.hi.y}) text += std::to_string(x) + " ";
  }
  for (const Tint& tint : list.tints)
    text += std::to_string(tint.opacity) + " " + std::to_string(tint.share) + " ";
  return text;
}

struct Change {
  std::string name;
  DrawList a, b;
};

// Frames that follow each other, and some that have nothing in common.
const std::vector<Change>& changes() {
  static const std::vector<Change> all = [] {
    std::vector<Change> found;
    const auto add = [&](const char* name, const Frame& a, const Frame& b) {
      found.push_back({name, page_drawn(a), page_drawn(b)});
    };
    add("split", samples::ghosts(2), samples::ghosts(3));
    add("another body", samples::ghosts(3), samples::ghosts(4));
    add("merge", samples::ghosts(4), samples::ghosts(2));
    add("ball", samples::pong(9), samples::pong(12));
    add("packed", samples::atlas(12, 4), samples::atlas(12, 5));
    add("all else", samples::coincident(4), samples::doom());
    add("from nothing", samples::empty(), samples::ghosts(3));
    return found;
  }();
  return all;
}

TEST(Tween, BeginsAndEndsWithTheFramesThemselves) {
  for (const auto& [name, a, b] : changes())
    for (const Motion motion : {Motion::eased, Motion::steady}) {
      EXPECT_TRUE(between(a, b, 0, motion).shapes == a.shapes) << name;
      EXPECT_TRUE(between(a, b, 1, motion).shapes == b.shapes) << name;
      EXPECT_TRUE(between(a, b, 0, motion).tints.empty());
      EXPECT_TRUE(between(a, b, 1, motion).tints.empty());
    }
}

TEST(Tween, NothingLeavesThePageAndEachShapeHasItsTint) {
  for (const auto& [name, a, b] : changes())
    for (const Motion motion : {Motion::eased, Motion::steady})
      for (const double t : kTimes) {
        const DrawList list = between(a, b, t, motion);
        ASSERT_EQ(list.tints.size(), list.shapes.size());
        for (std::size_t i = 0; i < list.shapes.size(); ++i) {
          const Box<2> box = extent_of(list.shapes[i]);
          EXPECT_TRUE(holds({{-0.01, -0.01}, list.page + Vec<2>(0.01)}, box))
              << name << " at " << t << ": " << style_of(list.shapes[i]) << " to " << box.lo.x
              << " " << box.lo.y << " " << box.hi.x << " " << box.hi.y;
          EXPECT_GT(list.tints[i].opacity, 0);
          EXPECT_LE(list.tints[i].opacity, 1);
          EXPECT_GE(list.tints[i].share, 0);
          EXPECT_LE(list.tints[i].share, 1);
        }
      }
}

TEST(Tween, IsTheSameEachTime) {
  for (const auto& [name, a, b] : changes())
    EXPECT_EQ(looks(between(a, b, 0.4)), looks(between(a, b, 0.4))) << name;
}

TEST(Tween, OfAFrameAndItselfIsTheFrame) {
  for (const auto& [name, a, b] : changes())
    EXPECT_TRUE(between(b, b, 0.5).shapes == b.shapes) << name;
}

// Keys and boxes of what they stand for.
std::map<std::string, Box<2>> things_of(const DrawList& list) {
  std::map<std::string, Box<2>> things;
  for (std::size_t r = 0; r < list.runs.size(); ++r) {
    const std::size_t end = r + 1 < list.runs.size() ? list.runs[r + 1].first : list.shapes.size();
    for (std::size_t i = list.runs[r].first; i < end; ++i) {
      const Box<2> box = extent_of(list.shapes[i]);
      const auto [at, fresh] = things.emplace(list.runs[r].key, box);
      if (!fresh) at->second = united(at->second, box);
    }
  }
  return things;
}

// The texts of the page's own words.
std::set<std::string> words_of_page(const DrawList& list) {
  DrawList words;
  for (std::size_t r = 0; r + 1 < list.runs.size(); ++r)
    if (list.runs[r].key.starts_with("page/"))
      for (std::size_t i = list.runs[r].first; i < list.runs[r + 1].first; ++i)
        words.shapes.push_back(list.shapes[i]);
  return lines_of(words);
}

TEST(Keys, AreOfTheThingNotOfItsPlaceInAList) {
  Frame frame = samples::ghosts(4);
  const auto things = things_of(page_drawn(frame));
  EXPECT_TRUE(things.contains("tree/node/root"));
  EXPECT_TRUE(things.contains("tree/node/root.0"));
  EXPECT_TRUE(things.contains("world/body/" + frame.bodies[0].name));
  std::ranges::reverse(frame.bodies);
  for (const auto& [key, box] : things_of(page_drawn(frame)))
    if (key.starts_with("tree/node/") || key.starts_with("world/body/")) {
      ASSERT_TRUE(things.contains(key)) << key;
      EXPECT_EQ(things.at(key), box) << key;
    }
}

TEST(Keys, EveryRunsOriginStandsAboveIt) {
  for (const auto& [name, a, b] : changes())
    for (const KeyedRun& run : b.runs) {
      if (run.from.empty() || run.from == run.key) continue;
      EXPECT_NE(run.key.find(run.from.substr(run.from.rfind('/') + 1)), std::string::npos)
          << run.key << " from " << run.from;
    }
}

TEST(Keys, ATextureIsTheSameInTheListAndInTheAtlas) {
  const DrawList a = page_drawn(samples::atlas(12, 4)), b = page_drawn(samples::atlas(12, 5));
  const auto from = things_of(a), to = things_of(b);
  int moved = 0;
  for (const auto& [key, box] : to) {
    if (!key.starts_with("atlas/texture/")) continue;
    ASSERT_TRUE(from.contains(key)) << key;
    moved += from.at(key).lo.x > box.lo.x + 100;
  }
  EXPECT_EQ(moved, 1) << "from the list at the right into the atlas";
}

// Of a sequence that comes with Lantern: each frame and the next one of its part.
void for_each_change(const std::string& scenario,
                     const std::function<void(const DrawList&, const DrawList&)>& look) {
  const std::vector<Frame> frames = run::frames_of(scenario);
  for (std::size_t i = 0; i + 1 < std::min<std::size_t>(frames.size(), 12); ++i) {
    const std::span<const Frame> two = std::span(frames).subspan(i, 2);
    if (!Staging::is_one_group(two[0], two[1])) continue;
    SCOPED_TRACE(scenario + ", frame " + std::to_string(i));
    const Staging staging{two};
    Work work;
    look(draw_frame(two[0], staging, page_for(1600, 900), work),
         draw_frame(two[1], staging, page_for(1600, 900), work));
  }
}

class EveryChange : public testing::TestWithParam<const char*> {};

TEST_P(EveryChange, SaysNothingThatNeitherFrameSays) {
  for_each_change(GetParam(), [](const DrawList& a, const DrawList& b) {
    const std::set<std::string> before = lines_of(a), after = lines_of(b);
    const auto words = words_of_page(a);
    for (const double t : kTimes) {
      const DrawList list = between(a, b, t);
      for (const std::string& line : lines_of(list))
        EXPECT_TRUE(before.contains(line) || after.contains(line)) << line << " at " << t;
      for (const std::string& line : words) EXPECT_TRUE(lines_of(list).contains(line)) << line;
      for (const std::string& line : words_of_page(b))
        EXPECT_TRUE(line.size() < 4 || before.contains(line) || !lines_of(list).contains(line))
            << "'" << line << "' comes before the picture, at " << t;
    }
  });
}

TEST_P(EveryChange, LeavesWallsAndBodiesWhereTheyAreInBoth) {
  for_each_change(GetParam(), [](const DrawList& a, const DrawList& b) {
    for (const DrawShape& shape : a.shapes) {
      const auto* wall = std::get_if<LineShape>(&shape);
      if (!wall || wall->stroke.role != Role::ink || wall->stroke.width < 5) continue;
      for (const double at : {0.1, 0.5, 0.9}) {
        const Vec<2> point = wall->from + (wall->to - wall->from) * at;
        if (painted(b, Role::ink, point) < 1) continue;
        for (const double t : kTimes)
          EXPECT_GE(painted(between(a, b, t), Role::ink, point), 0.999)
              << point.x << " " << point.y << " at " << t;
      }
    }
    const auto from = things_of(a), to = things_of(b);
    const auto way = passages(a, b);
    for (const auto& [key, box] : from) {
      if (key.find("world/body/") == key.npos || !to.contains(key)) continue;
      for (const double t : kTimes) {
        const Vec<2> middle = mix(box, to.at(key), progress(Beat::move, t, Motion::eased)).center();
        const DrawList list = between(a, b, way, t, Motion::eased);
        double most = 0;
        for (std::size_t i = 0; i < list.shapes.size(); ++i)
          if (glm::distance(extent_of(list.shapes[i]).center(), middle) < 12)
            most = std::max(most, list.tints[i].opacity);
        EXPECT_GE(most, 0.999) << key << " at " << t;
      }
    }
  });
}

// Where the lines of a view point that are painted whole, or not at all.
std::vector<double> view_edges(const DrawList& list) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < list.shapes.size(); ++i) {
    const auto* line = std::get_if<LineShape>(&list.shapes[i]);
    if (!line || line->stroke.role != Role::frustum || line->stroke.width != 3.4) continue;
    EXPECT_TRUE(list.tints.empty() || list.tints[i].opacity > 0.999) << "it fades";
    angles.push_back(std::atan2(line->to.y - line->from.y, line->to.x - line->from.x));
  }
  return angles;
}

void expect_turning(const DrawList& a, const DrawList& b) {
  const std::vector<double> from = view_edges(a), to = view_edges(b);
  ASSERT_GE(from.size(), 3u);
  ASSERT_EQ(to.size(), from.size());
  const auto turned = [&](double angle) {
    return std::abs(std::remainder(angle - from.back(), 2 * std::numbers::pi));
  };
  EXPECT_GT(turned(to.back()), 0.3) << "it should turn at all";
  double last = from.back();
  for (const double t : kTimes) {
    const std::vector<double> now = view_edges(between(a, b, t));
    ASSERT_EQ(now.size(), from.size()) << t;
    EXPECT_GE(turned(now.back()), turned(last)) << "it turns back at " << t;
    last = now.back();
  }
  EXPECT_NEAR(turned(last), turned(to.back()), 0.01);
}

TEST(Tween, AViewTurnsOnTheWay) {
  const auto looking = [](const Vec<3>& left, const Vec<3>& right) {
    Frame frame = samples::ghosts(3);
    frame.add<FrameFinding>().views = {{{1, 4, 0}, {{1, 4, 0}, left, right}}};
    return page_drawn(frame);
  };
  expect_turning(looking({6, 7, 0}, {7, 3, 0}), looking({7, 3, 0}, {5, 1, 0}));
  std::vector<Frame> culling = run::frames_of("frustum_culling");
  Frame turned = culling.at(1);
  for (FrameView& view : turned.add<FrameFinding>().views)
    for (Vec<3>& corner : view.corners) {  // by 20 degrees about the eye
      const Vec<3> arm = corner - view.eye;
      corner = view.eye + Vec<3>(0.94 * arm.x - 0.34 * arm.y, 0.34 * arm.x + 0.94 * arm.y, arm.z);
    }
  expect_turning(page_drawn(culling.at(1)), page_drawn(turned));
}

INSTANTIATE_TEST_SUITE_P(Tween, EveryChange,
                         testing::Values("ghost_quadtree", "children_on_demand", "doom_level_bsp",
                                         "quake_visibility", "sleeping", "node_reuse"));

}  // namespace
}  // namespace lantern::draw
