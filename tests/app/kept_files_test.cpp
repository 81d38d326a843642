// No output is an input, and none is written over what Lantern keeps for another purpose.
#include <gtest/gtest.h>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLittle =
    "title = \"Little\"\n[world]\nsize = [16, 9]\n[structure]\nkind = \"quadtree\"\n"
    "[[body]]\nname = \"a\"\nradius = 0.5\nposition = [3, 5]\n"
    "[[step]]\ndo = \"insert\"\nbodies = [\"a\"]\n";

// Commands run in a folder with little.toml, the same under other endings, and what Lantern has
// made of it: out/ with frames, golden/, parts/, measured/.
class KeptFiles : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made() = fresh_folder("kept-files");
    for (const char* name :
         {"little.toml", "little.html", "little.png", "little.pdf", "little.svg"})
      write_text(made() / name, kLittle);
    for (const char* words :
         {"render little.toml --size 80x45 -o out", "golden little.toml --size 80x45 --update",
          "render little.toml --size 80x45 -o parts --shard 1/1",
          "measure projectile --quick --no-peers --method velocity_verlet --step 0.2 -o "
          "measured"}) {
      const Outcome o = run(words);
      ASSERT_EQ(o.code, 0) << words << o.err;
    }
  }
  static fs::path& made() {
    static fs::path folder;
    return folder;
  }
  static Outcome run(const std::string& words) {
    return shell("cd " + made().string() + " && lantern " + words);
  }
  // Exit code 2, with these words, and the file is as it was.
  static void expect_refused(const std::string& words, const std::string& file,
                             const std::string& why) {
    const std::string before = read_text(made() / file);
    const Outcome o = run(words);
    EXPECT_EQ(o.code, 2) << words << "\n" << o.err;
    EXPECT_NE(o.err.find(why), o.err.npos) << words << "\n" << o.err;
    EXPECT_EQ(read_text(made() / file), before) << words;
  }
};

TEST_F(KeptFiles, WhatARunReadsIsNotWrittenOver) {
  for (const char* ending : {"html", "pdf", "svg", "png"}) {
    const std::string file = std::string("little.") + ending;
    expect_refused("render " + file + " -o " + file, file, "is read by this run");
    expect_refused("render " + file + " -o ./{scenario}." + ending, file, "is read by this run");
  }
  expect_refused("render little.png --sheet 2x1 -o little.png", "little.png",
                 "is read by this run");
  fs::create_hard_link(made() / "little.html", made() / "same.html");
  fs::create_symlink("little.html", made() / "link.html");
  expect_refused("render little.html -o same.html", "little.html", "is read by this run");
  expect_refused("render little.html -o link.html", "little.html", "is read by this run");
  expect_refused("render - -o little.html <little.html", "little.html", "is read by this run");
  expect_refused("golden little.html --junit little.html", "little.html", "is read by this run");
  expect_refused("golden little.html --report little.html", "little.html", "is read by this run");
  expect_refused("compare little.png little.svg -o little.png", "little.png", "");
}

// Its name is known when its frame is there: nothing is lost then, either.
TEST_F(KeptFiles, NorWhereTheNameIsAFrames) {
  write_text(made() / "0000.svg", kLittle);
  expect_refused("render 0000.svg -o {frame}.svg", "0000.svg", "is read by this run");
}

TEST_F(KeptFiles, WhatLanternKeepsIsNotWrittenOverByAnotherOption) {
  const std::string golden = "golden/little/", out = "out/little/";
  for (const std::string& file :
       {golden + "little_0000.png", golden + "golden.txt", out + "manifest.json",
        out + "little_0000.json", std::string("parts/shard-1-of-1/shard.json"),
        std::string("measured/measure.json")}) {
    expect_refused("golden little.toml --size 80x45 --junit " + file, file, "name another file");
    expect_refused("golden little.toml --size 80x45 --report " + file, file, "name another file");
  }
  for (const std::string& file : {golden + "little_0000.png", out + "little_0000.png"})
    expect_refused("render little.toml -o " + file, file, "name another file");
  for (const char* file : {"nowhere/golden.txt", "manifest.json", "shard.json", "measure.json"}) {
    EXPECT_EQ(run(std::string("golden little.toml --size 80x45 --junit ") + file).code, 2) << file;
    EXPECT_FALSE(fs::exists(made() / file)) << file;
  }
  // Nor is anything put where one of its frames is missing, whatever the folder is called now.
  EXPECT_EQ(run("golden little.toml --size 80x45 --junit " + golden + "little_0007.png").code, 2);
  EXPECT_FALSE(fs::exists(made() / golden / "little_0007.png"));
  fs::copy(made() / "golden/little", made() / "renamed");
  expect_refused("golden little.toml --size 80x45 --report renamed/little_0000.png",
                 "renamed/little_0000.png", "name another file");
  // What is nobody's is, and so is a file of another name beside them.
  for (const char* words : {"golden/little/mine.png", "out/little/mine.png", "mine.png"})
    for (int twice = 0; twice < 2; ++twice)
      EXPECT_EQ(run(std::string("render little.toml -o ") + words).code, 0) << words;
}

// A list that is a link, empty, or cannot be read may still be one.
TEST_F(KeptFiles, AListThatCannotBeReadClosesItsFolder) {
  for (const char* how : {"mv golden.txt s; ln -s s golden.txt", "mv golden.txt s; : >golden.txt",
                          "rm golden.txt; ln -s nowhere golden.txt",
                          "rm golden.txt; mkfifo golden.txt", "rm golden.txt; mkdir golden.txt"}) {
    fs::remove_all(made() / "closed");
    fs::copy(made() / "golden", made() / "closed", fs::copy_options::recursive);
    ASSERT_EQ(shell("cd " + (made() / "closed/little").string() + "; " + how).code, 0);
    const std::string frame = "closed/little/little_0000.png";
    expect_refused(
        "render little.toml --size 80x45 -o closed", frame,
        "'closed/little' may hold the golden frames, of which golden.txt tells, which is "
        "empty or cannot be read");
    expect_refused("render little.toml -o " + frame, frame, "name another file");
    expect_refused("golden little.toml --junit " + frame, frame, "name another file");
  }
  for (const char* how : {"mv shard.json s; ln -s s shard.json", ": >shard.json"}) {
    fs::remove_all(made() / "closed");
    fs::copy(made() / "parts/shard-1-of-1", made() / "closed", fs::copy_options::recursive);
    ASSERT_EQ(shell("cd " + (made() / "closed").string() + "; " + how).code, 0);
    expect_refused("render little.toml -o closed", "closed/little/little_0000.png",
                   "'closed' may hold the frames of a part");
  }
}

// What cannot be written is told before anything goes.
TEST_F(KeptFiles, NothingIsRemovedForWhatCannotBeWritten) {
  fs::copy(made() / "out", made() / "lost", fs::copy_options::recursive);
  const fs::path manifest = made() / "lost/little/manifest.json";
  write_text(manifest, std::string("name = \"little\"\n") + kLittle);
  Outcome o = run("render lost/little/manifest.json --size 160x90 -o lost");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("it is what this run has read"), o.err.npos) << o.err;
  EXPECT_TRUE(fs::exists(made() / "lost/little/little_0000.png"));
  fs::remove(manifest);
  fs::create_directory(manifest);
  o = run("render little.toml --size 160x90 -o lost");
  EXPECT_EQ(o.code, 1);
  EXPECT_TRUE(fs::exists(made() / "lost/little/little_0000.png")) << o.err;
}

TEST_F(KeptFiles, AFileThatWouldBeNoneIsRefused) {
  fs::copy(made() / "out", made() / "other", fs::copy_options::recursive);
  write_text(made() / "other/little/little_0000.json", "{}");
  for (const char* place : {"new/", "new/.", "new/x/.."})
    for (const char* words :
         {"compare out/little/little_0000.json other/little/little_0000.json -o ",
          "golden little.toml --size 80x45 --junit "}) {
      const Outcome o = run(std::string(words) + place);
      EXPECT_TRUE(o.code == 1 || o.code == 2) << words << place << o.code << o.err;
      EXPECT_FALSE(fs::exists(made() / "new")) << words << place;
    }
  fs::create_directories(made() / "darker");
  ASSERT_EQ(run("render little.toml --size 80x45 --theme dark -o darker").code, 0);
  const Outcome o = run("compare out/little/little_0000.png darker/little/little_0000.png -o new/");
  EXPECT_EQ(o.code, 2) << o.err;
  EXPECT_NE(o.err.find("'new/' is a folder; name another file"), o.err.npos) << o.err;
}

TEST_F(KeptFiles, ATableOfAMeasurementIsNotWrittenOver) {
  for (const char* file : {"measured/measure.csv", "measured/report.html"})
    expect_refused(std::string("golden little.toml --size 80x45 --junit ") + file, file,
                   "one of the tables and pages of a measurement there");
}

// It may be read by another run.
TEST_F(KeptFiles, NoReportIsCalledAsAScenario) {
  for (const char* words :
       {"golden little.toml --size 80x45 --junit ", "golden little.toml --size 80x45 --report "})
    for (const char* name : {"exam.toml", "exam.TOML"}) {
      write_text(made() / name, kLittle);
      expect_refused(words + std::string(name), name, "called as scenarios are");
    }
}

TEST_F(KeptFiles, ABenchIsNotWrittenOverItsBoxes) {
  const std::string boxes = "bench_pairs.csv";
  write_text(made() / boxes, "0,0,1,1\n2,2,3,3\n");
  expect_refused("bench pairs --boxes " + boxes + " --no-peers --seconds 0.01 -o .", boxes,
                 "is read by this run and would be written over");
}

TEST_F(KeptFiles, WhatIsNoFileIsNoOutput) {
  ASSERT_EQ(shell("mkfifo " + (made() / "pipe.png").string()).code, 0);
  for (const char* words : {"render little.toml -o pipe.png", "golden little.toml --junit pipe.png",
                            "golden little.toml --report pipe.png"})
    EXPECT_EQ(run(words).code, 2) << words;
  EXPECT_TRUE(fs::is_fifo(made() / "pipe.png"));
  const Outcome o = run("golden little.toml --junit x.html --report ./x.html");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("--junit and --report name the same file"), o.err.npos) << o.err;
}

TEST_F(KeptFiles, AFolderIsKeptForOnePurpose) {
  expect_refused("render little.toml --size 80x45 -o golden", "golden/little/little_0000.png",
                 "'golden/little' holds the golden frames, of which golden.txt tells");
  expect_refused("golden little.toml --dir out --update", "out/little/little_0000.png",
                 "'out/little' holds the frames of a run, of which manifest.json tells");
  expect_refused("golden little.toml --dir out", "out/little/little_0000.png",
                 "'out/little' holds the frames of a run, of which manifest.json tells");
  expect_refused("render little.toml -o parts/shard-1-of-1", "parts/shard-1-of-1/shard.json",
                 "'parts/shard-1-of-1' holds the frames of a part, of which shard.json tells");
  expect_refused("measure --from measured -o golden/little", "golden/little/little_0000.png",
                 "'golden/little' holds the golden frames, of which golden.txt tells");
}

// The difference of a/p.png would take the place of p.png, which comes later.
TEST_F(KeptFiles, NoDifferenceTakesThePlaceOfWhatIsYetToBeCompared) {
  const std::string frame = read_text(made() / "out/little/little_0000.png");
  for (const char* folder : {"x/a/a", "x/b/a"}) {
    fs::create_directories(made() / folder);
    for (const char* file : {"p.png", "../p.png"}) write_text(made() / folder / file, frame);
  }
  expect_refused("compare x/a x/b -o x", "x/a/p.png", "'x/a/p.png' is read by this run");
}

// Not even the answer that says so.
TEST_F(KeptFiles, StandardOutputIsNoInput) {
  write_text(made() / "in.toml", kLittle);
  for (const char* words :
       {"lantern check in.toml --json 1<>in.toml", "lantern check in.toml --json >>in.toml",
        "lantern list in.toml --json >>in.toml", "lantern check - --json <in.toml >>in.toml",
        "lantern explain - <in.toml >>in.toml", "lantern explain in.toml >>in.toml",
        "lantern render - -o - --size 80x45 <in.toml >>in.toml"}) {
    const Outcome o = shell("cd " + made().string() + " && " + words);
    EXPECT_EQ(o.code, 1) << words;
    EXPECT_NE(o.err.find("standard output is written to a file that this run reads"), o.err.npos)
        << words << "\n"
        << o.err;
    EXPECT_EQ(o.err.find("standard output"), o.err.rfind("standard output")) << "told once";
    EXPECT_EQ(read_text(made() / "in.toml"), kLittle) << words;
  }
}

// Whatever of it is read: also what Lantern has kept, and standard error.
TEST_F(KeptFiles, NorIsAStreamWhatIsRead) {
  fs::create_directories(made() / "read");
  for (const char* folder : {"golden", "out", "parts"})
    fs::copy(made() / folder, made() / "read" / folder, fs::copy_options::recursive);
  write_text(made() / "read/little.toml", kLittle);
  for (const auto& [words, file] :
       {std::pair{"golden little.toml --size 80x45 --json >>", "golden/little/golden.txt"},
        {"golden little.toml --size 80x45 2>>", "golden/little/golden.txt"},
        {"render little.toml --size 80x45 -o out --json 1<>", "out/little/little_0000.png"},
        {"render little.toml --size 80x45 -o out --json 1<>", "out/little/little_0000.json"},
        {"merge parts --json 1<>", "parts/shard-1-of-1/shard.json"},
        {"merge parts --json 1<>", "parts/shard-1-of-1/little/manifest.json"},
        {"merge parts 2>>", "parts/shard-1-of-1/shard.json"},
        {"check little.toml nope.toml 2>>", "little.toml"}}) {
    const std::string before = read_text(made() / "read" / file);
    const Outcome o = shell("cd " + (made() / "read").string() + " && lantern " + words + file);
    EXPECT_NE(o.code, 0) << words << file;
    EXPECT_EQ(read_text(made() / "read" / file), before) << words << file;
  }
}

TEST_F(KeptFiles, AForeignFileIsReplacedWithAWord) {
  const std::pair<const char*, const char*> cases[] = {
      {"foreign/little/manifest.json", "render little.toml --size 80x45 -o foreign"},
      {"foreign/shard-1-of-1/shard.json",
       "render little.toml --size 80x45 -o foreign --shard 1/1"}};
  for (const auto& [file, words] : cases) {
    fs::create_directories((made() / file).parent_path());
    write_text(made() / file, "{\"mine\": 1}\n");
    for (const bool is_foreign : {true, false}) {
      const Outcome o = run(words);
      EXPECT_EQ(o.code, 0) << o.err;
      EXPECT_EQ(o.err.find("it was not as Lantern made it") != o.err.npos, is_foreign) << o.err;
    }
  }
}

TEST_F(KeptFiles, BelowAPlaceholderNoLinkIsFollowed) {
  fs::create_directories(made() / "links");
  fs::create_directories(made() / "elsewhere");
  fs::create_symlink("../elsewhere", made() / "links/little");
  const Outcome o = run("render little.toml --size 80x45 -o 'links/{scenario}/x.html'");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("'links/little' is a link"), o.err.npos) << o.err;
  EXPECT_TRUE(fs::is_empty(made() / "elsewhere"));
}

TEST_F(KeptFiles, NoNumberIsNaNAndNoWordIsEmpty) {
  for (const char* words :
       {"render little.toml --hold nan -o x.gif", "compare out golden --fraction nan",
        "golden little.toml --size ''", "structure check --seed ''"})
    EXPECT_EQ(run(words).code, 2) << words;
}

}  // namespace
}  // namespace lantern::app
