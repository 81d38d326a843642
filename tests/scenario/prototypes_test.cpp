// What makes a world short to write: prototypes, maps, ranges of names, names that need no quotes.
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

const std::string kArena = "title = \"x\"\n[world]\nsize = [12, 8]\n";
const std::string kStoneWall = "[[prototype]]\nname = \"wall\"\nstatic = true\ncolor = 7\n";
const std::string kRoundDot = "[[prototype]]\nname = \"dot\"\nradius = 0.5\nfriction = 0.25\n";

std::string drawn(const std::string& rows, const std::string& keys = "") {
  return "[map]\n" + keys + "legend = { \"#\" = \"wall\", o = \"dot\" }\nrows = \"\"\"\n" + rows +
         "\"\"\"\n";
}

const AxisBox<3>& axis_box(const BodySpec& body) { return std::get<AxisBox<3>>(body.shape); }

TEST(Prototypes, GiveTheirKeysAndOwnOnesWin) {
  const Scenario s = good(kArena + kRoundDot +
                          "[[prototype]]\nname = \"heavy\"\nlike = \"dot\"\nmass = 3\n"
                          "[[body]]\nname = \"a\"\nlike = \"heavy\"\nposition = [1, 1]\n"
                          "[[body]]\nname = \"b\"\nlike = \"heavy\"\nposition = [3, 1]\n"
                          "half_size = [1, 2]\ndensity = 4\nfriction = 1\n"
                          "[[pattern]]\nname = \"p\"\nlike = \"dot\"\ncount = 2\n" +
                          kShow);
  EXPECT_EQ(std::get<Sphere>(s.bodies[0].shape).radius, 0.5) << "from a prototype's prototype";
  EXPECT_EQ(s.bodies[0].mass, 3);
  EXPECT_EQ(s.bodies[0].material.friction, 0.25);
  EXPECT_EQ(axis_box(s.bodies[1]).half_size, Vec<3>(1, 2, 0)) << "a box, whatever the prototype is";
  EXPECT_EQ(s.bodies[1].mass, 0) << "a density of its own takes the place of a mass";
  EXPECT_EQ(s.bodies[1].material.friction, 1);
  EXPECT_EQ(std::get<Sphere>(s.bodies[3].shape).radius, 0.5);
}

TEST(Prototypes, TellTheirMistakesOnceHoweverManyAreLikeThem) {
  const std::string like = "like = \"dot\"\nposition = [1, 1]\n";
  expect_mistakes(kArena + "[[prototype]]\nname = \"dot\"\nradius = @-1\n@fricton = 1\n" +
                      "[[body]]\nname = \"a\"\n" + like + "[[body]]\nname = \"b\"\n" + like + kShow,
                  {"allowed is", "did you mean 'friction'?"});
  expect_mistakes(kArena + "[[prototype]]\nname = \"dot\"\nradius = 1\n@wander = true\n" +
                      "[[body]]\nname = \"a\"\n" + like + "[[body]]\nname = \"b\"\n" + like + kShow,
                  {"needs a 'speed'"});
  expect_mistakes(kArena + kRoundDot +
                      "@position = [1, 1]\n[[pattern]]\nname = \"p\"\ncount = 2\n" +
                      "like = \"dot\"\n" + kShow,
                  {"unknown key 'position' in [[pattern]]"});
  // One that a body has, of another type than there.
  expect_mistakes(
      world_text("size = [8, 8]\n",
                 "[[pattern]]\nname = \"p\"\ncount = 2\nradius = 1\n@ground = 1\n" + kShow),
      {"unknown key 'ground' in [[pattern]]"});
}

TEST(Prototypes, ThatAreNotThereOrGoInCircles) {
  const std::string body = "[[body]]\nname = \"a\"\nposition = [1, 1]\nlike = ";
  expect_mistakes(kArena + kRoundDot + body + "@\"dots\"\n" + kShow, {"did you mean 'dot'?"});
  expect_mistakes(kArena + body + "@\"dot\"\n" + kShow, {"there is no prototype 'dot'"});
  expect_mistakes(kArena +
                      "[[prototype]]\nname = \"b\"\nlike = \"c\"\n[[prototype]]\nname = \"c\"\n"
                      "like = @\"b\"\n" +
                      body + "\"b\"\n" + kShow,
                  {"a circle: 'b' is like 'c' is like 'b'"});
  expect_mistakes(kArena + "[[prototype]]\nname = \"b\"\nlike = @\"b\"\nradius = 1\n" + kShow,
                  {"a circle: 'b' is like 'b'"});
  expect_mistakes(kArena + kRoundDot + "[[prototype]]\nname = @\"dot\"\n" + kShow, {"is taken"});
}

TEST(Maps, MergeWallsAndPutOthersInTheMiddle) {
  const Scenario s = good(kArena + kStoneWall + kRoundDot +
                          drawn("######\n"
                                "#.o..#\n"
                                "#..o.#\n"
                                "##.###\n",
                                "cell = 2\n") +
                          "[[step]]\ndo = \"insert\"\nbodies = [\"wall\", \"dot2\", \"dot1\"]\n");
  ASSERT_EQ(s.bodies.size(), 7u);
  EXPECT_EQ(s.bodies[0].name, "wall1");
  EXPECT_EQ(s.bodies[0].position, Vec<3>(6, 7, 0)) << "the upper row is one box";
  EXPECT_EQ(axis_box(s.bodies[0]).half_size, Vec<3>(6, 1, 0));
  EXPECT_EQ(s.bodies[1].position, Vec<3>(1, 4, 0)) << "equal runs below each other are one box";
  EXPECT_EQ(axis_box(s.bodies[1]).half_size, Vec<3>(1, 2, 0));
  EXPECT_EQ(s.bodies[2].position, Vec<3>(11, 4, 0));
  EXPECT_EQ(s.bodies[3].position, Vec<3>(2, 1, 0)) << "a run of another length is another box";
  EXPECT_EQ(s.bodies[4].name, "wall5");
  EXPECT_EQ(s.bodies[5].name, "dot1") << "in reading order";
  EXPECT_EQ(s.bodies[5].position, Vec<3>(5, 5, 0));
  EXPECT_EQ(s.bodies[6].position, Vec<3>(7, 3, 0));
  EXPECT_EQ(s.bodies[5].where.line, 17) << "of the letter";
  EXPECT_EQ(s.bodies[5].where.column, 3);
  EXPECT_EQ(std::get<Insert>(s.steps[0].verb).bodies.size(), 7u);
}

TEST(Maps, StandWhereTheyAreToldAndCycleColours) {
  const Scenario s = good(kArena + "[[prototype]]\nname = \"wall\"\ncolor = 0\n" +
                          "[[prototype]]\nname = \"dot\"\nradius = 1\n" +
                          drawn("##o\r\n  #\r\n", "at = [1, 2]\n") + kShow);
  ASSERT_EQ(s.bodies.size(), 4u);
  EXPECT_EQ(s.bodies[0].position, Vec<3>(1.5, 3.5, 0)) << "what moves is never merged";
  EXPECT_EQ(s.bodies[1].color, 2);
  EXPECT_EQ(s.bodies[2].color, 3);
  EXPECT_EQ(s.bodies[3].name, "dot") << "one that stands alone has no number";
  EXPECT_EQ(s.bodies[3].position, Vec<3>(3.5, 3.5, 0));
}

TEST(Maps, AreRefusedLetterByLetter) {
  expect_mistakes(kArena + kStoneWall + kRoundDot + drawn("#@x#\n#xo\n") + kShow,
                  {"the letter 'x' has no prototype, here and 1 times more"});
  expect_mistakes(kArena + kStoneWall + kRoundDot + drawn("#@é@ö#\n#é.#\n") + kShow,
                  {"the letter 'é' has no prototype, here and 1 times more", "the letter 'ö'"});
}

TEST(Maps, AreRefusedForTheirShape) {
  expect_mistakes(kArena + kStoneWall + kRoundDot + drawn("###\n@##\n") + kShow,
                  {"has 2 letters, the first has 3"});
  expect_mistakes(kArena + kStoneWall + kRoundDot + drawn("###\n###@##\n") + kShow,
                  {"has 5 letters"});
  const auto with = [](const std::string& keys) {
    return kArena + kStoneWall + kRoundDot + "[map]\nlegend = { \"#\" = \"wall\" }\n" + keys +
           "\n" + kShow;
  };
  expect_mistakes(with("cell = 5\nrows = @\"###\""), {"it would fit with cell = 4"});
  expect_mistakes(with("at = @[10, 0]\nrows = \"###\""), {"reaches beyond the world"});
  expect_mistakes(with("rows = @\"\""), {"the map is empty"});
  // Those who name what would stand there do not err.
  expect_mistakes(kArena + kStoneWall + kRoundDot +
                      "@[map]\nlegend = { \"#\" = \"wall\", o = \"dot\" }\n" +
                      "[[step]]\ndo = \"insert\"\nbodies = [\"wall\", \"dot\"]\n",
                  {"[map] has no 'rows'"});
  expect_mistakes(kArena + kStoneWall +
                      "[map]\nrows = \"#\"\nlegend = { @ab = \"wall\", \"#\" = @\"wal\" }\n" +
                      kShow,
                  {"is not one letter", "did you mean 'wall'?"});
  expect_mistakes("title = \"x\"\n[world]\nsize = [9, 9, 9]\n" + kStoneWall +
                      "[map]\n@rows = \"#\"\nlegend = { \"#\" = \"wall\" }\n" + kShow,
                  {"a map is for 2D worlds"});
}

TEST(Ranges, StandForAllTheirNames) {
  const std::string bodies = kArena + "[[pattern]]\nname = \"b\"\ncount = 12\nradius = 1\n";
  const auto insert = [&](const std::string& names) {
    return bodies + "[[step]]\ndo = \"insert\"\nbodies = [" + names + "]\n";
  };
  const Scenario s = good(insert("\"b12\", \"b2..b4\"") + "expect = { awake = [\"b2..b3\"] }\n");
  EXPECT_EQ(std::get<Insert>(s.steps[0].verb).bodies, (std::vector<std::size_t>{11, 1, 2, 3}));
  EXPECT_EQ(s.steps[0].expect[0].names, (std::vector<std::string>{"b2", "b3"}));
  expect_mistakes(insert("@\"b4..b2\""), {"write 'b2..b4'"});
  expect_mistakes(insert("@\"b4..c9\""), {"begins with 'b' and ends with 'c'"});
  expect_mistakes(insert("@\"b4..b13\""), {"there is no body 'b13' in the range 'b4..b13'"});
  expect_mistakes(insert("@\"b..b3\""), {"needs a number at both ends"});
  expect_mistakes(insert("@\"..\""), {"needs a number at both ends"});
  expect_mistakes(insert("@\"b1..b9999999999\""), {"is too long"});
  expect_mistakes(insert("\"b1\", @\"b1..b2\""), {"'b1' is in the world already"});
}

TEST(Names, OfBodyMeasuresNeedNoQuotes) {
  const std::string top =
      "title = \"x\"\n[world]\nsize = [9, 9]\ngravity = [0, -1]\n"
      "[[body]]\nname = \"d1\"\nradius = 1\nposition = [1, 1]\n"
      "[[step]]\ndo = \"insert\"\nbodies = [\"d1\"]\n";
  const Scenario s = good(top + "expect = { at_most = { energy.d1 = 3, bodies = 1 } }\n");
  ASSERT_EQ(s.steps[0].expect.size(), 2u);
  EXPECT_TRUE(s.steps[0].expect[0].name == "energy.d1" || s.steps[0].expect[1].name == "energy.d1");
  expect_mistakes(top + "expect = { at_most = { energy.@d2 = 3 } }\n", {"'d2'"});
  expect_mistakes(top + "expect = { at_most = { energy.d1 = @\"3\" } }\n", {"must be a number"});
}

TEST(Names, OfFilesAreMadeSafe) {
  const auto named = [](const std::string& path) {
    return parse_scenario("title = \"x\"\n" + kShow, path);
  };
  EXPECT_EQ(named("some/My-Scene.toml").name, "my_scene");
  EXPECT_EQ(named("some/My-Scene.toml").file_stem, "My-Scene");
  EXPECT_EQ(named("a. b c.toml").name, "a_b_c");
  EXPECT_EQ(named("plain_1.toml").file_stem, "");
}

TEST(Mistakes, OfWordsListWhatThereIs) {
  expect_mistakes("title = \"x\"\n[[step]]\ndo = @\"frobnicate\"\n",
                  {"known here: show, insert, emit, remove"});
  const std::string body =
      kArena + "[[body]]\nname = \"a\"\nradius = 1\nposition = [1, 1]\ncolor = ";
  expect_mistakes(body + "@\"rose\"\n" + kShow, {"1 red, 2 pink, 3 yellow"});
  expect_mistakes(body + "@9\n" + kShow, {"8 violet"});
}

}  // namespace
}  // namespace lantern::run
