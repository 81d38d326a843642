// The example project: a student's quadtree in the program that she builds, from the check to the
// picture, and the same with a mistake in it.
#include <regex>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kMine = LANTERN_ROOT "/tests/example/mine.toml";

Outcome my_tree(const std::string& words) { return shell(LANTERN_EXAMPLE " " + words); }

std::string replaced(const std::string& text, const std::string& what, const std::string& by) {
  return std::regex_replace(text, std::regex(what), by);
}

json frame_of(const fs::path& folder, const std::string& name, int index) {
  return json::parse(read_text(folder / name / (name + "_000" + std::to_string(index) + ".json")));
}

TEST(OwnStructureProgram, TheRightTreePassesTheCheck) {
  const Outcome check = my_tree("structure check mine --worlds 150");
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_NE(check.err.find("mine: good; in 150 worlds the pairs are those of brute force"),
            std::string::npos)
      << check.err;
}

TEST(OwnStructureProgram, TheWrongTreeIsCaughtOnASmallWorldThatCanBeDrawn) {
  const fs::path out = fresh_folder("own_wrong");
  const Outcome check =
      my_tree("structure check wrong --worlds 60 --json -o " + (out / "found").string());
  EXPECT_EQ(check.code, 1);
  const json facts = json::parse(check.out).at("structures").at(0);
  EXPECT_EQ(facts.at("name"), "wrong");
  EXPECT_LE(facts.at("bodies").size(), 2u);
  const std::string fault = facts.at("fault");
  EXPECT_NE(fault.find("structure 'wrong': node "), std::string::npos) << fault;
  const std::string file = facts.at("scenario");
  const Outcome render = my_tree("render " + file + " --format svg -o " + out.string());
  EXPECT_EQ(render.code, 1) << render.err;
  EXPECT_NE(render.err.find("wrong_fails.toml:"), std::string::npos) << render.err;
  EXPECT_NE(render.err.find(", which reaches it: its box goes from"), std::string::npos)
      << render.err;
  EXPECT_TRUE(fs::exists(out / "wrong_fails" / "wrong_fails_0000.svg"));
}

TEST(OwnStructureProgram, HerFramesSayWhatOursSay) {
  const fs::path out = fresh_folder("own_frames");
  const std::string text = read_text(kMine);
  write_text(out / "hers.toml", text);
  write_text(out / "ours.toml",
             replaced(text, "kind = \"mine\"", "kind = \"quadtree\"\nchildren = \"eager\""));
  const Outcome render = my_tree("render " + (out / "hers.toml").string() + " " +
                                 (out / "ours.toml").string() + " --format svg -o " + out.string());
  ASSERT_EQ(render.code, 0) << render.err;
  for (int i = 0; i < 4; ++i) {
    const json hers = frame_of(out, "hers", i), ours = frame_of(out, "ours", i);
    EXPECT_EQ(hers.at("hash"), ours.at("hash")) << i;
    for (const char* part : {"nodes", "pairs", "bodies"})
      EXPECT_EQ(hers.at(part), ours.at(part)) << part << " of frame " << i;
    EXPECT_FALSE(hers.at("counts").contains("box_tests")) << "nobody counts them";
  }
}

TEST(OwnPanelProgram, APanelInOneFileIsDrawnToldAndTallied) {
  const fs::path out = fresh_folder("own_panel");
  const std::string text = read_text(kMine);
  write_text(out / "with.toml", "panels = [\"world\", \"speeds\"]\n" + text);
  write_text(out / "without.toml", "panels = [\"world\"]\n" + text);
  for (const char* name : {"with", "without"})
    ASSERT_EQ(
        my_tree("render " + (out / name).string() + ".toml --format svg -o " + out.string()).code,
        0);
  const json with = frame_of(out, "with", 3), without = frame_of(out, "without", 3);
  EXPECT_EQ(with.at("speeds").size(), 4u);
  EXPECT_EQ(with.at("speeds").at(0).at("name"), "red");
  EXPECT_FALSE(without.contains("speeds"));
  EXPECT_EQ(with.at("bodies"), without.at("bodies"));
  const auto picture = [&](const std::string& name) {
    return read_text(out / name / (name + "_0003.svg"));
  };
  EXPECT_NE(picture("with").size(), picture("without").size());
  const Outcome tally = my_tree("explain " + (out / "with.toml").string());
  EXPECT_NE(tally.out.find("speeds panel"), std::string::npos) << tally.out;
  EXPECT_EQ(shell("lantern check " + (out / "with.toml").string()).code, 3)
      << "only her program knows it";
}

TEST(OwnPanelProgram, ACountInOneFileIsQuotedAndExpected) {
  const fs::path out = fresh_folder("own_count");
  const std::string text =
      replaced(replaced(read_text(kMine), "A ray visits only", "{moving:body moves}. A ray visits"),
               "hits = 1", "hits = 1, moving = 1");
  const std::string moves = replaced(text, "radius = 4", "radius = 4\nvelocity = [1, 0]");
  const auto check = [&](const std::string& panels, const std::string& scenario) {
    write_text(out / "count.toml", "panels = [" + panels + "]\n" + scenario);
    return my_tree("check " + (out / "count.toml").string());
  };
  EXPECT_EQ(check("\"world\", \"speeds\"", moves).code, 0);
  EXPECT_EQ(check("\"world\", \"speeds\"", text).code, 1) << "nobody moves";
  const Outcome early = check("\"world\"", moves);
  EXPECT_EQ(early.code, 3);
  EXPECT_NE(early.err.find("there is no panel 'speeds'"), std::string::npos) << early.err;
}

TEST(OwnStructureProgram, ItsEventsAreFrames) {
  const fs::path out = fresh_folder("own_events");
  const Outcome render =
      my_tree("render " + kMine + " --pace event --at split --format svg -o " + out.string());
  EXPECT_EQ(render.code, 0) << render.err;
  EXPECT_FALSE(fs::is_empty(out / "mine"));
}

TEST(OwnStructureProgram, AStepWhoseFramesAreEventsIsTakenWhole) {
  const fs::path out = fresh_folder("own_step");
  write_text(out / "paced.toml",
             replaced(read_text(kMine), "name = \"three\"", "name = \"three\"\npace = \"event\""));
  const std::string at = "render " + (out / "paced.toml").string() + " --at three ";
  EXPECT_EQ(my_tree(at + "--format svg -o " + out.string()).code, 0);
  EXPECT_GT(std::distance(fs::directory_iterator(out / "paced"), {}), 5) << "frames of events";
  EXPECT_EQ(my_tree(at + "-o " + (out / "one.svg").string()).code, 0) << "the step's last";
}

TEST(OwnStructureProgram, BenchTimesItBesideOurs) {
  const Outcome bench = my_tree("structure bench mine quadtree --bodies 40 --rounds 2 --json");
  ASSERT_EQ(bench.code, 0) << bench.err;
  const json rows = json::parse(bench.out).at("rows");
  ASSERT_EQ(rows.size(), 9u);  // brute force too, and three scenes
  for (const json& row : rows) {
    EXPECT_EQ(row.at("missed"), 0);
    EXPECT_GT(row.at("build_s"), 0.0);
  }
  EXPECT_EQ(rows[1].at("structure"), "mine");
  EXPECT_EQ(my_tree("structure bench wrong --bodies 200 --rounds 1").code, 1);
  const Outcome pairs =
      my_tree("bench pairs --workload uniform_2d --bodies 200 --rounds 1 --only wrong --no-peers");
  EXPECT_EQ(pairs.code, 1);
  EXPECT_NE(pairs.out.find("wrong: "), std::string::npos) << pairs.out;
}

// What came of `structure check` of one of tests/broken/, in 28 worlds.
json checked_broken(const std::string& name, const fs::path& out, std::string* said = nullptr) {
  const Outcome check = shell(LANTERN_BROKEN " structure check " + name +
                              " --worlds 28 --limit 0.2 --json -o " + out.string());
  EXPECT_EQ(check.code, 1) << check.err;
  if (said != nullptr) *said = check.err;
  return json::parse(check.out).at("structures").at(0);
}

TEST(BrokenStructures, WhatHangsIsToldShrunkAndDrawnUpToThere) {
  const fs::path out = fresh_folder("own_hangs");
  std::string said;
  const json facts = checked_broken("hangs", out, &said);
  EXPECT_EQ(facts.at("fault"), "structure 'hangs': insert of b2 did not return in 0.2 s");
  EXPECT_EQ(facts.at("bodies").size(), 2u);
  EXPECT_EQ(facts.at("failed"), 1) << "the others are not waited for";
  const std::string file = facts.at("scenario");
  EXPECT_EQ(file, (out / "hangs_hangs.toml").string());
  EXPECT_NE(said.find("world of 2 bodies in " + file), std::string::npos) << said;
  const Outcome render =
      shell(LANTERN_BROKEN " render " + file + " --format svg -o " + out.string());
  EXPECT_EQ(render.code, 0) << render.err;
  EXPECT_TRUE(fs::exists(out / "hangs_hangs" / "hangs_hangs_0000.svg"));
}

TEST(BrokenStructures, CrashesAndSplitsForEverAreTold) {
  const fs::path out = fresh_folder("own_crashes");
  for (const auto& [name, why] : {std::pair("crashes", "a null pointer was followed"),
                                  std::pair("splits", "does it call itself for ever?"),
                                  std::pair("fills", "more memory than there was")}) {
    const json facts = checked_broken(name, out);
    const std::string fault = facts.at("fault");
    EXPECT_NE(fault.find("insert of b2 "), std::string::npos) << fault;
    EXPECT_EQ(facts.at("bodies").size(), 2u) << name;
#if !defined(__SANITIZE_ADDRESS__)  // tells of them in its own words, and knows no limit of memory
    EXPECT_NE(fault.find(why), std::string::npos) << fault;
#endif
  }
}

TEST(BrokenStructures, BenchTellsThemBesideTheOthers) {
  const Outcome bench =
      shell(LANTERN_BROKEN " structure bench hangs --limit 0.2 --bodies 40 --rounds 1 --json");
  EXPECT_EQ(bench.code, 1) << bench.err;
  const json rows = json::parse(bench.out).at("rows");
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[5].at("scene"), "coincident_2d");
  EXPECT_EQ(rows[5].at("fault"), "structure 'hangs': insert of body 13 did not return in 0.2 s");
}

TEST(BrokenStructures, BenchGoesOnWithoutWhatCrashesInATurn) {
  const Outcome bench =
      shell(LANTERN_BROKEN " structure bench tires searches --bodies 40 --rounds 3 --json");
  EXPECT_EQ(bench.code, 1) << bench.err;
  const json rows = json::parse(bench.out).at("rows");
  ASSERT_EQ(rows.size(), 9u);
  const std::string fault = rows[1].at("fault");
  EXPECT_EQ(fault.rfind("structure 'tires': a timed turn crashed", 0), 0u) << fault;
  for (const int other : {0, 2}) EXPECT_GT(rows[other].at("build_s"), 0.0) << other;
}

TEST(BrokenStructures, WhatGoesWrongOutsideOfInsertIsToldByItsCall) {
  const fs::path out = fresh_folder("own_calls");
  std::string said;
  EXPECT_EQ(checked_broken("lingers", out).at("fault"),
            "structure 'lingers': its destructor did not return in 0.2 s");
  checked_broken("unmade", out, &said);
  EXPECT_NE(said.find("its constructor threw: not yet written"), std::string::npos) << said;
  checked_broken("pairs_itself", out, &said);
  EXPECT_NE(said.find("is no pair with itself"), std::string::npos) << said;
  const fs::path file = out / "file";
  write_text(file, "");
  const Outcome check =
      shell(LANTERN_BROKEN " structure check unmade --worlds 1 -o " + file.string());
  EXPECT_EQ(check.code, 1);
  EXPECT_NE(check.err.find("its constructor threw"), std::string::npos) << check.err;
}

TEST(OwnStructureProgram, OneOfRepeatedStepsIsTheLast) {
  const fs::path out = fresh_folder("own_repeat");
  write_text(out / "twice.toml", read_text(kMine) +
                                     "\n[[step]]\ndo = \"run\"\nname = \"on\"\nseconds = "
                                     "0.1\nrepeat = 3\n");
  const Outcome render = my_tree("render " + (out / "twice.toml").string() + " --at on -o " +
                                 (out / "one.svg").string());
  EXPECT_EQ(render.code, 0) << render.err;
}

// Flushed, so that it is there however the copy ends.
TEST(BrokenStructures, WhatHerCodeWritesReachesHer) {
  std::string said;
  checked_broken("fills", fresh_folder("own_words"), &said);
  EXPECT_NE(said.find("two coincide\n"), std::string::npos) << said;
}

TEST(BrokenStructures, SearchesOfTheirOwnAreHeldAgainstBruteForceAndTimed) {
  const fs::path out = fresh_folder("own_searches");
  EXPECT_EQ(shell(LANTERN_BROKEN " structure check searches --worlds 100").code, 0);
  std::string said;
  EXPECT_EQ(checked_broken("loses_hits", out, &said).at("bodies").size(), 2u);
  EXPECT_NE(said.find("misses b2, which it meets"), std::string::npos) << said;
  EXPECT_EQ(checked_broken("loses_pairs", out, &said).at("bodies").size(), 2u);
  EXPECT_NE(said.find("its pair search: b1 and b2 overlap"), std::string::npos) << said;
  const Outcome render =
      shell(LANTERN_BROKEN " render " + (out / "loses_pairs_fails.toml").string() +
            " --format svg -o " + out.string());
  EXPECT_EQ(render.code, 1) << render.err;
  for (const char* name : {"loses_hits", "loses_pairs"})
    EXPECT_EQ(shell(LANTERN_BROKEN " check " + (out / name).string() + "_fails.toml").code, 1)
        << "it tells what brute force finds";
  EXPECT_NE(read_text(out / "loses_pairs_fails" / "loses_pairs_fails_0000.svg").find("#b3261e"),
            std::string::npos)
      << "her own search draws its pairs";
  const Outcome bench =
      shell(LANTERN_BROKEN " structure bench searches crashes --bodies 9 --rounds 1 --json");
  const json rows = json::parse(bench.out).at("rows");
  EXPECT_GT(rows.at(1).at("rays_s"), 0.0);
  EXPECT_FALSE(rows.at(2).contains("rays_s")) << "it has no ray";
}

TEST(OwnStructureProgram, AMissedPairIsMarked) {
  const fs::path out = fresh_folder("own_missed");
  ASSERT_EQ(my_tree("structure check wrong --worlds 60 -o " + out.string()).code, 1);
  my_tree("render " + (out / "wrong_fails.toml").string() + " --format svg -o " + out.string());
  EXPECT_NE(read_text(out / "wrong_fails" / "wrong_fails_0000.svg").find("#b3261e"),
            std::string::npos);
}

TEST(OwnStructureProgram, ItIsOneOfTheKindsThere) {
  EXPECT_NE(my_tree("structure list").out.find("my quadtree"), std::string::npos);
  EXPECT_NE(my_tree("schema").out.find("\"mine\""), std::string::npos);
  EXPECT_EQ(shell("lantern schema").out.find("\"mine\""), std::string::npos);
}

TEST(OwnStructureProgram, WithoutHerProgramItIsNotKnown) {
  const Outcome check = shell("lantern check " + kMine);
  EXPECT_EQ(check.code, 3);
  EXPECT_NE(check.err.find("mine.toml:9:8: error: 'kind' cannot be 'mine'"), std::string::npos)
      << check.err;
  EXPECT_NE(check.err.find("quadtree"), std::string::npos) << check.err;
  EXPECT_NE(check.err.find("for a structure of your own see"), std::string::npos) << check.err;
  const Outcome unknown = shell("lantern structure check quadtre");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("did you mean 'quadtree'?"), std::string::npos) << unknown.err;
  EXPECT_EQ(shell("lantern structure check octree").code, 2);
}

}  // namespace
}  // namespace lantern::app
