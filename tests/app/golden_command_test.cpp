// `lantern golden` as a user meets it.
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"
#include "render/png.hpp"
#include "rooms.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kScene = R"(panels = ["world"]
title = "Three bodies"
[world]
size = [16, 9]
[structure]
kind = "quadtree"
capacity = 2
max_depth = 1
children = "eager"
[[body]]
name = "ann"
radius = 0.8
position = [3, 6]
[[body]]
name = "bob"
radius = 0.8
position = [6, 7]
[[body]]
name = "cyd"
radius = 0.8
position = [12, 2]
[[step]]
do = "insert"
name = "two"
bodies = ["ann", "bob"]
[[step]]
do = "insert"
name = "split"
bodies = ["cyd"]
)";
const std::string kThirdStep = "[[step]]\ndo = \"show\"\nname = \"third\"\n";
// Into the leaf of the others, which may not split again: the tree stays as it is.
const std::pair<std::string, std::string> kNear = {"[12, 2]", "[4, 7]"};

std::string with(std::string text, const std::pair<std::string, std::string>& change) {
  const std::size_t at = text.find(change.first);
  EXPECT_NE(at, text.npos) << change.first;
  return text.replace(at, change.first.size(), change.second);
}

// A folder with scene.toml, and its golden frames unless they are not wanted.
class GoldenCommand : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name());
    write_text(folder_ / "scene.toml", kScene);
    ASSERT_EQ(golden("--update").code, 0);
  }

  Outcome golden(const std::string& words, const std::string& files = "scene.toml") const {
    return shell("cd " + folder_.string() + " && lantern golden " + files + " --size 128x72 " +
                 words);
  }

  void change(const std::pair<std::string, std::string>& change) const {
    write_text(folder_ / "scene.toml", with(read_text(folder_ / "scene.toml"), change));
  }

  void change_list(const std::pair<std::string, std::string>& change) const {
    write_text(list_file(), with(read_text(list_file()), change));
  }

  fs::path list_file() const { return of_scene("golden.txt"); }
  fs::path of_scene(const std::string& file) const { return folder_ / "golden/scene" / file; }
  bool page_made() const { return fs::exists(folder_ / "output/golden.html"); }

  // Is `words` on standard error? All of it is shown if not.
  static testing::AssertionResult says(const Outcome& o, const std::string& words) {
    if (o.err.find(words) != o.err.npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "'" << words << "' is not in:\n" << o.err;
  }

  fs::path folder_;
};

TEST_F(GoldenCommand, EqualFramesAreOneLineAndNoPage) {
  for (const char* file :
       {"golden.txt", "scene_0000.png", "scene_0000.json", "scene_0001.png", "scene_0001.json"})
    EXPECT_TRUE(fs::exists(of_scene(file))) << file;
  const Outcome o = golden("");
  EXPECT_EQ(o.code, 0);
  EXPECT_TRUE(o.err.ends_with("2 frames of 1 scenario as expected\n")) << o.err;
  EXPECT_FALSE(page_made());
  EXPECT_EQ(golden("--report page/ --junit j/golden.xml").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "page/golden.html")) << "it was asked for";
  EXPECT_TRUE(fs::exists(folder_ / "j/golden.xml"));
}

TEST_F(GoldenCommand, ToldIsWhichFrameDiffersFirstAndInWhichCount) {
  change(kNear);
  const Outcome o = golden("--json");
  EXPECT_EQ(o.code, 1);
  EXPECT_TRUE(says(o,
                   "scene: 1 of 2 frames differs, first frame 1 (split): counts.most_in_leaf: "
                   "expected 2, found 3, and "));
  EXPECT_TRUE(says(o, " pixels differ, at most by "));
  EXPECT_TRUE(says(o, "1 of 1 scenario not as expected; see output/golden.html\n"));
  const json report = json::parse(o.out);
  EXPECT_EQ(report["format"], "lantern.golden/1");
  EXPECT_EQ(report["report"], "output/golden.html");
  const json scene = report["scenarios"][0];
  EXPECT_EQ(scene["good"], false);
  bool pairs = false;
  for (const json& fact : scene["frames_that_differ"][0]["facts"])
    pairs = pairs || fact == json{{"path", "counts.pairs"}, {"expected", "1"}, {"found", "3"}};
  EXPECT_TRUE(pairs) << scene;
}

TEST_F(GoldenCommand, ThePageHoldsThreePicturesOfAFrameAndNeedsNothingElse) {
  change(kNear);
  ASSERT_EQ(golden("--report it.html").code, 1);
  const std::string page = read_text(folder_ / "it.html");
  std::size_t pictures = 0;
  for (std::size_t at = 0; (at = page.find("data:image/png;base64,", at)) != page.npos; ++at)
    ++pictures;
  EXPECT_EQ(pictures, 3u);
  EXPECT_EQ(page.find("http"), page.npos);
  EXPECT_NE(page.find("<th scope=\"row\">counts.pairs</th><td>1</td><td>3</td>"), page.npos);
  EXPECT_NE(page.find("prefers-color-scheme:dark"), page.npos);
}

TEST_F(GoldenCommand, WithoutGoldensItFailsAndDrawsNothing) {
  fs::remove_all(folder_ / "golden");
  const Outcome o = golden("--json");
  EXPECT_EQ(o.code, 1);
  EXPECT_TRUE(says(o, "there are no golden frames in 'golden/scene'; --update makes them"));
  EXPECT_EQ(json::parse(o.out)["work"]["graphics_contexts"], 0);
  EXPECT_FALSE(fs::exists(folder_ / "golden"));
}

TEST_F(GoldenCommand, UpdateWritesOnlyWhatChanged) {
  EXPECT_EQ(golden("--update").err, "scene: the golden frames are as they were\n");
  change(kNear);
  const Outcome o = golden("--update");
  EXPECT_EQ(o.code, 0);
  EXPECT_TRUE(o.err.ends_with("scene: written: scene_0001.png, scene_0001.json, golden.txt\n"))
      << o.err;
  EXPECT_EQ(golden("").code, 0);
}

TEST_F(GoldenCommand, UpdateRemovesWhatIsGoneUnlessSomebodyElseMadeIt) {
  change({"[world]", "[world] # a comment changes no frame"});
  EXPECT_EQ(golden("").code, 0);
  write_text(folder_ / "scene.toml", kScene + kThirdStep);
  const Outcome more = golden("--frames 2");
  EXPECT_EQ(more.code, 1);
  EXPECT_TRUE(says(more, "first frame 2 (third): there is no golden frame of it"));
  ASSERT_EQ(golden("--update").code, 0);
  write_text(folder_ / "scene.toml", kScene);
  write_text(of_scene("scene_0009.png"), "mine");
  const Outcome less = golden("--json");
  EXPECT_EQ(less.code, 1);
  const json differ = json::parse(less.out)["scenarios"][0]["frames_that_differ"];
  EXPECT_EQ(differ.back()["event"], "third");
  EXPECT_EQ(differ.back()["findings"], json::array({"is expected, but the run has no such frame"}));
  const Outcome o = golden("--update");
  EXPECT_TRUE(says(o, "scene: removed: scene_0002.json, scene_0002.png\n"));
  EXPECT_TRUE(says(o, "left alone, since it is not as Lantern made it: scene_0009.png\n"));
  EXPECT_TRUE(fs::exists(of_scene("scene_0009.png")));
  EXPECT_FALSE(fs::exists(of_scene("scene_0002.png")));
  EXPECT_EQ(golden("").code, 0);
}

TEST_F(GoldenCommand, AnotherEncoderChangesNothing) {
  const auto image = decode_png(read_text(of_scene("scene_0001.png")));
  ASSERT_TRUE(image);
  write_text(of_scene("scene_0001.png"), encode_png(*image, PngEffort::fast, {}, 0));
  EXPECT_EQ(golden("").code, 0);
  EXPECT_EQ(golden("--update").err, "scene: the golden frames are as they were\n");
}

TEST_F(GoldenCommand, ToleranceAndFractionAllowForPixels) {
  change({"title = \"Three", "title = \"Tree"});
  EXPECT_EQ(golden("").code, 1);
  EXPECT_EQ(golden("--tolerance 255").code, 0);
  EXPECT_EQ(golden("--fraction 0.5").code, 0);
}

TEST_F(GoldenCommand, ChosenFramesAreComparedAndUpdatedAlone) {
  change(kNear);
  EXPECT_EQ(golden("--frames 0").code, 0) << "frame 1 differs, but was not asked for";
  EXPECT_EQ(golden("--at split").code, 1);
  ASSERT_EQ(golden("--update --frames 1").code, 0);
  EXPECT_EQ(golden("").code, 0) << "frame 0 is still listed";
}

TEST_F(GoldenCommand, OtherSettingsAreToldOnce) {
  const Outcome o = golden("--theme dark --pace event");
  EXPECT_EQ(o.code, 1);
  EXPECT_TRUE(says(o, "scene: the golden frames were made with --theme light --pace step; "));
  const Outcome part = golden("--theme dark --update --frames 0");
  EXPECT_EQ(part.code, 2) << "one folder does not hold frames of two themes";
  EXPECT_EQ(golden("--theme dark --update").code, 0);
  EXPECT_EQ(golden("--theme dark").code, 0);
}

TEST_F(GoldenCommand, AnOlderVersionIsToldOnce) {
  change_list({"facts lantern.frame/2", "facts lantern.frame/1"});
  const Outcome facts = golden("");
  EXPECT_EQ(facts.code, 1);
  EXPECT_TRUE(says(facts, "scene: the golden facts are lantern.frame/1, those of today "));
  ASSERT_EQ(golden("--update").code, 0);
  const std::string list = read_text(list_file());
  change_list({list.substr(list.find("version"), list.find("\nsize") - list.find("version")),
               "version 0.0.1"});
  EXPECT_EQ(golden("").code, 0) << "it draws the same";
  change(kNear);
  EXPECT_TRUE(says(golden(""), "the golden frames are of Lantern 0.0.1, this is "));
}

TEST_F(GoldenCommand, DamagedFilesAreNamedAndMadeAnew) {
  const std::string picture = read_text(of_scene("scene_0000.png"));
  fs::remove(of_scene("scene_0000.png"));
  write_text(of_scene("scene_0001.json"), "{\"format\": ");
  const Outcome o = golden("");
  EXPECT_EQ(o.code, 1);
  EXPECT_TRUE(says(o, "2 of 2 frames differ, first frame 0 (two): scene_0000.png is missing"));
  const Outcome second = golden("--frames 1");
  EXPECT_TRUE(says(second, "first frame 1 (split): scene_0001.json is damaged"));
  ASSERT_EQ(golden("--update").code, 0);
  EXPECT_EQ(read_text(of_scene("scene_0000.png")), picture);
  change(kNear);
  write_text(of_scene("scene_0001.png"), picture.substr(0, picture.size() / 2));
  EXPECT_TRUE(says(golden("--at split"), "its pixels differ, and scene_0001.png is damaged"));
  EXPECT_EQ(golden("--update").code, 0);
  EXPECT_EQ(golden("").code, 0);
}

// An update was interrupted before it came to its list, or one of them was not committed.
TEST_F(GoldenCommand, APictureThatTheListDoesNotTellOfFails) {
  const std::string list = read_text(list_file());
  change(kNear);
  ASSERT_EQ(golden("--update").code, 0);
  write_text(list_file(), list);
  const Outcome o = golden("");
  EXPECT_EQ(o.code, 1);
  EXPECT_TRUE(says(o, "scene_0001.png is not the picture that golden.txt tells of"));
  EXPECT_TRUE(golden("--update").err.ends_with("scene: written: golden.txt\n"));
  EXPECT_EQ(golden("").code, 0);
}

// People look at the picture: it must be the one that was compared.
TEST_F(GoldenCommand, AnotherPictureInItsPlaceFailsThoughTheFrameIsRight) {
  const std::string right = read_text(of_scene("scene_0001.png"));
  write_text(of_scene("scene_0001.png"), read_text(of_scene("scene_0000.png")));
  EXPECT_TRUE(says(golden(""), "scene_0001.png is not the picture that golden.txt tells of"));
  write_text(of_scene("scene_0001.png"), right.substr(0, 100));
  EXPECT_TRUE(says(golden(""), "scene_0001.png is damaged"));
  write_text(of_scene("scene_0001.png"), right);
  EXPECT_EQ(golden("").code, 0);
  write_text(of_scene("scene_0007.png"), right);
  const Outcome o = golden("");
  EXPECT_EQ(o.code, 1);
  EXPECT_TRUE(says(o, "scene_0007.png is of no golden frame; --update removes it"));
}

TEST_F(GoldenCommand, WritesOverNoScenario) {
  const std::string text = read_text(folder_ / "scene.toml");
  for (const char* words : {"--report scene.toml", "--junit scene.toml", "--junit -",
                            "--junit both.xml --report both.xml"})
    EXPECT_EQ(golden(words).code, 2) << words;
  EXPECT_EQ(read_text(folder_ / "scene.toml"), text);
}

TEST_F(GoldenCommand, ADamagedListIsMadeAnewAndAForeignOneStays) {
  const std::string list = read_text(list_file());
  write_text(list_file(), "lantern.golden_frames/1\n<<<<<<< mine\n");
  const Outcome o = golden("");
  EXPECT_EQ(o.code, 1);
  EXPECT_TRUE(says(o, "'golden/scene/golden.txt' is damaged in line 2; --update makes it anew"));
  EXPECT_EQ(golden("--update --frames 0").code, 1) << "the others would be lost";
  std::string other = list;
  write_text(list_file(), other.insert(list.find("frame 0") + 6, "0"));
  EXPECT_TRUE(says(golden(""), "line 7 is not as Lantern writes it: frame 00 "));
  EXPECT_EQ(golden("--update").code, 0);
  EXPECT_EQ(read_text(list_file()), list);
  write_text(list_file(), "My golden rules\n");
  EXPECT_EQ(golden("").code, 1);
  const Outcome foreign = golden("--update");
  EXPECT_EQ(foreign.code, 1);
  EXPECT_TRUE(says(foreign, "is not Lantern's"));
  EXPECT_EQ(read_text(list_file()), "My golden rules\n");
  write_text(list_file(), "lantern.golden_frames/2\n");
  EXPECT_TRUE(says(golden("--update"), "is of a later Lantern: lantern.golden_frames/2"));
}

TEST_F(GoldenCommand, WhatCannotBeWrittenIsToldAndTheListStays) {
  fs::remove_all(folder_ / "golden");
  write_text(folder_ / "golden", "a file");
  const Outcome o = golden("--update");
  EXPECT_EQ(o.code, 1);
  EXPECT_TRUE(says(o, "cannot make the folder 'golden'"));
  EXPECT_EQ(read_text(folder_ / "golden"), "a file");
  EXPECT_EQ(golden("--junit scene.toml/a.xml").code, 1);
  EXPECT_EQ(golden("--junit .").code, 2);
}

TEST_F(GoldenCommand, AScenarioWithAnErrorLetsTheOthersRun) {
  write_text(folder_ / "wrong.toml", with(kScene, {"capacity", "capcity"}));
  write_text(folder_ / "other.toml", kScene);
  EXPECT_EQ(golden("--update", "other.toml").code, 0);
  const Outcome o = golden("--junit golden.xml", "wrong.toml scene.toml gone.toml other.toml");
  EXPECT_EQ(o.code, 3);
  EXPECT_TRUE(says(o, "did you mean 'capacity'?"));
  EXPECT_TRUE(says(o, "2 of 4 scenarios not as expected"));
  const std::string xml = read_text(folder_ / "golden.xml");
  EXPECT_NE(
      xml.find("<testsuites name=\"lantern golden\" tests=\"6\" failures=\"0\" errors=\"2\">"),
      xml.npos)
      << xml;
  EXPECT_NE(xml.find("<error type=\"golden\" message=\"wrong.toml:7:1: error: unknown key"),
            xml.npos)
      << xml;
  fs::create_directory(folder_ / "b");
  write_text(folder_ / "b/scene.toml", kScene);
  const Outcome twice = golden("", "scene.toml b/scene.toml");
  EXPECT_EQ(twice.code, 2);
  EXPECT_TRUE(says(twice, "'scene.toml' and 'b/scene.toml' are both scenarios named 'scene'"));
}

TEST_F(GoldenCommand, AnUnmetExpectationFailsWithItsPlace) {
  change({"name = \"split\"", "name = \"split\"\nexpect = { pairs = 7 }"});
  const Outcome o = golden("--junit golden.xml");
  EXPECT_EQ(o.code, 1);
  EXPECT_TRUE(says(o, "expected pairs = 7, found 1"));
  EXPECT_NE(read_text(folder_ / "golden.xml").find("<testcase name=\"expectations\""),
            std::string::npos);
}

TEST_F(GoldenCommand, AnInterruptedUpdateLeavesNoListOfFramesThatAreNotThere) {
  const Outcome o = shell("cd " + folder_.string() + "; begin golden --update --size 128x72 " +
                          repository("tests/cases/walls300ev.toml").string() +
                          " 2>said; until_so 'grep -q walls300ev said'; interrupt");
  EXPECT_EQ(o.code, 130) << o.err;
  EXPECT_FALSE(fs::exists(folder_ / "golden/walls300ev/golden.txt"));
}

TEST_F(GoldenCommand, WithoutGraphicsItEndsWithFour) {
  const Outcome o =
      shell("export LD_LIBRARY_PATH=" LANTERN_FAKES "/without_symbol; cd " + folder_.string() +
            " && lantern golden scene.toml --size 128x72 --backend osmesa");
  EXPECT_EQ(o.code, 4) << o.err;
}

}  // namespace
}  // namespace lantern::app
