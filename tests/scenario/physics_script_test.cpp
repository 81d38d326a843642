// The physics verbs, and what may be promised of them.
#include <numbers>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "geometry/vec.hpp"
#include "language/language.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

const std::string kPhysicsRules = R"(title = "x"
[world]
size = [64, 64]
time_step = 0.25
frame_every = 2
contacts = "impulse"
may_sleep = true
)";
const std::string kBodies = R"([[body]]
name = "red"
radius = 1
position = [1, 1]
[[body]]
name = "pink"
half_size = [1, 1]
position = [5, 1]
[[body]]
name = "wall"
half_size = [0, 4]
position = [9, 2]
static = true
[[pattern]]
name = "dot"
count = 3
radius = 1
)";
const std::string kFree = "title = \"x\"\n[world]\nsize = [64, 64]\ntime_step = 0.25\n";
const std::string kPhysicsScene = kPhysicsRules + kTree + kBodies;
const std::string kInsertAll = "do = \"insert\"\nbodies = [\"red\", \"pink\", \"wall\", \"dot\"]";

template <class Verb>
Verb verb(const std::string& step) {
  const Scenario s = good(kPhysicsScene + steps({kInsertAll, step}));
  return std::get<Verb>(s.steps.at(1).verb);
}

// The mistake of a step that follows the insertion of all bodies.
void expect_mistake(const std::string& step, const std::string& words) {
  expect_mistakes(kPhysicsScene + steps({kInsertAll, step}), {words});
}

TEST(PhysicsVerbs, MoveTurnsAndSpins) {
  const Move move =
      verb<Move>("do = \"move\"\nbody = \"red\"\nturned = 90\nspin = -180\nrebuild = false");
  EXPECT_DOUBLE_EQ(*move.turned, 90 * kDegree);
  EXPECT_DOUBLE_EQ(*move.spin, -180 * kDegree);
  EXPECT_FALSE(move.rebuild);
  EXPECT_FALSE(move.to || move.velocity);
  EXPECT_TRUE(verb<Move>("do = \"move\"\nbody = \"red\"\nto = [1, 1]").rebuild) << "the default";
  expect_mistake("do = \"move\"\nbody = \"pink\"\n@turned = 90", "oriented = true");
  expect_mistake("do = \"move\"\nbody = \"red\"\nspin = @nan", "must be finite");
}

TEST(PhysicsVerbs, RunMayHaveItsOwnFrames) {
  EXPECT_EQ(verb<run::Run>("do = \"run\"\nseconds = 1\nevery = 4").every, 4);
  EXPECT_EQ(verb<run::Run>("do = \"run\"\nseconds = 1").every, 0) << "the world's";
}

TEST(PhysicsVerbs, WaitsForWhatCanHappen) {
  const Wait wait = verb<Wait>(
      "do = \"wait\"\nevent = \"part\"\nbodies = [\"pink\", \"dot2\"]\nat_most = 2\nevery = 3");
  EXPECT_EQ(wait.event, Wait::Event::part);
  EXPECT_EQ(wait.bodies, std::vector<std::size_t>{1});
  EXPECT_EQ(wait.others, std::vector<std::size_t>{4});
  EXPECT_EQ(wait.at_most, 2);
  EXPECT_EQ(wait.every, 3);
  EXPECT_EQ(verb<Wait>("do = \"wait\"\nevent = \"asleep\"\nbodies = [\"dot\"]\nat_most = 2").bodies,
            (std::vector<std::size_t>{3, 4, 5}));
  const std::string touch = "do = \"wait\"\nevent = \"touch\"\nat_most = 2\nbodies = ";
  expect_mistake(touch + "@[\"red\", \"pink\", \"wall\"]", "it takes two");
  expect_mistake(touch + "@[\"red\"]", "1 of them cannot touch: it takes two");
  expect_mistakes(kPhysicsScene + steps({"do = \"insert\"\nbodies = [\"red\"]",
                                         touch + "[\"red\", @\"pink\"]"}),
                  {"is not in the world at this step"});
  const std::string free = kFree + kTree + kBodies + steps({kInsertAll});
  expect_mistakes(
      free +
          steps({"do = \"wait\"\nevent = @\"touch\"\nbodies = [\"red\", \"pink\"]\nat_most = 1"}),
      {"contacts = \"impulse\" or \"soft\""});
  expect_mistakes(
      free + steps({"do = \"wait\"\nevent = @\"asleep\"\nbodies = [\"red\"]\nat_most = 1"}),
      {"may_sleep = true"});
  expect_mistake("do = \"wait\"\nevent = \"touch\"\nbodies = [\"red\", \"pink\"]\nat_most = @0.3",
                 "not a whole number");
}

TEST(PhysicsVerbs, WaitsForWhicheverOfAPatternIsFirst) {
  using Indices = std::vector<std::size_t>;
  const std::string touch = "do = \"wait\"\nevent = \"touch\"\nat_most = 2\nbodies = ";
  const Wait of_all = verb<Wait>(touch + "[\"dot\", \"red\"]");
  EXPECT_EQ(of_all.bodies, (Indices{3, 4, 5}));
  EXPECT_EQ(of_all.others, Indices{0});
  EXPECT_EQ(verb<Wait>(touch + "[\"red\", \"dot1..dot2\"]").others, (Indices{3, 4}));
  const Wait any_two = verb<Wait>(touch + "[\"dot\"]");
  EXPECT_EQ(any_two.bodies, (Indices{3, 4, 5}));
  EXPECT_EQ(any_two.others, any_two.bodies);
}

TEST(PhysicsVerbs, OnlyEnteringAndLeavingAreOfANode) {
  const std::string wait = "do = \"wait\"\nbodies = [\"red\", \"dot\"]\nat_most = 2\n";
  EXPECT_EQ(verb<Wait>(wait + "event = \"leave\"\nnode = \"1.3\"").node, "1.3");
  expect_mistake(wait + "event = @\"enter\"", "'enter' needs a node");
  expect_mistake(wait + "event = \"touch\"\n@node = \"1\"", "'touch' is of no node");
  expect_mistakes(
      kPhysicsRules + kBodies + steps({kInsertAll, wait + "event = \"enter\"\nnode = @\"1\""}),
      {"there is no node here: there is no structure"});
}

TEST(PhysicsVerbs, FramesAndTimeStepsOfAllStepsAreBounded) {
  // Two time steps a frame: 50000 s are 200000 time steps and 100000 frames.
  good(kPhysicsScene + steps({"do = \"run\"\nseconds = 50000"}));
  expect_mistakes(kPhysicsScene + steps({"do = \"run\"\nseconds = @50000.5"}), {"100001 frames"});
  expect_mistakes(kPhysicsScene + steps({kInsertAll,
                                         "do = \"wait\"\nevent = \"asleep\"\nbodies = [\"dot\"]\n"
                                         "at_most = @50000.5"}),
                  {"100002 frames"});
  // 1000 a frame: the time steps are the limit.
  const std::string run = "do = \"run\"\nevery = 1000\nseconds = ";
  good(kPhysicsScene + steps({run + "125000", run + "125000"}));
  expect_mistakes(kPhysicsScene + steps({run + "125000", run + "@125000.25"}),
                  {"1000001 time steps in all, the limit is 1000000"});
  expect_mistakes(kPhysicsScene + steps({run + "@250000.25"}), {"the limit is 1000000"});
}

TEST(PhysicsVerbs, ForcesAndImpulsesAreOfDynamicBodies) {
  const auto force =
      verb<ApplyForce>("do = \"force\"\nbody = \"red\"\nforce = [1, 2]\nat = [0, 1]");
  EXPECT_EQ(force.force, Vec<3>(1, 2, 0));
  EXPECT_EQ(force.at, Vec<3>(0, 1, 0));
  EXPECT_EQ(force.body, 0u);
  const auto impulse = verb<ApplyImpulse>("do = \"impulse\"\nbody = \"pink\"\nimpulse = [1, 2]");
  EXPECT_EQ(impulse.impulse, Vec<3>(1, 2, 0));
  EXPECT_EQ(impulse.at, Vec<3>(0.0)) << "the centre";
  EXPECT_EQ(impulse.body, 1u);
  for (const std::string name : {"force", "impulse"}) {
    const std::string keys = "do = \"" + name + "\"\n" + name + " = [1, 0]\nbody = ";
    expect_mistake(keys + "@\"wall\"", "'wall' is static: no " + name + " moves it");
    expect_mistake(keys + "@\"dot\"", "is a pattern");
    expect_mistakes(kPhysicsScene + steps({keys + "@\"red\""}), {"insert it first"});
  }
}

TEST(PhysicsVerbs, SleepAndWakeAreOfDynamicBodiesThatMay) {
  EXPECT_EQ(verb<Sleep>("do = \"sleep\"\nbodies = [\"dot\", \"red\"]").bodies,
            (std::vector<std::size_t>{3, 4, 5, 0}));
  EXPECT_EQ(verb<Wake>("do = \"wake\"\nbodies = [\"red\"]").bodies, (std::vector<std::size_t>{0}));
  expect_mistake("do = \"sleep\"\nbodies = [@\"wall\"]", "'wall' is not dynamic");
  expect_mistakes(kPhysicsScene + steps({"do = \"wake\"\nbodies = [@\"red\"]"}),
                  {"not in the world"});
  expect_mistakes(
      kFree + kTree + kBodies + steps({kInsertAll, "do = @\"sleep\"\nbodies = [\"red\"]"}),
      {"may_sleep = true"});
}

TEST(PhysicsVerbs, QuestionsAreRead) {
  const auto ray = verb<CastRay>("do = \"ray\"\nfrom = [0, 1]\nto = [5, 6]\nhits = \"all\"");
  EXPECT_EQ(ray.from, Vec<3>(0, 1, 0));
  EXPECT_EQ(ray.to, Vec<3>(5, 6, 0));
  EXPECT_TRUE(ray.all);
  EXPECT_FALSE(verb<CastRay>("do = \"ray\"\nfrom = [0, 1]\nto = [5, 6]").all);
  const Cull cull = verb<Cull>("do = \"cull\"\neye = [0, 1]\ntarget = [5, 6]\nangle = 90\nfar = 3");
  EXPECT_DOUBLE_EQ(cull.angle, 90 * kDegree);
  EXPECT_EQ(cull.near, 0.1);
  EXPECT_EQ(cull.far, 3);
  EXPECT_DOUBLE_EQ(verb<Cull>("do = \"cull\"\neye = [0, 1]\ntarget = [5, 6]").angle, 60 * kDegree);
  const Query box = verb<Query>("do = \"query\"\nmin = [0, 1]\nmax = [5, 6]");
  EXPECT_EQ(box.box, (Box<3>{{0, 1, 0}, {5, 6, 0}}));
  EXPECT_EQ(box.radius, 0);
  const Query disc = verb<Query>("do = \"query\"\ncenter = [3, 4]\nradius = 2");
  EXPECT_EQ(disc.box, (Box<3>{{1, 2, 0}, {5, 6, 0}})) << "flat along z";
  EXPECT_EQ(disc.radius, 2);
  const Scenario deep =
      good(std::string(kSolid) + steps({"do = \"query\"\ncenter = [3, 4, 5]\nradius = 2"}));
  EXPECT_EQ(std::get<Query>(deep.steps.back().verb).box, (Box<3>{{1, 2, 3}, {5, 6, 7}}));
}

TEST(PhysicsVerbs, QuestionsNeedAStructureAndASense) {
  expect_mistake("do = \"query\"\nmin = [0, 1]\nmax = @[-1, 6]", "no inside");
  expect_mistake("do = \"query\"\n@min = [0, 1]", "no 'max'");
  expect_mistake("do = \"query\"\nmin = [0, 1]\nmax = [1, 2]\n@center = [0, 0]\nradius = 1",
                 "one of them is enough");
  expect_mistakes(kPhysicsRules + kBodies + steps({"do = @\"ray\"\nfrom = [0, 1]\nto = [5, 6]"}),
                  {"no structure at this step"});
}

TEST(PhysicsVerbs, AreWatchedByTheirEvents) {
  const Scenario s =
      good(kPhysicsScene + steps({"do = \"phases\"\npace = \"event\"\nevents = [\"solve\"]"}));
  EXPECT_EQ(s.steps[0].pace, Pace::event);
  EXPECT_EQ(s.steps[0].events, std::vector<std::string>{"solve"});
  expect_mistake("do = \"run\"\nseconds = 1\n@events = [\"solve\"]", "'events' belongs to");
}

// --- promises ---

std::vector<Expectation> promises(const std::string& expect) {
  return good(kPhysicsScene +
              steps({kInsertAll,
                     "do = \"ray\"\nfrom = [0, 0]\nto = [1, 1]\nexpect = { " + expect + " }"}))
      .steps.at(1)
      .expect;
}

TEST(PhysicsPromises, HaveTheirForms) {
  using Kind = Expectation::Kind;
  const auto found = promises(
      "at_most = { contacts = 3, energy = 1.5 }, at_least = { hits = 1 }, contacts_are = "
      "[[\"red\", "
      "\"pink\"]], hits_are = [\"red\", \"pink\"], asleep = [\"dot\"], awake = 2, velocity = { red "
      "= "
      "[1, 2] }, half_size = { red = [1, 1] }, turned = { red = 90 }, momentum = 2.5, tolerance = "
      "0.5");
  ASSERT_EQ(found.size(), 11u);
  const std::vector<Kind> kinds = {Kind::at_most,   Kind::at_most, Kind::at_least, Kind::contacts,
                                   Kind::hits,      Kind::asleep,  Kind::count,    Kind::velocity,
                                   Kind::half_size, Kind::turned,  Kind::measure};
  for (std::size_t i = 0; i < kinds.size(); ++i) EXPECT_EQ(found[i].kind, kinds[i]) << i;
  EXPECT_EQ(found[0].name, "contacts");
  EXPECT_EQ(found[0].number, 3);
  EXPECT_EQ(found[1].number, 1.5);
  EXPECT_EQ(found[3].pairs, (std::vector<std::pair<std::string, std::string>>{{"red", "pink"}}));
  EXPECT_EQ(found[4].names, (std::vector<std::string>{"red", "pink"}));
  EXPECT_EQ(found[5].names, (std::vector<std::string>{"dot1", "dot2", "dot3"}))
      << "all of a pattern";
  EXPECT_EQ(found[6].name, "awake");
  EXPECT_EQ(found[6].number, 2);
  EXPECT_EQ(found[7].position, Vec<3>(1, 2, 0));
  EXPECT_EQ(found[7].tolerance, 0.5);
  EXPECT_DOUBLE_EQ(found[9].number, 90 * kDegree);
  EXPECT_DOUBLE_EQ(found[9].tolerance, 0.5 * kDegree) << "in degrees as well";
  EXPECT_EQ(found[10].name, "momentum");
  EXPECT_EQ(found[10].number, 2.5);
  EXPECT_EQ(found[10].tolerance, 0.5);
  EXPECT_EQ(promises("hits_are = []").size(), 1u) << "no hit is a promise, too";
}

TEST(PhysicsPromises, AreOfWhatIsCountedHere) {
  const std::string show = "do = \"show\"\nexpect = { ";
  for (const std::string count : {"hits", "nodes_visited", "nodes_skipped", "objects_tested"})
    expect_mistakes(kPhysicsScene + steps({show + "@" + count + " = 1 }"}),
                    {"no step has sent a ray"});
  expect_mistakes(kPhysicsScene + steps({show + "@hits_are = [] }"}), {"no step has sent a ray"});
  const std::string free = kFree + kTree + kBodies;
  for (const std::string count : {"contacts", "contact_points", "begins", "ends", "narrow_tests",
                                  "friction_rows", "penetration"})
    expect_mistakes(free + steps({show + "@" + count + " = 1 }"}), {"this world has no contacts"});
  expect_mistakes(free + steps({show + "@contacts_are = [] }"}), {"this world has no contacts"});
  expect_mistakes(free + steps({show + "at_most = { @contacts = 1 } }"}), {"no contacts"});
  expect_mistakes(kPhysicsScene + steps({show + "@stale = 1 }"}), {"no kd_tree at this step"});
  good(kPhysicsScene + steps({"do = \"rebuild\"\nkind = \"kd_tree\"\nexpect = { stale = 0 }"}));
  expect_mistakes(kPhysicsScene + steps({show + "@swaps = 1 }"}), {"no sort_and_sweep"});
  expect_mistakes(kPhysicsScene + steps({show + "@pairs_lost = 1 }"}), {"is as printed"});
  expect_mistakes(
      kPhysicsScene + steps({"do = \"rebuild\"\nkind = \"quadtree\"\n@as_printed = true"}),
      {"is not printed"});
  good(kPhysicsScene + steps({"do = \"rebuild\"\nkind = \"lecture_quadtree\"\nas_printed = true\n"
                              "expect = { pairs_lost = 0 }"}));
  for (const std::string count : {"reinserted", "refitted", "tree_cost"})
    expect_mistakes(kPhysicsScene + steps({show + "@" + count + " = 1 }"}), {"no aabb_tree"});
  for (const std::string count : {"slots", "node_bytes", "node_bytes_with_bounds", "nodes_asleep",
                                  "static_builds", "dynamic_builds"})
    expect_mistakes(kPhysicsRules + kBodies + steps({show + "@" + count + " = 1 }"}),
                    {"no structure"});
  for (const std::string count : {"walls", "sectors"})
    expect_mistakes(kPhysicsScene + steps({show + "@" + count + " = 1 }"}), {"no [level]"});
  for (const std::string count : {"static_builds", "dynamic_builds"})
    expect_mistakes(kPhysicsScene + steps({show + "@" + count + " = 1 }"}), {"no split_static"});
  for (const std::string count : {"asleep", "awake", "nodes_asleep"})
    expect_mistakes(free + steps({show + "@" + count + " = 1 }"}), {"nothing sleeps"});
  for (const std::string count : {"rotations", "force_evaluations", "energy", "momentum"})
    expect_mistakes(free + steps({show + "@" + count + " = 1 }"}), {"no contacts, gravity"});
  good(kFree + "gravitation = 1\n" + kTree + kBodies + steps({show + "force_evaluations = 0 }"}));
  expect_mistakes(std::string(kSolid) + steps({show + "@turned = { ball = 1 } }"}), {"2D world"});
  expect_mistakes(kPhysicsScene + steps({show + "@tolerance = 1 }"}), {"without a 'position'"});
  expect_mistakes("title = \"x\"\n[atlas]\nsize = [8, 8]\n" + steps({show + "@energy = 1 }"}),
                  {"an atlas has none"});
}

TEST(PhysicsPromises, OfNamesAreBounded) {
  std::string text = kPhysicsRules + "[[pattern]]\nname = \"p\"\ncount = 20000\nradius = 1\n" +
                     steps({"do = \"insert\"\nbodies = [\"p\"]"});
  for (int i = 0; i < 60; ++i) text += steps({"do = \"show\"\nexpect = { asleep = [\"p\"] }"});
  const auto found = mistakes(text);
  ASSERT_EQ(found.size(), 1u) << "told once";
  EXPECT_NE(found[0].message.find("1000000"), std::string::npos) << shown(found);
}

}  // namespace
}  // namespace lantern::run
