// What is legal and surely not meant is told; its near twin is not.
#include "run/warnings.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

bool shown_always(const Frame&) { return true; }

std::vector<Diagnostic> warnings_of(const std::string& text) {
  const Scenario scenario = good(text);
  RunWatch watch(scenario, shown_always);
  Work work;
  direct(
      scenario, scenario.pace, work, [](const Frame&) { return true; }, &watch);
  return watch.warnings();
}

std::vector<Warning> watched_in(const std::string& text) {
  return RunWatch(good(text), shown_always).kinds();
}

bool watches(const std::string& text, Warning kind) {
  const std::vector<Warning> kinds = watched_in(text);
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

// The first of them says `words`, stands at the line that begins with `line`, and is a warning.
void expect_warning(const std::string& text, const std::string& words, const std::string& line) {
  const std::vector<Diagnostic> found = warnings_of(text);
  ASSERT_FALSE(found.empty()) << "nothing is said of\n" << text;
  EXPECT_NE(found[0].message.find(words), std::string::npos) << shown(found);
  EXPECT_EQ(found[0].source_line.rfind(line, 0), 0u) << shown(found);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_FALSE(found[0].suggestion.empty());
  EXPECT_NE(to_string(found[0]).find(": warning: "), std::string::npos);
}

void expect_quiet(const std::string& text) {
  const std::vector<Diagnostic> found = warnings_of(text);
  EXPECT_TRUE(found.empty()) << text << "\n" << shown(found);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

std::string disc(const std::string& name, const std::string& keys) {
  return "[[body]]\nname = \"" + name + "\"\nradius = 0.5\n" + keys + "\n";
}

std::string insert_and_run(const std::string& bodies, const std::string& seconds) {
  return "[[step]]\ndo = \"insert\"\nbodies = " + bodies +
         "\n[[step]]\ndo = \"run\"\nseconds = " + seconds + "\n";
}

// --- nothing to see ---

TEST(Warnings, OfAViewThatShowsNoBody) {
  const std::string text = world_text(
      "size = [8, 8, 8]\ncamera_eye = [4, 4, 20]\ncamera_target = [4, 4, 40]",
      disc("ball", "position = [4, 4, 4]") +
          "[[step]]\ndo = \"show\"\n[[step]]\ndo = \"insert\"\nbodies = [\"ball\"]\n" + kShow);
  const Scenario scenario = good(text);
  const auto told = [&](bool shows) {
    RunWatch watch(scenario, [shows](const Frame&) { return shows; });
    Work work;
    direct(
        scenario, scenario.pace, work, [](const Frame&) { return true; }, &watch);
    return watch.warnings();
  };
  EXPECT_TRUE(told(true).empty());
  ASSERT_EQ(told(false).size(), 1u);
  const Diagnostic found = told(false)[0];
  EXPECT_EQ(found.message,
            "frame 1 (0 s) shows no body, though 'ball' is in the world; so do 2 of 2 frames")
      << "the first frame has no body to show";
  EXPECT_EQ(found.source_line, "camera_target = [4, 4, 40]");
  EXPECT_EQ(found.suggestion, "camera_target = [4, 4, 4] would look at it");
}

TEST(Warnings, OfViewsNeedAWorldPanel) {
  const std::string world = world_text("size = [8, 8]", kTree + disc("ball", "position = [4, 4]") +
                                                            "[[step]]\ndo = \"insert\"\n"
                                                            "bodies = [\"ball\"]\n");
  EXPECT_TRUE(watches(world, Warning::view));
  EXPECT_FALSE(watches("panels = [\"tree\"]\n" + world, Warning::view));
}

// --- outside the world ---

const std::string kOutside = world_text("size = [16, 9]", disc("ann", "position = [30, 6]") +
                                                              "[[step]]\ndo = \"insert\"\n"
                                                              "bodies = [\"ann\"]\n");

TEST(Warnings, OfABodyOutside) {
  expect_warning(kOutside, "'ann' is outside the world: frame 0 (0 s) has it 13.5 beyond",
                 "[[body]]");
  expect_quiet(replaced(kOutside, "[30, 6]", "[16.5, 6]"));  // it touches the bounds
  expect_warning(replaced(kOutside, "[30, 6]", "[16.51, 6]"), "0.01 beyond", "[[body]]");
  expect_quiet(replaced(kOutside, "[16, 9]", "[16, 9]\nquiet = [\"outside\"]"));
}

TEST(Warnings, OfABodyThatLeaves) {
  const std::string text =
      world_text("size = [8, 8]\ngravity = [0, -10]",
                 disc("ball", "position = [4, 4]") + insert_and_run("[\"ball\"]", "2"));
  // It is out when 4.5 units have been fallen: sqrt(0.9) s.
  expect_warning(text, "'ball' leaves the world: frame 57 (0.95 s)", "[[body]]");
  EXPECT_EQ(warnings_of(text).size(), 1u) << "told once";
  expect_quiet(replaced(text, "seconds = 2", "seconds = 0.9"));
}

TEST(Warnings, OfManyBodiesOutsideAreTenLinesAndOneForTheOthers) {
  const std::string text =
      world_text("size = [8, 8]",
                 "[[pattern]]\nname = \"b\"\narrange = \"line\"\ncount = 15\nmin = [20, 1]\n"
                 "max = [30, 1]\nradius = 0.1\n[[step]]\ndo = \"insert\"\nbodies = [\"b\"]\n");
  const std::vector<Diagnostic> found = warnings_of(text);
  ASSERT_EQ(found.size(), 11u);
  EXPECT_EQ(found[10].message, "5 more bodies are outside the world");
}

TEST(Warnings, OfAnchorsAndGroundsOutsideAreNotGiven) {
  expect_quiet(world_text("size = [8, 8]\ngravity = [0, -10]\ncontacts = \"soft\"",
                          "[[body]]\nname = \"ground\"\nground = [0, 1]\nposition = [0, -3]\n" +
                              disc("bob", "position = [4, 4]") +
                              "[[spring]]\na = \"bob\"\nto = [4, 12]\nstiffness = 30\n" +
                              insert_and_run("[\"ground\", \"bob\"]", "1")));
}

// --- contacts off ---

const std::string kFall = world_text(
    "size = [8, 8]\ngravity = [0, -10]\n",
    "[[body]]\nname = \"floor\"\nhalf_size = [4, 0.5]\nstatic = true\nposition = [4, 0.5]\n" +
        disc("ball", "position = [4, 3]") + insert_and_run("[\"floor\", \"ball\"]", "0.6"));

TEST(Warnings, OfContactsThatAreOff) {
  expect_warning(kFall, "'ball' falls into 'floor', ", "[world]");
  const std::string tree = replaced(kFall, "[[body]]", kTree + "[[body]]");
  expect_warning(tree, "'ball' falls into 'floor', ", "[world]");
  expect_warning(replaced(kFall, "gravity", "contacts = \"none\"\ngravity"), "contacts are off",
                 "contacts = \"none\"");
  expect_quiet(replaced(kFall, "gravity", "contacts = \"soft\"\ngravity"));
  expect_quiet(replaced(kFall, "gravity", "quiet = [\"contacts\"]\ngravity"));
  expect_quiet(replaced(kFall, "seconds = 0.6", "seconds = 0.5"));  // not yet there
}

TEST(Warnings, OfContactsThatAreOffNeedForces) {
  const std::string ghosts = replaced(kFall, "gravity = [0, -10]\n", "");
  EXPECT_FALSE(watches(ghosts, Warning::contacts));
  expect_quiet(replaced(ghosts, "position = [4, 3]", "position = [4, 3]\nvelocity = [0, -4]"));
}

TEST(Warnings, OfContactsThatAreOffAreNotForWhatOverlapsFromTheBeginning) {
  expect_quiet(world_text("size = [8, 8]\ngravity = [0, -1]",
                          disc("one", "position = [3.7, 6]") + disc("two", "position = [4.3, 6]") +
                              insert_and_run("[\"one\", \"two\"]", "1")));
  // Tied together they are no accident.
  expect_quiet(world_text("size = [8, 8]\ngravity = [0, -1]",
                          disc("one", "position = [3.2, 6]") + disc("two", "position = [4.5, 6]") +
                              "[[spring]]\na = \"one\"\nb = \"two\"\nstiffness = 5\n"
                              "rest_length = 0.2\n" +
                              insert_and_run("[\"one\", \"two\"]", "1")));
}

// --- joints ---

// A weight hangs from a chain of light beads.
std::string chain(const std::string& keys, double weight) {
  return world_text(
      "min = [0, -40]\nmax = [8, 8]\ngravity = [0, -10]\ncontacts = \"impulse\"\n" + keys,
      "[[pattern]]\nname = \"bead\"\narrange = \"line\"\ncount = 6\nmin = [4, 2]\nmax = [4, 7]\n"
      "radius = 0.2\nmass = 1\n[[joint]]\nalong = \"bead\"\nkind = \"distance\"\n[[joint]]\n"
      "a = \"bead6\"\nto = [4, 8]\nkind = \"distance\"\n"
      "[[body]]\nname = \"weight\"\nradius = 0.4\nmass = " +
          std::to_string(weight) +
          "\nposition = [4, 1]\n[[joint]]\na = \"weight\"\nb = \"bead1\"\nkind = \"distance\"\n" +
          insert_and_run("[\"bead\", \"weight\"]", "1"));
}

// A bar between two anchors that are farther apart than it is long.
std::string torn(const std::string& keys) {
  return world_text("size = [8, 8]\ncontacts = \"impulse\"\niterations = 1\n" + keys,
                    "[[body]]\nname = \"bar\"\nposition = [4, 4]\nhalf_size = [1, 0.2]\n"
                    "oriented = true\n"
                    "[[joint]]\na = \"bar\"\nto = [3, 4]\nat_a = [-1, 0]\nkind = \"pin\"\n"
                    "[[joint]]\na = \"bar\"\nto = [6, 4]\nat_a = [1, 0]\nkind = \"pin\"\n" +
                        insert_and_run("[\"bar\"]", "1"));
}

TEST(Warnings, OfJointsThatPart) {
  const std::vector<Diagnostic> found = warnings_of(torn(""));
  ASSERT_FALSE(found.empty());
  EXPECT_NE(found[0].message.find("the pin of 'bar' parts by "), std::string::npos) << shown(found);
  EXPECT_NE(found[0].message.find(" % of its bodies' size"), std::string::npos) << shown(found);
  EXPECT_EQ(found[0].source_line, "[[joint]]");
  EXPECT_EQ(found[0].suggestion,
            "give [world] more iterations than 1, or a time_step below 0.0167 s");
  expect_quiet(torn("quiet = [\"joints\"]"));
  expect_quiet(chain("iterations = 1", 1000));
  expect_quiet(chain("iterations = 200", 1));
}

// Told whether it is worth a warning or not.
TEST(Warnings, HowFarJointsPartIsAFact) {
  const auto facts_of = [](const std::string& text) {
    const Scenario scenario = good(text);
    RunWatch watch(scenario, shown_always);
    Work work;
    direct(
        scenario, Pace::step, work, [](const Frame&) { return true; }, &watch);
    return watch.facts();
  };
  const std::vector<std::string> told = facts_of(torn("quiet = [\"joints\"]"));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].rfind("joints parted by at most 0.", 0), 0u) << told[0];
  EXPECT_NE(told[0].find(", the pin of 'bar' at "), std::string::npos) << told[0];
  EXPECT_TRUE(facts_of(kFall).empty());
}

TEST(Warnings, OfJointsNeedJoints) {
  EXPECT_TRUE(watches(chain("", 1), Warning::joints));
  EXPECT_FALSE(watches(kFall, Warning::joints));
}

// --- energy ---

std::string swing(const std::string& integrator, const std::string& steps) {
  return world_text("size = [8, 8]\ntime_step = 0.02\nintegrator = \"" + integrator + "\"",
                    disc("bob", "mass = 1\nposition = [5, 4]") +
                        "[[spring]]\na = \"bob\"\nto = [2, 4]\nstiffness = 25\nrest_length = 2\n"
                        "[[step]]\ndo = \"insert\"\nbodies = [\"bob\"]\n" +
                        steps);
}

TEST(Warnings, OfEnergyThatGrows) {
  const std::string run = "[[step]]\ndo = \"run\"\nseconds = 1\n";
  expect_warning(swing("explicit_euler", run), "energy grows from ", "integrator = ");
  for (const char* method : {"semi_implicit_euler", "velocity_verlet", "implicit_midpoint",
                             "implicit_euler", "runge_kutta_4"})
    expect_quiet(swing(method, run));
  expect_quiet(
      replaced(swing("explicit_euler", run), "time_step", "quiet = [\"energy\"]\ntime_step"));
}

TEST(Warnings, OfEnergyAreNotForWhatTheScriptDrives) {
  const std::string push =
      "[[step]]\ndo = \"force\"\nbody = \"bob\"\nforce = [9, 0]\n"
      "[[step]]\ndo = \"run\"\nseconds = 0.3\n";
  expect_quiet(swing("implicit_midpoint", push));
  expect_quiet(swing("implicit_midpoint",
                     "[[step]]\ndo = \"run\"\nseconds = 0.3\n[[step]]\ndo = \"impulse\"\n"
                     "body = \"bob\"\nimpulse = [-9, 0]\n[[step]]\ndo = \"run\"\nseconds = 0.1\n"));
  // Once the force ends, what grows is told again.
  expect_warning(
      swing("explicit_euler", push + "[[step]]\ndo = \"force\"\nbody = \"bob\"\nforce = [0, 0]\n"
                                     "[[step]]\ndo = \"run\"\nseconds = 1\n"),
      "energy grows from ", "integrator = ");
}

TEST(Warnings, OfEnergyAreForTheTurningOfFreeBodies) {
  const auto box = [](const std::string& rotation) {
    return world_text(
        "min = [-9, -9, -9]\nmax = [9, 9, 9]\ntime_step = 0.02\nrotation = \"" + rotation + "\"",
        "[[body]]\nname = \"box\"\nhalf_size = [0.5, 2, 4.5]\nposition = [0, 0, 0]\n"
        "axis = [0.1, 5, 0.1]\nspin = 286\n" +
            insert_and_run("[\"box\"]", "6"));
  };
  expect_warning(box("explicit_gyroscopic"), "energy grows from ", "rotation = ");
  expect_quiet(box("splitting_2"));
}

TEST(Warnings, OfEnergyAreNotForBodiesThatEnterOneByOne) {
  expect_quiet("pace = \"event\"\n" +
               world_text("size = [8, 8]\ngravity = [0, -10]",
                          kTree + disc("one", "position = [2, 7]") +
                              disc("two", "position = [4, 7]") +
                              disc("three", "position = [6, 7]") +
                              insert_and_run("[\"one\", \"two\", \"three\"]", "0.5")));
}

TEST(Warnings, OfEnergyAreNotForARestingPile) {
  expect_quiet(world_text("min = [-8, -1]\nmax = [8, 8]\ngravity = [0, -10]\ncontacts = \"soft\"",
                          "[[body]]\nname = \"ground\"\nground = [0, 1]\nposition = [0, -0.5]\n" +
                              disc("ball", "position = [0, 0]") +
                              insert_and_run("[\"ground\", \"ball\"]", "2")));
}

// --- through ---

// A press comes down upon a ball that lies on a thin board.
std::string press(const std::string& speed) {
  return world_text("size = [8, 8]\ngravity = [0, -10]\ncontacts = \"soft\"",
                    "[[body]]\nname = \"board\"\nhalf_size = [3, 0.05]\nstatic = true\n"
                    "position = [4, 3]\n" +
                        disc("ball", "position = [4, 3.55]") +
                        "[[body]]\nname = \"press\"\nkind = \"kinematic\"\nhalf_size = [2, 0.5]\n"
                        "position = [4, 5]\nvelocity = [0, " +
                        speed + "]\n" + insert_and_run("[\"board\", \"ball\", \"press\"]", "1"));
}

TEST(Warnings, OfABodyThatIsPushedThroughAStaticOne) {
  expect_warning(press("-3"), "'ball' is pushed through 'board'", "[world]");
  expect_quiet(press("-0.4"));
  expect_quiet(replaced(press("-3"), "contacts", "quiet = [\"through\", \"crush\"]\ncontacts"));
}

TEST(Warnings, OfABodyThatIsPushedThroughNeedContactsAndAStaticBody) {
  EXPECT_TRUE(watches(press("-3"), Warning::through));
  EXPECT_FALSE(watches(replaced(press("-3"), "contacts = \"soft\"", ""), Warning::through));
  EXPECT_FALSE(watches(replaced(press("-3"), "static = true", ""), Warning::through));
}

// --- all of them ---

TEST(Warnings, OfAnAtlasAreNotWatchedFor) {
  EXPECT_TRUE(watched_in("title = \"t\"\n[atlas]\nsize = [64, 64]\n[[texture]]\nname = \"a\"\n"
                         "size = [8, 8]\n[[step]]\ndo = \"pack\"\ntextures = [\"a\"]\n")
                  .empty());
  EXPECT_EQ(watched_in(replaced(kOutside, "[30, 6]", "[3, 6]")),
            (std::vector{Warning::view, Warning::outside}));
}

TEST(Warnings, ThatAreWatchedForChangeNoFrame) {
  for (const std::string& text : {press("-3"), torn(""), kFall}) {
    const Scenario scenario = good(text);
    const std::vector<Frame> alone = frames_of(scenario);
    RunWatch watch(scenario, shown_always);
    Work work;
    std::size_t i = 0;
    direct(
        scenario, Pace::step, work,
        [&](const Frame& frame) {
          EXPECT_EQ(to_json(frame), to_json(alone[i++]));
          return true;
        },
        &watch);
    EXPECT_EQ(i, alone.size());
    EXPECT_FALSE(watch.warnings().empty());
  }
}

}  // namespace
}  // namespace lantern::run
