// Rays, views and regions find what asking every body would find, whatever structure answers.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "frame/parts/asked.hpp"
#include "geometry/ray.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

const std::vector<std::string> kFlatKinds = {
    "brute_force",
    "sort_and_sweep",
    "quadtree",
    "kd_tree",
    "grid",
    "grid\"\nopen = true\n#",
    "bsp\"\nplanes = [{ point = [16, 0], normal = [1, 0] }]\n#"};
const std::vector<std::string> kSolidKinds = {"brute_force", "sort_and_sweep",
                                              "quadtree",    "octree",
                                              "kd_tree",     "grid\"\ncell = 4\nlevels = 2\n#"};

std::string structure(const std::string& kind, bool split) {
  return "[structure]\nkind = \"" + kind + "\"\n" + (split ? "split_static = true\n" : "");
}

// Balls, boxes and capsules at random, some of them static; then one question.
Scenario asked(bool solid, const std::string& kind, bool split, const std::string& question) {
  const std::string size = solid ? "[32, 18, 24]" : "[32, 18]";
  const std::string half = solid ? "[1.2, 0.7, 1]" : "[1.2, 0.7]";
  return good(world_text(
      "size = " + size,
      structure(kind, split) + "[[pattern]]\nname = \"ball\"\ncount = 12\nradius = 0.9\n" +
          "[[pattern]]\nname = \"box\"\ncount = 12\nstatic = true\nturned = 30\nhalf_size = " +
          half + "\n[[pattern]]\nname = \"rod\"\ncount = 8\ncapsule = [0.5, 1]\n" +
          steps({"do = \"insert\"\nbodies = [\"ball\", \"box\", \"rod\"]", question})));
}

// Runs the question on every structure, and gives each answer to `check`.
void ask_all(const std::string& flat, const std::string& solid_question,
             const std::function<void(const Frame&)>& check) {
  for (const bool solid : {false, true})
    for (const std::string& kind : solid ? kSolidKinds : kFlatKinds)
      for (const bool split : {false, true}) {
        SCOPED_TRACE(kind + (solid ? " solid" : " flat") + (split ? " split" : ""));
        const std::string& question = solid ? solid_question : flat;
        check(frames_of(asked(solid, kind, split, question)).back());
      }
}

using Met = std::vector<std::pair<double, std::string>>;  // distance and name

// A ray against every body's true shape.
template <int D>
Met met_by_hand(const Frame& frame, const Vec<3>& from, const Vec<3>& to) {
  Ray<D> ray;
  ray.origin = in_dimension<D>(from);
  const Vec<D> way = in_dimension<D>(to) - ray.origin;
  ray.length = glm::length(way);
  ray.direction = way / ray.length;
  Met met;
  for (const FrameBody& b : frame.bodies) {
    Rotation<D> turn;
    if constexpr (D == 2)
      turn.angle = b.angle;
    else
      turn = b.orientation;
    const auto hit = entry(ray, in_dimension<D>(b.shape), in_dimension<D>(b.position), turn);
    if (hit) met.emplace_back(*hit, b.name);
  }
  std::sort(met.begin(), met.end());
  return met;
}

Met met_by_hand(const Frame& frame, const Vec<3>& from, const Vec<3>& to) {
  return frame.dimension == 2 ? met_by_hand<2>(frame, from, to) : met_by_hand<3>(frame, from, to);
}

std::vector<std::string> names_of(const Met& met) {
  std::vector<std::string> list;
  for (const auto& [distance, name] : met) list.push_back(name);
  return list;
}

Vec<3> end_of(const Frame& frame) { return {31, 10, frame.dimension == 3 ? 22 : 0}; }

TEST(Queries, ARayThatGoesThroughAllMeetsWhatEachShapeSays) {
  const std::string keys = "do = \"ray\"\nhits = \"all\"\n";
  std::size_t most = 0;
  ask_all(keys + "from = [0, 7]\nto = [31, 10]", keys + "from = [0, 7, 0]\nto = [31, 10, 22]",
          [&](const Frame& frame) {
            const Met met = met_by_hand(frame, Vec<3>(0, 7, 0), end_of(frame));
            most = std::max(most, met.size());
            EXPECT_EQ(names(frame, frame.get<FrameFinding>().hits), names_of(met))
                << "not in order along the ray";
            ASSERT_EQ(frame.get<FrameFinding>().rays.size(), 1u);
            ASSERT_EQ(frame.get<FrameFinding>().rays[0].hits.size(), met.size());
            for (std::size_t i = 0; i < met.size(); ++i)
              EXPECT_NEAR(
                  glm::length(frame.get<FrameFinding>().rays[0].hits[i].position - Vec<3>(0, 7, 0)),
                  met[i].first, 1e-9);
            EXPECT_EQ(frame.count("hits"), std::int64_t(met.size()));
            EXPECT_EQ(frame.get<FrameFinding>().rays[0].to, end_of(frame));
          });
  EXPECT_GE(most, 2u) << "the ray meets next to nothing: the test says little";
}

TEST(Queries, ARayStopsAtTheNearest) {
  ask_all("do = \"ray\"\nfrom = [0, 7]\nto = [31, 10]",
          "do = \"ray\"\nfrom = [0, 7, 0]\nto = [31, 10, 22]", [&](const Frame& frame) {
            const Met met = met_by_hand(frame, Vec<3>(0, 7, 0), end_of(frame));
            ASSERT_EQ(frame.get<FrameFinding>().hits.size(), met.empty() ? 0u : 1u);
            if (met.empty()) return;
            EXPECT_EQ(names(frame, frame.get<FrameFinding>().hits)[0], met[0].second);
            EXPECT_EQ(frame.get<FrameFinding>().rays[0].to,
                      frame.get<FrameFinding>().rays[0].hits[0].position)
                << "it is drawn beyond what stopped it";
          });
}

// All that overlap `holds`, by hand.
template <class Holds>
void expect_found(const Frame& frame, Holds&& holds) {
  Names expected, found;
  for (const FrameBody& b : frame.bodies)
    if (holds(b.box)) expected.insert(b.name);
  for (const std::string& name : names(frame, frame.get<FrameFinding>().hits)) found.insert(name);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(found.size(), frame.get<FrameFinding>().hits.size()) << "a body is found twice";
  EXPECT_TRUE(
      std::is_sorted(frame.get<FrameFinding>().hits.begin(), frame.get<FrameFinding>().hits.end()));
  EXPECT_FALSE(expected.empty()) << "the test says nothing";
  for (const FrameBody& b : frame.bodies) EXPECT_EQ(b.dimmed, !expected.contains(b.name)) << b.name;
}

TEST(Queries, ARegionHoldsWhatOverlapsIt) {
  ask_all("do = \"query\"\nmin = [8, 4]\nmax = [20, 12]",
          "do = \"query\"\nmin = [4, 2, 4]\nmax = [24, 14, 16]", [](const Frame& frame) {
            ASSERT_EQ(frame.get<FrameFinding>().queries.size(), 1u);
            expect_found(frame, [&](const Box<3>& box) {
              return overlap(box, frame.get<FrameFinding>().queries[0].box);
            });
          });
}

TEST(Queries, ABallHoldsWhatItReaches) {
  ask_all("do = \"query\"\ncenter = [14, 9]\nradius = 6",
          "do = \"query\"\ncenter = [14, 9, 12]\nradius = 9", [](const Frame& frame) {
            ASSERT_EQ(frame.get<FrameFinding>().queries.size(), 1u);
            const Vec<3> center = frame.get<FrameFinding>().queries[0].box.center();
            expect_found(frame, [&](const Box<3>& box) {
              const Vec<3> nearest = glm::clamp(center, box.lo, box.hi);
              return glm::length(nearest - center) <= frame.get<FrameFinding>().queries[0].radius;
            });
          });
}

TEST(Queries, AViewSeesTheSameWithEveryStructure) {
  std::set<Names> flat, solid;
  ask_all("do = \"cull\"\neye = [1, 9]\ntarget = [31, 9]\nangle = 50\nfar = 20",
          "do = \"cull\"\neye = [1, 9, 12]\ntarget = [31, 9, 12]\nangle = 50\nfar = 20",
          [&](const Frame& frame) {
            ASSERT_EQ(frame.get<FrameFinding>().views.size(), 1u);
            EXPECT_EQ(frame.get<FrameFinding>().views[0].corners.size(),
                      frame.dimension == 2 ? 4u : 8u);
            const auto list = names(frame, frame.get<FrameFinding>().hits);
            (frame.dimension == 2 ? flat : solid).insert(Names(list.begin(), list.end()));
            for (const FrameBody& b : frame.bodies)
              EXPECT_TRUE(b.dimmed || b.position.x < 1 + 20 + 3) << b.name << " lies too far";
          });
  EXPECT_EQ(flat.size(), 1u) << "structures see different bodies";
  EXPECT_EQ(solid.size(), 1u) << "structures see different bodies";
  EXPECT_FALSE(flat.begin()->empty() || solid.begin()->empty());
}

TEST(Queries, WhatTheyFoundIsShownOnTheirStepOnly) {
  Scenario s = asked(false, "quadtree", false, "do = \"query\"\nmin = [8, 4]\nmax = [20, 12]");
  s.steps.push_back(s.steps.back());
  s.steps.back().verb = Show();
  const Frame last = frames_of(s).back();
  EXPECT_TRUE(last.get<FrameFinding>().queries.empty() && last.get<FrameFinding>().hits.empty());
  EXPECT_TRUE(last.count("hits").has_value()) << "but it is still counted";
  for (const FrameBody& b : last.bodies) EXPECT_FALSE(b.dimmed);
}

TEST(Queries, EventsTellTheWholeWalk) {
  for (const bool solid : {false, true}) {
    const Scenario s = asked(solid, solid ? "octree" : "quadtree", false,
                             solid ? "do = \"query\"\nmin = [4, 2, 4]\nmax = [24, 14, 16]\n"
                                     "pace = \"event\""
                                   : "do = \"query\"\nmin = [8, 4]\nmax = [20, 12]\n"
                                     "pace = \"event\"");
    const auto frames = frames_of(s);
    std::int64_t visits = 0, skips = 0, tests = 0, hits = 0;
    for (const Frame& frame : frames) {
      visits += frame.event == "visit";
      skips += frame.event == "skip";
      tests += frame.event == "hit" || frame.event == "miss";
      hits += frame.event == "hit";
    }
    const Frame& last = frames.back();
    EXPECT_EQ(last.count("nodes_visited"), visits);
    EXPECT_EQ(last.count("nodes_skipped"), skips);
    EXPECT_EQ(last.count("objects_tested"), tests);
    EXPECT_EQ(last.count("hits"), hits);
  }
}

}  // namespace
}  // namespace lantern::run
