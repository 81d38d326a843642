// Ctrl-C in the midst of work that takes minutes, and the budget of memory, from outside.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string case_file(const std::string& name) {
  return repository("tests/cases/" + name + ".toml").string();
}

TEST(Interrupt, EndsWhatWouldTakeHours) {
  const std::string into = " -o " + fresh_folder("cut").string();
  // A check makes no frames of events.
  for (const auto& [verb, name, more] :
       std::vector<std::array<std::string, 3>>{{"check", "nostruct20k", ""},
                                               {"render", "events_bomb", into},
                                               {"check", "gravitation20k", ""},
                                               {"render", "walls300ev", into}}) {
    // It says how much is to come once it is in the midst of it.
    const fs::path said = fresh_folder("interrupted") / "said";
    const Outcome o = shell("begin " + verb + " " + case_file(name) + more + " 2>" + said.string() +
                            "; until_so 'grep -q budget " + said.string() +
                            "'; interrupt; code=$?; cat " + said.string() + " >&2; exit $code");
    EXPECT_EQ(o.code, 130) << name << ": " << o.err;
    EXPECT_NE(o.err.find("interrupted"), std::string::npos) << name << ": " << o.err;
  }
}

// A measurement that goes on from an earlier one, and is cut before it comes to its rows.
TEST(Interrupt, LosesNoRowThatWasMeasured) {
  const fs::path out = fresh_folder("measure-cut-again");
  const std::string words = "measure projectile --quick --no-peers -o " + out.string();
  ASSERT_EQ(shell("lantern " + words).code, 0);
  const auto rows = [&] { return json::parse(read_text(out / "measure.json"))["rows"].size(); };
  const std::size_t before = rows();
  ASSERT_GT(before, 3u);
  for (const char* seconds : {"0.02", "0.05", "0.1", "0.2", "0.4"}) {
    shell(std::string("timeout -s INT ") + seconds + " " LANTERN_BINARY " " + words);
    EXPECT_GE(rows(), before) << "cut after " << seconds << " s";
  }
}

// A bench that is cut before its first world is done has nothing to write over an earlier one.
TEST(Interrupt, LeavesAnEarlierReportAsItIs) {
  const fs::path out = fresh_folder("bench-cut-again");
  const std::string words = " bench pairs --workload uniform_2d --no-peers -o " + out.string();
  ASSERT_EQ(shell("lantern" + words + " --bodies 50 --rounds 1 --only quadtree").code, 0);
  const std::string before = read_text(out / "bench_pairs.json");
  const Outcome o = shell("timeout -s INT 1 " LANTERN_BINARY + words + " --bodies 20000");
  EXPECT_NE(o.err.find("interrupted before any work was done; nothing is written"),
            std::string::npos)
      << o.err;
  EXPECT_EQ(read_text(out / "bench_pairs.json"), before);
}

TEST(Memory, WhatNeedsMoreThanTheBudgetIsRefusedAtItsLine) {
  const fs::path file = fresh_folder("memory") / "crowd.toml";
  write_text(file, R"(title = "All in one place"
[world]
size = [64, 64]
contacts = "impulse"
gravity = [0, -10]
[structure]
kind = "sort_and_sweep"
[[pattern]]
name = "b"
count = 400
radius = 30
[[step]]
do = "insert"
bodies = ["b"]
[[step]]
do = "run"
seconds = 0.1
)");
  const Outcome o = shell("lantern check " + file.string() + " --memory 64M");
  EXPECT_EQ(o.code, 3) << o.err;
  EXPECT_NE(o.err.find("crowd.toml:15:1: error: 79800 pairs that may touch need about"),
            std::string::npos)
      << o.err;
  EXPECT_NE(o.err.find("the budget is 64 MB; take fewer bodies that overlap, or --memory"),
            std::string::npos)
      << o.err;
  EXPECT_EQ(shell("lantern --memory 2G check " + file.string()).code, 0);
}

TEST(Memory, BehindAllElseThereIsAWall) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer maps more than any budget";
#endif
  const Outcome o = shell("lantern check --memory 16M " + case_file("nostruct20k"));
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_NE(o.err.find("out of memory: the budget is 16 MB; --memory sets it"), std::string::npos)
      << o.err;
}

// Whatever is drawn, and by whatever.
TEST(Memory, ABudgetThatIsTooSmallToDrawIsBlamed) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer maps more than any budget";
#endif
  const fs::path out = fresh_folder("memory-drawing");
  for (const char* to : {"a.png --frames 0", "frames", "a.mp4"}) {
    const Outcome o =
        shell("lantern render --memory 64M " + kGhosts + " -o " + (out / to).string());
    EXPECT_EQ(o.code, 1) << to << ": " << o.err;
    EXPECT_NE(o.err.find("pictures by OpenGL need about "), std::string::npos) << o.err;
    EXPECT_NE(o.err.find("the budget is 64 MB; "), std::string::npos) << o.err;
    EXPECT_NE(o.err.find(", or --memory "), std::string::npos) << o.err;
    EXPECT_EQ(o.err.find("ulimit"), std::string::npos) << o.err;
  }
  // The limits of the process are blamed where they are in the way.
  const Outcome limited = shell("ulimit -v 400000; lantern render --memory 4G " + kGhosts + " -o " +
                                (out / "frames").string());
  EXPECT_EQ(limited.code, 4) << limited.err;
  EXPECT_NE(limited.err.find("ulimit -v"), std::string::npos) << limited.err;
}

TEST(Memory, ASizeThatIsNoneIsAUsageError) {
  for (const char* words : {"5", "1Q", "-4G", "4k", "''"}) {
    const Outcome o = shell(std::string("lantern check x.toml --memory ") + words);
    EXPECT_EQ(o.code, 2) << words << ": " << o.err;
    EXPECT_NE(o.err.find("--memory"), std::string::npos) << words << ": " << o.err;
  }
}

}  // namespace
}  // namespace lantern::app
