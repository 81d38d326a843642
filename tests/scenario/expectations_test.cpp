// Each kind of promise: it holds where it should, and says what it found where it does not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frame/frame.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

// Two that touch, one that sleeps elsewhere, a turned box; and a query that finds the first two.
std::string scene(const std::string& expect) {
  return world_text(
      "size = [16, 16]\ncontacts = \"impulse\"\nmay_sleep = true\ntime_step = 0.0625",
      "[structure]\nkind = \"quadtree\"\ncapacity = 1\nmax_depth = 3\n"
      "[[body]]\nname = \"a\"\nradius = 1\nposition = [2, 4]\n"
      "[[body]]\nname = \"b\"\nradius = 1\nposition = [3.9, 4]\n"
      "[[body]]\nname = \"sleeper\"\nradius = 1\nposition = [12, 12]\nasleep = true\n"
      "[[body]]\nname = \"box\"\nhalf_size = [1, 0.5]\nturned = 30\nposition = [12, 4]\n"
      "velocity = [1, 0]\n" +
          steps({"do = \"insert\"\nbodies = [\"a\", \"b\", \"sleeper\", \"box\"]",
                 "do = \"run\"\nseconds = 0.0625",
                 "do = \"query\"\nmin = [0, 0]\nmax = [6, 6]\nexpect = { " + expect + " }"}));
}

std::vector<Diagnostic> unmet_of(const std::string& expect) {
  Work work;
  return direct(good(scene(expect)), Pace::step, work, [](const Frame&) { return true; })
      .unmet.told();
}

struct Promise {
  std::string holds;
  std::string fails;
  std::string says;  // of the failing one
};

std::vector<Promise> promises() {
  const Frame found = frames_of(good(scene("bodies = 4"))).back();
  const FrameBody& a = body(found, "a");
  const FrameBody& box = body(found, "box");
  const double kinetic = *found.measure("kinetic_energy");
  const double deep = *found.measure("penetration");
  const auto point = [](const Vec<3>& p) { return fmt::format("[{:.17g}, {:.17g}]", p.x, p.y); };
  return {
      {"bodies = 4", "bodies = 5", "expected bodies = 5, found 4"},
      {"contacts = 1", "contacts = 0", "expected contacts = 0, found 1"},
      {"at_most = { contacts = 1 }", "at_most = { contacts = 0 }",
       "expected contacts at most 0, found 1"},
      {"at_least = { hits = 2 }", "at_least = { hits = 3 }", "expected hits at least 3, found 2"},
      {fmt::format("at_most = {{ penetration = {} }}", deep + 0.01),
       fmt::format("at_most = {{ penetration = {} }}", deep / 2), "expected penetration at most"},
      {"in_leaves = { sleeper = 1 }", "in_leaves = { sleeper = 7 }",
       "expected 'sleeper' in 7 leaves, found it in 1"},
      {"pairs_are = [[\"b\", \"a\"]]", "pairs_are = []", "expected the pairs none, found (a, b)"},
      {"contacts_are = [[\"a\", \"b\"]]", "contacts_are = [[\"a\", \"box\"]]",
       "expected the contacts (a, box), found (a, b)"},
      {"hits_are = [\"b\", \"a\"]", "hits_are = [\"a\"]", "expected the hits a, found a, b"},
      {"asleep = [\"sleeper\"]", "asleep = [\"sleeper\", \"a\"]",
       "expected to be asleep, but are not: a"},
      {"asleep = 1", "asleep = 2", "expected asleep = 2, found 1"},
      {"awake = [\"a\", \"b\"]", "awake = [\"sleeper\"]",
       "expected to be awake, but are not: sleeper"},
      {"position = { a = " + point(a.position) + " }", "position = { a = [9, 9] }",
       "expected 'a' at [9, 9] within"},
      {"velocity = { box = [1, 0] }", "velocity = { box = [0, 1] }",
       "expected 'box' with velocity [0, 1]"},
      {"half_size = { box = " + point(box.box.size() * 0.5) + " }", "half_size = { box = [1, 1] }",
       "expected 'box' with a box of half size [1, 1]"},
      {"turned = { box = 30 }", "turned = { box = 31 }",
       "expected 'box' turned by 31 degrees, found"},
      {fmt::format("kinetic_energy = {:.17g}", kinetic),
       fmt::format("kinetic_energy = {}, tolerance = 0.1", kinetic + 1),
       "expected kinetic_energy = "},
      {fmt::format("kinetic_energy = {}, tolerance = 0.1", kinetic + 0.05),
       fmt::format("kinetic_energy = {}", kinetic + 0.05), "expected kinetic_energy = "},
  };
}

TEST(Expectations, OfEachKindHoldOrSayWhatWasFound) {
  for (const Promise& promise : promises()) {
    SCOPED_TRACE(promise.holds);
    const auto kept = unmet_of(promise.holds);
    EXPECT_TRUE(kept.empty()) << kept[0].message;
    const auto broken = unmet_of(promise.fails);
    ASSERT_EQ(broken.size(), 1u) << promise.fails << " should not hold";
    EXPECT_NE(broken[0].message.find(promise.says), std::string::npos) << broken[0].message;
    EXPECT_NE(broken[0].message.find("(frame 2, time 0.0625 s)"), std::string::npos)
        << broken[0].message;
  }
}

TEST(Expectations, OfARayAreInOrder) {
  const auto unmet_with = [](const std::string& hits) {
    Work work;
    return direct(good(world_text("size = [16, 16]",
                                  "[structure]\nkind = \"brute_force\"\n[[pattern]]\n"
                                  "name = \"p\"\ncount = 3\nradius = 1\narrange = \"line\"\n"
                                  "min = [2, 8]\nmax = [14, 8]\n" +
                                      steps({"do = \"insert\"\nbodies = [\"p\"]",
                                             "do = \"ray\"\nhits = \"all\"\nfrom = [16, 8]\n"
                                             "to = [0, 8]\nexpect = { hits_are = [" +
                                                 hits + "] }"}))),
                  Pace::step, work, [](const Frame&) { return true; })
        .unmet.count();
  };
  EXPECT_EQ(unmet_with("\"p3\", \"p2\", \"p1\""), 0u);
  EXPECT_EQ(unmet_with("\"p1\", \"p2\", \"p3\""), 1u) << "the order along the ray is not verified";
}

TEST(Expectations, OfAlwaysAreVerifiedOnEveryFrame) {
  const Scenario s = good(
      world_text("size = [16, 16]\ntime_step = 0.25",
                 "[[body]]\nname = \"a\"\nradius = 1\nposition = [2, 2]\nvelocity = [1, 0]\n" +
                     steps({"do = \"insert\"\nbodies = [\"a\"]",
                            "do = \"run\"\nseconds = 1\nalways = { position = { a = [2.5, 2] }, "
                            "tolerance = 0.3 }"})));
  Work work;
  const DirectorReport report = direct(s, Pace::step, work, [](const Frame&) { return true; });
  EXPECT_EQ(report.expectations, 4u) << "one on each of four frames";
  ASSERT_EQ(report.unmet.count(), 1u) << "it breaks on the last one, and is told once";
  EXPECT_NE(report.unmet.told()[0].message.find("frame 4"), std::string::npos)
      << report.unmet.told()[0].message;
}

}  // namespace
}  // namespace lantern::run
