// Runs in parts: which part has what, and that they are one run when they are merged.
#include "app/folders/shard.hpp"

#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/folders/kept_files.hpp"
#include "app/process.hpp"
#include "app/terminal.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

using Tree = std::map<std::string, std::string>;

Tree tree_of(const fs::path& folder) {
  Tree tree;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      tree[fs::relative(entry.path(), folder).string()] = read_text(entry.path());
  return tree;
}

void expect_same(const fs::path& expected, const fs::path& actual) {
  const Tree a = tree_of(expected), b = tree_of(actual);
  for (const auto& [name, bytes] : a)
    EXPECT_TRUE(b.contains(name) && b.at(name) == bytes) << name << " differs or is missing";
  EXPECT_EQ(a.size(), b.size());
}

// --- the cut ---

using Counts = std::vector<std::optional<std::uint64_t>>;

TEST(Shard, WordsThatNameNoneAreRefused) {
  EXPECT_FALSE(parse_shard(""));
  EXPECT_EQ(parse_shard("2/4"), (Shard{2, 4}));
  EXPECT_EQ(parse_shard("1/1"), (Shard{1, 1}));
  for (const char* words :
       {"0/3", "4/3", "a/b", "1/0", "1", "1/", "/2", "-1/2", "1/2/3", " 1/2", "1/99999", "1.5/2"})
    EXPECT_THROW(parse_shard(words), UsageError) << words;
}

// Whatever the true lengths are: those that are known beforehand are upper bounds.
TEST(Shard, EveryFrameBelongsToOneShard) {
  const Counts known = {7, 300, std::nullopt, 1, 0, 12, 12, 12, 40};
  const std::vector<std::uint64_t> real = {7, 300, 23, 1, 0, 11, 12, 5, 40};
  for (const std::uint32_t of : {1u, 2u, 3u, 4u, 7u, 64u})
    for (std::size_t i = 0; i < known.size(); ++i)
      for (std::uint64_t k = 0; k < real[i]; ++k) {
        int owners = 0;
        for (std::uint32_t n = 1; n <= of; ++n) owners += parts_of({n, of}, known)[i].has(k);
        ASSERT_EQ(owners, 1) << "frame " << k << " of " << i << ", " << of << " shards";
      }
}

std::vector<std::uint64_t> loads(const Counts& frames, std::uint32_t of) {
  std::vector<std::uint64_t> loads;
  for (std::uint32_t n = 1; n <= of; ++n) {
    const std::vector<Part> parts = parts_of({n, of}, frames);
    std::uint64_t load = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) load += parts[i].count(*frames[i]);
    loads.push_back(load);
  }
  return loads;
}

TEST(Shard, TheWorkIsBalanced) {
  const auto expect_balanced = [](const Counts& frames, std::uint32_t of, std::uint64_t most) {
    const auto loaded = loads(frames, of);
    const auto [least, highest] = std::ranges::minmax(loaded);
    EXPECT_LE(highest - least, most) << of;
  };
  expect_balanced({1000}, 16, 1);
  expect_balanced({10, 10, 10}, 4, 1);  // the remainders do not all fall to the first
  Counts course;
  for (std::uint64_t i = 0; i < 200; ++i) course.push_back(5 + i * 7 % 31);
  for (const std::uint32_t of : {2u, 5u, 16u}) expect_balanced(course, of, 10);
}

// Of which each shard that draws anything must take all steps.
TEST(Shard, ShortScenariosStayWhole) {
  Counts course(200, 10);
  const std::vector<Part> parts = parts_of({1, 4}, course);
  for (const Part& part : parts) EXPECT_TRUE(part.is_all() || part.is_none());
}

TEST(Shard, ACommandIsGivenForAnotherShard) {
  EXPECT_EQ(command_for({"render", "my file.toml", "--shard", "1/4"}, {2, 4}),
            "lantern render 'my file.toml' --shard 2/4");
  EXPECT_EQ(command_for({"render", "it's.toml", "--shard=1/4"}, {3, 4}),
            "lantern render 'it'\\''s.toml' --shard=3/4");
}

// --- records ---

TEST(ShardRecord, WhatIsWrittenIsReadBack) {
  ShardRecord r = new_record({2, 3});
  r.settings = {{"frames", ""},          {"at", ""},
                {"pace", "event"},       {"size", "160x90"},
                {"theme", "dark"},       {"format", "svg"},
                {"png", "fast"},         {"tween", ""},
                {"tween digits", "2"},   {"transparent", "no"},
                {"switches", "no-title"}};
  r.inputs = {{*ScenarioName::of("pong"), "0123456789abcdef", 7, 9, true}};
  r.words = {"render", "\"quoted\".toml"};
  const ShardRecord read = read_record(to_json(r));
  EXPECT_EQ(to_json(read), to_json(r));
  EXPECT_FALSE(difference(r, read));
  EXPECT_THROW(read_record("{}"), RefusedFile);
  EXPECT_THROW(read_record("{\"format\": \"lantern.shard/1\", "), RefusedFile);
  EXPECT_THROW(read_record(to_json(r) + " "), RefusedFile);
}

TEST(ShardRecord, DifferencesAreNamed) {
  ShardRecord a = new_record({1, 3});
  a.settings = {{"size", "16x9"}};
  a.inputs = {{*ScenarioName::of("pong"), "0123456789abcdef"}};
  const auto words = [&](const auto& change) {
    ShardRecord b = a;
    b.shard.number = 2;
    change(b);
    return difference(a, b).value_or("none");
  };
  EXPECT_EQ(words([](ShardRecord&) {}), "none");
  EXPECT_EQ(words([](ShardRecord& b) { b.settings["size"] = "32x18"; }),
            "the setting 'size' is 16x9 in the first, 32x18 in the second");
  EXPECT_EQ(words([](ShardRecord& b) { b.shard.of = 4; }),
            "the number of shards is 3 in the first, 4 in the second");
  EXPECT_EQ(words([](ShardRecord& b) { b.version = "0.0.1"; }).substr(0, 14), "the version is");
  EXPECT_EQ(words([](ShardRecord& b) { b.sources = "0"; }).substr(0, 29),
            "the program's source hash is ");
  EXPECT_EQ(words([](ShardRecord& b) { b.inputs[0].text = "0"; }),
            "'pong' has another text in the second");
  EXPECT_EQ(words([](ShardRecord& b) { b.inputs[0].name = *ScenarioName::of("other"); }),
            "input 1 is pong in the first, other in the second");
}

// --- render and merge ---

// Six bodies, one after the other, in no time.
std::string six_steps() {
  std::string text =
      "title = \"Six\"\n[world]\nsize = [16, 9]\n"
      "[structure]\nkind = \"quadtree\"\ncapacity = 2\n";
  for (int i = 1; i <= 6; ++i)
    text += fmt::format("[[body]]\nname = \"b{}\"\nradius = 0.5\nposition = [{}, 5]\n", i, 2 * i);
  for (int i = 1; i <= 6; ++i)
    text +=
        fmt::format("[[step]]\ndo = \"insert\"\nbodies = [\"b{}\"]\ncaption = \"Step {}\"\n", i, i);
  return text;
}

// The program: one run, the shards of it, and what came of merging them.
class Shards : public testing::Test {
 protected:
  fs::path home_ = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name());
  std::string render_ = "lantern render " + at("six.toml") + " --size 80x45 ";

  void SetUp() override { write_text(at("six.toml"), six_steps()); }
  std::string at(const std::string& folder) const { return (home_ / folder).string(); }
  Outcome run(const std::string& words, const std::string& folder) const {
    return shell(render_ + words + " -o " + at(folder));
  }
  void run_shards(int of, const std::string& folder, const std::string& words = "") const {
    for (int i = 1; i <= of; ++i) {
      const Outcome o =
          run(words + " --shard " + std::to_string(i) + "/" + std::to_string(of), folder);
      ASSERT_EQ(o.code, 0) << o.err;
    }
  }
  Outcome merge(const std::string& into, const std::string& folders = "parts") const {
    return shell("cd " + home_.string() + " && lantern merge " + into + " " + folders);
  }
};

TEST_F(Shards, OfSeveralScenariosAreOneRun) {
  render_ = "lantern render " + at("six.toml") + " " + scenario("kdtree_atlas") + " " +
            scenario("pong_bsp") + " --size 80x45 ";
  ASSERT_EQ(run("", "one").code, 0);
  run_shards(3, "parts");
  const Outcome o = merge("whole");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(fs::exists(home_ / "one/kdtree_atlas/kdtree_atlas_atlas.png"));
  expect_same(home_ / "one", home_ / "whole");
}

TEST_F(Shards, OfRangesAndInBetweensAreOneRun) {
  const std::string words = "--frames 1-4 --tween 2 --format svg --no-title";
  ASSERT_EQ(run(words, "one").code, 0);
  run_shards(3, "parts", words);
  EXPECT_EQ(merge("whole").code, 0);
  EXPECT_TRUE(fs::exists(home_ / "one/six/six_0003_02.svg"));
  expect_same(home_ / "one", home_ / "whole");
}

// Some have none of its frames, and need no folder for it.
TEST_F(Shards, MayBeMoreThanThereAreFrames) {
  ASSERT_EQ(run("--frames 2", "one").code, 0);
  ASSERT_EQ(run("--frames 2 --shard 1/2", "parts").code, 0);
  const Outcome empty = run("--frames 2 --shard 2/2", "parts");
  EXPECT_EQ(empty.code, 0);
  EXPECT_TRUE(empty.err.ends_with("shard 2/2 is empty: there is too little for 2\n")) << empty.err;
  EXPECT_EQ(merge("whole").code, 0);
  EXPECT_FALSE(fs::exists(home_ / "parts/shard-2-of-2/six"));
  expect_same(home_ / "one", home_ / "whole");
}

TEST_F(Shards, MayShareAFolderWithTheWhole) {
  ASSERT_EQ(run("", "one").code, 0);
  run_shards(2, "parts");
  EXPECT_EQ(merge("parts", "").code, 0);
  expect_same(home_ / "one/six", home_ / "parts/six");
}

TEST_F(Shards, AreMergedTwiceWithNothingToDo) {
  run_shards(2, "parts");
  ASSERT_EQ(merge("whole").code, 0);
  const Tree before = tree_of(home_ / "whole");
  write_text(home_ / "whole/six/notes.txt", "mine");
  const Outcome again = merge("whole", "parts --json");
  EXPECT_EQ(again.code, 0) << again.err;
  const json told = json::parse(again.out);
  EXPECT_EQ(told["format"], "lantern.merge/1");
  EXPECT_EQ(told["scenarios"][0]["written"], 0);
  EXPECT_EQ(told["scenarios"][0]["kept"], 12);
  EXPECT_EQ(read_text(home_ / "whole/six/notes.txt"), "mine");
  fs::remove(home_ / "whole/six/notes.txt");
  EXPECT_EQ(tree_of(home_ / "whole"), before);
}

TEST_F(Shards, AMissingOneIsNamedWithWhatToRun) {
  ASSERT_EQ(run("--shard 1/2", "parts").code, 0);
  const Outcome o = merge("whole");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("shard 2/2 of six is missing: run lantern render "), std::string::npos)
      << o.err;
  EXPECT_NE(o.err.find(" --shard 2/2 -o "), std::string::npos) << o.err;
  EXPECT_FALSE(fs::exists(home_ / "whole")) << "nothing is begun";
}

// A shard that was killed: its record says that it has begun, and it is done again by its name.
TEST_F(Shards, AKilledOneIsNamedAndDoneAgain) {
  ASSERT_EQ(run("", "one").code, 0);
  ASSERT_EQ(run("--shard 2/2", "parts").code, 0);
  // So that it does not end by itself before it is killed: it cannot write to its pipe.
  const Outcome killed =
      shell("mkfifo " + at("pipe") + "; exec 3<>" + at("pipe") +
            "; dd if=/dev/zero bs=65536 count=1 >&3 2>/dev/null\n" + LANTERN_BINARY +
            render_.substr(7) + "--shard 1/2 --json -o " + at("parts") +
            " >&3 & lantern=$!\n"
            "until test -e " +
            at("parts/shard-1-of-2/six/manifest.json") +
            "; do sleep 0.01; done; kill -KILL $lantern; wait $lantern");
  // Whether the kill came before its end or not, one that is not finished is told as such.
  fs::path record = home_ / "parts/shard-1-of-2/shard.json";
  std::string text = read_text(record);
  if (const auto at_word = text.find("\"finished\": true"); at_word != std::string::npos)
    write_text(record, text.replace(at_word, 16, "\"finished\": false"));
  const Outcome o = merge("whole");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("shard 1/2 of six in 'parts/shard-1-of-2' is not finished: run"),
            std::string::npos)
      << o.err;
  ASSERT_EQ(run("--shard 1/2", "parts").code, 0);
  EXPECT_EQ(merge("whole").code, 0);
  expect_same(home_ / "one", home_ / "whole");
}

TEST_F(Shards, OfOtherSettingsOrAnotherTextAreRefused) {
  ASSERT_EQ(run("--shard 1/2", "a").code, 0);
  ASSERT_EQ(run("--shard 2/2 --theme dark", "b").code, 0);
  Outcome o = merge("whole", "a b");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("'a/shard-1-of-2' and 'b/shard-2-of-2' are no parts of one run: the setting "
                       "'theme' is light in the first, dark in the second"),
            std::string::npos)
      << o.err;
  ASSERT_EQ(run("--shard 2/3", "c").code, 0);
  o = merge("whole", "a c");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("the number of shards is 2 in the first, 3 in the second"),
            std::string::npos)
      << o.err;
  write_text(at("six.toml"), six_steps() + "# changed\n");
  ASSERT_EQ(run("--shard 2/2", "d").code, 0);
  o = merge("whole", "a d");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("'six' has another text"), std::string::npos) << o.err;
  EXPECT_FALSE(fs::exists(home_ / "whole"));
}

TEST_F(Shards, OfAnotherLanternAreRefused) {
  run_shards(1, "parts");
  const fs::path record = home_ / "parts/shard-1-of-1/shard.json";
  json changed = json::parse(read_text(record));
  changed["version"] = "0.0.1";
  write_text(record, changed.dump());
  const Outcome o = merge("whole");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("'parts/shard-1-of-1' was made by another Lantern: its version is 0.0.1"),
            std::string::npos)
      << o.err;
}

TEST_F(Shards, TheSameOneTwiceMustBeEqual) {
  run_shards(2, "parts");
  ASSERT_EQ(run("--shard 2/2", "twin").code, 0);
  Outcome o = merge("whole", "parts twin");
  EXPECT_EQ(o.code, 0) << o.err;
  // Another picture of the same frame, as another machine's graphics might draw it.
  const fs::path frames = home_ / "twin/shard-2-of-2/six";
  write_text(frames / "six_0001.png", read_text(frames / "six_0003.png"));
  o = merge("whole", "parts twin");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("'parts/shard-2-of-2' and 'twin/shard-2-of-2' are both shard 2/2, but "
                       "differ in 'six'"),
            std::string::npos)
      << o.err;
}

TEST_F(Shards, AFileThatIsNotAsItWasWrittenIsNamed) {
  run_shards(2, "parts");
  const fs::path frames = home_ / "parts/shard-2-of-2/six";
  write_text(frames / "notes.txt", "mine");
  write_text(frames / "six_0001.png", "scribbled");
  Outcome o = merge("whole");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("shard 2/2 in 'parts/shard-2-of-2': six_0001.png is missing or not as "
                       "Lantern made it: run lantern render"),
            std::string::npos)
      << o.err;
  ASSERT_EQ(run("--shard 2/2", "parts").code, 0);
  o = merge("whole");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.err.find("six: not of shard 2/2, left where it is: notes.txt"), std::string::npos)
      << o.err;
  EXPECT_FALSE(fs::exists(home_ / "whole/six/notes.txt"));
}

TEST_F(Shards, AFolderWithoutAnyOrOneThatCannotBeWrittenIsRefused) {
  fs::create_directories(home_ / "empty");
  Outcome o = merge("whole", "empty");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("'empty' holds no shard; give folders that a run with --shard wrote into"),
            std::string::npos)
      << o.err;
  EXPECT_EQ(merge("whole", "nowhere").code, 2);
  run_shards(1, "parts");
  o = merge("parts/shard-1-of-1");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("is the folder of shard 1/1; give another one"), std::string::npos) << o.err;
  write_text(home_ / "file", "");
  o = merge("file/whole");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("file/whole"), std::string::npos) << o.err;
  write_text(home_ / "parts/shard-1-of-1/shard.json", "{");
  o = merge("whole");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("shard.json' is no record of a shard"), std::string::npos) << o.err;
}

TEST_F(Shards, AreOfFoldersOnly) {
  const Outcome o = shell(render_ + "--shard 1/2 -o " + at("film.mp4"));
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("--shard divides a folder of frames"), std::string::npos) << o.err;
  EXPECT_EQ(shell(render_ + "--shard 0/3 -o " + at("out")).code, 2);
  EXPECT_EQ(shell("lantern stress cradle --shard 1/2").code, 2);
  EXPECT_EQ(shell("lantern measure broad_phase --shard 1/2 -o " + at("out")).code, 2);
  EXPECT_FALSE(fs::exists(home_ / "out"));
}

}  // namespace
}  // namespace lantern::app
