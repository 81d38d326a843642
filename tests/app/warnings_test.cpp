// Warnings as a user of the program meets them.
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A camera that looks away.
const std::string kAway =
    "title = \"away\"\n[world]\nsize = [4, 4, 4]\ncamera_eye = [2, 2, -20]\n"
    "camera_target = [2, 2, -40]\n[[body]]\nname = \"a\"\nposition = [1, 1, 1]\nradius = 0.5\n"
    "[[step]]\ndo = \"insert\"\nbodies = [\"a\"]\n";

std::string file_of(const std::string& name, const std::string& text) {
  const fs::path file = fresh_folder("warnings-" + name) / (name + ".toml");
  write_text(file, text);
  return file.string();
}

std::string looking_at_it() {
  std::string text = kAway;
  return text.replace(text.find("-40"), 3, "0");
}

TEST(Warnings, AreSaidWithPlaceAndKey) {
  const Outcome o = shell("lantern check " + file_of("away", kAway));
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.err.find("away.toml:5:1: warning: frame 0 (0 s) shows no body"), std::string::npos)
      << o.err;
  EXPECT_NE(o.err.find("camera_target = [1, 1, 1] would look at it"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("good; 1 frame, 0 expectations hold; 1 warning\n"), std::string::npos);
  EXPECT_EQ(shell("lantern check " + file_of("at", looking_at_it())).err.find(": warning: "),
            std::string::npos);
}

TEST(Warnings, AreErrorsIfOneIsStrict) {
  const Outcome o = shell("lantern check --strict " + file_of("away", kAway));
  EXPECT_EQ(o.code, 3);
  EXPECT_NE(o.err.find("away.toml:5:1: error: frame 0"), std::string::npos) << o.err;
  EXPECT_EQ(o.err.find("good"), std::string::npos) << o.err;
  EXPECT_EQ(shell("lantern check --strict " + file_of("at", looking_at_it())).code, 0);
}

TEST(Warnings, AreAListOfTheirOwnInJson) {
  const std::string file = file_of("away", kAway);
  const json told = json::parse(shell("lantern check --json " + file).out)["scenarios"][0];
  EXPECT_EQ(told["good"], true);
  EXPECT_TRUE(told["problems"].empty());
  ASSERT_EQ(told["warnings"].size(), 1u);
  EXPECT_EQ(told["warnings"][0]["line"], 5);
  EXPECT_EQ(told["warnings"][0]["column"], 1);
  EXPECT_EQ(told["warnings"][0]["suggestion"], "camera_target = [1, 1, 1] would look at it");
  const json strict =
      json::parse(shell("lantern check --strict --json " + file).out)["scenarios"][0];
  EXPECT_EQ(strict["good"], false);
  EXPECT_EQ(strict["problems"], told["warnings"]);
  EXPECT_TRUE(strict["warnings"].empty());
}

// --- what is beyond the file ---

// One disc, and what comes first.
std::string disc(const std::string& before, const std::string& world = "") {
  return before + "title = \"t\"\n[world]\nsize = [8, 8]\n" + world +
         "[[body]]\nname = \"a\"\nposition = [4, 4]\nradius = 0.5\n"
         "[[step]]\ndo = \"insert\"\nbodies = [\"a\"]\n";
}

TEST(Warnings, OfNeedsThatAreNotThere) {
  const fs::path folder = fresh_folder("warnings-needs");
  const auto checked = [&](const std::string& needs, const std::string& world = "") {
    write_text(folder / "lesson.toml", disc("needs = [" + needs + "]\n", world));
    const Outcome o = shell("lantern check --quiet " + (folder / "lesson.toml").string());
    EXPECT_EQ(o.code, 0) << o.err;
    return o.err;
  };
  write_text(folder / "before.toml", disc(""));
  write_text(folder / "file.toml", disc("name = \"called_so\"\n"));
  EXPECT_EQ(checked("\"before\", \"called_so\", \"ghost_quadtree\""), "");
  const std::string missing = checked("\"before\", \"nonexistent\"");
  EXPECT_NE(missing.find("lesson.toml:1:20: warning: there is no scenario 'nonexistent' to be seen "
                         "before"),
            std::string::npos)
      << missing;
  EXPECT_NE(missing.find("if this is intended, add quiet = [\"needs\"] to [world]"),
            std::string::npos);
  EXPECT_NE(checked("\"befor\"").find("did you mean 'before'?"), std::string::npos);
  EXPECT_EQ(checked("\"nonexistent\"", "quiet = [\"needs\"]\n"), "");
  EXPECT_NE(checked("\"lesson\"").find("1:10: warning: 'lesson' cannot be seen before itself"),
            std::string::npos);
  EXPECT_NE(checked("\"before\", \"before\"")
                .find("1:20: warning: 'before' is to be seen before, and is named twice"),
            std::string::npos);
  EXPECT_EQ(shell("lantern check --quiet - < " + (folder / "lesson.toml").string()).err, "")
      << "it lies in no folder";
}

TEST(Warnings, OfAProblemThatTheBodiesDoNotPose) {
  const std::string kepler = "[problem]\nsolution = \"kepler\"\nseconds = 1\nstep = 0.1\n";
  const auto checked = [&](const std::string& text) {
    return shell("lantern check --quiet " + file_of("problem", text)).err;
  };
  const std::string wrong = checked(disc("") + kepler);
  EXPECT_NE(wrong.find("problem.toml:11:1: warning: 'problem' is no problem of kind kepler: "
                       "[world] needs a `gravitation`"),
            std::string::npos)
      << wrong;
  EXPECT_EQ(checked(disc("", "quiet = [\"problem\"]\n") + kepler), "");
  const std::string second =
      "[[body]]\nname = \"b\"\nposition = [6, 4]\nradius = 0.5\n"
      "velocity = [0, 1]\n";
  EXPECT_EQ(checked(disc("", "gravitation = 2\n") + second + kepler), "");
  // What is found is told, not what should be.
  EXPECT_NE(checked(disc("", "gravitation = 2\ngravity = [0, -9]\n") + second + kepler)
                .find("there is gravity, too"),
            std::string::npos);
  EXPECT_NE(checked(disc("", "gravitation = 2\ncontacts = \"soft\"\n") + second + kepler)
                .find("its bodies may touch: contacts = \"soft\""),
            std::string::npos);
  const std::string pushed =
      "[[step]]\ndo = \"insert\"\nbodies = [\"b\"]\n[[step]]\ndo = \"force\"\nbody = \"b\"\nforce "
      "= [1, 0]\n";
  EXPECT_NE(checked(disc("", "gravitation = 2\n") + second + kepler + pushed)
                .find("the script pushes 'b'"),
            std::string::npos);
  const std::string steered =
      "[[body]]\nname = \"b\"\nposition = [6, 4]\nradius = 0.5\n"
      "wander = true\nspeed = 1\n";
  const std::string said = checked(disc("", "gravitation = 2\n") + steered + kepler);
  EXPECT_NE(said.find("'b' is steered"), said.npos);
  EXPECT_EQ(said.find("'wander'"), said.npos) << "it moves, though it never has to turn";
  const std::string flight = "[problem]\nsolution = \"projectile\"\nseconds = 1\nstep = 0.1\n";
  EXPECT_NE(checked(disc("", "gravitation = 2\n") + second + flight)
                .find("its bodies attract each other"),
            std::string::npos);
}

// Those whose answers are costly to know are not computed for it.
TEST(Warnings, OfProblemsThatTwoDiscsDoNotPose) {
  const std::string second = "[[body]]\nname = \"b\"\nposition = [6, 4]\nradius = 0.5\n";
  const std::pair<std::string, std::string> cases[] = {{"chain", "no end of it is fixed"},
                                                       {"linkage", "there is no gravity"},
                                                       {"heavy_top", "the world must be solid"},
                                                       {"springs_along_pins", "it has no joints"},
                                                       {"dominoes", "there is no gravity"}};
  for (const auto& [solution, why] : cases) {
    const std::string text = disc("") + second + "[problem]\nsolution = \"" + solution +
                             "\"\nseconds = 1e8\nstep = 0.1\n";
    const std::string told = shell("lantern check --quiet " + file_of("problem", text)).err;
    EXPECT_NE(told.find("is no problem of kind " + solution + ": " + why), std::string::npos)
        << told;
  }
}

TEST(Warnings, AreGivenOfNothingThatComesWithLantern) {
  const std::string root = repository("scenarios");
  std::string files = root + "/*.toml";
#ifndef __SANITIZE_ADDRESS__  // the problems would take minutes
  files += " " + root + "/problems/*.toml";
#endif
  // Event pace does all that step pace does.
  const Outcome o = shell("lantern check --strict --pace event " + files);
  EXPECT_EQ(o.code, 0) << o.err;
}

}  // namespace
}  // namespace lantern::app
