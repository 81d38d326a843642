// A scenario that comes with Lantern is found by its name.
#include <string>

#include <gtest/gtest.h>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// Where Lantern is installed, or looks so: the program, and one scenario that nobody else has.
fs::path installed() {
  const fs::path prefix = fresh_folder("installed");
  fs::create_directories(prefix / "bin");
  fs::create_directories(prefix / "share/lantern/scenarios/problems");
  fs::create_directories(prefix / "elsewhere");
  fs::create_hard_link(LANTERN_BINARY, prefix / "bin/lantern");
  fs::copy_file(kGhosts, prefix / "share/lantern/scenarios/only_here.toml");
  fs::copy_file(repository("scenarios/problems/projectile.toml"),
                prefix / "share/lantern/scenarios/problems/thrown.toml");
  return prefix;
}

std::string in_elsewhere(const fs::path& prefix, const std::string& words) {
  return "cd " + (prefix / "elsewhere").string() + "; XDG_DATA_DIRS= " + words;
}

TEST(ScenarioFolder, OfTheRepositoryIsFoundByTheProgramBuiltThere) {
  const fs::path folder = fresh_folder("anywhere");
  const Outcome o = shell("cd " + folder.string() + "; lantern check pong_bsp");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("'pong_bsp' is " + scenario("pong_bsp")), std::string::npos) << o.err;
  EXPECT_EQ(shell("cd " + folder.string() + "; lantern explain pong_bsp").code, 0);
}

TEST(ScenarioFolder, OfAnInstalledProgramIsBesideIt) {
  const fs::path prefix = installed();
  const std::string share = (prefix / "share/lantern/scenarios").string();
  Outcome o = shell(in_elsewhere(prefix, "../bin/lantern check only_here thrown"));
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("'only_here' is " + share + "/only_here.toml\n"), std::string::npos)
      << o.err;
  EXPECT_NE(o.err.find("'thrown' is " + share + "/problems/thrown.toml\n"), std::string::npos);
  o = shell(in_elsewhere(prefix, "../bin/lantern list"));
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.err.find("from " + share), std::string::npos) << o.err;
  EXPECT_NE(o.out.find("only_here"), std::string::npos) << o.out;
}

TEST(ScenarioFolder, HereGoesFirstAndFilesAreThemselves) {
  const fs::path prefix = installed();
  fs::create_directories(prefix / "elsewhere/scenarios");
  write_text(prefix / "elsewhere/scenarios/only_here.toml", "nonsense = 1\n");
  Outcome o = shell(in_elsewhere(prefix, "../bin/lantern check only_here"));
  EXPECT_EQ(o.code, 3);
  EXPECT_NE(o.err.find("'only_here' is scenarios/only_here.toml\n"), std::string::npos) << o.err;
  fs::copy_file(kGhosts, prefix / "elsewhere/only_here");
  o = shell(in_elsewhere(prefix, "../bin/lantern check only_here"));
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err.find("'only_here' is"), std::string::npos) << o.err;
}

TEST(ScenarioFolder, IsLookedForAmongTheDataOfTheMachine) {
  const fs::path prefix = installed();
  fs::create_directories(prefix / "other/bin");
  fs::rename(prefix / "bin/lantern", prefix / "other/bin/lantern");
  const std::string program = "../other/bin/lantern ";
  EXPECT_EQ(shell(in_elsewhere(prefix, program + "check only_here")).code, 1);
  EXPECT_EQ(shell("cd " + (prefix / "elsewhere").string() + "; XDG_DATA_DIRS=/nowhere:" +
                  (prefix / "share").string() + " " + program + "check only_here")
                .code,
            0);
}

TEST(ScenarioFolder, TellsTheNearestNameWhenThereIsNone) {
  const fs::path prefix = installed();
  const Outcome o = shell(in_elsewhere(prefix, "../bin/lantern check only_hear"));
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("did you mean 'only_here'?"), std::string::npos) << o.err;
  EXPECT_EQ(shell(in_elsewhere(prefix, "../bin/lantern check no_such.toml")).code, 1);
}

TEST(ScenarioFolder, TellsThatFoldersBelowAreNotRead) {
  const fs::path folder = fresh_folder("below");
  fs::create_directories(folder / "week2");
  fs::create_directories(folder / "de");
  fs::copy_file(kGhosts, folder / "ghosts.toml");
  fs::copy_file(kGhosts, folder / "week2/ghosts.toml");
  fs::copy_file(repository("scenarios/de/ghost_quadtree.toml"), folder / "de/ghosts.toml");
  const Outcome o = shell("lantern check " + folder.string());
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("week2' are not read"), std::string::npos) << o.err;
  EXPECT_EQ(o.err.find("/de'"), std::string::npos) << "it holds texts: " << o.err;
}

}  // namespace
}  // namespace lantern::app
