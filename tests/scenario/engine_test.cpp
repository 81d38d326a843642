// The engine of a scenario: structures may change, bodies do not notice; what is not needed is not
// there.
#include "run/engine.hpp"

#include <set>

#include <gtest/gtest.h>

#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

// A heap of bodies falls onto a floor, between two walls.
std::string heap(bool solid, const std::string& contacts, const std::string& body_keys = "") {
  const auto point = [&](const std::string& xy, const std::string& z) {
    return "[" + xy + (solid ? ", " + z : "") + "]\n";
  };
  const std::string floor = "[[body]]\nname = \"floor\"\nstatic = true\n" + body_keys;
  const std::string loose =
      "count = 7\n" + body_keys + "min = " + point("3, 3", "3") + "max = " + point("13, 12", "13");
  return world_text("size = " + point("16, 16", "16") + "gravity = " + point("0, -10", "0") +
                        "contacts = \"" + contacts + "\"\ntime_step = 0.015625\n",
                    "[structure]\nkind = \"brute_force\"\n" + floor +
                        "half_size = " + point("8, 1", "8") + "position = " + point("8, 1", "8") +
                        "[[pattern]]\nname = \"ball\"\nradius = 0.7\n" + loose +
                        "[[pattern]]\nname = \"box\"\noriented = true\nhalf_size = " +
                        point("0.8, 0.6", "0.7") + loose);
}

const std::string kInsertHeap = "do = \"insert\"\nbodies = [\"floor\", \"ball\", \"box\"]";
const std::string kQuarterSecond = "do = \"run\"\nseconds = 0.25\nevery = 4";

std::vector<std::uint64_t> motions(const std::string& text) {
  std::vector<std::uint64_t> hashes;
  for (const Frame& frame : frames_of(good(text)))
    if (frame.event == "run") hashes.push_back(motion_hash(frame));
  return hashes;
}

// Each of `rebuilds` before a quarter of a second.
std::string changing(const std::string& scene, const std::vector<std::string>& rebuilds) {
  std::vector<std::string> script{kInsertHeap};
  for (const std::string& keys : rebuilds) {
    script.push_back(keys.empty() ? "do = \"show\"" : "do = \"rebuild\"\n" + keys);
    script.push_back(kQuarterSecond);
  }
  return scene + steps(script);
}

TEST(Engine, AnotherStructureChangesNoBitOfTheMotion) {
  for (const std::string contacts : {"none", "impulse", "soft"})
    for (const bool solid : {false, true}) {
      SCOPED_TRACE(contacts + (solid ? ", solid" : ", flat"));
      const std::vector<std::string> rebuilds = {
          "kind = \"sort_and_sweep\"",
          "kind = \"quadtree\"\ncapacity = 2",
          solid ? "kind = \"octree\"\nsplit_static = true" : "kind = \"quadtree\"\nmax_depth = 2",
          "kind = \"bsp\"\nplanes = [{ point = " +
              std::string(solid ? "[8, 0, 0], normal = [1, 0, 0] }]"
                                : "[8, 0], normal = [1, 0] }]"),
          "kind = \"kd_tree\"\ncapacity = 2",
          "kind = \"grid\"\ncell = 2",
          "kind = \"grid\"\nopen = true\nlevels = 3",
          "kind = \"none\""};
      const std::string scene = heap(solid, contacts);
      const auto plain = motions(changing(scene, std::vector<std::string>(rebuilds.size())));
      EXPECT_EQ(plain.size(), 4 * rebuilds.size());
      EXPECT_EQ(motions(changing(scene, rebuilds)), plain);
      EXPECT_NE(plain.front(), plain.back()) << "nothing moves: the test says nothing";
    }
}

// Discs that fall side by side and never meet.
std::string rain(const std::string& world_keys, const std::string& body_keys) {
  return world_text("size = [32, 64]\ngravity = [0, -10]\ntime_step = 0.015625\n" + world_keys,
                    "[structure]\nkind = \"quadtree\"\n[[pattern]]\nname = \"drop\"\n"
                    "arrange = \"grid\"\ncount = 12\nradius = 0.5\ndrag = 0.1\n"
                    "min = [2, 40]\nmax = [30, 60]\n" +
                        body_keys) +
         steps({"do = \"insert\"\nbodies = [\"drop\"]", kQuarterSecond, kQuarterSecond});
}

// What a scene does not need may be there or not: no bit of the motion tells.
TEST(Engine, AStageThatIsNotNeededChangesNoBit) {
  const auto plain = motions(rain("contacts = \"none\"\n", ""));
  ASSERT_EQ(plain.size(), 8u);
  EXPECT_NE(plain.front(), plain.back()) << "nothing moves: the test says nothing";
  EXPECT_EQ(motions(rain("contacts = \"impulse\"\n", "")), plain) << "an idle narrow phase";
  EXPECT_EQ(motions(rain("contacts = \"soft\"\n", "")), plain) << "an idle soft solver";
  EXPECT_EQ(motions(rain("contacts = \"soft\"\nsub_steps = 32\n", "")), plain) << "sub-steps";
  EXPECT_EQ(motions(rain("contacts = \"soft\"\nmay_sleep = true\n", "")), plain) << "sleep";
  EXPECT_EQ(motions(rain("contacts = \"soft\"\n", "friction = 0\n")), plain) << "friction";
  EXPECT_EQ(motions(rain("contacts = \"soft\"\n", "may_turn = false\n")), plain) << "rotation";
}

TEST(Engine, TheSameScenarioRunsTheSame) {
  const std::string text = changing(heap(true, "soft"), {"kind = \"octree\"", ""});
  const auto first = frames_of(good(text)), second = frames_of(good(text));
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_EQ(to_json(first[i]), to_json(second[i])) << "frame " << i;
}

// --- what a scene does not need is not there ---

TEST(EngineLeavesOut, RotationsWhereNothingMayTurn) {
  const std::string script = steps({kInsertHeap, kQuarterSecond});
  bool turned = false;
  for (const Frame& frame : frames_of(good(heap(false, "impulse") + script)))
    turned = turned || frame.count("rotations").value_or(0) > 0;
  EXPECT_TRUE(turned) << "a heap that tumbles must turn";
  for (const Frame& frame :
       frames_of(good(heap(false, "impulse", "may_turn = false\n") + script))) {
    EXPECT_EQ(frame.count("rotations"), 0);
    for (const FrameBody& b : frame.bodies) EXPECT_EQ(b.angle, 0) << b.name;
  }
}

TEST(EngineLeavesOut, FrictionWhereNothingIsRough) {
  const std::string script =
      steps({kInsertHeap, kQuarterSecond, kQuarterSecond, kQuarterSecond, kQuarterSecond});
  for (const std::string contacts : {"impulse", "soft"}) {
    std::int64_t rough = 0, rows = 0;
    for (const Frame& frame : frames_of(good(heap(false, contacts) + script)))
      rough += *frame.count("friction_rows");
    for (const Frame& frame : frames_of(good(heap(false, contacts, "friction = 0\n") + script))) {
      EXPECT_EQ(frame.count("friction_rows"), 0) << contacts;
      rows += *frame.count("constraint_rows");
    }
    EXPECT_GT(rough, 0) << contacts;
    EXPECT_GT(rows, 0) << contacts << ": they touch all the same";
  }
}

TEST(EngineLeavesOut, ContactsWhereBodiesPassThroughEachOther) {
  for (const Frame& frame :
       frames_of(good(heap(false, "none") + steps({kInsertHeap, kQuarterSecond})))) {
    EXPECT_TRUE(frame.contacts.empty());
    EXPECT_FALSE(frame.count("narrow_tests").has_value());
    EXPECT_FALSE(frame.count("constraint_rows").has_value());
    EXPECT_FALSE(frame.measure("penetration").has_value());
  }
}

TEST(EngineLeavesOut, PhysicsInFreeFlight) {
  const auto frames =
      frames_of(good(world_text("size = [16, 16]",
                                "[[body]]\nname = \"a\"\nradius = 1\nposition = [2, 2]\n"
                                "velocity = [1, 0]\n" +
                                    steps({"do = \"insert\"\nbodies = [\"a\"]", kQuarterSecond}))));
  for (const Frame& frame : frames) {
    EXPECT_TRUE(frame.measures.empty());
    EXPECT_FALSE(frame.count("force_evaluations").has_value());
    EXPECT_FALSE(frame.count("awake").has_value());
  }
}

TEST(EngineLeavesOut, WorkOfBodiesThatSleep) {
  const auto frames = frames_of(good(world_text(
      "size = [16, 16]\ngravity = [0, -10]\ncontacts = \"impulse\"\nmay_sleep = true",
      "[[body]]\nname = \"floor\"\nstatic = true\nhalf_size = [8, 1]\nposition = [8, 1]\n"
      "[[body]]\nname = \"box\"\nhalf_size = [1, 1]\nposition = [8, 3]\n" +
          steps({"do = \"insert\"\nbodies = [\"floor\", \"box\"]",
                 "do = \"wait\"\nevent = \"asleep\"\nbodies = [\"box\"]\nat_most = 5\nevery = 1000",
                 "do = \"run\"\nseconds = 1\nname = \"night\""}))));
  for (const char* count : {"narrow_tests", "constraint_rows"})
    EXPECT_EQ(at(frames, "night").count(count), 0) << count << " while all sleep";
}

// Counts of work are those of the last world step, as the reference page says.
TEST(Engine, CountsTheLastWorldStepOnly) {
  const auto frames =
      frames_of(good(heap(false, "none") + steps({kInsertHeap, "do = \"run\"\nseconds = 0.5"})));
  std::set<std::int64_t> counts;
  for (const Frame& frame : frames)
    if (frame.event == "run") counts.insert(*frame.count("force_evaluations"));
  EXPECT_EQ(counts.size(), 1u) << "the count grows from step to step";
}

}  // namespace
}  // namespace lantern::run
