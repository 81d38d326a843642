// `lantern measure broad_phase`, and whom `lantern measure` leaves out, as a user meets them.
#include <algorithm>
#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

#ifdef __SANITIZE_ADDRESS__
constexpr bool kMeasuresAll = false;
#else
constexpr bool kMeasuresAll = true;
#endif

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0, to; (to = text.find('\n', from)) != std::string::npos; from = to + 1)
    lines.push_back(text.substr(from, to - from));
  return lines;
}

// What --json prints is the file, and how the command ended.
void expect_answer(const std::string& out, const std::string& file) {
  json answer = json::parse(out);
  EXPECT_EQ(answer["exit_code"], 0);
  answer.erase("diagnostics");
  answer.erase("exit_code");
  EXPECT_EQ(answer, json::parse(file));
}

// Of a table in which only the machine is quoted: every line has as many fields as the first.
void expect_csv(const std::string& text, std::size_t rows) {
  const std::vector<std::string> lines = lines_of(text);
  ASSERT_EQ(lines.size(), rows + 1);
  for (const std::string& line : lines) {
    const std::string bare = std::regex_replace(line, std::regex("\"[^\"]*\""), "quoted");
    EXPECT_EQ(std::ranges::count(bare, ','), std::ranges::count(lines[0], ',')) << line;
  }
}

TEST(MeasureBroadPhase, WritesTablesAndAPageForEachTree) {
  if (!kMeasuresAll) GTEST_SKIP() << "builds many trees";
  const fs::path out = fresh_folder("measure_broad_phase") / "deeper";
  const Outcome o = shell("lantern measure broad_phase --json ghost_maze -o " + out.string());
  ASSERT_EQ(o.code, 0) << o.err;
  for (const std::string tree : {"quadtree", "bsp", "kd_tree"})
    for (const char* ending : {".svg", ".png"})
      EXPECT_TRUE(fs::exists(out / ("broad_phase_ghost_maze_" + tree + ending))) << tree << ending;
  expect_answer(o.out, read_text(out / "broad_phase.json"));
  const json report = json::parse(o.out);
  EXPECT_EQ(report["format"], "lantern.measure.broad_phase/2");
  ASSERT_EQ(report["scenes"].size(), 1u);
  expect_csv(read_text(out / "broad_phase.csv"), report["rows"].size());
  EXPECT_NE(read_text(out / "broad_phase.txt").find("sort_and_sweep"), std::string::npos);
}

TEST(MeasureBroadPhase, MistakesAreTold) {
  const fs::path out = fresh_folder("measure_broad_phase_mistakes");
  const auto run = [&](const std::string& words) {
    return shell("lantern measure broad_phase " + words + " -o " + (out / "none").string());
  };
  const Outcome missing = run("quadtree");
  EXPECT_EQ(missing.code, 1) << "words are files here";
  EXPECT_NE(missing.err.find("quadtree"), std::string::npos) << missing.err;
  const Outcome atlas = run(scenario("kdtree_atlas"));
  EXPECT_EQ(atlas.code, 3) << atlas.err;
  EXPECT_FALSE(fs::exists(out / "none" / "broad_phase.json"));
}

TEST(MeasureBroadPhase, AFolderThatCannotBeWrittenIsFoundOutFirst) {
  const Outcome o = shell("lantern measure broad_phase -o /proc/lantern");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("/proc/lantern"), std::string::npos) << o.err;
}

TEST(MeasureCommand, AMethodThatDoesNotSuitIsNamedWithTheReason) {
  const fs::path out = fresh_folder("measure_unsuited");
  const Outcome alone =
      shell("lantern measure projectile --quick --no-peers --method impulse -o " + out.string());
  EXPECT_EQ(alone.code, 1);
  EXPECT_NE(alone.err.find("projectile is not run by impulse: its bodies do not collide"),
            std::string::npos)
      << alone.err;
  const Outcome beside = shell(
      "lantern measure projectile kepler --quick --longest 600 --no-peers --method impulse "
      "--method velocity_verlet --step 0.1 -o " +
      out.string());
  EXPECT_EQ(beside.code, 0);
  EXPECT_NE(beside.err.find("projectile and kepler are not run by impulse"), std::string::npos)
      << "a method that was asked for is missing without a word: " << beside.err;
}

// Whether engines are there depends on what was installed when Lantern was built.
TEST(MeasureCommand, AnEngineIsNoMethodAndThisIsSaid) {
  for (const char* engine : {"bullet", "Box2D", "MuJoCo:RK4"}) {
    const Outcome o = shell(std::string("lantern measure kepler --method ") + engine);
    EXPECT_EQ(o.code, 2) << engine;
    EXPECT_NE(o.err.find("is no method but another engine"), std::string::npos) << o.err;
  }
  const Outcome o = shell("lantern measure kepler --method mujoco");
  EXPECT_TRUE(o.err.find("not built in") != std::string::npos ||
              o.err.find("kepler is not run by MuJoCo") != std::string::npos)
      << "the reason is missing: " << o.err;
}

TEST(BenchAtlas, WritesATableAndFilesOfItsOwnSetsAndAUsersTextures) {
  const fs::path out = fresh_folder("bench_atlas");
  const std::string to = " --rounds 1 -o " + out.string();
  const Outcome o = shell("lantern bench atlas --set tall --count 30 --no-peers" + to);
  ASSERT_EQ(o.code, 0) << o.err;
  for (const char* words : {"tall, 30 textures", "first_fit", "best_texture:turn", "leaf tests"})
    EXPECT_NE(o.out.find(words), std::string::npos) << words << "\n" << o.out;
  const json written = json::parse(read_text(out / "bench_atlas.json"));
  EXPECT_EQ(written["format"], "lantern.bench.atlas/1");
  ASSERT_EQ(written["rows"].size(), 3u);
  EXPECT_EQ(written["rows"][1]["packed"], 30);
  EXPECT_EQ(written["rows"][1]["seconds"]["repeats"], 1);
  EXPECT_EQ(lines_of(read_text(out / "bench_atlas.csv")).size(), 4u);
  const std::string page = read_text(out / "bench_atlas.html");
  for (const char* words : {"lantern bench atlas --set tall --count 30 --no-peers --rounds 1",
                            "Packing into it", "<svg", "best_texture:turn", "</html>"})
    EXPECT_NE(page.find(words), std::string::npos) << words;

  write_text(out / "mine.csv", "width,height\n30,10\n10,30\n");
  const std::string own = "lantern bench atlas --rounds 1 --no-peers --sizes " + out.string();
  const Outcome mine = shell(own + "/mine.csv --size 20x30 --json");
  ASSERT_EQ(mine.code, 0) << mine.err;
  EXPECT_EQ(json::parse(mine.out)["rows"][2]["turned"], 1);
  write_text(out / "wrong.csv", "30,10\n10,3O\n");
  const Outcome wrong = shell(own + "/wrong.csv");
  EXPECT_EQ(wrong.code, 3);
  EXPECT_NE(wrong.err.find("wrong.csv:2:4: error:"), std::string::npos) << wrong.err;
  EXPECT_EQ(shell(own + "/none.csv").code, 1);
  for (const char* words : {"--set tal", "--only nobody", "--size 20", "--count 0"})
    EXPECT_EQ(shell(std::string("lantern bench atlas --no-peers ") + words).code, 2) << words;
}

TEST(BenchStep, WritesATableAndFiles) {
  const fs::path out = fresh_folder("bench_step");
  const Outcome o = shell(
      "lantern bench step --pile balls2d:3 --pile boxes2d:2 --seconds 1 "
      "--only soft:2 -o " +
      out.string());
  ASSERT_EQ(o.code, 0) << o.err;
  for (const char* words : {"balls2d:3", "boxes2d:2", "soft:2", "deepest", "box tests"})
    EXPECT_NE(o.out.find(words), std::string::npos) << words << "\n" << o.out;
  const json written = json::parse(read_text(out / "bench_step.json"));
  EXPECT_EQ(written["format"], "lantern.bench.step/1");
  ASSERT_EQ(written["rows"].size(), 2u);
  EXPECT_EQ(written["rows"][0]["work"]["steps"], 60);
  EXPECT_EQ(lines_of(read_text(out / "bench_step.csv")).size(), 3u);
  const std::string page = read_text(out / "bench_step.html");
  for (const char* words : {"lantern bench step --pile balls2d:3 --pile boxes2d:2 --seconds 1",
                            "boxes2d:2", "<svg", "soft:2", "</html>"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
  EXPECT_EQ(shell("lantern bench step --pile balls2d:0").code, 2);
  EXPECT_EQ(shell("lantern bench step --pile balls2d:3 --only nobody").code, 2);
  EXPECT_EQ(shell("lantern bench step --pile balls2d:3 --broad-phase octree").code, 2);
}

TEST(BenchPairs, WritesATableAndFiles) {
  const fs::path out = fresh_folder("bench_pairs");
  const std::string small = "lantern bench pairs --rounds 2 --bodies 100 ";
  const Outcome o = shell(small +
                          "--workload uniform_2d --workload boxes_3d --only octree "
                          "--only sort_and_sweep --no-peers -o " +
                          out.string());
  ASSERT_EQ(o.code, 0) << o.err;
  for (const char* words : {"uniform_2d with 100 boxes", "sort_and_sweep", "boxes_3d", "octree"})
    EXPECT_NE(o.out.find(words), std::string::npos) << words << "\n" << o.out;
  EXPECT_EQ(json::parse(read_text(out / "bench_pairs.json"))["rows"].size(), 4u);
  const std::vector<std::string> csv = lines_of(read_text(out / "bench_pairs.csv"));
  ASSERT_EQ(csv.size(), 5u);
  EXPECT_EQ(csv[0].find("workload,dimension,bodies,contestant,"), 0u) << csv[0];
  EXPECT_NE(csv[0].find(",entries,frames,found_in_all,processor,date"), std::string::npos)
      << csv[0];
  EXPECT_NE(o.out.find("left out: it does not do this in 2 dimensions"), std::string::npos)
      << o.out;
  EXPECT_NE(read_text(out / "bench_pairs.html").find("sort_and_sweep"), std::string::npos);
  const Outcome unknown = shell(small + "--workload unifrm_2d");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("did you mean 'uniform_2d'?"), std::string::npos) << unknown.err;
  EXPECT_EQ(shell(small + "--only nobody").code, 2);
  EXPECT_EQ(shell(small + "--workload uniform --boxes x.csv").code, 2);
  EXPECT_EQ(shell(small + "--boxes x.csv").code, 2) << "a file has its own number of boxes";
}

TEST(BenchPairs, ReadsBoxesOfOnesOwn) {
  const fs::path out = fresh_folder("bench_boxes");
  write_text(out / "mine.csv", "0,0,2,2\n1,1,3,3\n5,5,6,6\n");
  const std::string mine = "lantern bench pairs --no-peers --rounds 2 --boxes ";
  const Outcome o = shell(mine + (out / "mine.csv").string());
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("mine with 3 boxes: 1 pair at the first of 24 frames, "), std::string::npos)
      << o.out;
  EXPECT_NE(o.out.find("checked by brute force at the first two frames"), std::string::npos)
      << o.out;
  const Outcome solid = shell(mine + (out / "mine.csv").string() + " --only octree");
  EXPECT_EQ(solid.code, 1);
  EXPECT_NE(solid.err.find("nothing was measured: octree: it does not do this in 2 dimensions"),
            std::string::npos)
      << solid.err;
  write_text(out / "vast.csv", "-1.7e308,0,1.7e308,1\n0,0,1,1\n");
  const Outcome vast = shell(mine + (out / "vast.csv").string());
  EXPECT_EQ(vast.code, 1) << vast.out;
  EXPECT_EQ(vast.out.find("0 pairs"), vast.out.npos) << vast.out;
  write_text(out / "moving.csv", "t,obj,lo_x,lo_y,hi_x,hi_y\n0,a,0,0,1,1\n0,b,2,2,3,3\n");
  const std::string moving = mine + (out / "moving.csv").string();
  EXPECT_NE(shell(moving).out.find("not used: t, obj"), std::string::npos);
  const Outcome unknown = shell(moving + " --columns frame=time");
  EXPECT_EQ(unknown.code, 3);
  EXPECT_NE(unknown.err.find("moving.csv:1:1: error: no column is called 'time'"),
            std::string::npos)
      << unknown.err;
  write_text(out / "bad.csv", "0,0,2,2\n1,1,3,x\n");
  const Outcome bad = shell(mine + (out / "bad.csv").string());
  EXPECT_EQ(bad.code, 3);
  EXPECT_NE(bad.err.find("bad.csv:2:7: error: 'x' is no finite number"), std::string::npos)
      << bad.err;
}

// A program without other engines beside it, as it is installed.
TEST(BenchPairs, NamesThePackagesOfWhatIsMissing) {
  const fs::path out = fresh_folder("bench_missing");
  fs::create_hard_link(LANTERN_BINARY, out / "lantern");
  fs::create_hard_link(LANTERN_BUILD "/lantern_lab.so", out / "lantern_lab.so");
  const std::string alone = (out / "lantern").string() +
                            " bench pairs --workload uniform_2d --rounds 2 --bodies 50 --only ";
  const Outcome o = shell(alone + "quadtree");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("missing: not built in; apt-get install libcgal-dev"), std::string::npos)
      << o.out;
  const Outcome asked = shell(alone + "CGAL");
  EXPECT_EQ(asked.code, 2);
  EXPECT_NE(asked.err.find("libcgal-dev"), std::string::npos) << asked.err;
}

}  // namespace
}  // namespace lantern::app
