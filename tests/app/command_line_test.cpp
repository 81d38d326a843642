// The command line as a user meets it: streams, exit codes, selections.
#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"
#include "base/child.hpp"
#include "base/printable.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kPong = scenario("pong_bsp");
const std::string kAtlas = scenario("kdtree_atlas");
const std::string kSmall = " --size 320x180 ";

std::size_t count_files(const fs::path& folder, const std::string& ending) {
  std::size_t n = 0;
  for (const auto& entry : fs::directory_iterator(folder)) n += entry.path().extension() == ending;
  return n;
}

TEST(CommandLine, HelpGoesToStandardOutputAndIsGood) {
  const Outcome o = shell("lantern --help");
  EXPECT_EQ(o.code, 0);
  for (const char* word : {"render", "check", "list", "explain", "doctor", "compare", "bench"})
    EXPECT_NE(o.out.find(word), std::string::npos) << word << " is not in the help";
  EXPECT_EQ(shell("lantern render --help").code, 0);
}

TEST(CommandLine, WrongWordsAreUsageErrorsWithAHint) {
  const Outcome misspelt = shell("lantern rendr x.toml");
  EXPECT_EQ(misspelt.code, 2);
  EXPECT_NE(misspelt.err.find("did you mean 'render'?"), std::string::npos) << misspelt.err;
  EXPECT_EQ(misspelt.out, "");
  for (const char* command :
       {"lantern", "lantern render", "lantern render --theme pink x.toml", "lantern check --no x",
        "lantern render -j 0 x.toml", "lantern compare one.png"})
    EXPECT_EQ(shell(command).code, 2) << command;
}

TEST(CommandLine, AnUnknownOptionGetsTheNearest) {
  for (const auto& [words, near] : {std::pair{"render x.toml --lenght 20", "--length"},
                                    {"render --tehme=dark x.toml", "--theme"},
                                    {"render x.toml --langauge de", "--language"},
                                    {"--quite list", "--quiet"}}) {
    const Outcome o = shell(std::string("lantern ") + words);
    EXPECT_EQ(o.code, 2) << words;
    EXPECT_NE(o.err.find(std::string("did you mean ") + near + "?"), std::string::npos) << o.err;
  }
  EXPECT_EQ(shell("lantern render x.toml --xyzzy 1").err.find("did you mean"), std::string::npos);
}

TEST(CommandLine, WithoutAWordItSaysWhatToDoFirst) {
  const Outcome o = shell("lantern");
  EXPECT_EQ(o.out, "");
  EXPECT_EQ(std::ranges::count(o.err, '\n'), 5) << o.err;
  EXPECT_NE(o.err.find("lantern render ghost_quadtree"), o.err.npos) << o.err;
}

TEST(CommandLine, NamesAreSuggestedAndListed) {
  const Outcome o = shell("lantern check quadtree");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("did you mean 'ghost_quadtree', 'raycast_quadtree'?"), o.err.npos) << o.err;
  EXPECT_NE(shell("lantern check ghost_quadtre").err.find("did you mean 'ghost_quadtree'?"),
            std::string::npos);
  const std::string names = shell("lantern list --names " + repository("scenarios").string()).out;
  EXPECT_NE(names.find("ghost_quadtree\n"), names.npos);
  EXPECT_EQ(names.find(' '), names.npos);
}

TEST(CommandLine, AListFitsTheTerminal) {
  if (!find_program("script")) GTEST_SKIP() << "no script(1)";
  const std::string list = LANTERN_BINARY " list " + repository("scenarios").string();
  const std::string out =
      shell("script -qec 'stty cols 60; " + list + "' /dev/null </dev/null").out;
  std::istringstream lines(out);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    longest = std::max(longest, letters(line));
  }
  EXPECT_EQ(longest, 60u) << out;
  EXPECT_GT(shell("lantern list " + repository("scenarios").string()).out.size(), out.size())
      << "a pipe gets all";
}

TEST(CommandLine, BadSelectionsAreUsageErrors) {
  for (const char* words :
       {"--frames 9999", "--frames x", "--frames 5-3", "--frames -", "--at nothing_of_this_name",
        "--at 1e9", "--size 0x0", "--size 100", "--size 99999x99999", "--size -5x5"}) {
    const fs::path out = fresh_folder("selection");
    const Outcome o = shell("lantern render " + kGhosts + " -o " + out.string() + " " + words);
    EXPECT_EQ(o.code, 2) << words << ": " << o.err;
    EXPECT_TRUE(fs::is_empty(out)) << words << " left something behind";
  }
}

TEST(CommandLine, CheckVerifiesEveryScenarioOfTheRepository) {
  const Outcome o = shell("lantern check --json " + repository("scenarios").string() + "/*.toml");
  EXPECT_EQ(o.code, 0) << o.err;
  const json report = json::parse(o.out);
  EXPECT_GE(report["scenarios"].size(), 4u);
  for (const json& s : report["scenarios"]) EXPECT_GT(s["expectations"], 0) << s["file"];
}

TEST(CommandLine, AnUnmetExpectationFailsWithItsPlace) {
  const fs::path folder = fresh_folder("unmet");
  std::string text = read_text(kGhosts);
  text.replace(text.find("nodes = 1, pairs = 1"), 20, "nodes = 1, pairs = 7");
  write_text(folder / "wrong.toml", text);
  const Outcome o = shell("lantern check " + (folder / "wrong.toml").string());
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("wrong.toml:"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("expected pairs = 7, found 1"), std::string::npos) << o.err;
  const Outcome rendered = shell("lantern render " + (folder / "wrong.toml").string() + kSmall +
                                 "-o " + folder.string());
  EXPECT_EQ(rendered.code, 1) << "render verifies expectations, too";
  EXPECT_TRUE(fs::exists(folder / "wrong" / "wrong_0000.png")) << "but it still draws";
}

TEST(CommandLine, RenderWritesAPictureAndItsFactsForEachFrameAndAManifest) {
  const fs::path out = fresh_folder("render");
  const Outcome o = shell("lantern render " + kGhosts + kSmall + "-o " + out.string());
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out, "") << "messages belong to standard error";
  const json manifest = json::parse(read_text(out / "ghost_quadtree" / "manifest.json"));
  EXPECT_TRUE(manifest["finished"]);
  ASSERT_EQ(manifest["frames"].size(), 8u);
  for (const json& frame : manifest["frames"]) {
    EXPECT_TRUE(fs::exists(out / "ghost_quadtree" / std::string(frame["file"])));
    const json facts = json::parse(read_text(out / "ghost_quadtree" / std::string(frame["facts"])));
    EXPECT_EQ(facts["format"], "lantern.frame/2");
    EXPECT_EQ(facts["hash"], frame["hash"]);
  }
}

TEST(CommandLine, AtlasIsWrittenAsAnImageWithItsRectangles) {
  const fs::path out = fresh_folder("atlas");
  ASSERT_EQ(shell("lantern render " + kAtlas + kSmall + "-o " + out.string()).code, 0);
  const json atlas = json::parse(read_text(out / "kdtree_atlas" / "kdtree_atlas_atlas.json"));
  EXPECT_EQ(atlas["textures"].size(), 34u);
  EXPECT_EQ(atlas["refused"], json::array({"banner"}));
  EXPECT_TRUE(fs::exists(out / "kdtree_atlas" / "kdtree_atlas_atlas.png"));
}

TEST(CommandLine, FramesAndAtChoose) {
  const fs::path out = fresh_folder("choose");
  const auto pictures = [&](const std::string& words) {
    fs::remove_all(out / "pong_bsp");
    const Outcome o =
        shell("lantern render " + kPong + kSmall + "-o " + out.string() + " " + words);
    EXPECT_EQ(o.code, 0) << words << ": " << o.err;
    return count_files(out / "pong_bsp", ".png");
  };
  EXPECT_EQ(pictures("--frames 3"), 1u);
  EXPECT_EQ(pictures("--frames 3-5"), 3u);
  EXPECT_EQ(pictures("--frames -1"), 2u);
  EXPECT_EQ(pictures("--at across"), 1u);
  EXPECT_EQ(pictures("--at 1"), 1u);
  EXPECT_TRUE(fs::exists(out / "pong_bsp" / "pong_bsp_0003.png"))
      << "two explaining steps, one that ends after 0.90625 s, and the one across the net";
}

TEST(CommandLine, OneFrameToStandardOutputIsTheFileThatWouldBeWritten) {
  const fs::path out = fresh_folder("stdout");
  for (const std::string format : {"png", "svg"}) {
    ASSERT_EQ(
        shell("lantern render " + kGhosts + kSmall + "-o " + out.string() + " --format " + format)
            .code,
        0);
    const Outcome o =
        shell("lantern render " + kGhosts + kSmall + "-o - --at three --format " + format);
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.out, read_text(out / "ghost_quadtree" / ("ghost_quadtree_0001." + format)));
  }
  EXPECT_EQ(shell("lantern render " + kGhosts + kSmall + "-o -").code, 2) << "8 frames are chosen";
}

TEST(CommandLine, ListExplainDoctorAnswerOnStandardOutput) {
  const Outcome list = shell("lantern list " + repository("scenarios").string());
  EXPECT_EQ(list.code, 0);
  EXPECT_NE(list.out.find("pong_bsp"), std::string::npos);
  const json explained = json::parse(shell("lantern explain --json " + kAtlas).out);
  bool world_left_out = false;
  for (const json& stage : explained["stages"]) {
    EXPECT_FALSE(stage["counts"].empty()) << stage["stage"];
    if (stage["stage"] == "world") world_left_out = !stage["used"];
  }
  EXPECT_TRUE(world_left_out) << "an atlas has no world";
  for (const char* name : {"falling_boxes", "pong_bsp", "kdtree_atlas", "tumbling_box"}) {
    const std::string told = shell("lantern explain " + scenario(name)).out;
    EXPECT_LE(std::ranges::count(told, '\n'), 30) << "more than a screen:\n" << told;
    const json same = json::parse(shell("lantern explain --json " + scenario(name)).out);
    for (const json& stage : same["stages"])
      EXPECT_NE(told.find(stage["stage"].get<std::string>()), std::string::npos) << stage["stage"];
  }
  const Outcome doctor = shell("lantern doctor --json");
  EXPECT_EQ(doctor.code, 0);
  EXPECT_EQ(json::parse(doctor.out)["backends"].size(), 2u);
}

TEST(CommandLine, CompareTellsEqualFromDifferent) {
  const fs::path out = fresh_folder("compare");
  ASSERT_EQ(shell("lantern render " + kGhosts + kSmall + "-o " + out.string()).code, 0);
  const fs::path frames = out / "ghost_quadtree";
  const std::string a = (frames / "ghost_quadtree_0000.png").string();
  const std::string b = (frames / "ghost_quadtree_0001.png").string();
  EXPECT_EQ(shell("lantern compare " + a + " " + a).code, 0);
  EXPECT_EQ(shell("lantern compare " + a + " " + b + " -o " + (out / "d.png").string()).code, 1);
  EXPECT_TRUE(fs::exists(out / "d.png")) << "the difference picture is missing";
  EXPECT_EQ(shell("lantern compare " + a + " " + b + " --tolerance 255").code, 0);
  EXPECT_EQ(shell("lantern compare " + frames.string() + " " + frames.string()).code, 0);
  EXPECT_EQ(shell("lantern compare " + a + " " + kGhosts).code, 1) << "a scenario is no image";
  EXPECT_EQ(shell("lantern compare " + a + " " + frames.string()).code, 2);
}

}  // namespace
}  // namespace lantern::app
