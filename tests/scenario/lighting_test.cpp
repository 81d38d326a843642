// What is lit is the cause of a frame, and no result is told before it has happened.
#include <algorithm>

#include <gtest/gtest.h>

#include "frame/parts/asked.hpp"
#include "frame/parts/level.hpp"
#include "frame/parts/motion.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

bool lights_anything(const Frame& frame) {
  return std::ranges::any_of(frame.bodies, &FrameBody::lit) ||
         std::ranges::any_of(frame.pairs, &FramePair::lit) ||
         std::ranges::any_of(frame.nodes, [](const auto& n) { return n.mark != Mark::quiet; }) ||
         std::ranges::any_of(frame.get<FrameLevel>().walls,
                             [](const auto& w) { return w.mark != Mark::quiet; });
}

TEST(Lighting, AFirstFrameLightsNothing) {
  for (const std::string& name : all_scenarios()) {
    const Scenario scenario = shipped(name);
    if (scenario.pace == Pace::event || scenario.steps[0].pace == Pace::event) continue;
    Work work;
    direct(scenario, Pace::step, work, [&](const Frame& frame) {
      EXPECT_FALSE(lights_anything(frame)) << name;
      return false;
    });
  }
}

std::string ball(const std::string& name, const std::string& at) {
  return "[[body]]\nname = \"" + name + "\"\nradius = 0.5\nposition = " + at + "\n";
}

const std::string kTreeOfTwo = "[structure]\nkind = \"quadtree\"\ncapacity = 1\n";
const std::string kThree = ball("a", "[2, 2]") + ball("b", "[14, 2]") + ball("c", "[14, 14]");

Scenario scene(const std::string& keys, const std::string& bodies,
               const std::vector<std::string>& script) {
  return good(world_text("size = [16, 16]\n" + keys, kTreeOfTwo + bodies + steps(script)));
}

Names lit_leaves(const Frame& frame) {
  Names labels;
  for (const FrameNode& node : frame.nodes)
    if (node.mark == Mark::lit) labels.insert(node.label);
  return labels;
}

TEST(Lighting, AnInsertionLightsItsBodyItsLeavesAndTheWay) {
  const auto frames = frames_of(
      scene("", kThree,
            {"do = \"insert\"\nbodies = [\"a\", \"b\"]", "do = \"insert\"\nbodies = [\"c\"]"}));
  const Frame& last = frames.back();
  EXPECT_TRUE(body(last, "c").lit);
  EXPECT_FALSE(body(last, "a").lit);
  EXPECT_EQ(lit_leaves(last), Names({"2"}));
  EXPECT_EQ(node(last, "root").mark, Mark::passed);
}

TEST(Lighting, OfManyOnlyNewNodesAreLit) {
  const std::string dots = "[[pattern]]\nname = \"dot\"\ncount = 4\nradius = 0.1\n";
  const auto frames = frames_of(scene("", kThree + ball("d", "[1, 1]") + dots,
                                      {"do = \"insert\"\nbodies = [\"a\", \"b\", \"c\"]",
                                       "do = \"insert\"\nbodies = [\"d\", \"dot\"]",
                                       "do = \"rebuild\"\ncapacity = 2", "do = \"show\""}));
  EXPECT_TRUE(std::ranges::none_of(frames[1].bodies, &FrameBody::lit));
  EXPECT_FALSE(lights_anything(frames[3])) << "nothing is new";
}

TEST(Lighting, WhenAllMoveNobodyIsLit) {
  const std::string moving = "velocity = [1, 0]\n";
  const auto frames =
      frames_of(scene("", ball("a", "[2, 2]") + moving + ball("b", "[2, 14]") + moving,
                      {"do = \"insert\"\nbodies = [\"a\", \"b\"]", "do = \"run\"\nseconds = 0.1"}));
  EXPECT_TRUE(std::ranges::none_of(frames.back().bodies, &FrameBody::lit));
  EXPECT_EQ(lit_leaves(frames.back()), Names());
}

// Along the lower side: a is hit at 1.5, and b lies behind it.
const std::string kRay = "do = \"ray\"\nfrom = [0, 2]\nto = [16, 2]\npace = \"event\"";

TEST(Findings, GrowWithTheWalk) {
  const auto frames =
      frames_of(scene("", kThree, {"do = \"insert\"\nbodies = [\"a\", \"b\", \"c\"]", kRay}));
  const Frame& first = at(frames, "visit");
  EXPECT_EQ(first.count("nodes_visited"), 1);
  EXPECT_EQ(first.count("objects_tested"), 0);
  EXPECT_EQ(first.count("hits"), 0);
  EXPECT_EQ(first.get<FrameFinding>().rays.at(0).to, Vec<3>(16, 2, 0)) << "it has met nothing yet";
  const Frame& hit = at(frames, "hit");
  EXPECT_EQ(hit.count("hits"), 1);
  EXPECT_DOUBLE_EQ(hit.get<FrameFinding>().rays.at(0).to.x, 1.5);
  const Frame& skip = at(frames, "skip");
  EXPECT_GE(*skip.count("nodes_skipped"), 1);
  EXPECT_TRUE(std::ranges::any_of(skip.nodes, &FrameNode::skipped));
  EXPECT_TRUE(std::ranges::none_of(
      skip.nodes, [](const FrameNode& n) { return n.skipped && n.mark != Mark::quiet; }));
  std::int64_t seen = 0;
  for (const Frame& frame : frames)
    if (const auto visited = frame.count("nodes_visited")) {
      EXPECT_GE(*visited, seen);
      seen = *visited;
    }
  EXPECT_EQ(node(frames.back(), "3").met, 0u) << "the first leaf on its way";
}

TEST(Findings, EndAsTheyDoStepByStep) {
  for (const std::string question : {"do = \"ray\"\nfrom = [0, 2]\nto = [16, 2]\nhits = \"all\"",
                                     "do = \"cull\"\neye = [0, 2]\ntarget = [16, 2]\nfar = 20",
                                     "do = \"query\"\ncenter = [14, 8]\nradius = 6"}) {
    const std::string insert = "do = \"insert\"\nbodies = [\"a\", \"b\", \"c\"]";
    const auto at_once = frames_of(scene("", kThree, {insert, question})).back();
    const auto by_event = frames_of(scene("", kThree, {insert, question + "\npace = \"event\""}));
    EXPECT_EQ(by_event.back().get<FrameFinding>().hits, at_once.get<FrameFinding>().hits);
    for (const char* name : {"nodes_visited", "nodes_skipped", "objects_tested", "hits"})
      EXPECT_EQ(by_event.back().count(name), at_once.count(name)) << name;
    EXPECT_EQ(by_event.at(by_event.size() - 2).count("hits"), at_once.count("hits"));
  }
}

TEST(Findings, PhasesTellNoContactBeforeTheNarrowPhase) {
  const std::string touching = ball("a", "[2, 2]") + ball("b", "[2.9, 2]");
  const auto frames =
      frames_of(scene("contacts = \"impulse\"\n", touching,
                      {"do = \"insert\"\nbodies = [\"a\", \"b\"]", "do = \"run\"\nseconds = 0.1",
                       "do = \"phases\"\npace = \"event\""}));
  const Frame& broad = at(frames, "broad_phase");
  EXPECT_EQ(broad.count("contacts"), 0);
  EXPECT_TRUE(broad.contacts.empty());
  EXPECT_EQ(broad.phase, StepPhase::broad);
  EXPECT_EQ(at(frames, "narrow_phase").phase, StepPhase::narrow);
}

TEST(Told, AreTheNumbersThatACaptionQuotes) {
  const auto frames = frames_of(scene(
      "", kThree,
      {"do = \"insert\"\nbodies = [\"a\"]\ncaption = \"{nodes:node}, {pairs:pair}, {nodes}\"\n"
       "headline = [\"leaves:  leaf here/leaves here\"]",
       "do = \"show\"\nending = true"}));
  EXPECT_EQ(frames[0].told, (std::vector<std::string>{"nodes", "pairs"}));
  EXPECT_EQ(frames[1].headline, std::vector<std::string>{"leaves"}) << "from here on";
  EXPECT_EQ(frames[1].words.at("leaves"), "leaf here/leaves here");
  EXPECT_FALSE(frames[0].ending);
  EXPECT_TRUE(frames[1].ending);
}

TEST(Lighting, IsWhatAStepNames) {
  const std::string both = "do = \"insert\"\nbodies = [\"a\", \"b\", \"c\"]";
  const auto frames = frames_of(scene("", kThree,
                                      {both, "do = \"show\"\nlit = [\"a\", \"4\"]",
                                       "do = \"remove\"\nbodies = [\"c\"]\nlit = []"}));
  EXPECT_TRUE(body(frames[1], "a").lit);
  EXPECT_FALSE(body(frames[1], "b").lit);
  EXPECT_EQ(lit_leaves(frames[1]), Names{"4"});
  EXPECT_EQ(node(frames[1], "root").mark, Mark::passed) << "the way down to it";
  EXPECT_FALSE(lights_anything(frames[2]));
}

TEST(Lighting, OfWhatIsNotThereIsAnUnmetPromise) {
  Work work;
  const auto report =
      direct(scene("", kThree, {"do = \"insert\"\nbodies = [\"a\"]\nlit = [\"a\", \"1.3\"]"}),
             Pace::step, work, [](const Frame&) { return true; });
  ASSERT_EQ(report.unmet.count(), 1u);
  EXPECT_NE(report.unmet.told()[0].message.find("'1.3' is to be lit on frame 0"),
            std::string::npos);
}

TEST(Panels, OfAStepStayUntilOthersAreNamed) {
  const std::string text =
      "panels = [\"world\", \"tree\", \"ledger\"]\n" +
      world_text("size = [16, 16]",
                 kTreeOfTwo + kThree +
                     steps({"do = \"show\"\npanels = [\"world\"]", "do = \"show\"",
                            "do = \"show\"\npanels = [\"tree\", \"world\"]"}));
  const auto frames = frames_of(good(text));
  EXPECT_EQ(frames[0].panels, std::vector{panel_named("world")});
  EXPECT_EQ(frames[1].panels, frames[0].panels);
  EXPECT_EQ(frames[2].panels, (std::vector{panel_named("tree"), panel_named("world")}));
}

TEST(Panels, OfAStepAreAmongTheScenarios) {
  expect_mistakes("panels = [\"world\"]\n" + world_text("size = [16, 16]", kTreeOfTwo + kThree) +
                      "[[step]]\ndo = \"show\"\npanels = [\"world\", @\"tree\"]\n",
                  {"'tree' is not among the scenario's panels"});
}

TEST(Told, OnlyTheLastStepIsAnEnding) {
  expect_mistakes(world_text("size = [16, 16]", kTreeOfTwo + kThree) +
                      "[[step]]\ndo = \"show\"\n@ending = true\n[[step]]\ndo = \"show\"\n",
                  {"is for the last step"});
}

TEST(Rulers, MeasureAndCompare) {
  const auto frames = frames_of(scene("", ball("a", "[2, 2]") + ball("b", "[14, 2]"),
                                      {"do = \"insert\"\nbodies = [\"a\", \"b\"]",
                                       "do = \"move\"\nbody = \"b\"\nto = [15.5, 2]\n"
                                       "ruler = [{ a = \"a\", b = \"b\", change = true }]"}));
  ASSERT_EQ(frames[1].get<FrameRulers>().rulers.size(), 1u);
  EXPECT_EQ(frames[1].get<FrameRulers>().rulers[0].length, 13.5);
  EXPECT_EQ(frames[1].get<FrameRulers>().rulers[0].before, 12.0);
}

TEST(Rulers, WaitForTheirBodiesAndHaveTwoEnds) {
  const std::string ruler = "do = \"show\"\nruler = [{ a = \"a\", to = [0, 0] }]";
  EXPECT_TRUE(frames_of(scene("", kThree, {ruler})).back().get<FrameRulers>().rulers.empty());
  const std::string before = world_text("size = [16, 16]", kTreeOfTwo + kThree);
  expect_mistakes(before + "[[step]]\ndo = \"show\"\n@[[step.ruler]]\na = \"a\"\n",
                  {"one of 'b' and 'to'"});
  expect_mistakes(before +
                      "[[step]]\ndo = \"show\"\n[[step.ruler]]\na = \"a\"\n@from = [0, 0]\n"
                      "to = [1, 1]\n",
                  {"only one of 'a' and 'from'"});
}

TEST(Forces, AreShownWhenTheWorldSaysSo) {
  const std::string spring =
      "[[spring]]\na = \"b\"\nto = [14, 5]\nstiffness = 10\nrest_length = 1\n";
  const std::vector<std::string> script = {"do = \"insert\"\nbodies = [\"a\", \"b\", \"c\"]",
                                           "do = \"force\"\nbody = \"a\"\nforce = [40, 0]"};
  EXPECT_TRUE(
      frames_of(scene("", kThree + spring, script)).back().get<FrameForces>().forces.empty());
  const auto forces = frames_of(scene("show_forces = true\n", kThree + spring, script))
                          .back()
                          .get<FrameForces>()
                          .forces;
  ASSERT_EQ(forces.size(), 2u);
  EXPECT_EQ(forces[0].force, Vec<3>(40, 0, 0));
  EXPECT_EQ(forces[1].force, Vec<3>(0, 20, 0)) << "3 long, at rest 1: 2 units of 10 N";
  EXPECT_TRUE(forces[1].of_spring);
}

}  // namespace
}  // namespace lantern::run
