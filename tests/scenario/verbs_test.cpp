// What each verb of the script does to the bodies.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "frame/pair_state.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

// A disc of mass 2 at rest in the midst of nothing.
const std::string kDisc = R"([[body]]
name = "disc"
radius = 1
mass = 2
position = [8, 8]
)";

std::vector<Frame> played(const std::string& world, const std::string& bodies,
                          const std::vector<std::string>& script) {
  return frames_of(
      good(world_text("size = [16, 16]\ntime_step = 0.125\n" + world, bodies + steps(script))));
}

const std::string kInsertDisc = "do = \"insert\"\nbodies = [\"disc\"]";

TEST(Verbs, AForceActsUntilItIsEnded) {
  const auto frames = played("", kDisc,
                             {kInsertDisc, "do = \"force\"\nbody = \"disc\"\nforce = [4, 0]",
                              "do = \"run\"\nseconds = 1\nname = \"pushed\"\nevery = 8",
                              "do = \"force\"\nbody = \"disc\"\nforce = [0, 0]",
                              "do = \"run\"\nseconds = 1\nname = \"free\"\nevery = 8"});
  // a = 2; eight steps of 1/8 s, each with the velocity of its end: a h² (1 + ... + 8)
  const FrameBody& pushed = body(at(frames, "pushed"), "disc");
  EXPECT_EQ(pushed.velocity, Vec<3>(2, 0, 0));
  EXPECT_EQ(pushed.position, Vec<3>(8 + 1.125, 8, 0));
  const FrameBody& free = body(at(frames, "free"), "disc");
  EXPECT_EQ(free.velocity, Vec<3>(2, 0, 0)) << "a force of zero still pushes";
  EXPECT_EQ(free.position, Vec<3>(11.125, 8, 0));
  EXPECT_EQ(free.angular_momentum.z, 0) << "a force at the centre turns nothing";
}

TEST(Verbs, ANewForceTakesTheOldOnesPlace) {
  const auto frames = played(
      "", kDisc,
      {kInsertDisc, "do = \"force\"\nbody = \"disc\"\nforce = [4, 0]",
       "do = \"force\"\nbody = \"disc\"\nforce = [0, 4]", "do = \"run\"\nseconds = 1\nevery = 8"});
  EXPECT_EQ(body(frames.back(), "disc").velocity, Vec<3>(0, 2, 0)) << "two forces act at once";
}

TEST(Verbs, AnImpulseStrikesOnce) {
  const auto frames =
      played("", kDisc,
             {kInsertDisc, "do = \"impulse\"\nbody = \"disc\"\nimpulse = [6, 0]\nat = [0, 0.5]",
              "do = \"run\"\nseconds = 1\nevery = 8"});
  EXPECT_EQ(body(frames[1], "disc").velocity, Vec<3>(3, 0, 0));
  EXPECT_EQ(body(frames[1], "disc").angular_momentum.z, -3) << "arm × impulse";
  EXPECT_EQ(body(frames[1], "disc").position, Vec<3>(8, 8, 0)) << "no time has passed";
  EXPECT_EQ(body(frames[2], "disc").position, Vec<3>(11, 8, 0));
  EXPECT_LT(body(frames[2], "disc").angle, 0) << "it turns clockwise";
}

TEST(Verbs, ASleeperHangsInTheAirUntilItIsWoken) {
  const std::string run = "do = \"run\"\nseconds = 1\nevery = 8\nname = ";
  const auto frames = played("gravity = [0, -8]\nmay_sleep = true", kDisc,
                             {kInsertDisc, "do = \"sleep\"\nbodies = [\"disc\"]", run + "\"slept\"",
                              "do = \"wake\"\nbodies = [\"disc\"]", run + "\"woken\""});
  EXPECT_TRUE(body(frames[1], "disc").asleep);
  EXPECT_EQ(frames[1].count("asleep"), 1);
  const Frame& slept = at(frames, "slept");
  EXPECT_EQ(body(slept, "disc").position, Vec<3>(8, 8, 0)) << "a sleeper was moved by gravity";
  EXPECT_FALSE(body(frames[3], "disc").asleep);
  EXPECT_LT(body(at(frames, "woken"), "disc").position.y, 8);
}

TEST(Verbs, AMoveTurnsAndSpins) {
  const auto frames =
      played("",
             "[[body]]\nname = \"disc\"\nhalf_size = [2, 1]\noriented = true\n"
             "position = [8, 8]\n",
             {kInsertDisc, "do = \"move\"\nbody = \"disc\"\nturned = 90\nspin = 180",
              "do = \"run\"\nseconds = 1\nevery = 8"});
  constexpr double kPi = std::numbers::pi;
  EXPECT_EQ(body(frames[0], "disc").box.size(), Vec<3>(4, 2, 0));
  EXPECT_NEAR(body(frames[1], "disc").angle, kPi / 2, 1e-12);
  EXPECT_NEAR(body(frames[1], "disc").box.size().y, 4, 1e-12) << "its box did not turn with it";
  EXPECT_NEAR(std::remainder(body(frames[2], "disc").angle - 1.5 * kPi, 2 * kPi), 0, 1e-9);
  EXPECT_EQ(body(frames[2], "disc").position, Vec<3>(8, 8, 0));
}

TEST(Verbs, AMoveInASolidWorldTurnsAboutTheBodysAxis) {
  const Scenario s = good(world_text(
      "size = [9, 9, 9]\ntime_step = 0.125",
      "[[body]]\nname = \"rod\"\nhalf_size = [3, 1, 2]\noriented = true\naxis = [0, 0, 1]\n"
      "position = [4, 4, 4]\n" +
          steps({"do = \"insert\"\nbodies = [\"rod\"]",
                 "do = \"move\"\nbody = \"rod\"\nturned = 90\nto = [5, 4, 4]"})));
  const FrameBody rod = body(frames_of(s).back(), "rod");
  EXPECT_EQ(rod.position, Vec<3>(5, 4, 4));
  const Vec<3> size = rod.box.size();
  EXPECT_NEAR(size.x, 2, 1e-12);
  EXPECT_NEAR(size.y, 6, 1e-12);
  EXPECT_NEAR(size.z, 4, 1e-12) << "it turned about another axis";
}

TEST(Verbs, FramesComeEveryFewWorldStepsAndAtTheEnd) {
  const auto times = [](const std::string& every) {
    std::vector<double> list;
    for (const Frame& frame :
         played("frame_every = 3", kDisc, {kInsertDisc, "do = \"run\"\nseconds = 1\n" + every}))
      list.push_back(frame.time);
    return list;
  };
  EXPECT_EQ(times(""), (std::vector<double>{0, 0.375, 0.75, 1}));
  EXPECT_EQ(times("every = 4"), (std::vector<double>{0, 0.5, 1})) << "the step's own goes first";
  EXPECT_EQ(times("every = 1").size(), 9u);
}

// A ball flies to a wall and back.
const std::string kWallAndBall = R"([[body]]
name = "wall"
static = true
half_size = [1, 6]
position = [14, 8]
restitution = 1
friction = 0
[[body]]
name = "ball"
radius = 1
position = [4, 8]
velocity = [8, 0]
friction = 0
)";
const std::string kInsertBoth = "do = \"insert\"\nbodies = [\"wall\", \"ball\"]";

TEST(Verbs, AfterStandsOnTheLastFrameOfAStep) {
  const auto frames = played(
      "", kTree + kWallAndBall,
      {kInsertBoth + "\npace = \"event\"\ncaption = \"in\"\nafter = \"{bodies} in\"",
       "do = \"run\"\nseconds = 0.5\nevery = 2\ncaption = \"{time}\"\nafter = \"done: {time} s\"",
       "do = \"run\"\nseconds = 0.5\nevery = 2\ncaption = \"{time}\"",
       "do = \"show\"\ncaption = \"one\"\nafter = \"frame\""});
  std::vector<std::string> captions;
  for (const Frame& frame : frames)
    if (frame.step > 0) captions.push_back(frame.caption);
  EXPECT_EQ(captions, (std::vector<std::string>{"0.25", "done: 0.50 s", "0.75", "1.00", "frame"}));
  const auto of_insert = std::ranges::count(frames, 0u, &Frame::step);
  ASSERT_GT(of_insert, 1);
  EXPECT_NE(frames[0].caption, "in") << "it says what the algorithm does";
  EXPECT_EQ(frames[static_cast<std::size_t>(of_insert - 1)].caption, "2 in");
}

TEST(Verbs, AfterMayQuoteWhatACaptionMay) {
  expect_mistakes(world_text("size = [9, 9]",
                             kWallAndBall + steps({"do = \"show\"\nafter = \"a @{piars} @}\""})),
                  {"'after' cannot quote 'piars'", "in 'after': a '}'"});
}

TEST(Verbs, WaitEndsWithTheTouchAndWithTheParting) {
  for (const std::string contacts : {"impulse", "soft"}) {
    SCOPED_TRACE(contacts);
    const auto frames = played(
        "contacts = \"" + contacts + "\"", kWallAndBall,
        {kInsertBoth,
         "do = \"wait\"\nevent = \"touch\"\nbodies = [\"ball\", \"wall\"]\nat_most = 4\n"
         "name = \"touch\"\nevery = 1000\nexpect = { contacts_are = [[\"wall\", \"ball\"]] }",
         "do = \"wait\"\nevent = \"part\"\nbodies = [\"wall\", \"ball\"]\nat_most = 4\n"
         "name = \"part\"\nevery = 1000\nexpect = { contacts = 0, ends = 1 }",
         "do = \"run\"\nseconds = 0.5\nevery = 4\nname = \"after\""});
    ASSERT_EQ(frames.size(), 4u) << "one frame for each wait";
    EXPECT_GT(frames[1].time, 0.8);
    EXPECT_LT(frames[1].time, 1.3) << "8 units at 8 a second";
    EXPECT_EQ(frames[1].count("begins"), 1);
    EXPECT_GT(frames[2].time, frames[1].time);
    EXPECT_NEAR(body(frames[3], "ball").velocity.x, -8, 1e-6) << "it keeps its speed";
  }
}

TEST(Verbs, WaitEndsWhenAllAreAsleep) {
  const auto frames =
      played("gravity = [0, -10]\nmay_sleep = true\ncontacts = \"soft\"",
             "[[body]]\nname = \"ground\"\nstatic = true\nhalf_size = [8, 1]\nposition = [8, 1]\n"
             "[[body]]\nname = \"box\"\nhalf_size = [1, 1]\nposition = [8, 4]\n",
             {"do = \"insert\"\nbodies = [\"ground\", \"box\"]",
              "do = \"wait\"\nevent = \"asleep\"\nbodies = [\"box\"]\nat_most = 10\nevery = 1000\n"
              "expect = { asleep = [\"box\"], awake = 0 }"});
  EXPECT_TRUE(body(frames.back(), "box").asleep);
  EXPECT_LT(frames.back().time, 10);
  EXPECT_FALSE(body(frames.front(), "box").asleep);
}

TEST(Verbs, AWaitInVainIsReportedAtItsLine) {
  const Scenario s =
      good(world_text("size = [16, 16]\ntime_step = 0.125\ncontacts = \"impulse\"",
                      kWallAndBall + steps({kInsertBoth,
                                            "do = \"wait\"\nevent = \"touch\"\n"
                                            "bodies = [\"ball\", \"wall\"]\nat_most = 0.5",
                                            "do = \"show\"\nname = \"after\""})));
  Work work;
  std::vector<Frame> frames;
  const DirectorReport report = direct(s, Pace::step, work, [&](const Frame& frame) {
    frames.push_back(frame);
    return true;
  });
  ASSERT_EQ(report.unmet.count(), 1u) << "a wait in vain was not noticed";
  EXPECT_EQ(report.unmet.told()[0].message,
            "no touch of 'ball' and 'wall' within 0.5 s, nor any other");
  EXPECT_EQ(report.unmet.told()[0].where.line, s.steps[1].where.line);
  EXPECT_EQ(frames.back().event, "after") << "the rest of the script is still shown";
}

// Discs fly to the right from x = 4, through a net at 8 to a wall at 12.
const std::string kRace = R"([structure]
kind = "bsp"
planes = [{ name = "net", point = [8, 0], normal = [1, 0] }]
[[body]]
name = "wall"
half_size = [1, 8]
position = [13, 8]
static = true
[[body]]
name = "fast"
radius = 0.5
position = [4, 12]
velocity = [8, 0]
[[body]]
name = "slow"
radius = 0.5
position = [4, 8]
velocity = [4, 0]
[[pattern]]
name = "disc"
count = 2
arrange = "line"
radius = 0.5
min = [3, 2]
max = [4, 4]
velocity = [6, 0]
)";
const std::string kInsertRace =
    "do = \"insert\"\nbodies = [\"wall\", \"fast\", \"slow\", \"disc\"]";

std::string waiting(const std::string& event, const std::string& bodies, const std::string& rest) {
  return "do = \"wait\"\nevery = 1000\nevent = \"" + event + "\"\nbodies = [" + bodies + "]\n" +
         rest;
}

TEST(Verbs, WaitEndsWithTheFirstOfAPattern) {
  const auto frames = played("contacts = \"impulse\"", kRace,
                             {kInsertRace, waiting("touch", "\"wall\", \"disc\"",
                                                   "at_most = 4\nexpect = { "
                                                   "contacts_are = [[\"wall\", \"disc2\"]] }")});
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_NEAR(frames.back().time, 7.5 / 6, 0.13);
}

TEST(Verbs, WaitEndsWithWhoEntersAndWhoLeavesANode) {
  for (const std::string contacts : {"none", "impulse"}) {
    const auto frames = played("contacts = \"" + contacts + "\"", kRace,
                               {kInsertRace,
                                waiting("enter", "\"slow\", \"disc\"",
                                        "node = \"front\"\nat_most = 4\nexpect = { "
                                        "in_leaves = { slow = 1, disc1 = 1, disc2 = 2 } }"),
                                waiting("leave", "\"disc2\"",
                                        "node = \"back\"\nat_most = 4\nexpect = { in_leaves = "
                                        "{ disc2 = 1 } }"),
                                "do = \"show\""});
    ASSERT_EQ(frames.size(), 4u);
    // With contacts the boxes reach as far as the next step does.
    const bool ahead = contacts == "impulse";
    EXPECT_EQ(frames[1].time, ahead ? 0.5 : 0.625) << "3.5 units at 6 a second";
    EXPECT_EQ(frames[2].time, ahead ? 1 : 0.875) << "4.5 units, and touching counts";
  }
}

std::string told_in_vain(const std::string& step) {
  const Scenario s = good(world_text(
      "size = [16, 16]\ntime_step = 0.125\ncontacts = \"impulse\"\n"
      "may_sleep = true",
      kRace + "[[body]]\nname = \"stone\"\nradius = 0.5\nposition = [1, 1]\nstatic = true\n" +
          steps({kInsertRace, "do = \"insert\"\nbodies = [\"stone\"]", step})));
  Work work;
  const DirectorReport report = direct(s, Pace::step, work, [](const Frame&) { return true; });
  return report.unmet.count() == 1 ? report.unmet.told()[0].message : "";
}

TEST(Verbs, AWaitInVainTellsWhatHappenedInstead) {
  EXPECT_EQ(
      told_in_vain(waiting("touch", "\"fast\", \"slow\"", "at_most = 2")),
      "no touch of 'fast' and 'slow' within 2 s, but 'wall' and 'fast' at 1 s, 'wall' and 'slow' "
      "at 2 s");
  EXPECT_EQ(told_in_vain(waiting("touch", "\"disc\"", "at_most = 1")),
            "no touch of 'disc' and 'disc' within 1 s, but of others: 'wall' and 'fast' at 1 s");
  EXPECT_EQ(told_in_vain(waiting("part", "\"fast\", \"slow\"", "at_most = 0.5")),
            "no parting of 'fast' and 'slow' within 0.5 s, nor any other");
  EXPECT_EQ(told_in_vain(waiting("asleep", "\"fast\", \"slow\"", "at_most = 0.5")),
            "not asleep within 0.5 s: 'fast', 'slow', of 2");
  EXPECT_EQ(told_in_vain(waiting("enter", "\"slow\"", "node = \"back\"\nat_most = 0.25")),
            "no entry of 'slow' into node 'back' within 0.25 s: it is there from the start");
  EXPECT_EQ(told_in_vain(waiting("enter", "\"slow\"", "node = \"back\"\nat_most = 1")),
            "no entry of 'slow' into node 'back' within 1 s, but 'slow' into 'front' at 0.75 s");
  EXPECT_EQ(told_in_vain(waiting("leave", "\"slow\"", "node = \"frnt\"\nat_most = 1")),
            "no exit of 'slow' from node 'frnt' within 1 s: there was no such node; did you mean "
            "'front'? known here: back, front, root");
  EXPECT_EQ(told_in_vain(waiting("touch", "\"wall\", \"stone\"", "at_most = 0.5")),
            "no touch of 'wall' and 'stone' within 0.5 s: static and kinematic bodies never touch "
            "each other");
}

TEST(Verbs, PhasesShowsOneWorldStepInFiveFrames) {
  const auto frames =
      played("contacts = \"impulse\"", "[structure]\nkind = \"brute_force\"\n" + kWallAndBall,
             {kInsertBoth, "do = \"move\"\nbody = \"ball\"\nto = [12.05, 8]", "do = \"phases\""});
  ASSERT_EQ(frames.size(), 7u);
  const Frame &moved = frames[1], &broad = frames[2], &boxes = frames[3], &narrow = frames[4];
  const Frame &solve = frames[5], &last = frames[6];
  EXPECT_EQ(broad.event, "broad_phase");
  EXPECT_EQ(boxes.event, "boxes");
  EXPECT_EQ(narrow.event, "narrow_phase");
  EXPECT_EQ(solve.event, "solve");
  for (const Frame* frame : {&broad, &boxes}) {
    EXPECT_TRUE(frame->contacts.empty() && frame->tested.empty()) << frame->event;
    EXPECT_EQ(frame->count("contacts"), 0) << frame->event;
  }
  const auto state = [](const Frame& frame) {
    return PairStates(frame).state_of({frame.bodies[0].id, frame.bodies[1].id});
  };
  EXPECT_EQ(state(broad), PairState::candidate) << "the broad phase compares no boxes";
  EXPECT_EQ(state(boxes), PairState::candidate) << "their boxes overlap";
  EXPECT_EQ(state(narrow), PairState::contact);
  ASSERT_EQ(narrow.contacts.size(), 1u);
  ASSERT_EQ(solve.contacts.size(), 1u);
  EXPECT_TRUE(solve.contacts[0].begins);
  double before = 0, after = 0;
  for (const FrameContact::Point& p : narrow.contacts[0].points) before += p.impulse;
  for (const FrameContact::Point& p : solve.contacts[0].points) after += p.impulse;
  EXPECT_EQ(before, 0) << "the narrow phase shows impulses before they are there";
  EXPECT_GT(after, 0);
  for (const Frame* frame : {&broad, &boxes, &narrow, &solve})
    EXPECT_EQ(motion_hash(*frame), motion_hash(moved)) << frame->event << " has moved a body";
  EXPECT_NE(motion_hash(last), motion_hash(moved));
  EXPECT_DOUBLE_EQ(last.time, 0.125);
  EXPECT_EQ(narrow.count("contacts"), 1);
  EXPECT_EQ(narrow.count("all_pairs"), 1);
  for (const Frame* frame : {&broad, &boxes, &narrow, &solve}) EXPECT_FALSE(frame->caption.empty());
}

TEST(Verbs, PhasesCountTheStructureThatTheyShow) {
  const auto frames = played(
      "contacts = \"impulse\"", "[structure]\nkind = \"quadtree\"\ncapacity = 1\n" + kWallAndBall,
      {kInsertBoth, "do = \"move\"\nbody = \"ball\"\nto = [11.9, 3]\nvelocity = [60, 0]",
       "do = \"phases\""});
  for (const Frame& frame : frames) {
    EXPECT_EQ(frame.count("nodes"), std::int64_t(frame.nodes.size())) << frame.event;
    EXPECT_EQ(frame.count("pairs"), std::int64_t(frame.pairs.size())) << frame.event;
    EXPECT_EQ(frame.count("contacts"), std::int64_t(frame.contacts.size())) << frame.event;
  }
}

}  // namespace
}  // namespace lantern::run
