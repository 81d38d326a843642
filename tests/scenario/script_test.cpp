// The script: what each verb becomes, and what is known to go wrong before anything runs.
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

const std::string kScriptScene = R"(title = "x"
[world]
size = [64, 64]
time_step = 0.25
[structure]
kind = "quadtree"
capacity = 3
[[body]]
name = "red"
radius = 1
position = [1, 1]
[[body]]
name = "wall"
half_size = [0, 4]
position = [2, 2]
static = true
[[pattern]]
name = "dot"
count = 3
radius = 1
)";

const std::string kScriptAtlas = R"(title = "x"
[atlas]
size = [64, 32]
[[texture]]
name = "A"
size = [8, 16]
[[texture_pattern]]
name = "t"
count = 3
min = [8, 8]
max = [8, 8]
)";

template <class Verb>
Verb verb(const Scenario& scenario, std::size_t step) {
  return std::get<Verb>(scenario.steps.at(step).verb);
}

using Indices = std::vector<std::size_t>;

TEST(Script, VerbsOfAWorld) {
  const Scenario s = good(
      kScriptScene +
      steps({"do = \"show\"\nname = \"a\"\npart = \"b\"\ncaption = \"c\"",
             "do = \"insert\"\nbodies = [\"dot\", \"red\"]\npace = \"event\"\nevents = [\"split\"]",
             "do = \"remove\"\nbodies = [\"dot2\"]", "do = \"move\"\nbody = \"red\"\nto = [3, 4]",
             "do = \"move\"\nbody = \"dot1\"\nvelocity = [3, 4]", "do = \"run\"\nseconds = 1.5"}));
  ASSERT_EQ(s.steps.size(), 6u);
  EXPECT_TRUE(std::holds_alternative<Show>(s.steps[0].verb));
  EXPECT_EQ(s.steps[0].name, "a");
  EXPECT_EQ(s.steps[0].part, "b");
  EXPECT_EQ(s.steps[0].caption, "c");
  EXPECT_FALSE(s.steps[0].pace);
  EXPECT_EQ(verb<Insert>(s, 1).bodies, (Indices{2, 3, 4, 0})) << "in the order that was written";
  EXPECT_EQ(s.steps[1].pace, Pace::event);
  EXPECT_EQ(s.steps[1].events, std::vector<std::string>{"split"});
  EXPECT_EQ(verb<Remove>(s, 2).bodies, (Indices{3}));
  EXPECT_EQ(verb<Move>(s, 3).body, 0u);
  EXPECT_EQ(verb<Move>(s, 3).to, Vec<3>(3, 4, 0));
  EXPECT_FALSE(verb<Move>(s, 3).velocity);
  EXPECT_EQ(verb<Move>(s, 4).body, 2u);
  EXPECT_EQ(verb<Move>(s, 4).velocity, Vec<3>(3, 4, 0));
  EXPECT_EQ(verb<run::Run>(s, 5).seconds, 1.5);
  EXPECT_EQ(s.steps[5].where.line, 42);
}

TEST(Script, ARebuildKeepsWhatItDoesNotSay) {
  const Scenario s = good(
      kScriptScene +
      steps({"do = \"rebuild\"\nmax_depth = 3\nchildren = \"eager\"",
             "do = \"rebuild\"\nkind = \"bsp\"\nplanes = [{ point = [1, 2], normal = [0, 1] }, { "
             "name = \"b\", point = [3, 4], normal = [1, 0], at = \"front\" }]",
             "do = \"rebuild\"\nkind = \"quadtree\"", "do = \"rebuild\"\nkind = \"bsp\""}));
  EXPECT_EQ(s.structure.max_depth, 6u) << "the scenario's own structure stays as it was written";
  const StructureSpec first = verb<Rebuild>(s, 0).structure;
  EXPECT_EQ(first.kind, StructureKind::quadtree);
  EXPECT_EQ(first.capacity, 3u);
  EXPECT_EQ(first.max_depth, 3u);
  EXPECT_TRUE(first.eager_children);
  const StructureSpec bsp = verb<Rebuild>(s, 1).structure;
  ASSERT_EQ(bsp.planes.size(), 2u);
  EXPECT_EQ(bsp.planes[0].at, "root");
  EXPECT_EQ(bsp.planes[1].at, "front");
  EXPECT_EQ(bsp.planes[1].name, "b");
  EXPECT_EQ(bsp.max_depth, 3u);
  EXPECT_TRUE(verb<Rebuild>(s, 2).structure.eager_children);
  EXPECT_EQ(verb<Rebuild>(s, 3).structure.planes.size(), 2u) << "the lines are still known";
}

TEST(Script, VerbsOfAnAtlas) {
  const Scenario s =
      good(kScriptAtlas + steps({"do = \"pack\"\ntextures = [\"t\", \"A\"]\neach = false\n"
                                 "free_name = \"C\"\nevents = [\"cut\"]",
                                 "do = \"ask_room\"\nsize = [7, 9]"}));
  const Pack pack = verb<Pack>(s, 0);
  EXPECT_EQ(pack.textures, (Indices{1, 2, 3, 0}));
  EXPECT_FALSE(pack.each);
  EXPECT_EQ(pack.free_name, "C");
  EXPECT_EQ(verb<AskRoom>(s, 1).width, 7);
  EXPECT_EQ(verb<AskRoom>(s, 1).height, 9);
  EXPECT_EQ(s.atlas->width, 64);
  EXPECT_EQ(s.atlas->height, 32);
}

TEST(Script, BodiesAreWhereTheScriptHasThem) {
  const std::string insert = "do = \"insert\"\nbodies = [\"red\"]";
  expect_mistakes(kScriptScene + steps({insert, "do = \"insert\"\nbodies = [\"wall\", @\"red\"]"}),
                  {"'red' is in the world already"});
  expect_mistakes(kScriptScene + steps({"do = \"insert\"\nbodies = [\"red\", @\"red\"]"}),
                  {"already"});
  expect_mistakes(kScriptScene + steps({"do = \"insert\"\nbodies = [\"dot2\", @\"dot\"]"}),
                  {"'dot2' is in the world already"});
  expect_mistakes(kScriptScene + steps({"do = \"remove\"\nbodies = [@\"red\"]"}),
                  {"'red' is not in the world at this step"});
  expect_mistakes(kScriptScene + steps({"do = \"move\"\nbody = @\"red\"\nto = [1, 1]"}),
                  {"'red' is not in the world at this step"});
  expect_mistakes(kScriptScene + steps({insert, "do = \"remove\"\nbodies = [\"red\"]",
                                        "do = \"move\"\nbody = @\"red\"\nto = [1, 1]"}),
                  {"insert it first"});
  good(kScriptScene + steps({insert, "do = \"remove\"\nbodies = [\"red\"]", insert}));
}

TEST(Script, ATextureIsPackedOnce) {
  expect_mistakes(kScriptAtlas + steps({"do = \"pack\"\ntextures = [\"A\"]",
                                        "do = \"pack\"\ntextures = [\"t\", @\"A\"]"}),
                  {"'A' is packed already"});
}

TEST(Script, AMoveIsOfOneBodyThatCan) {
  expect_mistakes(kScriptScene + steps({"do = \"insert\"\nbodies = [\"dot\"]",
                                        "do = \"move\"\nbody = @\"dot\"\nto = [1, 1]"}),
                  {"its bodies are 'dot1' to 'dot3'"});
  expect_mistakes(kScriptScene + steps({"do = \"insert\"\nbodies = [\"wall\"]",
                                        "do = \"move\"\nbody = \"wall\"\nvelocity = @[1, 1]"}),
                  {"'wall' is static"});
  good(kScriptScene + steps({"do = \"insert\"\nbodies = [\"wall\"]",
                             "do = \"move\"\nbody = \"wall\"\nto = [1, 1]\nvelocity = [0, 0]"}));
}

TEST(Script, ARunIsAWholeNumberOfTimeSteps) {
  expect_mistakes(kScriptScene + steps({"do = \"run\"\nseconds = @0.3"}),
                  {"0.25 s or 0.5 s would be 1 or 2"});
  expect_mistakes(kScriptScene + steps({"do = \"run\"\nseconds = @0.1"}), {"not a whole number"});
  // A third of a second cannot be written as a decimal, but is meant.
  const std::string sixtieth = "title = \"x\"\n[world]\nsize = [1, 1]\n";
  good(sixtieth + steps({"do = \"run\"\nseconds = 0.3333333"}));
  expect_mistakes(sixtieth + steps({"do = \"run\"\nseconds = @0.33"}), {"19.8 time steps"});
}

TEST(Script, FramesOfAllStepsAreBounded) {
  const std::string run = "do = \"run\"\nseconds = 12500";  // 50000 time steps
  good(kScriptScene + steps({run, run}));
  expect_mistakes(kScriptScene + steps({run, run, "do = @\"show\"", "do = \"show\""}),
                  {"100001 frames in all, the limit is 100000"});
  expect_mistakes(kScriptScene + steps({"do = \"run\"\nseconds = @25000.25"}),
                  {"100001 frames in all"});
}

TEST(Script, WhatAllStepsNameIsBounded) {
  std::string text =
      "title = \"x\"\n[world]\nsize = [9, 9]\n[[pattern]]\nname = \"p\"\ncount = "
      "20000\nradius = 1\n";
  for (int i = 0; i < 26; ++i)
    text += steps({"do = \"insert\"\nbodies = [\"p\"]", "do = \"remove\"\nbodies = [\"p\"]"});
  const auto found = mistakes(text);
  ASSERT_EQ(found.size(), 1u) << "told once";
  EXPECT_NE(found[0].message.find("1000000"), std::string::npos) << shown(found);
}

TEST(Script, PlanesHaveFreePlacesBelowEarlierOnes) {
  const auto with = [](const std::string& at) {
    return "title = \"x\"\n[world]\nsize = [9, 9]\n[structure]\nkind = \"bsp\"\n" + at +
           "[[body]]\nname = \"a\"\nradius = 1\nposition = [1, 1]\n[[step]]\ndo = \"show\"\n";
  };
  const auto plane = [](const std::string& at) {
    return "[[structure.planes]]\npoint = [1, 1]\nnormal = [1, 0]\n" +
           (at.empty() ? "" : "at = " + at + "\n");
  };
  good(with(plane("") + plane("\"back\"") + plane("\"back.front\"") + plane("\"front\"")));
  good(with(plane("\"root\"")));
  expect_mistakes(with(plane("") + plane("@\"back.front\"")), {"there is no region 'back.front'"});
  expect_mistakes(with(plane("@\"back\"")), {"known here: root"});
  expect_mistakes(with(plane("") + plane("\"back\"") + plane("@\"back\"")),
                  {"another line divides 'back'"});
  expect_mistakes(with(plane("") + "@" + plane("")), {"only the first plane"});
  expect_mistakes("title = \"x\"\n[world]\nsize = [9, 9]\n[structure]\nkind = @\"bsp\"\n" +
                      std::string("[[body]]\nname = \"a\"\nradius = 1\nposition = [1, 1]\n") +
                      steps({"do = \"show\""}),
                  {"needs the lines that divide it"});
}

// --- promises ---

TEST(Script, ExpectationsKeepTheirPlaces) {
  const Scenario s =
      good(kScriptScene +
           steps({"do = \"insert\"\nbodies = [\"red\", \"wall\"]\n"
                  "expect = { pairs = 1, nodes = 5, in_leaves = { wall = 2 }, pairs_are = "
                  "[[\"red\", \"wall\"]], position = { red = [1, 2] }, tolerance = 0.5 }\n"
                  "always = { all_pairs = 1 }"}));
  const auto& expect = s.steps[0].expect;
  ASSERT_EQ(expect.size(), 5u);
  EXPECT_EQ(expect[0].kind, Expectation::Kind::count);
  EXPECT_EQ(expect[0].name, "pairs") << "in the order of the file";
  EXPECT_EQ(expect[0].number, 1);
  EXPECT_EQ(expect[0].where.line, 24);
  EXPECT_EQ(expect[0].where.column, 12);
  EXPECT_EQ(expect[1].name, "nodes");
  EXPECT_EQ(expect[2].kind, Expectation::Kind::leaves);
  EXPECT_EQ(expect[2].name, "wall");
  EXPECT_EQ(expect[2].number, 2);
  EXPECT_EQ(expect[3].kind, Expectation::Kind::pairs);
  EXPECT_EQ(expect[3].pairs, (std::vector<std::pair<std::string, std::string>>{{"red", "wall"}}));
  EXPECT_EQ(expect[4].kind, Expectation::Kind::position);
  EXPECT_EQ(expect[4].position, Vec<3>(1, 2, 0));
  EXPECT_EQ(expect[4].tolerance, 0.5);
  ASSERT_EQ(s.steps[0].always.size(), 1u);
  EXPECT_EQ(s.steps[0].always[0].name, "all_pairs");
  const Expectation strict =
      good(kScriptScene + steps({"do = \"show\"\nexpect = { position = { red = [1, 2] } }"}))
          .steps[0]
          .expect[0];
  EXPECT_EQ(strict.tolerance, 1e-9);
}

TEST(Script, NoPairsMayBePromised) {
  const Scenario s = good(kScriptScene + steps({"do = \"show\"\nexpect = { pairs_are = [] }"}));
  ASSERT_EQ(s.steps[0].expect.size(), 1u) << "an empty list is a promise, too";
}

TEST(Script, OnlyWhatIsCountedCanBePromisedOrQuoted) {
  expect_mistakes(kScriptScene + steps({"do = \"show\"\nexpect = { @refused = 1 }"}),
                  {"no [atlas]"});
  expect_mistakes(kScriptAtlas + steps({"do = \"show\"\nexpect = { @pairs = 1, nodes = 1 }"}),
                  {"an atlas has none"});
  expect_mistakes(
      kScriptAtlas + steps({"do = \"show\"\nexpect = { @room = 1 }\ncaption = \"@{room}\"",
                            "do = \"ask_room\"\nsize = [1, 1]\nexpect = { room = 1 }",
                            "do = \"show\"\nexpect = { room = 1 }"}),
      {"no step has asked for room yet", "no step has asked for room yet"});
  expect_mistakes(
      kScriptScene + steps({"do = \"show\"\ncaption = \"{nodes}\"",
                            "do = \"rebuild\"\nkind = \"none\"\ncaption = \"@{nodes} "
                            "{bodies} {all_pairs}\"\nexpect = { @in_leaves = { red = 1 } }"}),
      {"there is no structure at this step", "there is no structure at this step"});
  expect_mistakes("title = \"x\"\n" + steps({"do = \"show\"\nexpect = { @bodies = 0 }"}),
                  {"no bodies"});
  expect_mistakes(kScriptScene + steps({"do = \"show\"\nexpect = { @pair = 0 }"}),
                  {"did you mean 'pairs'?"});
  expect_mistakes(kScriptScene + steps({"do = \"show\"\nexpect = { @tolerance = 0.1 }"}),
                  {"without a 'position'"});
  expect_mistakes(kScriptScene + steps({"do = \"show\"\nexpect = { in_leaves = { @dot = 1 } }"}),
                  {"its bodies are 'dot1' to 'dot3'"});
}

TEST(Script, CaptionsAreCheckedBeforeAnythingRuns) {
  expect_mistakes(
      kScriptScene + steps({"do = \"show\"\ncaption = \"{pairs:pair}, @{piars} and @{texture}\""}),
      {"did you mean 'pairs'?", "no [atlas]"});
  expect_mistakes(
      kScriptScene + steps({"do = \"show\"\ncaption = \"all {{ of }} @{time:second} @{ it\""}),
      {"it takes no noun", "a '{' without its '}'"});
  expect_mistakes(kScriptScene + steps({"do = \"show\"\ncaption = @\"\"\"\n{pairs} {piars}\"\"\""}),
                  {"cannot quote 'piars'"});
  good(kScriptAtlas +
       steps({"do = \"show\"\ncaption = \"{texture} {refused_names} {refused:one/many}\""}));
}

TEST(Script, AStepThatRepeatsStandsThereAsOftenAsItSays) {
  const Scenario s =
      good(kScriptScene +
           steps({"do = \"show\"\nname = \"again\"\nrepeat = 3\nending = true\nquestion = "
                  "\"Many?\"\nanswer = \"None.\"\nexpect = { bodies = 0 }"}));
  ASSERT_EQ(s.steps.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(s.steps[i].name, "again");
    EXPECT_EQ(s.steps[i].ending, i == 2) << i;
    EXPECT_EQ(s.steps[i].question.empty(), i < 2) << "asked once";
    EXPECT_EQ(s.steps[i].where.line, s.steps[0].where.line);
    EXPECT_EQ(s.steps[i].expect.size(), 1u);
  }
  expect_mistakes(kScriptScene + steps({"do = \"insert\"\nrepeat = 2\nbodies = [@\"red\"]"}),
                  {"is in the world already"});
}

}  // namespace
}  // namespace lantern::run
