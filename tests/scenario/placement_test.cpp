// Where a pattern's bodies stand, how they enter, and which way a body is turned.
#include "language/tables/placement.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

std::vector<BodySpec> stand(const std::string& keys, const std::string& before = "",
                            const std::string& size = "[20, 10]") {
  return good("title = \"x\"\n[world]\nsize = " + size + "\n" + before +
              "[[pattern]]\nname = \"dot\"\n" + keys + kShow)
      .bodies;
}

TEST(Placement, StaggeredShiftsEveryOtherRow) {
  const auto dots =
      stand("count = 8\nradius = 0\narrange = \"staggered\"\nmin = [0, 0]\nmax = [18, 8]\n");
  ASSERT_EQ(dots.size(), 8u);
  EXPECT_EQ(dots[0].position, Vec<3>(2, 2, 0)) << "18 by 8 for 8: four columns and a half";
  EXPECT_EQ(dots[3].position, Vec<3>(14, 2, 0));
  EXPECT_EQ(dots[4].position, Vec<3>(4, 6, 0)) << "half a place to the right";
  EXPECT_EQ(dots[7].position, Vec<3>(16, 6, 0));
}

TEST(Placement, ApartKeepsClearOfEachOtherAndOfWalls) {
  const std::string wall =
      "[[body]]\nname = \"wall\"\nhalf_size = [5, 1]\nposition = [10, 5]\nstatic = true\n"
      "[[body]]\nname = \"floor\"\nground = [0, 1]\nposition = [0, 2]\n";
  const auto all = stand("count = 30\nradius = 0.5\ngap = 0.2\narrange = \"apart\"\n", wall);
  for (std::size_t i = 2; i < all.size(); ++i) {
    const Vec<3>& at = all[i].position;
    EXPECT_GE(at.y, 2.7 - 1e-6) << "above the floor";
    EXPECT_FALSE(std::abs(at.x - 10) < 5.69 && std::abs(at.y - 5) < 1.69) << "in the wall";
    for (std::size_t j = 2; j < i; ++j) EXPECT_GE(glm::length(at - all[j].position), 1.2 - 1e-6);
  }
  const auto again = stand("count = 30\nradius = 0.5\ngap = 0.2\narrange = \"apart\"\n", wall);
  EXPECT_EQ(again[20].position, all[20].position) << "by the seed alone";
  const auto boxes = stand("count = 20\nhalf_size = [1, 0.5]\narrange = \"apart\"\n");
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec<3> way = glm::abs(boxes[i].position - boxes[j].position);
      EXPECT_TRUE(way.x > 2 - 1e-6 || way.y > 1 - 1e-6);
    }
  const auto solid = stand("count = 40\nradius = 1\narrange = \"apart\"\n", "", "[9, 9, 9]");
  for (std::size_t i = 0; i < solid.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE(glm::length(solid[i].position - solid[j].position), 2 - 1e-6);
}

TEST(Placement, WhatReachesFarIsLookedAtOnce) {
  Occupied occupied({Vec<3>(0.0), Vec<3>(10, 10, 0)}, 2);
  for (int i = 0; i < 100; ++i) occupied.add({Vec<3>(-1e9), Vec<3>(1e9)});
  for (int i = 0; i < 100; ++i)
    occupied.add({Vec<3>(5, 0.1 * i, 0), Vec<3>(5.01, 0.1 * i + 0.01, 0)});
  const Box<3> all{Vec<3>(0.0), Vec<3>(10, 10, 0)};
  int looks = 0;
  const auto look = [&](bool answer) {
    looks = 0;
    return occupied.any_near(all, [&](const Box<3>&) { return ++looks > 0 && answer; });
  };
  EXPECT_TRUE(look(true));
  EXPECT_EQ(looks, 1) << "the first that meets it is enough";
  EXPECT_FALSE(look(false));
  EXPECT_GE(looks, 200);
  EXPECT_LE(looks, 500) << "once each, and once more where it reaches a second cell";
}

TEST(Placement, ApartTellsHowManyFound) {
  const auto with = [](const std::string& keys) {
    return "title = \"x\"\n[world]\nsize = [20, 10]\n[[pattern]]\nname = \"dot\"\n" + keys +
           "[[step]]\ndo = \"insert\"\nbodies = [\"dot\"]\n";
  };
  expect_mistakes(with("radius = 3\narrange = \"apart\"\ncount = @20\n"), {"of 20 bodies found"});
  expect_mistakes(with("radius = 3\n@gap = 1\ncount = 2\n"), {"of bodies that stand apart"});
  expect_mistakes(with("radius = 3\nvelocity = [1, 0]\n@speed = 1\ncount = 2\n"),
                  {"a 'velocity' and a 'speed'"});
}

const std::string kEmitter =
    "title = \"x\"\n[world]\nsize = [20, 10]\ntime_step = 0.1\n[structure]\nkind = \"quadtree\"\n"
    "[[pattern]]\nname = \"drop\"\ncount = 3\nradius = 0.2\nmin = [1, 5]\nmax = [1, 5]\n"
    "velocity = [10, 0]\n[[step]]\ndo = \"emit\"\nbodies = [\"drop\"]\nevery = 0.2\n";

TEST(Emitter, LetsBodiesInWhileTimePasses) {
  const auto frames = frames_of(good(kEmitter + "[[step]]\ndo = \"run\"\nseconds = 0.6\n"));
  ASSERT_EQ(frames.size(), 7u);
  const std::size_t there[] = {1, 1, 2, 2, 3, 3, 3};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].bodies.size(), there[i]) << i;
    EXPECT_EQ(*frames[i].count("bodies"), there[i]);
  }
  EXPECT_NEAR(body(frames[6], "drop1").position.x, 7, 1e-12);
  EXPECT_NEAR(body(frames[6], "drop3").position.x, 3, 1e-12);
  EXPECT_EQ(body(frames[4], "drop3").position.x, 1) << "as it enters";
}

// What is not sure to have entered cannot be moved or removed.
TEST(Emitter, NamesOnlyWhoHasEntered) {
  const std::string run = "[[step]]\ndo = \"run\"\nseconds = 0.3\n";
  const std::string move = "[[step]]\ndo = \"move\"\nto = [9, 9]\nbody = ";
  good(kEmitter + move + "\"drop1\"\n" + run + move + "\"drop2\"\n" + run + move + "\"drop3\"\n");
  expect_mistakes(kEmitter + run + move + "@\"drop3\"\n", {"may not have entered yet"});
  expect_mistakes(kEmitter + "[[step]]\ndo = \"remove\"\nbodies = [@\"drop\"]\n", {"'drop2'"});
  expect_mistakes(kEmitter + "[[step]]\ndo = \"insert\"\nbodies = [@\"drop3\"]\n", {"already"});
  good(kEmitter + run + run + "[[step]]\ndo = \"remove\"\nbodies = [\"drop\"]\n");
}

// --- orientation ---

Scenario with_top(const std::string& keys) {
  return good(
      "title = \"x\"\n[world]\nsize = [9, 9, 9]\n[[body]]\nname = \"top\"\n"
      "capsule = [0.5, 1]\nposition = [4, 4, 4]\n" +
      keys + "[[step]]\ndo = \"insert\"\nbodies = [\"top\"]\n");
}

const double kSlant = std::sqrt(0.5);

void expect_vector(const Vec<3>& found, const Vec<3>& wanted) {
  EXPECT_LT(glm::length(found - wanted), 1e-12) << found.x << ", " << found.y << ", " << found.z;
}

// Its own y axis, and its angular velocity, as the engine has them.
std::pair<Vec<3>, Vec<3>> top_state(const std::string& keys) {
  const auto frames = frames_of(with_top(keys));
  const FrameBody& top = body(frames.back(), "top");
  return {top.orientation.q * Vec<3>(0, 1, 0), top.angular_velocity};
}

TEST(Turns, HaveAxesOfTheirOwn) {
  const auto [up, spin] = top_state(
      "turned = { angle = -45, axis = [0, 0, 2] }\n"
      "spin = { speed = 180, axis = [0, 1, 0] }\n");
  expect_vector(up, {kSlant, kSlant, 0});
  expect_vector(spin, 3.141592653589793 * Vec<3>(kSlant, kSlant, 0));
}

TEST(Turns, WithoutOneGoAboutTheSharedAxis) {
  const auto [up, spin] = top_state("turned = 90\nspin = 180\naxis = [1, 0, 0]\n");
  expect_vector(up, {0, 0, 1});
  expect_vector(spin, {3.141592653589793, 0, 0});
  const auto [tilted, still] = top_state("turned = { angle = 90, axis = [1, 0, 0] }\nspin = 180\n");
  expect_vector(tilted, {0, 0, 1});
  expect_vector(still, {0, 3.141592653589793, 0});
}

TEST(Turns, FollowAHeading) {
  expect_vector(top_state("heading = [3, 0, 3]\n").first, {kSlant, 0, kSlant});
  expect_vector(top_state("heading = [0, 1, 0]\n").first, {0, 1, 0});
  expect_vector(top_state("heading = [0, -2, 0]\n").first, {0, -1, 0});
  const auto [up, spin] =
      top_state("heading = [1, 1, 0]\nspin = { speed = 180, axis = [0, 1, 0] }\n");
  expect_vector(spin, 3.141592653589793 * Vec<3>(kSlant, kSlant, 0));
  const Scenario flat = good(
      "title = \"x\"\n[world]\nsize = [9, 9]\n[[body]]\nname = \"a\"\nhalf_size = [1, 2]\n"
      "position = [4, 4]\nheading = [1, 0]\n" +
      kShow);
  EXPECT_NEAR(flat.bodies[0].angle, -std::acos(0.0), 1e-15);
  EXPECT_TRUE(std::holds_alternative<OrientedBox<3>>(flat.bodies[0].shape)) << "it is turned";
}

TEST(Turns, AreRefused) {
  const std::string top =
      "title = \"x\"\n[world]\nsize = [9, 9, 9]\n[[body]]\nname = \"top\"\n"
      "radius = 1\nposition = [4, 4, 4]\n";
  const auto refused = [&](const std::string& keys, const std::vector<std::string>& words) {
    expect_mistakes(top + keys + "\n" + kShow, words);
  };
  refused("spin = { speed = 1, @axes = [0, 1, 0] }", {"unknown key 'axes'"});
  refused("spin = @{ axis = [0, 1, 0] }", {"has no 'speed'"});
  refused("turned = { angle = @1e7 }", {"allowed is"});
  refused("turned = { angle = 1, axis = @[1, 0] }", {"three numbers"});
  refused("turned = @{ angle = 1, axis = [0, 0, 0] }", {"points nowhere"});
  refused("turned = 3\n@heading = [1, 0, 0]", {"one of them is enough"});
  refused("heading = @[0, 0, 0]", {"points nowhere"});
  expect_mistakes(
      "title = \"x\"\n[world]\nsize = [9, 9]\n[[body]]\nname = \"a\"\nradius = 1\n"
      "position = [4, 4]\nspin = { speed = 1, axis = @[0, 0, 1] }\n" +
          kShow,
      {"no other axis"});
}

}  // namespace
}  // namespace lantern::run
