// Lantern between other programs: standard input, folders, silence, colour, help.
#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kThumbnail = " --size 160x90 ";

std::string lesson(const std::string& title, const std::string& more = "") {
  return "title = \"" + title + "\"\n" + more + "[[step]]\ndo = \"show\"\n";
}

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// --- standard input ---

TEST(StandardInput, IsAScenarioLikeAnyOther) {
  const fs::path out = fresh_folder("stdin");
  const Outcome check = shell("cat " + kGhosts + " | lantern check -");
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_NE(check.err.find("<stdin>: good; 8 frames"), std::string::npos) << check.err;
  const Outcome render =
      shell("cat " + kGhosts + " | lantern render -" + kThumbnail + "-o " + out.string());
  EXPECT_EQ(render.code, 0) << render.err;
  EXPECT_TRUE(fs::exists(out / "stdin" / "stdin_0007.png"));
  EXPECT_EQ(shell("cat " + kGhosts + " | lantern explain --json -").code, 0);
  const Outcome picture =
      shell("cat " + kGhosts + " | lantern render - -o - --at three" + kThumbnail + "--format svg");
  EXPECT_EQ(picture.code, 0) << picture.err;
  EXPECT_NE(picture.out.find("<svg"), std::string::npos);
}

TEST(StandardInput, HasPlacesInDiagnostics) {
  const Outcome o = shell("printf 'title = \"t\"\\n[[step]]\\ndo = \"shw\"\\n' | lantern check -");
  EXPECT_EQ(o.code, 3);
  EXPECT_EQ(o.err.rfind("<stdin>:3:6: error: there is no verb 'shw'", 0), 0u) << o.err;
  EXPECT_EQ(shell("lantern check - </dev/null").code, 3) << "an empty file";
}

TEST(StandardInput, CanBeReadOnce) {
  for (const char* command : {"check", "render"}) {
    const Outcome o = shell(std::string("lantern ") + command + " - - <" + kGhosts);
    EXPECT_EQ(o.code, 2);
    EXPECT_NE(o.err.find("once"), std::string::npos) << o.err;
  }
  const Outcome closed = shell("lantern check - <&-");
  EXPECT_EQ(closed.code, 1) << closed.err;
  EXPECT_NE(closed.err.find("cannot read standard input: it is closed"), std::string::npos)
      << closed.err;
  const Outcome folder = shell("lantern check - </tmp");
  EXPECT_NE(folder.err.find("cannot read standard input: Is a directory"), std::string::npos)
      << folder.err;
}

// --- folders ---

// Three lessons, one of them without a place, and what is none.
fs::path lessons(const std::string& name) {
  const fs::path folder = fresh_folder(name);
  write_text(folder / "b.toml", lesson("b", "lecture = 2\n"));
  write_text(folder / "c.toml", lesson("c", "lecture = 1\n"));
  write_text(folder / "a.toml", lesson("a"));
  write_text(folder / "pyproject.toml", "[project]\nname = \"x\"\n");
  write_text(folder / "notes.txt", "nothing");
  fs::create_directories(folder / "deeper");
  write_text(folder / "deeper" / "d.toml", "this is not looked at");
  return folder;
}

TEST(Folders, StandForTheirScenariosInTheOrderOfTheLecture) {
  const fs::path folder = lessons("folders");
  for (const char* command : {"check", "list", "render"}) {
    const Outcome o = shell(
        std::string("lantern ") + command + " --json " + folder.string() +
        (command == std::string("render") ? kThumbnail + "-o " + (folder / "out").string() : ""));
    EXPECT_EQ(o.code, 0) << command << o.err;
    const json answer = json::parse(o.out);
    std::string order;
    for (const json& s : answer["scenarios"])
      order += s.contains("name") ? std::string(s["name"]) : std::string(s["scenario"]);
    EXPECT_EQ(order, "cba") << command;
    ASSERT_EQ(answer["diagnostics"].size(), 1u) << command;
    const std::string told = answer["diagnostics"][0]["message"];
    EXPECT_NE(told.find("pyproject.toml' is no scenario"), std::string::npos) << told;
  }
}

TEST(Folders, AnEmptyOneIsTold) {
  const fs::path folder = fresh_folder("folders-empty");
  for (const char* command : {"check", "list", "render"}) {
    const Outcome o = shell(std::string("lantern ") + command + " " + folder.string());
    EXPECT_EQ(o.code, 2) << command;
    EXPECT_NE(o.err.find("no scenario in the folder"), std::string::npos) << o.err;
  }
  write_text(folder / "bad.toml", "title = 'a\n");
  EXPECT_EQ(shell("lantern check " + folder.string()).code, 3) << "a broken one is no stranger";
}

TEST(Folders, TheOnesThatComeWithLanternAreFoundFromAnywhere) {
  const Outcome here = shell("cd /; lantern list");
  EXPECT_EQ(here.code, 0) << here.err;
  EXPECT_NE(here.out.find("ghost_quadtree"), std::string::npos);
}

// --- quiet ---

TEST(Quiet, LeavesErrorsAndWarningsOnly) {
  const fs::path out = fresh_folder("quiet");
  const std::string render = "render " + kGhosts + kThumbnail + "--frames 0 -o " + out.string();
  for (const std::string& words :
       {"--quiet " + render, render + " --quiet", "--quiet check " + kGhosts,
        "check --quiet " + kGhosts, std::string("compare --quiet a.png a.png")}) {
    const Outcome o = shell("cd " + out.string() + "; cp ghost_quadtree/*0.png a.png 2>/dev/null;" +
                            "lantern " + words);
    EXPECT_EQ(o.code, 0) << words;
    EXPECT_EQ(o.out + o.err, "") << words;
  }
  const Outcome list = shell("lantern list --quiet " + repository("scenarios").string());
  EXPECT_GT(lines_in(list.out), 20u) << "what was asked for is no chatter";
  EXPECT_NE(shell("lantern check --quiet no/such.toml").err.find("no/such.toml"),
            std::string::npos);
}

// --- colour ---

TEST(Color, IsAsToldElseAsTheVariablesSay) {
  const auto is_red = [](const std::string& before, const std::string& words) {
    const Outcome o = shell(before + " lantern " + words);
    EXPECT_NE(o.code, 0);
    return o.err.find("\033[1;31merror:") != std::string::npos;
  };
  const std::string unset = "unset NO_COLOR CLICOLOR_FORCE; ";
  EXPECT_FALSE(is_red(unset, "check no.toml")) << "standard error is no terminal";
  EXPECT_TRUE(is_red(unset, "check no.toml --color always"));
  EXPECT_TRUE(is_red(unset, "--color=always check no.toml"));
  EXPECT_TRUE(is_red(unset, "--color always chek no.toml")) << "a mistake of the command line, too";
  const std::string force = unset + "export CLICOLOR_FORCE=1; ";
  EXPECT_TRUE(is_red(force, "check no.toml"));
  EXPECT_FALSE(is_red(force, "check no.toml --color never"));
  EXPECT_FALSE(is_red(unset + "export CLICOLOR_FORCE=0; ", "check no.toml"));
  EXPECT_FALSE(is_red(force + "export NO_COLOR=1; ", "check no.toml"));
  EXPECT_TRUE(is_red(force + "export NO_COLOR=; ", "check no.toml")) << "empty is not set";
  EXPECT_EQ(shell("lantern check --color pink x").code, 2);
}

// --- help ---

TEST(Help, IsTheSameHoweverItIsAskedFor) {
  for (const char* words : {"", "check", "render", "bench", "bench step", "help"}) {
    const Outcome by_option = shell(std::string("lantern ") + words + " --help");
    const Outcome by_command = shell(std::string("lantern help ") + words);
    EXPECT_EQ(by_option.code, 0) << words;
    EXPECT_EQ(by_command.code, 0) << words << by_command.err;
    EXPECT_EQ(by_command.out, by_option.out) << words;
  }
  for (const auto& [words, hint] :
       {std::pair{"help chek", "did you mean 'check'?"}, std::pair{"bench stp", "'step'"},
        std::pair{"help bench stp", "'step'"}, std::pair{"--quiet chek x", "'check'"},
        std::pair{"--memory 1G chek x", "'check'"}}) {
    const Outcome o = shell(std::string("lantern ") + words);
    EXPECT_EQ(o.code, 2) << words;
    EXPECT_NE(o.err.find(hint), std::string::npos) << words << ": " << o.err;
  }
}

// --- pipes ---

TEST(Pipes, AReaderThatHasSeenEnoughHearsNothingOfAnyCommand) {
  for (const char* words :
       {"check --json scenarios/ghost_quadtree.toml", "explain scenarios/ghost_quadtree.toml",
        "explain --json scenarios/ghost_quadtree.toml", "doctor", "help", "list --json",
        "measure --list", "stress --list --json", "reference", "schema --of output",
        "render scenarios/ghost_quadtree.toml -o - --at three"}) {
    const Outcome o = shell("cd " LANTERN_ROOT "; unread lantern --quiet " + std::string(words));
    EXPECT_EQ(o.code, 1) << words;
    EXPECT_EQ(o.err, "") << words;
  }
}

// --- words ---

TEST(Words, OneIsOne) {
  const fs::path folder = fresh_folder("one");
  write_text(folder / "one.toml", lesson("one"));
  const std::string file = (folder / "one.toml").string();
  EXPECT_EQ(shell("lantern check " + file).err, file + ": good; 1 frame, 0 expectations hold\n");
  EXPECT_NE(shell("lantern explain " + file).out.find(": 1 frame in"), std::string::npos);
  const Outcome render =
      shell("lantern render " + file + kThumbnail + "-o " + (folder / "out").string());
  EXPECT_NE(render.err.find("one: 1 frame in "), std::string::npos) << render.err;
}

TEST(Words, WhatIsToStandardOutputSaysWhichFramesWereChosen) {
  const Outcome o = shell("lantern render " + kGhosts + kThumbnail + "--frames 2-5 -o -");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("4 are chosen, from 2 to 5; --frames 5"), std::string::npos) << o.err;
}

TEST(Words, AMeasurementOfNothingLeavesNothing) {
  const fs::path folder = fresh_folder("measured-nothing");
  const Outcome o = shell("cd " + folder.string() +
                          "; lantern measure kepler --no-peers --quick --method velocity_verlet "
                          "--step 1e-9 --longest 0.001 -o new/er");
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_FALSE(fs::exists(folder / "new"));
}

}  // namespace
}  // namespace lantern::app
