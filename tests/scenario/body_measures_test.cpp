// What is measured of single bodies, charts over time, methods of single bodies, and contacts that
// are solved another way from some step on.
#include <cmath>

#include <gtest/gtest.h>

#include "frame/parts/panels.hpp"
#include "language/method.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

// Two bobs, each on a spring from a point of the world: without gravity all is known.
const std::string kBobs = R"([[body]]
name = "bob"
radius = 0.25
mass = 2
position = [3, 5]
color = 3
[[body]]
name = "ann"
radius = 0.25
mass = 2
position = [3, 2]
integrator = "implicit_midpoint"
color = 6
[[spring]]
a = "bob"
to = [1, 5]
rest_length = 1
stiffness = 50
[[spring]]
a = "ann"
to = [1, 2]
rest_length = 1
stiffness = 50
)";
const std::string kInsertBobs = "[[step]]\ndo = \"insert\"\nbodies = [\"bob\", \"ann\"]\n";
const std::string kHalfSecond = "[[step]]\ndo = \"run\"\nseconds = 0.5\n";
const std::string kBobWorld = "size = [8, 8]\ntime_step = 0.05\n";

TEST(BodyMeasures, AreThoseOfTheBodyAndStandOnEveryFrame) {
  const auto frames = frames_of(good(world_text(
      kBobWorld,
      kBobs + kInsertBobs + kHalfSecond +
          "caption = \"{energy.bob} J\"\n"
          "expect = { at_least = { \"energy.ann\" = 24.999, \"x.bob\" = -9 }, at_most = { "
          "\"energy.ann\" = 25.001, \"speed.bob\" = 99, \"spin.bob\" = 0 } }\n")));
  ASSERT_EQ(frames.size(), 11u);
  for (const Frame& frame : frames) {
    const FrameBody& bob = body(frame, "bob");
    const double stretch = bob.position.x - 1 - 1;
    const double energy = 25 * stretch * stretch + glm::dot(bob.velocity, bob.velocity);
    EXPECT_NEAR(*frame.measure("energy.bob"), energy, 1e-12) << "half a spring, half a motion?";
    EXPECT_EQ(frame.measure("x.bob"), bob.position.x);
    EXPECT_EQ(frame.measure("speed.bob"), glm::length(bob.velocity));
    EXPECT_NEAR(*frame.measure("energy.bob") + *frame.measure("energy.ann"),
                *frame.measure("energy"), 1e-12);
  }
  EXPECT_EQ(frames[0].caption, "");
  EXPECT_NE(frames.back().caption.find(" J"), std::string::npos);
}

TEST(BodyMeasures, PenetrationIsOfTheBodysOwnContacts) {
  const auto frames =
      frames_of(good(world_text("size = [8, 8]\ncontacts = \"soft\"\ngravity = [0, -10]\n",
                                R"([[body]]
name = "floor"
ground = [0, 1]
position = [4, 1]
[[body]]
name = "low"
half_size = [0.5, 0.5]
position = [2, 1.45]
[[body]]
name = "high"
half_size = [0.5, 0.5]
position = [6, 3]
[[step]]
do = "insert"
bodies = ["floor", "low", "high"]
[[step]]
do = "phases"
expect = { at_least = { "penetration.low" = 0.001 }, at_most = { "penetration.high" = 0 } }
)")));
  EXPECT_EQ(frames.back().measure("penetration.low"), frames.back().measure("penetration"));
  EXPECT_EQ(frames.back().measure("penetration.high"), 0);
}

// A net in the middle: the taxi stands on it, the bus and the car to its left and right.
const std::string kTaxis = R"([structure]
kind = "bsp"
planes = [
  { name = "net", point = [4, 0], normal = [1, 0] },
  { name = "deep", point = [6, 0], normal = [1, 0], at = "front" },
]
[[body]]
name = "taxi"
radius = 0.5
position = [4, 2]
[[body]]
name = "bus"
radius = 0.5
position = [1, 2]
[[body]]
name = "car"
radius = 0.5
position = [5, 2]
)";
const std::string kInsertTaxis =
    "[[step]]\ndo = \"insert\"\nbodies = [\"taxi\", \"bus\", \"car\"]\n";

TEST(BodyMeasures, LeavesPairsAndDepthOfOneAreCounted) {
  const auto frames = frames_of(good(world_text(
      "size = [8, 8]",
      kTaxis + kInsertTaxis +
          "headline = [\"leaves.taxi\", \"pairs.bus\"]\n"
          "caption = \"{leaves.taxi:leaf/leaves}, {leaves.bus:leaf/leaves}; {pairs.taxi:pair}, "
          "{pairs.bus:pair}; {depth.taxi}\"\n"
          "expect = { in_leaves = { taxi = 2, bus = 1 }, equal = { \"leaves.taxi\" = 2, "
          "\"pairs.taxi\" = 2, \"pairs.car\" = 1, \"depth.car\" = 2, \"depth.bus\" = 1, "
          "\"x.taxi\" = 4 } }\n"
          "[[step]]\ndo = \"remove\"\nbodies = [\"bus\"]\n"
          "expect = { equal = { \"pairs.taxi\" = 1 } }\n")));
  EXPECT_EQ(frames[0].caption, "2 leaves, 1 leaf; 2 pairs, 1 pair; 2");
  EXPECT_EQ(frames[1].count("leaves.taxi"), 2);
  EXPECT_FALSE(frames[1].count("leaves.bus")) << "it has left";
}

TEST(BodyMeasures, WhatIsCountedNeedsAStructure) {
  const std::string show = kInsertTaxis + "caption = \"@{leaves.taxi}\"\n";
  const std::string bodies = kTaxis.substr(kTaxis.find("[[body]]"));
  expect_mistakes(world_text("size = [8, 8]", bodies + show),
                  {"'leaves.taxi' is not counted here: there is no structure at this step"});
  EXPECT_EQ(frames_of(good(world_text("size = [8, 8]",
                                      bodies + kInsertTaxis +
                                          "[[step]]\ndo = \"rebuild\"\nkind = \"brute_force\"\n"
                                          "caption = \"{leaves.taxi}\"\n")))
                .back()
                .caption,
            "1")
      << "as soon as there is one";
  const auto with = [](const std::string& caption) {
    return world_text("size = [8, 8]", kTaxis + kInsertTaxis + caption);
  };
  expect_mistakes(with("caption = \"@{leafs.taxi}\""), {"did you mean 'leaves'?"});
  expect_mistakes(with("caption = \"@{leaves.taxy}\""), {"did you mean 'taxi'?"});
  expect_mistakes(with("caption = \"@{x.taxi:unit}\""), {"it takes no noun"});
  expect_mistakes(with("expect = { equal = { @\"leaves.taxy\" = 1 } }"), {"did you mean 'taxi'?"});
}

TEST(BodyMeasures, MistakesAreToldByName) {
  const auto with = [](const std::string& promise) {
    return world_text(kBobWorld, kBobs + kInsertBobs + kHalfSecond + "expect = { at_most = { " +
                                     promise + " } }");
  };
  expect_mistakes(with("@\"enrgy.bob\" = 1"), {"there is no measure 'enrgy' of a body"});
  expect_mistakes(with("@\"energy.bib\" = 1"), {"there is no body 'bib'"});
  expect_mistakes(with("@\"penetration.bob\" = 1"), {"this world has no contacts"});
  expect_mistakes(with("@\"own_spin_y.bob\" = 1"), {"this world is 2D"});
  expect_mistakes(
      world_text(kBobWorld, kBobs + kInsertBobs + kHalfSecond + "caption = \"@{energy.bib}\"\n"),
      {"there is no body 'bib'"});
}

TEST(ChartOverTime, AddsAPointOnEveryFrameByItself) {
  const auto frames = frames_of(
      good(world_text(kBobWorld, "[chart]\nx = \"time\"\ny = [\"energy.bob\", \"energy.ann\"]\n" +
                                     kBobs + kInsertBobs + kHalfSecond)));
  const FrameChart& chart = frames.back().get<FrameChart>();
  EXPECT_TRUE(chart.over_time);
  EXPECT_EQ(chart.y_name, "energy") << "the same measure of different bodies";
  EXPECT_EQ(chart.seconds, 0.5) << "the axis must not grow while the lines do";
  ASSERT_EQ(chart.series.size(), 2u);
  EXPECT_EQ(chart.series[0].name, "bob");
  EXPECT_EQ(chart.series[0].color, 3);
  EXPECT_EQ(chart.series[1].color, 6);
  for (const FrameSeries& series : chart.series) {
    ASSERT_EQ(series.points.size(), 11u) << "one a frame, and one at the start";
    for (std::size_t i = 0; i < series.points.size(); ++i)
      EXPECT_NEAR(series.points[i].x, 0.05 * double(i), 1e-12);
  }
  for (std::size_t i = 0; i < frames.size(); ++i)
    EXPECT_EQ(frames[i].get<FrameChart>().series[0].points.size(), i + 1) << "frame " << i;
}

TEST(ChartOverTime, EachPartMayBeginAnew) {
  const std::string chart = "[chart]\nx = \"time\"\ny = [\"energy\"]\neach_part = true\n";
  const std::string longer =
      "[[step]]\ndo = \"run\"\nseconds = 0.75\npart = \"two\"\n[[step]]\ndo = \"show\"\n";
  const auto frames =
      frames_of(good(world_text(kBobWorld, chart + kBobs + kInsertBobs + kHalfSecond + longer)));
  const FrameChart& last = frames.back().get<FrameChart>();
  EXPECT_EQ(last.seconds, 0.75);
  EXPECT_EQ(last.series[0].points.size(), 15u) << "what stands still is said once";
  EXPECT_NEAR(last.series[0].points.front().x, 0.05, 1e-12) << "time is the part's own";
}

TEST(ChartOfBars, HasPiecesThatAddUp) {
  const FrameChart chart = frames_of("buckets").back().get<FrameChart>();
  ASSERT_EQ(chart.bars.size(), 3u);
  for (const FrameBar& bar : chart.bars) {
    ASSERT_EQ(bar.pieces.size(), 2u);
    EXPECT_EQ(bar.pieces[0] + bar.pieces[1], bar.value) << bar.label;
  }
  std::string text = read_text(LANTERN_ROOT "/scenarios/buckets.toml");
  const std::string both = "[\"box_tests\", \"pair_tests\"]";
  text.replace(text.find(both), both.size(), "[\"box_tests\", \"pairs\"]");
  EXPECT_THROW(frames_of(good(text)), ScenarioError) << "a pair met twice is missing";
}

TEST(ChartOfBars, BeginsAnewWithEachPart) {
  const auto frames = frames_of("coincident_max_depth");
  const auto chart = [&](const char* event) { return at(frames, event).get<FrameChart>(); };
  EXPECT_EQ(chart("limit_8").bars.size(), 3u);
  EXPECT_EQ(chart("limit_8").part, 0);
  EXPECT_EQ(chart("before").bars.size(), 1u);
  EXPECT_EQ(chart("before").part, 1);
}

TEST(ChartOverTime, NeedsNoPlotAndTakesNone) {
  const std::string chart = "[chart]\nx = \"time\"\ny = [\"energy\"]\n";
  expect_mistakes(
      world_text(kBobWorld, chart + kBobs + kInsertBobs + kHalfSecond + "@plot = \"here\"\n"),
      {"over time every frame is plotted by itself"});
  expect_mistakes(
      world_text(kBobWorld, "[chart]\nx = \"bodies\"\ny = [\"bodies\"]\n@each_part = true\n" +
                                kBobs + kInsertBobs + "plot = \"a\"\n"),
      {"'each_part' is of bars, or of a chart over time"});
  expect_mistakes(
      world_text(kBobWorld, chart + "least = 3\nmost = @3\n" + kBobs + kInsertBobs + kHalfSecond),
      {"'most' must be above 'least'"});
  expect_mistakes(world_text(kBobWorld, chart + "logarithmic = true\nleast = @0\n" + kBobs +
                                            kInsertBobs + kHalfSecond),
                  {"a logarithmic axis begins above 0"});
  expect_mistakes(world_text(kBobWorld, "[chart]\nx = \"time\"\ny = [@\"enrgy\"]\n" + kBobs +
                                            kInsertBobs + kHalfSecond),
                  {"there is no count 'enrgy'"});
}

TEST(BodyMethods, AreReadAndHoldForTheBodyAlone) {
  const Scenario s =
      good(world_text(kBobWorld + "integrator = \"runge_kutta_4\"\nrotation = \"splitting_4\"\n",
                      kBobs + kInsertBobs));
  EXPECT_EQ(s.world.rotation, RotationMethod::splitting_4);
  EXPECT_EQ(s.bodies[0].integrator, std::nullopt);
  EXPECT_EQ(s.bodies[1].integrator, Integrator::implicit_midpoint);
}

TEST(BodyMethods, OfWhatNoForceMovesAreMistakes) {
  expect_mistakes(world_text(kBobWorld,
                             "[[body]]\nname = \"a\"\nradius = 1\nposition = [1, 1]\nstatic = "
                             "true\n@rotation = \"splitting_4\"\n[[step]]\ndo = \"show\"\n"),
                  {"no force moves or turns this body"});
}

TEST(BodyMethods, OneSpringTakesOneMethod) {
  expect_mistakes(
      world_text(kBobWorld,
                 kBobs + "[[spring]]\na = \"bob\"\nb = @\"ann\"\nstiffness = 1\n" + kInsertBobs),
      {"'bob', moved by semi_implicit_euler, and 'ann', moved by implicit_midpoint"});
}

// A ball on a spring beside another one, by a method that knows forces of places alone.
std::string of_places(const std::string& world, const std::string& ball, const std::string& tie) {
  return world_text("size = [8, 8]\n" + world,
                    "[[body]]\nname = \"a\"\nradius = 0.1\nposition = [1, 1]\n" + ball +
                        "[[body]]\nname = \"b\"\nradius = 0.1\nposition = [3, 1]\n" + tie +
                        "[[step]]\ndo = \"show\"\n");
}

TEST(BodyMethods, OfPlacesAloneKnowNoOtherForces) {
  for (const std::string name : {"kahan_li_8", "dormand_prince"}) {
    const std::string by = "integrator = \"" + name + "\"\n", no = "'" + name + "' knows no ";
    const std::string spring = "[[spring]]\na = \"a\"\nb = \"b\"\nstiffness = 1\n";
    good(of_places(by + "gravity = [0, -10]\ngravitation = 1\n", "", spring));
    expect_mistakes(of_places("contacts = \"soft\"\nintegrator = @\"" + name + "\"\n", "", ""),
                    {no + "contacts"});
    expect_mistakes(of_places("contacts = \"soft\"\n", "integrator = @\"" + name + "\"\n", ""),
                    {no + "contacts"});
    expect_mistakes(of_places(by, "drag = @1\n", ""), {no + "drag"});
    expect_mistakes(of_places(by, "angular_drag = @1\n", ""), {no + "drag"});
    expect_mistakes(of_places("", by + "drag = @1\n", ""), {no + "drag"});
    expect_mistakes(of_places(by, "", spring + "damping = @0.1\n"), {no + "damping"});
    const std::string pin = "[[joint]]\nkind = @\"pin\"\na = \"a\"\nb = \"b\"\n";
    expect_mistakes(of_places(by, "", pin), {no + "joints"});
    expect_mistakes(of_places("", by, pin), {no + "joints"});
    good(of_places(by, "integrator = \"velocity_verlet\"\ndrag = 1\n", ""));
  }
}

TEST(BodyMethods, AMethodThatIsMeasuredHoldsForAllBodies) {
  Scenario s = good(world_text(kBobWorld, kBobs + kInsertBobs));
  s = moved_by(s, *method_named("velocity_verlet"), 0.01);
  EXPECT_EQ(s.world.integrator, Integrator::velocity_verlet);
  EXPECT_EQ(s.bodies[1].integrator, std::nullopt) << "it would be moved by its own";
  s = moved_by(s, *method_named("explicit_gyroscopic"), 0.01);
  EXPECT_EQ(s.world.rotation, RotationMethod::explicit_gyroscopic);
}

const std::string kPile = R"([[body]]
name = "floor"
ground = [0, 1]
position = [4, 1]
[[pattern]]
name = "box"
count = 3
arrange = "stack"
half_size = [0.5, 0.5]
oriented = true
min = [4, 1.5]
[[step]]
do = "insert"
bodies = ["floor", "box"]
[[step]]
do = "run"
seconds = 0.5
)";

TEST(SolveBy, TheWorldGoesOnWithTheOtherMethod) {
  const std::string world = "size = [8, 8]\ncontacts = \"impulse\"\ngravity = [0, -10]\n";
  const std::string soft =
      "[[step]]\ndo = \"solve_by\"\ncontacts = \"soft\"\nsub_steps = 4\n" + kHalfSecond;
  const auto frames = frames_of(good(world_text(world, kPile + soft)));
  const auto without = frames_of(good(world_text(world, kPile + kHalfSecond)));
  EXPECT_NE(motion_hash(frames.back()), motion_hash(without.back())) << "nothing was switched";
  EXPECT_NEAR(body(frames.back(), "box3").position.y, 3.5, 0.01);
  const Scenario measured =
      moved_by(good(world_text(world, kPile + soft)), *method_named("impulse:10"), 1.0 / 60);
  EXPECT_TRUE(std::holds_alternative<Show>(measured.steps[2].verb))
      << "a method that is measured holds throughout";
}

TEST(SolveBy, NeedsAWorldWithContacts) {
  expect_mistakes(world_text(kBobWorld, kBobs + kInsertBobs +
                                            "[[step]]\ndo = @\"solve_by\"\ncontacts = \"soft\"\n"),
                  {"in this world nothing touches"});
}

}  // namespace
}  // namespace lantern::run
