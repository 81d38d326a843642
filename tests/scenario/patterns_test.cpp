// Bodies and textures that are made many at once.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

std::vector<BodySpec> bodies(const std::string& keys, const std::string& top = "") {
  return good(top +
              "title = \"x\"\n[world]\nmin = [10, 20]\nmax = [50, 40]\n[[pattern]]\nname = "
              "\"dot\"\n" +
              keys + kShow)
      .bodies;
}

std::vector<TextureSpec> textures(const std::string& keys) {
  return good("title = \"x\"\n[atlas]\nsize = [64, 64]\n[[texture_pattern]]\nname = \"t\"\n" +
              keys + kShow)
      .textures;
}

TEST(Patterns, AreUnrolledByName) {
  const auto dots = bodies("count = 11\nradius = 1\nlook = \"ball\"\n");
  ASSERT_EQ(dots.size(), 11u);
  for (std::size_t i = 0; i < dots.size(); ++i) {
    EXPECT_EQ(dots[i].name, "dot" + std::to_string(i + 1));
    EXPECT_EQ(dots[i].color, static_cast<int>(1 + i % 8)) << "colours cycle";
    EXPECT_EQ(dots[i].look, Look::ball);
    EXPECT_EQ(dots[i].velocity, Vec<3>(0, 0, 0));
    EXPECT_EQ(dots[i].where.line, 5);
  }
  for (const BodySpec& dot : bodies("count = 3\nradius = 1\ncolor = 5\n")) EXPECT_EQ(dot.color, 5);
}

TEST(Patterns, LieInTheWorldOrWhereTheyAreTold) {
  for (const BodySpec& dot : bodies("count = 500\nhalf_size = [3, 2]\n")) {
    EXPECT_TRUE(contains(Box<3>{{13, 22, 0}, {47, 38, 0}}, dot.position))
        << "all of it in the world";
    EXPECT_EQ(dot.look, Look::box);
  }
  for (const BodySpec& dot : bodies("count = 500\nradius = 3\nmin = [0, 0]\nmax = [1, 2]\n"))
    EXPECT_TRUE(contains(Box<3>{{0, 0, 0}, {1, 2, 0}}, dot.position));
  for (const BodySpec& dot : bodies("count = 5\nradius = 300\n"))
    EXPECT_EQ(dot.position, Vec<3>(30, 30, 0)) << "too large for the world: in its middle";
  for (const BodySpec& dot : bodies("count = 5\nradius = 3\nmin = [7, 7]\nmax = [7, 7]\n"))
    EXPECT_EQ(dot.position, Vec<3>(7, 7, 0));
  for (const BodySpec& dot :
       bodies("count = 5\nradius = 3\narrange = \"grid\"\nmin = [7, 7]\nmax = [7, 7]\n"))
    EXPECT_EQ(dot.position, Vec<3>(7, 7, 0));
}

TEST(Patterns, OfAGridHaveRowsFromTheLowerLeft) {
  const auto dots = bodies("count = 8\nradius = 0\narrange = \"grid\"\n");
  ASSERT_EQ(dots.size(), 8u);
  EXPECT_EQ(dots[0].position, Vec<3>(15, 25, 0)) << "40 by 20 for 8: four columns and two rows";
  EXPECT_EQ(dots[1].position, Vec<3>(25, 25, 0));
  EXPECT_EQ(dots[4].position, Vec<3>(15, 35, 0));
  for (const int count : {1, 2, 3, 7, 50, 999}) {
    std::set<std::pair<double, double>> places;
    for (const BodySpec& dot :
         bodies("count = " + std::to_string(count) + "\nradius = 0\narrange = \"grid\"\n")) {
      places.emplace(dot.position.x, dot.position.y);
      EXPECT_TRUE(contains(Box<3>{{10, 20, 0}, {50, 40, 0}}, dot.position));
    }
    EXPECT_EQ(places.size(), static_cast<std::size_t>(count)) << "two at one place";
  }
}

TEST(Patterns, GoInAllDirectionsAtOneSpeed) {
  Vec<3> sum(0.0);
  for (const BodySpec& dot : bodies("count = 1000\nradius = 1\nspeed = 2\n")) {
    EXPECT_NEAR(std::hypot(dot.velocity.x, dot.velocity.y), 2, 1e-12);
    sum += dot.velocity;
  }
  EXPECT_LT(std::hypot(sum.x, sum.y), 200) << "as many to one side as to the other";
}

TEST(Patterns, DependOnTheSeedAndTheNameAlone) {
  const std::string keys = "count = 20\nradius = 1\n";
  const auto places = [](const std::vector<BodySpec>& list) {
    std::vector<std::pair<double, double>> all;
    for (const BodySpec& b : list) all.emplace_back(b.position.x, b.position.y);
    return all;
  };
  EXPECT_EQ(places(bodies(keys)), places(bodies(keys)));
  EXPECT_EQ(places(bodies(keys)), places(bodies(keys, "seed = 1\n"))) << "1 is the default";
  EXPECT_NE(places(bodies(keys)), places(bodies(keys, "seed = 2\n")));
  EXPECT_EQ(places(bodies(keys + "seed = 9\n")), places(bodies(keys + "seed = 9\n", "seed = 2\n")))
      << "a pattern with its own seed does not heed the scenario's";
  const std::string other = "[[pattern]]\nname = \"bit\"\n" + keys;
  const auto both = bodies(keys + other);
  EXPECT_EQ(places({both.begin(), both.begin() + 20}), places(bodies(keys)))
      << "another pattern changes nothing";
  EXPECT_NE(places({both.begin(), both.begin() + 20}), places({both.begin() + 20, both.end()}));
}

// One body's place, bit for bit: the same on every machine.
TEST(Patterns, AreTheSameOnEveryMachine) {
  const auto dots = bodies("count = 2\nradius = 1\nspeed = 1\nseed = 5\n");
  EXPECT_EQ(dots[1].position, Vec<3>(0x1.22479df533c33p+4, 0x1.bd9d88f6c6082p+4, 0));
  EXPECT_EQ(dots[1].velocity, Vec<3>(0x1.ffddc1a02c71ap-1, 0x1.767dbffaf36cdp-6, 0));
}

TEST(Patterns, OfTexturesHaveSizesInRange) {
  std::set<int> widths;
  for (const TextureSpec& t :
       textures("count = 300\nmin = [10, 3]\nmax = [31, 8]\nmultiple = 4\n")) {
    EXPECT_EQ(t.width % 4, 0);
    EXPECT_EQ(t.height % 4, 0);
    EXPECT_TRUE(12 <= t.width && t.width <= 28) << t.width;
    EXPECT_TRUE(4 <= t.height && t.height <= 8) << t.height;
    widths.insert(t.width);
  }
  EXPECT_EQ(widths, (std::set<int>{12, 16, 20, 24, 28})) << "each width comes up";
  expect_mistakes(
      "title = \"x\"\n[atlas]\nsize = [64, 64]\n[[texture_pattern]]\nname = \"t\"\n"
      "count = 1\nmin = [10, 8]\nmax = @[11, 8]\nmultiple = 4\n" +
          kShow,
      {"no width from 10 to 11 is a multiple of 4"});
}

TEST(Patterns, OfTexturesAreNamedInTheirOrder) {
  const auto made = textures("count = 50\nmin = [1, 1]\nmax = [9, 9]\n");
  auto sorted = textures("count = 50\nmin = [1, 1]\nmax = [9, 9]\norder = \"tallest_first\"\n");
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    EXPECT_EQ(sorted[i].name, "t" + std::to_string(i + 1));
    EXPECT_EQ(sorted[i].color, static_cast<int>(1 + i % 8));
    if (i > 0) {
      EXPECT_GE(sorted[i - 1].height, sorted[i].height);
    }
  }
  const auto sizes = [](const std::vector<TextureSpec>& list) {
    std::multiset<std::pair<int, int>> all;
    for (const TextureSpec& t : list) all.emplace(t.width, t.height);
    return all;
  };
  EXPECT_EQ(sizes(made), sizes(sorted)) << "the order must not change what there is";
  EXPECT_FALSE(std::is_sorted(made.begin(), made.end(),
                              [](const auto& a, const auto& b) { return a.height > b.height; }));
}

TEST(Patterns, AndBodiesHaveFittingLooks) {
  const Scenario s = good(
      "title = \"x\"\n[world]\nsize = [9, 9]\n[[body]]\nname = \"a\"\nradius = 1\nposition = [1, "
      "1]\n[[body]]\nname = \"b\"\nhalf_size = [1, 2]\nposition = [1, 1]\nvelocity = [3, 4]\n"
      "color = 8\n" +
      kShow);
  EXPECT_EQ(s.bodies[0].look, Look::disc);
  EXPECT_EQ(s.bodies[0].color, 1);
  EXPECT_EQ(std::get<Sphere>(s.bodies[0].shape).radius, 1);
  EXPECT_EQ(s.bodies[1].look, Look::box);
  EXPECT_EQ(s.bodies[1].color, 8);
  EXPECT_EQ(std::get<AxisBox<3>>(s.bodies[1].shape).half_size, Vec<3>(1, 2, 0));
  EXPECT_EQ(s.bodies[1].velocity, Vec<3>(3, 4, 0));
}

}  // namespace
}  // namespace lantern::run
