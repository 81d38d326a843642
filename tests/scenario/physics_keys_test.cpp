// What the physics keys become, and what is known to go wrong with them before anything runs.
#include <numbers>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "geometry/vec.hpp"
#include "language/language.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

const std::string kFlat = "title = \"x\"\n[world]\nsize = [64, 64]\n";
const std::string kDeep = "title = \"x\"\n[world]\nsize = [64, 32, 16]\n";

std::string body_text(const std::string& keys, bool deep = false) {
  return "[[body]]\nname = \"a\"\nposition = " + std::string(deep ? "[1, 2, 3]" : "[1, 2]") + "\n" +
         keys;
}

BodySpec flat_body(const std::string& keys) {
  return good(kFlat + body_text(keys) + kShow).bodies.at(0);
}
BodySpec deep_body(const std::string& keys) {
  return good(kDeep + body_text(keys, true) + kShow).bodies.at(0);
}

// --- dimensions ---

TEST(Dimension, IsThatOfTheWorldsExtent) {
  EXPECT_EQ(good(kFlat + kShow).world.dimension, 2);
  const Scenario deep = good(kDeep + kShow);
  EXPECT_EQ(deep.world.dimension, 3);
  EXPECT_EQ(deep.world.bounds, (Box<3>{{0, 0, 0}, {64, 32, 16}}));
  const Scenario s = good("title = \"x\"\n[world]\nmin = [-1, -2, -3]\nmax = [1, 2, 3]\n" + kShow);
  EXPECT_EQ(s.world.bounds, (Box<3>{{-1, -2, -3}, {1, 2, 3}}));
}

TEST(Dimension, IsThatOfAllPoints) {
  expect_mistakes(kFlat + "[[body]]\nname = \"a\"\nradius = 1\nposition = @[1, 2, 3]\n" + kShow,
                  {"this world is 2D: write [x, y]"});
  expect_mistakes(kDeep + "[[body]]\nname = \"a\"\nradius = 1\nposition = @[1, 2]\n" + kShow,
                  {"this world is 3D: write [x, y, z]"});
  expect_mistakes(
      "title = \"x\"\n[world]\nmin = [0, 0]\nmax = @[1, 1, 1]\ngravity = @[0, 0, -9]\n" + kShow,
      {"this world is 2D", "this world is 2D"});
  expect_mistakes(kDeep +
                      "[structure]\nkind = \"bsp\"\nplanes = [{ point = @[1, 2], normal = "
                      "[0, 1, 0] }]\n" +
                      body_text("radius = 1\n", true) + kShow,
                  {"three numbers, not 2"});
  expect_mistakes(kDeep + body_text("radius = 1\n", true) +
                      "[[step]]\ndo = \"show\"\nexpect = { position = { a = @[1, 2] } }\n",
                  {"this world is 3D"});
}

TEST(Dimension, ThatCannotBeToldBringsAboutNoOtherMistake) {
  expect_mistakes("title = \"x\"\n[world]\nsize = @[1]\n" + body_text("radius = 1\n", true) +
                      body_text("radius = 1\n").replace(16, 3, "\"b\"") + kShow,
                  {"two or three numbers"});
}

TEST(Dimension, OfASolidWorldReachesMinToo) {
  expect_mistakes("title = \"x\"\n[world]\nmin = [0, 0, 0]\nmax = @[1, 1, 0]\n" + kShow,
                  {"at least"});
}

// --- the world ---

TEST(World, RulesAreRead) {
  const Scenario rules = good(
      "title = \"x\"\n[world]\nsize = [1, 1]\ngravity = [0, -9.81]\ncontacts = \"soft\"\n"
      "integrator = \"implicit_midpoint\"\nsub_steps = 4\niterations = 20\nimpact_budget = "
      "30\nmay_sleep = true\n"
      "frame_every = 5\nshow_boxes = true\nshow_velocities = true\n" +
      kShow);
  const WorldSpec& w = rules.world;
  EXPECT_EQ(w.gravity, Vec<3>(0, -9.81, 0));
  EXPECT_EQ(w.contacts, ContactMethod::soft);
  EXPECT_EQ(w.integrator, Integrator::implicit_midpoint);
  EXPECT_EQ(w.sub_steps, 4);
  EXPECT_EQ(w.iterations, 20);
  EXPECT_EQ(w.impact_budget, 30);
  EXPECT_EQ(w.frame_every, 5);
  EXPECT_TRUE(w.may_sleep && rules.display.boxes && rules.display.arrows);
  const Scenario without = good(kFlat + kShow);
  const WorldSpec& plain = without.world;
  EXPECT_EQ(without.display, Display());
  EXPECT_EQ(plain.contacts, ContactMethod::none) << "bodies fly freely unless told otherwise";
  EXPECT_EQ(plain.integrator, Integrator::semi_implicit_euler);
  EXPECT_EQ(plain.sub_steps, 8);
  EXPECT_EQ(plain.iterations, 10);
  EXPECT_EQ(plain.impact_budget, 10'000);
  EXPECT_EQ(plain.frame_every, 1);
  EXPECT_FALSE(plain.may_sleep || plain.has_camera);
}

TEST(World, IntegratorsKeepTheirNames) {
  const std::vector<std::string> names = {
      "explicit_euler",    "semi_implicit_euler", "velocity_verlet", "runge_kutta_4",
      "implicit_midpoint", "implicit_euler",      "kahan_li_8",      "dormand_prince"};
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(good(kFlat + "integrator = \"" + names[i] + "\"\n" + kShow).world.integrator,
              static_cast<Integrator>(i))
        << names[i];
}

TEST(World, ACameraIsOfASolidOneAndWhole) {
  const WorldSpec w =
      good(kDeep + "camera_eye = [0, 5, 20]\ncamera_target = [0, 0, 0]\n" + kShow).world;
  EXPECT_TRUE(w.has_camera);
  EXPECT_EQ(w.camera_eye, Vec<3>(0, 5, 20));
  expect_mistakes(kFlat + "@camera_eye = [0, 5]\n" + kShow, {"a 2D world has no camera"});
  expect_mistakes(kFlat + "camera_eye = @[0, 5, 9]\n" + kShow, {"a 2D world has no camera"});
  expect_mistakes(kDeep + "@camera_eye = [0, 5, 1]\n" + kShow, {"no 'camera_target'"});
  expect_mistakes(kDeep + "@camera_target = [0, 5, 1]\n" + kShow, {"no 'camera_eye'"});
  expect_mistakes(kDeep + "camera_eye = [0, 5, 1]\ncamera_target = @[0, 5, 1]\n" + kShow,
                  {"looks at itself"});
}

TEST(World, LandIsOfAFlatOneAndOfFewCorners) {
  const std::string land = "land = [[[0, 0], [8, 0], [8, 6]]]\n";
  EXPECT_EQ(good(kFlat + land + kShow).world.land.at(0).size(), 3u);
  expect_mistakes(kDeep + "@" + land + kShow, {"a 3D world has no land"});
  std::string corners;
  for (int i = 0; i < 2001; ++i) corners += "[" + std::to_string(i) + ", 0], ";
  expect_mistakes(kFlat + "land = @[[" + corners + "]]\n" + kShow,
                  {"2001 corners in all, the limit is 2000"});
}

// --- bodies ---

TEST(Bodies, HaveOutlinesThatFillTheirBoxes) {
  const BodySpec body =
      flat_body("radius = 1\noutline = \"M10 20 h8 v4 H10 Z m2 1 Q12 30 14 21 z\"\n");
  ASSERT_TRUE(body.outline);
  ASSERT_EQ(body.outline->size(), 2u);
  EXPECT_EQ(body.outline->at(0).at(0), Vec<2>(-1, -1)) << "as on the page, y down";
  EXPECT_EQ(body.outline->at(0).at(2).x, 1);
  EXPECT_EQ(body.outline->at(1).size(), 13u) << "a curve is twelve lines";
  EXPECT_FALSE(flat_body("radius = 1\n").outline);
}

TEST(Bodies, PaintsTakeColoursThatNobodyHas) {
  const auto body = [](const std::string& name, const std::string& color) {
    return "[[body]]\nradius = 1\nposition = [1, 2]\nname = \"" + name + "\"\n" + color + "\n";
  };
  const Scenario s = good(kFlat + body("a", "paint = \"#0077aa\"") + body("b", "color = 1") +
                          body("c", "paint = \"#07a\"") + body("d", "paint = \"#7a0\"") + kShow);
  EXPECT_EQ(s.bodies[0].color, 2);
  EXPECT_EQ(s.bodies[2].color, 2) << "the same paint";
  EXPECT_EQ(s.bodies[3].color, 3);
  ASSERT_EQ(s.paints.size(), 2u);
  EXPECT_EQ(s.paints[0].rgb, 0x0077aau);
  const auto warned = [&](const std::string& paint) {
    return good(kFlat + body("a", "paint = \"" + paint + "\"") + kShow).noticed;
  };
  ASSERT_GE(warned("#ffff66").size(), 1u);
  EXPECT_NE(warned("#ffff66")[0].message.find("from the ground of the light theme"),
            std::string::npos);
  std::string many;
  for (int i = 1; i <= 8; ++i)
    many += body("n" + std::to_string(i), "color = " + std::to_string(i));
  expect_mistakes(kFlat + many + "@" + body("x", "paint = \"#07a\"") + kShow, {"8 colours"});
}

TEST(Bodies, HaveOneOfTheShapes) {
  EXPECT_EQ(std::get<Sphere>(flat_body("radius = 2\n").shape).radius, 2);
  EXPECT_EQ(std::get<AxisBox<3>>(deep_body("half_size = [1, 2, 3]\n").shape).half_size,
            Vec<3>(1, 2, 3));
  const auto capsule = std::get<Capsule>(flat_body("capsule = [0.5, 2]\n").shape);
  EXPECT_EQ(capsule.radius, 0.5);
  EXPECT_EQ(capsule.half_length, 2);
  const BodySpec ground = flat_body("ground = [3, 4]\n");
  EXPECT_NEAR(glm::distance(std::get<HalfSpace<3>>(ground.shape).normal, Vec<3>(0.6, 0.8, 0)), 0,
              1e-15)
      << "of unit length";
  EXPECT_EQ(ground.kind, BodyKind::static_body);
  EXPECT_EQ(ground.look, Look::box);
  EXPECT_EQ(std::get<HalfSpace<3>>(flat_body("ground = [1e-300, 0]\n").shape).normal,
            Vec<3>(1, 0, 0))
      << "a tiny direction is one";
  expect_mistakes(kFlat + body_text("radius = 1\n@capsule = [1, 1]\n") + kShow,
                  {"one of them is enough"});
  expect_mistakes(kFlat + body_text("ground = [0, 1]\nvelocity = @[1, 0]\n") + kShow,
                  {"a static body has no velocity"});
  expect_mistakes(kFlat + body_text("ground = [0, 1]\nkind = @\"dynamic\"\n") + kShow,
                  {"the ground never moves"});
  expect_mistakes(kFlat + body_text("ground = [0, 1]\n@turned = 5\n") + kShow,
                  {"'ground' says where its face looks"});
}

TEST(Bodies, ABoxTurnsIfItIsOriented) {
  const auto is_oriented = [](const BodySpec& b) {
    return std::holds_alternative<OrientedBox<3>>(b.shape);
  };
  EXPECT_FALSE(is_oriented(flat_body("half_size = [1, 2]\n")));
  EXPECT_TRUE(is_oriented(flat_body("half_size = [1, 2]\noriented = true\n")));
  const BodySpec turned = flat_body("half_size = [1, 2]\nturned = 90\n");
  EXPECT_TRUE(is_oriented(turned)) << "turned implies it";
  EXPECT_DOUBLE_EQ(turned.angle, 90 * kDegree);
  const BodySpec spinning = flat_body("half_size = [1, 2]\nspin = -45\n");
  EXPECT_TRUE(is_oriented(spinning)) << "and so does spin";
  EXPECT_DOUBLE_EQ(spinning.spin, -45 * kDegree);
  expect_mistakes(kFlat + body_text("half_size = [1, 2]\nturned = 9\noriented = @false\n") + kShow,
                  {"keeps to the axes does not turn"});
  expect_mistakes(kFlat + body_text("radius = 1\n@oriented = true\n") + kShow, {"only a box"});
  expect_mistakes(kFlat + body_text("half_size = [1, 2]\n@may_turn = true\n") + kShow,
                  {"write oriented = true"});
}

TEST(Bodies, TurnAboutTheirAxis) {
  EXPECT_EQ(flat_body("radius = 1\nturned = 5\n").axis, Vec<3>(0, 0, 1)) << "towards the viewer";
  EXPECT_EQ(deep_body("radius = 1\n").axis, Vec<3>(0, 1, 0)) << "upright";
  EXPECT_EQ(deep_body("radius = 1\naxis = [0, 0, -5]\n").axis, Vec<3>(0, 0, -1));
  expect_mistakes(kDeep + body_text("radius = 1\naxis = @[0, 0, 0]\n", true) + kShow,
                  {"points nowhere"});
  expect_mistakes(kFlat + body_text("radius = 1\n@axis = [0, 1]\n") + kShow, {"no other axis"});
}

TEST(Bodies, AreDynamicKinematicOrStatic) {
  EXPECT_EQ(flat_body("radius = 1\n").kind, BodyKind::dynamic_body);
  EXPECT_EQ(flat_body("radius = 1\nkind = \"kinematic\"\nvelocity = [1, 0]\n").kind,
            BodyKind::kinematic_body);
  EXPECT_EQ(flat_body("radius = 1\nkind = \"static\"\n").kind, BodyKind::static_body);
  EXPECT_EQ(flat_body("radius = 1\nstatic = true\n").kind, BodyKind::static_body);
  EXPECT_EQ(flat_body("radius = 1\nstatic = true\nkind = \"static\"\n").kind,
            BodyKind::static_body);
  expect_mistakes(kFlat + body_text("radius = 1\nstatic = true\nkind = @\"dynamic\"\n") + kShow,
                  {"contradicts static = true"});
  expect_mistakes(kFlat + body_text("radius = 1\nstatic = false\nkind = @\"static\"\n") + kShow,
                  {"contradicts static = false"});
  expect_mistakes(kFlat + body_text("radius = 1\nstatic = true\nspin = @9\n") + kShow,
                  {"a static body has no spin"});
  expect_mistakes(kFlat + body_text("radius = @0\nspin = 9\n") + kShow, {"needs a size"});
}

TEST(Bodies, AreMadeOfSomething) {
  const BodySpec b = flat_body(
      "radius = 1\nmass = 3\nrestitution = 0.5\nfriction = 0\ndrag = 2\nangular_drag = 4\n"
      "may_turn = false\n");
  EXPECT_EQ(b.mass, 3);
  EXPECT_EQ(b.material.restitution, 0.5);
  EXPECT_EQ(b.material.friction, 0);
  EXPECT_EQ(b.linear_drag, 2);
  EXPECT_EQ(b.angular_drag, 4);
  EXPECT_FALSE(b.may_turn);
  const BodySpec plain = flat_body("radius = 1\n");
  EXPECT_EQ(plain.density, 1);
  EXPECT_EQ(plain.mass, 0) << "from shape and density";
  EXPECT_EQ(plain.material.friction, 0.5);
  EXPECT_TRUE(plain.may_turn);
  expect_mistakes(kFlat + body_text("radius = 1\ndensity = 2\n@mass = 3\n") + kShow,
                  {"one of them is enough"});
  expect_mistakes(kFlat + body_text("radius = 1\n@asleep = true\n") + kShow, {"may_sleep = true"});
  expect_mistakes(kFlat + "may_sleep = true\n" +
                      body_text("radius = 1\nstatic = true\n@asleep = true\n") + kShow,
                  {"only a dynamic body sleeps"});
  EXPECT_TRUE(good(kFlat + "may_sleep = true\n" + body_text("radius = 1\nasleep = true\n") + kShow)
                  .bodies[0]
                  .asleep);
}

TEST(Bodies, FollowAnotherThatMayBeDeclaredLater) {
  const std::string ball = "[[body]]\nname = \"ball\"\nradius = 1\nposition = [5, 5]\n";
  const std::string bat = "half_size = [1, 1]\nkind = \"kinematic\"\nspeed = 3\nfollow = ";
  const Scenario s =
      good(kFlat + body_text(bat + "\"ball\"\nfollow_axes = [0, 1]\n") + ball + kShow);
  EXPECT_EQ(s.bodies[0].brain, Brain::follow);
  EXPECT_EQ(s.bodies[0].follows, 1u);
  EXPECT_EQ(s.bodies[0].brain_axes, Vec<3>(0, 1, 0));
  EXPECT_EQ(s.bodies[0].brain_speed, 3);
  EXPECT_EQ(s.bodies[0].velocity, Vec<3>(0.0));
  EXPECT_EQ(good(kFlat + body_text(bat + "\"ball\"\n") + ball + kShow).bodies[0].brain_axes,
            Vec<3>(1.0));
  expect_mistakes(kFlat + body_text(bat + "@\"bal\"\n") + ball + kShow, {"did you mean 'ball'?"});
  expect_mistakes(kFlat + body_text(bat + "@\"a\"\n") + ball + kShow, {"cannot follow itself"});
  expect_mistakes(kFlat + body_text(bat + "@\"dot\"\n") +
                      "[[pattern]]\nname = \"dot\"\ncount = 2\nradius = 1\n" + kShow,
                  {"'dot1' to 'dot2'"});
  expect_mistakes(kFlat + body_text(bat + "\"ball\"\nfollow_axes = @[0.5, 1]\n") + ball + kShow,
                  {"it takes 0 or 1"});
  expect_mistakes(kFlat + body_text("radius = 1\nspeed = 3\n@follow = \"ball\"\n") + ball + kShow,
                  {"kind = \"kinematic\""});
  expect_mistakes(
      kFlat + body_text("radius = 1\nkind = \"kinematic\"\n@follow = \"ball\"\n") + ball + kShow,
      {"needs a 'speed'"});
  expect_mistakes(kFlat + body_text("radius = 1\n@follow_axes = [1, 1]\n") + kShow,
                  {"without 'follow'"});
  expect_mistakes(kFlat + body_text("radius = 1\n@speed = 1\n") + kShow, {"velocity"});
}

TEST(Bodies, Wander) {
  const BodySpec b = flat_body("radius = 1\nwander = true\nspeed = 3\n");
  EXPECT_EQ(b.brain, Brain::wander);
  EXPECT_EQ(b.brain_speed, 3);
  expect_mistakes(kFlat + body_text("radius = 1\n@wander = true\n") + kShow, {"needs a 'speed'"});
  expect_mistakes(
      kFlat + body_text("radius = 1\nstatic = true\n@wander = true\nspeed = 1\n") + kShow,
      {"a static body does not wander"});
  expect_mistakes(
      kFlat +
          body_text(
              "radius = 1\nkind = \"kinematic\"\nspeed = 1\nfollow = \"b\"\n@wander = true\n") +
          "[[body]]\nname = \"b\"\nradius = 1\nposition = [5, 5]\n" + kShow,
      {"either follows or wanders"});
}

// --- patterns ---

std::vector<BodySpec> pattern(const std::string& world, const std::string& keys) {
  return good(world + "[[pattern]]\nname = \"p\"\n" + keys + kShow).bodies;
}

TEST(PatternsOf, AStackTouch) {
  const auto stack =
      pattern(kFlat, "count = 4\nhalf_size = [2, 0.5]\narrange = \"stack\"\nmin = [10, 1]\n");
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(stack[i].position, Vec<3>(10, 1 + static_cast<double>(i), 0)) << i;
  EXPECT_EQ(pattern(kFlat, "count = 2\nradius = 1\narrange = \"stack\"\n")[1].position,
            Vec<3>(32, 3, 0))
      << "in the middle, on the floor";
  EXPECT_EQ(pattern(kDeep, "count = 2\nradius = 1\narrange = \"stack\"\n")[1].position,
            Vec<3>(32, 3, 8));
  const auto turned = pattern(
      kFlat, "count = 2\nhalf_size = [2, 1]\nturned = 90\narrange = \"stack\"\nmin = [9, 2]\n");
  EXPECT_NEAR(turned[1].position.y, 6, 1e-12) << "as high as they are, turned";
}

TEST(PatternsOf, AStackIsAsHighAsItIs) {
  const std::string stack =
      kFlat + "[[pattern]]\nname = \"p\"\ncount = 2\nradius = 1\narrange = \"stack\"\n";
  good(stack + "min = [10, 99]\n" + kShow);
  expect_mistakes(stack + "@max = [10, 9]\n" + kShow, {"a stack has no 'max'"});
}

TEST(PatternsOf, ALineReachItsEnds) {
  const auto line = pattern(
      kDeep, "count = 3\nradius = 1\narrange = \"line\"\nmin = [1, 2, 3]\nmax = [5, 2, 7]\n");
  EXPECT_EQ(line[0].position, Vec<3>(1, 2, 3));
  EXPECT_EQ(line[1].position, Vec<3>(3, 2, 5));
  EXPECT_EQ(line[2].position, Vec<3>(5, 2, 7));
  EXPECT_EQ(pattern(kFlat, "count = 1\nradius = 1\narrange = \"line\"\nmin = [1, 2]\n")[0].position,
            Vec<3>(1, 2, 0));
}

TEST(PatternsOf, SolidWorldsFillThem) {
  const auto grid = pattern("title = \"x\"\n[world]\nsize = [8, 8, 8]\n",
                            "count = 8\nradius = 0\narrange = \"grid\"\n");
  EXPECT_EQ(grid[0].position, Vec<3>(2, 2, 2));
  EXPECT_EQ(grid[1].position, Vec<3>(6, 2, 2));
  EXPECT_EQ(grid[2].position, Vec<3>(2, 6, 2));
  EXPECT_EQ(grid[7].position, Vec<3>(6, 6, 6));
  bool deep = false;
  for (const BodySpec& b : pattern(kDeep, "count = 200\nradius = 2\nspeed = 3\n")) {
    EXPECT_TRUE(contains(Box<3>{{2, 2, 2}, {62, 30, 14}}, b.position));
    EXPECT_NEAR(glm::length(b.velocity), 3, 1e-12);
    deep = deep || b.velocity.z != 0;
  }
  EXPECT_TRUE(deep) << "nothing goes along z";
}

TEST(PatternsOf, BodiesWithBrainsHaveThem) {
  const std::string ball = "[[body]]\nname = \"b\"\nradius = 1\nposition = [5, 5]\n";
  const auto all = good(kFlat + ball +
                        "[[pattern]]\nname = \"p\"\ncount = 3\nradius = 1\nkind = \"kinematic\"\n"
                        "follow = \"b\"\nspeed = 2\n" +
                        kShow)
                       .bodies;
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(all[i].follows, 0u);
    EXPECT_EQ(all[i].brain_speed, 2);
    EXPECT_EQ(all[i].velocity, Vec<3>(0.0)) << "it goes after the ball, not at random";
  }
}

// --- springs and joints ---

const std::string kTwo =
    "[[body]]\nname = \"a\"\nradius = 1\nposition = [1, 1]\n"
    "[[body]]\nname = \"b\"\nradius = 1\nposition = [5, 1]\n"
    "[[pattern]]\nname = \"p\"\ncount = 3\nradius = 1\n"
    "[[body]]\nname = \"wall\"\nradius = 1\nposition = [9, 1]\nstatic = true\n";

TEST(Links, TieBodiesAndTheWorld) {
  const auto links =
      good(kFlat + kTwo +
           "[[spring]]\na = \"a\"\nb = \"b\"\nat_a = [0, 1]\nat_b = [1, 0]\nstiffness = 5\n"
           "damping = 2\nrest_length = 3\n[[spring]]\na = \"b\"\nto = [5, 9]\nstiffness = 1\n"
           "[[joint]]\nkind = \"pin\"\na = \"a\"\nb = \"wall\"\n"
           "[[joint]]\nkind = \"distance\"\nalong = \"p\"\nlength = 2\n" +
           kShow)
          .links;
  ASSERT_EQ(links.size(), 5u);
  EXPECT_EQ(links[0].kind, LinkSpec::Kind::spring);
  EXPECT_EQ(links[0].a, 0u);
  EXPECT_EQ(links[0].b, 1u);
  EXPECT_EQ(links[0].at_a, Vec<3>(0, 1, 0));
  EXPECT_EQ(links[0].at_b, Vec<3>(1, 0, 0));
  EXPECT_EQ(links[0].stiffness, 5);
  EXPECT_EQ(links[0].damping, 2);
  EXPECT_EQ(links[0].rest_length, 3);
  EXPECT_FALSE(links[1].b);
  EXPECT_EQ(links[1].at_b, Vec<3>(5, 9, 0)) << "a point of the world";
  EXPECT_FALSE(links[1].rest_length) << "as long as it is";
  EXPECT_EQ(links[2].kind, LinkSpec::Kind::pin);
  EXPECT_EQ(links[3].kind, LinkSpec::Kind::distance);
  const Scenario s = good(kFlat + kTwo + "[[spring]]\nalong = \"p\"\nstiffness = 1\n" + kShow);
  ASSERT_EQ(s.links.size(), 2u);
  EXPECT_EQ(s.bodies[s.links[0].a].name, "p1");
  EXPECT_EQ(s.bodies[*s.links[0].b].name, "p2");
  EXPECT_EQ(s.bodies[*s.links[1].b].name, "p3");
}

TEST(Links, HaveTwoEnds) {
  const std::string spring = kFlat + kTwo + "[[spring]]\nstiffness = 1\n";
  expect_mistakes(kFlat + kTwo + "@[[spring]]\nstiffness = 1\na = \"a\"\n" + kShow,
                  {"give one of 'b', a body, and 'to'"});
  expect_mistakes(kFlat + kTwo + "@[[spring]]\nstiffness = 1\n" + kShow, {"no 'a' or 'along'"});
  expect_mistakes(spring + "a = \"a\"\nb = \"b\"\n@to = [1, 1]\n" + kShow, {"not at both"});
  expect_mistakes(spring + "a = \"a\"\nb = @\"a\"\n" + kShow, {"tied to itself"});
  expect_mistakes(spring + "a = \"a\"\nb = @\"p\"\n" + kShow, {"'p1' to 'p3'"});
  expect_mistakes(spring + "a = @\"wall\"\nto = [1, 1]\n" + kShow, {"nothing that it could move"});
  expect_mistakes(spring + "a = \"a\"\nto = [1, 1]\n@at_b = [1, 1]\n" + kShow,
                  {"'at_b' is of 'b'"});
  expect_mistakes(spring + "along = @\"a\"\n" + kShow, {"a pattern of at least two"});
  expect_mistakes(spring + "along = \"p\"\n@b = \"a\"\n" + kShow, {"not with 'along'"});
  expect_mistakes(spring + "a = \"a\"\n@along = \"p\"\n" + kShow, {"one of them is enough"});
}

TEST(Links, ThatAreTooManyAreRefused) {
  std::string text = kFlat + "[[pattern]]\nname = \"p\"\ncount = 15000\nradius = 1\n";
  text += "[[spring]]\nalong = \"p\"\nstiffness = 1\n@[[spring]]\nalong = \"p\"\nstiffness = 1\n";
  expect_mistakes(text + kShow, {"29998 springs and joints in all, the limit is 20000"});
  expect_mistakes(
      kFlat + kTwo + "[[joint]]\nkind = \"pin\"\na = \"a\"\nb = \"b\"\n@length = 1\n" + kShow,
      {"a pin has no 'length'"});
}

// --- levels and charts ---

TEST(Level, IsRead) {
  const Scenario s = good(kFlat +
                          "[level]\nloops = [[[0, 0], [8, 0], [8, 6]]]\nbalance = 2\ncuts = 3\n"
                          "choose = \"first_wall\"\n[[step]]\ndo = \"compile\"\n[[step]]\ndo = "
                          "\"locate\"\npoint = [1, 2]\n[[step]]\ndo = \"order\"\neye = [3, 4]\n");
  ASSERT_TRUE(s.level);
  EXPECT_EQ(s.level->loops[0][2], Vec<2>(8, 6));
  EXPECT_EQ(s.level->balance, 2);
  EXPECT_EQ(s.level->cuts, 3);
  EXPECT_TRUE(s.level->first_wall);
  EXPECT_TRUE(std::holds_alternative<CompileLevel>(s.steps[0].verb));
  EXPECT_EQ(std::get<Locate>(s.steps[1].verb).point, Vec<2>(1, 2));
  EXPECT_EQ(std::get<OrderFrom>(s.steps[2].verb).eye, Vec<2>(3, 4));
  EXPECT_EQ(s.panels, (std::vector<Panel>{panel_named("world"), panel_named("tree")}));
}

TEST(Level, IsOfAFlatWorldAndCompiledFirst) {
  const std::string level = "[level]\nloops = [[[0, 0], [8, 0], [8, 6]]]\n";
  expect_mistakes(kDeep + "@" + level + kShow, {"a 2D world, this one is 3D"});
  expect_mistakes("title = \"x\"\n@" + level + kShow, {"needs a [world]"});
  expect_mistakes(kFlat + "[[step]]\ndo = @\"compile\"\n", {"needs a [level]"});
  expect_mistakes(kFlat + level + "[[step]]\ndo = @\"locate\"\npoint = [1, 1]\n",
                  {"do = \"compile\" before"});
  expect_mistakes(kFlat + level + "[[step]]\ndo = \"show\"\nexpect = { @sectors = 2 }\n",
                  {"no step has compiled the level yet"});
  std::string loop = "[";
  for (int i = 0; i <= 2000; ++i)
    loop += "[" + std::to_string(i) + ", " + std::to_string(i * i) + "], ";
  expect_mistakes(kFlat + "[level]\nloops = @[" + loop + "]]\n" + kShow,
                  {"2001 walls in all, the limit is 2000"});
}

TEST(Chart, IsOfCountsThatTheStepsCount) {
  const std::string scene =
      kFlat + "[structure]\nkind = \"brute_force\"\n" + body_text("radius = 1\n");
  const Scenario s =
      good(scene + "[chart]\nx = \"bodies\"\ny = [\"pairs\", \"all_pairs\"]\nlogarithmic = true\n" +
           kShow + "plot = \"one\"\n" + kShow);
  ASSERT_TRUE(s.chart);
  EXPECT_EQ(s.chart->x, "bodies");
  EXPECT_EQ(s.chart->y, (std::vector<std::string>{"pairs", "all_pairs"}));
  EXPECT_TRUE(s.chart->logarithmic);
  EXPECT_EQ(s.steps[0].plot, "one");
  EXPECT_FALSE(s.steps[1].plot);
  EXPECT_EQ(s.panels, (std::vector<Panel>{panel_named("world"), panel_named("chart")}));
  const Scenario bars = good(scene + "[chart]\nbars = \"pairs\"\n" + kShow + "plot = \"one\"\n");
  EXPECT_TRUE(bars.chart->x.empty());
  EXPECT_EQ(bars.chart->y, std::vector<std::string>{"pairs"});
  expect_mistakes(scene + "@[chart]\nbars = \"pairs\"\n" + kShow, {"no step adds anything"});
  expect_mistakes(scene + kShow + "@plot = \"a\"\n", {"'plot' needs a [chart]"});
  expect_mistakes(scene + "[chart]\nbars = \"contacts\"\n" + kShow + "@plot = \"a\"\n",
                  {"'contacts' is not counted here: this world has no contacts"});
  expect_mistakes(scene + "[chart]\n@y = [\"pairs\"]\n" + kShow + "plot = \"a\"\n", {"no 'x'"});
}

}  // namespace
}  // namespace lantern::run
